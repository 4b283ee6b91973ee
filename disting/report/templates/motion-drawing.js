// The drawing of a chain whose parts move: every point of a part goes where the masses that hold it take it. The parts are those of
// the still drawings, held once by the page.
const ROOM = 34; // by which every joint is longer than in a still drawing, for the motion
const drawMoving = (svg, chain, { size, wall, pitch, joint: length, mass }) => {
  const [gap, actMinus, actPlus, measMinus, measPlus] = chain.ports, n = chain.masses;
  const named = [`ground-${gap ? 1 : 0}`, ...chain.names.map((name) => name + (chain.damped && name[0] === "k" ? "-damped" : ""))];
  named.push(`gap-${gap}`, `sensor-${measMinus}-${measPlus}`, `force-${actMinus}-${actPlus}`); // from back to front
  const parts = named.map((name) => document.getElementById(`part-${name}`)).map((part) => {
    const copy = part?.cloneNode(true);
    copy?.removeAttribute("id");
    return copy; // the ground has no part where nothing stands on it
  });
  svg.replaceChildren(...parts.filter(Boolean));
  svg.setAttribute("viewBox", `0 0 ${size[0] + ROOM * (n + 0.8)} ${size[1]}`);
  // where a point is between two nodes: u(x) is linear, or all of the one or of the other
  const middle = (node) => (node ? wall + pitch * node - mass / 2 : wall);
  const linear = (from, to) => (x) => { // a shaft ends a little before its arrow's tip
    const share = clamped((x - middle(from) - 12) / (middle(to) - middle(from) - 24), 0, 1);
    return (u) => u[from] * (1 - share) + u[to] * share;
  };
  const joint = (i) => (x) => {
    const start = wall + pitch * i, share = clamped((x - start) / length, 0, 1);
    return (u) => u[i] * (1 - share) + u[i + 1] * share;
  };
  const fieldOf = (at, path) => {
    if (at === 0) return () => () => 0;
    const which = at - 1;
    if (which < chain.names.length) {
      const place = chain.places[which], kind = chain.kinds[which];
      if (kind === "m") return () => (u) => u[place + 1];
      if (kind === "k" || path < 0) return joint(place); // the name of a damper as a spring
      const start = wall + pitch * place; // the cup stays whole on its rod, and so does the piston
      if (path < 2) return (x) => (u) => u[place] + (x > start + 1 ? ROOM / 2 : 0);
      return (x) => (u) => u[place + 1] - (x < start + length - 1 ? ROOM / 2 : 0);
    }
    return [joint(gap), linear(measMinus, measPlus), linear(actMinus, actPlus)][which - chain.names.length];
  };
  const moves = [];
  parts.forEach((part, at) =>
    part?.querySelectorAll("path, rect, circle, text").forEach((shape) => {
      const path = [...part.querySelectorAll("path")].indexOf(shape), field = fieldOf(at, path);
      if (shape.tagName === "path") {
        const text = shape.getAttribute("d"), points = [...text.matchAll(/(-?[\d.]+) (-?[\d.]+)/g)].map(([, x, y]) => [+x, +y]);
        const head = at > chain.names.length && text.endsWith("z") && points.length === 3; // of an arrow: whole, at its tip
        const where = points.map(([x]) => field(head ? points[0][0] : x)), end = text.endsWith("z") ? "z" : "";
        moves.push((u) => shape.setAttribute("d", `M${points.map(([x, y], i) => `${(x + where[i](u)).toFixed(2)} ${y}`).join("L")}${end}`));
      } else {
        const name = shape.tagName === "circle" ? "cx" : "x", x = +shape.getAttribute(name);
        const where = field(shape.tagName === "rect" ? x + shape.getAttribute("width") / 2 : x);
        moves.push((u) => shape.setAttribute(name, (x + where(u)).toFixed(2)));
      }
    }),
  );
  return (displaced) => { // of the masses, in the drawing's units
    const u = [0, ...Array.from({ length: n }, (_, i) => (i + 1) * ROOM + displaced[i])];
    moves.forEach((move) => move(u));
  };
};
// The largest stretch between neighbours in a run, or a little less than the largest way of a mass: what the room of the drawing must
// hold.
const widest = (places, { near, masses: n }) => {
  let most = 0;
  for (let at = 0; at < places.length; at += n) {
    const of = (node) => (node ? places[at + node - 1] : 0);
    for (const [from, to] of near) most = Math.max(most, Math.abs(of(to) - of(from)));
    for (let i = 1; i <= n; i++) most = Math.max(most, 0.8 * Math.abs(of(i)));
  }
  return most;
};
