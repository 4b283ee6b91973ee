// After a fit: what to measure next, and how much more of the same; each a job whose answer stays with the fit.
import { command, element } from "./dom.js";
import { jobLine } from "./job.js";

const ASKED = {
  next: ["What to measure next", "What to measure next", "advice"],
  plan: ["Plan: how much more of the same", "How much more of the same to measure", "plan"],
};
const STEPS = { rival: "Rivals", "pages of the plan": "Pages of the plan" };
const sentence = (text) => (/^[a-z]+[\s:]/.test(text) ? text[0].toUpperCase() + text.slice(1) : text); // a path stays as it is

const words = (name, found, addNext) => {
  const { first, text, warnings, setup } = found[name], [, title] = ASKED[name];
  return element("section", { class: "onward", "aria-label": title },
    element("h3", { tabindex: -1 }, title),
    warnings.map((warning) => element("p", { class: "warning" }, sentence(warning.replace(/^warning: /, "")))),
    element("p", {}, `${sentence(first)}.`),
    setup ? element("p", {}, element("button", { type: "button", class: "plainbutton main", onclick: () => addNext(setup, found.fit) }, `Add this measurement (${setup})`)) : null,
    name === "plan" && found.files.includes("plan.html") ? element("p", {}, element("a", { href: `/project/fits/${found.fit}/plan.html`, target: "_blank", rel: "noopener" }, "Open the page of the plan")) : null,
    text === first ? null : element("details", {}, element("summary", {}, "In full"), element("pre", { class: "scroll", tabindex: 0, role: "group", "aria-label": `${title}, in full` }, text)),
    element("details", {}, element("summary", {}, "The same on the command line"), command(found[name].command)));
};

const ALONE = "Circuits and own models are fitted to one measurement: another one, such as the one advised, cannot be added to this fit. In Python, fit_networks fits several responses of models that have as many sensors.";

// {root, watch}: buttons and answers of a fit; `watch(name, promise)` takes a job that already runs.
export const onwardPart = ({ call, follow, addNext }, found) => {
  const isAlone = Boolean(found.request?.models?.length), line = jobLine("computation", STEPS), answers = element("div", {});
  const buttons = Object.entries(ASKED).map(([name, [text]]) => element("button", { type: "button", class: "plainbutton", onclick: () => watch(name, call(name, { fit: found.fit }, line.hear)) }, text));
  const present = () => answers.replaceChildren(...Object.keys(ASKED).filter((name) => found[name]).map((name) => words(name, found, addNext)));
  const watch = async (name, promise) => {
    for (const button of buttons) button.disabled = true;
    const answer = await line.run(promise);
    for (const button of buttons) button.disabled = false;
    if (!answer) return;
    Object.assign(found, answer);
    present();
    answers.querySelector(`[aria-label="${ASKED[name][1]}"] h3`).focus();
  };
  present();
  return {
    root: element("div", { class: "onward-part" }, element("p", {}, buttons.flatMap((button) => [button, " "]), isAlone ? null : element("button", { type: "button", class: "plainbutton", onclick: () => addNext("") }, "Add another measurement of this machine")), isAlone ? element("p", { class: "hint" }, ALONE) : null, line.root, answers),
    resume: ({ job, name }) => watch(name, follow(job, line.hear)),
  };
};
