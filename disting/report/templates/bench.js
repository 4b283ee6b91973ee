// What stands around a matrix: the panel of what is selected, its address, the buttons of size, the fields of the panel.
const byId = (id) => document.getElementById(id);
// `seek` tells what a text names, `follow` what an address does (null: nothing here): how to { show } it, its { address } on another
// page, or the { trouble } in words.
const createBench = (matrix, { fill, seek, follow }) => {
  const section = byId("verdicts"), panel = byId("detail");
  let selected = null; // { models, address } and what fill needs
  // the field stays in sight: above the sheet on a phone, below the upper edge elsewhere
  const bring = () => {
    const field = matrix.cursor();
    const sheet = getComputedStyle(panel).position === "fixed";
    const [top, bottom] = [60, sheet ? innerHeight - panel.offsetHeight - 20 : innerHeight - 30];
    const by = field.bottom > bottom ? Math.min(field.bottom - bottom + (sheet ? 60 : 0), field.top - top) : field.top < top ? field.top - top : 0;
    scrollBy({ top: by, behavior: "instant" });
  };
  const say = (trouble) => (byId("trouble").textContent = trouble || "");
  const clear = () => {
    selected = null;
    matrix.pick(null);
    panel.hidden = true;
  };
  const select = (selection) => {
    say("");
    selected = selection;
    matrix.pick(selection.models);
    fill(selection);
    panel.hidden = false;
    if (location.hash !== selection.address) history.replaceState(null, "", selection.address);
    panel.scrollTop = panel.parentElement.scrollTop = 0;
    bring();
  };
  const close = () => {
    if (!selected) return;
    const { models } = selected;
    clear();
    history.replaceState(null, "", location.pathname + location.search);
    if (models.length) matrix.go(models[models.length - 1], models[0], { focus: true });
  };
  const arrive = () => {
    const found = follow(location.hash);
    say(found?.trouble);
    if (!found) return;
    if (found.address) return location.replace(found.address);
    if (found.trouble) clear();
    section.scrollIntoView({ behavior: "instant" });
    found.show?.();
  };
  const ZOOM = { out: () => matrix.zoom(1 / 1.5), in: () => matrix.zoom(1.5), fit: matrix.fit };
  section.querySelectorAll("[data-zoom]").forEach((b) => b.addEventListener("click", () => ZOOM[b.dataset.zoom]()));
  panel.querySelector(".close").addEventListener("click", close);
  byId("filter").addEventListener("submit", (event) => event.preventDefault());
  document.addEventListener("keydown", (event) => event.key === "Escape" && close());
  byId("search").addEventListener("submit", (event) => {
    event.preventDefault();
    const found = seek(byId("find").value);
    say(found.trouble);
    if (found.address) location.href = found.address;
    found.show?.();
  });
  return {
    select,
    follow: () => {
      addEventListener("hashchange", arrive);
      document.addEventListener("click", (event) => event.target.closest("a")?.hash === location.hash && location.hash && arrive()); // the same link again
      arrive();
    },
    again: (changes) => selected && fill(Object.assign(selected, changes)),
  };
};
// Groups first, the largest before the others, so that indistinguishable blocks stand on the diagonal: order and blocks.
const byGroup = (groups, models, name = () => "") => {
  const sorted = groups.map((members) => [members, name(members)]).sort(([a], [b]) => b.length - a.length || a[0] - b[0]);
  const inside = new Set(groups.flat());
  const blocks = [];
  sorted.reduce((from, [members, said]) => (blocks.push([from, members.length, said]), from + members.length), 0);
  return [[...sorted.flatMap(([members]) => members), ...models.filter((i) => !inside.has(i))], blocks];
};
// Numbers >= 0; a negative one repeats what is before it.
const unpacked = (runs, size) => {
  const found = new Uint32Array(size);
  let at = 0;
  for (const number of runs)
    if (number >= 0) found[at++] = number;
    else found.fill(found[at - 1], at, (at -= number));
  return found;
};
const slot = (name) => byId("detail").querySelector(`[data-slot="${name}"]`);
const put = (texts) => Object.entries(texts).forEach(([name, text]) => (slot(name).textContent = text));
