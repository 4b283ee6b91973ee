// Shell of the page: a tab for each module that has something to show.
import { call } from "./call.js";

const PAGES = [
  ["data", "Data", "./data.js"],
  ["machine", "Machine", "./machine.js"],
  ["compare", "Two models", "./compare.js"],
];

const tabs = document.getElementById("tabs"), pages = document.getElementById("pages");
const started = new Map();

const show = async (name, focus = false) => {
  for (const tab of tabs.children) {
    const chosen = tab.id === `tab-${name}`;
    tab.setAttribute("aria-selected", chosen);
    tab.tabIndex = chosen ? 0 : -1;
    if (chosen && focus) tab.focus();
  }
  for (const panel of pages.children) panel.hidden = panel.id !== `page-${name}`;
  history.replaceState(null, "", `#${name}`);
  document.title = `${PAGES.find(([own]) => own === name)[1]} – disting`;
  if (started.has(name)) return;
  started.set(name, true);
  const [, , path] = PAGES.find(([own]) => own === name);
  const panel = document.getElementById(`page-${name}`);
  try {
    const { start } = await import(path);
    await start(panel, call);
  } catch (error) {
    const told = document.createElement("p");
    told.setAttribute("role", "alert");
    told.className = "warning";
    told.textContent = error.message;
    panel.prepend(told);
  }
};

for (const [name, title] of PAGES) {
  const tab = document.createElement("button");
  Object.assign(tab, { id: `tab-${name}`, type: "button", textContent: title });
  tab.setAttribute("role", "tab");
  tab.setAttribute("aria-controls", `page-${name}`);
  tab.addEventListener("click", () => show(name));
  tabs.append(tab);
  const panel = document.createElement("div");
  Object.assign(panel, { id: `page-${name}`, hidden: true, className: "page" });
  panel.setAttribute("role", "tabpanel");
  panel.setAttribute("aria-labelledby", tab.id);
  pages.append(panel);
}
tabs.addEventListener("keydown", (event) => {
  const names = PAGES.map(([name]) => name), step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
  if (!step) return;
  event.preventDefault();
  const now = names.findIndex((name) => `tab-${name}` === document.activeElement.id);
  show(names.at((now + step + names.length) % names.length), true);
});
const named = () => PAGES.find(([name]) => `#${name}` === location.hash)?.[0] ?? PAGES[0][0];
addEventListener("hashchange", () => show(named()));
show(named());
