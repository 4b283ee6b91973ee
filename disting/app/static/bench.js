// The bench: masses to place, to join and to move, by mouse, touch and keys. `onChange(parts)` hears every change of the machine.
import { element, svg, announce } from "./dom.js";
import { GROUND, addMass, join, removeJoint, removeMass, toggleGear, togglePort } from "./parts.js";

const WIDTH = 540, HEIGHT = 300, SIZE = 48, FLOOR = 270; // in the units of the drawing
const TOOLS = [
  ["move", "Move"], ["both", "Spring + damper"], ["spring", "Spring"], ["damper", "Damper"], ["gear", "Gear"],
  ["force", "Force"], ["sensor", "Sensor"], ["remove", "Remove"],
];
const KINDS = ["both", "spring", "damper"], JOINING = [...KINDS, "gear"];
const WORDS = { both: "spring and damper", spring: "spring", damper: "damper" };
const clamp = (x, low, high) => Math.min(Math.max(x, low), high);

// A place that no mass covers, below or beside the wanted one.
const freePlace = ([x, y], taken) => {
  const isFree = ([a, b]) => taken.every(([c, d]) => Math.abs(a - c) >= SIZE + 8 || Math.abs(b - d) >= SIZE + 16);
  const rows = [0, 1, 2].map((i) => 40 + ((y - 40 + 70 * i) % 210)), columns = [0, 1, 2, 3, 4, 5, 6].map((i) => 40 + ((x - 40 + 60 * i) % (WIDTH - 80)));
  return columns.flatMap((a) => rows.map((b) => [a, b])).find(isFree) ?? [x, y];
};

// Columns by the distance from the force; what has a place keeps it.
export const arrange = (parts, places) => {
  const near = (node) => parts.joints.flatMap(({ from, to }) => (from === node ? [to] : to === node ? [from] : [])).filter((i) => i !== GROUND);
  const columns = new Map(), starts = [...parts.forces, ...parts.sensors].flat().filter((i) => i !== GROUND);
  for (const start of [...starts, ...parts.masses]) {
    if (columns.has(start)) continue;
    columns.set(start, columns.size ? Math.max(...columns.values()) + 1 : 0);
    for (const queue = [start]; queue.length;) {
      const node = queue.shift();
      for (const next of near(node)) if (!columns.has(next)) { columns.set(next, columns.get(node) + 1); queue.push(next); }
    }
  }
  const count = Math.max(1, ...columns.values()) + 1, rows = new Map(), found = {};
  for (const [node, column] of columns) {
    const row = rows.get(column) ?? 0;
    rows.set(column, row + 1);
    found[node] = places[node] ?? freePlace([80 + (column * (WIDTH - 160)) / Math.max(2, count - 1), 90 + 80 * row], [...Object.values(found), ...Object.values(places)]);
  }
  return found;
};

// A spring or a damper from p to q, beside the line by `aside` and before its middle by `back`.
const symbolOf = (kind, p, q, aside, back) => {
  const length = Math.hypot(q[0] - p[0], q[1] - p[1]) || 1, u = [(q[0] - p[0]) / length, (q[1] - p[1]) / length];
  const at = (along, across) => [0, 1].map((i) => ((p[i] + q[i]) / 2 + along * u[i] + (across + aside) * (i ? u[0] : -u[1])).toFixed(1)).join(" ");
  const half = length / 2, own = (along, across) => at(along - back, across), zigzag = [-15, -9, -3, 3, 9, 15].map((x, i) => own(x, i % 2 ? 6 : -6));
  if (kind === "spring") return `M${at(-half, 0)}L${[own(-18, 0), ...zigzag, own(18, 0), at(half, 0)].join("L")}`;
  return `M${at(-half, 0)}L${own(-9, 0)}M${own(9, -6)}L${own(-9, -6)}L${own(-9, 6)}L${own(9, 6)}M${own(3, -4)}L${own(3, 4)}M${own(3, 0)}L${at(half, 0)}`;
};
// A gear before the mass at q: two wheels, as in the drawings of the package.
const gearAt = (p, q) => {
  const length = Math.hypot(q[0] - p[0], q[1] - p[1]) || 1, before = (way) => [0, 1].map((i) => q[i] - (way * (q[i] - p[i])) / length);
  return svg("g", { class: "gear" }, [[SIZE / 2 + 23, 11], [SIZE / 2 + 6, 6]].map(([way, r]) => {
    const [cx, cy] = before(way);
    return svg("circle", { cx: cx.toFixed(1), cy: cy.toFixed(1), r });
  }));
};

export const createBench = (onChange) => {
  let parts = null, places = {}, tool = "move", picked = null, drag = null;
  const canvas = svg("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, class: "bench", role: "group", "aria-label": "Machine to edit" });
  const hint = element("p", { class: "hint", id: "bench-hint" });
  const tools = element("fieldset", { class: "segments tools-of-bench" }, element("legend", { class: "unseen" }, "Tool"), TOOLS.map(([name, title]) => element("label", {},
    element("input", { type: "radio", name: "tool", value: name, checked: name === tool, onchange: () => choose(name) }), element("span", {}, title))));
  const add = element("button", { type: "button", class: "plainbutton", id: "add-mass", onclick: () => place() }, "Add mass");

  const HINTS = {
    move: "Drag a mass. Keys on a mass: arrows move it, F and S toggle force and sensor, Delete removes it.",
    force: "Choose the mass on which the force acts.", sensor: "Choose the mass whose motion is measured.", gear: "Choose two masses: a gear is before the second one. Where there is one, it goes.", remove: "Choose a mass or a joint to remove.",
  };
  const showHint = () => {
    const second = picked === null ? "" : tool === "gear" ? `Mass ${picked} is chosen: choose the mass behind the gear.` : `${picked ? `Mass ${picked}` : "The ground"} is chosen: choose the other end.`;
    hint.textContent = second || HINTS[tool] || `Choose two masses, or a mass and the ground: a ${WORDS[tool]} joins them.`;
  };
  const choose = (name) => { tool = name; picked = null; draw(); };
  const change = (changed, sentence) => {
    parts = changed;
    places = arrange(parts, places);
    draw();
    if (sentence) announce(sentence);
    onChange(parts, places);
  };
  const place = (at) => {
    const [changed, node] = addMass(parts);
    const last = parts.masses.length ? places[parts.masses.at(-1)] : [-50, 70];
    const right = last[0] + 120 <= WIDTH - 60 ? [last[0] + 120, last[1]] : [clamp(last[0] - 60, 60, WIDTH - 60), clamp(last[1] + 75, 40, FLOOR - 60)];
    places = { ...places, [node]: at ?? right };
    change(changed, `Mass ${node} added.`);
    canvas.querySelector(`[data-node="${node}"]`)?.focus();
  };
  const pick = (node) => { // with the tool, by whatever means
    if (tool === "remove" && node !== GROUND) return remove(node);
    if ((tool === "force" || tool === "sensor") && node !== GROUND) return change(togglePort(parts, `${tool}s`, node), `${tool} at mass ${node} changed.`);
    if (!JOINING.includes(tool) || (tool === "gear" && node === GROUND)) return draw();
    if (picked === null || picked === node) {
      picked = picked === node ? null : node;
      draw();
      return announce(hint.textContent);
    }
    const from = picked;
    picked = null;
    if (tool === "gear") return change(toggleGear(parts, from, node), `Gear between mass ${from} and mass ${node} changed.`);
    return change(join(parts, from, node, tool), `A ${WORDS[tool]} joins ${[from, node].map((i) => (i ? `mass ${i}` : "the ground")).join(" and ")}.`);
  };
  const remove = (node) => {
    picked = null;
    change(removeMass(parts, node), `Mass ${node} removed.`);
    (canvas.querySelector("[data-node]") ?? add).focus();
  };
  const shift = (node, dx, dy) => {
    const [x, y] = places[node];
    places = { ...places, [node]: [clamp(x + dx, 30, WIDTH - 30), clamp(y + dy, 30, FLOOR - 40)] };
    draw();
  };
  const ARROWS = { ArrowLeft: [-20, 0], ArrowRight: [20, 0], ArrowUp: [0, -20], ArrowDown: [0, 20] };
  const keys = (node) => (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const key = event.key.toLowerCase(), act = key === "enter" || key === " " ? () => pick(node) : event.key in ARROWS && node ? () => shift(node, ...ARROWS[event.key])
      : (key === "delete" || key === "backspace") && node ? () => remove(node) : key === "f" && node ? () => change(togglePort(parts, "forces", node), `Force at mass ${node} changed.`)
        : key === "s" && node ? () => change(togglePort(parts, "sensors", node), `Sensor at mass ${node} changed.`) : null;
    if (!act) return;
    event.preventDefault();
    act();
  };
  const pointOf = (event) => {
    const { x, y } = new DOMPoint(event.clientX, event.clientY).matrixTransform(canvas.getScreenCTM().inverse());
    return [x, y];
  };
  canvas.addEventListener("pointerdown", (event) => {
    const node = event.target.closest("[data-node]")?.dataset.node;
    if (node === undefined || event.button) return;
    drag = { node: +node, start: pointOf(event), moved: false };
    if (tool === "move" && +node) canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener("pointermove", (event) => {
    if (!drag || tool !== "move" || !drag.node) return;
    const [x, y] = pointOf(event);
    if (!drag.moved && Math.hypot(x - drag.start[0], y - drag.start[1]) < 4) return;
    drag.moved = true;
    places = { ...places, [drag.node]: [clamp(x, 30, WIDTH - 30), clamp(y, 30, FLOOR - 40)] };
    draw();
  });
  canvas.addEventListener("pointerup", (event) => { // a line that is drawn from one node to another joins them
    if (!drag) return;
    const { node } = drag, over = document.elementFromPoint(event.clientX, event.clientY)?.closest("[data-node]")?.dataset.node;
    drag = null;
    if (tool === "move") return;
    pick(node);
    if (over !== undefined && +over !== node && JOINING.includes(tool) && picked === node) pick(+over);
  });
  canvas.addEventListener("pointercancel", () => { drag = null; });
  canvas.addEventListener("dblclick", (event) => { if (!event.target.closest("[data-node], [data-joint]")) place(pointOf(event)); });

  const jointOf = ({ from, to, kind, ratio }, at) => {
    const p = places[from] ?? [0, FLOOR], q = to === GROUND ? [p[0], FLOOR] : places[to], kinds = kind === "both" ? ["spring", "damper"] : [kind];
    const middle = [(p[0] + q[0]) / 2, (p[1] + q[1]) / 2], words = `${WORDS[kind]} between mass ${from} and ${to ? `mass ${to}` : "the ground"}${ratio ? `, gear ${ratio}` : ""}`;
    const act = () => (tool === "remove" ? change(removeJoint(parts, from, to), "Joint removed.") : tool === "gear" && picked === null && change(toggleGear(parts, from, to), `Gear between mass ${from} and mass ${to} changed.`));
    return svg("g", { "data-joint": at, class: tool === "remove" || (tool === "gear" && to) ? "joint removable" : "joint", onclick: act },
      svg("title", {}, words),
      kinds.map((one, i) => svg("path", { d: symbolOf(one, p, q, kinds.length > 1 ? 18 * i - 9 : 0, ratio ? 16 : 0) })),
      ratio ? gearAt(p, q) : null,
      svg("path", { class: "grip", d: `M${p.join(" ")}L${q.join(" ")}` }),
      ratio ? svg("text", { x: middle[0], y: middle[1] - 22 }, `× ${ratio}`) : null);
  };
  const massOf = (node) => {
    const [x, y] = places[node], signs = [["F", "forces", "force", -1], ["y", "sensors", "sensor", 1]].flatMap(([sign, side, tone, way]) => parts[side].flatMap(([plus, minus]) => {
      const text = plus === node ? sign : minus === node ? `−${sign}` : "";
      return text ? [svg("g", { class: tone }, svg("path", { d: way < 0 ? `M${x - 42} ${y - 32}H${x - 8}l-7 -4v8l7 -4` : `M${x + 8} ${y - 22}v-10H${x + 36}` }), svg("text", { x: x + way * 46, y: y - 28 }, text))] : [];
    }));
    const has = [parts.forces.some((e) => e.includes(node)) ? "force" : "", parts.sensors.some((e) => e.includes(node)) ? "sensor" : ""].filter(Boolean).join(" and ");
    return svg("g", { "data-node": node, tabindex: 0, role: "button", class: picked === node ? "mass picked" : "mass", "aria-label": `Mass ${node}${has ? `, ${has}` : ""}`, "aria-pressed": String(picked === node), onkeydown: keys(node) },
      svg("rect", { x: x - SIZE / 2, y: y - SIZE / 2, width: SIZE, height: SIZE, rx: 4 }), svg("text", { x, y: y + 5 }, `m${node}`), signs);
  };
  const groundOf = () => svg("g", { "data-node": GROUND, tabindex: 0, role: "button", class: picked === GROUND ? "ground picked" : "ground", "aria-label": "Ground", "aria-pressed": String(picked === GROUND), onkeydown: keys(GROUND) },
    svg("rect", { x: 10, y: FLOOR, width: WIDTH - 20, height: 24 }),
    svg("path", { d: `M10 ${FLOOR}H${WIDTH - 10}${Array.from({ length: 26 }, (_, i) => `M${20 + i * 20} ${FLOOR}l-8 10`).join("")}` }));
  const draw = () => {
    const focused = canvas.contains(document.activeElement) ? document.activeElement.dataset.node : undefined;
    canvas.dataset.tool = tool;
    canvas.replaceChildren(groundOf(), ...parts.joints.map(jointOf), ...parts.masses.map(massOf));
    if (focused !== undefined) canvas.querySelector(`[data-node="${focused}"]`)?.focus();
    showHint();
  };
  return {
    nodes: [element("div", { class: "toolbar" }, tools, add), canvas, hint],
    show: (given, at = {}) => { // parts that come from elsewhere; places of masses that stay are kept
      if (JSON.stringify(given) !== JSON.stringify(parts)) picked = null; // an answer about the same machine keeps the choice
      parts = given;
      places = arrange(parts, Object.fromEntries(Object.entries({ ...places, ...at }).filter(([node]) => parts.masses.includes(+node))));
      draw();
    },
    places: () => places,
  };
};
