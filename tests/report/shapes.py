"""Whether two shapes of a drawing meet."""

from itertools import pairwise

from disting.report.scene import Ink, Path, Shape, Text, extent

Box = tuple[float, float, float, float]


def meet(one: Shape, other: Shape) -> bool:
    """Whether the boxes of two shapes, lines with their width, have a point in common; of a line
    of several pieces, that of any piece.
    """
    return any(
        left < c and a < right and top < d and b < bottom
        for left, top, right, bottom in boxes(one)
        for a, b, c, d in boxes(other)
    )


def boxes(shape: Shape) -> list[Box]:
    """Boxes around the ink of a shape."""
    if isinstance(shape, Text):
        return [extent(shape)]
    half = shape.line / 2 if shape.stroke is not Ink.NONE else 0.0
    pieces: list[Shape] = [shape]
    if isinstance(shape, Path) and shape.fill is Ink.NONE:
        pieces = [Path(ends) for ends in pairwise(shape.points)]
    return [(a - half, b - half, c + half, d + half) for a, b, c, d in (extent(p) for p in pieces)]
