"""Docstrings as HTML: paragraphs, lists, examples, and names in backticks that lead to where they
are explained.

What is a sign of Markdown elsewhere is text here: `m1*k12`, `[1FS]=[2]` and `G_0` stand in
docstrings as they are.
"""

import re
from collections.abc import Callable, Sequence
from functools import cache

from markdown_it import MarkdownIt
from markdown_it.token import Token
from markupsafe import Markup, escape

PLAIN = (
    ["emphasis", "link", "image", "autolink", "escape", "entity", "html_inline"],
    ["heading", "lheading", "hr", "blockquote", "html_block", "reference"],
)
EXAMPLE = re.compile(r"^>>> .*(?:\n.+)*", re.MULTILINE)
NAME = re.compile(r"[A-Za-z_][\w.]*")
Leads = Callable[[str], str]
"""Where a name leads; an empty text if nowhere."""


def rendered(text: str, leads: Leads) -> Markup:
    r"""HTML of a docstring whose indentation is removed.

    >>> print(rendered("A `Chain` of *two*.\n\n>>> 1 + 1\n2", {"Chain": "#Chain"}.get))
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
    parser.add_render_rule("code_inline", _named)
    for kind in ("fence", "code_block"):
        parser.add_render_rule(kind, _block)
    return parser


def _named(
    _: object, tokens: Sequence[Token], place: int, __: object, env: dict[str, Leads]
) -> str:
    return code(tokens[place].content, env["leads"])


def code(name: str, leads: Leads) -> Markup:
    """A name as code, linked where it is explained."""
    address = leads(name) if NAME.fullmatch(name) else ""
    link = Markup('<a href="{}"><code>{}</code></a>') if address else Markup("<code>{1}</code>")
    return link.format(address, name)


def linked(source: str, leads: Leads) -> Markup:
    """An annotation or a default with its names linked.

    >>> linked("tuple[Chain, ...]", {"Chain": "#Chain"}.get)
    Markup('tuple[<a href="#Chain">Chain</a>, ...]')
    """
    found, done = Markup(), 0
    for match in NAME.finditer(source):
        address = leads(match[0])
        if address:
            link = Markup('<a href="{}">{}</a>').format(address, match[0])
            found, done = found + source[done : match.start()] + link, match.end()
    return found + source[done:]


def _block(_: object, tokens: Sequence[Token], place: int, *__: object) -> str:
    return f'<pre tabindex="0"><code>{escape(tokens[place].content.rstrip())}</code></pre>\n'
