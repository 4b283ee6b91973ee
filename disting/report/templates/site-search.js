  const form = document.querySelector(".finder"), field = form.querySelector("input"), list = form.querySelector("ul"), said = form.querySelector("[role=status]");
  const MOST = 12, AROUND = 70;
  const entries = DATA.sections.map(([page, anchor, title, words]) => ({
    title, words, where: DATA.pages[page][1], address: DATA.pages[page][0] + (anchor && `#${anchor}`), low: title.toLowerCase(), text: `${title} ${DATA.pages[page][1]} ${words}`.toLowerCase(),
  }));
  let chosen = -1, shown = [];

  // of each family that may be meant: a model without masses is one of every size
  const models = (query) => {
    const asked = parseModels(query);
    if (!asked) return [];
    const masses = asked.map((m) => m.masses).filter(Boolean), two = masses.some((m) => m !== masses[0]);
    const undamped = (family) => +family.endsWith("-undamped"); // a name means a damped chain where nothing else is said
    return Object.keys(DATA.families).sort((a, b) => undamped(a) - undamped(b)).flatMap((family) => {
      const [, what, size, kind] = /^(\w+?)-(?:(\d+)-)?(\w+)$/.exec(family);
      if (what !== (two ? "sizes" : asked.some((m) => m.dampers) ? "dampers" : "chains") || (!two && masses.length && +size !== masses[0])) return [];
      const { page, address, trouble } = addressOf(asked, masses[0] || +size, kind, DATA.families);
      if (trouble) return [];
      const name = asked.map((m) => `${two ? `${m.masses || masses[0]}:` : "A"}${m.number}${damperSet(m.dampers)}`).join(" and ");
      return [{ title: `${name}${two ? "" : ` of ${size} mass${size === "1" ? "" : "es"}`}, ${kind}`, where: asked.length > 1 && !page ? "Verdict" : "Model", words: "", address: page || address }];
    });
  };
  // how well an entry answers: its title before its words, a beginning before a middle, a short title before a long one, the guide before the reference
  const REFERENCE = /^guide\/(?:python-|commands|command-summary|deciders|development)/, BEHIND = 95;
  const NAME = /[A-Z_.]|--|disting/, FIRST = 5; // friction is a word, of which the guide tells first; Friction is a name
  const weight = (entry, query, words) => {
    if (!words.every((word) => entry.text.includes(word))) return 0;
    const title = entry.low;
    const start = title === query ? 400 : title.split(/[^\w]+/).includes(query) ? 200 : title.startsWith(query) ? 150 : title.includes(query) ? 100 : words.every((word) => title.includes(word)) ? 60 : entry.text.includes(query) ? 30 : 10;
    const behind = start < 400 && REFERENCE.test(entry.address) ? BEHIND : 0;
    return Math.max(start - behind - Math.min(title.length, 80) / 10, 0.1);
  };
  const find = (text) => {
    const query = text.trim().toLowerCase(), words = query.split(/\s+/).filter(Boolean);
    if (!words.length) return [];
    const ranked = entries.map((entry) => [weight(entry, query, words), entry]).filter(([w]) => w).sort((a, b) => b[0] - a[0]);
    const every = ranked.map(([, entry]) => entry), first = NAME.test(text) ? [] : every.filter((entry) => entry.low === `disting ${query}` || !REFERENCE.test(entry.address)).slice(0, FIRST);
    return [...new Set([...models(query), ...first, ...every])].slice(0, MOST);
  };
  const excerpt = (entry, query) => {
    const at = Math.max(0, entry.words.toLowerCase().indexOf(query.trim().toLowerCase().split(/\s+/)[0]) - AROUND / 2);
    return `${at ? "…" : ""}${entry.words.slice(at, at + 2 * AROUND)}${entry.words.length > at + 2 * AROUND ? "…" : ""}`;
  };
  const part = (kind, text) => Object.assign(document.createElement("span"), { className: kind, textContent: text });
  const choose = (index) => {
    chosen = index;
    [...list.children].forEach((item, i) => item.setAttribute("aria-selected", i === chosen));
    if (chosen < 0) return field.removeAttribute("aria-activedescendant");
    field.setAttribute("aria-activedescendant", list.children[chosen].id);
    list.children[chosen].scrollIntoView({ block: "nearest" });
  };
  const close = () => { list.hidden = true; field.setAttribute("aria-expanded", "false"); choose(-1); };
  const go = (entry) => { location.href = form.dataset.root + entry.address; close(); };
  const show = () => {
    shown = find(field.value);
    list.replaceChildren(...shown.map((entry, i) => {
      const item = Object.assign(document.createElement("li"), { id: `find-${i}` });
      item.setAttribute("role", "option");
      item.append(part("what", entry.title), part("where", entry.where));
      if (entry.words) item.append(part("words", excerpt(entry, field.value)));
      item.addEventListener("mousedown", (event) => { event.preventDefault(); go(entry); });
      return item;
    }));
    list.hidden = !shown.length;
    field.setAttribute("aria-expanded", !list.hidden);
    said.textContent = field.value.trim() ? (shown.length ? `${shown.length} found` : "Nothing found") : "";
    said.className = shown.length || !field.value.trim() ? "unseen" : "nothing";
    choose(-1);
  };
  field.addEventListener("input", show);
  field.addEventListener("keydown", (event) => {
    if (event.key === "Escape") { if (list.hidden) field.value = ""; said.textContent = ""; close(); }
    else if ((event.key === "ArrowDown" || event.key === "ArrowUp") && shown.length) {
      event.preventDefault();
      if (list.hidden) show();
      const step = event.key === "ArrowDown" ? 1 : -1;
      choose(chosen < 0 && step < 0 ? shown.length - 1 : (chosen + step + shown.length) % shown.length);
    }
  });
  field.addEventListener("blur", close);
  form.addEventListener("submit", (event) => { event.preventDefault(); if (shown.length) go(shown[Math.max(chosen, 0)]); });
  if (field.value) show();
