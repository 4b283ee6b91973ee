// Elements: element("p", { class: "hint", onclick: go, hidden: true }, "text", child, null)
const SVG = "http://www.w3.org/2000/svg";
const made = (node, attributes, children) => {
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) node.addEventListener(name.slice(2), value);
    else if (value === true) node.setAttribute(name, "");
    else if (value !== false && value !== null && value !== undefined) node.setAttribute(name, value);
  }
  node.append(...children.flat().filter((child) => child !== null && child !== undefined && child !== ""));
  return node;
};
export const element = (name, attributes = {}, ...children) => made(document.createElement(name), attributes, children);
export const svg = (name, attributes = {}, ...children) => made(document.createElementNS(SVG, name), attributes, children);

// One sentence for those who hear the page.
export const announce = (sentence) => { document.getElementById("status").textContent = sentence; };

// A command with a button that copies it.
export const command = (text) => {
  const button = element("button", { type: "button", class: "plainbutton" }, "Copy");
  button.addEventListener("click", async () => {
    await navigator.clipboard.writeText(text);
    announce("Copied.");
  });
  return element("div", { class: "command" }, element("code", { tabindex: 0, role: "group", "aria-label": "Command" }, text), button);
};
