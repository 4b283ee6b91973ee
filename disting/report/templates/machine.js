// From a description of a machine to its model. A description is [gap, act-, act+, meas-, meas+]; 0 is the ground.
(() => {
  const SCALE = 1.3; // of the drawing, where there is room
  const catalogues = JSON.parse(document.getElementById("machines").textContent);
  const form = document.getElementById("machine");
  if (!form) return;
  const { masses, dampers, gap, force, sensor } = form.elements;
  const slot = (name) => form.querySelector(`[data-slot="${name}"]`);
  const mass = (i) => (i ? `mass ${i}` : "the ground");
  const between = (i) => (i < 9 ? `${i}${i + 1}` : `${i}_${i + 1}`);
  const upTo = (first, last) => Array.from({ length: last - first + 1 }, (_, k) => first + k);
  const catalogue = () => catalogues.find((c) => c.masses === +masses.value && c.damped === (dampers.value === "damped"));

  // ---- the choices: (36) and (37), in words
  const choose = (select, value) => {
    if ([...select.options].some((option) => option.value === value)) select.value = value;
  };
  const offer = (select, choices, near = "") => { // what was chosen stays, or something near it
    const before = select.value;
    select.replaceChildren(...choices.map(([value, text]) => new Option(text, value)));
    choose(select, near);
    choose(select, before);
  };
  const offerDampers = () => {
    const kinds = [["damped", "at each spring"], ["undamped", "none"]];
    offer(dampers, kinds.filter(([kind]) => catalogues.some((c) => c.masses === +masses.value && c.damped === (kind === "damped"))));
  };
  const offerGap = () => offer(gap, upTo(0, +masses.value - 1).map((g) => [`${g}`, g ? `between ${mass(g)} and ${mass(g + 1)}` : "none between masses: a free row"]));
  const offerPorts = () => {
    const references = +gap.value ? upTo(1, +gap.value) : [0];
    for (const [select, word] of [[force, "on"], [sensor, "of"]]) {
      const choices = upTo(+gap.value + 1, +masses.value).flatMap((to) => references.map((from) => [`${from},${to}`, `${word} ${mass(to)}, against ${mass(from)}`]));
      offer(select, choices, `${references[0]},${select.value.split(",")[1]}`);
    }
  };

  // ---- the model: as described, or by a symmetry that keeps the transfer function
  const mirrored = (n, [g, ...ports]) => [g, ...ports.map((i) => (i > g ? g + 1 + n - i : i))];
  const exchanged = ([g, from, on, against, of]) => [g, against, of, from, on];
  const find = (c, described) => {
    const free = described[0] ? `masses ${described[0] + 1} to ${c.masses}` : "the masses";
    const other = `${free} counted from the other end`, swapped = "force and sensor exchanged";
    const ways = [[described, ""], [mirrored(c.masses, described), other], [exchanged(described), swapped], [exchanged(mirrored(c.masses, described)), `${other} and ${swapped}`]];
    const number = (indices) => c.models.findIndex((model) => `${model}` === `${indices}`) + 1;
    return ways.map(([indices, how]) => [number(indices), how]).find(([found]) => found);
  };

  // ---- the drawing, of parts that the page holds
  const draw = (c, [g, from, on, against, of]) => {
    const svg = slot("drawing"), joints = upTo(0, c.masses - 1).filter((i) => i !== g).map(between);
    const parts = [`ground-${g ? 1 : 0}`, ...upTo(1, c.masses).map((i) => `m${i}`), ...joints.map((j) => `k${j}${c.damped ? "-damped" : ""}`)];
    parts.push(...(c.damped ? joints.map((j) => `d${j}`) : []), `gap-${g}`, `sensor-${against}-${of}`, `force-${from}-${on}`);
    svg.replaceChildren(...parts.map((part) => {
      const use = document.createElementNS(svg.namespaceURI, "use");
      use.setAttribute("href", `#part-${part}`);
      return use;
    }));
    svg.setAttribute("viewBox", `0 0 ${c.size.join(" ")}`);
    svg.setAttribute("width", SCALE * c.size[0]);
    const said = (select) => select.selectedOptions[0].text;
    svg.setAttribute("aria-label", `${c.title}; gap: ${said(gap)}; force ${said(force)}; sensor ${said(sensor)}.`);
  };

  // ---- what is said
  const link = (text, href, label) => {
    const a = Object.assign(document.createElement("a"), { textContent: text, href });
    if (label) a.setAttribute("aria-label", label);
    return a;
  };
  const put = (name, ...content) => slot(name).replaceChildren(...content);
  const say = (c, number, how) => {
    const twins = (c.groups.find((group) => group.includes(number)) || []).filter((other) => other !== number), open = c.open[number];
    const one = twins.length === 1, others = c.models.length - 1 - twins.length, depends = c.depends[number] || [];
    const links = (of) => of.flatMap((other, at) => [at ? ", " : "", link(`A${other}`, `${c.name}.html${pairHash([number, other])}`, `A${other}: verdict and evidence`)]);
    put("number", `A${number} of ${c.title}`);
    put("remark", how ? `Listed with ${how}: the transfer function is the same.` : "");
    put("known", (c.known[number] || "").replace("{0}", `A${number}`)); // before any "distinguishable"
    put("twins", ...(twins.length ? [
      `Whatever its positive parameters, ${twins.length} other ${one ? "model" : "models"} cannot be told apart from it with this force and sensor: `,
      ...links(twins), ".",
    ] : others ? [open || depends.length ? "No other model is known that can never be told apart from it." : "With generic positive parameters it is distinguishable from every other model of this catalogue."] : ["The only model of this size."]));
    put("depends", ...(depends.length ? ["It depends on the positive parameters whether an experiment tells it from ", ...links(depends), "."] : []));
    put("open", open ? `With ${open} ${open === 1 ? "model" : "models"} this is undecided over positive parameters.` : "");
    put("links", link(`Model page of A${number}`, `${c.folder}/${number}.html`), link("Its column in the matrix", `${c.name}.html#A${number}`));
    form.dataset.model = `${c.masses}:${number}`;
    put("typed", form.dataset.model);
  };

  const offerAll = () => [offerDampers, offerGap, offerPorts].forEach((one) => one());
  const refresh = () => {
    offerAll();
    const c = catalogue(), [[from, on], [against, of]] = [force, sensor].map((select) => select.value.split(",").map(Number));
    const described = [+gap.value, from, on, against, of];
    draw(c, described);
    say(c, ...find(c, described));
  };

  // ---- the address keeps the description, for the way back and for others
  const CHOICES = [masses, dampers, gap, force, sensor];
  const follow = () => {
    const given = /^#machine=(\d+),((?:un)?damped),(\d+),(\d+,\d+),(\d+,\d+)$/.exec(location.hash);
    if (!given) return;
    CHOICES.forEach((select, at) => {
      choose(select, given[at + 1]);
      offerAll();
    });
    refresh();
    form.scrollIntoView({ block: "nearest" });
  };
  const keep = () => history.replaceState(null, "", `#machine=${CHOICES.map((select) => select.value)}`);
  let soon = 0; // browsers refuse an address that changes too often
  form.addEventListener("change", () => {
    refresh();
    clearTimeout(soon);
    soon = setTimeout(keep, 100);
  });
  form.addEventListener("submit", (event) => event.preventDefault());
  addEventListener("hashchange", follow);
  refresh();
  follow();
})();
