(() => {
  const data = JSON.parse(document.getElementById("data").textContent);
  const byId = (id) => document.getElementById(id), root = document.documentElement;
  const SECONDS = 20, SAMPLES = 16; // of a run; samples of the fastest oscillation
  const UNITS = { m: " kg", k: " N/m", d: " N s/m", i: "" };
  const chains = data.machines?.map(machineOf) ?? data.models.map((ports) => chainOf(data.masses, data.damped, ports, data.order));
  const nameOf = (i) => data.names?.[i - 1] ?? `A${i}`, numbers = chains.map((_, i) => i + 1);
  const kindOf = (given, other) => {
    if (data.groups.some((group) => group.includes(given) && group.includes(other))) return "always";
    const share = data.able.find(([a, b]) => a === given && b === other)?.[2];
    const open = data.open.some((pair) => pair.includes(given) && pair.includes(other));
    return share === "always" ? "always-there" : share === "sometimes" ? "sometimes" : open || share === "unknown" ? "open" : data.sided === false ? "apart" : "never";
  };
  const RANK = ["always", "always-there", "sometimes", "open", "apart", "never"];
  const pairs = numbers.flatMap((a) => numbers.slice(a).map((b) => [a, b]));
  const ranked = pairs.map(([a, b]) => [a, b, Math.min(RANK.indexOf(kindOf(a, b)), RANK.indexOf(kindOf(b, a)))]);
  const order = ranked.sort((x, y) => x[2] - y[2] || x[0] - y[0] || x[1] - y[1]).map(([a, b]) => [a, b]);

  let pair = data.first, values = [], base = [], usual = [], found = null, run = null, presenting = false;
  let playing = !matchMedia("(prefers-reduced-motion: reduce)").matches, now = 0, before = null;
  let showRun = () => {}, showBode = () => {}, move = [];
  const given = () => chains[pair[0] - 1], other = () => chains[pair[1] - 1];
  const forceKind = () => byId("drive").elements.force.value;

  // ---- sentences
  const leavesOut = (pair) => data.aside.some((other) => other.every((i) => pair.includes(i)));
  const SAYS = {
    always: (a, b) => `Whatever the positive parameters of ${a}${leavesOut(pair) ? ", special values aside" : ""}, some of ${b} give the same response: no experiment with this force and sensor distinguishes them.`,
    "always-there": (a, b) => `For all positive parameters of ${a}, special values aside, some of ${b} give the same response; the reverse holds for some only.`,
    sometimes: (a, b) => `For some positive parameters of ${a}, some of ${b} give the same response; for others none do.`,
    open: (a, b) => `It is unknown whether positive parameters of ${b} can give the response of ${a}.`,
    apart: (a, b) => `An experiment distinguishes them: with generic positive parameters, at least one of ${a} and ${b} has responses that the other cannot produce.`,
    never: (a, b) => `An experiment distinguishes them: ${b} cannot produce the response of ${a} with generic positive parameters.`,
  };
  const names = () => pair.map(nameOf);
  const apart = ({ decibels, omega }) => `${short(Math.abs(decibels))} dB at ${short(omega / (2 * Math.PI))} Hz`;
  const failing = () => other().names.filter((_, i) => found.how === "impossible" && !(found.values[i] > 0));
  const howSaid = () => {
    const [a, b] = names();
    if (found.how === "formula") return `The values of ${b} follow from those of ${a} by formulas.`;
    if (found.how === "same") return `No formulas are used here: these values of ${b}, found numerically, give the same response up to rounding.`;
    if (found.how === "impossible") return `With these values of ${a}, ${b} would need ${failing().join(" and ")} that ${failing().length > 1 ? "are" : "is"} not positive, which no machine has; ${found.searching ? "positive values with the same response are being searched" : "no positive values with the same response were found"}.`;
    const lent = data.damped ? "" : ` (both with ${100 * LENT} % damping added)`;
    const exist = kindOf(...pair).startsWith("always") && !found.searching ? "Values with the same response exist, but this search did not find them. " : "";
    return `${exist}${found.searching ? "Searching; best so far" : "Best values found"}: ${b} differs from ${a} by up to ${apart(found.most)}${lent}.`;
  };
  const say = () => {
    const [a, b] = names(), fails = found.how === "impossible";
    byId("pair").firstChild.data = `${a} and ${b} `;
    byId("verdict").textContent = SAYS[kindOf(...pair)](a, b);
    const how = byId("how");
    if (how.textContent !== howSaid()) how.textContent = howSaid();
    how.classList.toggle("fails", fails);
    byId("two-how").textContent = { formula: "same response", same: "same response", impossible: "same response, but cannot be built" }[found.how] || "nearest response found";
    document.querySelector("figure.two").classList.toggle("impossible", fails);
  };

  // ---- the parameters
  const unit = (chain, i) => UNITS[chain.kinds[i]];
  const fillValues = () => {
    const [left, right] = byId("values").querySelectorAll("tbody");
    byId("one-values").textContent = `${nameOf(pair[0])}: set`;
    byId("two-values").textContent = `${nameOf(pair[1])}: follows`;
    left.replaceChildren(...given().names.map((name, i) => {
      const row = document.createElement("tr"), input = document.createElement("input");
      Object.assign(input, { type: "range", min: -1, max: 1, step: 0.005, value: Math.log10(values[i] / base[i]) });
      input.setAttribute("aria-label", `${name} of ${nameOf(pair[0])}`);
      const cells = [Object.assign(document.createElement("th"), { scope: "row", textContent: name }), document.createElement("td"), document.createElement("td")];
      cells[1].append(input);
      row.append(...cells);
      const tell = () => {
        cells[2].textContent = `${written(values[i])}${unit(given(), i)}`;
        input.setAttribute("aria-valuetext", cells[2].textContent);
      };
      tell();
      input.addEventListener("input", () => {
        values[i] = base[i] * 10 ** input.value;
        tell();
        soon();
      });
      return row;
    }));
    right.replaceChildren(...other().names.map((name) => {
      const row = document.createElement("tr");
      row.append(Object.assign(document.createElement("th"), { scope: "row", textContent: name }), document.createElement("td"));
      return row;
    }));
  };
  const tellValues = () =>
    [...byId("values").querySelectorAll("tbody")[1].rows].forEach((row, i) => {
      const fails = !(found.values[i] > 0);
      row.classList.toggle("fails", fails);
      row.cells[1].textContent = `${written(found.values[i])}${unit(other(), i)}${fails ? ", not positive" : ""}`;
    });

  // ---- motion
  const parts = () => [partsOf(given(), values), partsOf(other(), found.values)];
  const sineFrequency = () => {
    const [low, high] = second.band(given(), base).map((omega) => omega / (2 * Math.PI));
    return low * (high / low) ** byId("frequency").value;
  };
  const compute = () => {
    const [one, two] = parts(), [from, to] = second.band(given(), values).map((omega) => omega / (2 * Math.PI));
    const fastest = Math.max(frequencyOf(given(), one, data.masses), found.values.every((x) => x > 0) ? frequencyOf(other(), two, data.masses) : 0, 2 * Math.PI * to * (forceKind() === "sweep"));
    const steps = Math.round(clamped((SECONDS * SAMPLES * fastest) / (2 * Math.PI), 1500, 12000));
    const asked = { steps, duration: SECONDS, frequency: sineFrequency(), from, to };
    const force = forceOf(forceKind(), asked), motions = [[given(), one], [other(), two]].map(([chain, of]) => moved(chain, of, force, SECONDS / steps));
    const [first, next] = motions.map(({ places }, which) => widest(places, chains[pair[which] - 1]));
    run = { ...asked, force, motions, gain: (0.9 * ROOM) / (Math.max(first, next) || 1) };
  };
  const draw = () => {
    const shown = byId("drive").elements.shown.value === "sensor" ? "acceleration" : "distance";
    const title = shown === "acceleration" ? "y: acceleration in m/s²" : "change of the distance y in mm, without travel";
    const curves = run.motions.map((motion) => (shown === "distance" ? motion.distance.map((x) => 1000 * x) : motion.acceleration));
    showRun = plotRun(byId("run"), { force: run.force, curves, duration: SECONDS, title });
    const [a, b] = names();
    byId("run").setAttribute("aria-label", `Force and ${title}, of ${a} and ${b} over ${SECONDS} s. ${howSaid()}`);
    if (byId("bode").getBoundingClientRect().width) {
      const lines = linesOf(...second.band(given(), values), 700);
      const bodes = parts().map((of, which) => bodeOf([given(), other()][which], of, lines));
      showBode = plotBode(byId("bode"), { lines, bodes, most: found.most, title: "amplitude of y/F in dB" });
      byId("bode").setAttribute("aria-label", `Bode diagrams of ${a} and ${b}. ${howSaid()}`);
    }
    place();
  };
  const place = () => {
    const at = Math.min(Math.round((now / SECONDS) * run.steps), run.steps), n = data.masses;
    run.motions.forEach(({ places }, which) => move[which](Array.from({ length: n }, (_, i) => run.gain * places[at * n + i])));
    showRun(now, at);
    showBode({ sine: run.frequency, sweep: sweepFrequency(now, run) }[forceKind()] ?? 0);
    byId("time").value = now / SECONDS;
    byId("time").setAttribute("aria-valuetext", `${now.toFixed(1)} s`);
  };
  const tick = (time) => {
    if (playing && before !== null && run) {
      now = (now + Math.min(time - before, 100) / 1000) % SECONDS;
      place();
    }
    before = time;
    requestAnimationFrame(tick);
  };

  // ---- from what was changed to what is seen
  const show = (next) => {
    found = next;
    say();
    tellValues();
    compute();
    draw();
  };
  const second = createSecond(show);
  const follow = () => show(second.follow({ given: given(), other: other(), values, usual, kind: kindOf(...pair), pair: `${pair}` }));
  let waiting = false;
  const soon = () => {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(() => {
      waiting = false;
      follow();
    });
  };
  const offer = () => {
    const chosen = (i) => new Option(data.hints?.[i - 1] ? `${nameOf(i)}: ${data.hints[i - 1]}` : nameOf(i), i);
    byId("left").replaceChildren(...numbers.map(chosen));
    byId("left").value = pair[0];
    const titles = { always: "Indistinguishable", "always-there": "Has all its responses", sometimes: "Depends on the values", open: "Not known", apart: "Distinguishable", never: "Distinguishable" };
    const groups = RANK.map((kind) => [titles[kind], numbers.filter((i) => i !== pair[0] && kindOf(pair[0], i) === kind)]).filter(([, of]) => of.length);
    byId("right").replaceChildren(...groups.map(([label, of]) => {
      const group = Object.assign(document.createElement("optgroup"), { label });
      group.append(...of.map(chosen));
      return group;
    }));
    byId("right").value = pair[1];
  };
  const hash = () => `#${pair.map((i) => `A${i}`).join("-")}${presenting ? ",present" : ""}`;
  const select = (next, first = data.values[next[0] - 1], second = data.values[next[1] - 1]) => {
    pair = next;
    byId("trouble").textContent = "";
    [values, base, usual] = [[...first], [...first], second];
    offer();
    [["one", given()], ["two", other()]].forEach(([id, chain], which) => {
      move[which] = chain.at ? drawGraph(byId(id), chain) : drawMoving(byId(id), chain, data.drawing);
      byId(id).setAttribute("aria-label", `${nameOf(pair[which])}, moving`);
      byId(`${id}-name`).textContent = nameOf(pair[which]);
      if (data.folder) byId(`${id}-name`).href = `${data.folder}/${pair[which]}.html`;
    });
    fillValues();
    now = 0;
    follow();
    document.title = `${names().join(" and ")} in motion`;
    if (location.hash !== hash()) history.replaceState(null, "", hash());
  };
  const turn = (by) => {
    const low = [...pair].sort((a, b) => a - b), at = order.findIndex((p) => `${p}` === `${low}`);
    select(order[(at + by + order.length) % order.length]);
  };
  const swap = () => (found.values.every((x) => x > 0) ? select([pair[1], pair[0]], found.values, values) : select([pair[1], pair[0]]));
  const present = (on) => {
    presenting = on;
    root.classList.toggle("present", on);
    root.classList.toggle("bode-on", on);
    if (!on && document.fullscreenElement) document.exitFullscreen();
    history.replaceState(null, "", hash());
    draw();
    (on ? byId("both") : byId("present")).focus({ preventScroll: true });
  };
  const play = (on) => {
    playing = on;
    byId("play").textContent = on ? "Pause" : "Play";
  };
  const toggle = (name) => {
    root.classList.toggle(name);
    draw();
  };

  // ---- what people do
  byId("left").addEventListener("change", (event) => {
    const chosen = +event.target.value, twins = numbers.filter((i) => i !== chosen).sort((a, b) => RANK.indexOf(kindOf(chosen, a)) - RANK.indexOf(kindOf(chosen, b)) || a - b);
    select([chosen, twins[0]]);
  });
  byId("right").addEventListener("change", (event) => select([pair[0], +event.target.value]));
  const CLICKS = {
    swap, before: () => turn(-1), after: () => turn(1), present: () => present(true), leave: () => present(false), play: () => play(!playing),
    help: () => byId("keys").showModal(), reset: () => select(pair),
  };
  for (const [id, act] of Object.entries(CLICKS)) byId(id).addEventListener("click", act);
  for (const id of ["choose", "drive"]) byId(id).addEventListener("submit", (event) => event.preventDefault());
  byId("time").addEventListener("input", (event) => {
    play(false);
    now = event.target.value * SECONDS;
    place();
  });
  const again = () => {
    document.querySelector(".sine").hidden = forceKind() !== "sine";
    byId("hertz").textContent = `${written(sineFrequency())} Hz`;
    compute();
    draw();
  };
  byId("frequency").addEventListener("input", again);
  byId("drive").addEventListener("change", (event) => event.target.type === "radio" && again());
  const force = (kind) => {
    byId("drive").elements.force.value = kind;
    again();
  };
  const KEYS = {
    ArrowRight: () => turn(1), PageDown: () => turn(1), ArrowLeft: () => turn(-1), PageUp: () => turn(-1), " ": () => play(!playing), 1: () => force("step"), 2: () => force("sweep"), 3: () => force("sine"),
    x: swap, b: () => toggle("bode-on"), p: () => toggle("values-on"), "?": () => byId("keys").showModal(), Escape: () => present(false),
    f: () => (document.fullscreenElement ? document.exitFullscreen() : root.requestFullscreen?.().catch(() => {})),
  };
  document.addEventListener("keydown", (event) => {
    const act = KEYS[event.key.length === 1 ? event.key.toLowerCase() : event.key], at = event.target;
    if (!presenting || !act || event.ctrlKey || event.altKey || event.metaKey || byId("keys").open) return;
    if (at.closest("input, select") && event.key.length > 1 && event.key !== "Escape") return; // arrows belong to it
    if (at.closest("button") && event.key === " ") return;
    event.preventDefault();
    act();
  });
  const asked = () => { // by the address
    const match = /^#(?:(\d+)(?::|%3A))?A?(\d+)-(?:(\d+)(?::|%3A))?A?(\d+)(,present)?$/i.exec(location.hash);
    const two = match && [+match[2], +match[4]], sizes = match ? [match[1], match[3]].filter(Boolean) : [];
    const there = two && two.every((i) => numbers.includes(i)) && two[0] !== two[1] && sizes.every((n) => +n === data.masses);
    const trouble = there || !location.hash ? "" : `${decodeURI(location.hash.slice(1))} names no pair here: there are the models ${data.names ? "A" : `${data.masses}:`}1 to ${data.names ? "A" : `${data.masses}:`}${numbers.length}.`;
    return { two: there ? two : data.first, present: Boolean(there && match[5]), trouble };
  };
  const arrive = () => {
    const { two, present: on, trouble } = asked();
    presenting = on;
    select(two);
    byId("trouble").textContent = trouble;
    if (presenting !== root.classList.contains("present")) present(presenting);
  };
  addEventListener("hashchange", arrive);
  let size = 0; // lines are redrawn where the window changes its shape
  new ResizeObserver(([{ contentRect }]) => {
    if (contentRect.width !== size && run) draw();
    size = contentRect.width;
  }).observe(byId("run"));
  play(playing);
  const [first, next] = asked().two.map((i) => i - 1);
  if (mapped(chains[first], chains[next], data.values[first])) arrive();
  else requestAnimationFrame(() => setTimeout(arrive)); // a search takes longer than a formula: the page is seen before
  requestAnimationFrame(tick);
})();
