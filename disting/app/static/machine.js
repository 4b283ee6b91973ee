// Page of one machine: drawn on the bench, typed, or chosen; with every change what can be determined, what looks the same, what to
// measure next.
import { element } from "./dom.js";
import { EMPTY, changeJoint, removeJoint, togglePort } from "./parts.js";
import { createBench } from "./bench.js";
import { commandFold, evidenceButton, facts, folded, picture, valuesTable, waitFor } from "./answers.js";
import { ask as showBoth } from "./compare.js";

const GALLERY = [
  ["Motor and load", "1=2; F1; S1"], ["Motor, gear, load", "1=2*i, 2-#; F1; S1"], ["Belt axis", "1=2=3, 3-#; F1; S1"], ["Gantry", "1=3, 2=3, 3=4, 1-#, 2-#; F1; S4"],
  ["Two encoders", "1=2; F1; S1 S2"], ["Randles cell", "R0-p(R1-W1,C1)"], ["Two compartments", "1>2, 2>1, 2>0; in 1; out 1"],
];
const PAUSE = 120; // ms after the last key before a text is read
const SHOWN = 3; // models of which the values are shown at once
const MOST = 6; // of a menu, beside the machine
const kept = (name, key) => `m_${name}_${key}`;

export const start = async (root, call) => {
  let turn = 0, timer = null, now = null, values = {}, queue = Promise.resolve(), open = new Set();
  const text = element("input", { type: "text", id: "machine-text", spellcheck: "false", autocomplete: "off", maxlength: 5000, "aria-describedby": "machine-trouble" });
  const gallery = element("select", { id: "machine-gallery" }, element("option", { value: "" }, "Choose …"), GALLERY.map(([title, of]) => element("option", { value: of }, title)));
  const trouble = element("p", { class: "trouble", id: "machine-trouble", role: "alert" });
  const bench = createBench((parts) => read({ parts }));
  const place = (id) => element("div", { id, class: "answer" });
  const drawing = place("drawing"), list = place("parts-list"), determined = place("determined"), alike = place("alike"), next = place("next");
  const editor = element("div", {}, bench.nodes, list), asText = element("p", { class: "hint", hidden: true }, "Circuits and compartments are written as text: change the text above.");
  const answers = element("div", { class: "answers" });
  answers.append(
    element("section", {}, element("h2", {}, "Which parameters can be determined"), determined),
    element("section", {}, element("h2", {}, "What looks the same"), alike),
    element("section", {}, element("h2", {}, "What to measure next"), next));
  root.append(
    element("h1", { class: "unseen" }, "Machine"),
    element("section", {},
      element("div", { class: "fields" },
        element("p", { class: "field wide-field" }, element("label", { for: "machine-text" }, "Machine, circuit or compartments, in any notation"), text),
        element("p", { class: "field" }, element("label", { for: "machine-gallery" }, "or an example"), gallery)),
      trouble, editor, asText, drawing),
    answers);

  // Another machine or other values: answers that are not there yet are given up.
  const begin = () => {
    const mine = ++turn;
    clearTimeout(timer);
    for (const promise of open) promise.leave();
    open = new Set();
    return () => mine === turn;
  };
  const ask = (name, request) => {
    const promise = call(name, request), mine = open;
    mine.add(promise);
    promise.catch(() => {}).finally(() => mine.delete(promise));
    return promise;
  };
  const read = async (request, at = {}) => {
    const isCurrent = begin();
    answers.classList.add("stale");
    let answer;
    try {
      answer = await ask("machine", request);
    } catch (problem) {
      if (!isCurrent()) return;
      trouble.textContent = problem.message;
      for (const busy of answers.querySelectorAll("[aria-busy=true]")) { busy.replaceChildren(); busy.setAttribute("aria-busy", "false"); }
      return;
    }
    if (!isCurrent()) return;
    trouble.textContent = "";
    if (now?.text !== answer.text) values = answer.values;
    now = answer;
    if ("parts" in request) text.value = answer.text;
    showEditor(request, at);
    drawing.replaceChildren(picture(answer.drawing), element("p", { class: "hint" }, answer.words), ...(answer.unseen.length ? [element("p", {}, `Without effect on the response: ${answer.unseen.join(", ")}.`)] : []), showValues(isCurrent));
    call("save", { page: "machine", content: { text: answer.text, places: bench.places() } }).catch(() => {});
    await answerAll(answer, isCurrent);
  };
  const showValues = (isCurrent) => folded("Values of this model", element("div", { class: "fields" }, now.parameters.map((name) => element("p", { class: "field" },
    element("label", { for: `value-${name}` }, name), element("input", { type: "text", id: `value-${name}`, value: values[name], maxlength: 100, onchange: (event) => {
      values = { ...values, [name]: event.target.value.trim() };
      answerAll(now, begin());
    } })))));
  const showEditor = (request, at) => {
    const { parts } = now;
    editor.hidden = !parts;
    asText.hidden = Boolean(parts);
    if (!parts) return;
    bench.show("parts" in request ? request.parts : parts, at);
    showList(parts);
  };
  // Slow questions one after the other, and only those of the machine that is there: so workers are free for the next change.
  const later = (isCurrent, work) => {
    queue = queue.then(() => (isCurrent() ? work() : null));
    return queue;
  };
  const answerAll = async ({ text: of, sensors, count }, isCurrent) => {
    const apart = element("div", { class: "answer" }), more = element("div", { class: "answer" });
    answers.classList.remove("stale");
    next.replaceChildren(apart, more);
    const [known, rows] = await Promise.all([
      waitFor(determined, "Deciding which of them have one value", ask("determine", { text: of }), showDetermined(of), isCurrent, count ? [element("p", { class: "count" }, count)] : []),
      waitFor(alike, "Looking up", ask("alike", { text: of, values }), (answer) => showAlike(answer, of, isCurrent), isCurrent).then((found) => {
        if (isCurrent() && found) showApart(apart, of, sameOf(found), isCurrent);
        return found;
      })]);
    if (!isCurrent()) return;
    const isGlobal = known?.levels.every(({ level }) => level === "global"), masses = known && !isGlobal ? sensors : [];
    showSensors(more, of, masses, isCurrent);
    if (!masses.length && !(rows && sameOf(rows).length)) next.replaceChildren(element("p", {}, nothingNext(known, isGlobal, rows)));
  };
  const sameOf = ({ rows }) => {
    const isSame = ({ relation }) => relation === "indistinguishable", row = rows.find(({ others }) => others.some(isSame));
    return (row?.others ?? []).filter(isSame).map(({ name }) => name).slice(0, MOST);
  };
  const nothingNext = (known, isGlobal, rows) => `${!known ? "Not known: whether all parameters can be determined was not decided." : isGlobal ? "Every parameter has one value." : "Not every parameter has one value; what would determine more is not searched for models of this kind."} ${
    !rows ? "" : rows.rows.length ? "No listed model is known to be indistinguishable from it." : "No catalogue lists this model: whether another one looks the same is not known."}`;
  const showDetermined = (of) => (answer) => {
    const groups = Map.groupBy ? Map.groupBy(answer.levels, ({ level }) => level) : answer.levels.reduce((map, one) => map.set(one.level, [...(map.get(one.level) ?? []), one]), new Map());
    return [
      element("p", { class: "verdict", "data-of": of }, answer.sentence),
      facts([...[...groups].map(([level, some]) => [level, some.map(({ name }) => name).join(", ")]), ["certainty", answer.certainty], ["reason", answer.reason]]),
      commandFold(answer.command)];
  };
  const showAlike = ({ rows }, of, isCurrent) => {
    if (!rows.length) return element("p", {}, "No catalogue lists this model. The page Two models compares it with any other one.");
    return rows.flatMap(({ title, sentence, others, command }) => [
      element("h3", {}, title), element("p", {}, sentence),
      element("ul", { class: "others" }, others.slice(0, SHOWN).map((other) => showOther(other, of, isCurrent))),
      others.length > SHOWN ? folded(`${others.length - SHOWN} more`, element("ul", { class: "others" }, others.slice(SHOWN).map((other) => showOther(other, of, isCurrent, false)))) : null,
      others.length ? commandFold(command) : null]);
  };
  const showOther = ({ name, relation, drawing: drawn }, of, isCurrent, isWithValues = true) => {
    const found = element("div", { class: "answer" }), pair = { left: of, right: name };
    if (isWithValues && relation === "indistinguishable")
      later(isCurrent, () => waitFor(found, "Values", ask("values", { ...pair, values }), ({ given, sets, extent, command }) => [
        sets.length ? valuesTable(given, sets, ["this machine", "the other"]) : element("p", {}, "No values were found."), element("p", { class: "hint" }, sets.length ? `Same response; ${extent}.` : extent), commandFold(command)], isCurrent));
    return element("li", {},
      element("p", {}, element("strong", {}, name), " ", element("span", { class: `key ${relation}`, "aria-hidden": "true" }), ` ${relation === "sometimes" ? "the same for some values" : relation === "indistinguishable" ? "indistinguishable" : "not decided"}`),
      picture(drawn), found,
      element("p", { class: "buttons" }, element("button", { type: "button", class: "plainbutton", onclick: () => showBoth(of, name) }, "Compare both"), " ", evidenceButton(call, pair)));
  };
  const showApart = (apart, of, same, isCurrent) => {
    if (!same.length) return;
    later(isCurrent, () => waitFor(apart, "What separates the models that look the same", ask("separate", { text: of, others: same }), ({ sentence, least, command }) => [
      element("h3", {}, "To separate it from what looks the same"), element("p", {}, sentence), element("p", {}, `If it is this machine: ${least}.`), commandFold(command)], isCurrent));
  };
  const showSensors = (more, of, sensors, isCurrent) => {
    if (sensors.length) more.append(element("h3", {}, "A further sensor, to determine more parameters"));
    for (const mass of sensors) {
      const line = element("div", { class: "answer" });
      more.append(line);
      later(isCurrent, () => waitFor(line, `Sensor at mass ${mass}`, ask("sensor", { text: of, mass }), ({ sentence, certainty, command }) => [
        element("p", {}, element("strong", {}, `Sensor at mass ${mass}: `), sentence, element("span", { class: "hint" }, ` ${certainty}`)), commandFold(command)], isCurrent));
    }
  };

  // ---- the parts as a list, for keys and for what has no place on the bench: gears, ends of forces and sensors, the quantity
  const showList = (parts) => {
    const nodes = (own, withGround = true) => [...(withGround ? [0] : []), ...parts.masses].map((node) => element("option", { value: node, selected: node === own }, node ? `mass ${node}` : "ground"));
    const edit = (changed) => read({ parts: changed });
    const focusBack = (id) => requestAnimationFrame(() => document.getElementById(id)?.focus());
    const joints = parts.joints.map(({ from, to, kind, ratio }, i) => element("tr", {},
      element("th", { scope: "row" }, `mass ${from} – ${to ? `mass ${to}` : "ground"}`),
      element("td", {}, element("select", { id: kept("kind", i), "aria-label": `Joint of mass ${from} and ${to ? `mass ${to}` : "ground"}`, onchange: (event) => { edit(changeJoint(parts, i, { kind: event.target.value })); focusBack(kept("kind", i)); } },
        [["both", "spring + damper"], ["spring", "spring"], ["damper", "damper"]].map(([value, title]) => element("option", { value, selected: value === kind }, title)))),
      element("td", {}, to ? element("input", { type: "text", value: ratio, size: 6, maxlength: 20, placeholder: "none", "aria-label": `Gear ratio of mass ${from} and mass ${to}`, onchange: (event) => edit(changeJoint(parts, i, { ratio: event.target.value.trim() })) }) : ""),
      element("td", {}, element("button", { type: "button", class: "plainbutton", "aria-label": `Remove joint of mass ${from} and ${to ? `mass ${to}` : "ground"}`, onclick: () => edit(removeJoint(parts, from, to)) }, "Remove"))));
    const ports = [["forces", "Force"], ["sensors", "Sensor"]].flatMap(([side, title]) => parts[side].map(([plus, minus], i) => {
      const change = (ends) => edit({ ...parts, [side]: parts[side].map((old, k) => (k === i ? ends : old)) });
      return element("tr", {}, element("th", { scope: "row" }, title),
        element("td", {}, element("select", { "aria-label": `${title} ${i + 1}: at`, onchange: (event) => change([+event.target.value, minus]) }, nodes(plus, plus === 0))),
        element("td", {}, element("select", { "aria-label": `${title} ${i + 1}: against`, onchange: (event) => change([plus, +event.target.value]) }, nodes(minus))),
        element("td", {}, element("button", { type: "button", class: "plainbutton", "aria-label": `Remove ${title.toLowerCase()} ${i + 1}`, onclick: () => edit(togglePort(parts, side, plus, minus)) }, "Remove")));
    }));
    const quantity = element("select", { id: "quantity", onchange: (event) => edit({ ...parts, quantity: event.target.value }) }, ["position", "velocity", "acceleration"].map((name) => element("option", { value: name, selected: name === parts.quantity }, name)));
    const wasOpen = list.querySelector("details")?.open;
    const fold = folded("Parts: joints, gears, force, sensor", element("div", { class: "wide", tabindex: 0, role: "group", "aria-label": "Parts" }, element("table", { class: "plain" },
      element("thead", {}, element("tr", {}, ["part", "kind, or at", "gear ratio, or against", ""].map((title) => (title ? element("th", { scope: "col" }, title) : element("td", {}))))), element("tbody", {}, joints, ports))),
    element("p", { class: "field narrow" }, element("label", { for: "quantity" }, "Sensors show"), quantity));
    fold.open = Boolean(wasOpen);
    list.replaceChildren(fold);
  };

  text.addEventListener("input", () => { clearTimeout(timer); timer = setTimeout(() => read({ text: text.value }), PAUSE); });
  gallery.addEventListener("change", () => {
    if (!gallery.value) return;
    text.value = gallery.value;
    read({ text: text.value });
  });
  bench.show(EMPTY);
  const saved = (await call("open", { page: "machine" }).catch(() => ({ content: null }))).content;
  if (text.value || text === document.activeElement) return; // somebody writes while the saved machine is on its way
  text.value = typeof saved?.text === "string" ? saved.text : GALLERY[0][1];
  await read({ text: text.value }, saved?.places ?? {});
};
