(() => {
  const data = JSON.parse(byId("data").textContent);
  const NAMES = ["relation", "by", "representation", "certainty", "domain", "shown", "why", "formula", "rule", "more", "aside"];
  const RELATIONS = ["distinguishable", "indistinguishable", "sometimes", "undecided"];
  const names = createNames(data), nameOf = names.name;
  const said = { above: byId("above"), below: byId("below") };
  const views = () => [said.below.value, said.above.value];
  const domain = () => document.querySelector('[name="domain"]:checked').value; // a view: positive, or exact for complex parameters
  const inOrder = (i, j) => (i < j ? [i, j] : [j, i]);

  // ---- data: entry (high-1)(high-2)/2 + low-1 of a view
  const entries = {};
  const entriesOf = (view) => (entries[view] ??= unpacked(data.views[view], (data.models * (data.models - 1)) / 2));
  const LIMITS = { 1: 4, 2: 4, 4: 5 }; // distinguishable models of two sizes: one is a limit of the other, or that is not known; by their kind, the painter's colour
  const relations = data.entries.map((entry) => RELATIONS.indexOf(data.texts[entry[0]]));
  const place = (i, j) => (i > j ? ((i - 1) * (i - 2)) / 2 + j - 1 : ((j - 1) * (j - 2)) / 2 + i - 1);
  const limits = data.limits ? createLimits(data, place) : null;
  const entry = (i, j, view) => entriesOf(view)[place(i, j)];
  const named = (text, low, high) => text.replace(/\{([LR])\}/g, (_, side) => nameOf(side === "L" ? low : high));
  const verdict = (i, j, view) => {
    const [low, high] = inOrder(i, j);
    const found = Object.fromEntries(NAMES.map((name, at) => [name, data.texts[data.entries[entry(i, j, view)][at]]]));
    for (const part of ["shown", "why", "more"]) found[part] = named(found[part], low, high);
    return found;
  };
  const short = (v) => (v.by ? `${data.said[v.relation]}, ${v.rule}` : data.said[v.relation]);
  const label = (i, j, view) => {
    if (i === j) return `${nameOf(i)}, the model itself`;
    const inside = limits?.short(i, j);
    return `${inOrder(i, j).map(nameOf).join(" and ")}: ${short(verdict(i, j, view))} (${data.titles[view].toLowerCase()})${inside ? `; ${named(inside, ...inOrder(i, j))}` : ""}`;
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
    link.textContent = data.numbered ? `${nameOf(number)}: ${data.names[number - 1]}` : nameOf(number);
    if (names.page(number)) link.href = names.page(number);
    else link.removeAttribute("href"); // of a size whose pages are not beside this one
  };
  const linkTo = (href, textContent) => Object.assign(document.createElement("a"), { href, textContent });
  const further = (low, high) => {
    const said = data.next[`${low}-${high}`];
    return said ? `To measure next: ${said}` : "";
  };
  const explain = (v) => { // the algebra below the sentence, and what its symbols mean; open where there is no sentence
    const meant = data.symbols.filter(([pattern]) => new RegExp(pattern, "u").test(`${v.why} ${v.more} ${v.formula}`)).map(([, words]) => words);
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
    const models = numbers.map((i) => [chainOf(names.masses(i), data.damped, data.chains[i - 1], data.order), data.values[i - 1]]);
    caption.textContent = twoCurves(svg, models, numbers.map(nameOf));
    figure.hidden = !caption.textContent;
  };
  const known = (numbers) => numbers.flatMap((i) => (data.known?.[i] ? [data.known[i].replace("{0}", nameOf(i))] : [])).join(" "); // before any "distinguishable": what cannot be determined
  const takeAway = (low, high, v, view) => { // the same verdict elsewhere: a command, Python, and a reference to it with its address
    slot("takeaway").hidden = Boolean(data.names && !data.numbered);
    if (slot("takeaway").hidden) return;
    const quoted = (text) => (data.names ? `"${text}"` : text), damping = data.names ? "" : ` --${data.damped ? "damped" : "undamped"}`;
    const [left, right] = [low, high].map(names.typed);
    const why = data.texts[data.entries[entry(low, high, view)][NAMES.indexOf("why")]].replace(/\{([LR])\}/g, (_, side) => (side === "L" ? left : right));
    const cited = `${left} and ${right}${data.names ? "" : `, ${data.premise},`} are ${data.said[v.relation]} over ${v.domain} parameters${v.aside}${v.by ? ` (${v.rule})` : ""}: ${why} ${v.certainty}`.trim();
    put({
      shell: `disting compare ${quoted(left)} ${quoted(right)}${damping}`,
      python: `disting.compare("${left}", "${right}"${data.names ? "" : `, damped=${data.damped ? "True" : "False"}`})`,
      cited: `disting ${data.version}: ${cited} ${location.href.split("#")[0]}${names.hash([low, high])}`,
    });
    for (const button of slot("takeaway").querySelectorAll("[data-copy]")) button.textContent = "Copy";
  };
  const fillPair = (low, high, view) => {
    const v = verdict(low, high, view);
    put({ title: `${nameOf(low)} and ${nameOf(high)}`, badge: data.said[v.relation], shown: `${v.relation === "distinguishable" ? known([low, high]) : ""} ${v.shown}`.trim(), why: `${v.why} ${v.more}`.trim(), formula: v.formula, link: "", next: further(low, high) });
    explain(v);
    compare([low, high], v);
    slot("sketches").replaceChildren(...sketches(`${low}-${high}`));
    slot("badge").className = `badge ${v.relation}`;
    slot("where").textContent = `over ${v.domain} parameters${v.by ? ` (${v.rule})` : ""}`;
    slot("certainty").textContent = v.by ? v.certainty : "";
    if (limits) put({ limit: named(limits.sentence(low, high), low, high), reason: named(limits.why(low, high), low, high) });
    if (limits) slot("limits").hidden = !limits.why(low, high);
    takeAway(low, high, v, view);
    const catalogue = names.catalogue(low, high);
    if (catalogue) slot("link").replaceChildren(linkTo(catalogue, "This pair in the catalogue of its size"));
    if (data.motion) slot("link").replaceChildren(linkTo(`${data.motion}#A${low}-A${high}`, "Both machines in motion"));
    draw("left", low);
    draw("right", high);
    slot("right-figure").hidden = slot("views").hidden = false;
    for (const other of Object.keys(data.views)) slot(`in-${other}`).textContent = short(verdict(low, high, other));
    byId("status").textContent = `${nameOf(low)} and ${nameOf(high)}: ${short(v)}. ${slot("shown").textContent || v.why} ${limits ? slot("limit").textContent : ""}`.trim();
  };
  const fillLimits = (model, others) => { // of two sizes
    const smaller = (i) => names.masses(i) < names.masses(model), larger = (i) => names.masses(i) > names.masses(model);
    const count = (which, kind) => others.filter((i) => which(i) && limits.kind(i, model) === kind).length;
    const said = (which, what) => (others.some(which) ? `${what(count(which, 1), others.filter(which).length)}${count(which, 4) ? `, of ${count(which, 4)} it is not known` : ""}.` : "");
    const words = [said(smaller, (n, of) => `${n} of the ${of} smaller models are limits of it`), said(larger, (n, of) => `It is a limit of ${n} of the ${of} larger models`)];
    put({ limit: ["Over complex parameters:", ...words].join(" "), reason: "" });
    slot("limits").hidden = true;
  };
  const fillModel = (model, view) => {
    const others = Array.from({ length: data.models }, (_, i) => i + 1).filter((i) => i !== model);
    const counted = RELATIONS.map((r, at) => [r, others.filter((i) => relations[entry(model, i, view)] === at)]).filter(([, of]) => of.length);
    const words = counted.map(([r, of]) => `${data.said[r]} from ${of.length}${r === "distinguishable" ? "" : ` (${of.map(nameOf).join(", ")})`}`);
    put({ title: nameOf(model), badge: "", where: data.titles[view], shown: `${known([model])} Of the other models: ${words.join("; ")}.`.trim(), why: "", formula: "", certainty: "", next: "" });
    slot("sketches").replaceChildren();
    slot("badge").className = "badge";
    draw("left", model);
    slot("right-figure").hidden = slot("curves").hidden = slot("views").hidden = slot("algebra").hidden = slot("takeaway").hidden = true;
    if (limits) fillLimits(model, others);
    slot("link").replaceChildren(...(names.page(model) ? [linkTo(names.page(model), `Formulas and identifiability of ${nameOf(model)}`)] : []));
    byId("status").textContent = `${nameOf(model)}. ${slot("shown").textContent}`;
  };
  const fill = ({ models, view }) => (models.length === 2 ? fillPair(...models, view) : fillModel(models[0], view));
  const select = (models, view) => bench.select({ models, view, address: names.hash(models) });

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
      if (!limits) return (i, j) => codes[place(i, j)];
      return (i, j) => codes[place(i, j)] || (names.masses(i) === names.masses(j) ? 0 : LIMITS[limits.kind(i, j)] || 0);
    },
    sign: (i, j, view) => {
      return limits?.sign(i, j) || data.signs[data.texts[data.entries[entry(i, j, view)][1]]] || "";
    },
    label,
    onMove: (i, j, view) => (byId("readout").textContent = label(i, j, view)),
    onOpen: (i, j, view) => select(i === j ? [i] : inOrder(i, j), view),
  });
  const shown = () => { // all models, or those of one or two sizes
    const sizes = (byId("only")?.value || "").split("-").filter(Boolean).map(Number);
    return sizes.length ? natural.filter((i) => sizes.includes(names.masses(i))) : natural;
  };
  const grouped = (order) => { // related groups beside each other, in frames; then all others
    const some = new Set(order), frames = [], blocks = data.blocks[domain()].map((members) => members.filter((i) => some.has(i)));
    blocks.reduce((from, members) => (members.length > 1 && frames.push([from, members.length, ""]), from + members.length), 0);
    return [[...new Set([...blocks.flat(), ...order])], frames];
  };
  const bySize = (order) => { // the models of one size in a frame; lines between sizes cross the whole square
    const frames = [];
    order.forEach((i, at) => (at && names.masses(order[at - 1]) === names.masses(i) ? frames[frames.length - 1][1]++ : frames.push([at, 1, ""])));
    for (const frame of frames) frame[2] = `${nameOf(order[frame[0]])}${frame[1] > 1 ? `–${frame[1]}` : ""}`;
    return [order, frames, frames.slice(1).map(([from]) => from)];
  };
  const byNumber = limits ? bySize : (order) => [order, []];
  const arrange = () => matrix.arrange(...(document.querySelector('[name="order"]:checked').value === "group" ? grouped : byNumber)(shown()));
  for (const radio of document.querySelectorAll('[name="order"]')) radio.addEventListener("change", arrange);

  // ---- filter and views
  const filter = () => {
    const shown = RELATIONS.map((name) => byId("filter").elements[name].checked);
    const members = byId("group").value ? new Set(data.groups[domain()][byId("group").value - 1]) : null;
    const kinds = byId("limit")?.value; // of inclusion, a digit each
    matrix.filter((i, j, code) => shown[code > 3 ? 0 : code] && (!members || (members.has(i) && members.has(j))) && (!kinds || kinds.includes(limits.kind(i, j))));
  };
  const offerGroups = () => {
    const named = (of) => `${of.slice(0, 6).map(nameOf).join(data.names ? ", " : " ")}${of.length > 6 ? " …" : ""}`;
    byId("group").replaceChildren(new Option("all", ""), ...data.groups[domain()].map((of, at) => new Option(`${at + 1}: ${named(of)}`, at + 1)));
  };
  byId("filter").addEventListener("change", filter);
  byId("only")?.addEventListener("change", arrange);
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

  // ---- what is typed, and deep links to a pair, such as #2-5 or #2:1-3:4, and to a model, such as #A5 or #3:5
  const show = (numbers) => {
    if (!numbers.every(matrix.has)) {
      byId("only").value = "";
      arrange();
    }
    matrix.go(numbers[numbers.length - 1], numbers[0]);
    select(numbers, views()[0]);
  };
  const asked = (found) => (found?.models ? { show: () => show(found.models) } : found);
  const bench = createBench(matrix, { fill, seek: (text) => asked(names.seek(text)), follow: (hash) => asked(names.follow(hash)) });
  if (limits) arrange();
  bench.follow();
})();
