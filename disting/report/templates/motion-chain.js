// A chain with numbers: its frequency response, and the highest and lowest frequency of its free motion.
// `ports` are [gap, act-, act+, meas-, meas+], 0 is the ground. `values` stand in the order of `names`: masses, springs, dampers.
const between = (i) => (i < 9 ? `${i}${i + 1}` : `${i}_${i + 1}`);
const chainOf = (masses, damped, ports, order = 2) => {
  const numbers = Array.from({ length: masses }, (_, i) => i);
  const joints = numbers.filter((i) => i !== ports[0]); // joint i lies between mass i, or the ground, and mass i + 1
  const kinds = [...numbers.map(() => "m"), ...joints.map(() => "k"), ...(damped ? joints.map(() => "d") : [])];
  const places = [...numbers, ...joints, ...(damped ? joints : [])];
  const names = kinds.map((kind, at) => kind + (kind === "m" ? places[at] + 1 : between(places[at])));
  return { masses, damped, ports, order, joints, kinds, places, names };
};
// Masses 0.., springs and dampers by joint, with zeros at the gap; and back.
const partsOf = (chain, values) => {
  const parts = { m: Array(chain.masses).fill(0), k: Array(chain.masses).fill(0), d: Array(chain.masses).fill(0) };
  chain.kinds.forEach((kind, at) => (parts[kind][chain.places[at]] = values[at]));
  return parts;
};
const valuesOf = (chain, parts) => chain.kinds.map((kind, at) => parts[kind][chain.places[at]]);
const freeMass = ({ ports }, { m }) => m.slice(ports[0]).reduce((sum, mass) => sum + mass, 0);

// A(s) = M s² + D s + K is tridiagonal, with -κ beside the diagonal, κ = k + d s. With the leading minors `low` and the trailing
// ones `high`, (A^-1)_ij = low_i κ_i+1 .. κ_j high_j+1 / det A for i <= j. Complex numbers are pairs in one array.
const createSolver = (chain) => {
  const n = chain.masses, [, actMinus, actPlus, measMinus, measPlus] = chain.ports;
  const kappa = new Float64Array(2 * n + 2), diagonal = new Float64Array(2 * n), act = new Float64Array(2 * n), meas = new Float64Array(2 * n);
  const low = new Float64Array(2 * n + 2), high = new Float64Array(2 * n + 2);
  const minor = (into, at, from, before, entry, joint) => { // into[at] = diagonal[entry] into[from] - κ[joint]² into[before]
    const dr = diagonal[2 * entry], di = diagonal[2 * entry + 1], fr = into[2 * from], fi = into[2 * from + 1];
    into[2 * at] = dr * fr - di * fi;
    into[2 * at + 1] = dr * fi + di * fr;
    if (before < 0 || before > n) return;
    const kr = kappa[2 * joint], ki = kappa[2 * joint + 1], sr = kr * kr - ki * ki, si = 2 * kr * ki, br = into[2 * before], bi = into[2 * before + 1];
    into[2 * at] -= sr * br - si * bi;
    into[2 * at + 1] -= sr * bi + si * br;
  };
  const add = (into, port, sign) => { // a column of the inverse
    if (!port) return;
    const column = port - 1, dr = low[2 * n], di = low[2 * n + 1], size = sign / (dr * dr + di * di);
    for (let way = -1; way <= 1; way += 2) {
      let pr = 1, pi = 0; // of the κ on the way
      for (let i = way < 0 ? column : column + 1; i >= 0 && i < n; i += way) {
        if (i !== column) {
          const joint = 2 * (way < 0 ? i + 1 : i), kr = kappa[joint], ki = kappa[joint + 1], before = pr;
          pr = pr * kr - pi * ki;
          pi = before * ki + pi * kr;
        }
        const l = 2 * Math.min(i, column), h = 2 * Math.max(i, column) + 2;
        const mr = low[l] * high[h] - low[l + 1] * high[h + 1], mi = low[l] * high[h + 1] + low[l + 1] * high[h];
        const ur = mr * pr - mi * pi, ui = mr * pi + mi * pr;
        into[2 * i] += size * (ur * dr + ui * di);
        into[2 * i + 1] += size * (ui * dr - ur * di);
      }
    }
  };
  const column = (into, minus, plus) => {
    into.fill(0);
    add(into, plus, 1);
    add(into, minus, -1);
  };
  const factor = ({ m, k, d }, sr, si) => {
    const s2r = sr * sr - si * si, s2i = 2 * sr * si;
    for (let i = 0; i < n; i++) {
      kappa[2 * i] = k[i] + d[i] * sr;
      kappa[2 * i + 1] = d[i] * si;
    }
    for (let i = 0; i < n; i++) {
      diagonal[2 * i] = m[i] * s2r + kappa[2 * i] + kappa[2 * i + 2];
      diagonal[2 * i + 1] = m[i] * s2i + kappa[2 * i + 1] + kappa[2 * i + 3];
    }
    low[0] = high[2 * n] = 1;
    low[1] = high[2 * n + 1] = 0;
    for (let i = 0; i < n; i++) minor(low, i + 1, i, i - 1, i, i);
    for (let i = n - 1; i >= 0; i--) minor(high, i, i + 1, i + 2, i, i + 1);
    column(act, actMinus, actPlus);
  };
  const seen = (part) => act[2 * measPlus - 2 + part] - (measMinus ? act[2 * measMinus - 2 + part] : 0);
  const response = (parts, sr, si) => { // [re, im] at s: receptance times s^order
    factor(parts, sr, si);
    let gr = seen(0), gi = seen(1);
    for (let i = 0; i < chain.order; i++) [gr, gi] = [gr * sr - gi * si, gr * si + gi * sr];
    return [gr, gi];
  };
  return {
    response,
    // [re, im], and derivatives of ln G as pairs into `into`, by the parameters in units of `scales`: d G = -w (v'x)(v'y) d p for a
    // parameter that enters A(s) as p w v v'
    gradient: (parts, scales, sr, si, into) => {
      const g = response(parts, sr, si), r = seen(0), i = seen(1), size = r * r + i * i;
      column(meas, measMinus, measPlus);
      for (let p = 0; p < scales.length; p++) {
        const place = 2 * chain.places[p], kind = chain.kinds[p];
        let xr = act[place], xi = act[place + 1], yr = meas[place], yi = meas[place + 1];
        if (kind !== "m" && place) {
          xr -= act[place - 2];
          xi -= act[place - 1];
          yr -= meas[place - 2];
          yi -= meas[place - 1];
        }
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
// Free motion without damping: number `which` [rad/s] of the frequencies in rising order, the first is that of travel, 0. The pivots
// of K - λ M below zero count the eigenvalues below λ.
const frequencyOf = (chain, { m, k }, which) => {
  const below = (lambda) => {
    let count = 0, pivot = Infinity;
    for (let i = 0; i < chain.masses; i++) {
      pivot = k[i] + (k[i + 1] || 0) - lambda * m[i] - (k[i] * k[i]) / pivot || -Number.MIN_VALUE;
      count += pivot < 0;
    }
    return count;
  };
  let low = 0, high = 1;
  while (below(high) < which) high *= 4;
  while (below(high / 4) >= which && high > Number.MIN_VALUE * 1e20) high /= 4;
  for (let i = 0; i < 60; i++) [low, high] = below((low + high) / 2) < which ? [(low + high) / 2, high] : [low, (low + high) / 2];
  return Math.sqrt((low + high) / 2);
};
