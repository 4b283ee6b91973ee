"""The figures of the paper from our own data, in its order; verdicts as triangles of fields, any
number of them side by side, as in Figs. 10, 11, 13 and 14.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations

from disting.catalogs import Catalog
from disting.catalogs.dampers import DamperTable, spell
from disting.fit.judge.modes import physical
from disting.model.family import Family
from disting.paper import Findings
from disting.report.fit import bode, models_by_threshold, parameters_by_threshold
from disting.report.matrix import (
    CORNERS,
    LETTERS,
    corner,
    field,
    legend,
    legend_entry,
    legend_width,
)
from disting.report.paper.picture import Picture, of_plot, of_scene
from disting.report.paper.refit import refit_figure
from disting.report.scene import Anchor, Ink, Layer, Scene, Text
from disting.report.words import sign
from disting.verdict.decisions import Decisions
from disting.verdict.query import View
from disting.verdict.result import Relation

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


def of_decisions(title: str, decisions: Decisions, names: Sequence[str] = ()) -> Panel:
    """Every pair of a list of models; the sign is the condition's number."""
    pairs = combinations(range(len(decisions.subjects)), 2)
    fields = {(i, j): (decisions.relation(i, j), sign(decisions.rule(i, j))) for i, j in pairs}
    return Panel(title, tuple(names or (s.name for s in decisions.subjects)), fields)


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
    return of_decisions(title, table.decided, tuple(map(spell, table.sets)))


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


SECOND_BED = (
    "The paper draws one figure for each of its two test beds, whose data are not published; here"
    " it is the simulated demonstration drive."
)


def paper_figures(findings: Findings) -> tuple[Picture, ...]:
    """All figures that can be drawn: 3 to 8, 10 to 14."""
    return (
        *_of_the_fit(findings),
        *_of_verdicts(findings),
        _figure_12(findings),
        *_of_larger_sets(findings),
    )


def _of_the_fit(findings: Findings) -> Iterator[Picture]:
    selection = findings.selection
    candidate, fitted = selection.described, len(selection.candidates)
    plot = bode(
        candidate,
        selection.task,
        physical(candidate, selection.task),
        findings.train,
        findings.test,
    )
    yield of_plot(
        "figures-3-4",
        "Figs. 3 and 4",
        f"Measured responses and the best of {fitted} models, with asymptotes. {SECOND_BED}",
        plot,
    )
    yield of_plot(
        "figures-5-6",
        "Figs. 5 and 6",
        "Number of parameters of the best model when one criterion is applied alone, by its"
        " threshold; dashed: in use.",
        parameters_by_threshold(selection.candidates, selection.thresholds),
    )
    yield of_plot(
        "figures-7-8",
        "Figs. 7 and 8",
        f"Number of models that fulfil one criterion alone, out of all {fitted}, by its threshold.",
        models_by_threshold(selection.candidates, selection.thresholds),
    )


def _of_verdicts(findings: Findings) -> Iterator[Picture]:
    for name, damped, count, without in (
        ("figure-10", False, 8, "without damping"),
        ("figure-11", True, 7, "with damping"),
    ):
        panels = (
            of_decisions("Transfer function", findings.picture(3, damped, View.TF)),
            of_decisions(
                f"{count} Markov parameters", findings.picture(3, damped, View.MARKOV, count)
            ),
        )
        printed = f"Fig. {name.removeprefix('figure-')}"
        caption = (
            f"The eleven 3-mass models {without}, by conditions 1 to 7; a field shows the condition"
            " that decides."
        )
        title = f"{printed}: {caption}"
        yield of_scene(
            name,
            printed,
            caption,
            triangles(title, panels, 2, 24.0),
            triangles(title, panels, 1, 24.0),
        )


def _figure_12(findings: Findings) -> Picture:
    caption = (
        "A4 fitted to the exact response of a damped A1: resonances and antiresonances agree, the"
        " four damping ratios cannot. Without damping the two models are indistinguishable."
    )
    return of_plot("figure-12", "Fig. 12", caption, refit_figure(findings.refit))


def _of_larger_sets(findings: Findings) -> Iterator[Picture]:
    caption = "The 29 4-mass models without damping, by conditions 1 to 9 on both representations."
    panel = of_catalog(
        "Transfer function and Markov parameters", findings.catalog(4, damped=False), View.COMBINED
    )
    yield of_scene(
        "figure-13", "Fig. 13", caption, triangles(f"Fig. 13: {caption}", (panel,), 1, 20.0)
    )
    caption = (
        "For each of the eleven damped 3-mass models: no damper to the base (0) or one at mass 1, 2"
        " or 3, against each other. E: decided exactly, where conditions 1 to 9 leave the pair"
        " open."
    )
    family = enumerate(Family(3, damped=True), 1)
    panels = tuple(of_dampers(f"A{number}", findings.dampers(chain)) for number, chain in family)
    title = f"Fig. 14: {caption}"
    yield of_scene(
        "figure-14",
        "Fig. 14",
        caption,
        triangles(title, panels, 4, 30.0),
        triangles(title, panels, 2, 26.0),
    )
