// What people type: "5:17", "A17", "17", and two of these for a pair; a pair may also be 17-23.
const parseModels = (text) => {
  const one = "(?:(\\d+)\\s*:\\s*)?[aA]?(\\d+)";
  const found = new RegExp(`^\\s*${one}(?:(?:\\s*[-–,;]\\s*|\\s+(?:and|vs\\.?|to)\\s+|\\s+)${one})?\\s*$`).exec(text);
  if (!found) return null;
  const models = [{ masses: +found[1] || null, number: +found[2] }];
  if (found[4]) models.push({ masses: +found[3] || null, number: +found[4] });
  return models;
};
const pairHash = (numbers) => `#${Math.min(...numbers)}-${Math.max(...numbers)}`;
