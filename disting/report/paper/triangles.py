"""Verdicts as triangles of fields, any number of them side by side, as in Figs. 10, 11, 13 and
14.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations

from disting.catalogs import Catalog
from disting.catalogs.dampers import DamperTable, spelled
from disting.report.fields import (
    CORNERS,
    LETTERS,
    corner,
    field,
    legend,
    legend_entry,
    legend_width,
)
from disting.report.scene import Anchor, Ink, Layer, Scene, Text
from disting.report.words import sign
from disting.verdict import Decisions, Relation, View

MARGIN = 16.0
HEAD = 26.0  # a panel's title
FOOT = 34.0  # the legend, in one row
LEAST = 250.0  # width of a figure
LINE = 24.0  # a row of the legend, where it needs more


@dataclass(frozen=True, slots=True)
class Panel:
    """Names of the models; relation and sign of each pair i < j, counted from 0."""

    title: str
    names: tuple[str, ...]
    fields: dict[tuple[int, int], tuple[Relation, str]]


def of_decisions(title: str, found: Decisions, names: Sequence[str] = ()) -> Panel:
    """Every pair of a list of models; the sign is the condition's number."""
    pairs = combinations(range(len(found.subjects)), 2)
    fields = {(i, j): (found.relation(i, j), sign(found.rule(i, j))) for i, j in pairs}
    return Panel(title, tuple(names or (s.name for s in found.subjects)), fields)


def of_catalog(title: str, catalog: Catalog, view: View) -> Panel:
    """Every pair of a catalogue in one view."""
    names = tuple(f"A{number}" for number in range(1, len(catalog.family) + 1))
    return Panel(
        title,
        names,
        {(i - 1, j - 1): (v.relation, sign(v.decided_by)) for i, j, v in catalog.pairs(view)},
    )


def of_dampers(title: str, table: DamperTable) -> Panel:
    """Every pair of sets of ground dampers."""
    return of_decisions(title, table.decided, tuple(map(spelled, table.sets)))


def triangles(title: str, panels: Sequence[Panel], columns: int, cell: float) -> Scene:
    """The panels row after row, and the legend of the relations that occur."""
    side = max(len(panel.names) for panel in panels) * cell
    width, height = side + 3.2 * cell, side + HEAD + 0.6 * cell
    layers: list[Layer] = []
    for place, panel in enumerate(panels):
        row, column = divmod(place, columns)
        layers += _panel(panel, MARGIN + 2.0 * cell + column * width, 8 + HEAD + row * height, cell)
    rows = -(-len(panels) // columns)
    occurring = [
        r
        for r in Relation
        if any(r is relation for p in panels for relation, _ in p.fields.values())
    ]
    total = max(2 * MARGIN + min(columns, len(panels)) * width, LEAST)
    foot = 8 + rows * height + FOOT / 2
    if sum(map(legend_width, occurring)) < total + LINE:
        layers += legend(occurring, MARGIN, foot)
    else:
        layers += (
            legend_entry(relation, MARGIN, foot + i * LINE) for i, relation in enumerate(occurring)
        )
        foot += (len(occurring) - 1) * LINE
    return Scene(total, foot + FOOT / 2 + 4, tuple(layers), title)


def _panel(panel: Panel, x: float, y: float, cell: float) -> Iterator[Layer]:
    places = {(i, j): (x + i * cell, y + j * cell) for i, j in panel.fields}
    by_relation = sorted(panel.fields.items(), key=lambda item: list(Relation).index(item[1][0]))
    marked = [
        (places[pair], relation) for pair, (relation, _) in by_relation if relation in CORNERS
    ]
    signs = [(places[pair], relation, mark) for pair, (relation, mark) in by_relation if mark]
    half = (cell - 1) / 2
    yield Layer("title", (Text(x, y - 4, panel.title, 13, anchor=Anchor.START, bold=True),))
    yield Layer("names", tuple(_names(panel.names, x, y, cell)))
    yield Layer(
        "fields",
        tuple(
            s for pair, (relation, _) in by_relation for s in field(*places[pair], relation, cell)
        ),
    )
    yield Layer("corners", tuple(corner(*place, relation, cell) for place, relation in marked))
    yield Layer(
        "signs",
        tuple(
            Text(a + half, b + half, mark, 0.62 * cell, LETTERS[relation])
            for (a, b), relation, mark in signs
        ),
    )


def _names(names: Sequence[str], x: float, y: float, cell: float) -> Iterator[Text]:
    """Each name at the left of its row and on the diagonal, on top of its column."""
    size = min(11.0, 0.62 * cell)
    for i, name in enumerate(names):
        middle = y + (i + 0.5) * cell
        if i:
            yield Text(x - 5, middle, name, size, Ink.MUTED, Anchor.END)
        yield Text(x + i * cell + 3, middle, name, size, Ink.MUTED, Anchor.START)
