"""Words that a reader may not know: each page of the guide links the first use of each to the
glossary.

A page may use such a word only with a link, which a test asks of every page and template.
"""

import re
from collections.abc import Iterable, Iterator

from markdown_it.token import Token

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
    """Which of them a text uses, with their headings in the glossary.

    >>> hard_words("Generic values; chi2 per line of two fibres")
    {'generic': 'generic', 'chi2 per line': 'chi2-per-line', 'fibre': 'fibre'}
    """
    return {m[1].lower(): ANCHORS[m[1].lower()] for m in WORD.finditer(text)}


def link_words(inlines: Iterable[Token]) -> None:
    """Make the first use of each word in running text a link to the glossary, in place."""
    done: set[str] = set()
    for inline in inlines:
        inline.children = list(_linked(inline.children or (), done))


def _linked(children: Iterable[Token], done: set[str]) -> Iterator[Token]:
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
