"""Polynomials on closed boxes of [0, oo]^n, n = 1 or 2: boxes where inequalities are found to fail
or to hold, and roots.

A polynomial f of degree at most d in x is taken as homogeneous, x = x0/x1, so that x = oo is a
point like others, and a box is the image of [0, oo]. If all coefficients are >= 0 and those at the
corners > 0, f is positive on the whole closed box; the same for negative. Halving: x = u/(1 + u)
is the part up to 1, x = 1 + u the part from 1.

A statement on one polynomial on a closed box stays true if its coefficients move a little, as the
box is compact.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import comb

Grid = list[list[int]]
"""Coefficients of x^i y^j: as many rows and columns for a given polynomial in all boxes."""

Ends = tuple[tuple[int, int], tuple[int, int]]
"""Numerators and denominators of both ends on one axis."""

BOXES = 3000
DEPTH = 24  # halvings of one axis
NARROW = 12  # halvings before a root is named


@dataclass(frozen=True, slots=True)
class Box:
    """Polynomials in the coordinates of the box, and its ends by axis: two points (numerator,
    denominator) each.
    """

    equations: tuple[Grid, ...]
    positive: tuple[Grid, ...]
    nonzero: tuple[Grid, ...] = ()
    ends: tuple[Ends, ...] = (((0, 1), (1, 0)), ((0, 1), (1, 0)))
    depth: tuple[int, int] = (0, 0)


def sign_on(grid: Grid) -> int:
    """1 or -1 if the polynomial has this sign on the whole closed box as its coefficients show
    it, else 0.
    """
    corners = {grid[i][j] for i in (0, -1) for j in (0, -1)}
    entries = [c for row in grid for c in row]
    if min(corners) > 0 and min(entries) >= 0:
        return 1
    return -1 if max(corners) < 0 and max(entries) <= 0 else 0


def is_empty(start: Box, axes: int) -> bool:
    """Return True if no point of the closed box solves all equations with all inequalities >= 0;
    False also where that is not found.
    """
    todo, n_boxes = [start], 0
    while todo:
        box, n_boxes = todo.pop(), n_boxes + 1
        if any(map(sign_on, box.equations)) or any(sign_on(g) < 0 for g in box.positive):
            continue
        if n_boxes > BOXES or min(box.depth[:axes]) >= DEPTH:
            return False
        todo += halves(box, axes)
    return True


def over_sum(grid: Grid, degree: int) -> Grid:
    """(1 + w)^degree times a polynomial of x, y > 0 of at most this total degree, in the axes r = x
    + y and w = x/y: x = r w/(1 + w), y = r/(1 + w).

    Where x and y are both infinite all terms of that degree count then; in x and y only that of the
    largest powers of both, which may be missing.

    >>> over_sum([[1, -3, 1], [-3, 2, 0], [1, 0, 0]], 2)  # 1 - 3 r + r^2
    [[1, 2, 1], [-3, -6, -3], [1, 2, 1]]
    """
    table = [[0] * (degree + 1) for _ in range(degree + 1)]
    for i, row in enumerate(grid):
        for j, c in enumerate(row[: max(degree - i + 1, 0)]):
            for k in range(degree - i - j + 1):
                table[i + j][i + k] += c * comb(degree - i - j, k)
    return table


def root(start: Box) -> tuple[Fraction, Fraction] | None:
    """An interval on which all inequalities hold and no `nonzero` polynomial vanishes, if one is
    found.

    With one equation also one at whose ends the equation has opposite signs.
    """
    todo, n_boxes = [start], 0
    while todo and n_boxes < BOXES:
        box, n_boxes = todo.pop(0), n_boxes + 1
        if any(map(sign_on, box.equations)) or any(sign_on(g) < 0 for g in box.positive):
            continue
        low, high = box.ends[0]
        if (
            low[1]
            and high[1]
            and _changes(box)
            and all(sign_on(g) > 0 for g in box.positive)
            and all(map(sign_on, box.nonzero))
        ):
            return Fraction(*low), Fraction(*high)
        if box.depth[0] < 2 * DEPTH:
            todo += halves(box, 1)
    return None


def _changes(box: Box) -> bool:
    """Return True if the box is narrow and the equation has opposite signs at its ends."""
    return not box.equations or (
        box.depth[0] >= NARROW and box.equations[0][0][0] * box.equations[0][-1][0] < 0
    )


def halves(box: Box, axes: int) -> Iterator[Box]:
    """Both halves across the axis that was halved least often."""
    axis = min(range(axes), key=lambda i: box.depth[i])
    depth = tuple(d + (i == axis) for i, d in enumerate(box.depth))
    low, high = box.ends[axis]
    middle = low[0] + high[0], low[1] + high[1]
    for upper, ends in ((False, (low, middle)), (True, (middle, high))):
        every = tuple(ends if i == axis else e for i, e in enumerate(box.ends))
        first, second, third = (
            tuple(_half(g, axis, upper) for g in side)
            for side in (box.equations, box.positive, box.nonzero)
        )
        yield Box(first, second, third, every, (depth[0], depth[1]))


def _half(grid: Grid, axis: int, upper: bool) -> Grid:
    lines = grid if axis else [list(line) for line in zip(*grid, strict=True)]
    halved = [_shift_by_one(line) if upper else _shift_by_one(line[::-1])[::-1] for line in lines]
    return halved if axis else [list(line) for line in zip(*halved, strict=True)]


def _shift_by_one(coefficients: Sequence[int]) -> list[int]:
    """Coefficients of f(1 + u)."""
    moved = list(coefficients)
    for i in range(len(moved)):
        for j in range(len(moved) - 2, i - 1, -1):
            moved[j] += moved[j + 1]
    return moved
