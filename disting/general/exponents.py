"""Exponents of constant phase elements that a function determines.

A function N/D in lowest terms is made of powers s^(i + j.n), i the power of s, j those of all s^n.
Let it be N'/D' with other exponents m as well, both n and m generic. Then N = s^c N', D = s^c D',
so the powers of N' and D' are those of N and D moved by c: there is an affine map T, one to one
from the powers (i', j') of N' to those of N, and of D' to those of D, with

    i = i' + b.j' + c0 ,   j = B j' + c1 ,   m = b + B^T n ,

b, B and c rational. Permutations of the exponents are such maps, the orders of `powers.orders`.
"""

from collections.abc import Sequence
from itertools import chain, permutations, product
from math import perm, prod

from flint import fmpq, fmpq_mat, fmpz_mat

from disting.general.powers import Cell, Powers

MOST_TRIED = 20_000  # images of a few powers
Parts = tuple[int, ...]
"""Powers of s and of every s^n."""


def count_determined(cells: Sequence[Cell], size: int) -> tuple[int, tuple[int, ...]]:
    """Count the combinations of exponents that the functions determine, and find the single ones.

    Only combinations c with c.e = const for all powers e of all s^n of both sides are not: a change
    along them is one of the unit of s, as ln s is no function of this kind.
    """
    rows = []
    for top, bottom in cells:
        first, *others = (parts[1:] for parts in (*top, *bottom))
        rows += [[a - b for a, b in zip(e, first, strict=True)] for e in others]
    rank = _rank(rows, size)
    unit = [[int(i == j) for i in range(size)] for j in range(size)]
    return rank, tuple(j for j in range(size) if _rank([*rows, unit[j]], size) == rank)


def _rank(rows: Sequence[Sequence[int]], size: int) -> int:
    return int(fmpz_mat(len(rows), size, [x for row in rows for x in row]).rank()) if rows else 0


def may_be_others(cells: Sequence[Cell], powers: Powers) -> bool:
    """Return True if other exponents between 0 and 1 than these, in another order, may give
    functions made of the same powers: False where no other map T remains; True for several
    functions, and where too many maps would have to be tried.
    """
    if len(cells) > 1:
        return True
    size = len(powers.weights)
    sides = sorted((frozenset(side) for side in cells[0]), key=len)
    the_pairs = _basis(sides, size)
    counts = [len(points) for points in the_pairs]
    if sum(counts) <= size or prod(map(perm, map(len, sides), counts)) > MOST_TRIED:
        return True
    points = [point for chosen in the_pairs for point in chosen]
    inverse = fmpq_mat(fmpz_mat([[1, *p[1:]] for p in points])).inv()
    ways = [permutations(sorted(side), n) for side, n in zip(sides, counts, strict=True)]
    for images in product(*ways):
        pairs = zip(points, chain(*images), strict=True)
        moved = fmpz_mat([[image[0] - p[0], *image[1:]] for p, image in pairs])
        change = inverse * fmpq_mat(moved)
        if all(_keeps(change, side) for side in sides) and _is_another(change, size, powers.step):
            return True
    return False


def _basis(sides: Sequence[frozenset[Parts]], size: int) -> list[list[Parts]]:
    """Of each side the powers that fix a map, as many as size + 1 together where they do."""
    rows, pairs = list[list[int]](), list[list[Parts]]()
    for side in sides:
        pairs.append([])
        for point in sorted(side):
            more = [*rows, [1, *point[1:]]]
            if fmpz_mat(more).rank() == len(more):
                rows = more
                pairs[-1].append(point)
    return pairs


def _keeps(change: fmpq_mat, side: frozenset[Parts]) -> bool:
    """Return True if (i, j) + (i', 0), with i' and the new j from the rows (c0, c1) and (b, B^T),
    remains in the side.
    """
    for first, *others in side:
        i, *j = (fmpq_mat(fmpz_mat([[1, *others]])) * change).entries()
        if (first + i, *j) not in side:
            return False
    return True


def _is_another(change: fmpq_mat, size: int, step: int) -> bool:
    """Return True if m = b + B^T n may lie between 0 and 1 and is not a permutation of n."""
    rows = [change.tolist()[r] for r in range(1, size + 1)]
    unit = [sorted(map(int, row[1:])) == [*[0] * (size - 1), 1] for row in rows]
    if all(row[0] == 0 and is_unit for row, is_unit in zip(rows, unit, strict=True)):
        return False
    low = [b / step + sum(min(x, fmpq(0)) for x in row) for b, *row in rows]
    high = [b / step + sum(max(x, fmpq(0)) for x in row) for b, *row in rows]
    return all(x < 1 for x in low) and all(x > 0 for x in high)
