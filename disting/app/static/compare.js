// Page of two models: verdict, why, formulas, values, and both machines in motion.
import { element } from "./dom.js";
import { commandFold, evidenceButton, facts, folded, picture, valuesTable, waitFor } from "./answers.js";
import { createMotion } from "./motion.js";

const FIRST = ["1=2=3; F1; S1", "3:11"];
const PAUSE = 400; // ms after the last key before both are compared
let open = null, pending = null;

// Show two models here, from another page.
export const ask = (left, right) => {
  pending = [left, right];
  location.hash = "#compare";
  open?.(...pending);
};

export const start = async (root, call) => {
  let turn = 0, timer = null, job = null;
  const field = (id, title) => {
    const input = element("input", { type: "text", id, spellcheck: "false", autocomplete: "off", maxlength: 5000, oninput: () => { clearTimeout(timer); timer = setTimeout(run, PAUSE); } });
    return [input, element("p", { class: "field" }, element("label", { for: id }, title), input)];
  };
  const [left, leftField] = field("compare-left", "Model 1"), [right, rightField] = field("compare-right", "Model 2");
  const swap = element("button", { type: "button", class: "plainbutton", "aria-label": "Exchange the two models", onclick: () => show(right.value, left.value) }, "⇄");
  const verdict = element("div", { class: "answer", id: "pair-verdict" }), formulas = element("div", { class: "answer", id: "pair-formulas" }), values = element("div", { class: "answer", id: "pair-values" });
  const motion = createMotion(), moving = element("section", { hidden: true }, element("h2", {}, "In motion"), motion.nodes);
  const map = element("section", { hidden: true }, element("h2", {}, "Values of model 2 from those of model 1"), formulas, values);
  root.append(
    element("h1", { class: "unseen" }, "Two models"),
    element("section", {}, element("p", { class: "hint" }, "A number such as 3:11, a machine, a circuit or compartments, in any notation."),
      element("div", { class: "pair-fields" }, leftField, swap, rightField)),
    element("section", {}, element("h2", {}, "Verdict"), verdict), map, moving);

  const showVerdict = (pair) => (answer) => [
    element("div", { class: "two-drawings" }, answer.drawings.map((drawn, i) => element("figure", {}, element("figcaption", {}, [pair.left, pair.right][i]), drawn ? picture(drawn) : null))),
    element("p", { class: "relation-line" }, element("span", { class: `key ${answer.relation}`, "aria-hidden": "true" }), " ", element("strong", { id: "relation" }, answer.in_words)),
    element("p", {}, answer.meaning),
    facts([["certainty", answer.certainty], ["evidence", answer.evidence]]),
    folded("The whole sentence", element("p", {}, answer.sentence)),
    commandFold(answer.command),
    element("p", { class: "buttons" }, evidenceButton(call, pair))];
  // A verdict that takes longer than a quick call may: asked for without a limit, it can be stopped.
  const decideLonger = (pair, mine) => {
    const stop = element("button", { type: "button", class: "plainbutton", onclick: () => job?.stop() }, "Stop"), place = element("div", { class: "answer" });
    const begin = element("button", { type: "button", class: "plainbutton", onclick: async () => {
      begin.replaceWith(stop);
      job = call("decide", pair, () => {});
      const answer = await waitFor(place, "Deciding without a limit", job, showVerdict(pair), () => mine === turn);
      stop.remove();
      if (answer && mine === turn) await showMore(pair, answer, mine);
    } }, "Decide without a limit of time");
    verdict.append(element("p", { class: "buttons" }, begin), place);
  };
  const showMore = async (pair, { relation }, mine) => {
    const isCurrent = () => mine === turn, isSame = relation === "indistinguishable";
    map.hidden = relation === "distinguishable";
    if (isSame) await waitFor(formulas, "Formulas", call("formulas", pair), ({ forms, reason }) => (forms.length ? forms.flatMap(({ text, certainty }) => [element("pre", { tabindex: 0 }, text), element("p", { class: "hint" }, certainty)]) : element("p", {}, reason)), isCurrent);
    else formulas.replaceChildren();
    if (!isCurrent()) return;
    const moved = call("motion", pair).catch(() => null);
    if (!map.hidden) await waitFor(values, "Values", call("values", pair), ({ given, sets, extent, command }) => [
      sets.length ? valuesTable(given, sets, ["model 1", "model 2"]) : element("p", {}, "No positive values of model 2 give the response of model 1 at these values, as far as was found."),
      element("p", { class: "hint" }, sets.length ? `Same response; ${extent}.` : extent), commandFold(command)], isCurrent);
    const answer = await moved;
    if (!isCurrent()) return;
    moving.hidden = !answer?.machines.length;
    if (!moving.hidden) motion.show(answer, [pair.left, pair.right], relation);
  };
  const run = async () => {
    const mine = ++turn, pair = { left: left.value, right: right.value };
    clearTimeout(timer);
    job?.stop();
    job = null;
    map.hidden = moving.hidden = true;
    motion.stop();
    const answer = await waitFor(verdict, "Deciding", call("compare", pair), showVerdict(pair), () => mine === turn).catch(() => null);
    if (mine !== turn) return;
    if (!answer) {
      if (verdict.textContent.includes("not finished")) decideLonger(pair, mine);
      return;
    }
    call("save", { page: "compare", content: pair }).catch(() => {});
    await showMore(pair, answer, mine);
  };
  const show = (one, two) => {
    left.value = one;
    right.value = two;
    run();
  };
  open = show;
  const saved = pending ?? (await call("open", { page: "compare" }).then(({ content }) => content && [content.left, content.right]).catch(() => null));
  if ([left, right].some((input) => input.value || input === document.activeElement)) return; // somebody writes while the saved pair is on its way
  show(...(saved?.every((text) => typeof text === "string") ? saved : FIRST));
};
