// Fills the panel of what is selected: a pair, a model, a structure with all its sets, or a group.
const createDamperPanel = (data, classes, models) => {
  const { setOf, structure, name, spelled } = models;
  const number = (n) => n.toLocaleString("en");
  const plural = (n, one) => `${number(n)} ${one}${n === 1 ? "" : "s"}`;
  const collected = (pairs) => pairs.reduce((found, [key, value]) => found.set(key, [...(found.get(key) || []), value]), new Map());
  const runs = (members) => { // "A17, A19: 1, 1+3; A20: 0"
    const sets = [...collected(members.map((i) => [structure(i), spelled(i)]))].map(([s, of]) => [of.join(", "), `A${s}`]);
    return [...collected(sets)].map(([of, structures]) => `${structures.join(", ")}: ${of}`).join("; ");
  };
  const link = (text, href) => Object.assign(document.createElement("a"), { textContent: text, href });
  const groupLink = (g) => Object.assign(link(g + 1, `#group-${g + 1}`), { ariaLabel: `Group ${g + 1}` });
  const draw = (side, s, set) => {
    const figure = slot(`${side}-figure`), svg = slot(side), source = document.querySelector(`#row-${s} .chain`);
    const [, , width, low] = source.getAttribute("viewBox").split(" ");
    const parts = [`#chain-${s}`, ...set.map((m) => `#ground-${m}`)];
    svg.replaceChildren(...parts.map((part) => {
      const use = document.createElementNS(svg.namespaceURI, "use");
      use.setAttribute("href", part);
      return use;
    }));
    svg.setAttribute("viewBox", `0 0 ${width} ${set.length ? data.tall : low}`);
    svg.setAttribute("width", width);
    svg.setAttribute("aria-label", [source.getAttribute("aria-label").replace(/\.$/, ""), ...set.map((m) => `damper from mass ${m} to the ground`)].join("; "));
    const caption = slot(`${side}-name`);
    caption.textContent = `A${s}${damperSet(set)}`;
    if (data.catalog) caption.href = `models/${data.masses}-${data.damped ? "damped" : "undamped"}/${s}.html`;
    figure.hidden = false;
  };
  const show = (...names) => ["left-figure", "right-figure", "facts", "command"].forEach((part) => (slot(part).hidden = !names.includes(part)));
  const NOT_ASKED = "Positive parameters are not asked here; the command below asks.";
  const REASONS = {
    distinguishable: (rule) => (rule === data.links.exact ? "No necessary condition separates them, but the exact decision does: with generic parameters, complex or positive, at least one of them has a transfer function that the other cannot have." : `Indistinguishable models must have this in common: ${data.rules[rule][2]}. These two have not.`),
    indistinguishable: (rule) => (rule === data.links.exact ? `The exact decision links them, directly or through other models of their group: over complex parameters they can have the very same transfer function. ${NOT_ASKED}` : `${data.rules[rule][2][0].toUpperCase()}${data.rules[rule][2].slice(1)}. So over complex parameters they can have the very same transfer function. ${NOT_ASKED}`),
    undecided: () => "Neither the conditions nor the exact decision settled their groups in the time that was given. With more time the command below may.",
  };
  const fact = (i) => {
    const [, , own] = data.structures[structure(i) - 1];
    const row = document.createElement("tr"), head = Object.assign(document.createElement("th"), { scope: "row" });
    head.append(...name(i).split(/(?=\+)/).flatMap((part) => [document.createElement("wbr"), part])); // breaks before a damper only
    const g = classes.group(i), group = document.createElement("td");
    group.append(g < data.several ? groupLink(g) : "alone");
    row.append(head, group, ...[own + setOf(i).length, classes.rank(i)].map((n) => Object.assign(document.createElement("td"), { className: "n", textContent: n })));
    return row;
  };
  const facts = (...of) => slot("facts").tBodies[0].replaceChildren(...of.map(fact));
  const command = (...words) => { // a line breaks between words only
    const all = ["disting", ...words, data.damped ? "--damped" : "--undamped"];
    slot("text").replaceChildren(...all.flatMap((word, at) => [at ? " " : "", Object.assign(document.createElement("span"), { textContent: word })]));
  };
  const members = (g) => (g < data.several ? `Group ${g + 1}, ${plural(classes.members[g].length, "model")}: ${runs(classes.members[g])}.` : "");
  const fillPair = (i, j) => {
    const relation = RELATIONS[classes.relation(i, j)], rule = classes.rule(i, j);
    put({ title: `${name(i)} and ${name(j)}`, badge: relation, where: rule ? `over complex parameters, by ${data.rules[rule][1]}` : "", why: REASONS[relation](rule) });
    command("compare", models.onCommandLine(i), models.onCommandLine(j));
    put({ members: relation === "indistinguishable" ? members(classes.group(i)) : "" });
    facts(i, j);
    draw("left", structure(i), setOf(i));
    draw("right", structure(j), setOf(j));
    show("left-figure", "right-figure", "facts", "command");
  };
  const fillModel = (i) => {
    const found = RELATIONS.map(() => 0);
    for (const j of models.all) if (j !== i) found[classes.relation(i, j)]++;
    const words = RELATIONS.map((relation, code) => [relation, found[code]]).filter(([, n]) => n).map(([relation, n]) => `${relation} from ${number(n)}`);
    put({ title: name(i), badge: "", where: "", why: `Of the other models, over complex parameters: ${words.join("; ")}.`, members: members(classes.group(i)) });
    facts(i);
    draw("left", structure(i), setOf(i));
    show("left-figure", "facts");
  };
  const fillStructure = (s) => {
    const own = collected(models.ofStructure(s).map((i) => [classes.group(i), spelled(i)]));
    const same = [...own.values()].filter((sets) => sets.length > 1).map((sets) => sets.join(" = "));
    put({ title: `A${s} with all sets of dampers`, badge: "", where: plural(models.ofStructure(s).length, "model"), members: same.length ? `Indistinguishable over complex parameters: ${same.join("; ")}.` : "" });
    const groups = [...own.keys()], open = groups.flatMap((a, k) => groups.slice(k + 1).filter((b) => classes.undecided(a, b))).length;
    const apart = open ? `; ${plural(open, "pair")} of these ${open === 1 ? "is" : "are"} undecided, all others are distinguishable` : groups.length > 1 ? " that are distinguishable" : "";
    put({ why: `Its ${data.sets.length} sets of dampers to the ground fall into ${plural(groups.length, "group")}${apart}. A set is written by its masses, 0 is none.` });
    command("dampers", `${data.masses}:${s}`, "--sets all");
    draw("left", s, []);
    show("left-figure", "command");
  };
  const fillGroup = (g) => {
    put({ title: `Group ${g + 1}`, badge: "indistinguishable", where: plural(classes.members[g].length, "model"), why: "Over complex parameters these models have the same transfer functions; positive ones are not asked here.", members: `${runs(classes.members[g])}.` });
    show();
  };
  return ({ pair, model, structure: s, group: g }) => {
    const tasks = [[pair, () => fillPair(...pair)], [model, () => fillModel(model)], [s, () => fillStructure(s)], [g, () => fillGroup(g)]];
    tasks.find(([given]) => given !== undefined)[1]();
    slot("badge").className = `badge ${slot("badge").textContent}`;
    byId("status").textContent = ["title", "badge", "where", "why"].map((part) => slot(part).textContent).filter(Boolean).join(". ");
  };
};
