// Fields of a reading: what each is called, how it is shown, what it is as read.
import { element } from "./dom.js";

const QUANTITIES = ["position", "velocity", "acceleration"];
const UNITS = {
  frequency: ["Hz", "rad/s"], magnitude: ["1", "dB"], phase: ["deg", "rad"],
  input: ["A", "Nm", "N"], output: ["rad", "rad/s", "rad/s^2", "deg", "rpm", "m", "mm", "m/s", "m/s^2"],
};
const ROLE = { frequency: ["frequency"], magnitude: ["gain"], phase: ["phase"], input: ["input"], output: ["output", "real part", "gain", "complex response"] };

const unitOf = (look, name) => look.columns.find((column) => column.used && ROLE[name].includes(column.role) && column.unit)?.unit ?? "";
const named = (column) => column.name || `column ${column.number}`;
const isAssumed = (look, word) => look.assumed.some(({ what }) => what.startsWith(word));

// Each: [name, label, kind, choices or unit, as read, assumed?, shown?]
const rows = ({ look, responses }) => {
  const record = look.record !== null, columns = look.columns.map((column) => [named(column), named(column)]);
  const read = look.columns.find((column) => column.used && ["gain", "real part", "complex response"].includes(column.role));
  return [
    ["column", "Response", "choice", responses.map(({ column, name }) => [column, name]), read ? named(read) : "", false, responses.length > 1],
    ["input", "Input", "choice", columns, look.columns.find((c) => c.role === "input" && c.used)?.name ?? "", false, record],
    ["output", "Output", "choice", columns, look.columns.find((c) => c.role === "output" && c.used)?.name ?? "", false, record],
    ["reference", "Reference of the controller", "choice", columns, look.columns.find((c) => c.role === "reference" && c.used)?.name ?? "none", false, record],
    ["sampling_rate", "Sampling rate", "number", "Hz", look.record?.sampling_rate ?? "", isAssumed(look, "sampling"), record],
    ["quantity", "Quantity", "choice", QUANTITIES.map((q) => [q, q]), look.quantity ?? "", isAssumed(look, "quantity"), !look.impedance],
    ["units.frequency", "Frequency unit", "choice", UNITS.frequency.map((u) => [u, u]), unitOf(look, "frequency"), isAssumed(look, "frequency"), !record],
    ["units.magnitude", "Magnitude unit", "choice", UNITS.magnitude.map((u) => [u, u]), unitOf(look, "magnitude"), isAssumed(look, "gain") || isAssumed(look, "magnitude"), look.columns.some((c) => c.used && c.role === "gain")],
    ["units.phase", "Phase unit", "choice", UNITS.phase.map((u) => [u, u]), unitOf(look, "phase"), isAssumed(look, "phase"), look.columns.some((c) => c.used && c.role === "phase")],
    ["units.input", "Input unit", "text", UNITS.input, record ? unitOf(look, "input") : "", isAssumed(look, "input"), !look.impedance],
    ["units.output", "Output unit", "text", UNITS.output, record ? unitOf(look, "output") : "", isAssumed(look, "output"), !look.impedance],
    ["sign", "Sign of the sensor", "choice", [["+", "+"], ["-", "− (reversed)"], ["auto", "whichever fits better"]], "+", false, !look.impedance],
    ["band.0", "Band from", "number", "Hz", look.lines ? look.lines.band[0] : "", false, true],
    ["band.1", "Band to", "number", "Hz", look.lines ? look.lines.band[1] : "", false, true],
    ["hold", "Input held for", "number", "s", "not held", false, !look.impedance],
    ["scale", "Multiply by", "number", "", "1", false, true],
    ["torque_constant", "Torque constant", "number", "Nm/A or N/A", "none", false, !look.impedance],
  ].filter((row) => row.at(-1));
};

const valueOf = (reading, name) => {
  const [own, part] = name.split(".");
  return part === undefined ? reading[own] : reading[own]?.[part];
};

// The reading with another value of one field; an empty one is as read.
const changed = (reading, name, value, look) => {
  const next = structuredClone(reading), [own, part] = name.split(".");
  if (own === "band") {
    const band = next.band ?? [look.lines?.band[0] ?? 0, look.lines?.band[1] ?? 1e9];
    band[part] = value === "" ? (part === "0" ? 0 : 1e9) : value;
    next.band = band;
    if (band[0] === 0 && band[1] === 1e9) delete next.band;
  } else if (part !== undefined) {
    next[own] = { ...next[own] };
    if (value === "") delete next[own][part]; else next[own][part] = value;
    if (!Object.keys(next[own]).length) delete next[own];
  } else if (value === "") delete next[own];
  else next[own] = value;
  return next;
};

const choice = (id, choices, asRead, value) => element("select", { id },
  element("option", { value: "", selected: value === undefined }, asRead === "" ? "as read" : `as read: ${asRead}`),
  choices.map(([own, text]) => element("option", { value: own, selected: String(own) === String(value) }, String(text))));
const text = (id, list, asRead, value) => [
  element("input", { id, type: "text", list: `${id}-list`, value: value ?? "", placeholder: asRead === "" ? "as read" : String(asRead), maxlength: 40, autocomplete: "off", spellcheck: "false" }),
  element("datalist", { id: `${id}-list` }, list.map((own) => element("option", { value: own }))),
];
const readable = (x) => (typeof x === "number" ? String(+x.toPrecision(6)) : x);
const number = (id, asRead, value) => element("input", { id, type: "text", inputmode: "decimal", value: value ?? "", placeholder: readable(asRead), maxlength: 40, autocomplete: "off" });

// The fields of a reading. `onEdit(edit)` hears of a change, which `edit(reading)` makes: several may come before the
// fields are drawn anew. `onTrouble(sentence)` hears of what is no number.
export const fieldsOf = (seen, reading, onEdit, onTrouble, shown = seen.look) => element("div", { class: "fields" }, rows({ ...seen, look: shown }).map(([name, label, kind, more, asRead, assumed]) => {
  const id = `field-${name.replace(".", "-")}`, value = valueOf(reading, name), isBand = name.startsWith("band");
  const own = isBand && (value === 0 || value === 1e9) ? undefined : value;
  const inputs = kind === "choice" ? choice(id, more, asRead, own) : kind === "text" ? text(id, more, asRead, own) : number(id, asRead, own);
  const input = Array.isArray(inputs) ? inputs[0] : inputs;
  const marked = assumed && value === undefined;
  const field = element("p", { class: marked ? "field assumed" : "field" },
    element("label", { for: id }, label, kind === "number" && more ? ` [${more}]` : "", marked ? element("strong", {}, " assumed") : null), inputs);
  input.addEventListener(kind === "choice" ? "change" : "input", () => {
    let next = input.value.trim();
    if (kind === "number" && next !== "") {
      next = Number(next.replace(",", "."));
      if (!Number.isFinite(next)) {
        input.setAttribute("aria-invalid", "true");
        onTrouble(`${label}: ${input.value} is no number.`);
        return;
      }
    }
    input.removeAttribute("aria-invalid");
    onTrouble("");
    if (name === "column" && next !== "") next = Number(next);
    onEdit((own) => changed(own, name, next, shown));
  });
  return field;
}));
