// Parameters of one chain from those of another, with the same response for all values: the formulas of disting.equivalence, in
// numbers. Symmetries rename, the duality theorem exchanges the rows, Cauer's continued fraction sees a row from its end (undamped).
const FORMS = [0, 1, 2, 3, 4, 5, 6, 7].map((i) => ({ free: i & 4, grounded: i & 2, mirrored: i & 1, steps: [i & 4, i & 2, i & 1].filter(Boolean).length }));
const formOf = ({ ports: [gap, actMinus, actPlus, measMinus, measPlus], parts }, n, form) => {
  const fold = (i) => (form.mirrored && i > gap ? gap + 1 + n - i : i);
  const [act, meas] = form.free ? [measPlus, actPlus] : [actPlus, measPlus];
  const references = form.grounded ? [measMinus, actMinus] : [actMinus, measMinus];
  const masses = parts.m.map((_, i) => parts.m[fold(i + 1) - 1]);
  const laws = (of) => of.map((_, i) => (form.mirrored && i > gap ? of[gap + n - i] : of[i]));
  return { ports: [gap, references[0], fold(act), references[1], fold(meas)], parts: { m: masses, k: laws(parts.k), d: laws(parts.d) } };
};
// F(s) - 1/(M s²) of a row that is free, seen from its end, and the reverse: [masses, laws] outwards; a law is [k, d].
const groundedFrom = (masses, laws, total) => {
  if (!laws.length) return [[], []];
  const rest = total - masses[0], factor = (total / rest) ** 2;
  const [inner, others] = groundedFrom(masses.slice(1), laws.slice(1), rest);
  return [[(total * masses[0]) / rest, ...inner.map((m) => factor * m)], [laws[0], ...others].map((law) => law.map((x) => factor * x))];
};
const freeFrom = (masses, laws, total) => {
  if (!masses.length) return [[total], []];
  const rest = total ** 2 / (total + masses[0]), factor = (rest / total) ** 2, scaled = (law) => law.map((x) => factor * x);
  const [inner, others] = freeFrom(masses.slice(1).map((m) => factor * m), laws.slice(1).map(scaled), rest);
  return [[(total * masses[0]) / (total + masses[0]), ...inner], [scaled(laws[0]), ...others]];
};
const dualOf = ({ ports: [gap, actMinus, actPlus, measMinus, measPlus], parts }, n) => {
  if (actMinus !== gap || measMinus !== gap || actPlus !== gap + 1 || measPlus !== gap + 1) return null;
  const h = n - 1 - gap, law = (i) => [parts.k[i], parts.d[i]], total = parts.m.slice(gap).reduce((a, b) => a + b, 0);
  const behind = Array.from({ length: h }, (_, i) => law(gap + 1 + i)), before = Array.from({ length: gap }, (_, i) => law(gap - 1 - i));
  const [inner, springs] = groundedFrom(parts.m.slice(gap), behind, total);
  const [outer, others] = freeFrom(parts.m.slice(0, gap).reverse(), before, total);
  const laws = [...springs.reverse(), [0, 0], ...others];
  return { ports: [h, h, h + 1, h, h + 1], parts: { m: [...inner.reverse(), ...outer], k: laws.map(([k]) => k), d: laws.map(([, d]) => d) } };
};
const imagesOf = (start, n) => {
  const moved = (from, steps) => FORMS.map((form) => ({ ...formOf(from, n, form), steps: steps + form.steps }));
  const first = moved(start, 0);
  const duals = first.flatMap((form) => {
    const other = dualOf(form, n);
    return other ? moved(other, form.steps + 1) : [];
  });
  return [...first, ...duals].sort((a, b) => a.steps - b.steps);
};

// ---- polynomials in x = s², lowest coefficient first
const plus = (p, q, factor = 1) => Array.from({ length: Math.max(p.length, q.length) }, (_, i) => (p[i] || 0) + factor * (q[i] || 0));
const product = (p, q) => {
  const found = Array(Math.max(p.length + q.length - 1, 0)).fill(0);
  p.forEach((a, i) => q.forEach((b, j) => (found[i + j] += a * b)));
  return found;
};
// det of masses first .. last of a row (an empty one: 1) and the receptance of mass `at` in it: [numerator, denominator]
const minorOf = ({ m, k }, first, last) => {
  let [before, here] = [[0], [1]];
  for (let i = first; i <= last; i++) [before, here] = [here, plus(product([k[i] + (k[i + 1] || 0), m[i]], here), before, i > first ? -(k[i] ** 2) : 0)];
  return here;
};
const receptanceAt = (parts, first, last, at) => [product(minorOf(parts, first, at - 1), minorOf(parts, at + 1, last)), minorOf(parts, first, last)];
const fromEnd = (numerator, denominator, wall) => {
  const masses = [], springs = [];
  let [num, den] = [numerator, denominator];
  while (num.length) {
    masses.push(den[den.length - 1] / num[num.length - 1]);
    const rest = den.slice(0, -1).map((c, i) => (i ? c - masses[masses.length - 1] * num[i - 1] : c));
    if (num.length === 1 && !wall) break;
    springs.push(rest[rest.length - 1] / num[num.length - 1]);
    [num, den] = [num.slice(0, -1).map((c, i) => c - rest[i] / springs[springs.length - 1]), rest];
  }
  return [masses, springs];
};
const expansionsOf = ({ ports, parts }, n) => {
  const [gap, actMinus, actPlus, measMinus, measPlus] = ports, found = [];
  const free = actPlus === measPlus, grounded = gap > 0 && actMinus === measMinus, none = Array(n).fill(0);
  const freeEnd = () => receptanceAt(parts, gap, n - 1, actPlus - 1), groundedEnd = () => receptanceAt(parts, 0, gap - 1, actMinus - 1);
  if (free && (grounded || !gap)) {
    const [a, b] = freeEnd(), [c, d] = gap ? groundedEnd() : [[], [1]];
    const [m, k] = fromEnd(plus(product(a, d), product(c, b)), product(b, d), false);
    found.push({ ports: [0, 0, 1, 0, 1], parts: { m, k: [0, ...k], d: none } });
  }
  if (!gap) return found;
  for (const [f, g] of [[free, grounded], [free, false], [false, grounded]]) {
    if (!f && !g) continue;
    const to = { ports: [...ports], parts: { m: [...parts.m], k: [...parts.k], d: none } };
    if (f) {
      const [m, k] = fromEnd(...freeEnd(), false);
      [to.ports[2], to.ports[4]] = [gap + 1, gap + 1];
      to.parts.m.splice(gap, m.length, ...m);
      to.parts.k.splice(gap + 1, k.length, ...k);
    }
    if (g) {
      const [m, k] = fromEnd(...groundedEnd(), true);
      [to.ports[1], to.ports[3]] = [gap, gap];
      to.parts.m.splice(0, m.length, ...m.reverse());
      to.parts.k.splice(0, k.length, ...k.reverse());
    }
    found.push(to);
  }
  return found;
};
// The values of `other`, by the simplest formulas that are known; null if there are none, as of what is no chain.
const mapped = (given, other, values) => {
  if (!given.ports || !other.ports) return null;
  const n = given.masses, start = { ports: given.ports, parts: partsOf(given, values) }, wanted = `${other.ports}`;
  const among = (from) => imagesOf(from, n).find((image) => `${image.ports}` === wanted);
  let found = among(start);
  for (const expansion of given.damped || found ? [] : expansionsOf(start, n)) found ??= among(expansion);
  return found ? valuesOf(other, found.parts) : null;
};
