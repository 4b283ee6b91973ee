// The values of one chain that come nearest to the response of another, by Levenberg's and Marquardt's method over logarithms from
// several starts. The cost is (14) of the paper with its weights: π log10 of the ratio of the amplitudes, and the phase between.
const LINES = 400;
const WEIGHTS = [Math.PI / Math.LN10, 1];
const FURTHEST = Math.log(1e4); // of a value from where its start is: a limit case has no best values
// What is undamped has resonances without end: both are seen as if each had this damping ratio.
const LENT = 0.02;
const linesOf = (low, high, count = LINES) => Array.from({ length: count }, (_, i) => low * (high / low) ** (i / (count - 1)));
const alongAxis = (chain, omega) => [chain.damped ? 0 : LENT * omega, omega];
const createTask = (given, values, other, low, high, { lines = LINES, more = [] } = {}) => { // `more`: further frequencies
  const solver = createSolver(given), parts = partsOf(given, values);
  const points = [...linesOf(low, high, lines), ...more].map((omega) => alongAxis(given, omega));
  return { given, values, parts, other, low, high, points, wanted: points.map(([re, im]) => solver.response(parts, re, im)), solver: createSolver(other) };
};
// What is varied: logarithms, which keep values positive; or values in units of given ones, which may change their signs.
const POSITIVE = { values: (logs) => logs.map(Math.exp), scales: (values) => values };
const signed = (units) => ({ values: (factors) => factors.map((x, i) => x * units[i]), scales: () => units });
const residuals = ({ other, points, wanted, solver }, unknowns, way = POSITIVE) => { // and the rows of their derivatives, one behind the other
  const size = unknowns.length, values = way.values(unknowns), scales = way.scales(values), parts = partsOf(other, values), into = new Float64Array(2 * size);
  const r = new Float64Array(2 * points.length), rows = new Float64Array(r.length * size);
  for (let i = 0; i < points.length; i++) {
    const [gr, gi] = solver.gradient(parts, scales, points[i][0], points[i][1], into), [hr, hi] = wanted[i], hh = hr * hr + hi * hi;
    const qr = (gr * hr + gi * hi) / hh, qi = (gi * hr - gr * hi) / hh;
    r[2 * i] = WEIGHTS[0] * 0.5 * Math.log(qr * qr + qi * qi);
    r[2 * i + 1] = WEIGHTS[1] * Math.atan2(qi, qr);
    for (let p = 0; p < size; p++) {
      rows[2 * i * size + p] = WEIGHTS[0] * into[2 * p];
      rows[(2 * i + 1) * size + p] = WEIGHTS[1] * into[2 * p + 1];
    }
  }
  return { r, rows, cost: r.reduce((sum, x) => sum + x * x, 0) };
};
const normalOf = ({ r, rows }, size) => {
  const normal = Array.from({ length: size }, () => new Float64Array(size)), slope = new Float64Array(size);
  for (let i = 0; i < r.length; i++)
    for (let p = 0; p < size; p++) {
      const x = rows[i * size + p];
      slope[p] -= x * r[i];
      for (let q = p; q < size; q++) normal[p][q] += x * rows[i * size + q];
    }
  for (let p = 0; p < size; p++) for (let q = 0; q < p; q++) normal[p][q] = normal[q][p];
  return { normal, slope };
};
const solved = (matrix, right) => { // symmetric and positive
  const n = right.length, a = matrix.map((row) => [...row]), x = [...right];
  for (let i = 0; i < n; i++)
    for (let j = i + 1; j < n; j++) {
      const factor = a[j][i] / a[i][i];
      for (let k = i; k < n; k++) a[j][k] -= factor * a[i][k];
      x[j] -= factor * x[i];
    }
  for (let i = n - 1; i >= 0; i--) {
    for (let k = i + 1; k < n; k++) x[i] -= a[i][k] * x[k];
    x[i] /= a[i][i];
  }
  return x;
};
const descended = (task, start, { rounds = 150, least = 1e-9, way = POSITIVE } = {}) => { // until three steps gain less than this share of the cost
  const size = start.length;
  let unknowns = start, here = residuals(task, start, way), { normal, slope } = normalOf(here, size), damping = 1e-2, small = 0;
  for (let round = 0; round < rounds && damping < 1e12 && small < 3 && here.cost > 1e-26; round++) {
    const floor = 1e-9 * Math.max(...normal.map((row, p) => row[p]));
    const step = solved(normal.map((row, p) => row.map((x, q) => x + (p === q) * damping * (row[p] + floor))), slope);
    const next = unknowns.map((x, p) => clamped(x + clamped(step[p], -1.5, 1.5), start[p] - FURTHEST, start[p] + FURTHEST));
    const found = residuals(task, next, way);
    if (found.cost < here.cost) {
      small = here.cost - found.cost < least * here.cost ? small + 1 : 0;
      [unknowns, here, damping] = [next, found, Math.max(damping / 6, 1e-14)];
      ({ normal, slope } = normalOf(here, size));
    } else damping *= 4;
  }
  return { values: way.values(unknowns), unknowns, cost: here.cost };
};
// Starts: the given values where there are any, then those of the same names and scattered ones, all with the mass that travels.
const startOf = ({ given, parts, other }, values) => {
  const factor = freeMass(given, parts) / freeMass(other, partsOf(other, values));
  return values.map((x) => Math.log(x * factor));
};
const startsOf = (task, usual, count) => {
  let seed = 12345;
  const random = () => (seed = (Math.imul(seed, 1664525) + 1013904223) >>> 0) / 2 ** 32;
  return Array.from({ length: count }, (_, i) => startOf(task, usual.map((x) => x * Math.exp(i ? 3.2 * (random() - 0.5) : 0))));
};
// Where two responses part most, in dB: the largest of |20 log10| of the ratio between two frequencies [rad/s], and where that is.
const partedMost = (task, values) => {
  const { given, parts, other, low, high } = task, one = createSolver(given), two = createSolver(other), others = partsOf(other, values);
  const at = (omega) => {
    const s = alongAxis(given, omega), [a, b] = [one.response(parts, ...s), two.response(others, ...s)];
    return (20 * Math.log(Math.hypot(...b) / Math.hypot(...a))) / Math.LN10;
  };
  const lines = linesOf(low, high, 1500), sizes = lines.map((omega) => Math.abs(at(omega))), best = sizes.indexOf(Math.max(...sizes));
  let [left, right] = [lines[Math.max(best - 1, 0)], lines[Math.min(best + 1, lines.length - 1)]];
  for (let i = 0; i < 50; i++) {
    const [a, b] = [left + (right - left) * 0.382, left + (right - left) * 0.618];
    [left, right] = Math.abs(at(a)) > Math.abs(at(b)) ? [left, b] : [a, right];
  }
  const omega = (left + right) / 2;
  return Math.abs(at(omega)) >= sizes[best] ? { omega, decibels: at(omega) } : { omega: lines[best], decibels: at(lines[best]) };
};
// An imitation may hide a resonance without damping between two lines, which costs nothing there. Lines are put where both part
// far more than at any line, until none does.
const CROWD = 9;
const withoutSpikes = (task, found) => {
  const spacing = (task.high / task.low) ** (1 / (LINES - 1)), more = [];
  const seen = ({ r }) => r.reduce((most, x, i) => (i % 2 ? most : Math.max(most, (20 * Math.abs(x)) / Math.PI)), 0);
  let [best, now] = [found, task];
  for (let round = 0; round < 6; round++) {
    const { omega, decibels } = partedMost(now, best.values);
    if (Math.abs(decibels) <= 1.2 * seen(residuals(now, best.unknowns)) + 0.1) break;
    more.push(...linesOf(omega / spacing, omega * spacing, CROWD), omega);
    now = createTask(task.given, task.values, task.other, task.low, task.high, { more });
    best = descended(now, best.unknowns);
  }
  return best;
};
