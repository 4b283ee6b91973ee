// What people type: "5:17", "A17", "17", with dampers to the ground "5:17+b1+b3" (+0: with none), and two of these for a pair; a
// pair may also be 17-23 or 17+b1/23.
const parseModels = (text) => {
  const one = "(?:(\\d+)\\s*:\\s*)?[aA]?(\\d+)((?:\\s*\\+\\s*[bB]?\\d+)*)";
  const found = new RegExp(`^\\s*${one}(?:(?:\\s*[-–,;/]\\s*|\\s+(?:and|vs\\.?|to)\\s+|\\s+)${one})?\\s*$`).exec(text);
  if (!found) return null;
  const model = (masses, number, dampers) => ({
    masses: +masses || null,
    number: +number,
    dampers: dampers && [...new Set(dampers.match(/\d+/g).map(Number))].filter(Boolean).sort((a, b) => a - b),
  });
  const models = [model(...found.slice(1, 4))];
  if (found[5]) models.push(model(...found.slice(4, 7)));
  return models;
};
const pairHash = (numbers) => `#${Math.min(...numbers)}-${Math.max(...numbers)}`;
const damperSet = (dampers) => (dampers?.length ? dampers.map((mass) => `+b${mass}`).join("") : "");
// A page of sets of ground dampers: one model without a set is a structure with all its sets, in a pair it has none.
const damperHash = (models) => (models.length === 1 && !models[0].dampers ? `#A${models[0].number}` : `#${models.map((m) => m.number + (damperSet(m.dampers) || (models.length === 1 ? "+0" : ""))).join("/")}`);
