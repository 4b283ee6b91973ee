// Curves on axes, as SVG in the colours and the letters of the page.
const clamped = (x, low, high) => Math.min(Math.max(x, low), high);
const shape = (name, attributes, text) => {
  const found = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) found.setAttribute(key, value);
  if (text !== undefined) found.textContent = text;
  return found;
};
const steps = (low, high, count) => { // round numbers between two
  const rough = (high - low) / count, ten = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((x) => x * ten).find((x) => x >= rough);
  return Array.from({ length: Math.floor(high / step + 1e-9) - Math.ceil(low / step - 1e-9) + 1 }, (_, i) => (Math.ceil(low / step - 1e-9) + i) * step);
};
const roundSteps = (low, high) => [-3, -2, -1, 0, 1, 2, 3, 4].flatMap((ten) => [1, 2, 5].map((x) => x * 10 ** ten)).filter((x) => x >= low * 0.999 && x <= high * 1.001);
const roundDown = (x) => [5, 2, 1].map((f) => f * 10 ** Math.floor(Math.log10(x))).find((f) => f <= x * 1.0001);
const written = (x) => (x === 0 ? "0" : Math.abs(x) < 1e-3 || Math.abs(x) >= 1e5 ? x.toExponential(2) : String(+x.toPrecision(4))).replace("-", "−");
const short = (x) => (Math.abs(x) >= 0.001 ? written(+x.toPrecision(3)) : written(+x.toPrecision(1)));
// One panel of a plot: `box` is [left, top, width, height]; x and y map numbers to its units.
const panelIn = (svg, box, { x: [x0, x1], y: [y0, y1], log = false, xTicks = [], yTicks = [], xTitle = "", yTitle = "" }, letter) => {
  const [left, top, width, height] = box;
  const share = log ? (v) => Math.log(v / x0) / Math.log(x1 / x0) : (v) => (v - x0) / (x1 - x0);
  const x = (v) => left + width * share(v), y = (v) => top + height * (1 - (v - y0) / (y1 - y0));
  const group = shape("g", { class: "axes" }), bottom = top + height;
  group.append(shape("rect", { x: left, y: top, width, height, class: "frame" }));
  for (const v of xTicks) {
    group.append(shape("path", { d: `M${x(v)} ${top}V${bottom}`, class: "grid" }));
    if (xTitle) group.append(shape("text", { x: x(v), y: bottom + 1.15 * letter, "text-anchor": "middle" }, written(v)));
  }
  for (const v of yTicks) group.append(shape("path", { d: `M${left} ${y(v)}H${left + width}`, class: "grid" }), shape("text", { x: left - 0.4 * letter, y: y(v) + 0.35 * letter, "text-anchor": "end" }, written(v)));
  if (xTitle) group.append(shape("text", { x: left + width / 2, y: bottom + 2.3 * letter, "text-anchor": "middle" }, xTitle));
  group.append(shape("text", { x: left, y: top - 0.35 * letter, class: "name" }, yTitle));
  svg.append(group);
  const clip = `clip-${svg.id}-${svg.querySelectorAll("clipPath").length}`, window = shape("clipPath", { id: clip });
  const opening = shape("rect", { x: left, y: top, width, height });
  window.append(opening);
  const inside = shape("g", { "clip-path": `url(#${clip})` });
  svg.append(window, inside);
  return {
    x, y, inside,
    reveal: (v) => opening.setAttribute("width", Math.max(x(v) - left, 0)),
    line: (points, name) => {
      let d = "";
      for (const [a, b] of points) d += `${d ? "L" : "M"}${x(a).toFixed(1)} ${clamped(y(b), top - 999, bottom + 999).toFixed(1)}`;
      inside.append(shape("path", { d, class: name }));
    },
  };
};
const sized = (svg) => {
  const { width, height } = svg.getBoundingClientRect(), letter = parseFloat(getComputedStyle(svg).fontSize);
  svg.setAttribute("viewBox", `0 0 ${width || 1} ${height || 1}`);
  svg.replaceChildren();
  return { width: Math.max(width, 160), height: Math.max(height, 160), letter };
};
// Bode diagram of a chain: [dB, degrees] at the lines [rad/s].
const bodeOf = (chain, parts, lines) => {
  const solver = createSolver(chain), gain = [], phase = [];
  for (const omega of lines) {
    const [re, im] = solver.response(parts, 0, omega), angle = (Math.atan2(im, re) * 180) / Math.PI, before = phase[phase.length - 1];
    gain.push((20 * Math.log(Math.hypot(re, im))) / Math.LN10);
    if (!chain.damped) phase.push(re < 0 ? -180 : 0);
    else phase.push(before === undefined ? angle : angle + 360 * Math.round((before - angle) / 360));
  }
  return [gain, phase];
};
