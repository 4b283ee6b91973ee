// A job on the page: its progress, a button that stops it, and what went wrong.
import { element } from "./dom.js";

const sentence = (text) => text[0].toUpperCase() + text.slice(1);

// `run(promise, hear)`: its answer, null where there is none. `words`: names of the steps.
export const jobLine = (name, words = {}) => {
  let running = null;
  const bar = element("progress", { "aria-label": `Progress of the ${name}`, max: 1, value: 0 });
  const told = element("span", { role: "status" });
  const stop = element("button", { type: "button", class: "plainbutton", onclick: () => running?.stop() }, "Stop");
  const line = element("p", { class: "progress", hidden: true }, bar, " ", told, " ", stop);
  const troubles = element("p", { class: "trouble", role: "alert" });
  const hear = ({ state, what, done, total }) => {
    told.textContent = state === "waiting" ? "Waits for another job." : what ? `${words[what] ?? sentence(what)}${total > 1 ? `: ${done} of ${total}` : " …"}` : "Begins.";
    if (total > 1) { bar.max = total; bar.value = done; } else bar.removeAttribute("value");
  };
  const run = async (promise) => {
    running = promise;
    line.hidden = false;
    troubles.textContent = "";
    hear({});
    const isLast = () => running === promise; // a later one has the line
    try {
      return await promise;
    } catch (error) {
      if (isLast()) troubles.textContent = error.message;
      return null;
    } finally {
      if (isLast()) { running = null; line.hidden = true; }
    }
  };
  return { root: element("div", {}, line, troubles), hear, run, complain: (text) => { troubles.textContent = text; }, isRunning: () => running !== null };
};
