(() => {
  const data = JSON.parse(byId("data").textContent);
  const classes = createClasses(data), models = createModels(data, classes), fill = createDamperPanel(data, classes, models);
  const kind = data.damped ? "damped" : "undamped", each = data.sets.length;

  // ---- the matrix: all models or some, by number or by group
  const only = byId("only");
  const shown = () => {
    const [what, which] = only.value.split("-");
    return { structure: () => models.ofStructure(+which), group: () => classes.members[which - 1], all: () => models.all }[what]();
  };
  const byStructure = (order) => {
    const blocks = [], of = models.structure;
    order.forEach((i, at) => (at && of(order[at - 1]) === of(i) ? blocks[blocks.length - 1][1]++ : blocks.push([at, 1, `A${of(i)}`])));
    return [order, blocks.filter(([, count]) => count > 1)];
  };
  const arrange = () => {
    const order = shown(), inside = new Set(order);
    const groups = classes.members.slice(0, data.several).map((of) => of.filter((i) => inside.has(i))).filter((of) => of.length > 1);
    const grouped = document.querySelector('[name="order"]:checked').value === "group";
    matrix.arrange(...(grouped ? byGroup(groups, order, ([i]) => `group ${classes.group(i) + 1}`) : byStructure(order)));
  };
  const restrict = (to) => {
    if (only.value === to) return;
    only.value = to;
    arrange();
  };
  const goPair = (i, j) => {
    if (!matrix.has(i) || !matrix.has(j)) restrict("all");
    matrix.go(j, i);
    selectPair(i, j);
  };
  const selectPair = (i, j) => bench.select(i === j ? { model: i, models: [i], address: damperHash([models.typed(i)]) } : { pair: [i, j], models: [i, j], address: damperHash([models.typed(i), models.typed(j)]) });
  const goStructure = (s) => {
    document.querySelector('[name="order"][value="number"]').checked = true;
    only.value = "all";
    arrange();
    matrix.go((s - 1) * each + 1, (s - 1) * each);
    matrix.span((s - 1) * each, each);
    bench.select({ structure: s, models: models.ofStructure(s), address: `#A${s}` });
  };
  const goGroup = (g) => {
    restrict(`group-${g + 1}`);
    bench.select({ group: g, models: [], address: `#group-${g + 1}` });
  };
  const options = (title, entries) => {
    const found = Object.assign(document.createElement("optgroup"), { label: title });
    found.append(...entries.map(([value, text]) => new Option(text, value)));
    only.append(found);
  };
  options("One structure with all its sets", data.structures.map((_, at) => [`structure-${at + 1}`, `A${at + 1}`]));
  options("One group", classes.members.slice(0, data.several).map((of, g) => [`group-${g + 1}`, `${g + 1}: ${of.slice(0, 3).map(models.name).join(" ")}${of.length > 3 ? ` … (${of.length})` : ""}`]));
  const matrix = createMatrix(byId("matrix"), {
    order: models.all,
    blocks: byStructure(models.all)[1],
    views: ["classes", "classes"],
    name: models.name,
    relation: () => classes.relation,
    sign: (i, j) => data.rules[classes.rule(i, j)][0],
    label: models.label,
    onMove: (i, j) => (byId("readout").textContent = models.label(i, j)),
    onOpen: (i, j) => selectPair(Math.min(i, j), Math.max(i, j)),
  });
  only.addEventListener("change", arrange);
  for (const radio of document.querySelectorAll('[name="order"]')) radio.addEventListener("change", arrange);
  byId("relations").addEventListener("change", () => {
    const lit = RELATIONS.map((relation) => byId("filter").elements[relation]?.checked);
    matrix.filter((i, j, code) => lit[code]);
  });

  // ---- what is typed, and deep links #17+b1+b3/20+b2 to a pair, #17+b1 to a model, #A17 to a structure, #group-3
  const go = (named) => {
    if (named.length === 1 && !named[0].dampers) return goStructure(named[0].number);
    const [i, j] = [named[0], named[named.length - 1]].map(models.place).sort((a, b) => a - b);
    goPair(i, j);
  };
  const seek = (text) => {
    const named = parseModels(text);
    if (!named) return { trouble: `Type a structure such as ${data.masses}:2, a model such as 2+b1, or two models for a pair.` };
    const masses = named[0].masses || data.masses;
    const here = named.every((m) => (m.masses || masses) === data.masses && !m.late.length && models.place(m) >= 0);
    return here ? { show: () => go(named) } : addressOf(named, masses, kind, data.families, true);
  };
  const follow = (hash) => {
    const group = /^#group-(\d+)$/.exec(hash);
    if (!group) return namedBy(hash) ? seek(namedBy(hash)) : null;
    return +group[1] >= 1 && +group[1] <= data.several ? { show: () => goGroup(group[1] - 1) } : { trouble: `There is no group ${group[1]}: the groups are 1 to ${data.several}.` };
  };
  const bench = createBench(matrix, { fill, seek, follow });
  bench.follow();
})();
