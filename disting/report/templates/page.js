(() => {
  const data = JSON.parse(byId("data").textContent);
  const NAMES = ["relation", "by", "representation", "certainty", "domain", "shown", "why", "formula", "rule"];
  const RELATIONS = ["distinguishable", "indistinguishable", "sometimes", "undecided"];
  const kind = data.damped ? "damped" : "undamped";
  const folder = `models/${data.masses}-${kind}`;
  const nameOf = (i) => (data.names ? data.names[i - 1] : `A${i}`); // of general models, or of a catalogue
  const pageOf = (i) => (data.names ? `#model-${i}` : `${folder}/${i}.html`);
  const said = { above: byId("above"), below: byId("below") };
  const views = () => [said.below.value, said.above.value];
  const domain = () => document.querySelector('[name="domain"]:checked').value; // a view: positive, or exact for complex parameters
  const inOrder = (i, j) => (i < j ? [i, j] : [j, i]);

  // ---- data: entry (high-1)(high-2)/2 + low-1 of a view
  const entries = {};
  const entriesOf = (view) => (entries[view] ??= unpacked(data.views[view], (data.models * (data.models - 1)) / 2));
  const relations = data.entries.map((entry) => RELATIONS.indexOf(data.texts[entry[0]]));
  const place = (i, j) => (i > j ? ((i - 1) * (i - 2)) / 2 + j - 1 : ((j - 1) * (j - 2)) / 2 + i - 1);
  const entry = (i, j, view) => entriesOf(view)[place(i, j)];
  const verdict = (i, j, view) => {
    const [low, high] = inOrder(i, j);
    const found = Object.fromEntries(NAMES.map((name, at) => [name, data.texts[data.entries[entry(i, j, view)][at]]]));
    for (const part of ["shown", "why"]) found[part] = found[part].replace(/\{([LR])\}/g, (_, side) => nameOf(side === "L" ? low : high));
    return found;
  };
  const short = (v) => (v.by ? `${data.said[v.relation]}, ${v.rule}` : data.said[v.relation]);
  const label = (i, j, view) => {
    if (i === j) return `${nameOf(i)}, the model itself`;
    return `${inOrder(i, j).map(nameOf).join(" and ")}: ${short(verdict(i, j, view))} (${data.titles[view].toLowerCase()})`;
  };

  // ---- the panel of a pair or of a model
  const draw = (side, number) => {
    const source = document.querySelector(`#row-${number} .chain`);
    const svg = slot(side);
    svg.hidden = !source; // a page of thousands of models has no drawings
    svg.style.display = source ? "" : "none";
    for (const name of ["viewBox", "aria-label", "width"]) if (source) svg.setAttribute(name, source.getAttribute(name));
    svg.firstElementChild.setAttribute("href", `#chain-${number}`);
    const link = slot(`${side}-name`);
    link.textContent = nameOf(number);
    link.href = pageOf(number);
  };
  const linkTo = (href, textContent) => Object.assign(document.createElement("a"), { href, textContent });
  const further = (low, high) => {
    const said = data.next[`${low}-${high}`];
    return said ? `To measure next: ${said}` : "";
  };
  const explain = (v) => { // the algebra below the sentence, and what its symbols mean; open where there is no sentence
    const meant = data.symbols.filter(([pattern]) => new RegExp(pattern, "u").test(`${v.why} ${v.formula}`)).map(([, words]) => words);
    slot("symbols").replaceChildren(...meant.map((words) => Object.assign(document.createElement("li"), { textContent: words })));
    slot("algebra").hidden = false;
    slot("algebra").open = !v.shown;
  };
  const sketches = (pair) => (data.sketches[pair] || []).map(([box, parts, text]) => {
    const figure = document.createElement("figure"), caption = document.createElement("figcaption");
    const svg = slot("left").cloneNode(true);
    for (const name of ["data-slot", "width", "style"]) svg.removeAttribute(name);
    svg.hidden = false;
    svg.setAttribute("viewBox", box);
    svg.setAttribute("aria-label", text);
    svg.replaceChildren(...parts.map((part) => {
      const use = document.createElementNS(svg.namespaceURI, "use");
      use.setAttribute("href", `#${part}`);
      return use;
    }));
    caption.textContent = text;
    caption.setAttribute("aria-hidden", "true"); // the drawing says the same
    figure.append(svg, caption);
    return figure;
  });
  const compare = (numbers, v) => { // both curves, where how they fall is what differs
    const figure = slot("curves"), [svg, caption] = figure.children;
    figure.hidden = !data.chains || v.relation !== "distinguishable" || v.by !== "1";
    if (figure.hidden) return;
    const models = numbers.map((i) => [chainOf(data.masses, data.damped, data.chains[i - 1], data.order), data.values[i - 1]]);
    caption.textContent = twoCurves(svg, models, numbers.map(nameOf));
    figure.hidden = !caption.textContent;
  };
  const takeAway = (low, high, v) => { // the same verdict elsewhere: a command, Python, and a reference to it with its address
    slot("takeaway").hidden = Boolean(data.names);
    if (data.names) return;
    const [left, right] = [low, high].map((i) => `${data.masses}:${i}`);
    put({
      shell: `disting compare ${left} ${right} --${kind}`,
      python: `disting.compare("${left}", "${right}", damped=${data.damped ? "True" : "False"})`,
      cited: `disting ${data.version}: ${left} and ${right}, ${kind}, are ${v.relation} over ${v.domain} parameters. ${location.href.split("#")[0]}${pairHash([low, high])}`,
    });
    for (const button of slot("takeaway").querySelectorAll("[data-copy]")) button.textContent = "Copy";
  };
  const fillPair = (low, high, view) => {
    const v = verdict(low, high, view);
    put({ title: `${nameOf(low)} and ${nameOf(high)}`, badge: data.said[v.relation], shown: v.shown, why: v.why, formula: v.formula, link: "", next: further(low, high) });
    explain(v);
    compare([low, high], v);
    slot("sketches").replaceChildren(...sketches(`${low}-${high}`));
    slot("badge").className = `badge ${v.relation}`;
    slot("where").textContent = `over ${v.domain} parameters${v.by ? ` (${v.rule})` : ""}`;
    slot("certainty").textContent = v.by ? v.certainty : "";
    takeAway(low, high, v);
    if (data.motion) slot("link").replaceChildren(linkTo(`${data.motion}#A${low}-A${high}`, "Both machines in motion"));
    draw("left", low);
    draw("right", high);
    slot("right-figure").hidden = slot("views").hidden = false;
    for (const other of Object.keys(data.views)) slot(`in-${other}`).textContent = short(verdict(low, high, other));
    byId("status").textContent = `${nameOf(low)} and ${nameOf(high)}: ${short(v)}. ${v.shown || v.why}`;
  };
  const fillModel = (model, view) => {
    const others = Array.from({ length: data.models }, (_, i) => i + 1).filter((i) => i !== model);
    const counted = RELATIONS.map((r, at) => [r, others.filter((i) => relations[entry(model, i, view)] === at)]).filter(([, of]) => of.length);
    const words = counted.map(([r, of]) => `${data.said[r]} from ${of.length}${r === "distinguishable" ? "" : ` (${of.map(nameOf).join(", ")})`}`);
    put({ title: nameOf(model), badge: "", where: data.titles[view], shown: `Of the other models: ${words.join("; ")}.`, why: "", formula: "", certainty: "", next: "" });
    slot("sketches").replaceChildren();
    slot("badge").className = "badge";
    draw("left", model);
    slot("right-figure").hidden = slot("curves").hidden = slot("views").hidden = slot("algebra").hidden = slot("takeaway").hidden = true;
    slot("link").replaceChildren(linkTo(pageOf(model), `Formulas and identifiability of ${nameOf(model)}`));
    byId("status").textContent = `${nameOf(model)}. ${slot("shown").textContent}`;
  };
  const fill = ({ models, view }) => (models.length === 2 ? fillPair(...models, view) : fillModel(models[0], view));
  const select = (models, view) => bench.select({ models, view, address: models.length === 2 ? pairHash(models) : `#A${models[0]}` });

  const natural = Array.from({ length: data.models }, (_, i) => i + 1);
  const matrix = createMatrix(byId("matrix"), {
    order: natural,
    views: views(),
    name: (i) => { // at the edges there is room for some letters only
      const letters = [...nameOf(i)];
      return letters.length > 16 ? `${letters.slice(0, 15).join("")}…` : letters.join("");
    },
    relation: (view) => {
      const codes = Uint8Array.from(entriesOf(view), (number) => relations[number]);
      return (i, j) => codes[place(i, j)];
    },
    sign: (i, j, view) => {
      return data.signs[data.texts[data.entries[entry(i, j, view)][1]]] || "";
    },
    label,
    onMove: (i, j, view) => (byId("readout").textContent = label(i, j, view)),
    onOpen: (i, j, view) => select(i === j ? [i] : inOrder(i, j), view),
  });
  const grouped = () => { // related groups beside each other, in frames; then all others
    const inside = new Set(data.blocks[domain()].flat()), frames = [];
    data.blocks[domain()].reduce((from, members) => (members.length > 1 && frames.push([from, members.length, ""]), from + members.length), 0);
    return [[...data.blocks[domain()].flat(), ...natural.filter((i) => !inside.has(i))], frames];
  };
  const arrange = () => matrix.arrange(...(document.querySelector('[name="order"]:checked').value === "group" ? grouped() : [natural, []]));
  for (const radio of document.querySelectorAll('[name="order"]')) radio.addEventListener("change", arrange);

  // ---- filter and views
  const filter = () => {
    const shown = RELATIONS.map((name) => byId("filter").elements[name].checked);
    const members = byId("group").value ? new Set(data.groups[domain()][byId("group").value - 1]) : null;
    matrix.filter((i, j, code) => shown[code] && (!members || (members.has(i) && members.has(j))));
  };
  const offerGroups = () => {
    const named = (of) => `${of.slice(0, 6).map(nameOf).join(data.names ? ", " : " ")}${of.length > 6 ? " …" : ""}`;
    byId("group").replaceChildren(new Option("all", ""), ...data.groups[domain()].map((of, at) => new Option(`${at + 1}: ${named(of)}`, at + 1)));
  };
  byId("filter").addEventListener("change", filter);
  for (const choice of Object.values(said))
    choice.addEventListener("change", () => {
      matrix.show(views());
      bench.again({ view: choice.value });
    });

  // ---- the domain: what is said, the groups, and which view is below the diagonal
  for (const radio of document.querySelectorAll('[name="domain"]'))
    radio.addEventListener("change", () => {
      document.documentElement.dataset.domain = domain();
      [said.below.value, said.above.value] = [domain(), domain() === "exact" ? "positive" : "exact"];
      offerGroups();
      arrange();
      filter();
      matrix.show(views());
      bench.again({ view: domain() });
    });
  offerGroups();

  // ---- what is typed, and deep links #2-5 (or #2:5) to a pair and #A5 to a model
  const there = (numbers) => numbers.every((i) => i >= 1 && i <= data.models) && numbers[0] !== numbers[1];
  const show = (numbers) => {
    matrix.go(numbers[numbers.length - 1], numbers[0]);
    select(numbers, views()[0]);
  };
  const findByName = (text) => { // in full, or its beginning
    const names = data.names.map((name) => name.toLowerCase());
    const number = (word) => 1 + (names.includes(word) ? names.indexOf(word) : names.findIndex((name) => word && name.startsWith(word)));
    const whole = number(text.trim().toLowerCase()); // a name may have a comma of its own
    const found = whole ? [whole] : [...new Set(text.split(/[,;/]/).map((part) => number(part.trim().toLowerCase())))];
    if (found.length > 2 || found.includes(0)) return "Type the name of a model, or two names with a comma between them.";
    show(found.sort((a, b) => a - b));
    return "";
  };
  const find = (text) => {
    if (data.names) return findByName(text);
    const models = parseModels(text);
    if (!models) return `Type a model such as ${data.masses}:2, or two numbers for a pair.`;
    const masses = models.map((m) => m.masses || models[0].masses || data.masses);
    const elsewhere = answeredBy(models, masses[0], kind);
    if (elsewhere) return elsewhere;
    const numbers = [...new Set(models.map((m) => m.number))].sort((a, b) => a - b);
    if (models.some((m) => m.dampers)) {
      if (!data.dampers) return "This catalogue has no dampers to the ground.";
      location.href = `dampers-${masses[0]}-${kind}.html${damperHash(models)}`;
    } else if (masses[0] !== data.masses) location.href = `chains-${masses[0]}-${kind}.html${numbers.length === 2 ? pairHash(numbers) : `#A${numbers[0]}`}`;
    else if (there(numbers)) show(numbers);
    else return `There are the models 1 to ${data.models}.`;
    return "";
  };
  const follow = (hash) => {
    const found = /^#(?:A(\d+)|(\d+)(?:-|:|%3A)(\d+))$/i.exec(hash);
    if (!found) return null;
    const numbers = found[1] ? [+found[1]] : inOrder(+found[2], +found[3]);
    return there(numbers) ? () => show(numbers) : null;
  };
  const bench = createBench(matrix, { fill, follow });
  bench.search(find);
  bench.follow();
})();
