"""Pieces of HTML for notebooks: complete in themselves, without a style sheet, in the notebook's
own colours wherever a colour means nothing.
"""

from collections.abc import Callable, Iterable, Sequence

from markupsafe import Markup, escape

from disting.report.scene import FILE_PALETTE, Ink
from disting.report.words import SAID
from disting.verdict import Relation

LONGEST = 12  # rows, columns or drawings that are shown of many
FILLS = {
    Relation.DISTINGUISHABLE: (Ink.DISTINGUISHABLE, Ink.ON_DISTINGUISHABLE, "≠"),
    Relation.INDISTINGUISHABLE: (Ink.INDISTINGUISHABLE, Ink.ON_INDISTINGUISHABLE, "="),
    Relation.SOMETIMES: (Ink.SOMETIMES, Ink.ON_SOMETIMES, "≈"),
    Relation.UNDECIDED: (Ink.UNDECIDED, Ink.PAPER, "?"),
}
"""Ground, letter and sign of a relation: the colours of the pages, and a sign beside them."""


def block(*parts: str) -> str:
    """Parts below each other."""
    return Markup("<div>{}</div>").format(Markup("").join(p for p in parts if p))


def line(text: str, *, bold: bool = False) -> Markup:
    """A line of text, escaped."""
    inside = Markup("<strong>{}</strong>").format(text) if bold else escape(text)
    return Markup("<p>{}</p>").format(inside)


def table(head: Sequence[str], rows: Iterable[Sequence[object]]) -> Markup:
    """A table; cells that are Markup stay as they are."""
    top = Markup("").join(Markup("<th>{}</th>").format(h) for h in head)
    body = Markup("").join(
        Markup("<tr>{}</tr>").format(Markup("").join(map(_cell, row))) for row in rows
    )
    return Markup("<table><thead><tr>{}</tr></thead><tbody>{}</tbody></table>").format(top, body)


def facts(rows: Iterable[tuple[str, object]]) -> Markup:
    """Names and what they are; those without are left out."""
    body = Markup("").join(
        Markup("<tr><th>{}</th>{}</tr>").format(name, _cell(value)) for name, value in rows if value
    )
    return Markup("<table><tbody>{}</tbody></table>").format(body)


def matrix(names: Sequence[str], relation: Callable[[int, int], Relation]) -> Markup:
    """The relations of models counted from 0, the first `LONGEST` of them, with a legend."""
    shown = range(min(len(names), LONGEST))
    rows = (
        (Markup("<strong>{}</strong>").format(names[i]), *(_field(i, j, relation) for j in shown))
        for i in shown
    )
    return table(["", *(names[j] for j in shown)], rows) + line(
        ", ".join(f"{sign} {SAID[r]}" for r, (_, _, sign) in FILLS.items())
    )


def more(total: int, what: str, hint: str) -> Markup:
    """That the first of many are shown, and what shows the rest; nothing where all are."""
    return line(f"The first {LONGEST} of {total} {what}. {hint}") if total > LONGEST else Markup("")


def _field(i: int, j: int, relation: Callable[[int, int], Relation]) -> Markup:
    if i == j:
        return Markup("<td></td>")
    found = relation(i, j)
    ground, letter, sign = FILLS[found]
    style = f"text-align:center;background:{FILE_PALETTE[ground]};color:{FILE_PALETTE[letter]}"
    return Markup('<td style="{}" title="{}">{}</td>').format(style, SAID[found], sign)


def _cell(value: object) -> Markup:
    if isinstance(value, Markup) and value.startswith("<td"):
        return value
    return Markup('<td style="text-align:left">{}</td>').format(value)
