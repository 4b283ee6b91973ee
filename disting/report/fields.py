"""What a field of a verdict matrix looks like in every figure.

Relations differ in colour and in shape: distinguishable is a plain field, indistinguishable has a
dark upper corner, what depends on the parameters a dark lower one, undecided is crossed out and
has no sign.
"""

from collections.abc import Iterable, Iterator

from disting.report.scene import Anchor, Ink, Layer, Path, Rect, Shape, Text
from disting.verdict import Relation

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
    said = Text(x + 24 * k, y, SAID[relation], 12 * k, anchor=Anchor.START)
    return Layer(
        f"legend-{relation}", (*field(x, y - side / 2, relation, side), *dark, *sign, said)
    )
