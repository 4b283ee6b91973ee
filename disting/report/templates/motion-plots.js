// Curves on axes, as SVG in the colours and the letters of the page.
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
const largest = (values) => values.reduce((most, x) => Math.max(most, Math.abs(x)), 0);
// What the first does is seen whole; a second that does far more is cut off.
const spread = ([one, two]) => {
  const size = 1.08 * Math.min(Math.max(largest(one), largest(two)), 2 * largest(one)) || 1;
  return [-size, size];
};

// The force above, what is seen of both machines below, drawn up to now.
const plotRun = (svg, { force, curves, duration, title }) => {
  const { width, height, letter } = sized(svg), left = 4.2 * letter, right = width - left - 0.8 * letter, foot = height - 2.8 * letter, head = 1.4 * letter;
  const first = 0.18 * (foot - 2 * head), y = spread(curves), every = Math.ceil(force.length / 4000);
  const points = (values) => Array.from({ length: Math.floor((values.length - 1) / every) + 1 }, (_, i) => [(i * every * duration) / (values.length - 1), values[i * every]]);
  const above = panelIn(svg, [left, head, right, first], { x: [0, duration], y: [-1.5 * FORCE, 1.5 * FORCE], yTicks: [0], yTitle: "force" }, letter);
  const below = panelIn(svg, [left, first + 2 * head, right, foot - first - 2 * head], { x: [0, duration], y, xTicks: steps(0, duration, 10), yTicks: steps(...y, 4), xTitle: "time in s", yTitle: title }, letter);
  above.line(points(force), "curve force-line");
  curves.forEach((curve, which) => below.line(points(curve), `curve ${["one", "two"][which]}`));
  const now = shape("path", { class: "now" });
  const dots = curves.map((_, which) => shape("circle", { r: 0.32 * letter, class: `dot ${["one", "two"][which]}` }));
  svg.append(now, ...dots);
  return (t, at) => {
    [above, below].forEach((panel) => panel.reveal(t));
    now.setAttribute("d", `M${below.x(t)} ${head}V${foot}`);
    dots.forEach((dot, which) => (dot.setAttribute("cx", below.x(t)), dot.setAttribute("cy", below.y(curves[which][at]))));
  };
};

// Bode diagrams of both, and where they part most; `bodes` are [dB, degrees] at the lines [rad/s].
const plotBode = (svg, { lines, bodes, most, title }) => {
  const { width, height, letter } = sized(svg), left = 4.2 * letter, right = width - left - 0.8 * letter, foot = height - 2.8 * letter, head = 1.4 * letter;
  const hertz = lines.map((omega) => omega / (2 * Math.PI)), x = [hertz[0], hertz[hertz.length - 1]], first = 0.63 * (foot - 2 * head);
  const sorted = bodes.flatMap(([gain]) => gain).sort((a, b) => a - b), at = (share) => sorted[Math.round(share * (sorted.length - 1))];
  const y = [Math.max(sorted[0], at(0.02) - 12) - 4, Math.min(sorted[sorted.length - 1], at(0.98) + 12) + 8];
  const phases = bodes.flatMap(([, phase]) => phase), turns = [Math.min(-180, ...phases) - 25, Math.max(0, ...phases) + 45];
  const ticks = { x, log: true, xTicks: roundSteps(...x) };
  const above = panelIn(svg, [left, head, right, first], { ...ticks, y, yTicks: steps(...y, 5), yTitle: title }, letter);
  const grid = [-540, -360, -180, 0, 180, 360, 540].filter((v) => v > turns[0] && v < turns[1]);
  const below = panelIn(svg, [left, first + 2 * head, right, foot - first - 2 * head], { ...ticks, y: turns, yTicks: grid, xTitle: "frequency in Hz", yTitle: "phase in degrees" }, letter);
  bodes.forEach(([gain, phase], which) => {
    const name = `curve ${["one", "two"][which]}`;
    above.line(gain.map((v, i) => [hertz[i], v]), name);
    below.line(phase.map((v, i) => [hertz[i], v]), name);
  });
  if (most) {
    const f = above.x(most.omega / (2 * Math.PI)), late = f > left + right / 2;
    const label = shape("text", { x: f + (late ? -0.5 : 0.5) * letter, y: head + first - 0.7 * letter, "text-anchor": late ? "end" : "start", class: "most" }, `${short(Math.abs(most.decibels))} dB apart`);
    svg.append(shape("path", { d: `M${f} ${head}V${foot}`, class: "most" }), label);
  }
  const now = shape("path", { class: "now" });
  svg.append(now);
  return (frequency) => now.setAttribute("d", frequency >= x[0] && frequency <= x[1] ? `M${above.x(frequency)} ${head}V${foot}` : "");
};
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
