// Drawings of a page as a file, in the colours of white paper: [data-picture] names the file; the drawings are those of its parent, side by side.
const PALETTE = {{ file_palette|tojson }};
const wholeDrawing = (svg) => { // references replaced by what they refer to
  const copy = svg.cloneNode(true);
  for (let use; (use = copy.querySelector("use")); ) {
    const source = document.querySelector(use.getAttribute("href") || "none");
    if (!source) { use.remove(); continue; }
    const group = source.cloneNode(true);
    group.removeAttribute("id");
    if (use.hasAttribute("transform")) group.setAttribute("transform", use.getAttribute("transform"));
    use.replaceWith(group);
  }
  return copy;
};
const pictureOf = (svgs) => {
  const gap = 24, edge = 8, boxes = svgs.map((svg) => svg.viewBox.baseVal), at = boxes.map((_, i) => edge + boxes.slice(0, i).reduce((x, b) => x + b.width + gap, 0));
  const width = at.at(-1) + boxes.at(-1).width + edge, height = Math.max(...boxes.map((b) => b.height)) + 2 * edge;
  const inner = svgs.map((svg, i) => `<g transform="translate(${at[i] - boxes[i].x} ${edge - boxes[i].y})">${[...wholeDrawing(svg).childNodes].map((n) => new XMLSerializer().serializeToString(n)).join("")}</g>`);
  const text = `<svg xmlns="${svgs[0].namespaceURI}" width="${width}" height="${height}" viewBox="0 0 ${width} ${height}" font-family="system-ui, 'Segoe UI', Roboto, 'Liberation Sans', 'DejaVu Sans', Arial, sans-serif" stroke-linejoin="round" stroke-linecap="round"><rect width="100%" height="100%" fill="${PALETTE.paper}"/>${inner.join("")}</svg>`;
  return { width, height, text: text.replace(/var\(--([\w-]+)\)/g, (_, name) => PALETTE[name] || PALETTE.line).replaceAll("currentColor", PALETTE.line) };
};
const saveAs = (name, blob) => {
  const link = Object.assign(document.createElement("a"), { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
};
const saved = {
  svg: (name, { text }) => saveAs(`${name}.svg`, new Blob([text], { type: "image/svg+xml" })),
  png: async (name, { width, height, text }) => {
    const image = new Image(), scale = 3, canvas = Object.assign(document.createElement("canvas"), { width: width * scale, height: height * scale });
    image.src = `data:image/svg+xml,${encodeURIComponent(text)}`;
    await image.decode();
    canvas.getContext("2d").drawImage(image, 0, 0, canvas.width, canvas.height);
    canvas.toBlob((blob) => saveAs(`${name}.png`, blob), "image/png");
  },
};
for (const place of document.querySelectorAll("[data-picture]"))
  place.append(...Object.keys(saved).map((kind) => {
    const button = Object.assign(document.createElement("button"), { type: "button", className: "plainbutton", textContent: `Save ${kind.toUpperCase()}` });
    button.addEventListener("click", () => {
      const svgs = [...place.parentElement.querySelectorAll("svg.chain")].filter((svg) => svg.checkVisibility());
      if (svgs.length) saved[kind](place.dataset.picture, pictureOf(svgs));
    });
    return button;
  }));
