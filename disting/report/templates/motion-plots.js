// What two machines do, and their Bode diagrams.
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
