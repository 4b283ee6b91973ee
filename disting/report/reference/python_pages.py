"""The reference of the public Python names: a page a module. Docstrings become HTML: paragraphs,
lists, examples, and names in backticks that lead to where they are explained.

What is a sign of Markdown elsewhere is text here: `m1*k12`, `[1FS]=[2]` and `G_0` are written so in
docstrings.
"""

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache, partial

from markdown_it import MarkdownIt
from markdown_it.token import Token
from markupsafe import Markup, escape

from disting.report.environment import render
from disting.report.markdown import GuidePage, Section
from disting.report.reference.entries import Argument, Entry, Place, definition, entries, parse

PLAIN = (
    ["emphasis", "link", "image", "autolink", "escape", "entity", "html_inline"],
    ["heading", "lheading", "hr", "blockquote", "html_block", "reference"],
)
EXAMPLE = re.compile(r"^>>> .*(?:\n.+)*", re.MULTILINE)
NAME = re.compile(r"[A-Za-z_][\w.]*")
Leads = Callable[[str], str]
"""Where a name leads; an empty text if nowhere."""


def as_html(text: str, leads: Leads) -> Markup:
    r"""HTML of a docstring whose indentation is removed.

    >>> print(as_html("A `Chain` of *two*.\n\n>>> 1 + 1\n2", {"Chain": "#Chain"}.get))
    <p>A <a href="#Chain"><code>Chain</code></a> of *two*.</p>
    <pre tabindex="0"><code>&gt;&gt;&gt; 1 + 1
    2</code></pre>
    <BLANKLINE>
    """
    fenced = EXAMPLE.sub(lambda match: f"\n```\n{match[0]}\n```\n", text)
    return Markup(_parser().render(fenced, {"leads": leads}))


@cache
def _parser() -> MarkdownIt:
    parser = MarkdownIt("commonmark").disable([rule for rules in PLAIN for rule in rules])
    parser.add_render_rule("code_inline", _render_name)
    for kind in ("fence", "code_block"):
        parser.add_render_rule(kind, _block)
    return parser


def _render_name(
    _: object, tokens: Sequence[Token], place: int, __: object, env: dict[str, Leads]
) -> str:
    return code(tokens[place].content, env["leads"])


def code(name: str, leads: Leads) -> Markup:
    """A name as code, linked where it is explained."""
    address = leads(name) if NAME.fullmatch(name) else ""
    link = Markup('<a href="{}"><code>{}</code></a>') if address else Markup("<code>{1}</code>")
    return link.format(address, name)


def link(source: str, leads: Leads) -> Markup:
    """An annotation or a default with its names linked.

    >>> link("tuple[Chain, ...]", {"Chain": "#Chain"}.get)
    Markup('tuple[<a href="#Chain">Chain</a>, ...]')
    """
    markup, done = Markup(), 0
    for match in NAME.finditer(source):
        address = leads(match[0])
        if address:
            link = Markup('<a href="{}">{}</a>').format(address, match[0])
            markup, done = markup + source[done : match.start()] + link, match.end()
    return markup + source[done:]


def _block(_: object, tokens: Sequence[Token], place: int, *__: object) -> str:
    return f'<pre tabindex="0"><code>{escape(tokens[place].content.rstrip())}</code></pre>\n'


MODULES = (
    "disting",
    "disting.equivalence",
    "disting.experiments",
    "disting.fit",
    "disting.general",
    "disting.measurement",
    "disting.questions.identifiability",
    "disting.report",
    "disting.simulation",
)
WIDEST = 88  # characters of a signature on one line


@dataclass(frozen=True, slots=True)
class PageEntry:
    """An entry as the page shows it; `elsewhere`: the address where it is explained, if that is
    another page.
    """

    entry: Entry
    anchor: str
    signature: Markup
    raises: tuple[Markup, ...]
    text: Markup
    members: tuple["PageEntry", ...] = ()
    elsewhere: str = ""

    @property
    def gist(self) -> str:
        """First sentence of the docstring, as plain text."""
        return self.entry.text.split("\n\n")[0].replace("`", "")


@cache
def python_pages() -> tuple[GuidePage, ...]:
    """A page for every public module; a name that two of them hand on is explained in the first."""
    offered = {name: sorted(entries(name), key=lambda e: e.name.lower()) for name in MODULES}
    addresses: dict[Place, str] = {}
    for name, the_entries in offered.items():
        for entry in the_entries:
            addresses.setdefault(entry.place, f"{page_name(name)}.html#{entry.name}")
    pages = tuple(_page(name, the_entries, addresses) for name, the_entries in offered.items())
    parse.cache_clear()  # nobody asks for a tree again
    return pages


def page_name(module: str) -> str:
    """Name of a module's page.

    >>> page_name("disting.questions.identifiability")
    'python-identifiability'
    """
    return f"python-{module.split('.')[-1]}"


def _page(name: str, the_entries: list[Entry], addresses: Mapping[Place, str]) -> GuidePage:
    shown = [_show_entry(name, entry, addresses) for entry in the_entries]
    text = as_html(parse(name).text, partial(_address, name, addresses))
    body = Markup(render("reference.html", module=name, text=text, entries=shown))
    sections = [Section("", f"Python: {name}", 1, parse(name).text)]
    for item in shown:
        sections += _sections(item) if not item.elsewhere else []
    return GuidePage(page_name(name), f"Python: {name}", tuple(sections), body, True)


def _sections(item: PageEntry, level: int = 2) -> Iterator[Section]:
    """Sections for the search: an entry and its members, by the first sentences of their
    docstrings.
    """
    text = item.entry.text.split("\n\n")[0]
    yield Section(item.anchor, item.anchor, level, text)
    for member in item.members:
        yield from _sections(member, level + 1)


def _show_entry(
    module: str, entry: Entry, addresses: Mapping[Place, str], within: str = ""
) -> PageEntry:
    leads = partial(_address, entry.place.module, addresses)
    errors = partial(_address, "disting.errors", addresses)  # whoever raises them
    anchor = f"{within}.{entry.name}" if within else entry.name
    address = addresses.get(entry.place, "")
    elsewhere = "" if within or address.startswith(f"{page_name(module)}.html") else address
    members = (
        [_show_entry(module, m, addresses, anchor) for m in entry.members] if not elsewhere else []
    )
    return PageEntry(
        entry=entry,
        anchor=anchor,
        signature=_signature(entry, leads),
        raises=tuple(link(name, lambda e: leads(e) or errors(e)) for name in entry.raises),
        text=as_html(entry.text, leads),
        members=tuple(members),
        elsewhere=elsewhere,
    )


def _address(module: str, addresses: Mapping[Place, str], name: str) -> str:
    """Target of a name in the source of a module: `Chain`, `Chain.parameters`, `View.EXACT` or
    `fit.select`.
    """
    head, _, rest = name.partition(".")
    at = definition(Place(module, head))
    if at and at in addresses:
        return addresses[at]
    return _address(f"disting.{head}", addresses, rest) if rest and "." not in rest else ""


def _signature(entry: Entry, leads: Leads) -> Markup:
    """Name, arguments with types and defaults, and what is returned; a line for each argument
    where one line is too short for all.
    """
    if entry.arguments is None:
        return _show_value(entry, leads)
    written = [_write_argument(argument, leads) for argument in entry.arguments]
    end = Markup(" -&gt; ") + link(entry.returns, leads) if entry.returns else Markup()
    width = len(entry.name) + sum(len(w.striptags()) + 2 for w in written) + len(end.striptags())
    if width <= WIDEST:
        return Markup("{}({})").format(entry.name, Markup(", ").join(written)) + end
    lines = Markup("").join(Markup("    {},\n").format(argument) for argument in written)
    return Markup("{}(\n{})").format(entry.name, lines) + end


def _show_value(entry: Entry, leads: Leads) -> Markup:
    """A property, a constant or a member of an enumeration; of a class its name."""
    parts = Markup(entry.name)
    if entry.returns:
        parts += Markup(": ") + link(entry.returns, leads)
    return parts + (Markup(" = ") + link(entry.value, leads) if entry.value else "")


def _write_argument(argument: Argument, leads: Leads) -> Markup:
    markup = Markup("{}{}").format(argument.star, argument.name)
    if argument.annotation:
        markup += Markup(": ") + link(argument.annotation, leads)
    if argument.default:
        space = " " if argument.annotation else ""
        markup += Markup("{0}={0}").format(space) + link(argument.default, leads)
    return markup
