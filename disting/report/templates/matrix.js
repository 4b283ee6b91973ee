"use strict";
{% include "matrix-fields.js" %}
{% include "matrix-viewport.js" %}
{% include "matrix-labels.js" %}
{% include "matrix-painter.js" %}
{% include "matrix-input.js" %}
// A square of fields on a canvas: one view below the diagonal, another above it; `source` tells what they show:
//   order, blocks   the models, as `arrange` takes them    name(i)          a model's name
//   views           below and above the diagonal           relation(view)   function of two models: place in RELATIONS
//   sign, label     (i, j, view): in a field, in words     onMove, onOpen   (i, j, view)
// One element, the cursor, is the field for assistive technology: a cell of a grid, made anew wherever the focus moves.
const createMatrix = (host, source) => {
  const grid = host.querySelector('[role="grid"]');
  const state = { order: [], place: [], blocks: [], cuts: [], views: source.views, lit: () => true, picked: null };
  const v = createViewport(() => state.order.length);
  const fields = createFields(state, source);
  const painter = createPainter(host.querySelector("canvas"), v, state, fields, source);
  let row = 1, col = 0, hovered = null, waiting = 0;

  const of = (r, c) => [state.order[r], state.order[c], state.views[r > c ? 0 : 1]];
  const cursor = () => grid.querySelector('[role="gridcell"]');
  const place = () => {
    const size = Math.max(v.cell, 9), x = v.gutter + v.left + (col + 0.5) * v.cell, y = v.gutter + v.top + (row + 0.5) * v.cell;
    cursor().style.cssText = `left:${x - size / 2}px;top:${y - size / 2}px;width:${size}px;height:${size}px`;
  };
  const name = () => {
    cursor().setAttribute("aria-label", source.label(...of(row, col)));
    cursor().setAttribute("aria-colindex", col + 1);
    cursor().parentElement.setAttribute("aria-rowindex", row + 1);
  };
  const draw = () => {
    waiting = 0;
    if (!v.width) return;
    const spots = [hovered, document.activeElement === cursor() ? [row, col] : null].filter(Boolean);
    const strong = new Set([...(state.picked?.length < 3 ? state.picked : []), ...spots.flatMap((spot) => of(...spot).slice(0, 2))]);
    painter.draw([...strong].filter((model) => model in state.place));
    place();
    Object.assign(host.dataset, { cell: v.cell.toFixed(3), gutter: v.gutter, left: v.left, top: v.top });
    host.style.touchAction = v.fitted ? "pan-y" : "none";
  };
  const redraw = () => (waiting ||= requestAnimationFrame(draw));
  const refresh = () => {
    fields.reset();
    painter.forget();
    redraw();
  };
  const moveTo = (r, c, { focus = false } = {}) => {
    [row, col] = [r, c];
    const old = cursor(), fresh = old.cloneNode();
    old.replaceWith(fresh); // a new element, so that a screen reader reads its name
    name();
    v.reveal(row, col);
    place();
    if (focus) fresh.focus({ preventScroll: true });
    source.onMove(...of(row, col));
    redraw();
  };
  const open = (r, c) => source.onOpen(...of(r, c));
  const hover = (field) => {
    if (String(field) === String(hovered)) return;
    hovered = field;
    if (field) source.onMove(...of(...field));
    redraw();
  };
  listenToKeys(grid, v, { field: () => [row, col], last: () => state.order.length - 1, moveTo, open, changed: redraw });
  listenToPointers(host, v, { moveTo, open, hover, changed: redraw });
  for (const kind of ["focusin", "focusout"]) grid.addEventListener(kind, redraw);

  const resize = () => {
    v.width = host.clientWidth;
    v.resize(v.width, Math.max(360, Math.min(v.width, window.innerHeight - 120)), painter.gutter());
    host.style.height = `${v.height}px`;
    painter.size();
    draw();
  };
  new ResizeObserver(() => host.clientWidth !== v.width && resize()).observe(host);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
    painter.recolour();
    painter.forget();
    redraw();
  });
  // the models in order, all or some of them, at least two; blocks are runs of them in frames: [from, count, name or nothing];
  // before the cuts a line crosses the whole square
  const arrange = (order, blocks, cuts = []) => {
    const [r, c] = of(row, col), other = state.order.length !== order.length;
    Object.assign(state, { order, blocks, cuts, place: [] });
    order.forEach((model, at) => (state.place[model] = at));
    [row, col] = r in state.place && c in state.place ? [state.place[r], state.place[c]] : [1, 0];
    for (const attribute of ["aria-rowcount", "aria-colcount"]) grid.setAttribute(attribute, order.length);
    hovered = null;
    name();
    refresh();
    if (!other) return;
    v.fitted = true;
    resize();
  };
  arrange(source.order, source.blocks || []);

  const then = (act) => (...values) => (act(...values), redraw());
  return {
    arrange,
    fit: then(v.fit),
    zoom: then((factor) => v.zoomTo(v.cell * factor)),
    span: then(v.span),
    show: (views) => {
      state.views = views;
      name();
      refresh();
    },
    filter: (lit) => {
      state.lit = lit;
      refresh();
    },
    pick: then((models) => (state.picked = models)),
    has: (model) => model in state.place,
    go: (one, other, options) => moveTo(state.place[one], state.place[other], options),
    cursor: () => cursor().getBoundingClientRect(),
  };
};
