"use strict";
(() => {
  const families = JSON.parse(document.getElementById("families").textContent);
  const form = document.getElementById("search");
  const said = document.getElementById("said");
  const found = (text, kind) => {
    const models = parseModels(text);
    if (!models) return { trouble: "Type a model as masses:number, such as 5:17, or two of them." };
    const { masses } = models.find((m) => m.masses) || {};
    if (!masses) return { trouble: "Say the number of masses too, such as 5:17." };
    return addressOf(models, masses, kind, families);
  };
  form.addEventListener("submit", (event) => {
    event.preventDefault();
    const { page, address, trouble } = found(form.elements.models.value, form.elements.kind.value);
    said.textContent = trouble || "";
    if (!trouble) location.href = page || address;
  });
})();
