// Two finished fits side by side.
import { command, element } from "./dom.js";
import { waitFor } from "./answers.js";

const table = (name, rows, heads) => element("div", { class: "scroll", tabindex: 0, role: "group", "aria-label": name }, element("table", { class: "plain" },
  element("thead", {}, element("tr", {}, ["", ...heads].map((head) => (head ? element("th", { scope: "col" }, head) : element("td", {}))))),
  element("tbody", {}, rows.map(([head, ...cells]) => element("tr", {}, element("th", { scope: "row" }, head), cells.map((cell) => element("td", {}, cell)))))));

export const twoFits = (call, fits) => {
  let asked = 0;
  const choice = (id, label, chosen) => [element("label", { for: id }, label), " ", element("select", { id }, fits.map(({ fit }) => element("option", { value: fit, selected: fit === chosen }, `Fit ${fit}`))), " "];
  const place = element("div", { id: "two-fits", "aria-live": "polite" }), [last, before] = fits.map(({ fit }) => fit);
  const ask = () => {
    const [left, right] = ["left-fit", "right-fit"].map((id) => Number(document.getElementById(id).value)), own = ++asked;
    if (left === right) { place.replaceChildren(element("p", { class: "trouble" }, "Choose two different fits.")); return; }
    const heads = [`Fit ${left}`, `Fit ${right}`];
    waitFor(place, "Comparing", call("two_fits", { fits: [left, right] }), ({ rows, parameters, verdict, command: line }) => [
      element("p", { class: "lead near" }, element("strong", {}, "Structures: "), verdict), line ? command(line) : null, table("Both fits", rows, heads),
      element("h3", {}, "Parameters, in SI units, with their intervals"), table("Parameters of both fits", parameters, heads)], () => own === asked);
  };
  return element("div", {}, element("h3", {}, "Two fits side by side"), element("p", {}, choice("left-fit", "Left", before), choice("right-fit", "Right", last), element("button", { type: "button", class: "plainbutton", onclick: ask }, "Compare the fits")), place);
};
