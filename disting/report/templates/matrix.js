"use strict";
// A square of n x n fields on a canvas: one view below the diagonal, another above it. Only what is visible is drawn. Fields
// smaller than a pixel are merged, the rarer relation wins, so that no field of millions is lost. One element, the cursor, is
// the field for assistive technology: a cell of a grid that is made anew wherever the focus moves.
const createMatrix = (host, source) => {
  const GUTTER = 42, LARGEST = 48, FIT_LARGEST = 44, LINES_FROM = 5, MARKS_FROM = 7, SIGNS_FROM = 14, LABEL = 14;
  const RELATIONS = ["distinguishable", "indistinguishable", "sometimes", "undecided"];
  const canvas = host.querySelector("canvas");
  const grid = host.querySelector('[role="grid"]');
  const pen = canvas.getContext("2d");
  const n = source.count;
  const state = { order: source.order, place: [], blocks: [], views: source.views, lit: () => true, row: 1, col: 0, picked: null, hover: null };
  let width = 0, height = 0, cell = 10, left = 0, top = 0, fitted = true, levels = [], images = [], colours = null, waiting = 0;

  // ---- fields: key 0 on the diagonal, else 1 + relation, and 4 more where the filter lets it through
  const view = (row, col) => state.views[row > col ? 0 : 1];
  const pair = (row, col) => [state.order[row], state.order[col]];
  const keysOf = () => {
    const keys = new Uint8Array(n * n);
    const codes = state.views.map((v) => source.codes(v));
    for (let row = 0; row < n; row++)
      for (let col = 0; col < n; col++) {
        if (row === col) continue;
        const i = state.order[row], j = state.order[col];
        const code = codes[row > col ? 0 : 1][i > j ? ((i - 1) * (i - 2)) / 2 + j - 1 : ((j - 1) * (j - 2)) / 2 + i - 1];
        keys[row * n + col] = 1 + code + (state.lit(i, j, code) ? 4 : 0);
      }
    return keys;
  };
  const merged = ({ size, keys }) => {
    const half = Math.ceil(size / 2), found = new Uint8Array(half * half);
    for (let row = 0; row < size; row++)
      for (let col = 0; col < size; col++) {
        const at = (row >> 1) * half + (col >> 1), key = keys[row * size + col];
        if (key > found[at]) found[at] = key;
      }
    return { size: half, keys: found };
  };
  const level = (k) => (levels[k] ??= k ? merged(level(k - 1)) : { size: n, keys: keysOf() });

  // ---- colours come from the style sheet, so that light and dark follow it
  const css = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
  const rgb = (colour) => {
    pen.fillStyle = colour;
    return [1, 3, 5].map((i) => parseInt(pen.fillStyle.slice(i, i + 2), 16));
  };
  const palette = () => {
    const paper = rgb(css("paper"));
    const dim = (colour) => colour.map((v, i) => Math.round(paper[i] + (v - paper[i]) * 0.16));
    const full = RELATIONS.map((name) => rgb(css(name)));
    return [rgb(css("body")), ...full.map(dim), ...full];
  };
  const image = (k) => {
    if (images[k]) return images[k];
    const { size, keys } = level(k);
    const found = document.createElement("canvas");
    found.width = found.height = size;
    const context = found.getContext("2d"), pixels = context.createImageData(size, size);
    const words = new Uint32Array(pixels.data.buffer);
    const packed = colours.map(([r, g, b]) => ((255 << 24) | (b << 16) | (g << 8) | r) >>> 0);
    for (let i = 0; i < words.length; i++) words[i] = packed[keys[i]];
    context.putImageData(pixels, 0, 0);
    return (images[k] = found);
  };
  const refresh = ({ fields = true } = {}) => {
    if (fields) levels = [];
    images = [];
    colours = null;
    redraw();
  };

  // ---- geometry: field (row, col) begins at left + col * cell, top + row * cell of the plot
  const room = () => [width - GUTTER, height - GUTTER];
  const fitCell = () => Math.min(FIT_LARGEST, Math.min(...room()) / n);
  const clamp = () => {
    const [w, h] = room();
    left = Math.min(0, Math.max(left, w - n * cell));
    top = Math.min(0, Math.max(top, h - n * cell));
    host.style.touchAction = cell > fitCell() * 1.01 ? "none" : "pan-y";
  };
  const zoomTo = (size, x = room()[0] / 2, y = room()[1] / 2) => {
    const smallest = fitCell();
    const next = Math.max(smallest, Math.min(Math.max(LARGEST, smallest), size));
    left = x - ((x - left) * next) / cell;
    top = y - ((y - top) * next) / cell;
    cell = next;
    fitted = cell <= smallest * 1.001;
    clamp();
    redraw();
  };
  const fit = () => {
    cell = fitCell();
    left = top = 0;
    fitted = true;
    clamp();
    redraw();
  };
  const at = (event) => {
    const box = canvas.getBoundingClientRect();
    const x = event.clientX - box.left - GUTTER, y = event.clientY - box.top - GUTTER;
    const row = Math.floor((y - top) / cell), col = Math.floor((x - left) / cell);
    const inside = x >= 0 && y >= 0 && row >= 0 && col >= 0 && row < n && col < n;
    return { x, y, field: inside ? [row, col] : null };
  };
  const reveal = (row, col) => {
    const [w, h] = room();
    const edge = Math.min(cell, w / 4);
    left = Math.min(Math.max(left, edge - (col + 1) * cell), w - edge - (col + 0) * cell - edge);
    top = Math.min(Math.max(top, edge - (row + 1) * cell), h - edge - row * cell - edge);
    clamp();
  };

  // ---- drawing
  const draw = () => {
    waiting = 0;
    if (!width) return;
    const scale = window.devicePixelRatio || 1;
    colours ??= palette();
    pen.setTransform(scale, 0, 0, scale, 0, 0);
    pen.fillStyle = css("paper");
    pen.fillRect(0, 0, width, height);
    const [w, h] = room();
    const span = (from, length) => [Math.max(0, Math.floor(-from / cell)), Math.min(n, Math.ceil((length - from) / cell))];
    const [c0, c1] = span(left, w), [r0, r1] = span(top, h);
    pen.save();
    pen.beginPath();
    pen.rect(GUTTER, GUTTER, w, h);
    pen.clip();
    pen.translate(GUTTER + left, GUTTER + top);
    const k = Math.max(0, Math.ceil(Math.log2(1 / (cell * scale)))), f = 2 ** k;
    pen.imageSmoothingEnabled = false;
    const [sx, sy] = [Math.floor(c0 / f), Math.floor(r0 / f)], [sw, sh] = [Math.ceil(c1 / f) - sx, Math.ceil(r1 / f) - sy];
    pen.drawImage(image(k), sx, sy, sw, sh, sx * f * cell, sy * f * cell, sw * f * cell, sh * f * cell);
    if (cell >= LINES_FROM) lines(r0, r1, c0, c1);
    if (cell >= MARKS_FROM) marks(r0, r1, c0, c1);
    if (cell >= SIGNS_FROM) signs(r0, r1, c0, c1);
    pen.restore();
    pen.save();
    pen.beginPath();
    pen.rect(GUTTER - 6, GUTTER - 6, w + 6, h + 6); // frames of the first row and column reach a little over the edge
    pen.clip();
    pen.translate(GUTTER + left, GUTTER + top);
    outlines();
    pen.restore();
    labels(r0, r1, c0, c1);
    place();
    host.dataset.cell = cell.toFixed(3);
  };
  const redraw = () => (waiting ||= requestAnimationFrame(draw));
  const lines = (r0, r1, c0, c1) => {
    pen.fillStyle = css("paper");
    pen.globalAlpha = cell < 12 ? 0.35 : 1;
    for (let row = r0; row <= r1; row++) pen.fillRect(c0 * cell, row * cell - 0.5, (c1 - c0) * cell, 1);
    for (let col = c0; col <= c1; col++) pen.fillRect(col * cell - 0.5, r0 * cell, 1, (r1 - r0) * cell);
    pen.globalAlpha = 1;
  };
  const visible = (r0, r1, c0, c1, act) => {
    const { keys } = level(0);
    for (let row = r0; row < r1; row++)
      for (let col = c0; col < c1; col++) if (row !== col) act(row, col, (keys[row * n + col] - 1) % 4, keys[row * n + col] > 4);
  };
  const marks = (r0, r1, c0, c1) => {
    const ink = RELATIONS.map((name) => css(`on-${name}`) || css("paper"));
    const leg = cell * 0.3;
    visible(r0, r1, c0, c1, (row, col, code, lit) => {
      if (!code || !lit) return;
      const x = col * cell + 0.5, y = row * cell + 0.5, far = cell - 1;
      pen.beginPath();
      if (code === 1) pen.moveTo(x + far - leg, y), pen.lineTo(x + far, y), pen.lineTo(x + far, y + leg);
      if (code === 2) pen.moveTo(x, y + far - leg), pen.lineTo(x, y + far), pen.lineTo(x + leg, y + far);
      if (code === 3) pen.moveTo(x, y), pen.lineTo(x + leg, y), pen.lineTo(x + far, y + far - leg), pen.lineTo(x + far, y + far), pen.lineTo(x + far - leg, y + far), pen.lineTo(x, y + leg);
      pen.fillStyle = ink[code];
      pen.fill();
    });
  };
  const signs = (r0, r1, c0, c1) => {
    const ink = RELATIONS.map((name) => css(`on-${name}`) || css("ink"));
    pen.textAlign = "center";
    pen.textBaseline = "middle";
    pen.font = `600 ${cell * 0.56}px system-ui, sans-serif`;
    visible(r0, r1, c0, c1, (row, col, code, lit) => {
      if (code === 3 || !lit) return;
      pen.fillStyle = ink[code];
      pen.fillText(source.sign(...pair(row, col), view(row, col)), (col + 0.5) * cell, (row + 0.53) * cell);
    });
  };
  const frame = (row, col, rows, colour, line) => {
    pen.strokeStyle = colour;
    pen.lineWidth = line;
    pen.strokeRect(col * cell - line / 2, row * cell - line / 2, rows * cell + line, rows * cell + line);
  };
  const outlines = () => {
    for (const [from, count] of state.blocks) if (count * cell > 5) frame(from, from, count, css("ink"), cell < 4 ? 1 : 2);
    if (!state.picked) return;
    const [a, b] = state.picked.map((model) => state.place[model]);
    if (a === b) {
      const far = n * cell; // a model: its row and its column
      pen.strokeStyle = css("focus");
      pen.lineWidth = 2;
      pen.strokeRect(-1, a * cell - 1, far + 2, cell + 2);
      pen.strokeRect(a * cell - 1, -1, cell + 2, far + 2);
      return;
    }
    for (const [row, col] of [[a, b], [b, a]]) frame(row, col, 1, css("paper"), 2), frame(row - 3 / cell, col - 3 / cell, 1 + 6 / cell, css("focus"), 3);
  };
  const labels = (r0, r1, c0, c1) => {
    const strong = new Set(state.picked || []);
    for (const spot of [state.hover, document.activeElement === cursor() ? [state.row, state.col] : null]) if (spot) pair(...spot).forEach((m) => strong.add(m));
    const step = Math.max(1, Math.ceil(LABEL / cell)), nice = [1, 2, 5, 10, 20, 50, 100, 200, 500].find((s) => s >= step) || 1000;
    const upright = cell < 26;
    const near = [...strong].map((model) => state.place[model]);
    const shown = (place) => ((place + 1) % nice === 0 || nice === 1) && near.every((other) => Math.abs(other - place) * cell >= LABEL);
    for (const [from, to, across] of [[r0, r1, false], [c0, c1, true]])
      for (const bold of [false, true])
        for (let place = from; place < to; place++) {
          const model = state.order[place];
          if (strong.has(model) !== bold || !(bold || shown(place))) continue;
          const middle = GUTTER + (across ? left : top) + (place + 0.5) * cell;
          if (middle < GUTTER - 1 || middle > (across ? width : height)) continue;
          pen.save();
          if (across) pen.translate(middle, GUTTER - 5), upright && pen.rotate(-Math.PI / 2);
          else pen.translate(GUTTER - 5, middle);
          pen.font = `${bold ? 700 : 400} 11px system-ui, sans-serif`;
          pen.textAlign = across ? (upright ? "left" : "center") : "right";
          pen.textBaseline = across && !upright ? "bottom" : "middle";
          const text = `A${model}`;
          if (bold) {
            const wide = pen.measureText(text).width + 6;
            pen.fillStyle = css("paper");
            if (across && !upright) pen.fillRect(-wide / 2, -13, wide, 14);
            else pen.fillRect(across ? -3 : 3 - wide, -8, wide, 16);
          }
          pen.fillStyle = css(bold ? "ink" : "muted");
          pen.fillText(text, 0, 0);
          pen.restore();
        }
  };

  // ---- the cursor
  const cursor = () => grid.querySelector('[role="gridcell"]');
  const place = () => {
    const element = cursor(), size = Math.max(cell, 9);
    const x = GUTTER + left + (state.col + 0.5) * cell, y = GUTTER + top + (state.row + 0.5) * cell;
    element.style.cssText = `left:${x - size / 2}px;top:${y - size / 2}px;width:${size}px;height:${size}px`;
  };
  const name = (element) => {
    element.setAttribute("aria-label", source.label(...pair(state.row, state.col), view(state.row, state.col)));
    element.setAttribute("aria-colindex", state.col + 1);
    element.parentElement.setAttribute("aria-rowindex", state.row + 1);
  };
  const moveTo = (row, col, { focus = false } = {}) => {
    state.row = row;
    state.col = col;
    const old = cursor(), fresh = old.cloneNode();
    old.replaceWith(fresh); // a new element, so that a screen reader reads its name
    name(fresh);
    reveal(row, col);
    place();
    if (focus) fresh.focus({ preventScroll: true });
    source.onMove(...pair(row, col), view(row, col));
    redraw();
  };
  const open = (row, col) => source.onOpen(...pair(row, col), view(row, col));
  const step = (event) => {
    const { row, col } = state, far = event.ctrlKey || event.metaKey, last = n - 1;
    const inside = (r, c) => [Math.max(0, Math.min(last, r)), Math.max(0, Math.min(last, c))];
    switch (event.key) {
      case "ArrowLeft": return inside(row, col - 1);
      case "ArrowRight": return inside(row, col + 1);
      case "ArrowUp": return inside(row - 1, col);
      case "ArrowDown": return inside(row + 1, col);
      case "PageUp": return inside(row - 10, col);
      case "PageDown": return inside(row + 10, col);
      case "Home": return far ? [0, 0] : [row, 0];
      case "End": return far ? [last, last] : [row, last];
      default: return null;
    }
  };
  grid.addEventListener("keydown", (event) => {
    const next = step(event);
    const centre = () => [left + (state.col + 0.5) * cell, top + (state.row + 0.5) * cell];
    if (next) moveTo(...next, { focus: true });
    else if (event.key === "Enter" || event.key === " ") open(state.row, state.col);
    else if (event.ctrlKey || event.metaKey || event.altKey) return;
    else if (event.key === "+" || event.key === "=") zoomTo(cell * 1.4, ...centre());
    else if (event.key === "-") zoomTo(cell / 1.4, ...centre());
    else if (event.key === "0") fit();
    else return;
    event.preventDefault();
  });
  for (const kind of ["focusin", "focusout"]) grid.addEventListener(kind, redraw);

  // ---- pointer: click opens, drag moves, two fingers or the wheel zoom
  const down = new Map();
  let moved = false;
  const spread = () => {
    const [a, b] = [...down.values()];
    return { size: Math.hypot(a.x - b.x, a.y - b.y), x: (a.x + b.x) / 2, y: (a.y + b.y) / 2 };
  };
  host.addEventListener("pointerdown", (event) => {
    if (event.button) return;
    if (!down.size) moved = false;
    down.set(event.pointerId, at(event));
  });
  host.addEventListener("pointermove", (event) => {
    const here = at(event), before = down.get(event.pointerId);
    if (!before) {
      const changed = String(here.field) !== String(state.hover);
      state.hover = here.field;
      if (!changed) return;
      if (here.field) source.onMove(...pair(...here.field), view(...here.field));
      redraw();
      return;
    }
    if (!moved && Math.hypot(here.x - before.x, here.y - before.y) < 5 && down.size === 1) return;
    moved = true;
    host.setPointerCapture(event.pointerId);
    if (down.size === 2) {
      const old = spread();
      down.set(event.pointerId, here);
      const now = spread();
      left += now.x - old.x;
      top += now.y - old.y;
      zoomTo((cell * now.size) / Math.max(1, old.size), now.x, now.y);
      return;
    }
    left += here.x - before.x;
    top += here.y - before.y;
    down.set(event.pointerId, here);
    clamp();
    redraw();
  });
  host.addEventListener("pointerup", (event) => {
    const before = down.get(event.pointerId);
    down.delete(event.pointerId);
    const { field } = at(event);
    if (!before || moved || !field) return;
    moveTo(...field, { focus: true });
    open(...field);
  });
  host.addEventListener("pointercancel", (event) => down.delete(event.pointerId));
  host.addEventListener("mousedown", (event) => event.preventDefault()); // the cursor keeps the focus
  host.addEventListener("pointerleave", () => {
    state.hover = null;
    redraw();
  });
  host.addEventListener("wheel", (event) => {
    if (!(event.ctrlKey || event.metaKey || host.matches(":focus-within"))) return;
    if (fitted && event.deltaY > 0 && !event.ctrlKey) return; // nothing smaller: the page scrolls on
    event.preventDefault();
    const { x, y } = at(event);
    zoomTo(cell * Math.exp(-Math.max(-120, Math.min(120, event.deltaY)) / 300), x, y);
  }, { passive: false });

  // ---- size
  const resize = () => {
    width = host.clientWidth;
    const most = Math.max(360, Math.min(width, window.innerHeight - 120));
    height = Math.round(Math.min(most, GUTTER + n * FIT_LARGEST + 4));
    host.style.height = `${height}px`;
    const scale = window.devicePixelRatio || 1;
    canvas.width = Math.round(width * scale);
    canvas.height = Math.round(height * scale);
    canvas.style.width = `${width}px`;
    canvas.style.height = `${height}px`;
    if (fitted || cell < fitCell()) {
      cell = fitCell();
      left = top = 0;
      fitted = true;
    }
    clamp();
    draw();
  };
  new ResizeObserver(() => host.clientWidth !== width && resize()).observe(host);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => refresh({ fields: false }));
  const arrange = (order, blocks) => {
    const models = pair(state.row, state.col);
    state.order = order;
    state.blocks = blocks;
    order.forEach((model, at) => (state.place[model] = at));
    [state.row, state.col] = models.map((model) => state.place[model]);
    refresh();
  };
  arrange(source.order, []);
  name(cursor());
  resize();

  return {
    arrange,
    fit,
    zoom: (factor) => zoomTo(cell * factor),
    show: (views) => {
      state.views = views;
      name(cursor());
      refresh();
    },
    filter: (lit) => {
      state.lit = lit;
      refresh();
    },
    pick: (models) => {
      state.picked = models;
      redraw();
    },
    go: (row, col, options) => moveTo(state.place[row], state.place[col], options),
    cursor: () => cursor().getBoundingClientRect(),
  };
};
