// Names of the models of a family with sets of dampers to the ground: a model is a place counted from 0, a structure is counted
// from 1, a set is a list of masses.
const RELATIONS = ["distinguishable", "indistinguishable", "sometimes", "undecided"];
const createModels = (data, classes) => {
  const each = data.sets.length;
  const masses = (set) => Array.from({ length: data.masses }, (_, k) => k + 1).filter((m) => set & (1 << m));
  const setOf = (i) => masses(data.sets[i % each]);
  const structure = (i) => classes.structure(i) + 1;
  const name = (i) => `A${structure(i)}${damperSet(setOf(i))}`;
  const inWords = (i, j) => {
    const relation = RELATIONS[classes.relation(i, j)], rule = classes.rule(i, j);
    return rule ? `${relation}, ${data.rules[rule][1]}` : relation;
  };
  return {
    setOf,
    structure,
    name,
    all: Array.from({ length: classes.count }, (_, i) => i),
    ofStructure: (s) => Array.from({ length: each }, (_, k) => (s - 1) * each + k),
    spelled: (i) => setOf(i).join("+") || "0",
    typed: (i) => ({ number: structure(i), dampers: setOf(i) }),
    onCommandLine: (i) => `${data.masses}:${structure(i)}${damperSet(setOf(i))}`,
    label: (i, j) => (i === j ? `${name(i)}, the model itself` : `${name(Math.min(i, j))} and ${name(Math.max(i, j))}: ${inWords(i, j)}`),
    place: ({ number, dampers }) => { // -1 where there is no such model
      const set = data.sets.indexOf((dampers || []).reduce((bits, m) => bits | (1 << m), 0));
      return number >= 1 && number <= data.structures.length && set >= 0 ? (number - 1) * each + set : -1;
    },
  };
};
