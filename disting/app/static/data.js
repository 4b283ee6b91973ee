// Data page: files, what was read of each, then the fit.
import { announce, command, element, svg } from "./dom.js";
import { follow, upload } from "./call.js";
import { fieldsOf } from "./fields.js";
import { fitSection } from "./fit.js";
import { draw } from "./plot.js";
import { zoomable } from "./zoom.js";

const PAUSE = 250; // milliseconds without a change after which a file is read again
const LARGEST = 200e6; // bytes of a file

const heading = (id, text) => element("h2", { id }, text);
const section = (id, title, ...children) => element("section", { id, "aria-labelledby": `${id}-title` }, heading(`${id}-title`, title), ...children);
const list = (items, name) => (items.length ? element("ul", { class: name }, items.map((item) => element("li", {}, item))) : null);

// What was read of a file: fields, diagram, assumptions, facts, columns.
const columnTable = ({ columns }) => element("div", { class: "scroll", tabindex: 0, role: "group", "aria-label": "Table of columns" },
  element("table", { class: "plain columns", "aria-label": "Columns" },
    element("thead", {}, element("tr", {}, ["No.", "Name", "Unit", "Role", "Why", "Begins with"].map((head) => element("th", { scope: "col" }, head)))),
    element("tbody", {}, columns.map((column) => element("tr", {},
      element("td", { class: "n" }, String(column.number ?? "")), element("th", { scope: "row" }, column.name || "–"), element("td", {}, column.unit),
      element("td", {}, column.used ? column.role : "not used"), element("td", {}, column.why.includes("assumed") ? element("strong", { class: "force" }, column.why) : column.why),
      element("td", {}, column.first.map((x) => (x === null ? "–" : String(+x.toPrecision(5)))).join(", ")))))));

const facts = (rows) => element("dl", { class: "provenance" }, rows.map(([name, text]) => element("div", {}, element("dt", {}, name[0].toUpperCase() + name.slice(1)), element("dd", {}, text))));

export const start = async (root, call) => {
  const state = { measurements: [], masses: [1, 2, 3, 4], ...((await call("open", { page: "data" })).content ?? {}) };
  let chosen = 0, asked = 0, timer = 0, redraw = () => {}, expected = {};
  const kept = new Set((await call("files", {})).files.map(({ name }) => name));
  state.measurements = state.measurements.filter(({ file }) => kept.has(file));
  delete state.measurements[0]?.role; // the first is always fitted
  const save = () => call("save", { page: "data", content: state }).catch((error) => trouble(error.message));

  const troubles = element("p", { class: "trouble", role: "alert" });
  const trouble = (sentence) => { troubles.textContent = sentence; };
  const picker = element("input", { type: "file", id: "file", class: "unseen", multiple: true });
  const pasted = element("textarea", { id: "pasted", rows: 6, spellcheck: "false" });
  const tabs = element("div", { class: "measurements", role: "group", "aria-label": "Measurements" });
  const drop = element("div", { class: "drop" },
    element("p", {}, element("label", { for: "file", class: "plainbutton main" }, "Choose a file"), picker, " or drop it here: a frequency response or a record of force and motion (CSV, text, MATLAB, UFF)."),
    element("details", {}, element("summary", {}, "Paste a table"), element("label", { for: "pasted" }, "Rows of numbers, with a header if there is one"), pasted,
      element("p", {}, element("button", { type: "button", class: "plainbutton", onclick: () => addPasted() }, "Read the table"))), troubles);
  const seenPart = element("div", { id: "seen" });
  const fitting = fitSection({ call, follow, state, save, trouble, addNext, setQuantity });
  const together = element("p", { class: "hint", id: "together", hidden: true }, "All are measurements of one machine. For another machine, remove them first (×); the files stay in the project folder.");
  root.append(element("h1", {}, "Data"), section("files", "Measurements", drop, tabs, together), seenPart, fitting.root);

  async function add(file, name = file.name) {
    if (file.size > LARGEST) return trouble(`${name} is larger than 200 MB, too large; choose a smaller file.`);
    trouble("");
    try {
      const { name: own } = await upload(file, name);
      const { places = {}, left } = state.measurements.length ? expected : {};
      expected = {};
      state.measurements.push({ file: own, reading: left ? structuredClone(state.measurements[0].reading) : {}, ...places });
      if (left) fitting.only(left);
      chosen = state.measurements.length - 1;
      await save();
      await show();
    } catch (error) { trouble(error.message); }
  }
  // The next file that is chosen was measured with this setup, such as sensor=2 or lock=2, which a fit advised: it is read
  // as the first one, and tells apart what that fit left.
  function addNext(setup, fit) {
    const [name, place] = setup.split("=");
    expected = !setup ? {} : { places: ["sensor", "force"].includes(name) ? { [name]: place } : { change: setup }, left: fit };
    picker.click();
  }
  picker.addEventListener("cancel", () => { expected = {}; });
  const addAll = async (files) => { for (const file of files) await add(file); };
  function addPasted() {
    if (pasted.value.trim()) add(new Blob([pasted.value]), "pasted.csv").then(() => { pasted.value = ""; });
    else trouble("Paste the rows of a table first.");
  }
  picker.addEventListener("change", () => addAll([...picker.files]).then(() => { picker.value = ""; }));
  for (const kind of ["dragover", "dragleave", "drop"]) addEventListener(kind, (event) => {
    event.preventDefault();
    drop.classList.toggle("over", kind === "dragover");
    if (kind === "drop") addAll([...event.dataTransfer.files]);
  });

  function setQuantity(quantity) {
    state.measurements.forEach((measurement) => { measurement.reading = { ...measurement.reading, quantity }; });
    save();
    return show();
  }

  const showTabs = () => {
    together.hidden = state.measurements.length < 2;
    tabs.replaceChildren(...state.measurements.map(({ file, role }, i) => element("span", { class: "measurement" },
      element("button", { type: "button", class: "plainbutton", "aria-pressed": String(i === chosen), onclick: () => { chosen = i; show(); } }, `${i + 1}. ${file}${role ? " (test)" : ""}`),
      element("button", { type: "button", class: "plainbutton", "aria-label": `Remove measurement ${i + 1}, ${file}`, onclick: () => remove(i) }, "×"))));
  };
  function remove(i) {
    state.measurements.splice(i, 1);
    delete state.measurements[0]?.role; // the first is always fitted
    chosen = Math.max(0, Math.min(chosen, state.measurements.length - 1));
    announce("Removed from the list; the file stays in the project folder.");
    save();
    show();
  }

  // Where the sensor and the force of a measurement are; of a further one also what it is for.
  const PLACES = [["sensor", "Sensor at mass"], ["force", "Force at mass"], ["change", "Change of the machine"]];
  const isTest = ({ role }) => role === "test";
  const places = (measurement, i) => element("fieldset", { class: "fields" }, element("legend", {}, i ? "This measurement beside the first" : "Places"),
    i ? element("p", { class: "field" }, element("label", { for: "role" }, "Use it to"), element("select", { id: "role", onchange: (event) => setRole(measurement, event.target.value) },
      [["", "fit together with the first"], ["test", "test the fit of the first"]].map(([value, text]) => element("option", { value, selected: (measurement.role ?? "") === value }, text)))) : null,
    isTest(measurement) ? element("p", { class: "hint" }, "The same machine, sensor and force, measured again. It is read as the first measurement, and tests the fit in place of cross-validation.") : PLACES.slice(0, i ? 3 : 2).map(([name, label], k) => element("p", { class: "field" },
      element("label", { for: `place-${name}` }, label),
      element("input", { id: `place-${name}`, type: "text", value: measurement[name] ?? "", placeholder: i ? ["as the first", "as the first", "lock=2 or inertia=1:0.5"][k] : "1", maxlength: 200, onchange: (event) => {
        if (event.target.value.trim()) measurement[name] = event.target.value.trim(); else delete measurement[name];
        save();
      } }))));
  function setRole(measurement, role) {
    for (const one of state.measurements) if (role && one.role) delete one.role; // one tests the fit
    if (role) measurement.role = role; else delete measurement.role;
    save();
    show();
  }

  const first = new Map(); // what was read without any field, by file: choices stay, whatever the fields hold
  async function show() {
    showTabs();
    const measurement = state.measurements[chosen], own = ++asked;
    if (!measurement) { seenPart.replaceChildren(); fitting.show(null); return; }
    fitting.wait();
    seenPart.setAttribute("aria-busy", "true");
    try {
      const plain = first.get(measurement.file) ?? await call("look", { file: measurement.file, reading: {} });
      first.set(measurement.file, plain);
      const { reading } = isTest(measurement) ? state.measurements[0] : measurement;
      const seen = Object.keys(reading).length ? await call("look", { file: measurement.file, reading }) : plain;
      if (own === asked) render(measurement, seen, plain);
    } catch (error) {
      if (own === asked) refuse(measurement, error.message);
    } finally {
      if (own === asked) seenPart.setAttribute("aria-busy", "false");
    }
  }

  const again = (measurement) => (edit) => {
    measurement.reading = edit(measurement.reading);
    asked += 1; // an answer to an older reading is not shown
    fitting.wait();
    clearTimeout(timer);
    timer = setTimeout(() => { save(); show(); }, PAUSE);
  };

  // Draw anew around the field in which somebody is writing.
  const replace = (part) => {
    const { id, value, selectionStart } = document.activeElement ?? {};
    seenPart.replaceChildren(part);
    const input = id && seenPart.querySelector(`#${id}`);
    if (!input) return;
    input.focus();
    if (input.type === "text") { input.value = value; input.setSelectionRange(selectionStart, selectionStart); }
  };

  function refuse(measurement, sentence) {
    const reset = element("button", { type: "button", class: "plainbutton", onclick: () => again(measurement)(() => ({})) }, "Read it without these settings");
    const plain = first.get(measurement.file);
    if (isTest(measurement)) { replace(section("read", `What was read: ${measurement.file}`, element("p", { class: "warning", role: "alert" }, sentence), places(measurement, chosen))); fitting.show(null); return; }
    const fields = plain && Object.keys(measurement.reading).length ? [fieldsOf(plain, measurement.reading, again(measurement), trouble), element("p", {}, reset)] : [];
    replace(section("read", `What was read: ${measurement.file}`, element("p", { class: "warning", role: "alert" }, sentence), ...fields));
    fitting.show(null);
  }

  function render(measurement, seen, plain) {
    const { look, diagram } = seen;
    const merged = { ...plain.look, record: look.record ?? plain.look.record, quantity: look.quantity, assumed: look.assumed, impedance: look.impedance, columns: look.columns };
    const picture = diagram ? svg("svg", { id: "diagram", class: `plot diagram ${diagram.kind}`, role: "img" }) : null;
    const plot = picture ? zoomable(picture, diagram, draw) : null;
    replace(section("read", `What was read: ${measurement.file}`,
      look.doubts.map((doubt) => element("p", { class: "warning" }, doubt)),
      isTest(measurement) ? null : fieldsOf(seen, measurement.reading, again(measurement), trouble, merged), look.impedance ? null : places(measurement, chosen),
      picture ? element("figure", { class: "panel" }, plot.root, element("figcaption", { class: "hint" }, diagram.wide ? "Bars: 95 % of the scatter of a line." : "The scatter of the lines is not known.")) : null,
      look.assumed.length ? element("h3", {}, "Assumed: change it above where it is wrong") : null, list(look.assumed.map(({ what }) => what), "near"),
      facts(seen.facts), element("details", {}, element("summary", {}, "Columns"), columnTable(look)),
      element("details", {}, element("summary", {}, "The same on the command line"), command(seen.command))));
    redraw = plot?.redraw ?? (() => {});
    redraw();
    announce(diagram ? picture.getAttribute("aria-label") : "No response was read.");
    fitting.show(seen);
  }
  new ResizeObserver(() => redraw()).observe(root);
  await show();
  await fitting.resume();
};
