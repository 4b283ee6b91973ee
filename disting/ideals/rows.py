"""A damped row of masses with its receptance, as what a part of a chain or a whole chain without a
gap is.

A row has a wall at its left end or none; its right end is free. With ports a <= b, the names of
`system` and, for the joints between the ports, h_i = u_i/e_i:

    H = G s^-2w N/D,   N = prod_(a <= i < b) (s + h_i) theta_(a-1) phi_(b+1),   G = g prod_(a <= i
    < b) e_i

with w = 0 at a wall and 1 without one (then the determinant is s^2 D). N, theta, phi and D are
monic. The gain g is in G only, so the closure of all H is the product of a line and the closure of
Psi = (N, D): rows of equal kind are the same exactly if their maps Psi have the same closure.
Where e_i of a joint between the ports is zero, N has a smaller degree; no such row has the
receptance of one where none is.
"""

from dataclasses import dataclass
from functools import cache, reduce
from operator import mul

from flint import fmpz_mpoly

from disting.algebra.symbols import symbols
from disting.ideals.system import CoefficientMap, minors, separated
from disting.model.structure import Structure


@dataclass(frozen=True, slots=True, order=True)
class DampedRow:
    """A damped row: whether the wall is at its left end, its number of masses, and its two
    ports, counted from 1.
    """

    wall: bool
    masses: int
    ports: tuple[int, int]

    def __str__(self) -> str:
        return (
            f"{self.masses} masses {'at a wall' if self.wall else 'free'}, ports {self.ports[0]}"
            f" and {self.ports[1]}"
        )


@dataclass(frozen=True)
class RowMap:
    """Psi in factors: parameters, the h_i in order, and the coefficients of theta, phi and D
    without their leading ones.
    """

    parameters: tuple[str, ...]
    heads: tuple[str, ...]
    left: tuple[fmpz_mpoly, ...]
    right: tuple[fmpz_mpoly, ...]
    poles: tuple[fmpz_mpoly, ...]
    whole: CoefficientMap


def canonical_row(wall: bool, masses: int, ports: tuple[int, int]) -> DampedRow:
    """The row, ports in order; of a free row and its mirror image the smaller one.

    >>> str(canonical_row(False, 5, (5, 3)))
    '5 masses free, ports 1 and 3'
    """
    a, b = sorted(ports)
    return DampedRow(
        wall, masses, (a, b) if wall else min((a, b), (masses + 1 - b, masses + 1 - a))
    )


def rows_of(structure: Structure) -> tuple[DampedRow, ...]:
    """The rows of a plain damped chain that have ports, the grounded one first."""
    p, found = structure.ports, list[DampedRow]()
    for first, last in structure.row_ends:
        for pair in ((p.act_minus, p.meas_minus), (p.act_plus, p.meas_plus)):
            if all(first <= port <= last for port in pair):
                wall = any(e.kind == "k" and e.at == first - 1 for e in structure.elements)
                found.append(
                    canonical_row(
                        wall, last - first + 1, (pair[0] - first + 1, pair[1] - first + 1)
                    )
                )
    return tuple(found)


@cache
def row_map(row: DampedRow) -> RowMap:
    """Psi of a row.

    >>> m = row_map(DampedRow(True, 2, (1, 2)))
    >>> m.parameters, [str(c) for c in m.right], len(m.poles)
    (('u0', 'e0', 'h1', 'e1', 'r1'), [], 4)
    """
    (a, b), n = row.ports, row.masses
    joints = range(0 if row.wall else 1, n)
    names = tuple(
        x
        for i in joints
        for x in (f"{'h' if a <= i < b else 'u'}{i}", f"e{i}", f"r{i}")[: 3 if i else 2]
    )
    ring = symbols(["s", *names])
    s, zero, one = ring["s"], ring["s"] - ring["s"], ring["s"] ** 0
    joint = {
        i: ring[f"e{i}"] * (s + ring[f"h{i}"]) if a <= i < b else ring[f"u{i}"] + ring[f"e{i}"] * s
        for i in joints
    }
    joint = {0: zero, n: zero} | joint
    ratio = {i: ring.get(f"r{i}", one) for i in range(n)}
    diagonal = [s * s + joint[i - 1] * ratio[i - 1] + joint[i] for i in range(1, n + 1)]
    squares = [joint[i] * joint[i] * ratio[i] for i in range(1, n)]
    leading, trailing = minors(diagonal, squares, one), minors(diagonal[::-1], squares[::-1], one)
    left, right, poles = (
        leading[a - 1],
        trailing[n - b],
        leading[n] if row.wall else leading[n] // s**2,
    )
    heads = tuple(f"h{i}" for i in range(a, b))
    zeros = reduce(mul, (s + ring[h] for h in heads), left * right)
    sides = [separated(names, p, one).numerator[:-1] for p in (left, right, poles)]
    return RowMap(names, heads, sides[0], sides[1], sides[2], separated(names, zeros, poles))
