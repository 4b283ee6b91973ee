"use strict";
(() => {
  const sizes = JSON.parse(document.getElementById("sizes").textContent);
  const form = document.getElementById("search");
  const said = document.getElementById("said");
  const address = (text, kind) => {
    const models = parseModels(text);
    if (!models) return ["", "Type a model as masses:number, such as 5:17, or two of them."];
    const masses = models.map((m) => m.masses).filter(Boolean);
    if (!masses.length) return ["", "Say the number of masses too, such as 5:17."];
    const elsewhere = answeredBy(models, masses[0], kind);
    if (elsewhere) return ["", elsewhere];
    const dampers = models.flatMap((m) => m.dampers || []), name = `${models.some((m) => m.dampers) ? "dampers" : "chains"}-${masses[0]}-${kind}`;
    const family = sizes[name];
    if (!family) return ["", `There is no catalogue of ${masses[0]} masses, ${kind}${dampers.length ? ", with dampers to the ground" : ""}, here.`];
    const numbers = models.map((m) => m.number);
    const wrong = numbers.find((n) => n < 1 || n > family.models);
    if (wrong !== undefined) return ["", `That catalogue has the models 1 to ${family.models}.`];
    if (dampers.some((mass) => mass > masses[0])) return ["", `There are the masses 1 to ${masses[0]}.`];
    if (!family.folder) return [`${name}.html${damperHash(models)}`, ""];
    if (numbers.length === 1 || numbers[0] === numbers[1]) return [`${family.folder}/${numbers[0]}.html`, ""];
    return [`${name}.html${pairHash(numbers)}`, ""];
  };
  form.addEventListener("submit", (event) => {
    event.preventDefault();
    const [to, trouble] = address(form.elements.models.value, form.elements.kind.value);
    said.textContent = trouble;
    if (to) location.href = to;
  });
})();
