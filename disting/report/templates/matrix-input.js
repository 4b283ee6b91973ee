// Keys and pointers. Arrows move, Enter opens, + - 0 zoom; a click opens, a drag moves, two fingers or the wheel zoom.
const STEPS = {
  ArrowLeft: ([row, col]) => [row, col - 1],
  ArrowRight: ([row, col]) => [row, col + 1],
  ArrowUp: ([row, col]) => [row - 1, col],
  ArrowDown: ([row, col]) => [row + 1, col],
  PageUp: ([row, col]) => [row - 10, col],
  PageDown: ([row, col]) => [row + 10, col],
  Home: ([row], last, far) => (far ? [0, 0] : [row, 0]),
  End: ([row], last, far) => (far ? [last, last] : [row, last]),
};
const listenToKeys = (grid, v, { field, last, moveTo, open, changed }) => {
  grid.addEventListener("keydown", (event) => {
    const far = event.ctrlKey || event.metaKey;
    const middle = () => { // of the cursor's field
      const [row, col] = field();
      return [v.left + (col + 0.5) * v.cell, v.top + (row + 0.5) * v.cell];
    };
    if (Object.hasOwn(STEPS, event.key)) {
      const next = STEPS[event.key](field(), last(), far);
      moveTo(...next.map((at) => Math.max(0, Math.min(last(), at))), { focus: true });
    } else if (event.key === "Enter" || event.key === " ") open(...field());
    else if (far || event.altKey) return;
    else if (event.key === "+" || event.key === "=") v.zoomTo(v.cell * 1.4, ...middle());
    else if (event.key === "-") v.zoomTo(v.cell / 1.4, ...middle());
    else if (event.key === "0") v.fit();
    else return;
    event.preventDefault();
    changed();
  });
};
const listenToPointers = (host, v, { moveTo, open, hover, changed }) => {
  const down = new Map();
  let moved = false;
  const at = (event) => {
    const box = host.getBoundingClientRect();
    return v.at(event.clientX - box.left, event.clientY - box.top);
  };
  const spread = () => {
    const [a, b] = [...down.values()];
    return { size: Math.hypot(a.x - b.x, a.y - b.y), x: (a.x + b.x) / 2, y: (a.y + b.y) / 2 };
  };
  const pinch = (id, here) => {
    const old = spread();
    down.set(id, here);
    const now = spread();
    v.moveBy(now.x - old.x, now.y - old.y);
    v.zoomTo((v.cell * now.size) / Math.max(1, old.size), now.x, now.y);
  };
  host.addEventListener("pointerdown", (event) => {
    if (event.button) return;
    if (!down.size) moved = false;
    down.set(event.pointerId, at(event));
  });
  host.addEventListener("pointermove", (event) => {
    const here = at(event), before = down.get(event.pointerId);
    if (!before) return hover(here.field);
    if (!moved && Math.hypot(here.x - before.x, here.y - before.y) < 5 && down.size === 1) return;
    moved = true;
    host.setPointerCapture(event.pointerId);
    if (down.size === 2) pinch(event.pointerId, here);
    else {
      v.moveBy(here.x - before.x, here.y - before.y);
      down.set(event.pointerId, here);
    }
    changed();
  });
  host.addEventListener("pointerup", (event) => {
    const before = down.get(event.pointerId), { field } = at(event);
    down.delete(event.pointerId);
    if (!before || moved || !field) return;
    moveTo(...field, { focus: true });
    open(...field);
  });
  host.addEventListener("pointercancel", (event) => down.delete(event.pointerId));
  host.addEventListener("mousedown", (event) => event.preventDefault()); // the cursor keeps the focus
  host.addEventListener("pointerleave", () => hover(null));
  host.addEventListener("wheel", (event) => {
    if (!(event.ctrlKey || event.metaKey || host.matches(":focus-within"))) return;
    if (v.fitted && event.deltaY > 0 && !event.ctrlKey) return; // nothing smaller: the page scrolls on
    event.preventDefault();
    const { x, y } = at(event);
    v.zoomTo(v.cell * Math.exp(-Math.max(-120, Math.min(120, event.deltaY)) / 300), x, y);
    changed();
  }, { passive: false });
};
