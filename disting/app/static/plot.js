// Diagrams of a measured response on the axes of the site's pages (axes.js): Bode, or Nyquist of an impedance.
const DB = 20 / Math.LN10, MARGIN = 0.05;
const finite = (values) => values.filter(Number.isFinite);
const spread = (values, least) => { // limits of an axis with a margin
  const low = Math.min(...values), high = Math.max(...values), more = Math.max((high - low) * MARGIN, least);
  return [low - more, high + more];
};
const path = (panel, d, name) => panel.inside.append(shape("path", { d, class: name }));
const at = (panel, x, y) => `${panel.x(x).toFixed(1)} ${panel.y(y).toFixed(1)}`;

const dots = (panel, points) => {
  for (const [x, y] of points) panel.inside.append(shape("circle", { cx: panel.x(x).toFixed(1), cy: panel.y(y).toFixed(1), r: 2, class: "dot" }));
};
const bars = (panel, points, wide, factor) => {
  if (wide) path(panel, points.map(([x, y], i) => `M${at(panel, x, y - factor * wide[i])}L${at(panel, x, y + factor * wide[i])}`).join(""), "bars");
};

const drawBode = (svg, diagram) => {
  const { width, height, letter } = sized(svg), { frequency, wide } = diagram;
  const gain = diagram.gain.map((x) => DB * Math.log(x)), left = 4 * letter, right = width - left - 1.2 * letter;
  const x = [frequency[0] / 1.02, frequency.at(-1) * 1.02], xTicks = roundSteps(...x);
  const upper = [left, 1.6 * letter, right, 0.56 * height - 2 * letter], lower = [left, 0.56 * height + 1.6 * letter, right, 0.44 * height - 4.6 * letter];
  const sparse = xTicks.length > 8 ? xTicks.filter((v) => /^1(0*|e.*)$/.test(String(v)) || /^0\.0*1$/.test(String(v))) : xTicks;
  for (const [box, values, factor, title, least, xTitle] of [
    [upper, gain, DB, `Amplitude [dB${diagram.unit ? ` re ${diagram.unit}` : ""}]`, 1, ""],
    [lower, diagram.phase, 180 / Math.PI, "Phase [°]", 5, "Frequency [Hz]"],
  ]) {
    const shown = finite(values), y = spread(shown, least);
    const panel = panelIn(svg, box, { x, y, log: true, xTicks: sparse, yTicks: steps(...y, 5), xTitle, yTitle: title }, letter);
    const points = frequency.map((f, i) => [f, values[i]]).filter(([, v]) => Number.isFinite(v));
    bars(panel, points, points.length === frequency.length ? wide : null, factor);
    dots(panel, points);
  }
};

const drawNyquist = (svg, diagram) => {
  const { width, height, letter } = sized(svg), points = diagram.re.map((re, i) => [re, -diagram.im[i]]);
  const box = [4.5 * letter, 1.6 * letter, width - 6 * letter, height - 5 * letter];
  const [x0, x1] = spread(points.map(([re]) => re), 1e-12), [y0, y1] = spread(points.map(([, im]) => im), 1e-12);
  const scale = Math.max((x1 - x0) / box[2], (y1 - y0) / box[3]); // one scale on both axes
  const wider = (low, high, length) => [(low + high - scale * length) / 2, (low + high + scale * length) / 2];
  const x = wider(x0, x1, box[2]), y = wider(y0, y1, box[3]);
  const panel = panelIn(svg, box, { x, y, xTicks: steps(...x, 5), yTicks: steps(...y, 5), xTitle: "Re Z [Ω]", yTitle: "−Im Z [Ω]" }, letter);
  if (diagram.wide) {
    const half = points.map(([re, im], i) => diagram.wide[i] * Math.hypot(re, im));
    bars(panel, points, half, 1);
    path(panel, points.map(([re, im], i) => `M${at(panel, re - half[i], im)}L${at(panel, re + half[i], im)}`).join(""), "bars");
  }
  dots(panel, points);
};

// Draw into an SVG element, which is shown: its size is that of the picture.
export const draw = (svg, diagram) => {
  const isBode = diagram.kind === "bode", { frequency } = diagram;
  const uncertain = diagram.wide ? ", bars of 95 %" : "";
  svg.setAttribute("aria-label", `${isBode ? "Bode" : "Nyquist"} diagram of ${diagram.lines} lines from ${short(frequency[0])} to ${short(frequency.at(-1))} Hz${uncertain}`);
  (isBode ? drawBode : drawNyquist)(svg, diagram);
};
