// A window on a diagram, chosen by mouse, finger, keys and buttons. A Bode diagram has one in frequency alone.
import { announce, element, svg } from "./dom.js";

const LEAST = 1 / 500; // share of the whole picture
const CLOSER = 0.7, STEP = 0.25; // of the window, for each key or notch of a wheel
const CLICK = 6; // pixels below which a drag is a click
export const WHOLE = { size: 1, x: 0, y: 0 };

const within = ({ size, x, y }) => ({ size, x: clamped(x, 0, 1 - size), y: clamped(y, 0, 1 - size) });
// Smaller by a factor; the place [x, y] of the window stays where it is.
export const zoomed = (view, factor, [x, y] = [0.5, 0.5]) => {
  const size = clamped(view.size * factor, LEAST, 1), gain = view.size - size;
  return within({ size, x: view.x + gain * x, y: view.y + gain * y });
};
export const moved = (view, x, y) => within({ ...view, x: view.x + x * view.size, y: view.y + y * view.size });
// The window around two places of it; both axes keep one scale.
export const around = (view, [x0, y0], [x1, y1], isFlat) => {
  const size = clamped(view.size * Math.max(Math.abs(x1 - x0), isFlat ? 0 : Math.abs(y1 - y0)), LEAST, 1);
  return within({ size, x: view.x + (view.size * (x0 + x1) - size) / 2, y: view.y + (view.size * (y0 + y1) - size) / 2 });
};

// The window after two fingers at [before] went to [after], places of it; `factor`: their distance before by that after.
export const pinched = (view, factor, [x0, y0], [x1, y1]) => zoomed(moved(view, x0 - x1, y0 - y1), factor, [x1, y1]);

// The diagram with its keys and buttons: {root, redraw}. `draw(picture, diagram, view)` returns the box of its axes.
export const zoomable = (picture, diagram, draw) => {
  const isFlat = diagram.kind === "bode", fingers = new Map(), hint = `${picture.id}-hint`;
  let view = WHOLE, box = null, from = null, mark = null;
  const redraw = () => { if (picture.clientWidth) box = draw(picture, diagram, view); };
  const show = (next) => {
    view = next;
    redraw();
    announce(picture.getAttribute("aria-label"));
  };
  const pixel = (event) => { const at = picture.getBoundingClientRect(); return [event.clientX - at.left, event.clientY - at.top]; };
  const place = ([x, y]) => [clamped((x - box[0]) / box[2], 0, 1), clamped(1 - (y - box[1]) / box[3], 0, 1)];
  const keys = {
    "+": () => zoomed(view, CLOSER), "=": () => zoomed(view, CLOSER), "-": () => zoomed(view, 1 / CLOSER),
    ArrowLeft: () => moved(view, -STEP, 0), ArrowRight: () => moved(view, STEP, 0), 0: () => WHOLE, Escape: () => WHOLE,
    ...(isFlat ? {} : { ArrowUp: () => moved(view, 0, STEP), ArrowDown: () => moved(view, 0, -STEP) }),
  };
  const button = (text, label, key) => element("button", { type: "button", class: "plainbutton", "aria-label": label, onclick: () => show(keys[key]()) }, text);
  const frame = element("div", { class: "zoom", tabindex: 0, role: "group", "aria-label": "Diagram", "aria-describedby": hint }, picture);

  frame.addEventListener("keydown", (event) => {
    if (!(event.key in keys) || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    show(keys[event.key]());
  });
  // A page that scrolls must not stop at a diagram: the wheel zooms one that was chosen.
  frame.addEventListener("wheel", (event) => {
    if (!event.ctrlKey && document.activeElement !== frame) return;
    event.preventDefault();
    show(zoomed(view, event.deltaY < 0 ? CLOSER : 1 / CLOSER, place(pixel(event))));
  }, { passive: false });
  picture.addEventListener("dblclick", () => show(WHOLE));
  const dropMark = () => { mark?.remove(); from = mark = null; };
  const two = () => {
    const [a, b] = fingers.values();
    return { middle: [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2], apart: Math.max(Math.hypot(a[0] - b[0], a[1] - b[1]), CLICK) };
  };
  // The browser would scroll or zoom the page instead.
  picture.addEventListener("touchmove", (event) => { if (event.touches.length > 1) event.preventDefault(); }, { passive: false });
  picture.addEventListener("pointerdown", (event) => {
    if (event.button !== 0 || fingers.size > 1) return;
    fingers.set(event.pointerId, pixel(event));
    if (fingers.size > 1) dropMark();
    else from = pixel(event);
    picture.setPointerCapture(event.pointerId);
  });
  picture.addEventListener("pointermove", (event) => {
    if (!fingers.has(event.pointerId)) return;
    const before = fingers.size > 1 ? two() : null, [x, y] = pixel(event);
    fingers.set(event.pointerId, [x, y]);
    if (before) {
      const now = two();
      view = pinched(view, before.apart / now.apart, place(before.middle), place(now.middle));
      redraw();
    } else if (from) {
      const [left, top, width, height] = box;
      mark?.remove();
      mark = svg("rect", { class: "chosen", x: Math.min(x, from[0]), y: isFlat ? top : Math.min(y, from[1]), width: Math.abs(x - from[0]), height: isFlat ? height : Math.abs(y - from[1]) });
      picture.append(mark);
    }
  });
  const end = (event) => {
    if (fingers.size > 1) announce(picture.getAttribute("aria-label"));
    fingers.delete(event.pointerId);
    const begun = from, to = pixel(event);
    dropMark();
    const far = begun && Math.max(Math.abs(to[0] - begun[0]), isFlat ? 0 : Math.abs(to[1] - begun[1])) > CLICK;
    if (far && event.type === "pointerup") show(around(view, place(begun), place(to), isFlat));
  };
  picture.addEventListener("pointerup", end);
  picture.addEventListener("pointercancel", end);

  const buttons = element("p", { class: "zoom-keys" }, button("+", "Zoom in", "+"), button("−", "Zoom out", "-"),
    button("←", "Move left", "ArrowLeft"), button("→", "Move right", "ArrowRight"),
    isFlat ? null : [button("↑", "Move up", "ArrowUp"), button("↓", "Move down", "ArrowDown")], button("Show all", "Show the whole diagram", "0"),
    element("span", { class: "hint", id: hint }, "Drag over a range to zoom in, or pinch; the wheel zooms after a click. Keys: + and −, arrows, 0 for all."));
  return { root: element("div", {}, frame, buttons), redraw };
};
