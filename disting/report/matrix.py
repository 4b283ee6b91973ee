"""The verdicts of a family as a triangle of fields, as in Figs. 10, 11 and 13 of the paper, one
view a slide.

Row and column of a field are the two models; the number is the condition that decided. Relations
differ in colour and in shape, here as in every figure: distinguishable is a plain field,
indistinguishable has a dark upper corner, what depends on the parameters a dark lower one,
undecided is crossed out and has no sign.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from disting.catalogs import Catalog
from disting.conditions.rule import RULES
from disting.report.png import png
from disting.report.scene import Anchor, Ink, Layer, Path, Rect, Scene, Shape, Text, svg
from disting.report.words import VIEW_TITLES, headline, title, totals
from disting.verdict.result import Relation, View

FILLS = {
    Relation.DISTINGUISHABLE: Ink.DISTINGUISHABLE,
    Relation.INDISTINGUISHABLE: Ink.INDISTINGUISHABLE,
    Relation.SOMETIMES: Ink.SOMETIMES,
}
LETTERS = {
    Relation.DISTINGUISHABLE: Ink.ON_DISTINGUISHABLE,
    Relation.INDISTINGUISHABLE: Ink.ON_INDISTINGUISHABLE,
    Relation.SOMETIMES: Ink.ON_SOMETIMES,
}
CORNERS = {Relation.INDISTINGUISHABLE: True, Relation.SOMETIMES: False}  # upper right, lower left
SAID = {relation: f"{relation} by condition n" for relation in FILLS} | {
    Relation.SOMETIMES: "for some parameters only",
    Relation.UNDECIDED: "undecided",
}
BOX = 17.0  # side of a field of the legend
LETTER = 6.6  # width of a letter of the legend


def field(x: float, y: float, relation: Relation, cell: float) -> tuple[Shape, ...]:
    """The field with its upper left corner at (x, y), in a raster of `cell`."""
    side = cell - 1
    if relation is not Relation.UNDECIDED:
        return (Rect(x, y, side, side, FILLS[relation]),)
    inset = 0.3 * cell
    cross = Path(
        ((x + inset, y + side - inset), (x + side - inset, y + inset)), Ink.UNDECIDED, line=1
    )
    return Rect(x + 0.5, y + 0.5, side - 1, side - 1, Ink.NONE, Ink.UNDECIDED, line=1), cross


def corner(x: float, y: float, relation: Relation, cell: float) -> Path:
    """The dark corner of a field, upper right or lower left."""
    far, leg = cell - 1, 0.28 * cell
    shape = (
        ((far - leg, 0.0), (far, 0.0), (far, leg))
        if CORNERS[relation]
        else ((0.0, far - leg), (0.0, far), (leg, far))
    )
    return Path(tuple((x + dx, y + dy) for dx, dy in shape), Ink.NONE, LETTERS[relation])


def legend(relations: Iterable[Relation], x: float, y: float, k: float = 1.0) -> Iterator[Layer]:
    """A field of each relation with its name, in a row from x on, its middle at y, `k` times
    the usual size.
    """
    for relation in relations:
        yield legend_entry(relation, x, y, k)
        x += legend_width(relation, k)


def legend_width(relation: Relation, k: float = 1.0) -> float:
    """Room that an entry of the legend takes."""
    return (46 + LETTER * len(SAID[relation])) * k


def legend_entry(relation: Relation, x: float, y: float, k: float = 1.0) -> Layer:
    """A field of the relation at x, its middle at y, and its name."""
    side = BOX * k
    dark = (corner(x, y - side / 2, relation, side),) if relation in CORNERS else ()
    sign = (Text(x + side / 2, y, "n", 10.5 * k, LETTERS[relation]),) if relation in LETTERS else ()
    label = Text(x + 24 * k, y, SAID[relation], 12 * k, anchor=Anchor.START)
    return Layer(
        f"legend-{relation}", (*field(x, y - side / 2, relation, side), *dark, *sign, label)
    )


TOP = 88.0  # room for the figure's and the panels' titles, at letter size 1
MARGIN = 16.0
WIDEST_PNG = 5200  # pixels
SLIDE = (1920.0, 1080.0)  # of a projector; wider figures have a slide for each view too
SLIDE_MARGIN = 24.0
NAMES = 11.0  # largest size of the names of the models


@dataclass(frozen=True, slots=True)
class Grid:
    """One panel: whose verdicts, and where the square of its fields begins."""

    catalog: Catalog
    view: View
    x: float
    y: float
    cell: float
    letters: float

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
    """The triangles as a stand-alone SVG.

    >>> from disting import catalog
    >>> matrix_svg(catalog(2, damped=True))[:4]
    '<svg'
    """
    return svg(figure(catalog))


def matrix_png(catalog: Catalog) -> bytes:
    """The triangles as a PNG of at most 5200 pixels width.

    >>> from disting import catalog
    >>> matrix_png(catalog(2, damped=True))[1:4]
    b'PNG'
    """
    return figure_png(figure(catalog))


def figure_png(scene: Scene) -> bytes:
    """A figure as a PNG of at most 5200 pixels width."""
    return png(scene, scale=min(2.0, WIDEST_PNG / scene.width), oversample=2)


def figure(catalog: Catalog) -> Scene:
    """Every view, side by side, with a legend."""
    size = len(catalog.family)
    cell, k = _cell(size), 1.6 if size > 30 else 1.0
    top, left = TOP * k, MARGIN + 2.2 * cell
    panel = _panel_width(size)
    panels = (
        _panel(Grid(catalog, view, left + i * panel, top, cell, min(NAMES, 0.62 * cell)), k)
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


def has_slides(catalog: Catalog) -> bool:
    """Return True if the figure of all views is too wide for a slide."""
    return len(VIEW_TITLES) * _panel_width(len(catalog.family)) > SLIDE[0]


def slide_name(catalog: Catalog, view: View) -> str:
    """Name of the file of a slide.

    >>> from disting.catalogs import catalog
    >>> slide_name(catalog(5, damped=False), View.POSITIVE)
    'chains-5-undamped-matrix-positive.png'
    """
    return f"{catalog.name}-matrix-{view}.png"


def slide(catalog: Catalog, view: View) -> Scene:
    """One view in the size of a projector's picture, names and signs as large as the fields allow;
    title, numbers of pairs and legend are in the empty corner.
    """
    size, (width, height) = len(catalog.family), SLIDE
    cell = min((height - 2 * SLIDE_MARGIN) / size, 40.0)
    letters = min(0.9 * cell, 22.0)
    left = SLIDE_MARGIN + 0.62 * letters * len(f"A{size}") + 6
    grid = Grid(catalog, view, left, SLIDE_MARGIN, cell, letters)
    counted = totals(catalog, view)
    aside, rows = left + 0.55 * size * cell, [r for r in Relation if counted.get(r)]
    label = (
        Text(aside, 60, title(catalog), 38, anchor=Anchor.START, bold=True),
        Text(aside, 112, VIEW_TITLES[view], 30, anchor=Anchor.START),
        *(
            Text(aside + 680, 176 + 46 * k, f"{counted[r]:,} pairs", 24, anchor=Anchor.END)
            for k, r in enumerate(rows)
        ),
    )
    legends = (legend_entry(r, aside, 176 + 46 * k, 2.0) for k, r in enumerate(rows))
    head = f"{title(catalog)}, {VIEW_TITLES[view].lower()}"
    return Scene(width, height, (Layer("head", label), *_fields(grid), *legends), head)


def slide_png(catalog: Catalog, view: View) -> bytes:
    """A slide as a PNG of its size."""
    return png(slide(catalog, view), scale=1, oversample=2, colours=64)


def _cell(size: int) -> float:
    """Side of a field: the smaller, the more there are."""
    return 24.0 if size <= 11 else 17.0 if size <= 30 else 12.0


def _panel_width(size: int) -> float:
    return max(size * _cell(size), 150.0) + 3 * _cell(size)


def _head(catalog: Catalog, k: float) -> Layer:
    name = Text(MARGIN, 20 * k, title(catalog), 16 * k, anchor=Anchor.START, bold=True)
    return Layer(
        "head", (name, Text(MARGIN, 41 * k, headline(catalog), 12 * k, Ink.MUTED, Anchor.START))
    )


def _panel(grid: Grid, k: float) -> Iterator[Layer]:
    name = Text(
        grid.x, grid.y - 14 * k, VIEW_TITLES[grid.view], 13 * k, anchor=Anchor.START, bold=True
    )
    yield Layer(f"{grid.view}-title", (name,))
    yield from _fields(grid)


def _fields(grid: Grid) -> Iterator[Layer]:
    view, pairs = grid.view, list(grid.pairs)
    relations = {pair: grid.catalog.relation(*pair, view) for pair in pairs}
    # equal style in a row: a smaller file
    grouped = sorted(pairs, key=lambda pair: list(Relation).index(relations[pair]))
    marked = [pair for pair in grouped if relations[pair] in CORNERS]
    numbers = sorted((_number(grid, pair) for pair in pairs), key=lambda text: text.fill)
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
    for model in range(1, len(grid.catalog.family) + 1):
        x, y = grid.at(model, model)
        middle = y + grid.cell / 2
        if model > 1:
            yield Text(grid.x - 5, middle, f"A{model}", grid.letters, Ink.MUTED, Anchor.END)
        yield Text(x + 3, middle, f"A{model}", grid.letters, Ink.MUTED, Anchor.START)


def _number(grid: Grid, pair: tuple[int, int]) -> Text:
    verdict = grid.catalog.verdict(*pair, grid.view)
    x, y = grid.at(*pair)
    half = (grid.cell - 1) / 2
    return Text(
        x + half,
        y + half,
        sign(verdict.decided_by),
        max(grid.letters, 0.62 * grid.cell),
        LETTERS.get(verdict.relation, Ink.LINE),
    )


def sign(decided_by: str) -> str:
    """Sign in a field of a matrix, empty for an undecided pair.

    >>> sign("4"), sign("exact"), sign("")
    ('4', 'E', '')
    """
    return RULES[decided_by].sign if decided_by else ""
