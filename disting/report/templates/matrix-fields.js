// The fields as keys: 0 on the diagonal, else 1 + relation, and KINDS more where the filter lets it through. A level has half the
// side of the one before it: of four fields the largest key wins, the rarer relation, so that no field of millions is lost.
const KINDS = 6; // of colours, see the painter
const createFields = (state, source) => {
  let levels = [];
  const keysOf = () => {
    const { order, views, lit } = state, n = order.length;
    const keys = new Uint8Array(n * n);
    const fill = (view, at) => {
      const relation = source.relation(view);
      for (let row = 1; row < n; row++)
        for (let col = 0; col < row; col++) {
          const i = order[row], j = order[col], code = relation(i, j);
          keys[at(row, col, n)] = 1 + code + (lit(i, j, code) ? KINDS : 0);
        }
    };
    fill(views[0], (row, col) => row * n + col);
    if (views[0] !== views[1]) fill(views[1], (row, col) => col * n + row);
    else for (let row = 1; row < n; row++) for (let col = 0; col < row; col++) keys[col * n + row] = keys[row * n + col];
    return { size: n, keys };
  };
  const merged = ({ size, keys }) => {
    const half = Math.ceil(size / 2), found = new Uint8Array(half * half);
    for (let row = 0; row < size; row++)
      for (let col = 0; col < size; col++) {
        const at = (row >> 1) * half + (col >> 1), key = keys[row * size + col];
        if (key > found[at]) found[at] = key;
      }
    return { size: half, keys: found };
  };
  const level = (k) => (levels[k] ??= k ? merged(level(k - 1)) : keysOf());
  return {
    level,
    reset: () => (levels = []),
    visit: (r0, r1, c0, c1, act) => {
      const { size, keys } = level(0);
      for (let row = r0; row < r1; row++)
        for (let col = c0; col < c1; col++) {
          const key = keys[row * size + col];
          if (row !== col) act(row, col, (key - 1) % KINDS, key > KINDS);
        }
    },
  };
};
