// A force over time, and how a machine with numbers moves under it, from rest. The force is linear between its samples, and for such a
// force the samples of the motion are exact: the transition matrices are exponentials of the state space.
const FORCE = 10; // N
const forceOf = (kind, { steps, duration, frequency, from, to }) => {
  const dt = duration / steps, rise = Math.log(to / from);
  const phase = kind === "sweep" ? (t) => (2 * Math.PI * from * duration * Math.expm1((rise * t) / duration)) / rise : (t) => 2 * Math.PI * frequency * t;
  const at = kind === "step" ? (t) => (t < duration / 2 ? FORCE : 0) : (t) => FORCE * Math.sin(phase(t));
  return Float64Array.from({ length: steps + 1 }, (_, i) => at(i * dt));
};
const sweepFrequency = (t, { duration, from, to }) => from * (to / from) ** (t / duration);

const matrixProduct = (a, b) => a.map((row) => b[0].map((_, j) => row.reduce((sum, x, k) => sum + x * b[k][j], 0)));
const exponential = (a) => {
  const size = Math.max(...a.map((row) => row.reduce((sum, x) => sum + Math.abs(x), 0)));
  const halvings = Math.max(0, Math.ceil(Math.log2(size)) + 3), scaled = a.map((row) => row.map((x) => x / 2 ** halvings));
  let term = a.map((_, i) => a.map((_, j) => +(i === j))), sum = term;
  for (let k = 1; k <= 14; k++) {
    term = matrixProduct(term, scaled).map((row) => row.map((x) => x / k));
    sum = sum.map((row, i) => row.map((x, j) => x + term[i][j]));
  }
  for (let i = 0; i < halvings; i++) sum = matrixProduct(sum, sum);
  return sum;
};
// z' = A z + b F for places and velocities. What travels is seen from its centre of mass (behind gears as these make it travel), so that
// it stays in the picture.
const stateSpace = (machine, parts) => {
  const { masses: n, joints, free, act } = machine, { m, k, d, g } = parts, h = travelOf(machine, parts);
  const on = ([minus, plus], i) => (i + 1 === plus) - (i + 1 === minus), along = (port) => free.reduce((sum, i) => sum + h[i] * on(port, i), 0);
  const net = free.length ? along(act) / free.reduce((sum, i) => sum + m[i] * h[i] ** 2, 0) : 0;
  const a = Array.from({ length: 2 * n }, () => Array(2 * n).fill(0)), b = Array(2 * n).fill(0);
  for (let i = 0; i < n; i++) {
    a[i][n + i] = 1;
    b[n + i] = on(act, i) / m[i] - (free.includes(i) ? net * h[i] : 0);
  }
  for (const [of, offset] of [[k, 0], [d, n]])
    joints.forEach(([from, to], at) => {
      const felt = [[from - 1, 1], [to - 1, -g[at]]].filter(([i]) => i >= 0);
      for (const [i, u] of felt) for (const [j, v] of felt) a[n + i][offset + j] -= (of[at] * u * v) / m[i];
    });
  const travel = along(machine.meas) * net; // what the sensor sees of it
  return { a, b, travel };
};
// Places of the masses [m], row after row, without the travel; what the sensor shows (its `order`-th derivative, with the travel for
// an acceleration), and the change of the measured distance without travel.
const moved = (machine, parts, force, dt) => {
  const n = machine.masses, [measMinus, measPlus] = machine.meas, { a, b, travel } = stateSpace(machine, parts), size = 2 * n;
  const held = [...a.map((row, i) => [...row.map((x) => x * dt), b[i] * dt, 0]), [...Array(size + 1).fill(0), 1], Array(size + 2).fill(0)];
  const transition = exponential(held), samples = force.length;
  const places = new Float64Array(samples * n), distance = new Float64Array(samples), acceleration = new Float64Array(samples);
  const seen = a.map((row, i) => [row, b[i]]), rows = [[measPlus, 1], [measMinus, -1]].filter(([port]) => port).map(([port, sign]) => [n + port - 1, sign]);
  let state = Array(size).fill(0);
  for (let t = 0; t < samples; t++) {
    for (let i = 0; i < n; i++) places[t * n + i] = state[i];
    distance[t] = (measPlus ? state[measPlus - 1] : 0) - (measMinus ? state[measMinus - 1] : 0);
    acceleration[t] = force[t] * travel + rows.reduce((sum, [row, sign]) => sum + sign * seen[row][0].reduce((s, x, j) => s + x * state[j], seen[row][1] * force[t]), 0);
    if (t + 1 < samples) {
      const change = force[t + 1] - force[t], before = state;
      state = before.map((_, i) => {
        let sum = transition[i][size] * force[t] + transition[i][size + 1] * change;
        for (let j = 0; j < size; j++) sum += transition[i][j] * before[j];
        return sum;
      });
    }
  }
  return { places, distance, acceleration };
};
