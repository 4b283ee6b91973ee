// Two machines under one force, by the scripts of the pages of motion: `drawGraph`, `moved` and their like.
import { element, svg } from "./dom.js";

const SCRIPTS = ["motion-machine.js", "motion-run.js", "motion-graph.js"];
const SECONDS = 20, STEPS = 1200, WAY = 34; // of a run; largest way of a mass in a drawing
const load = (name) => new Promise((resolve, reject) => {
  const script = element("script", { src: `/site/${name}`, onload: resolve, onerror: () => reject(new Error("The picture in motion cannot be loaded.")) });
  document.head.append(script);
});
let scripts = null;
const loadScripts = () => (scripts ??= SCRIPTS.reduce((before, name) => before.then(() => load(name)), Promise.resolve()));

export const createMotion = () => {
  let runs = [], playing = false, time = 0, before = null, frame = 0;
  const drawings = ["one", "two"].map(() => svg("svg", { class: "chain", role: "img" })), captions = ["one", "two"].map(() => element("figcaption"));
  const curve = svg("svg", { viewBox: "0 0 640 150", class: "curves", role: "img", "aria-label": "What the sensor shows over time, of model 1 broad and of model 2 dashed" });
  const how = element("p", { id: "motion-how" });
  const slider = element("input", { type: "range", min: 0, max: STEPS, step: 1, value: 0, "aria-label": "Time", oninput: () => { time = (+slider.value / STEPS) * SECONDS; paint(); } });
  const button = element("button", { type: "button", class: "plainbutton main", onclick: () => play(!playing) }, "Play");
  const cursor = svg("path", { class: "cursor" });

  const paint = () => {
    const at = Math.min(STEPS, Math.round((time / SECONDS) * STEPS));
    runs.forEach(({ move, places, masses, gain }) => move(Array.from({ length: masses }, (_, i) => gain * places[at * masses + i])));
    slider.value = at;
    const x = 10 + (620 * at) / STEPS;
    cursor.setAttribute("d", `M${x} 8V142`);
  };
  const tick = (stamp) => {
    if (!playing) return;
    time = (time + (before === null ? 0 : (stamp - before) / 1000)) % SECONDS;
    before = stamp;
    paint();
    frame = requestAnimationFrame(tick);
  };
  const play = (on) => {
    playing = on;
    before = null;
    button.textContent = on ? "Pause" : "Play";
    cancelAnimationFrame(frame);
    if (on) frame = requestAnimationFrame(tick);
  };
  const pathOf = (values, most) => `M${Array.from(values, (value, i) => `${(10 + (620 * i) / STEPS).toFixed(1)} ${(75 - (62 * value) / most).toFixed(1)}`).join("L")}`;
  const show = async ({ machines, values, same }, names) => {
    await loadScripts();
    const force = forceOf("step", { steps: STEPS, duration: SECONDS });
    const found = machines.map((given, i) => {
      const machine = machineOf(given), run = moved(machine, partsOf(machine, values[i]), force, SECONDS / STEPS);
      return { ...run, masses: machine.masses, move: drawGraph(drawings[i], given) };
    });
    const most = Math.max(1e-12, ...found.map(({ places }) => places.reduce((high, x) => Math.max(high, Math.abs(x)), 0)));
    runs = found.map((run) => ({ ...run, gain: WAY / most }));
    const highest = Math.max(1e-12, ...found.map(({ acceleration }) => acceleration.reduce((high, x) => Math.max(high, Math.abs(x)), 0)));
    curve.replaceChildren(svg("path", { class: "axis", d: "M10 75H630" }), ...found.map(({ acceleration }, i) => svg("path", { class: i ? "two" : "one", d: pathOf(acceleration, highest) })), cursor);
    captions.forEach((caption, i) => { caption.textContent = names[i]; });
    drawings.forEach((drawing, i) => drawing.setAttribute("aria-label", `${names[i]} in motion`));
    how.textContent = same ? "Both show the same acceleration at the sensor, and move differently inside: the values of model 2 are those that give the response of model 1."
      : "Both have values of their own here: they show how each may move, and the curves need not agree.";
    time = 0;
    paint();
    play(!matchMedia("(prefers-reduced-motion: reduce)").matches);
  };
  return {
    nodes: [element("p", { class: "buttons" }, button, slider), element("div", { class: "two-drawings" }, drawings.map((drawing, i) => element("figure", {}, captions[i], drawing))),
      element("p", { class: "hint" }, "Force: a step for 10 s. The travel of what nothing holds is left out, and the motion is enlarged, both alike. Acceleration at the sensor, model 1 broad, model 2 dashed:"), curve, how],
    show,
    stop: () => play(false),
  };
};
