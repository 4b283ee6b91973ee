(() => {
  const form = document.querySelector(".finder"), field = form.querySelector("input");
  form.hidden = false;
  field.addEventListener("focus", () => {
    const code = document.createElement("script");
    code.src = `${form.dataset.root}search.js`;
    code.onerror = () => { form.querySelector("[role=status]").className = "trouble"; form.querySelector("[role=status]").textContent = "The search belongs to the whole site, which disting report writes."; };
    document.head.append(code);
  }, { once: true });
  addEventListener("keydown", (event) => {
    if (event.key !== "/" || event.ctrlKey || event.metaKey || event.altKey || event.target.closest?.("input, select, textarea")) return;
    event.preventDefault();
    field.focus();
  });
})();
