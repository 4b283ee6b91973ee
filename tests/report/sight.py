"""What a reader cannot see or reach on a page, measured by the browser that shows it."""

CUT = r"""() => {
  const found = new Set(), page = document.documentElement, wide = page.clientWidth;
  const seen = (e) => e.checkVisibility({ visibilityProperty: true }) && !hidden(e);
  const kept = (of) => { // asked of each element once, as its descendants ask it again
    const known = new Map();
    return (e) => known.has(e) ? known.get(e) : known.set(e, of(e)).get(e);
  };
  const hidden = kept((e) => e !== null && (getComputedStyle(e).clipPath === "inset(50%)" || hidden(e.parentElement))); // for those who listen only
  const words = (e) => (e.textContent || e.placeholder || "").trim().replace(/\s+/g, " ").slice(0, 40);
  const tell = (what, e) => found.add(`${what}: ${e.localName}${e.id && "#" + e.id}.${e.classList.value} "${words(e)}"`);
  const boxFrom = kept((up) => { // it or what is around it that cuts off or scrolls
    if (!up || up === page) return null;
    const { overflowX, overflowY, position } = getComputedStyle(up);
    if (overflowX !== "visible" || overflowY !== "visible") return up;
    return position === "fixed" ? null : boxFrom(up.parentElement);
  });
  const boxOf = (e) => boxFrom(e.parentElement);
  const cuts = (overflow) => overflow === "hidden" || overflow === "clip";
  const ownWords = (e) => [...e.childNodes].some((n) => n.nodeType === 3 && n.data.trim());
  const shortField = (e, style) => { // the value of a field is wider than the field
    const pen = new OffscreenCanvas(1, 1).getContext("2d"), arrow = e.localName === "select" ? 16 : 0;
    pen.font = `${style.fontStyle} ${style.fontWeight} ${style.fontSize} ${style.fontFamily}`;
    const shown = e.localName === "select" ? e.selectedOptions[0]?.text ?? "" : e.value || e.placeholder;
    const room = e.clientWidth - parseFloat(style.paddingLeft) - parseFloat(style.paddingRight) - arrow;
    if (pen.measureText(shown).width > room + 1) tell(`"${shown}" cut`, e);
  };
  for (const e of document.body.querySelectorAll("*")) {
    if (e.parentElement.closest("svg") || !seen(e)) continue;
    const style = getComputedStyle(e), box = e.getBoundingClientRect(), around = boxOf(e);
    if (!box.width || !box.height) continue;
    if (e.matches("input[type=text], select")) shortField(e, style);
    if (cuts(style.overflowX) && e.scrollWidth > e.clientWidth + 1 || cuts(style.overflowY) && e.scrollHeight > e.clientHeight + 1) tell("cut off", e);
    if (!around && (box.left + scrollX < -1 || box.top + scrollY < -1)) tell("before the page", e);
    if (!around && box.right > wide + 1) tell("beyond the window", e);
    if (style.position === "fixed" && (box.top < -1 || box.bottom > innerHeight + 1)) tell("beyond the window", e);
    if (around && ownWords(e) && !around.scrollLeft && box.left < around.getBoundingClientRect().left - 1) tell("before its box", e);
    if (style.display !== "inline" && style.overflowY === "visible" && e.localName !== "svg" && e.localName !== "mo" && e.clientHeight && e.scrollHeight > e.clientHeight + 8) tell("spills over", e);
    if (ownWords(e) && style.display !== "inline" && style.overflowX === "visible" && e.scrollWidth > e.clientWidth + 1) tell("words out of their box", e);
  }
  for (const text of document.querySelectorAll("svg:not(.store) text")) {
    const svg = text.closest("svg:not(svg svg)"), [a, b] = [text, svg].map((e) => e.getBoundingClientRect());
    if (svg.closest(".store") || !a.width || getComputedStyle(svg).overflow === "visible" || !seen(svg)) continue;
    if (a.left < b.left - 1 || a.right > b.right + 1 || a.top < b.top - 1 || a.bottom > b.bottom + 1) tell("cut off in a drawing", text);
    if (Math.max(a.width / text.textContent.length, a.height) < 5) tell("too small to read", text);
  }
  for (const use of document.querySelectorAll("use[href^='#']"))
    if (use.closest("svg").checkVisibility() && !document.getElementById(use.getAttribute("href").slice(1))) tell("a part is missing", use);
  const beyond = page.scrollWidth - wide;
  if (beyond > 0) found.add(`the page scrolls sideways by ${beyond} px`);
  return [...found];
}"""


def out_of_sight(tab) -> list[str]:  # type: ignore[no-untyped-def]
    """What is cut off or too small to read, lies outside of the page where no box scrolls to it, or
    makes the whole page scroll sideways.
    """
    return list(tab.evaluate(CUT))
