"""Pages of Markdown as pages of the site.

Markdown is that of CommonMark, with tables. Markup in a page is text, never passed through. A link
to another page of the guide, or to a notebook, leads to the rendered page; hard words lead to the
glossary (page "glossary"); a link that leads elsewhere has no place in the site and stays as its
words. An image is a drawing (SVG) next to the pages, and becomes a part of the page. A block named
"picture" holds a model a line, such as `3:1 --damped`, or a network, and is shown as their
drawings; text after the name of a chain is for readers of the source, text after a network is its
caption.

Each page of the guide links the first use of a word that a reader may not know to the glossary; a
page may use such a word only with a link, which a test checks on every page and template.
"""

import re
from collections import Counter
from collections.abc import Container, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from types import MappingProxyType

from markdown_it import MarkdownIt
from markdown_it.token import Token
from markupsafe import Markup, escape

from disting.model.family import Family
from disting.model.names import chain_of
from disting.network.notation import network_of, notations_of
from disting.report.drawing import draw
from disting.report.network_drawing import draw_network
from disting.report.scene import PAGE_PALETTE, Scene, body

PAGE = "glossary"
HARD = {
    "chi2 per line": "chi2-per-line",
    "chi2": "chi2-per-line",
    "Akaike weight": "akaike-weight",
    "J test": "j-test",
    "J train": "j-train",
    "hit rate": "hit-rate",
    "condition index": "scaled-condition-index",
    "collinearity": "collinearity-index",
    "PII": "parameter-importance-index",
    "noncentrality": "noncentrality",
    "generic rank": "generic-rank",
    "generic": "generic",
    "moment invariant": "moment-invariant",
    "Markov parameter": "markov-parameter",
    "exhaustive summary": "exhaustive-summary",
    "symbolic form": "symbolic-form",
    "matroid": "matroid",
    "fibre": "fibre",
    "closure": "closure",
    "receptance": "receptance",
    "collocated": "collocated",
    "driving-point function": "driving-point-function",
    "degree of freedom": "degree-of-freedom",
    "degrees of freedom": "degree-of-freedom",
    "likelihood": "likelihood",
    "crest factor": "crest-factor",
    "multisine": "multisine",
}
"""Each with its heading in the glossary; a longer one before one that it begins with."""

WORD = re.compile(
    r"(?<![\w-])(" + "|".join(map(re.escape, HARD)) + r")(?:s|es|ations?)?(?![\w-])", re.IGNORECASE
)
ANCHORS = {word.lower(): anchor for word, anchor in HARD.items()}


def hard_words(text: str) -> dict[str, str]:
    """Hard words in a text, with their headings in the glossary.

    >>> hard_words("Generic values; chi2 per line of two fibres")
    {'generic': 'generic', 'chi2 per line': 'chi2-per-line', 'fibre': 'fibre'}
    """
    return {m[1].lower(): ANCHORS[m[1].lower()] for m in WORD.finditer(text)}


def link_words(inlines: Iterable[Token]) -> None:
    """Make the first use of each word in running text a link to the glossary, in place."""
    done: set[str] = set()
    for inline in inlines:
        inline.children = list(_link_words(inline.children or (), done))


def _link_words(children: Iterable[Token], done: set[str]) -> Iterator[Token]:
    inside = 0  # of a link, which does not nest
    for token in children:
        inside += token.nesting if token.type in ("link_open", "link_close") else 0
        if token.type == "link_open" and (address := str(token.attrs["href"])).startswith(PAGE):
            done.add(address.partition("#")[2])
        if inside or token.type != "text":
            yield token
            continue
        yield from _parts(token.content, done)


def _parts(text: str, done: set[str]) -> Iterator[Token]:
    at = 0
    for match in WORD.finditer(text):
        anchor = ANCHORS[match[1].lower()]
        if anchor in done:
            continue
        done.add(anchor)
        yield _text(text[at : match.start()])
        yield Token("link_open", "a", 1, attrs={"href": f"{PAGE}.html#{anchor}", "class": "term"})
        yield _text(match[0])
        yield Token("link_close", "a", -1)
        at = match.end()
    yield _text(text[at:])


def _text(content: str) -> Token:
    return Token("text", "", 0, content=content)


# letters; a table with two such cells in a row is read row by row where the screen is narrow
LONG = 40
ENLARGED = 1.4  # drawings of chains
FIGURE = Markup('<figure class="picture">{}<figcaption>{}</figcaption></figure>\n')
COPIED = Markup(
    '<div class="code"><pre tabindex="0"><code>{}</code></pre><button type="button"'
    ' class="plainbutton interactive" data-copy data-text="{}">Copy</button></div>\n'
)
ADDRESS = re.compile(r"([a-z0-9-]+)\.md(#[\w-]+)?")
NOTEBOOK = re.compile(r"\.\./\.\./reports/notebooks/([\w-]+)\.ipynb")
PREFIX = "notebook-"  # of the names of pages of executed notebooks


@dataclass(frozen=True, slots=True)
class Section:
    """A part of a page: its anchor (empty: before the first heading), its heading and the level of
    that (1 to 6), and its words.
    """

    anchor: str
    title: str
    level: int
    words: str = ""


@dataclass(frozen=True, slots=True)
class GuidePage:
    """A page: its name without an ending, its first heading, its sections, and what follows the
    first heading as HTML; `is_folded`: parts of it are closed until an address names them.
    """

    name: str
    title: str
    sections: tuple[Section, ...]
    body: Markup
    is_folded: bool = False

    @property
    def contents(self) -> tuple[tuple[str, str], ...]:
        """Anchors and titles of the sections that a list of contents names."""
        return tuple((s.anchor, s.title) for s in self.sections if s.level == 2)


NOTHING: Mapping[str, str] = MappingProxyType({})


def guide_page(
    name: str,
    text: str,
    container: Container[str],
    drawings: Mapping[str, str] = NOTHING,
    outputs: Mapping[str, str] = NOTHING,
) -> GuidePage:
    """A page of Markdown whose first block is its title; `container`: names of the pages that links
    may lead to; `drawings`: SVG by the names of the files that images may name; `outputs`: HTML
    in the place of blocks, by what these are named.

    >>> text = "# Title\\n\\n## Of *one*\\n\\nSee [b](b.md) and [code](../b.py), <b>."
    >>> page = guide_page("a", text, ["a", "b"])
    >>> page.title, page.contents
    ('Title', (('of-one', 'Of one'),))
    >>> print(page.body.splitlines()[1])
    <p>See <a href="b.html">b</a> and code, &lt;b&gt;.</p>

    Raises ValueError if the first block is not a heading of level 1.
    """
    parser = _parser()
    tokens = parser.parse(text)
    if len(tokens) < 3 or tokens[0].tag != "h1":
        raise ValueError(f"page {name} of the guide does not begin with its title")
    sections = _with_anchors(tokens)
    _with_names_of_columns(tokens)
    for before, token, after in zip(tokens, tokens[1:], tokens[2:], strict=False):
        if token.children:
            token.children = list(_lead_links(token.children, container))
            if [child.type for child in token.children] == ["image"]:
                before.hidden = after.hidden = True  # a figure is no part of a paragraph
    title = _words(tokens[1])
    if PAGE in container and name != PAGE:
        pairs = pairwise(tokens[2:])
        link_words(
            inner for token, inner in pairs if inner.children and token.type != "heading_open"
        )
    html = parser.renderer.render(
        tokens[3:], parser.options, {"drawings": drawings, "outputs": outputs}
    )
    return GuidePage(name, title, sections, Markup(html))


def _parser() -> MarkdownIt:
    """CommonMark with tables, without HTML; what may be wider than a phone scrolls in a box of
    its own.
    """
    parser = MarkdownIt("commonmark", {"html": False}).enable("table")
    parser.add_render_rule("image", _drawing)
    parser.add_render_rule("table_open", _table_open)
    parser.add_render_rule("table_close", lambda *_: "</table>\n</div>\n")
    parser.add_render_rule("code_inline", _code_in_text)
    for kind in ("fence", "code_block"):
        parser.add_render_rule(kind, _code)
    return parser


def _table_open(_: object, tokens: Sequence[Token], place: int, *__: object) -> str:
    label = escape(f"Table: {tokens[place].meta['under']}")
    kind = "plain wordy" if tokens[place].meta.get("wordy") else "plain"
    return (
        f'<div class="scroll" tabindex="0" role="group" aria-label="{label}">\n<table'
        f' class="{kind}">\n'
    )


def _drawing(
    _: object, tokens: Sequence[Token], place: int, __: object, env: Mapping[str, Mapping[str, str]]
) -> str:
    """A drawing in its place; nothing is fetched, so an image of another place is its words."""
    text = env["drawings"].get(str(tokens[place].attrs["src"]))
    words = escape(tokens[place].content)
    return FIGURE.format(Markup(text), words) if text else words


def _pictures(lines: Sequence[str]) -> str:
    """Drawings of the models that a block names."""
    return "".join(_picture(*re.split(r"\s{2,}", line, maxsplit=1)) for line in lines)


def _picture(model: str, said: str = "") -> str:
    """A chain with its drawing in words; a network with its caption."""
    if notations_of(model):
        scene = draw_network(network_of(model))
        return _figure(scene, said)
    name, _, option = model.partition(" ")
    scene = draw(chain_of(name, Family(1, damped=option == "--damped")))
    return _figure(scene, f"{name}: {scene.title}")


def _figure(scene: Scene, said: str) -> str:
    size = f'width="{scene.width * ENLARGED:.0f}" viewBox="0 0 {scene.width:g} {scene.height:g}"'
    drawn = Markup(f'<svg class="chain" {size}>{body(scene, PAGE_PALETTE)}</svg>')
    return FIGURE.format(drawn, said)


def _code(
    _: object, tokens: Sequence[Token], place: int, __: object, env: Mapping[str, Mapping[str, str]]
) -> str:
    if tokens[place].info in env["outputs"]:
        return env["outputs"][tokens[place].info]
    if tokens[place].info == "picture":
        return _pictures(tokens[place].content.splitlines())
    content = tokens[place].content.rstrip()
    return COPIED.format(content, typed_text(content))


def typed_text(shown: str) -> str:
    """Part of a block that a reader types: commands without their outputs, Python without its
    answers, else the whole of it.

    >>> typed_text("$ disting doctor\\nfine"), typed_text(">>> for i in (1,):\\n...     i\\n1")
    ('disting doctor', 'for i in (1,):\\n    i')
    """
    marks = ("$ ",) if shown.startswith("$ ") else (">>> ", "... ")
    lines = [line[len(marks[0]) :] for line in shown.splitlines() if line.startswith(marks)]
    return "\n".join(lines) if shown.startswith(marks) else shown


def _code_in_text(_: object, tokens: Sequence[Token], place: int, *__: object) -> str:
    """An option such as --no-cache is not broken at its hyphens."""
    whole = Markup('<span class="nobr">{}</span>')
    words = (
        whole.format(word) if "-" in word and len(word) < LONG else word
        for word in tokens[place].content.split(" ")
    )
    return f"<code>{Markup(' ').join(words)}</code>"


def _with_anchors(tokens: Sequence[Token]) -> tuple[Section, ...]:
    """Give every heading but the title an anchor, and every table the heading above it; the
    sections.
    """
    counts: Counter[str] = Counter()
    sections = [Section("", _words(tokens[1]), 1)]
    words: list[str] = []
    for token, inner in pairwise(tokens[2:]):
        if token.type == "heading_open":
            sections[-1] = replace(sections[-1], words=" ".join(words))
            words, heading = [], _words(inner)
            anchor = _anchor(heading)
            token.attrSet("id", f"{anchor}-{counts[anchor]}" if counts[anchor] else anchor)
            counts[anchor] += 1
            sections.append(Section(str(token.attrs["id"]), heading, int(token.tag[1:])))
        elif token.type == "table_open":
            token.meta["under"] = sections[-1].title
        elif inner.type == "inline" and token.type != "heading_open":
            words.append(_words(inner))
    return (*sections[:-1], replace(sections[-1], words=" ".join(words)))


def _with_names_of_columns(tokens: Sequence[Token]) -> None:
    """Give every cell of a wordy table the name of its column, which is shown before it where rows
    are stacked.
    """
    table, names = tokens[0], list[str]()
    cells = list[tuple[Token, Token]]()
    for token, inner in pairwise(tokens):
        if token.type == "table_open":
            table, names, cells = token, [], []
        elif token.type == "th_open":
            names.append(_words(inner))
        elif token.type == "td_open":
            cells.append((token, inner))
        elif token.type == "table_close":
            rows = [cells[i : i + len(names)] for i in range(0, len(cells), len(names))]
            table.meta["wordy"] = any(
                sum(len(_words(words)) > LONG for _, words in row) > 1 for row in rows
            )
            for row in rows if table.meta["wordy"] else []:
                for (cell, _), name in zip(row, names, strict=True):
                    cell.attrSet("data-name", name)


def _anchor(heading: str) -> str:
    """As code hosts make them, so that one link serves the text and the page.

    >>> _anchor("What is read, and how?")
    'what-is-read-and-how'
    """
    return re.sub(r"[^\w\- ]", "", heading.lower()).strip().replace(" ", "-")


def _words(inline: Token) -> str:
    # a line of the source that ends within a sentence is a child without words
    return "".join(
        child.content or (" " if child.type == "softbreak" else "")
        for child in inline.children or ()
    )


def _lead_links(children: Sequence[Token], container: Container[str]) -> Iterator[Token]:
    """The same words with links to rendered pages; of a link that leads out of the guide only
    its words.
    """
    leads = True  # links do not nest
    for token in children:
        if token.type == "link_open":
            address = _rendered_address(str(token.attrs["href"]), container)
            leads = bool(address)
            token.attrSet("href", address)
        if leads or token.type not in ("link_open", "link_close"):
            yield token


def _rendered_address(address: str, container: Container[str]) -> str:
    """Where a link of a page leads in the site; empty if that is nowhere."""
    if address.startswith("#"):
        return address
    if notebook := NOTEBOOK.fullmatch(address):
        name = f"{PREFIX}{notebook[1]}"
        return f"{name}.html" if name in container else ""
    match = ADDRESS.fullmatch(address)
    return f"{match[1]}.html{match[2] or ''}" if match and match[1] in container else ""
