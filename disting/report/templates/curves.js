// The curves of two models with the same example values, where they differ in how they fall towards high frequencies.
const LINES = Array.from({ length: 300 }, (_, i) => 2 * Math.PI * 10 ** (-1 + (4 * i) / 299)); // 0.1 to 1000 Hz: far above the resonances a damper carries more than its spring
const twoCurves = (svg, models, names) => { // `models`: [chain, values]; what it shows in words, "" where both fall alike
  const gains = models.map(([chain, values]) => bodeOf(chain, partsOf(chain, values), LINES)[0]), last = LINES.length - 1;
  const falls = gains.map((gain) => 20 * Math.round((gain[last] - gain[last - 40]) / (20 * Math.log10(LINES[last] / LINES[last - 40]))) || 0);
  if (falls[0] === falls[1] || !falls.every(Number.isFinite)) return "";
  const width = 330, height = 190, letter = 11; // the panel may not be shown yet, so it cannot be measured
  svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
  svg.replaceChildren();
  const sorted = gains.flat().sort((a, b) => a - b);
  const y = [sorted[0] - 4, sorted[Math.round(0.985 * (sorted.length - 1))] + 12], x = [0.1, 1000];
  const box = [3.4 * letter, 1.4 * letter, width - 5 * letter, height - 4.2 * letter];
  const panel = panelIn(svg, box, { x, y, log: true, xTicks: [0.1, 1, 10, 100, 1000], yTicks: steps(...y, 4), xTitle: "frequency in Hz", yTitle: "amplitude of y/F in dB" }, letter);
  gains.forEach((gain, which) => panel.line(gain.map((v, i) => [LINES[i] / (2 * Math.PI), v]), `curve ${["one", "two"][which]}`));
  const said = falls.map((fall, which) => `${names[which]} (${["solid", "dashed"][which]}) ${fall ? `${fall < 0 ? "falls" : "rises"} by ${Math.abs(fall)} dB a decade` : "stays level"}`);
  return `With example values: towards high frequencies ${said.join(", ")}.`;
};
