// What the form asks beside a plain chain: friction, what the sensor shows, lag and dead time; and what makes it another machine: branches,
// a loop, a gear, a second sensor. Such a machine is written as commands read it and drawn from signs that the page holds.
const createMore = (form, { upTo, mass, offer }) => {
  const { quantity, lag, delay, loop, gear, second } = form.elements;
  const slot = (name) => form.querySelector(`[data-slot="${name}"]`);
  const named = (name) => [...form.querySelectorAll(`[name^="${name}-"]`)];
  const labelled = (text, field, first) => {
    const label = document.createElement("label");
    label.append(...(first ? [field, ` ${text}`] : [`${text} `, field]));
    return label;
  };
  const field = (tag, name, more = {}) => Object.assign(document.createElement(tag), { name, ...more });
  let size = "";
  const offerMore = (n, gap, ports) => { // what was chosen stays where it can
    if (size !== `${n},${gap}`) {
      const rubbed = new Set(named("friction").filter((box) => box.checked).map((box) => box.value)), hung = Object.fromEntries(named("joined").map((s) => [s.name, s.value]));
      slot("friction").replaceChildren(...upTo(1, n).map((k) => labelled(mass(k), field("input", `friction-${k}`, { type: "checkbox", value: `${k}`, checked: rubbed.has(`${k}`) }), true)));
      slot("joined").replaceChildren(...upTo(3, n).filter((k) => k !== gap + 1).map((k) => {
        const select = field("select", `joined-${k}`);
        offer(select, upTo(1, k - 1).reverse().map((j) => [`${j}`, mass(j)]), hung[`joined-${k}`]);
        return labelled(`Mass ${k} is joined to`, select);
      }));
      size = `${n},${gap}`;
    }
    const joints = upTo(2, n).filter((k) => k !== gap + 1).map((k) => [k, parent(k)]);
    const free = upTo(1, n).flatMap((b) => upTo(0, b - 1).map((a) => [a, b])).filter(([a, b]) => !joints.some(([k, j]) => k === b && j === a) && !(gap && !a && b === 1));
    offer(loop, [["", "none"], ...free.map(([a, b]) => [`${a},${b}`, `between ${a ? `mass ${a}` : "the ground"} and mass ${b}`])]);
    offer(gear, [["", "none"], ...joints.map(([k, j]) => [`${k}`, `between mass ${j} and mass ${k}`])]);
    offer(second, [["", "none"], ...ports]);
  };
  const parent = (k) => +(form.elements[`joined-${k}`]?.value || k - 1);
  const pair = (select) => (select.value ? select.value.split(",").map(Number) : null);
  const read = (n, gap) => {
    const joints = upTo(2, n).filter((k) => k !== gap + 1).map((k) => [parent(k), k]);
    const found = { friction: named("friction").filter((box) => box.checked).map((box) => +box.value), quantity: quantity.value, lag: lag.checked, delay: delay.checked, joints, loop: pair(loop), gear: +gear.value, second: pair(second) };
    found.other = joints.some(([j, k]) => j !== k - 1) || Boolean(found.loop || found.gear || found.second);
    found.plain = !found.other && !found.friction.length && !found.lag && !found.delay && found.quantity === "acceleration";
    return found;
  };
  // as commands read it; a bearing beside a damper to the ground is one damper with it
  const written = ([gap, from, on, against, of], damped, { joints, loop, gear: at, friction, second: also, quantity: shown }) => {
    const sign = damped ? "=" : "~", held = [...(gap ? [1] : []), ...(loop && !loop[0] ? [loop[1]] : [])];
    const runs = [...(gap ? [`#${sign}1`] : []), ...joints.map(([j, k]) => `${j}${sign}${k}${at === k ? "*i" : ""}`), ...(loop ? [`${loop[0] || "#"}${sign}${loop[1]}`] : [])];
    const bearings = friction.filter((k) => !(damped && held.includes(k))).map((k) => `${k}-#`);
    const port = (letter, [minus, plus]) => `${letter}${plus}${minus ? `:${minus}` : ""}`;
    const sensors = [[against, of], ...(also ? [also] : [])].map((ends) => port("S", ends)).join(" ");
    return `${[...runs, ...bearings].join(", ")}; ${port("F", [from, on])}; ${sensors}${shown === "acceleration" ? "" : `; ${shown}`}`;
  };
  return { offerMore, read, written };
};
// Columns by the number of joints from a mass that nothing of lower number holds; signs are [id, place, turn].
const drawMachine = (svg, n, [gap, from, on, against, of], damped, { joints, loop, gear, friction, second }) => {
  const COLUMN = 112, ROW = (damped ? 128 : 104) + (friction.length ? 40 : 0), RIM = 17, ARM = 58, shapes = [], top = {};
  const add = (tag, attributes, text = "") => shapes.push(Object.assign(document.createElementNS(svg.namespaceURI, tag), { textContent: text })) && Object.entries(attributes).forEach(([name, value]) => shapes.at(-1).setAttribute(name, value));
  const line = (points, stroke = "currentColor") => add("path", { d: `M${points.map((p) => p.join(" ")).join("L")}`, fill: "none", stroke, "stroke-width": 1.5 });
  const word = (x, y, text, fill = "currentColor", size = 11) => add("text", { x, y: y + 4, fill, "font-size": size, "text-anchor": "middle", "font-weight": fill === "currentColor" ? 400 : 600 }, text);
  const depth = [], columns = [];
  for (let k = 1; k <= n; k++) {
    const joint = joints.find(([, b]) => b === k);
    depth[k] = joint ? depth[joint[0]] + 1 : Math.max(-1, ...depth.filter(Number.isFinite)) + 1;
    (columns[depth[k]] ??= []).push(k);
  }
  const at = (k) => [70 + COLUMN * depth[k], ROW * (columns[depth[k]].indexOf(k) - (columns[depth[k]].length - 1) / 2)];
  const between = ([x0, y0], [x1, y1], name, wheels, shift = 0) => { // a spring, with a damper beside it, its name outside
    const length = Math.hypot(x1 - x0, y1 - y0), [ux, uy] = [(x1 - x0) / length, (y1 - y0) / length], turn = (Math.atan2(uy, ux) * 180) / Math.PI;
    const place = (along, aside) => [x0 + along * ux - (aside + shift) * uy, y0 + along * uy + (aside + shift) * ux].map((v) => +v.toFixed(1));
    for (const [letter, aside, side] of damped ? [["k", -9, -1], ["d", 9, 1]] : [["k", 0, -1]]) {
      const middle = place(length / 2, aside);
      line([place(0, aside), place(length / 2 - 18, aside)]);
      line([place(length / 2 + 18, aside), place(length, aside)]);
      add("use", { href: `#part-sign-${letter}`, transform: `translate(${middle}) rotate(${turn.toFixed(1)})`, "data-element": letter + name });
      word(...place(length / 2, aside + side * 15), letter + name);
    }
    if (wheels) add("use", { href: "#part-sign-gear", transform: `translate(${place(length - 26, 0)}) rotate(${turn.toFixed(1)})`, "data-element": "i" }), word(...place(length - 26, -26), "i");
  };
  const joint = (a, b) => `${Math.min(a, b)}${Math.max(a, b)}`;
  const ground = (x, y, turn) => add("use", { href: "#part-sign-ground", transform: `translate(${x} ${y}) rotate(${turn})` });
  for (const [j, k] of [...joints, ...(loop?.[0] ? [loop] : [])]) between(at(j), at(k), joint(j, k), gear === k && joints.some(([a, b]) => a === j && b === k), depth[j] === depth[k] && Math.abs(at(j)[1] - at(k)[1]) > ROW ? 44 : 0);
  const [left] = at(1), held = loop && !loop[0] ? loop[1] : 0;
  if (gap) between([left - ARM - RIM, at(1)[1]], at(1), "01"), ground(left - ARM - RIM, at(1)[1], 180);
  if (held) between([at(held)[0] + 6, at(held)[1]], [at(held)[0] + 6, at(held)[1] + ARM + RIM], `0${held}`), ground(at(held)[0] + 6, at(held)[1] + ARM + RIM, 90);
  for (const k of friction.filter((one) => !(damped && (one === held || (gap && one === 1))))) {
    const [x, y] = [at(k)[0] - (held === k ? 22 : 9), at(k)[1]];
    line([[x, y], [x, y + 24]]), line([[x, y + 60], [x, y + ARM + RIM]]);
    add("use", { href: "#part-sign-d", transform: `translate(${x} ${y + 42}) rotate(90)`, "data-element": `b${k}` });
    word(x - 18, y + 42, `b${k}`), ground(x, y + ARM + RIM, 90);
  }
  const port = (k, text, ink, force) => { // upwards from a mass, beside those that are there
    const nth = (top[k] = (top[k] ?? -1) + 1), [x, y] = [at(k)[0] - 13 + 26 * (nth % 2), at(k)[1] - RIM], end = y - 22 - 26 * Math.floor(nth / 2);
    line([[x, y], [x, end]], ink);
    add(...(force ? ["path", { d: `M${x} ${y}l-4 -9h8z`, fill: ink }] : ["circle", { cx: x, cy: y, r: 4, fill: text[0] === "−" ? "var(--paper)" : ink, stroke: ink }]));
    add("rect", { x: x - 12, y: end - 18, width: 24, height: 18, rx: force ? 9 : 0, fill: "var(--paper)", stroke: ink, "data-port": text });
    word(x, end - 9, text, ink, 12);
  };
  port(on, "F", "var(--force)", true);
  if (from) port(from, "−F", "var(--force)", true);
  for (const [i, [minus, plus]] of [[against, of], ...(second ? [second] : [])].entries()) {
    port(plus, `y${i ? 2 : ""}`, "var(--sensor)");
    if (minus) port(minus, `−y${i ? 2 : ""}`, "var(--sensor)");
  }
  for (let k = 1; k <= n; k++) {
    const [x, y] = at(k);
    add("rect", { x: x - RIM, y: y - RIM, width: 2 * RIM, height: 2 * RIM, rx: 3, fill: "var(--body)", stroke: "currentColor", "stroke-width": 1.5, "data-element": `m${k}` });
    word(x, y, `m${k}`, "currentColor", 13);
  }
  const tall = Math.max(...columns.map((c) => c.length)), width = 110 + COLUMN * (columns.length - 1) + 40, high = 70 + 26 * Math.floor(Math.max(0, ...Object.values(top)) / 2);
  svg.replaceChildren(...shapes);
  svg.setAttribute("viewBox", `-20 ${-(ROW * (tall - 1)) / 2 - high} ${width + 20} ${ROW * (tall - 1) + high + (friction.length || held ? 100 : 40)}`);
  svg.setAttribute("width", width + 20);
};
