"""The verdicts of a family as a triangle of fields, as in Figs. 10, 11 and 13 of the paper, and as
a thumbnail.

Row and column of a field are the two models; the number is the condition that decided. How a field
shows its relation is told in `disting.report.fields`.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import groupby

from disting.catalogs import Catalog
from disting.report.fields import CORNERS, FILLS, LETTERS, corner, field, legend
from disting.report.png import png
from disting.report.scene import Anchor, Ink, Layer, Path, Rect, Scene, Text
from disting.report.svg import svg
from disting.report.words import VIEW_TITLES, headline, sign, title
from disting.verdict import Relation, View

TOP = 88.0  # room for the figure's and the panels' titles, at letter size 1
MARGIN = 16.0
WIDEST_PNG = 5200  # pixels


@dataclass(frozen=True, slots=True)
class Grid:
    """One panel: whose verdicts, and where the square of its fields begins."""

    catalog: Catalog
    view: View
    x: float
    y: float
    cell: float

    @property
    def pairs(self) -> Iterator[tuple[int, int]]:
        """(column, row) of every field, row after row."""
        return (
            (low, high) for high in range(2, len(self.catalog.family) + 1) for low in range(1, high)
        )

    def at(self, low: int, high: int) -> tuple[float, float]:
        """Upper left corner of a field."""
        return self.x + (low - 1) * self.cell, self.y + (high - 1) * self.cell


def matrix_svg(catalog: Catalog) -> str:
    """The triangles as a stand-alone SVG."""
    return svg(figure(catalog))


def matrix_png(catalog: Catalog) -> bytes:
    """The triangles as a PNG of at most 5200 pixels width."""
    return figure_png(figure(catalog))


def figure_png(scene: Scene) -> bytes:
    """A figure as a PNG of at most 5200 pixels width."""
    return png(scene, scale=min(2.0, WIDEST_PNG / scene.width), oversample=2)


def figure(catalog: Catalog) -> Scene:
    """Every view, side by side, with a legend."""
    size = len(catalog.family)
    cell, k = _cell(size), 1.6 if size > 30 else 1.0
    top, left = TOP * k, MARGIN + 2.2 * cell
    panel = max(size * cell, 150.0) + 3 * cell
    panels = (
        _panel(Grid(catalog=catalog, view=view, x=left + i * panel, y=top, cell=cell), k)
        for i, view in enumerate(VIEW_TITLES)
    )
    foot = top + size * cell + 26 * k
    width = max(len(VIEW_TITLES) * panel + left - cell, 620.0)
    layers = (
        _head(catalog, k),
        *(layer for layers in panels for layer in layers),
        *legend(Relation, MARGIN, foot, k),
    )
    return Scene(width, foot + 26 * k, layers, f"{title(catalog)}: {headline(catalog)}")


def thumbnail(catalog: Catalog, side: float = 168) -> Scene:
    """The combined triangle without numbers, `side` pixels wide: a blue staircase with the
    other fields on it.
    """
    size = len(catalog.family)
    cell = side / max(size - 1, 1)
    steps = [(x * cell, y * cell) for i in range(size - 1) for x, y in ((i, i), (i + 1, i))]
    stairs = Path((*steps, (side, side), (0, side)), Ink.NONE, Ink.DISTINGUISHABLE)
    runs = (run for high in range(2, size + 1) for run in _runs(catalog, high, cell))
    layers = (
        Layer("distinguishable", (stairs,)),
        Layer("others", tuple(sorted(runs, key=lambda run: run.fill))),
    )
    return Scene(side, side, layers, f"{title(catalog)}: {headline(catalog)}")


def _cell(size: int) -> float:
    """Side of a field: the smaller, the more there are."""
    return 24.0 if size <= 11 else 17.0 if size <= 30 else 12.0


def _head(catalog: Catalog, k: float) -> Layer:
    name = Text(MARGIN, 20 * k, title(catalog), 16 * k, anchor=Anchor.START, bold=True)
    return Layer(
        "head", (name, Text(MARGIN, 41 * k, headline(catalog), 12 * k, Ink.MUTED, Anchor.START))
    )


def _panel(grid: Grid, k: float) -> Iterator[Layer]:
    view, pairs = grid.view, list(grid.pairs)
    relations = {pair: grid.catalog.relation(*pair, view) for pair in pairs}
    # equal style in a row: a smaller file
    grouped = sorted(pairs, key=lambda pair: list(Relation).index(relations[pair]))
    marked = [pair for pair in grouped if relations[pair] in CORNERS]
    numbers = sorted((_number(grid, pair) for pair in pairs), key=lambda text: text.fill)
    yield Layer(
        f"{view}-title",
        (Text(grid.x, grid.y - 14 * k, VIEW_TITLES[view], 13 * k, anchor=Anchor.START, bold=True),),
    )
    yield Layer(f"{view}-labels", tuple(_labels(grid)))
    yield Layer(
        f"{view}-fields",
        tuple(s for pair in grouped for s in field(*grid.at(*pair), relations[pair], grid.cell)),
    )
    yield Layer(
        f"{view}-corners",
        tuple(corner(*grid.at(*pair), relations[pair], grid.cell) for pair in marked),
    )
    yield Layer(f"{view}-numbers", tuple(text for text in numbers if text.text))


def _labels(grid: Grid) -> Iterator[Text]:
    """Each model's name at the left of its row and on the diagonal, on top of its column."""
    letters = min(11.0, 0.62 * grid.cell)
    for model in range(1, len(grid.catalog.family) + 1):
        x, y = grid.at(model, model)
        middle = y + grid.cell / 2
        if model > 1:
            yield Text(grid.x - 5, middle, f"A{model}", letters, Ink.MUTED, Anchor.END)
        yield Text(x + 3, middle, f"A{model}", letters, Ink.MUTED, Anchor.START)


def _number(grid: Grid, pair: tuple[int, int]) -> Text:
    verdict = grid.catalog.verdict(*pair, grid.view)
    x, y = grid.at(*pair)
    half = (grid.cell - 1) / 2
    return Text(
        x + half,
        y + half,
        sign(verdict.decided_by),
        0.62 * grid.cell,
        LETTERS.get(verdict.relation, Ink.LINE),
    )


def _runs(catalog: Catalog, high: int, cell: float) -> Iterator[Rect]:
    """Neighbours of one relation in a row, as one rectangle; the distinguishable ones are left
    out.
    """
    for relation, run in groupby(range(1, high), key=lambda low: catalog.relation(low, high)):
        lows = list(run)
        if relation is not Relation.DISTINGUISHABLE:
            fill = FILLS.get(relation, Ink.OPEN)
            yield Rect((lows[0] - 1) * cell, (high - 2) * cell, len(lows) * cell, cell, fill)
