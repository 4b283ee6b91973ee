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

// The part of an axis that a window shows.
const part = ([low, high], begin, size) => [low + (high - low) * begin, low + (high - low) * (begin + size)];
const logPart = ([low, high], begin, size) => part([Math.log(low), Math.log(high)], begin, size).map(Math.exp);

const drawBode = (svg, diagram, view) => {
  const { width, height, letter } = sized(svg), { frequency, wide } = diagram;
  const gain = diagram.gain.map((x) => DB * Math.log(x)), left = 4 * letter, right = width - left - 1.2 * letter;
  const x = logPart([frequency[0] / 1.02, frequency.at(-1) * 1.02], view.x, view.size);
  const decades = roundSteps(...x), xTicks = decades.length < 3 ? steps(...x, 5) : decades;
  const upper = [left, 1.6 * letter, right, 0.56 * height - 2 * letter], lower = [left, 0.56 * height + 1.6 * letter, right, 0.44 * height - 4.6 * letter];
  const sparse = xTicks.length > 8 ? xTicks.filter((v) => /^1(0*|e.*)$/.test(String(v)) || /^0\.0*1$/.test(String(v))) : xTicks;
  const isSeen = (f) => f >= x[0] && f <= x[1], seen = frequency.some(isSeen) ? isSeen : () => true;
  for (const [box, values, factor, title, least, xTitle] of [
    [upper, gain, DB, `Amplitude [dB${diagram.unit ? ` re ${diagram.unit}` : ""}]`, 1, ""],
    [lower, diagram.phase, 180 / Math.PI, "Phase [°]", 5, "Frequency [Hz]"],
  ]) {
    const y = spread(finite(values.filter((_, i) => seen(frequency[i]))), least);
    const panel = panelIn(svg, box, { x, y, log: true, xTicks: sparse, yTicks: steps(...y, 5), xTitle, yTitle: title }, letter);
    const points = frequency.map((f, i) => [f, values[i]]).filter(([, v]) => Number.isFinite(v));
    bars(panel, points, points.length === frequency.length ? wide : null, factor);
    dots(panel, points);
  }
  return { box: [left, upper[1], right, lower[1] + lower[3] - upper[1]], shown: `${short(x[0])} to ${short(x[1])} Hz` };
};

const drawNyquist = (svg, diagram, view) => {
  const { width, height, letter } = sized(svg), points = diagram.re.map((re, i) => [re, -diagram.im[i]]);
  const box = [4.5 * letter, 1.6 * letter, width - 6 * letter, height - 5 * letter];
  const [x0, x1] = spread(points.map(([re]) => re), 1e-12), [y0, y1] = spread(points.map(([, im]) => im), 1e-12);
  const scale = Math.max((x1 - x0) / box[2], (y1 - y0) / box[3]); // one scale on both axes
  const wider = (low, high, length) => [(low + high - scale * length) / 2, (low + high + scale * length) / 2];
  const x = part(wider(x0, x1, box[2]), view.x, view.size), y = part(wider(y0, y1, box[3]), view.y, view.size);
  const panel = panelIn(svg, box, { x, y, xTicks: steps(...x, 5), yTicks: steps(...y, 5), xTitle: "Re Z [Ω]", yTitle: "−Im Z [Ω]" }, letter);
  if (diagram.wide) {
    const half = points.map(([re, im], i) => diagram.wide[i] * Math.hypot(re, im));
    bars(panel, points, half, 1);
    path(panel, points.map(([re, im], i) => `M${at(panel, re - half[i], im)}L${at(panel, re + half[i], im)}`).join(""), "bars");
  }
  dots(panel, points);
  return { box, shown: `Re Z ${short(x[0])} to ${short(x[1])} Ω` };
};

// Draw a window of a diagram into an SVG element, which is shown: its size is that of the picture. Returns the box of the axes.
export const draw = (svg, diagram, view) => {
  const isBode = diagram.kind === "bode", { frequency } = diagram;
  const uncertain = diagram.wide ? ", bars of 95 %" : "";
  const { box, shown } = (isBode ? drawBode : drawNyquist)(svg, diagram, view);
  const closer = view.size < 1 ? `; shown: ${shown}` : "";
  svg.setAttribute("aria-label", `${isBode ? "Bode" : "Nyquist"} diagram of ${diagram.lines} lines from ${short(frequency[0])} to ${short(frequency.at(-1))} Hz${uncertain}${closer}`);
  return box;
};
