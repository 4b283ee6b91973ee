// Answers as elements: what the engine says, how sure it is, and the command that says it too.
import { element, command } from "./dom.js";

// Drawings are made by the package; they hold no text of a user but what it has escaped.
export const picture = (text) => {
  const drawn = new DOMParser().parseFromString(text, "text/html").querySelector("svg");
  return element("div", { class: "picture" }, drawn);
};

export const facts = (rows) => element("dl", { class: "facts-of-answer" }, rows.filter(([, value]) => value).map(([name, value]) => element("div", {}, element("dt", {}, name), element("dd", {}, value))));

export const folded = (title, ...children) => element("details", { class: "fold" }, element("summary", {}, element("strong", {}, title)), children);

export const commandFold = (text) => folded("Command", command(text));

// While a promise is open its place says what is known already and how long it takes; then what it gives, or why not.
export const waitFor = async (place, what, promise, show, isCurrent = () => true, known = []) => {
  const begun = performance.now(), line = element("p", { class: "hint waiting" }, `${what} …`);
  place.replaceChildren(...known, line);
  place.setAttribute("aria-busy", "true");
  const clock = setInterval(() => { line.textContent = `${what} … ${Math.round((performance.now() - begun) / 1000)} s`; }, 1000);
  try {
    const answer = await promise;
    if (isCurrent()) place.replaceChildren(...[show(answer)].flat().filter(Boolean));
    return answer;
  } catch (trouble) {
    if (isCurrent()) place.replaceChildren(...known, element("p", { class: "trouble" }, trouble.message));
    return null;
  } finally {
    clearInterval(clock);
    if (isCurrent()) place.setAttribute("aria-busy", "false");
  }
};

// A button that fetches the evidence of a verdict and gives it to the reader as a file.
export const evidenceButton = (call, request) => {
  const button = element("button", { type: "button", class: "plainbutton" }, "Evidence (JSON)");
  button.addEventListener("click", async () => {
    button.disabled = true;
    try {
      const { file } = await call("evidence", request);
      const address = URL.createObjectURL(new Blob([`${JSON.stringify(file, null, 1)}\n`], { type: "application/json" }));
      element("a", { href: address, download: "verdict.json" }).click();
      setTimeout(() => URL.revokeObjectURL(address), 1000);
    } catch (trouble) {
      button.after(element("p", { class: "trouble" }, trouble.message));
    } finally {
      button.disabled = false;
    }
  });
  return button;
};

export const valuesTable = (given, sets, names = ["given", "set"]) => {
  const parameters = [...new Set([...Object.keys(given), ...sets.flatMap(Object.keys)])].sort(), columns = [[names[0], given], ...sets.map((one, i) => [sets.length > 1 ? `${names[1]} ${i + 1}` : names[1], one])];
  return element("div", { class: "wide", tabindex: 0, role: "group", "aria-label": "Values" }, element("table", { class: "plain" },
    element("thead", {}, element("tr", {}, element("th", { scope: "col" }, "parameter"), columns.map(([name]) => element("th", { scope: "col" }, name)))),
    element("tbody", {}, parameters.map((name) => element("tr", {}, element("th", { scope: "row" }, name), columns.map(([, values]) => element("td", {}, values[name] ?? "–")))))));
};
