// Where the fields are on the canvas: field (row, col) begins at left + col * cell, top + row * cell of the plot, which
// lies right of and below a gutter for the names.
const createViewport = (count) => {
  const LARGEST = 48, FIT_LARGEST = 44;
  const v = { width: 0, height: 0, gutter: 0, cell: 10, left: 0, top: 0, fitted: true };
  v.room = () => [v.width - v.gutter, v.height - v.gutter];
  v.fitCell = () => Math.min(FIT_LARGEST, Math.min(...v.room()) / count());
  v.clamp = () => {
    const [w, h] = v.room();
    v.left = Math.min(0, Math.max(v.left, w - count() * v.cell));
    v.top = Math.min(0, Math.max(v.top, h - count() * v.cell));
  };
  v.moveBy = (x, y) => {
    v.left += x;
    v.top += y;
    v.clamp();
  };
  v.zoomTo = (size, x = v.room()[0] / 2, y = v.room()[1] / 2) => {
    const smallest = v.fitCell();
    const next = Math.max(smallest, Math.min(Math.max(LARGEST, smallest), size));
    v.left = x - ((x - v.left) * next) / v.cell;
    v.top = y - ((y - v.top) * next) / v.cell;
    v.cell = next;
    v.fitted = v.cell <= smallest * 1.001;
    v.clamp();
  };
  v.fit = () => {
    v.cell = v.fitCell();
    v.left = v.top = 0;
    v.fitted = true;
    v.clamp();
  };
  v.span = (from, size) => { // some neighbouring models, as large as they can be
    v.zoomTo((0.9 * Math.min(...v.room())) / size, 0, 0);
    const middle = (length) => length / 2 - (from + size / 2) * v.cell;
    [v.left, v.top] = v.room().map(middle);
    v.clamp();
  };
  v.resize = (width, most, gutter) => {
    Object.assign(v, { width, gutter, height: Math.round(Math.min(most, gutter + count() * FIT_LARGEST + 4)) });
    if (v.fitted || v.cell < v.fitCell()) v.fit();
    v.clamp();
  };
  v.at = (x, y) => { // a point of the canvas: as seen from the plot, and the field there
    const [px, py] = [x - v.gutter, y - v.gutter];
    const row = Math.floor((py - v.top) / v.cell), col = Math.floor((px - v.left) / v.cell);
    const inside = px >= 0 && py >= 0 && row >= 0 && col >= 0 && row < count() && col < count();
    return { x: px, y: py, field: inside ? [row, col] : null };
  };
  v.reveal = (row, col) => {
    const [w, h] = v.room(), edge = Math.min(v.cell, w / 4);
    v.left = Math.min(Math.max(v.left, edge - (col + 1) * v.cell), w - edge - col * v.cell - edge);
    v.top = Math.min(Math.max(v.top, edge - (row + 1) * v.cell), h - edge - row * v.cell - edge);
    v.clamp();
  };
  v.visible = () => {
    const [w, h] = v.room(), span = (from, length) => [Math.max(0, Math.floor(-from / v.cell)), Math.min(count(), Math.ceil((length - from) / v.cell))];
    return [...span(v.top, h), ...span(v.left, w)];
  };
  return v;
};
