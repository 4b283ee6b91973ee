"""The guide: pages of Markdown in the package, rendered as pages of the site.

Markdown is that of CommonMark, with tables. Markup in a page is text, never passed through. A link
to another page of the guide leads to the rendered page; a link that leads out of the guide has no
place in the site and stays as its words. The page named "index" lists the others, and their order
there is that of the navigation.
"""

import re
from collections import Counter
from collections.abc import Container, Iterator, Sequence
from dataclasses import dataclass
from importlib.resources import files
from itertools import pairwise

from markdown_it import MarkdownIt
from markdown_it.token import Token
from markupsafe import Markup, escape

from disting.report.environment import render, source

LISTING = "index"
# letters; a table with two such cells in a row is read row by row where the screen is narrow
LONG = 40
ADDRESS = re.compile(r"([a-z0-9-]+)\.md(#[\w-]+)?")
Contents = tuple[tuple[str, str], ...]
"""Anchors and titles of a page's sections."""


@dataclass(frozen=True, slots=True)
class GuidePage:
    """A page: its name without an ending, its first heading, its sections, and what follows the
    first heading as HTML.
    """

    name: str
    title: str
    contents: Contents
    body: Markup


def guide_files() -> Iterator[tuple[str, bytes]]:
    """Address below the site's folder and content of every page of the guide, and of their
    style sheet.
    """
    texts = guide_texts()
    pages = [guide_page(name, text, texts) for name, text in texts.items()]
    for place, page in enumerate(pages):
        yield f"guide/{page.name}.html", framed(page, pages, place).encode()
    yield "guide/style.css", (source("style.css") + source("guide.css")).encode()


def guide_texts() -> dict[str, str]:
    """Markdown of every page by its name: the listing first, then the others as it lists them,
    then any that it does not.
    """
    found = {
        path.name.removesuffix(".md"): path.read_text(encoding="utf-8")
        for path in sorted((files("disting") / "guide").iterdir(), key=lambda path: path.name)
        if path.name.endswith(".md")
    }
    listed = [match[1] for match in ADDRESS.finditer(found[LISTING]) if match[1] in found]
    return {name: found[name] for name in dict.fromkeys([LISTING, *listed, *found])}


def framed(page: GuidePage, pages: Sequence[GuidePage], place: int) -> str:
    """HTML of a page with the navigation; `place`: where it stands among all pages."""
    return render(
        "guide.html",
        page=page,
        pages=pages,
        before=pages[place - 1] if place else None,
        after=pages[place + 1] if place + 1 < len(pages) else None,
    )


def guide_page(name: str, text: str, known: Container[str]) -> GuidePage:
    """A page of Markdown whose first block is its title; `known`: names of the pages that links
    may lead to.

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
    contents = _with_anchors(tokens)
    _with_names_of_columns(tokens)
    for token in tokens:
        if token.children:
            token.children = list(_led(token.children, known))
    title = _words(tokens[1])
    return GuidePage(
        name, title, contents, Markup(parser.renderer.render(tokens[3:], parser.options, {}))
    )


def _parser() -> MarkdownIt:
    """CommonMark with tables, without HTML; what may be wider than a phone scrolls in a box of
    its own.
    """
    # nothing is fetched
    parser = MarkdownIt("commonmark", {"html": False}).enable("table").disable("image")
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


def _code(_: object, tokens: Sequence[Token], place: int, *__: object) -> str:
    return f'<pre tabindex="0"><code>{escape(tokens[place].content.rstrip())}</code></pre>\n'


def _code_in_text(_: object, tokens: Sequence[Token], place: int, *__: object) -> str:
    """An option such as --no-cache is not broken at its hyphens."""
    whole = Markup('<span class="nobr">{}</span>')
    words = (
        whole.format(word) if "-" in word and len(word) < LONG else word
        for word in tokens[place].content.split(" ")
    )
    return f"<code>{Markup(' ').join(words)}</code>"


def _with_anchors(tokens: Sequence[Token]) -> Contents:
    """Give every heading an anchor, and every table the heading above it; the sections
    (headings of level 2).
    """
    seen: Counter[str] = Counter()
    contents, heading = [], ""
    for token, inner in pairwise(tokens):
        if token.type == "heading_open":
            heading = _words(inner)
            anchor = _anchor(heading)
            token.attrSet("id", f"{anchor}-{seen[anchor]}" if seen[anchor] else anchor)
            seen[anchor] += 1
            contents += [(str(token.attrs["id"]), heading)] if token.tag == "h2" else []
        elif token.type == "table_open":
            token.meta["under"] = heading
    return tuple(contents)


def _with_names_of_columns(tokens: Sequence[Token]) -> None:
    """Give every cell of a wordy table the name of its column, which stands before it where
    rows are stacked.
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
    return "".join(child.content for child in inline.children or ())


def _led(children: Sequence[Token], known: Container[str]) -> Iterator[Token]:
    """The same words with links to rendered pages; of a link that leads out of the guide only
    its words.
    """
    leads = True  # links do not nest
    for token in children:
        if token.type == "link_open":
            address = _rendered(str(token.attrs["href"]), known)
            leads = bool(address)
            token.attrSet("href", address)
        if leads or token.type not in ("link_open", "link_close"):
            yield token


def _rendered(address: str, known: Container[str]) -> str:
    """Where a link of a page leads in the site; empty if that is nowhere."""
    if address.startswith("#"):
        return address
    match = ADDRESS.fullmatch(address)
    return f"{match[1]}.html{match[2] or ''}" if match and match[1] in known else ""
