// How the models of a page are called: in fields, in its address, in what is typed, on a command line. They are counted from 1.
// `seek` and `follow` tell what a text and an address name: the { models }, their { address } on another page, or the { trouble } in words.
const createNames = (data) => (data.names ? createListNames(data) : createChainNames(data));
// Chains of the sizes data.sizes, [masses, number of models] each: A5 or 3:5 on a page of one size, 3:5 on a page of several.
const createChainNames = (data) => {
  const kind = data.damped ? "damped" : "undamped", several = data.sizes.length > 1, [[usual]] = data.sizes;
  const all = data.sizes.flatMap(([masses, count]) => Array.from({ length: count }, (_, k) => [masses, k + 1]));
  const typed = (i) => all[i - 1].join(":");
  const place = (masses, { number, dampers, late }) => (dampers || late.length ? 0 : 1 + all.findIndex(([size, at]) => size === masses && at === number));
  const family = (masses) => data.families[`chains-${masses}-${kind}`];
  const seek = (text) => {
    const models = parseModels(text);
    if (!models) return { trouble: `Type a model such as ${several ? "3" : usual}:2, or two of them for a pair.` };
    const masses = models[0].masses || (several ? models.at(-1).masses : usual);
    if (!masses) return { trouble: `Say the number of masses too, such as 3:${models[0].number}.` };
    const places = [...new Set(models.map((m) => place(m.masses || masses, m)))].sort((a, b) => a - b);
    return places[0] ? { models: places } : addressOf(models, masses, kind, data.families);
  };
  return {
    typed,
    seek,
    follow: (hash) => (namedBy(hash) ? seek(namedBy(hash)) : null),
    name: (i) => (several ? typed(i) : `A${i}`),
    hash: (models) => (several ? `#${models.map(typed).join("-")}` : models.length === 2 ? pairHash(models) : `#A${models[0]}`),
    page: (i) => (family(all[i - 1][0]) ? `${family(all[i - 1][0]).folder}/${all[i - 1][1]}.html` : ""),
    masses: (i) => all[i - 1][0],
    // where a page of several sizes leads to the catalogue of one
    catalogue: (i, j) => (several && all[i - 1][0] === all[j - 1][0] && family(all[i - 1][0]) ? `chains-${all[i - 1][0]}-${kind}.html${pairHash([all[i - 1][1], all[j - 1][1]])}` : ""),
  };
};
// Models of a list, by their names; numbered ones are called A1, A2, .. too, their names are texts that commands read; in an address by numbers.
const createListNames = (data) => {
  const there = (numbers) => numbers.every((i) => i >= 1 && i <= data.models) && numbers[0] !== numbers[1];
  const names = data.names.map((name) => name.toLowerCase());
  const called = (word) => (data.numbered && /^a?\d+$/.test(word) && there([+word.replace("a", "")]) ? +word.replace("a", "") : 0);
  const number = (word) => called(word) || 1 + (names.includes(word) ? names.indexOf(word) : names.findIndex((name) => word && name.startsWith(word))); // in full, or its beginning
  return {
    typed: (i) => data.names[i - 1],
    seek: (text) => {
      const parts = [[text], ...[...text.matchAll(/[,;/]/g)].map(({ index }) => [text.slice(0, index), text.slice(index + 1)])]; // a name may have a comma of its own
      const found = parts.map((of) => of.map((part) => number(part.trim().toLowerCase()))).find((of) => !of.includes(0));
      if (!found) return { trouble: "Type the name of a model, or two names with a comma between them." };
      return { models: [...new Set(found)].sort((a, b) => a - b) };
    },
    follow: (hash) => {
      if (!namedBy(hash)) return null;
      const numbers = (/^(?:a(\d+)|(\d+)[-:](\d+))$/i.exec(namedBy(hash)) || []).slice(1).filter(Boolean).map(Number).sort((a, b) => a - b);
      return numbers.length && there(numbers) ? { models: numbers } : { trouble: `There is no ${namedBy(hash)} here: the models are 1 to ${data.models}.` };
    },
    name: (i) => (data.numbered ? `A${i}` : data.names[i - 1]),
    hash: (models) => (models.length === 2 ? pairHash(models) : `#A${models[0]}`),
    page: (i) => `${data.folder}/${i}.html`,
    catalogue: () => "",
  };
};
