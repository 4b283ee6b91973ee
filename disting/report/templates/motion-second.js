// The values of machine 2 from those of machine 1: by formulas where there are any; else the nearest that are found, at once from
// what was found before, and better ones from further starts while nothing else is to do.
const SAME = 1e-20; // of the cost a line: what rounding leaves where the responses agree
const STARTS = 24, COARSE = 80, REFINED = 3;
const EXACT = { refined: 12, rounds: 500, least: 1e-13 }; // an exact answer may lie at the end of a long valley
const createSecond = (onFound) => {
  let turn = 0, last = null; // what was found last, and for which pair
  const band = (given, values) => { // [rad/s], and as round numbers in Hz
    const parts = partsOf(given, values), [slow, fast] = [1 + given.loose, given.masses].map((which) => frequencyOf(given, parts, which) / (2 * Math.PI));
    const low = roundDown(slow / 5), high = 10 / roundDown(10 / (fast * 3)); // rounded outwards
    return [2 * Math.PI * low, 2 * Math.PI * high];
  };
  const isSame = (task, found) => found.cost < SAME * task.points.length;
  const told = (task, found, how) => ({ ...found, how, most: how === "nearest" ? partedMost(task, found.values) : null });
  // real values of which some are not positive, near those that did the same last, or that come nearest
  const impossible = (task, near) => {
    const found = descended(task, near.map(() => 1), { rounds: 200, way: signed(near) });
    return isSame(task, found) && found.values.some((x) => x <= 0) ? found : null;
  };
  const judged = (task, found, kind) => { // of values that are never exact the nearest are no more than that
    const same = kind !== "never" && isSame(task, found), depends = kind === "sometimes" || kind === "open";
    const real = same ? found : depends ? impossible(task, last.real ?? found.values) : null;
    last = { ...last, values: found.values, cost: found.cost, real: real ? real.values : last.real };
    return real ? told(task, real, real === found ? "same" : "impossible") : told(task, found, "nearest");
  };
  // from what did the same last, and from what was found last; an exact answer is worth more rounds than a near one, and of a new
  // pair something is to be seen at once
  const nearby = (task, kind) => {
    const rounds = last.cost === Infinity ? { rounds: 3 } : kind === "never" ? { rounds: 15, least: 1e-4 } : { rounds: 30, least: 1e-6 };
    let best = null;
    for (const values of [last.real, last.values])
      if (values?.every((x) => x > 0) && !(best && isSame(task, best))) {
        const found = descended(task, values.map(Math.log), rounds);
        if (!best || found.cost < best.cost) best = found;
      }
    return best;
  };
  const search = (mine, task, usual, kind) => {
    const [coarse, fine] = [COARSE, LINES].map((lines) => createTask(task.given, task.values, task.other, task.low, task.high, { lines }));
    const starts = startsOf(task, usual, STARTS), found = [], refined = [], exact = kind !== "never";
    const step = () => {
      if (mine !== turn) return;
      if (starts.length) found.push(descended(coarse, starts.shift(), { rounds: 40, least: 1e-4 }));
      else {
        if (!refined.length) found.sort((a, b) => a.cost - b.cost).splice(exact ? EXACT.refined : REFINED, Infinity, { unknowns: last.values.map(Math.log) });
        refined.push(descended(fine, found.shift().unknowns, exact ? EXACT : {}));
        const best = refined.reduce((a, b) => (b.cost < a.cost ? b : a));
        const done = isSame(fine, best) ? best : !found.length && withoutSpikes(fine, best);
        if (done) return onFound({ ...judged(fine, done, kind), searching: false });
      }
      setTimeout(step);
    };
    setTimeout(step, 250);
  };
  return {
    band,
    // the values now; a search for better ones begins, and what it finds is told. `usual`: of machine 2, where to begin;
    // `kind`: how many positive values of machine 1 have an equivalent there
    follow: ({ given, other, values, usual, kind, pair }) => {
      const mine = ++turn, [low, high] = band(given, values), task = createTask(given, values, other, low, high, { lines: kind === "never" ? COARSE : LINES });
      const explicit = mapped(given, other, values);
      if (explicit) return told(task, { values: explicit, cost: 0 }, "formula");
      if (last?.pair !== pair) last = { pair, values: startOf(task, usual).map(Math.exp), cost: Infinity, real: null };
      const now = judged(task, nearby(task, kind), kind);
      if (now.how !== "same") search(mine, task, usual, kind);
      return { ...now, searching: now.how !== "same" };
    },
  };
};
