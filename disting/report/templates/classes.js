// Relation and rule of two models, counted from 0. No pair is stored: two classes are distinguishable by the first column in which
// both have a bucket and these differ, else undecided if their pair is open, else distinguishable by the exact decision; the
// models of one class are indistinguishable, by the rule that links them.
const createClasses = (data) => {
  const { exact: EXACT, renaming, free: freely, submodel, supermodel } = data.links, DISTINGUISHABLE = 0, INDISTINGUISHABLE = 1, UNDECIDED = 3;
  const each = data.sets.length, count = data.structures.length * each, tests = [...data.tests, EXACT];
  const [group, renamed, free, rank] = ["group", "renamed", "free", "rank"].map((name) => unpacked(data[name], count));
  const columns = data.columns.map((column) => unpacked(column, data.classes));
  const setNumber = new Map(data.sets.map((set, at) => [set, at]));
  const members = Array.from({ length: data.classes }, () => []);
  group.forEach((g, model) => members[g].push(model));

  // ---- of two classes: their relation, and the number of the test that tells them apart
  const relations = new Uint8Array(data.classes ** 2), decisive = new Uint8Array(data.classes ** 2);
  const at = (a, b) => a * data.classes + b;
  for (let a = 0; a < data.classes; a++)
    for (let b = 0; b < data.classes; b++) {
      const first = columns.findIndex((column) => column[a] !== column[b] && column[a] && column[b]);
      decisive[at(a, b)] = first < 0 ? tests.length - 1 : first;
      relations[at(a, b)] = a === b ? INDISTINGUISHABLE : DISTINGUISHABLE;
    }
  for (const [a, b] of data.open) if (decisive[at(a, b)] === tests.length - 1) relations[at(a, b)] = relations[at(b, a)] = UNDECIDED;

  // ---- inside a class
  const structure = (i) => Math.floor(i / each);
  const within = (one, other) => (one & other) === one || (one & other) === other;
  const turned = (set, gap, fold) => Array.from({ length: data.masses }, (_, k) => k + 1).reduce((found, m) => (set & (1 << m) ? found | (1 << (m > gap ? fold - m : m)) : found), 0);
  const byStructure = (i, j) => {
    if (structure(i) !== structure(j)) return EXACT;
    const [gap, fold] = data.structures[structure(i)], mine = data.sets[i % each], yours = data.sets[j % each];
    if (within(mine, yours)) return submodel;
    const both = setNumber.get(mine | yours);
    if (both !== undefined && rank[structure(i) * each + both] === rank[i]) return supermodel;
    return fold && within(mine, turned(yours, gap, fold)) ? submodel : EXACT;
  };
  const link = (i, j) => (renamed[i] === renamed[j] ? renaming : free[i] && free[i] === free[j] ? freely : byStructure(i, j));

  return {
    count,
    members,
    undecided: (a, b) => relations[at(a, b)] === UNDECIDED,
    group: (i) => group[i],
    rank: (i) => rank[i],
    structure,
    relation: (i, j) => relations[group[i] * data.classes + group[j]],
    rule: (i, j) => {
      const of = at(group[i], group[j]);
      return [() => tests[decisive[of]], () => link(i, j), null, () => ""][relations[of]]();
    },
  };
};
