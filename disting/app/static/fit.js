// Fit of the Data page: candidates, progress, answer, earlier fits.
import { announce, command, element } from "./dom.js";
import { showFigures } from "./figures.js";
import { jobLine } from "./job.js";
import { onwardPart } from "./onward.js";
import { twoFits } from "./two-fits.js";

const WORDS = { fit: "Candidates fitted", "last digits": "Last digits of the parameters", equivalents: "Equivalent structures", networks: "Models fitted", intervals: "Intervals", proofs: "Proofs" };
const SHOWN = [["fit.html", "Open the page"], ["fit.json", "JSON"], ["model.mat", "MATLAB"], ["models.py", "Python (python-control)"], ["candidates.csv", "Candidates (CSV)"], ["bode.pdf", "Bode (PDF)"], ["plan.html", "Plan"]];
const EXAMPLES = { fix: "m1=0.02, Td=0.0003", bound: "k12=0..500" };
const address = (fit, name) => `/project/fits/${fit}/${name}`;
const sentence = (text) => text[0].toUpperCase() + text.slice(1);

const answerLine = (text) => {
  const [label, ...rest] = text.split(": ");
  return rest.length ? element("li", {}, element("strong", {}, `${sentence(label)}: `), rest.join(": ")) : element("li", {}, text);
};

export const fitSection = ({ call, follow, state, save, trouble, addNext, setQuantity }) => {
  let shown = null, onward = null, both = null;
  const line = jobLine("fit", WORDS);
  const button = element("button", { type: "button", class: "plainbutton main", onclick: () => begin() }, "Fit");
  const masses = element("fieldset", { class: "masses" }, element("legend", {}, "Masses"), [1, 2, 3, 4, 5].map((n) => element("label", {},
    element("input", { type: "checkbox", value: n, checked: state.masses.includes(n), onchange: () => {
      state.masses = [...masses.querySelectorAll("input:checked")].map((input) => Number(input.value));
      save();
    } }), ` ${n}`)));
  const damped = element("input", { type: "checkbox", id: "damped", checked: state.damped ?? true, onchange: () => { state.damped = damped.checked; save(); } });
  const base = element("input", { type: "checkbox", id: "base", checked: state.base ?? false, onchange: () => { state.base = base.checked; save(); } });
  const models = element("textarea", { id: "models", rows: 3, spellcheck: "false", placeholder: "R0-p(R1,C1)\nR0-p(R1,C1)-p(R2,C2)\ncells-4", onchange: () => { state.models = models.value; save(); } }, state.models ?? "");
  const option = (name, label, example) => element("p", { class: "field" }, element("label", { for: name }, label),
    element("input", { id: name, type: "text", value: state[name] ?? "", placeholder: example, maxlength: 300, spellcheck: "false", autocomplete: "off", onchange: (event) => { state[name] = event.target.value.trim(); save(); } }));
  const more = element("details", { open: ["fix", "bound", "controller"].some((name) => state[name]) }, element("summary", {}, "Known values, ranges, controller"), element("div", { class: "fields" },
    option("fix", "Known values (SI units; Td: dead time)", EXAMPLES.fix), option("bound", "Ranges of parameters", EXAMPLES.bound), option("controller", "Controller: its stability margins", "P=2,I=30")));
  const left = element("input", { type: "checkbox", id: "left", onchange: () => only(undefined) }), leftText = element("label", { for: "left" });
  const onlyLeft = element("p", {}, left, " ", leftText);
  const every = element("div", {}, masses, element("p", {}, damped, element("label", { for: "damped" }, " springs with dampers beside them ")), element("p", {}, base, element("label", { for: "base" }, " also on an elastic base")));
  const chains = element("div", {}, onlyLeft, every, more);
  const own = element("p", { class: "field wide" }, element("label", { for: "models" }, "Circuits or machines, one a line: by their text, or a family such as cells-4"), models);
  const sort = element("fieldset", { class: "segments" }, [["chains", "Chains of masses"], ["models", "Circuits and own models"]].map(([value, text]) => element("label", {},
    element("input", { type: "radio", name: "sort", value, checked: (state.sort ?? "chains") === value, onchange: () => { state.sort = value; sorted(); save(); } }), element("span", {}, text))));
  const sorted = () => {
    chains.hidden = state.sort === "models";
    own.hidden = !chains.hidden;
    onlyLeft.hidden = !state.left;
    every.hidden = left.checked = Boolean(state.left);
    leftText.textContent = `only the structures that fit ${state.left} left; places are masses of the one that it selected`;
  };
  // Fit only what an earlier fit left; undefined: all candidates.
  function only(fit) {
    state.left = fit;
    sorted();
    save();
  }
  const answer = element("div", { id: "answer" });
  const earlier = element("div", { id: "earlier" });
  const form = element("section", { id: "fit", "aria-labelledby": "fit-title", hidden: true }, element("h2", { id: "fit-title" }, "Fit"), sort, chains, own, element("p", {}, button), line.root);
  sorted();

  // Names with their values: {m1: 0.02}, {k12: [0, 500]}; undefined where there are none. Throws a sentence.
  const valuesOf = (name, label, parse) => {
    const parts = (state[name] ?? "").split(",").map((text) => text.trim()).filter(Boolean);
    const found = parts.map((text) => {
      const [, own, value] = /^([A-Za-z]\w*)\s*=\s*(.+)$/.exec(text) ?? [], numbers = own && parse(value);
      if (!numbers || ![numbers].flat().every((x) => Number.isFinite(x) && x >= 0)) throw new Error(`${label}: write them like ${EXAMPLES[name]}, not ${text}.`);
      return [own, numbers];
    });
    return found.length ? Object.fromEntries(found) : undefined;
  };
  const request = () => {
    const test = state.measurements.find(({ role }) => role === "test");
    const measurements = state.measurements.filter((one) => one !== test).map(({ role, ...one }) => one);
    const found = { measurements, masses: state.masses, ...(test ? { test: test.file } : {}) };
    if (state.sort === "models") found.models = models.value.split("\n").map((text) => text.trim()).filter(Boolean);
    else {
      Object.assign(found, {
        damped: damped.checked, base: base.checked, fix: valuesOf("fix", "Known values", (text) => Number(text || "x")),
        bound: valuesOf("bound", "Ranges", (text) => (text.split("..").length === 2 ? text.split("..").map((end) => Number(end || "x")) : null)),
      });
      if (state.left) Object.assign(found, { left: state.left, damped: undefined, base: undefined });
      if (state.controller) found.controller = state.controller.replace(/\s/g, "");
    }
    if (state.sort === "models" ? !found.models.length : !found.masses.length && !found.left) throw new Error(state.sort === "models" ? "Name at least one model." : "Choose at least one number of masses.");
    return found;
  };

  const begin = () => {
    let wanted;
    try { wanted = request(); } catch (error) { line.complain(error.message); return; }
    // the schema wants a number of masses even where models are named
    watch(call("fit", { ...wanted, masses: wanted.masses.length ? wanted.masses : [1] }, line.hear));
  };
  const watch = async (promise) => {
    button.disabled = true;
    const found = await line.run(promise);
    button.disabled = false;
    if (!found) return;
    present(found, true);
    await list();
  };

  // The answer: three lines, files, the page of the fit.
  const present = (found, isNew = false) => {
    shown = found.fit;
    onward = onwardPart({ call, follow, addNext }, found);
    const frame = element("iframe", { src: address(found.fit, "fit.html"), title: `Page of fit ${found.fit}`, class: "report" });
    frame.addEventListener("load", () => {
      const page = frame.contentDocument?.documentElement;
      if (!page) return;
      const fitTo = () => { frame.style.height = `${page.offsetHeight + 2}px`; };
      new ResizeObserver(fitTo).observe(page);
      fitTo();
    });
    const files = SHOWN.filter(([name]) => found.files.includes(name)).map(([name, text]) => element("a", { href: address(found.fit, name), target: name === "fit.html" ? "_blank" : null, rel: "noopener" }, text));
    const figures = element("div", { class: "figures" });
    const names = (found.request?.measurements ?? []).map(({ file }) => file).join(", ");
    answer.replaceChildren(element("section", { "aria-labelledby": "answer-title" },
      element("h2", { id: "answer-title", tabindex: -1 }, `Answer of fit ${found.fit}: ${names}`),
      element("ul", { class: found.explains ? "lead near" : "lead near warning" }, (found.answer ?? []).map(answerLine)),
      found.quantities?.length ? element("p", {}, "The sensor shows ", found.quantities.map((quantity) => [element("button", { type: "button", class: "plainbutton", onclick: () => setQuantity(quantity).then(begin) }, quantity), " "])) : null,
      figures, element("p", { class: "links" }, files.flatMap((link) => [link, " "])),
      onward.root, element("details", {}, element("summary", {}, "The same fit on the command line"),
        found.command ? command(found.command) : element("p", {}, "The command line reads all files of a fit alike; these are read differently, so no single command gives this fit."))), frame);
    showFigures(call, found.fit, figures);
    announce(`Fit ${found.fit} is finished.`);
    if (isNew) document.getElementById("answer-title").focus();
  };

  const list = async () => {
    const { fits } = await call("fits", {});
    both?.stop();
    both = fits.length > 1 ? twoFits(call, fits) : null;
    if (!fits.length) { earlier.replaceChildren(); return fits; }
    earlier.replaceChildren(element("section", { "aria-labelledby": "fits-title" }, element("h2", { id: "fits-title" }, "Fits of this project"),
      element("ul", { class: "near" }, fits.map((found) => element("li", {},
        element("button", { type: "button", class: "plainbutton", "aria-label": `Show fit ${found.fit}`, onclick: () => present(found, true) }, `Fit ${found.fit}`), ` ${(found.request?.measurements ?? []).map(({ file }) => file).join(", ")}: `,
        found.answer?.[1] ?? found.answer?.[0] ?? ""))), both?.root));
    return fits;
  };

  return {
    root: element("div", {}, form, answer, earlier),
    only,
    wait: () => { button.disabled = true; },
    // Nothing can be fitted before it was seen.
    show: (seen) => {
      form.hidden = !seen?.diagram;
      button.disabled = line.isRunning();
      if (seen?.look.impedance && state.sort === undefined) {
        state.sort = "models";
        form.querySelector('[value="models"]').checked = true;
        sorted();
      }
    },
    resume: async () => {
      const fits = await list();
      const { jobs } = await fetch("/api/jobs").then((response) => response.json());
      const job = jobs.find(({ name, state: now }) => ["fit", "next", "plan"].includes(name) && (now === "running" || now === "waiting"));
      const own = (job && fits.find(({ fit }) => fit === job.request.fit)) ?? fits[0];
      if (job?.name === "fit") watch(follow(job.job, line.hear));
      else if (own && shown === null) {
        present(own);
        if (job) onward.resume(job);
      }
    },
  };
};
