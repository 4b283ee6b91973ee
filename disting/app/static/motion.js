// Two machines under one force and their Bode diagrams, by the scripts of the site's pages of motion: `drawGraph`, `moved`, `plotBode`
// and their like.
import { element, svg } from "./dom.js";

const SCRIPTS = ["machine", "run", "graph", "plots", "maps", "imitate", "second"].map((name) => `motion-${name}.js`);
const SECONDS = { step: 20, sweep: 40 }, SAMPLES = 30; // of a run; samples in a period of the fastest motion
const WAY = 34; // largest way of a mass in a drawing
const BAND = [0.1, 100]; // Hz, where nothing oscillates
const NEAREST = { distinguishable: "never", sometimes: "sometimes" }; // what the search for near values may expect; else "open"
const load = (name) => new Promise((resolve, reject) => {
  const script = element("script", { src: `/site/${name}`, onload: resolve, onerror: () => reject(new Error("The picture in motion cannot be loaded.")) });
  document.head.append(script);
});
let scripts = null;
const loadScripts = () => (scripts ??= SCRIPTS.reduce((before, name) => before.then(() => load(name)), Promise.resolve()));
const largestOf = (lists) => lists.reduce((high, list) => list.reduce((most, x) => Math.max(most, Math.abs(x)), high), 1e-12);

export const createMotion = () => {
  let turn = 0, pair = null, run = null, playing = false, time = 0, before = null, frame = 0, second = null, showRun = () => {}, showBode = () => {};
  const drawings = ["one", "two"].map(() => svg("svg", { class: "chain", role: "img" })), captions = ["one", "two"].map(() => element("figcaption"));
  const curves = svg("svg", { id: "motion-run", class: "plot", role: "img" }), bode = svg("svg", { id: "motion-bode", class: "plot", role: "img" });
  const how = element("p", { id: "motion-how" }), nearest = element("div", { id: "motion-nearest" }), hint = element("p", { class: "hint" });
  const slider = element("input", { type: "range", min: 0, max: 1000, step: 1, value: 0, "aria-label": "Time", oninput: () => { time = (+slider.value / 1000) * run.duration; paint(); } });
  const button = element("button", { type: "button", class: "plainbutton main", onclick: () => play(!playing) }, "Play");
  const forces = element("fieldset", { class: "segments" }, element("legend", { class: "unseen" }, "Force"), [["step", "Step"], ["sweep", "Slow frequency sweep"]].map(([value, title]) => element("label", {},
    element("input", { type: "radio", name: "force", value, checked: value === "step", onchange: () => { time = 0; compute(); } }), element("span", {}, title))));
  const kind = () => forces.querySelector(":checked").value;

  const paint = () => {
    const at = clamped(Math.round((time / run.duration) * run.steps), 0, run.steps);
    run.motions.forEach(({ places }, i) => pair.move[i](Array.from({ length: pair.machines[i].masses }, (_, k) => run.gain * places[at * pair.machines[i].masses + k])));
    showRun(time, at);
    showBode(kind() === "sweep" ? sweepFrequency(time, run) : 0);
    slider.value = (1000 * time) / run.duration;
    slider.setAttribute("aria-valuetext", `${time.toFixed(1)} s${kind() === "sweep" ? `, ${short(sweepFrequency(time, run))} Hz` : ""}`);
  };
  const tick = (stamp) => {
    if (!playing) return;
    time = (time + (before === null ? 0 : (stamp - before) / 1000)) % run.duration;
    before = stamp;
    paint();
    frame = requestAnimationFrame(tick);
  };
  const play = (on) => {
    playing = on && run !== null;
    before = null;
    button.textContent = playing ? "Pause" : "Play";
    cancelAnimationFrame(frame);
    if (playing) frame = requestAnimationFrame(tick);
  };
  const partsOfBoth = () => pair.machines.map((machine, i) => partsOf(machine, pair.values[i]));
  const bandOf = (machine, parts) => {
    const [slow, fast] = [machine.loose + 1, machine.masses].map((which) => (which > machine.masses ? 0 : frequencyOf(machine, parts, which) / (2 * Math.PI)));
    return slow > 0 ? [roundDown(slow / 5), 10 / roundDown(10 / (fast * 3))] : BAND;
  };
  const compute = () => {
    const parts = partsOfBoth(), bands = pair.machines.map((machine, i) => bandOf(machine, parts[i])), [from, to] = bands[0]; // in which model 2 follows model 1
    const duration = SECONDS[kind()], fastest = Math.max(kind() === "sweep" ? to : 0, ...bands.map(([, high]) => high / 3)), steps = Math.round(clamped(duration * SAMPLES * fastest, 1500, 12000));
    const asked = { steps, duration, from, to }, force = forceOf(kind(), asked);
    const motions = pair.machines.map((machine, i) => moved(machine, parts[i], force, duration / steps));
    run = { ...asked, force, motions, gain: WAY / largestOf(motions.map(({ places }) => places)) };
    hint.textContent = `Force: ${kind() === "step" ? `a step for ${duration / 2} s` : `a sine from ${short(from)} to ${short(to)} Hz in ${duration} s`}. The travel of what nothing holds is left out, and the motion is enlarged, both alike. Model 1 is the broad curve, model 2 the dashed one.`;
    draw();
  };
  const draw = () => {
    const { force, motions, duration, from, to } = run, parts = partsOfBoth(), [a, b] = pair.names;
    showRun = plotRun(curves, { force, curves: motions.map(({ acceleration }) => acceleration), duration, title: "acceleration at the sensor in m/s²" });
    curves.setAttribute("aria-label", `Force and acceleration at the sensor over ${duration} s, of ${a} and ${b}`);
    const lines = linesOf(2 * Math.PI * from, 2 * Math.PI * to, 600);
    showBode = plotBode(bode, { lines, bodes: pair.machines.map((machine, i) => bodeOf(machine, parts[i], lines)), most: pair.most, title: "amplitude of y/F in dB" });
    bode.setAttribute("aria-label", `Bode diagrams of ${a} and ${b} from ${short(from)} to ${short(to)} Hz`);
    paint();
  };
  new ResizeObserver(() => { if (run && bode.getBoundingClientRect().width) draw(); }).observe(bode);

  // Of two models that differ: the values of model 2 whose response is nearest, and where it is furthest off.
  const showNearest = (mine) => ({ values, how: found, most, searching }) => {
    if (pair !== mine) return;
    Object.assign(pair, { values: [mine.values[0], values], most });
    const names = mine.machines[1].names, [low, high] = second.band(mine.machines[0], mine.values[0]).map((omega) => short(omega / (2 * Math.PI)));
    how.textContent = found !== "nearest" ? "These values of model 2 give the response of model 1, as far as was computed."
      : `Model 2 has the values whose response is nearest to that of model 1 from ${low} to ${high} Hz${searching ? ", so far" : ", as far as was found"}: it is off by up to ${short(Math.abs(most.decibels))} dB, at ${short(most.omega / (2 * Math.PI))} Hz.`;
    nearest.dataset.state = searching ? "searching" : "found";
    nearest.replaceChildren(element("p", { class: "hint" }, `Values of model 1: ${listOf(mine.machines[0].names, mine.values[0])}.`), element("p", { class: "hint" }, `Nearest values of model 2: ${listOf(names, values)}.`));
    compute();
  };
  const listOf = (names, values) => names.map((name, i) => `${name} = ${short(values[i])}`).join(", ");
  const show = async ({ machines, values, same }, names, relation) => {
    const mine = ++turn;
    await loadScripts();
    if (mine !== turn) return; // it was stopped meanwhile
    pair = { names, values, most: null, machines: machines.map(machineOf), move: machines.map((given, i) => drawGraph(drawings[i], given)) };
    captions.forEach((caption, i) => { caption.textContent = names[i]; });
    drawings.forEach((drawing, i) => drawing.setAttribute("aria-label", `${names[i]} in motion`));
    how.textContent = same ? "Both show the same acceleration at the sensor, and move differently inside: the values of model 2 are those that give the response of model 1." : "";
    nearest.replaceChildren();
    delete nearest.dataset.state;
    time = 0;
    if (same) compute();
    else {
      const found = showNearest(pair), [given, other] = pair.machines;
      second = createSecond(found);
      found(second.follow({ given, other, values: values[0], usual: values[1], kind: NEAREST[relation] ?? "open", pair: names.join(" ") }));
    }
    play(!matchMedia("(prefers-reduced-motion: reduce)").matches);
  };
  return {
    nodes: [element("p", { class: "buttons" }, button, slider), forces, how,
      element("div", { class: "motion-stage" },
        element("div", {}, element("div", { class: "two-drawings" }, drawings.map((drawing, i) => element("figure", {}, captions[i], drawing))), curves), bode), hint, nearest],
    show,
    stop: () => { turn++; pair = run = null; play(false); },
  };
};
