// Diagrams of a fit's answer, to be zoomed: measured lines, and the curves of the structures with a box that hides each.
import { element, svg } from "./dom.js";
import { draw } from "./plot.js";
import { zoomable } from "./zoom.js";

const KINDS = { bode: "Bode diagram", nyquist: "Nyquist diagram" };

const figureOf = (figure, number) => {
  const diagram = { ...figure, hidden: new Set() }, picture = svg("svg", { id: `answer-diagram-${number}`, class: `plot diagram ${figure.kind}`, role: "img" });
  const plot = zoomable(picture, diagram, draw), title = `${KINDS[figure.kind]}${figure.title ? `: ${figure.title}` : ""}`;
  const key = (style) => svg("svg", { class: "key-line", viewBox: "0 0 30 10", "aria-hidden": "true" }, svg("path", { d: "M0 5H30", class: style }));
  const boxes = figure.curves.map(({ name }, i) => element("label", {}, element("input", { type: "checkbox", checked: true, onchange: (event) => {
    if (event.target.checked) diagram.hidden.delete(name); else diagram.hidden.add(name);
    plot.redraw();
  } }), " ", key(`curve ${["first", "second", "third", "fourth"][i]}`), ` ${name}`));
  const marks = figure.measured.map(({ name }, i) => `${["○", "×"][i]} ${name}`).join(", "), bars = figure.measured.some(({ wide }) => wide) ? "Bars: 95 % of the scatter of a line. " : "";
  return { redraw: plot.redraw, root: element("figure", { class: "panel", "aria-label": title }, element("h3", {}, title), plot.root,
    element("figcaption", {}, element("fieldset", { class: "curves" }, element("legend", { class: "unseen" }, "Curves"), boxes),
      element("span", { class: "hint" }, `${marks}. ${bars}Shaded: 95 % band of ${figure.curves[0].name}, if it is the true structure.`))) };
};

// The diagrams of a fit in a place of the page, which stays empty where the fit has none.
export const showFigures = async (call, fit, place) => {
  try {
    const { figures } = await call("figures", { fit });
    const shown = figures.flatMap((figure) => (figure.kind === "nyquist" ? [figure, { ...figure, kind: "bode" }] : [figure])).map(figureOf);
    place.replaceChildren(...shown.map(({ root }) => root));
    const redraw = () => shown.forEach((one) => one.redraw());
    redraw();
    new ResizeObserver(redraw).observe(place);
  } catch {
    place.replaceChildren(element("p", { class: "hint" }, "The diagrams of this fit cannot be shown; its page below has them too."));
  }
};
