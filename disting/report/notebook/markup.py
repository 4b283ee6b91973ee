"""Pieces of HTML for notebooks: complete in themselves, without a style sheet, in the notebook's
own colours wherever a colour means nothing.
"""

from collections.abc import Callable, Iterable, Sequence

import numpy as np
from markupsafe import Markup, escape

from disting.measurement.arrays import Real
from disting.report.scene import FILE_PALETTE, Ink, Layer, Path, Scene
from disting.report.svg import svg
from disting.report.words import SAID
from disting.verdict.result import Relation

WIDTH, HEIGHT, EDGE = 280.0, 90.0, 6.0
MOST = 400  # points


def curve(x: Real, y: Real, title: str) -> str:
    """Stand-alone SVG of positive values over rising positive places, shape (n,) each."""
    at = np.unique(np.linspace(0, len(x) - 1, min(len(x), MOST)).astype(int))
    across, up = (_scaled(np.log(values[at])) for values in (x, y))
    points = tuple(
        (EDGE + (WIDTH - 2 * EDGE) * float(a), HEIGHT - EDGE - (HEIGHT - 2 * EDGE) * float(b))
        for a, b in zip(across, up, strict=True)
    )
    return svg(Scene(WIDTH, HEIGHT, (Layer("curve", (Path(points, Ink.SENSOR),)),), title))


def _scaled(values: Real) -> Real:
    """From 0 to 1; 1/2 where they are all the same."""
    span = float(np.ptp(values))
    return np.asarray((values - values.min()) / span if span else np.full(len(values), 0.5))


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
    the_relation = relation(i, j)
    ground, letter, sign = FILLS[the_relation]
    style = f"text-align:center;background:{FILE_PALETTE[ground]};color:{FILE_PALETTE[letter]}"
    return Markup('<td style="{}" title="{}">{}</td>').format(style, SAID[the_relation], sign)


def _cell(value: object) -> Markup:
    if isinstance(value, Markup) and value.startswith("<td"):
        return value
    return Markup('<td style="text-align:left">{}</td>').format(value)
