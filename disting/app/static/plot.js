// Diagrams of responses on the axes of the site's pages (axes.js): Bode, or Nyquist of an impedance. A diagram holds the
// lines of one measurement, or those of several (`measured`) with the curves of structures (`curves`).
const DB = 20 / Math.LN10, DEGREES = 180 / Math.PI, MARGIN = 0.05;
const spread = (values, least) => { // limits of an axis with a margin
  let low = Infinity, high = -Infinity;
  for (const value of values) if (Number.isFinite(value)) { low = Math.min(low, value); high = Math.max(high, value); }
  const more = Math.max((high - low) * MARGIN, least);
  return low <= high ? [low - more, high + more] : [-least, least];
};
const path = (panel, d, name) => panel.inside.append(shape("path", { d, class: name }));
const at = (panel, x, y) => `${panel.x(x).toFixed(1)} ${panel.y(y).toFixed(1)}`;
const joined = (panel, points) => points.map(([x, y]) => at(panel, x, y)).join("L");

// Marks of one measurement; those of the second are crosses.
const marks = (panel, points, name) => {
  for (const [x, y] of points) {
    const [cx, cy] = at(panel, x, y).split(" ");
    panel.inside.append(name === "two" ? shape("path", { d: `M${cx - 2.5} ${cy - 2.5}l5 5m0 -5l-5 5`, class: "dot two" }) : shape("circle", { cx, cy, r: 2, class: "dot" }));
  }
};
const bars = (panel, points, half) => path(panel, points.map(([x, y], i) => `M${at(panel, x, y - half[i])}L${at(panel, x, y + half[i])}`).join(""), "bars");
const NAMES = ["one", "two"], CURVES = ["first", "second", "third", "fourth"];

const measuredOf = (diagram) => diagram.measured ?? [diagram];
const curvesOf = (diagram) => (diagram.curves ?? []).map((curve, i) => ({ ...curve, style: `curve ${CURVES[i]}` })).filter(({ name }) => !diagram.hidden?.has(name));

// The part of an axis that a window shows.
const part = ([low, high], begin, size) => [low + (high - low) * begin, low + (high - low) * (begin + size)];
const logPart = ([low, high], begin, size) => part([Math.log(low), Math.log(high)], begin, size).map(Math.exp);

// Values of a line in a window of frequency; at its edges those on the straight line between two points.
const valuesIn = (points, [low, high]) => {
  const values = points.filter(([f]) => f >= low && f <= high).map(([, v]) => v);
  for (const edge of [low, high]) {
    const i = points.findIndex(([f]) => f > edge);
    if (i > 0) values.push(points[i - 1][1] + ((points[i][1] - points[i - 1][1]) * Math.log(edge / points[i - 1][0])) / Math.log(points[i][0] / points[i - 1][0]));
  }
  return values;
};

const drawBode = (svg, diagram, view) => {
  const { width, height, letter } = sized(svg), left = 4 * letter, right = width - left - 1.8 * letter;
  const measured = measuredOf(diagram), curves = curvesOf(diagram);
  const ends = [Math.min(...measured.map(({ frequency }) => frequency[0])), Math.max(...measured.map(({ frequency }) => frequency.at(-1)))];
  const x = logPart([ends[0] / 1.02, ends[1] * 1.02], view.x, view.size);
  const decades = roundSteps(...x), xTicks = decades.length < 3 ? steps(...x, 5) : decades;
  const upper = [left, 1.6 * letter, right, 0.56 * height - 2 * letter], lower = [left, 0.56 * height + 1.6 * letter, right, 0.44 * height - 4.6 * letter];
  const sparse = xTicks.length > 8 ? xTicks.filter((v) => /^1(0*|e.*)$/.test(String(v)) || /^0\.0*1$/.test(String(v))) : xTicks;
  for (const [box, valueOf, factor, band, title, least, xTitle] of [
    [upper, ({ gain }, i) => DB * Math.log(gain[i]), DB, "wide", `Amplitude [dB${diagram.unit ? ` re ${diagram.unit}` : ""}]`, 1, ""],
    [lower, ({ phase }, i) => phase[i], DEGREES, "wide_phase", "Phase [°]", 5, "Frequency [Hz]"],
  ]) {
    const pointsOf = (line) => line.frequency.map((f, i) => [f, valueOf(line, i), i]).filter(([, v]) => Number.isFinite(v));
    const y = spread([...measured, ...curves].flatMap((line) => valuesIn(pointsOf(line), x)), least);
    const panel = panelIn(svg, box, { x, y, log: true, xTicks: sparse, yTicks: steps(...y, 5), xTitle, yTitle: title }, letter);
    for (const curve of curves.filter((one) => one[band])) {
      const edge = (sign) => pointsOf(curve).map(([f, v, i]) => [f, v + sign * factor * curve[band][i]]);
      path(panel, `M${joined(panel, [...edge(1), ...edge(-1).reverse()])}Z`, "band");
    }
    measured.forEach((line, k) => {
      const points = pointsOf(line);
      if (line.wide) bars(panel, points, points.map(([, , i]) => factor * line.wide[i]));
      marks(panel, points, NAMES[k]);
    });
    for (const curve of curves.toReversed()) path(panel, `M${joined(panel, pointsOf(curve))}`, curve.style);
  }
  return { box: [left, upper[1], right, lower[1] + lower[3] - upper[1]], shown: `${short(x[0])} to ${short(x[1])} Hz` };
};

const drawNyquist = (svg, diagram, view) => {
  const { width, height, letter } = sized(svg), measured = measuredOf(diagram), curves = curvesOf(diagram);
  const pointsOf = ({ re, im }) => re.map((x, i) => [x, -im[i]]), lines = [...measured, ...curves].map(pointsOf);
  const box = [4.5 * letter, 1.6 * letter, width - 6 * letter, height - 5 * letter];
  const [x0, x1] = spread(lines.flatMap((points) => points.map(([re]) => re)), 1e-12), [y0, y1] = spread(lines.flatMap((points) => points.map(([, im]) => im)), 1e-12);
  const scale = Math.max((x1 - x0) / box[2], (y1 - y0) / box[3]); // one scale on both axes
  const wider = (low, high, length) => [(low + high - scale * length) / 2, (low + high + scale * length) / 2];
  const x = part(wider(x0, x1, box[2]), view.x, view.size), y = part(wider(y0, y1, box[3]), view.y, view.size);
  const panel = panelIn(svg, box, { x, y, xTicks: steps(...x, 5), yTicks: steps(...y, 5), xTitle: "Re Z [Ω]", yTitle: "−Im Z [Ω]" }, letter);
  for (const curve of curves.filter(({ across_re }) => across_re)) {
    const edge = (sign) => curve.re.map((re, i) => [re + sign * curve.across_re[i], -curve.im[i] - sign * curve.across_im[i]]);
    path(panel, `M${joined(panel, [...edge(1), ...edge(-1).reverse()])}Z`, "band");
  }
  measured.forEach((line, k) => {
    const points = pointsOf(line);
    if (line.wide) {
      const half = points.map(([re, im], i) => line.wide[i] * Math.hypot(re, im));
      bars(panel, points, half);
      path(panel, points.map(([re, im], i) => `M${at(panel, re - half[i], im)}L${at(panel, re + half[i], im)}`).join(""), "bars");
    }
    marks(panel, points, NAMES[k]);
  });
  for (const curve of curves.toReversed()) path(panel, `M${joined(panel, pointsOf(curve))}`, curve.style);
  return { box, shown: `Re Z ${short(x[0])} to ${short(x[1])} Ω` };
};

const inWords = (diagram) => {
  const [{ frequency, wide, lines = frequency.length }] = measuredOf(diagram), names = curvesOf(diagram).map(({ name }) => name);
  return `${lines} lines from ${short(frequency[0])} to ${short(frequency.at(-1))} Hz${wide ? ", bars of 95 %" : ""}${names.length ? `, with ${names.join(", ")}` : ""}`;
};

// Draw a window of a diagram into an SVG element, which is shown: its size is that of the picture. Returns the box of the axes.
export const draw = (svg, diagram, view) => {
  const isBode = diagram.kind === "bode", { box, shown } = (isBode ? drawBode : drawNyquist)(svg, diagram, view);
  const closer = view.size < 1 ? `; shown: ${shown}` : "";
  svg.setAttribute("aria-label", `${isBode ? "Bode" : "Nyquist"} diagram of ${inWords(diagram)}${closer}`);
  return box;
};
