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
// Where what no page shows is answered: pairs of two sizes, lags and dead times; "" for what pages show. `masses`: of models that do not say it.
const answeredBy = (models, masses, kind) => {
  const sizes = models.map((m) => m.masses || masses);
  const names = models.map((m, k) => `${sizes[k]}:${m.number}${damperSet(m.dampers)}${m.late.map((word) => `+${word}`).join("")}`);
  const late = models.some((m) => m.late.length);
  if (sizes[0] === sizes[sizes.length - 1] && !late) return "";
  const why = late ? "Pages have no lag and no dead time" : "A page compares models of one size";
  return `${why}; a command answers: disting compare ${names[0]} ${names[1] || `${sizes[0]}:..`} --${kind}`;
};
