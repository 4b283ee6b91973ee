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
  const choicesOf = (word) => {
    const references = +gap.value ? upTo(1, +gap.value) : [0];
    return upTo(+gap.value + 1, +masses.value).flatMap((to) => references.map((from) => [`${from},${to}`, `${word} ${mass(to)}, against ${mass(from)}`]));
  };
  const more = createMore(form, { upTo, mass, offer });
  const offerPorts = () => {
    const references = +gap.value ? upTo(1, +gap.value) : [0];
    for (const [select, word] of [[force, "on"], [sensor, "of"]]) {
      offer(select, choicesOf(word), `${references[0]},${select.value.split(",")[1]}`);
    }
    more.offerMore(+masses.value, +gap.value, choicesOf("of"));
  };

  // ---- the model: as described, or by a symmetry that keeps the transfer function
  const mirrored = (n, [g, ...ports]) => [g, ...ports.map((i) => (i > g ? g + 1 + n - i : i))];
  const exchanged = ([g, from, on, against, of]) => [g, against, of, from, on];
  const find = (c, described) => {
    const free = described[0] ? `masses ${described[0] + 1} to ${c.masses}` : "the masses";
    const other = `${free} counted from the other end`, swapped = "force and sensor exchanged";
    const turned = mirrored(c.masses, described);
    const ways = [[described, "", false], [turned, other, true], [exchanged(described), swapped, false], [exchanged(turned), `${other} and ${swapped}`, true]];
    const number = (indices) => c.models.findIndex((model) => `${model}` === `${indices}`) + 1;
    return ways.map(([indices, how, isTurned]) => [number(indices), how, isTurned]).find(([found]) => found);
  };

  // ---- the drawing, of parts that the page holds
  const draw = (c, [g, from, on, against, of], { friction, lag, delay }) => {
    const svg = slot("drawing"), joints = upTo(0, c.masses - 1).filter((i) => i !== g).map(between);
    const parts = [`ground-${g ? 1 : 0}`, ...upTo(1, c.masses).map((i) => `m${i}`), ...joints.map((j) => `k${j}${c.damped ? "-damped" : ""}`)];
    parts.push(...(c.damped ? joints.map((j) => `d${j}`) : []), `gap-${g}`, `sensor-${against}-${of}`, `force-${from}-${on}`, ...friction.map((k) => `friction-${k}`));
    svg.replaceChildren(...parts.map((part) => {
      const use = document.createElementNS(svg.namespaceURI, "use");
      use.setAttribute("href", `#part-${part}`);
      return use;
    }));
    svg.setAttribute("viewBox", `0 0 ${c.size[0]} ${c.size[1] + (friction.length ? c.below : 0)}`);
    svg.setAttribute("width", SCALE * c.size[0]);
    const said = (select) => select.selectedOptions[0].text;
    svg.setAttribute("aria-label", `${c.title}; gap: ${said(gap)}; force ${said(force)}; sensor ${said(sensor)}${friction.map((k) => `; friction at mass ${k}`).join("")}.`);
    put("behind", lag || delay ? `The force acts behind ${[lag && "a lag T1", delay && "a dead time Td"].filter(Boolean).join(" and ")}.` : "");
  };

  // ---- what is said
  const link = (text, href, label) => {
    const a = Object.assign(document.createElement("a"), { textContent: text, href });
    if (label) a.setAttribute("aria-label", label);
    return a;
  };
  const put = (name, ...content) => slot(name).replaceChildren(...content);
  const EMPTY = ["remark", "known", "twins", "depends", "open", "links", "behind", "commands"];
  const command = (text) => { // to copy
    const box = Object.assign(document.createElement("div"), { className: "command" }), code = Object.assign(document.createElement("code"), { textContent: text });
    const button = Object.assign(document.createElement("button"), { type: "button", className: "plainbutton", textContent: "Copy" });
    button.setAttribute("aria-label", `Copy ${text}`);
    button.addEventListener("click", () => {
      getSelection().selectAllChildren(code); // stays selected where a browser refuses the clipboard
      navigator.clipboard?.writeText(text).then(() => (button.textContent = "Copied"), () => {});
    });
    box.append(code, button);
    return box;
  };
  const NOTHING = "This machine is in no catalogue of this site, so its equivalents are not listed here. ";
  const sayExtended = (c, number, how, turned, extras) => { // a chain with friction, lag, dead time, another quantity
    const g = +gap.value, there = (k) => (turned && k > g ? g + 1 + c.masses - k : k);
    const name = `${c.masses}:${number}${damperSet(extras.friction.map(there).sort((a, b) => a - b))}${extras.lag ? "+lag" : ""}${extras.delay ? "+delay" : ""}`;
    const only = !extras.lag && !extras.delay && extras.quantity === "acceleration", kind = c.damped ? "damped" : "undamped";
    const families = JSON.parse(document.getElementById("families").textContent), found = only ? addressOf(parseModels(name), c.masses, kind, families) : {};
    const flags = `${c.damped ? "" : " --undamped"}${extras.quantity === "acceleration" ? "" : ` --quantity ${extras.quantity}`}`;
    put("number", `${name}, ${c.title}${extras.quantity === "acceleration" ? "" : `, ${extras.quantity}`}`);
    put("remark", how ? `Listed with ${how}: the transfer function is the same.` : "");
    put("twins", ...(found.address ? ["Its verdicts are in ", link("its row of the catalogue with dampers to the ground", found.address), "."] : [NOTHING, "This command computes them for the values that you give:"]));
    put("commands", ...(found.address ? [] : [command(`disting equivalents ${name} --to "${c.masses}+b*"${flags} --set ${valuesOf(c, extras)}`)]));
    form.dataset.model = name;
    put("typed", `${name}${flags}`);
  };
  const valuesOf = (c, { friction, lag, delay }) => [...upTo(1, c.masses).map((k) => `m${k}`), ...upTo(0, c.masses - 1).filter((k) => k !== +gap.value).flatMap((k) => [`k${between(k)}`, ...(c.damped ? [`d${between(k)}`] : [])]), ...friction.map((k) => `b${k}`), ...(lag ? ["T1"] : []), ...(delay ? ["Td"] : [])].map((name) => `${name}=..`).join(",");
  const sayOther = (c, described, extras) => { // no chain, or one with two sensors: written as commands read it
    const text = more.written(described, c.damped, extras), family = c.families[+Boolean(extras.loop)];
    drawMachine(slot("drawing"), c.masses, described, c.damped, extras);
    slot("drawing").setAttribute("aria-label", `A machine: ${text}`);
    put("number", text);
    put("remark", extras.lag || extras.delay ? "Such a machine cannot have a lag or a dead time: both were left out." : "");
    put("twins", NOTHING, "These commands compute them:");
    put("commands", ...[`disting models "${text}"`, ...(family && !extras.second ? [`disting equivalents "${text}" --family ${family}`] : []), `disting draw "${text}" --svg machine.svg`].map(command));
    form.dataset.model = text;
    put("typed", "no chain with a number");
  };
  const say = (c, number, how) => {
    const twins = (c.groups.find((group) => group.includes(number)) || []).filter((other) => other !== number), open = c.open[number];
    const one = twins.length === 1, others = c.models.length - 1 - twins.length, depends = c.depends[number] || [];
    const links = (of) => of.flatMap((other, at) => [at ? ", " : "", link(`A${other}`, `${c.name}.html${pairHash([number, other])}`, `A${other}: verdict and evidence`)]);
    put("number", `A${number} of ${c.title}`);
    put("remark", how ? `Listed with ${how}: the transfer function is the same.` : "");
    put("known", (c.known[number] || "").replace("{0}", `A${number}`)); // before any "distinguishable"
    put("twins", ...(twins.length ? [
      `Whatever its positive parameters${c.aside.includes(number) ? ", special values aside" : ""}, no experiment with this force and sensor distinguishes it from ${twins.length} other ${one ? "model" : "models"}: `,
      ...links(twins), ".",
    ] : others ? [open || depends.length ? "No other model is known to be indistinguishable from it." : "With generic positive parameters it is distinguishable from every other model of this catalogue."] : ["The only model of this size."]));
    put("depends", ...(depends.length ? ["The positive parameters determine whether an experiment can distinguish it from ", ...links(depends), "."] : []));
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
    const extras = more.read(c.masses, +gap.value);
    for (const name of EMPTY) put(name);
    if (extras.other) return sayOther(c, described, extras);
    draw(c, described, extras);
    const [number, how, turned] = find(c, described);
    if (extras.plain) return say(c, number, how);
    sayExtended(c, number, how, turned, extras);
  };

  // ---- the address keeps the description, for the way back and for others
  const CHOICES = [masses, dampers, gap, force, sensor];
  const follow = () => {
    const given = /^#machine=(\d+),((?:un)?damped),(\d+),(\d+,\d+),(\d+,\d+)((?:\/[\w-]+=[\w,]+)*)$/.exec(location.hash);
    if (!given) return;
    CHOICES.forEach((select, at) => {
      choose(select, given[at + 1]);
      offerAll();
    });
    for (const one of beside()) one.type === "checkbox" ? (one.checked = false) : (one.selectedIndex = 0);
    for (const [, name, value] of given[6].matchAll(/\/([\w-]+)=([\w,]+)/g)) {
      const one = beside().find((e) => e.name === name);
      if (one?.type === "checkbox") one.checked = true;
      else if (one) choose(one, value);
      offerAll();
    }
    refresh();
    form.scrollIntoView({ block: "nearest" });
  };
  const beside = () => [...form.elements].filter((e) => e.name && !CHOICES.includes(e)); // what is asked beside a chain, where it is not as at first
  const said = (e) => (e.type === "checkbox" ? e.checked && 1 : e.selectedIndex > 0 && e.value);
  const keep = () => history.replaceState(null, "", `#machine=${CHOICES.map((select) => select.value)}${beside().filter(said).map((e) => `/${e.name}=${said(e)}`).join("")}`);
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
