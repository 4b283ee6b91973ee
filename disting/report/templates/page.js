(() => {
  const data = JSON.parse(document.getElementById("data").textContent);
  const section = document.getElementById("verdicts");
  const panel = document.getElementById("detail");
  const NAMES = ["relation", "by", "representation", "certainty", "domain", "why", "formula"];
  const RELATIONS = ["distinguishable", "indistinguishable", "sometimes", "undecided"];
  const WHERE = { tf: "transfer function", markov: "Markov parameters", structure: "structure", fibre: "one fibre", parameters: "equivalents" };
  const RULES = { exact: "the exact decision", admissible: "positive equivalents" };
  const SIGNS = { exact: "E", admissible: "+" };
  const kind = data.damped ? "damped" : "undamped";
  const folder = `models/${data.masses}-${kind}`;
  const rule = (by) => RULES[by] || `condition ${by}`;
  const byId = (id) => document.getElementById(id);
  const slot = (name) => panel.querySelector(`[data-slot="${name}"]`);
  const said = { above: byId("above"), below: byId("below") };
  const views = () => [said.below.value, said.above.value];
  let selected = null; // models, one or two, and the view: [[2, 5], "exact"]

  // ---- data: entry (high-1)(high-2)/2 + low-1 of a view; negative numbers repeat what is before them
  const size = (data.models * (data.models - 1)) / 2;
  const unpack = (runs) => {
    const found = new Uint32Array(size);
    let at = 0;
    for (const number of runs)
      if (number >= 0) found[at++] = number;
      else found.fill(found[at - 1], at, (at -= number));
    return found;
  };
  const entries = {};
  const entriesOf = (view) => (entries[view] ??= unpack(data.views[view]));
  const relations = data.entries.map((entry) => RELATIONS.indexOf(data.texts[entry[0]]));
  const entry = (i, j, view) => {
    const [low, high] = i < j ? [i, j] : [j, i];
    return entriesOf(view)[((high - 1) * (high - 2)) / 2 + low - 1];
  };
  const verdict = (i, j, view) => {
    const [low, high] = i < j ? [i, j] : [j, i];
    const found = Object.fromEntries(NAMES.map((name, at) => [name, data.texts[data.entries[entry(i, j, view)][at]]]));
    found.why = found.why.replaceAll("{L}", `A${low}`).replaceAll("{R}", `A${high}`);
    return found;
  };
  const short = (v) => (v.by ? `${v.relation}, ${rule(v.by)}` : v.relation);
  const titled = (view) => data.titles[view].toLowerCase();
  const label = (i, j, view) => {
    if (i === j) return `A${i}, the model itself`;
    return `A${Math.min(i, j)} and A${Math.max(i, j)}: ${short(verdict(i, j, view))} (${titled(view)})`;
  };

  // ---- the panel of a pair or of a model
  const draw = (side, number) => {
    const source = document.querySelector(`#row-${number} .chain`);
    const svg = slot(side);
    svg.hidden = !source; // a page of thousands of models has no drawings
    for (const name of ["viewBox", "aria-label", "width"]) if (source) svg.setAttribute(name, source.getAttribute(name));
    svg.firstElementChild.setAttribute("href", `#chain-${number}`);
    const link = slot(`${side}-name`);
    link.textContent = `A${number}`;
    link.href = `${folder}/${number}.html`;
  };
  const put = (texts) => Object.entries(texts).forEach(([name, text]) => (slot(name).textContent = text));
  const fillPair = (low, high, view) => {
    const v = verdict(low, high, view);
    put({ title: `A${low} and A${high}`, badge: v.relation, why: v.why, formula: v.formula, link: "" });
    slot("badge").className = `badge ${v.relation}`;
    slot("where").textContent = v.by ? `by ${rule(v.by)}, ${WHERE[v.representation] || v.representation}` : "";
    slot("certainty").textContent = v.by ? `${v.certainty} Over ${v.domain} parameter values.` : "";
    draw("left", low);
    draw("right", high);
    slot("right-figure").hidden = slot("views").hidden = false;
    for (const other of Object.keys(data.views)) slot(`in-${other}`).textContent = short(verdict(low, high, other));
    byId("status").textContent = `A${low} and A${high}: ${short(v)}. ${v.why}`;
  };
  const fillModel = (model, view) => {
    const others = Array.from({ length: data.models }, (_, i) => i + 1).filter((i) => i !== model);
    const counted = RELATIONS.map((r, at) => [r, others.filter((i) => relations[entry(model, i, view)] === at)]).filter(([, of]) => of.length);
    const words = counted.map(([r, of]) => `${r} from ${of.length}${r === "distinguishable" ? "" : ` (${of.map((i) => `A${i}`).join(", ")})`}`);
    put({ title: `A${model}`, badge: "", where: data.titles[view], why: `Of the other models: ${words.join("; ")}.`, formula: "", certainty: "" });
    slot("badge").className = "badge";
    draw("left", model);
    slot("right-figure").hidden = slot("views").hidden = true;
    const link = document.createElement("a");
    link.href = `${folder}/${model}.html`;
    link.textContent = `Formulas and identifiability of A${model}`;
    slot("link").replaceChildren(link);
    byId("status").textContent = `A${model}. ${slot("why").textContent}`;
  };
  const fill = ([models, view]) => (models.length === 2 ? fillPair(...models, view) : fillModel(models[0], view));
  const hashOf = (models) => (models.length === 2 ? `#${models[0]}-${models[1]}` : `#A${models[0]}`);
  const select = (models, view) => {
    selected = [models, view];
    matrix.pick(models.length === 2 ? models : [models[0], models[0]]);
    fill(selected);
    panel.hidden = false;
    if (location.hash !== hashOf(models)) history.replaceState(null, "", hashOf(models));
    panel.scrollTop = panel.parentElement.scrollTop = 0;
    bring();
  };
  // the field stays in sight: above the sheet on a phone, below the upper edge elsewhere
  const bring = () => {
    const field = matrix.cursor();
    const sheet = getComputedStyle(panel).position === "fixed";
    const [top, bottom] = [60, sheet ? innerHeight - panel.offsetHeight - 20 : innerHeight - 30];
    const by = field.bottom > bottom ? Math.min(field.bottom - bottom + (sheet ? 60 : 0), field.top - top) : field.top < top ? field.top - top : 0;
    scrollBy({ top: by, behavior: "instant" });
  };
  const close = () => {
    if (!selected) return;
    const back = selected[0];
    selected = null;
    matrix.pick(null);
    panel.hidden = true;
    history.replaceState(null, "", location.pathname + location.search);
    matrix.go(back[back.length - 1], back[0], { focus: true });
  };

  const natural = Array.from({ length: data.models }, (_, i) => i + 1);
  const matrix = createMatrix(byId("matrix"), {
    count: data.models,
    order: natural,
    views: views(),
    codes: (view) => Uint8Array.from(entriesOf(view), (number) => relations[number]),
    sign: (i, j, view) => {
      const by = data.texts[data.entries[entry(i, j, view)][1]];
      return SIGNS[by] || by;
    },
    label,
    onMove: (i, j, view) => (byId("readout").textContent = label(i, j, view)),
    onOpen: (i, j, view) => select(i === j ? [i] : [Math.min(i, j), Math.max(i, j)], view),
  });

  // ---- order: groups first, the largest before the others, so that indistinguishable blocks stand on the diagonal
  const grouped = () => {
    const groups = [...data.groups].sort((a, b) => b.length - a.length || a[0] - b[0]);
    const inside = new Set(groups.flat());
    const blocks = [];
    groups.reduce((from, members) => (blocks.push([from, members.length]), from + members.length), 0);
    return [[...groups.flat(), ...natural.filter((i) => !inside.has(i))], blocks];
  };
  for (const radio of section.querySelectorAll('[name="order"]'))
    radio.addEventListener("change", () => matrix.arrange(...(radio.value === "group" ? grouped() : [natural, []])));

  // ---- filter, views, size
  const filter = () => {
    const shown = RELATIONS.map((name) => byId("filter").elements[name].checked);
    const members = byId("group").value ? new Set(data.groups[byId("group").value - 1]) : null;
    matrix.filter((i, j, code) => shown[code] && (!members || (members.has(i) && members.has(j))));
  };
  byId("filter").addEventListener("change", filter);
  byId("filter").addEventListener("submit", (event) => event.preventDefault());
  for (const choice of Object.values(said))
    choice.addEventListener("change", () => {
      matrix.show(views());
      if (selected) fill((selected[1] = choice.value, selected));
    });
  const ZOOM = { out: () => matrix.zoom(1 / 1.5), in: () => matrix.zoom(1.5), fit: matrix.fit };
  section.querySelectorAll("[data-zoom]").forEach((b) => b.addEventListener("click", () => ZOOM[b.dataset.zoom]()));

  // ---- search
  const trouble = (text) => (byId("trouble").textContent = text);
  byId("search").addEventListener("submit", (event) => {
    event.preventDefault();
    trouble("");
    const models = parseModels(byId("find").value);
    if (!models) return trouble(`Type a model such as ${data.masses}:2, or two numbers for a pair.`);
    const masses = models.map((m) => m.masses || models[0].masses || data.masses);
    if (masses.length === 2 && masses[0] !== masses[1]) return trouble("A catalogue compares models of one size.");
    const numbers = [...new Set(models.map((m) => m.number))].sort((a, b) => a - b);
    if (masses[0] !== data.masses) return (location.href = `chains-${masses[0]}-${kind}.html${numbers.length === 2 ? pairHash(numbers) : `#A${numbers[0]}`}`);
    if (!show(numbers)) trouble(`There are the models 1 to ${data.models}.`);
  });

  // ---- deep links #2-5 (or #2:5) to a pair and #A5 to a model
  const show = (numbers) => {
    if (numbers.some((i) => i < 1 || i > data.models) || numbers[0] === numbers[1]) return false;
    matrix.go(numbers[numbers.length - 1], numbers[0]);
    select(numbers, views()[0]);
    return true;
  };
  const follow = () => {
    const found = /^#(?:A(\d+)|(\d+)(?:-|:|%3A)(\d+))$/i.exec(location.hash);
    if (!found) return;
    const numbers = found[1] ? [+found[1]] : [+found[2], +found[3]].sort((a, b) => a - b);
    section.scrollIntoView({ behavior: "instant" });
    show(numbers);
  };
  panel.querySelector(".close").addEventListener("click", close);
  document.addEventListener("keydown", (event) => event.key === "Escape" && close());
  addEventListener("hashchange", follow);
  follow();
})();
