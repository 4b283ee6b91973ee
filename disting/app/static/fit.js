// Fit of the Data page: candidates, progress, answer, earlier fits.
import { announce, element } from "./dom.js";

const WORDS = { fit: "Candidates fitted", "last digits": "Last digits of the parameters", equivalents: "Equivalent structures", networks: "Models fitted", intervals: "Intervals", proofs: "Proofs" };
const SHOWN = [["fit.html", "Open the page"], ["fit.json", "JSON"], ["model.mat", "MATLAB"], ["models.py", "Python"], ["candidates.csv", "Candidates (CSV)"], ["bode.pdf", "Bode (PDF)"]];
const address = (fit, name) => `/project/fits/${fit}/${name}`;
const sentence = (text) => text[0].toUpperCase() + text.slice(1);

const line = (text) => {
  const [label, ...rest] = text.split(": ");
  return rest.length ? element("li", {}, element("strong", {}, `${sentence(label)}: `), rest.join(": ")) : element("li", {}, text);
};

export const fitSection = ({ call, follow, state, save, trouble, addNext, setQuantity }) => {
  let running = null, shown = null;
  const button = element("button", { type: "button", class: "plainbutton main", onclick: () => begin() }, "Fit");
  const stop = element("button", { type: "button", class: "plainbutton", hidden: true, onclick: () => running?.stop() }, "Stop");
  const bar = element("progress", { "aria-label": "Progress of the fit", max: 1, value: 0 });
  const told = element("span", { role: "status" });
  const progress = element("p", { class: "progress", hidden: true }, bar, " ", told, " ", stop);
  const troubles = element("p", { class: "trouble", role: "alert" });
  const masses = element("fieldset", { class: "masses" }, element("legend", {}, "Masses"), [1, 2, 3, 4, 5].map((n) => element("label", {},
    element("input", { type: "checkbox", value: n, checked: state.masses.includes(n), onchange: () => {
      state.masses = [...masses.querySelectorAll("input:checked")].map((input) => Number(input.value));
      save();
    } }), ` ${n}`)));
  const damped = element("input", { type: "checkbox", id: "damped", checked: state.damped ?? true, onchange: () => { state.damped = damped.checked; save(); } });
  const base = element("input", { type: "checkbox", id: "base", checked: state.base ?? false, onchange: () => { state.base = base.checked; save(); } });
  const models = element("textarea", { id: "models", rows: 3, spellcheck: "false", placeholder: "R0-p(R1,C1)\nR0-p(R1,C1)-p(R2,C2)\ncells-4", onchange: () => { state.models = models.value; save(); } }, state.models ?? "");
  const chains = element("div", {}, masses, element("p", {}, damped, element("label", { for: "damped" }, " springs with dampers beside them ")), element("p", {}, base, element("label", { for: "base" }, " also on an elastic base")));
  const own = element("p", { class: "field wide" }, element("label", { for: "models" }, "Circuits or machines, one a line: by their text, or a family such as cells-4"), models);
  const sort = element("fieldset", { class: "segments" }, [["chains", "Chains of masses"], ["models", "Circuits and own models"]].map(([value, text]) => element("label", {},
    element("input", { type: "radio", name: "sort", value, checked: (state.sort ?? "chains") === value, onchange: () => { state.sort = value; sorted(); save(); } }), element("span", {}, text))));
  const sorted = () => { chains.hidden = state.sort === "models"; own.hidden = !chains.hidden; };
  const answer = element("div", { id: "answer" });
  const earlier = element("div", { id: "earlier" });
  const form = element("section", { id: "fit", "aria-labelledby": "fit-title", hidden: true }, element("h2", { id: "fit-title" }, "Fit"), sort, chains, own, element("p", {}, button), progress, troubles);
  sorted();

  const request = () => {
    const found = { measurements: state.measurements, masses: state.masses };
    if (state.sort === "models") found.models = models.value.split("\n").map((text) => text.trim()).filter(Boolean);
    else Object.assign(found, { damped: damped.checked, base: base.checked });
    return found;
  };
  const complaint = (found) => {
    if (state.sort === "models" ? !found.models.length : !found.masses.length) return state.sort === "models" ? "Name at least one model." : "Choose at least one number of masses.";
    return "";
  };

  const begin = () => {
    const wanted = request(), wrong = complaint(wanted);
    troubles.textContent = wrong;
    if (wrong) return;
    // the schema wants a number of masses even where models are named
    watch(call("fit", { ...wanted, masses: wanted.masses.length ? wanted.masses : [1] }, hear));
  };
  const hear = ({ state: now, what, done, total }) => {
    told.textContent = now === "waiting" ? "Waits for another fit." : what ? `${WORDS[what] ?? sentence(what)}: ${done} of ${total}` : "Begins.";
    if (total) { bar.max = total; bar.value = done; } else bar.removeAttribute("value");
  };
  const watch = async (promise) => {
    running = promise;
    button.disabled = true;
    progress.hidden = stop.hidden = false;
    told.textContent = "Begins.";
    bar.removeAttribute("value");
    try {
      present(await promise, true);
      await list();
    } catch (error) {
      troubles.textContent = error.message;
    } finally {
      running = null;
      button.disabled = false;
      progress.hidden = stop.hidden = true;
    }
  };

  // The answer: three lines, files, the page of the fit.
  const present = (found, isNew = false) => {
    shown = found.fit;
    const frame = element("iframe", { src: address(found.fit, "fit.html"), title: `Page of fit ${found.fit}`, class: "report" });
    frame.addEventListener("load", () => {
      const page = frame.contentDocument?.documentElement;
      if (!page) return;
      const fitTo = () => { frame.style.height = `${page.scrollHeight + 2}px`; };
      new ResizeObserver(fitTo).observe(page);
      fitTo();
    });
    const files = SHOWN.filter(([name]) => found.files.includes(name)).map(([name, text]) => element("a", { href: address(found.fit, name), target: name === "fit.html" ? "_blank" : null, rel: "noopener" }, text));
    const names = (found.request?.measurements ?? []).map(({ file }) => file).join(", ");
    answer.replaceChildren(element("section", { "aria-labelledby": "answer-title" },
      element("h2", { id: "answer-title", tabindex: -1 }, `Answer of fit ${found.fit}: ${names}`),
      element("ul", { class: found.explains ? "lead near" : "lead near warning" }, (found.answer ?? []).map(line)),
      found.quantities?.length ? element("p", {}, "The sensor shows ", found.quantities.map((quantity) => [element("button", { type: "button", class: "plainbutton", onclick: () => setQuantity(quantity).then(begin) }, quantity), " "])) : null,
      element("p", { class: "links" }, files.flatMap((link) => [link, " "])),
      element("p", {}, element("button", { type: "button", class: "plainbutton", onclick: addNext }, "Add another measurement of this machine"))), frame);
    announce(`Fit ${found.fit} is finished.`);
    if (isNew) document.getElementById("answer-title").focus();
  };

  const list = async () => {
    const { fits } = await call("fits", {});
    if (!fits.length) { earlier.replaceChildren(); return fits; }
    earlier.replaceChildren(element("section", { "aria-labelledby": "fits-title" }, element("h2", { id: "fits-title" }, "Fits of this project"),
      element("ul", { class: "near" }, fits.map((found) => element("li", {},
        element("button", { type: "button", class: "plainbutton", "aria-label": `Show fit ${found.fit}`, onclick: () => present(found, true) }, `Fit ${found.fit}`), ` ${(found.request?.measurements ?? []).map(({ file }) => file).join(", ")}: `,
        found.answer?.[1] ?? found.answer?.[0] ?? "")))));
    return fits;
  };

  return {
    root: element("div", {}, form, answer, earlier),
    wait: () => { button.disabled = true; },
    // Nothing can be fitted before it was seen.
    show: (seen) => {
      form.hidden = !seen?.diagram;
      button.disabled = running !== null;
      if (seen?.look.impedance && state.sort === undefined) {
        state.sort = "models";
        form.querySelector('[value="models"]').checked = true;
        sorted();
      }
    },
    resume: async () => {
      const fits = await list();
      const { jobs } = await fetch("/api/jobs").then((response) => response.json());
      const job = jobs.find(({ name, state: now }) => name === "fit" && (now === "running" || now === "waiting"));
      if (job) watch(follow(job.job, hear));
      else if (fits.length && shown === null) present(fits[0]);
    },
  };
};
