// The drawing of a machine that is no chain: masses at `at` [x, y] move to the left and to the right, joints are drawn between where
// they are now; `grounds`: by mass, from 1, where the piece of ground is that holds it.
const SIDE = 34, ASIDE = 8;
const drawGraph = (svg, { masses, joints, kinds, places, names, act, meas, at, grounds, size }) => {
  const line = (attributes) => shape("path", { fill: "none", stroke: "currentColor", "stroke-width": 1.5, ...attributes });
  const write = (x, y, text, attributes) => shape("text", { x, y, "text-anchor": "middle", "font-family": "sans-serif", fill: "currentColor", ...attributes }, text);
  svg.classList.add("graph");
  svg.setAttribute("viewBox", `0 0 ${size.join(" ")}`);
  const both = (place) => kinds.filter((kind, i) => "kd".includes(kind) && places[i] === place).length > 1;
  const drawn = kinds.flatMap((kind, i) => {
    if (!"kd".includes(kind)) return [];
    const ratio = joints[places[i]][2], said = ratio === undefined ? names[i] : `${names[i]} *${typeof ratio === "number" ? short(ratio) : ratio}`;
    const aside = both(places[i]) ? (kind === "k" ? -ASIDE : ASIDE) : 0, path = line({}), name = write(0, 0, said, { "font-size": 11, fill: "var(--label)", stroke: "var(--paper)", "stroke-width": 3, "paint-order": "stroke" });
    return [{ kind, aside, path, name, ends: joints[places[i]] }];
  });
  const walls = Object.values(grounds).map(([x, y]) => line({ d: `M${x - 15} ${y}h30${[-12, -4, 4, 12].map((dx) => `M${x + dx} ${y}l-5 6`).join("")}` }));
  const boxes = Array.from({ length: masses }, (_, i) => {
    const [x, y] = at[i], group = shape("g", {}), port = (ends, sign, side, color) => {
      const which = ends.indexOf(i + 1); // 0: minus, 1: plus
      if (which < 0) return;
      const far = x + side * 30, high = y - SIDE / 2 - 14, tip = x + side * 4, [from, to] = which ? [far, tip] : [tip, far];
      if (side < 0) group.append(line({ d: `M${from} ${high}H${to}m${which ? "-7 -4l7 4l-7 4" : "7 -4l-7 4l7 4"}`, stroke: color }));
      else group.append(line({ d: `M${x + 8} ${y - SIDE / 2}V${high}H${far - 8}`, stroke: color }), shape("circle", { cx: x + 8, cy: y - SIDE / 2 - 2, r: 3.5, stroke: color, fill: which ? color : "var(--paper)" }));
      group.append(write(far + side * 5, high + 4, sign, { "font-size": 12, "font-weight": 700, fill: color }));
    };
    group.append(shape("rect", { x: x - SIDE / 2, y: y - SIDE / 2, width: SIDE, height: SIDE, rx: 3, fill: "var(--body)", stroke: "currentColor", "stroke-width": 1.5 }));
    group.append(write(x, y + 4.5, names[places.findIndex((place, k) => kinds[k] === "m" && place === i)], { "font-size": 13, "font-weight": 700 }));
    port(act, "F", -1, "var(--force)");
    port(meas, "y", 1, "var(--sensor)");
    return group;
  });
  svg.replaceChildren(...walls, ...drawn.map(({ path }) => path), ...boxes, ...drawn.map(({ name }) => name));
  const signs = { // along the joint from -1 to 1, and aside
    k: [[-1, 0], [-0.5, 0], [-0.42, -1], [-0.25, 1], [-0.08, -1], [0.08, 1], [0.25, -1], [0.42, 1], [0.5, 0], [1, 0]].map(([a, b]) => [a, 6 * b, a > -1]),
    d: [[-1, 0], [-0.25, 0, 1], [0.2, -6], [-0.25, -6, 1], [-0.25, 6, 1], [0.2, 6, 1], [0.05, -4], [0.05, 4, 1], [0.05, 0], [1, 0, 1]],
  };
  return (displaced) => { // of the masses, in the drawing's units
    const where = (node, other) => (node ? [at[node - 1][0] + displaced[node - 1], at[node - 1][1]] : grounds[other]);
    boxes.forEach((group, i) => group.setAttribute("transform", `translate(${displaced[i].toFixed(2)} 0)`));
    drawn.forEach(({ kind, aside, path, name, ends: [from, to, ratio] }) => {
      const [p, q] = [where(from, to), where(to, from)], length = Math.hypot(q[0] - p[0], q[1] - p[1]), u = [(q[0] - p[0]) / length, (q[1] - p[1]) / length];
      const half = length / 2, point = (a, b) => [0, 1].map((i) => (p[i] + q[i]) / 2 + a * half * u[i] + (b + aside) * (i ? u[0] : -u[1]));
      const wheel = ([x, y], r) => `M${(x - r).toFixed(2)} ${y.toFixed(2)}a${r} ${r} 0 1 0 ${2 * r} 0a${r} ${r} 0 1 0 ${-2 * r} 0`; // two of a gear, near its second node
      const gear = ratio === undefined ? "" : wheel(point(1 - 27.5 / half, 0), 4) + wheel(point(1 - 20.5 / half, 0), 3);
      path.setAttribute("d", signs[kind].map(([a, b, drawnTo]) => `${drawnTo ? "L" : "M"}${point(a, b).map((v) => v.toFixed(2)).join(" ")}`).join("") + gear);
      const away = point(0, aside < 0 || (!aside && kind === "k") ? -16 : 16);
      name.setAttribute("x", away[0].toFixed(2));
      name.setAttribute("y", (away[1] + 4).toFixed(2));
    });
  };
};
