// A machine with numbers: its frequency response, and the highest and lowest frequency of its free motion.
// `joints` are pairs of nodes, 0 is the ground, and the ratio of a gear: a number, or the name of a value; springs and dampers sit at
// some of them. `values` stand in the order of `names`: each has a kind and a place, the number of a mass, of a joint or of a ratio
// ("i"), from 0. `act`, `meas`: [minus, plus], nodes of force and sensor.
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
// Masses 0.., springs and dampers by joint, with zeros where there are none, unknown ratios, and the ratios g of all joints; and back.
const partsOf = ({ masses, joints, kinds, places, names }, values) => {
  const parts = { m: Array(masses).fill(0), k: Array(joints.length).fill(0), d: Array(joints.length).fill(0), i: [] };
  kinds.forEach((kind, at) => (parts[kind][places[at]] = values[at]));
  parts.g = joints.map(([, , ratio = 1]) => (typeof ratio === "string" ? values[names.indexOf(ratio)] : ratio));
  return parts;
};
const valuesOf = (machine, parts) => machine.kinds.map((kind, at) => parts[kind][machine.places[at]]);
// How far each mass goes where what is free travels: all alike but for gears, of which one of ratio g has h_i = g h_j; 0: held.
const travelOf = ({ free, near, joints }, { g }) => {
  const h = {}, pairs = joints.flatMap(([i, j], at) => (i && j ? [[i - 1, j - 1, 1 / g[at]], [j - 1, i - 1, g[at]]] : []));
  for (const start of free) {
    const todo = start in h ? [] : [start];
    h[start] ??= 1;
    while (todo.length) {
      const from = todo.pop();
      for (const [i, j, factor] of pairs) if (i === from && !(j in h)) todo.push(((h[j] = h[i] * factor), j));
    }
  }
  return h;
};
const freeMass = (machine, parts) => { // as force and sensor feel it
  const h = travelOf(machine, parts), on = ([, plus]) => h[plus - 1] || 1;
  if (!machine.free.length) return parts.m.reduce((sum, mass) => sum + mass, 0);
  return machine.free.reduce((sum, i) => sum + parts.m[i] * h[i] ** 2, 0) / (on(machine.act) * on(machine.meas));
};

// A(s) = M s² + D s + K, in which every joint of nodes i and j puts k + d s with v v', v = e_i - g e_j, g = 1 without a gear. A x = e_act and A y = e_meas are
// solved by elimination with pivots; complex numbers are pairs in one array, and x and y have a zero for the ground in front.
const createSolver = ({ masses: n, joints, kinds, places, names, act, meas, order }) => {
  const width = 2 * (n + 2), a = Array.from({ length: n }, () => new Float64Array(width)), x = new Float64Array(2 * n + 2), y = new Float64Array(2 * n + 2);
  const fill = ({ m, k, d, g }, sr, si) => {
    a.forEach((row, i) => {
      row.fill(0);
      row[2 * i] = m[i] * (sr * sr - si * si);
      row[2 * i + 1] = 2 * m[i] * sr * si;
      row[2 * n] = (i + 1 === act[1]) - (i + 1 === act[0]);
      row[2 * n + 2] = (i + 1 === meas[1]) - (i + 1 === meas[0]);
    });
    joints.forEach(([from, to], at) => {
      const re = k[at] + d[at] * sr, im = d[at] * si, r = g[at];
      for (const [i, j, weight] of [[from, from, 1], [to, to, r * r], [from, to, -r], [to, from, -r]])
        if (i && j) {
          a[i - 1][2 * j - 2] += weight * re;
          a[i - 1][2 * j - 1] += weight * im;
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
  const byRatio = ({ k, d, g }, name, sr, si) => { // derivative of the receptance by g
    let [sumr, sumi] = [0, 0];
    joints.forEach(([from, to, ratio], at) => {
      if (ratio !== name) return;
      const felt = (z) => [z[2 * from] - g[at] * z[2 * to], z[2 * from + 1] - g[at] * z[2 * to + 1]], [xr, xi] = felt(x), [yr, yi] = felt(y);
      const re = x[2 * to] * yr - x[2 * to + 1] * yi + y[2 * to] * xr - y[2 * to + 1] * xi, im = x[2 * to] * yi + x[2 * to + 1] * yr + y[2 * to] * xi + y[2 * to + 1] * xr;
      const wr = k[at] + d[at] * sr, wi = d[at] * si;
      [sumr, sumi] = [sumr + re * wr - im * wi, sumi + re * wi + im * wr];
    });
    return [sumr, sumi];
  };
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
    // parameter that enters A(s) as p w v v', and d G = (k + d s) (x_j v'y + y_j v'x) d g for each joint with the ratio g
    gradient: (parts, scales, sr, si, into) => {
      const g = response(parts, sr, si), r = seen(0), i = seen(1), size = r * r + i * i;
      back(y, n + 1);
      for (let p = 0; p < scales.length; p++) {
        if (kinds[p] === "i") {
          const [wr, wi] = byRatio(parts, names[p], sr, si);
          into[2 * p] = (scales[p] * (wr * r + wi * i)) / size;
          into[2 * p + 1] = (scales[p] * (wi * r - wr * i)) / size;
          continue;
        }
        const kind = kinds[p], [from, to] = kind === "m" ? [0, places[p] + 1] : joints[places[p]], by = kind === "m" ? 1 : parts.g[places[p]];
        const xr = by * x[2 * to] - x[2 * from], xi = by * x[2 * to + 1] - x[2 * from + 1], yr = by * y[2 * to] - y[2 * from], yi = by * y[2 * to + 1] - y[2 * from + 1];
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
const frequencyOf = ({ masses: n, joints }, { m, k, g }, which) => {
  const below = (lambda) => {
    const a = m.map((mass, i) => m.map((_, j) => (i === j ? -lambda * mass : 0)));
    joints.forEach(([from, to], at) => {
      if (from) a[from - 1][from - 1] += k[at];
      if (to) a[to - 1][to - 1] += k[at] * g[at] ** 2;
      if (from && to) for (const [i, j] of [[from, to], [to, from]]) a[i - 1][j - 1] -= k[at] * g[at];
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
