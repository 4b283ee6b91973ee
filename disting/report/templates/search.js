// What people type: the names that all commands read, "5:17", "5:17+b1+b3+lag+delay", "A17" where the size is known, here "17" too
// (+0: with no dampers to the ground), and two of these for a pair; a pair may also be 17-23 or 17+b1/23.
const parseModels = (text) => {
  const one = "(?:(\\d+)\\s*:\\s*)?a?(\\d+)((?:\\s*\\+\\s*(?:b?\\d+|lag|delay))*)";
  const found = new RegExp(`^\\s*${one}(?:(?:\\s*[-–,;/]\\s*|\\s+(?:and|vs\\.?|to)\\s+|\\s+)${one})?\\s*$`, "i").exec(text);
  if (!found) return null;
  const model = (masses, number, extras) => {
    const words = extras.toLowerCase().split("+").slice(1).map((word) => word.trim()), at = words.filter((word) => /\d/.test(word));
    const dampers = at.length ? [...new Set(at.map((word) => +word.replace("b", "")))].filter(Boolean).sort((a, b) => a - b) : null;
    return { masses: +masses || null, number: +number, dampers, late: ["lag", "delay"].filter((word) => words.includes(word)) };
  };
  const models = [model(...found.slice(1, 4))];
  if (found[5]) models.push(model(...found.slice(4, 7)));
  return models;
};
const pairHash = (numbers) => `#${Math.min(...numbers)}-${Math.max(...numbers)}`;
const damperSet = (dampers) => (dampers?.length ? dampers.map((mass) => `+b${mass}`).join("") : "");
// A page of sets of ground dampers: one model without a set is a structure with all its sets, in a pair it has none.
const damperHash = (models) => (models.length === 1 && !models[0].dampers ? `#A${models[0].number}` : `#${models.map((m) => m.number + (damperSet(m.dampers) || (models.length === 1 ? "+0" : ""))).join("/")}`);
// The text of an address that names models, such as 3:1-4:5; "" where it leads to a part of the page, or nowhere.
const namedBy = (hash) => {
  const text = /%(?![0-9a-f]{2})/i.test(hash) ? hash.slice(1) : decodeURIComponent(hash.slice(1));
  return /^a?\d/i.test(text) && !document.getElementById(text) ? text : "";
};
// Where the site shows chains: { address } of their field or column, and the { page } of a single one; else the { trouble } in words.
// `families`: the pages of pairs by their names; `masses`: of models that do not say it; `dampers`: on a page of sets of ground dampers.
const addressOf = (models, masses, kind, families, dampers = models.some((m) => m.dampers)) => {
  const sizes = models.map((m) => m.masses || masses), [size] = sizes, two = sizes.some((n) => n !== size), across = families[`sizes-${kind}`];
  const names = models.map((m, k) => `${sizes[k]}:${m.number}${damperSet(m.dampers)}${m.late.map((word) => `+${word}`).join("")}`);
  const answered = (why) => ({ trouble: `${why}; a command answers: disting compare ${names[0]} ${names[1] || `${size}:..`} --${kind}` });
  if (models.some((m) => m.late.length)) return answered("Pages have no lag and no dead time");
  if (two && !across) return answered("A page compares models of one size");
  if (two && dampers) return answered("With dampers to the ground a page compares models of one size");
  const counts = new Map(two ? across.sizes : []), name = `${dampers ? "dampers" : "chains"}-${size}-${kind}`, family = families[name];
  const lacking = sizes.find((n) => two && !counts.has(n));
  if (lacking !== undefined) return answered(`Chains of ${across.sizes[0][0]} to ${across.sizes.at(-1)[0]} masses are compared here, not of ${lacking}`);
  if (!two && !family) return { trouble: `There is no catalogue of ${size} masses, ${kind}${dampers ? ", with dampers to the ground" : ""}, here.` };
  const most = (k) => (two ? counts.get(sizes[k]) : family.models);
  const wrong = models.findIndex((m, k) => m.number < 1 || m.number > most(k));
  if (wrong >= 0) return { trouble: `There is no model ${sizes[wrong]}:${models[wrong].number}: the models of ${sizes[wrong]} masses are ${sizes[wrong]}:1 to ${sizes[wrong]}:${most(wrong)}.` };
  if (models.some((m) => (m.dampers || []).some((mass) => mass > size))) return { trouble: `There are the masses 1 to ${size}.` };
  if (two) return { address: `sizes-${kind}.html#${names.join("-")}` };
  if (dampers) return { address: `${name}.html${damperHash(models)}` };
  const numbers = models.map((m) => m.number), single = numbers.every((n) => n === numbers[0]);
  return { address: `${name}.html${single ? `#A${numbers[0]}` : pairHash(numbers)}`, page: single ? `${family.folder}/${numbers[0]}.html` : "" };
};
