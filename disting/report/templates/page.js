"use strict";
(() => {
  const data = JSON.parse(document.getElementById("data").textContent);
  const section = document.getElementById("verdicts");
  const panel = document.getElementById("detail");
  const grids = [...section.querySelectorAll(".matrix")];
  const NAMES = ["relation", "by", "representation", "certainty", "domain", "why", "formula"];
  const WHERE = { tf: "transfer function", markov: "Markov parameters", structure: "structure", fibre: "one fibre", parameters: "equivalents" };
  const RULES = { exact: "the exact decision", admissible: "positive equivalents" };
  const rule = (by) => RULES[by] || `condition ${by}`;
  const PANELS = { domains: ["exact", "positive"], all: Object.keys(data.views) };
  const first = (show) => (PANELS[show] || [show])[0];
  const slot = (name) => panel.querySelector(`[data-slot="${name}"]`);
  const viewOf = (grid) => grid.closest(".view").dataset.view;
  let selected = null; // [low, high, view]

  // ---- data: entry (high-1)(high-2)/2 + low-1 of a view
  const verdict = (low, high, view) => {
    const entry = data.entries[data.views[view][((high - 1) * (high - 2)) / 2 + low - 1]];
    const found = Object.fromEntries(NAMES.map((name, i) => [name, data.texts[entry[i]]]));
    found.why = found.why.replaceAll("{L}", `A${low}`).replaceAll("{R}", `A${high}`);
    return found;
  };
  const short = (v) => (v.by ? `${v.relation}, ${rule(v.by)}` : v.relation);

  // ---- fields: row and column give the pair
  const pairOf = (td) => [td.cellIndex, td.parentElement.rowIndex + 1];
  const fieldOf = (grid, low, high) => grid.tBodies[0].rows[high - 2]?.cells[low];
  const name = (td) => {
    const [low, high] = pairOf(td);
    td.setAttribute("aria-label", `A${low} and A${high}: ${short(verdict(low, high, viewOf(td.closest("table"))))}`);
    td.title = td.getAttribute("aria-label");
  };
  const rove = (grid, td) => {
    grid.querySelector('td[tabindex="0"]')?.setAttribute("tabindex", "-1");
    td.setAttribute("tabindex", "0");
    name(td);
  };
  const light = (grid, low, high) => {
    grid.querySelectorAll("th.lit").forEach((th) => th.classList.remove("lit"));
    if (low) [grid.tHead.rows[0].cells[low], grid.tBodies[0].rows[high - 2].cells[0]].forEach((th) => th.classList.add("lit"));
  };
  const relight = (grid) => light(grid, ...(selected || []));

  // ---- the panel
  const draw = (side, number) => {
    const source = document.querySelector(`#A${number} .chain`);
    const svg = slot(side);
    svg.setAttribute("viewBox", source.getAttribute("viewBox"));
    svg.setAttribute("aria-label", source.getAttribute("aria-label"));
    svg.firstElementChild.setAttribute("href", `#chain-${number}`);
    svg.setAttribute("width", source.getAttribute("width"));
    slot(`${side}-name`).textContent = `A${number}`;
  };
  const fill = (low, high, view) => {
    const v = verdict(low, high, view);
    slot("title").textContent = `A${low} and A${high}`;
    slot("badge").textContent = v.relation;
    slot("badge").className = `badge ${v.relation}`;
    slot("where").textContent = v.by ? `by ${rule(v.by)}, ${WHERE[v.representation] || v.representation}` : "";
    slot("why").textContent = v.why;
    slot("formula").textContent = v.formula;
    slot("certainty").textContent = v.by ? `${v.certainty} Over ${v.domain} parameter values.` : "";
    draw("left", low);
    draw("right", high);
    for (const other of Object.keys(data.views)) slot(`in-${other}`).textContent = short(verdict(low, high, other));
    document.getElementById("status").textContent = `A${low} and A${high}: ${short(v)}. ${v.why}`;
  };
  const clear = () => {
    section.querySelectorAll('[aria-selected="true"]').forEach((td) => td.removeAttribute("aria-selected"));
  };
  const select = (low, high, view) => {
    clear();
    selected = [low, high, view];
    for (const grid of grids) {
      const td = fieldOf(grid, low, high);
      td.setAttribute("aria-selected", "true");
      rove(grid, td);
      relight(grid);
    }
    fill(low, high, view);
    panel.hidden = false;
    if (location.hash !== `#${low}:${high}`) history.replaceState(null, "", `#${low}:${high}`);
    panel.scrollIntoView({ block: "nearest" });
  };
  const close = () => {
    if (!selected) return;
    const [low, high, view] = selected;
    const grid = grids.find((g) => viewOf(g) === view && g.offsetParent) || grids.find((g) => g.offsetParent);
    selected = null;
    clear();
    grids.forEach(relight);
    panel.hidden = true;
    history.replaceState(null, "", location.pathname + location.search);
    fieldOf(grid, low, high).focus({ preventScroll: true });
  };

  // ---- keyboard: arrows move in the triangle, Enter or space opens
  const target = (grid, low, high, event) => {
    const last = data.models;
    const far = event.ctrlKey || event.metaKey;
    switch (event.key) {
      case "ArrowLeft": return [Math.max(1, low - 1), high];
      case "ArrowRight": return [Math.min(high - 1, low + 1), high];
      case "ArrowUp": return [low, Math.max(low + 1, high - 1)];
      case "ArrowDown": return [low, Math.min(last, high + 1)];
      case "PageUp": return [low, Math.max(low + 1, high - 10)];
      case "PageDown": return [low, Math.min(last, high + 10)];
      case "Home": return far ? [1, 2] : [1, high];
      case "End": return far ? [last - 1, last] : [high - 1, high];
      default: return null;
    }
  };
  const onKey = (grid, event) => {
    const td = event.target.closest("tbody td");
    if (!td) return;
    const [low, high] = pairOf(td);
    const next = target(grid, low, high, event);
    if (event.key === "Enter" || event.key === " ") select(low, high, viewOf(grid));
    else if (next) {
      const to = fieldOf(grid, ...next);
      rove(grid, to);
      to.focus();
    } else return;
    event.preventDefault();
  };
  for (const grid of grids) {
    const first = fieldOf(grid, 1, 2);
    rove(grid, first);
    grid.addEventListener("keydown", (event) => onKey(grid, event));
    grid.addEventListener("click", (event) => {
      const td = event.target.closest("tbody td");
      if (!td) return;
      select(...pairOf(td), viewOf(grid));
      td.focus({ preventScroll: true });
    });
    for (const kind of ["pointerover", "focusin"])
      grid.addEventListener(kind, (event) => {
        const td = event.target.closest("tbody td");
        if (!td) return;
        name(td);
        light(grid, ...pairOf(td));
      });
    for (const kind of ["pointerleave", "focusout"]) grid.addEventListener(kind, () => relight(grid));
  }
  panel.querySelector(".close").addEventListener("click", close);
  document.addEventListener("keydown", (event) => {
    if (event.key === "Escape") close();
  });

  // ---- views and size of the fields
  const SIZES = [8, 10, 12, 14, 16, 18, 20, 23, 26, 30, 36, 44];
  let cell = data.models <= 12 ? 26 : 20;
  const resize = (size) => {
    cell = size;
    section.style.setProperty("--cell", `${size}px`);
    section.classList.toggle("tiny", size < 14);
    section.classList.toggle("micro", size < 10);
  };
  const fit = () => {
    const shown = grids.find((grid) => grid.offsetParent);
    if (!shown) return;
    const beside = section.dataset.show === "domains" && innerWidth > 700 ? 2 : 1;
    const room = (shown.closest(".scroll").parentElement.parentElement.clientWidth - 26) / beside - Math.max(3.2 * cell, 46);
    const size = Math.floor(room / (data.models - 1));
    resize(Math.max(5, Math.min(30, size < 14 ? size : size - 1))); // small fields have no space between them
  };
  const ZOOM = {
    out: () => resize(SIZES.filter((s) => s < cell).pop() || cell),
    in: () => resize(SIZES.find((s) => s > cell) || cell),
    fit,
  };
  section.querySelectorAll("[data-zoom]").forEach((b) => b.addEventListener("click", () => ZOOM[b.dataset.zoom]()));
  const show = (view) => {
    section.dataset.show = view;
    if (!selected) return;
    if (!(PANELS[view] || [view]).includes(selected[2])) selected[2] = first(view);
    fill(...selected);
  };
  const radios = [...section.querySelectorAll('input[name="show"]')];
  radios.forEach((radio) => radio.addEventListener("change", () => show(radio.value)));
  const choose = (view) => {
    radios.forEach((radio) => (radio.checked = radio.value === view));
    show(view);
  };

  // ---- deep link #low:high
  const follow = () => {
    const found = /^#(\d+)(?::|%3A)(\d+)$/i.exec(location.hash);
    if (!found) return;
    const [low, high] = [+found[1], +found[2]].sort((a, b) => a - b);
    if (low < 1 || low === high || high > data.models) return;
    select(low, high, first(section.dataset.show));
    section.scrollIntoView({ behavior: "instant" });
    const grid = grids.find((g) => g.offsetParent);
    fieldOf(grid, low, high).scrollIntoView({ block: "center", inline: "center", behavior: "instant" });
    panel.scrollIntoView({ block: "nearest", behavior: "instant" });
  };
  resize(cell);
  choose(innerWidth > 700 ? section.dataset.show : "exact");
  if (data.models > 12) fit();
  addEventListener("hashchange", follow);
  follow();
})();
