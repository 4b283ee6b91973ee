// Which models are limits of others, on a page that tells it (data.limits): of each pair a kind, a sentence and a reason; `place` and
// `entry` are those of the verdicts.
const createLimits = ({ limits, models }, place) => {
  const TURNED = [0, 2, 1, 3, 4], of = unpacked(limits.of, (models * (models - 1)) / 2);
  const entry = (i, j) => limits.entries[of[place(i, j)]];
  return {
    kind: (i, j) => entry(i, j)[0],
    sign: (row, column) => limits.signs[column < row ? entry(row, column)[0] : TURNED[entry(row, column)[0]]], // the column's model in the row's
    short: (i, j) => limits.short[entry(i, j)[0]],
    sentence: (i, j) => entry(i, j)[1],
    why: (i, j) => entry(i, j)[2],
  };
};
