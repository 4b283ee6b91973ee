// A machine with numbers: its frequency response, and the highest and lowest frequency of its free motion.
// `joints` are pairs of nodes, 0 is the ground; springs and dampers sit at some of them. `values` stand in the order of `names`: each
// has a kind and a place, the number of a mass or of a joint, from 0. `act`, `meas`: [minus, plus], nodes of force and sensor.
const machineOf = (given) => {
  const { masses, kinds, places, joints } = given, at = (letters) => places.filter((_, i) => letters.includes(kinds[i])).map((place) => joints[place]);
  const roots = (pairs) => { // of the parts that the pairs connect, by node; 0 is that of the ground
    const found = Array.from({ length: masses + 1 }, (_, i) => i);
    for (const [from, to] of pairs) {
      const [low, high] = [found[from], found[to]].sort((a, b) => a - b);
      found.forEach((root, i) => (found[i] = root === high ? low : root));
    }
    return found;
  };
  const free = roots(at("kd")).slice(1).flatMap((root, i) => (root ? [i] : [])); // masses, from 0, that nothing holds to the ground: they travel
  const loose = new Set(roots(at("k")).filter((root) => root)).size; // parts that no spring holds: so many frequencies are zero
  return { near: at("kd"), ...given, free, loose };
};
// A chain; `ports` are [gap, act-, act+, meas-, meas+].
const between = (i) => (i < 9 ? `${i}${i + 1}` : `${i}_${i + 1}`);
const chainOf = (masses, damped, ports, order = 2) => {
  const numbers = Array.from({ length: masses }, (_, i) => i), [gap, actMinus, actPlus, measMinus, measPlus] = ports;
  const held = numbers.filter((i) => i !== gap), joints = numbers.map((i) => [i, i + 1]);
  const kinds = [...numbers.map(() => "m"), ...held.map(() => "k"), ...(damped ? held.map(() => "d") : [])];
  const places = [...numbers, ...held, ...(damped ? held : [])];
  const names = kinds.map((kind, at) => kind + (kind === "m" ? places[at] + 1 : between(places[at])));
  return machineOf({ masses, damped, ports, order, joints, kinds, places, names, act: [actMinus, actPlus], meas: [measMinus, measPlus], near: gap ? joints : joints.slice(1) });
};
// Masses 0.., springs and dampers by joint, with zeros where there are none; and back.
const partsOf = ({ masses, joints, kinds, places }, values) => {
  const parts = { m: Array(masses).fill(0), k: Array(joints.length).fill(0), d: Array(joints.length).fill(0) };
  kinds.forEach((kind, at) => (parts[kind][places[at]] = values[at]));
  return parts;
};
const valuesOf = (machine, parts) => machine.kinds.map((kind, at) => parts[kind][machine.places[at]]);
const freeMass = ({ free }, { m }) => (free.length ? free.map((i) => m[i]) : m).reduce((sum, mass) => sum + mass, 0);

// A(s) = M s² + D s + K, in which every joint of nodes i and j puts k + d s with v v', v = e_i - e_j. A x = e_act and A y = e_meas are
// solved by elimination with pivots; complex numbers are pairs in one array, and x and y have a zero for the ground in front.
const createSolver = ({ masses: n, joints, kinds, places, act, meas, order }) => {
  const width = 2 * (n + 2), a = Array.from({ length: n }, () => new Float64Array(width)), x = new Float64Array(2 * n + 2), y = new Float64Array(2 * n + 2);
  const fill = ({ m, k, d }, sr, si) => {
    a.forEach((row, i) => {
      row.fill(0);
      row[2 * i] = m[i] * (sr * sr - si * si);
      row[2 * i + 1] = 2 * m[i] * sr * si;
      row[2 * n] = (i + 1 === act[1]) - (i + 1 === act[0]);
      row[2 * n + 2] = (i + 1 === meas[1]) - (i + 1 === meas[0]);
    });
    joints.forEach(([from, to], at) => {
      const re = k[at] + d[at] * sr, im = d[at] * si;
      for (const [i, j, sign] of [[from, from, 1], [to, to, 1], [from, to, -1], [to, from, -1]])
        if (i && j) {
          a[i - 1][2 * j - 2] += sign * re;
          a[i - 1][2 * j - 1] += sign * im;
        }
    });
  };
  const subtract = (row, other, at, re, im) => { // row -= (re + j im) other, from column `at` on
    for (let k = 2 * at; k < width; k += 2) {
      row[k] -= re * other[k] - im * other[k + 1];
      row[k + 1] -= re * other[k + 1] + im * other[k];
    }
  };
  const eliminate = () => {
    for (let i = 0; i < n; i++) {
      const size = (row) => row[2 * i] ** 2 + row[2 * i + 1] ** 2;
      let best = i;
      for (let j = i + 1; j < n; j++) if (size(a[j]) > size(a[best])) best = j;
      [a[i], a[best]] = [a[best], a[i]];
      const pr = a[i][2 * i], pi = a[i][2 * i + 1], whole = size(a[i]);
      for (let j = i + 1; j < n; j++) {
        const re = a[j][2 * i], im = a[j][2 * i + 1];
        if (re || im) subtract(a[j], a[i], i, (re * pr + im * pi) / whole, (im * pr - re * pi) / whole);
      }
    }
  };
  const back = (into, column) => {
    for (let i = n - 1; i >= 0; i--) {
      let re = a[i][2 * column], im = a[i][2 * column + 1];
      for (let j = i + 1; j < n; j++) {
        re -= a[i][2 * j] * into[2 * j + 2] - a[i][2 * j + 1] * into[2 * j + 3];
        im -= a[i][2 * j] * into[2 * j + 3] + a[i][2 * j + 1] * into[2 * j + 2];
      }
      const pr = a[i][2 * i], pi = a[i][2 * i + 1], whole = pr * pr + pi * pi;
      into[2 * i + 2] = (re * pr + im * pi) / whole;
      into[2 * i + 3] = (im * pr - re * pi) / whole;
    }
  };
  const seen = (part) => x[2 * meas[1] + part] - x[2 * meas[0] + part];
  const response = (parts, sr, si) => { // [re, im] at s: receptance times s^order
    fill(parts, sr, si);
    eliminate();
    back(x, n);
    let gr = seen(0), gi = seen(1);
    for (let i = 0; i < order; i++) [gr, gi] = [gr * sr - gi * si, gr * si + gi * sr];
    return [gr, gi];
  };
  return {
    response,
    // [re, im], and derivatives of ln G as pairs into `into`, by the parameters in units of `scales`: d G = -w (v'x)(v'y) d p for a
    // parameter that enters A(s) as p w v v'
    gradient: (parts, scales, sr, si, into) => {
      const g = response(parts, sr, si), r = seen(0), i = seen(1), size = r * r + i * i;
      back(y, n + 1);
      for (let p = 0; p < scales.length; p++) {
        const kind = kinds[p], [from, to] = kind === "m" ? [0, places[p] + 1] : joints[places[p]];
        const xr = x[2 * to] - x[2 * from], xi = x[2 * to + 1] - x[2 * from + 1], yr = y[2 * to] - y[2 * from], yi = y[2 * to + 1] - y[2 * from + 1];
        let wr = xr * yr - xi * yi, wi = xr * yi + xi * yr;
        for (let o = kind === "m" ? 2 : kind === "d" ? 1 : 0; o > 0; o--) {
          const before = wr;
          wr = wr * sr - wi * si;
          wi = before * si + wi * sr;
        }
        into[2 * p] = (-scales[p] * (wr * r + wi * i)) / size;
        into[2 * p + 1] = (-scales[p] * (wi * r - wr * i)) / size;
      }
      return g;
    },
  };
};
// Free motion without damping: number `which` [rad/s] of the frequencies in rising order; where something travels the first is 0. The
// pivots of K - λ M below zero count the eigenvalues below λ.
const frequencyOf = ({ masses: n, joints }, { m, k }, which) => {
  const below = (lambda) => {
    const a = m.map((mass, i) => m.map((_, j) => (i === j ? -lambda * mass : 0)));
    joints.forEach(([from, to], at) => {
      if (from) a[from - 1][from - 1] += k[at];
      if (to) a[to - 1][to - 1] += k[at];
      if (from && to) [a[from - 1][to - 1], a[to - 1][from - 1]] = [a[from - 1][to - 1] - k[at], a[to - 1][from - 1] - k[at]];
    });
    let count = 0;
    for (let i = 0; i < n; i++) {
      const pivot = a[i][i] || -Number.MIN_VALUE;
      count += pivot < 0;
      for (let j = i + 1; j < n; j++) if (a[j][i]) for (let c = n - 1; c >= i; c--) a[j][c] -= (a[j][i] / pivot) * a[i][c];
    }
    return count;
  };
  let low = 0, high = 1;
  while (below(high) < which) high *= 4;
  while (below(high / 4) >= which && high > Number.MIN_VALUE * 1e20) high /= 4;
  for (let i = 0; i < 60; i++) [low, high] = below((low + high) / 2) < which ? [(low + high) / 2, high] : [low, (low + high) / 2];
  return Math.sqrt((low + high) / 2);
};
