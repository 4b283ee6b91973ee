// Two finished fits side by side.
import { command, element } from "./dom.js";
import { waitFor } from "./answers.js";
import { jobLine } from "./job.js";

const table = (name, rows, heads) => element("div", { class: "scroll", tabindex: 0, role: "group", "aria-label": name }, element("table", { class: "plain" },
  element("thead", {}, element("tr", {}, ["", ...heads].map((head) => (head ? element("th", { scope: "col" }, head) : element("td", {}))))),
  element("tbody", {}, rows.map(([head, ...cells]) => element("tr", {}, element("th", { scope: "row" }, head), cells.map((cell) => element("td", {}, cell)))))));

// {root, stop}. The verdict may take minutes: it is a job, which ends when others are asked for.
export const twoFits = (call, fits) => {
  let turn = 0, job = null;
  const line = jobLine("verdict", { deciding: "Verdict on both structures" }), verdict = element("div", { "aria-live": "polite" });
  const choice = (id, label, chosen) => [element("label", { for: id }, label), " ", element("select", { id }, fits.map(({ fit }) => element("option", { value: fit, selected: fit === chosen }, `Fit ${fit}`))), " "];
  const place = element("div", { id: "two-fits", "aria-live": "polite" }), [last, before] = fits.map(({ fit }) => fit);
  const decide = async (pair, own) => {
    verdict.replaceChildren();
    job = call("fits_verdict", pair, line.hear);
    const found = await line.run(job);
    if (found && own === turn) verdict.replaceChildren(element("p", { class: "lead near" }, element("strong", {}, "Structures: "), found.verdict), ...(found.command ? [command(found.command)] : []));
  };
  const ask = async () => {
    const [left, right] = ["left-fit", "right-fit"].map((id) => Number(document.getElementById(id).value)), own = ++turn, heads = [`Fit ${left}`, `Fit ${right}`];
    job?.stop();
    if (left === right) { place.replaceChildren(element("p", { class: "trouble" }, "Choose two different fits.")); return; }
    const pair = { fits: [left, right] };
    const found = await waitFor(place, "Comparing", call("two_fits", pair), ({ rows, parameters }) => [
      line.root, verdict, table("Both fits", rows, heads), element("h3", {}, "Parameters, in SI units, with their intervals"), table("Parameters of both fits", parameters, heads)], () => own === turn);
    if (found && own === turn) await decide(pair, own);
  };
  return { stop: () => job?.stop(), root: element("div", {}, element("h3", {}, "Two fits side by side"), element("p", {}, choice("left-fit", "Left", before), choice("right-fit", "Right", last), element("button", { type: "button", class: "plainbutton", onclick: ask }, "Compare the fits")), place) };
};
