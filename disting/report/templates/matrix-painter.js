// Draws what is visible: the fields from a picture of their level, then lines, marks and signs where they are large enough,
// frames and names. Colours come from the style sheet, so that light and dark follow it.
const createPainter = (canvas, v, state, fields, source) => {
  const LINES_FROM = 5, MARKS_FROM = 7, SIGNS_FROM = 14, RELATIONS = ["distinguishable", "indistinguishable", "sometimes", "undecided", "limit", "open"]; // the last two of different sizes
  const pen = canvas.getContext("2d");
  const css = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
  const labels = createLabels(pen, v, state, source, css);
  let images = [], colours = null;
  const rgb = (colour) => {
    pen.fillStyle = colour;
    return [1, 3, 5].map((i) => parseInt(pen.fillStyle.slice(i, i + 2), 16));
  };
  const palette = () => {
    const paper = rgb(css("paper"));
    const dim = (colour) => colour.map((value, i) => Math.round(paper[i] + (value - paper[i]) * 0.16));
    const full = RELATIONS.map((name) => rgb(css(name)));
    return [rgb(css("body")), ...full.map(dim), ...full];
  };
  const image = (k) => {
    if (images[k]) return images[k];
    const { size, keys } = fields.level(k);
    const found = document.createElement("canvas");
    found.width = found.height = size;
    const context = found.getContext("2d"), pixels = context.createImageData(size, size);
    const words = new Uint32Array(pixels.data.buffer);
    const packed = colours.map(([r, g, b]) => ((255 << 24) | (b << 16) | (g << 8) | r) >>> 0);
    for (let i = 0; i < words.length; i++) words[i] = packed[keys[i]];
    context.putImageData(pixels, 0, 0);
    return (images[k] = found);
  };
  const inside = (edge, act) => { // with the plot's corner as origin, cut off at its edge
    const [w, h] = v.room();
    pen.save();
    pen.beginPath();
    pen.rect(v.gutter - edge, v.gutter - edge, w + edge, h + edge);
    pen.clip();
    pen.translate(v.gutter + v.left, v.gutter + v.top);
    act();
    pen.restore();
  };
  const picture = ([r0, r1, c0, c1], scale) => {
    const k = Math.max(0, Math.ceil(Math.log2(1 / (v.cell * scale)))), f = 2 ** k;
    const [sx, sy] = [Math.floor(c0 / f), Math.floor(r0 / f)], [sw, sh] = [Math.ceil(c1 / f) - sx, Math.ceil(r1 / f) - sy];
    pen.imageSmoothingEnabled = false;
    pen.drawImage(image(k), sx, sy, sw, sh, ...[sx, sy, sw, sh].map((at) => at * f * v.cell));
  };
  const lines = ([r0, r1, c0, c1]) => {
    const { cell } = v;
    pen.fillStyle = css("paper");
    pen.globalAlpha = cell < 12 ? 0.35 : 1;
    for (let row = r0; row <= r1; row++) pen.fillRect(c0 * cell, row * cell - 0.5, (c1 - c0) * cell, 1);
    for (let col = c0; col <= c1; col++) pen.fillRect(col * cell - 0.5, r0 * cell, 1, (r1 - r0) * cell);
    pen.globalAlpha = 1;
  };
  const marks = (shown) => {
    const ink = RELATIONS.map((name) => css(`on-${name}`) || css("paper"));
    const leg = v.cell * 0.3, far = v.cell - 1;
    fields.visit(...shown, (row, col, code, lit) => {
      if (!code || !lit) return;
      const x = col * v.cell + 0.5, y = row * v.cell + 0.5;
      pen.beginPath();
      if (code === 1) pen.moveTo(x + far - leg, y), pen.lineTo(x + far, y), pen.lineTo(x + far, y + leg);
      if (code === 2) pen.moveTo(x, y + far - leg), pen.lineTo(x, y + far), pen.lineTo(x + leg, y + far);
      if (code === 3) pen.moveTo(x, y), pen.lineTo(x + leg, y), pen.lineTo(x + far, y + far - leg), pen.lineTo(x + far, y + far), pen.lineTo(x + far - leg, y + far), pen.lineTo(x, y + leg);
      pen.fillStyle = ink[code];
      pen.fill();
    });
  };
  const signs = (shown) => {
    const ink = RELATIONS.map((name) => css(`on-${name}`) || css("ink"));
    pen.textAlign = "center";
    pen.textBaseline = "middle";
    pen.font = `600 ${v.cell * 0.56}px system-ui, sans-serif`;
    fields.visit(...shown, (row, col, code, lit) => {
      if (code === 3 || !lit) return;
      pen.fillStyle = ink[code];
      pen.fillText(source.sign(state.order[row], state.order[col], state.views[row > col ? 0 : 1]), (col + 0.5) * v.cell, (row + 0.53) * v.cell);
    });
  };
  const frame = (row, col, rows, cols, colour, line) => {
    pen.strokeStyle = colour;
    pen.lineWidth = line;
    pen.strokeRect(col * v.cell - line / 2, row * v.cell - line / 2, cols * v.cell + line, rows * v.cell + line);
  };
  const outlines = () => {
    const across = state.order.length * v.cell;
    pen.fillStyle = css("ink");
    for (const cut of state.cuts) pen.fillRect(0, cut * v.cell - 1, across, 2), pen.fillRect(cut * v.cell - 1, 0, 2, across);
    for (const [from, count] of state.blocks) if (count * v.cell > 5) frame(from, from, count, count, css("ink"), v.cell < 4 ? 1 : 2);
    const places = (state.picked || []).map((model) => state.place[model]);
    if (places.includes(undefined)) return;
    const n = state.order.length, low = Math.min(...places), margin = 3 / v.cell;
    if (places.length === 1) { // a model: its row and its column
      frame(low, 0, 1, n, css("focus"), 2);
      frame(0, low, n, 1, css("focus"), 2);
    } else if (places.length === 2) {
      for (const [row, col] of [places, [...places].reverse()]) {
        frame(row, col, 1, 1, css("paper"), 2);
        frame(row - margin, col - margin, 1 + 2 * margin, 1 + 2 * margin, css("focus"), 3);
      }
    } else if (places.length && Math.max(...places) - low + 1 === places.length) frame(low, low, places.length, places.length, css("focus"), 3);
  };
  return {
    gutter: labels.gutter,
    recolour: () => (colours = null),
    forget: () => (images = []),
    size: () => {
      const scale = window.devicePixelRatio || 1;
      canvas.width = Math.round(v.width * scale);
      canvas.height = Math.round(v.height * scale);
      canvas.style.width = `${v.width}px`;
      canvas.style.height = `${v.height}px`;
    },
    draw: (strong) => {
      const scale = window.devicePixelRatio || 1, shown = v.visible();
      colours ??= palette();
      pen.setTransform(scale, 0, 0, scale, 0, 0);
      pen.fillStyle = css("paper");
      pen.fillRect(0, 0, v.width, v.height);
      inside(0, () => {
        picture(shown, scale);
        if (v.cell >= LINES_FROM) lines(shown);
        if (v.cell >= MARKS_FROM) marks(shown);
        if (v.cell >= SIGNS_FROM) signs(shown);
      });
      inside(6, outlines); // frames of the first row and column reach a little over the edge
      labels.draw(shown, strong);
    },
  };
};
