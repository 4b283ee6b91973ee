"""Branches of a search in ball arithmetic: what a ball proves, and what the end of a branch can be.

A ball holds a number that is not known exactly. It proves that a number is not zero by leaving
zero out; it never proves that a number is zero. So a branch is killed by a ball, and never
accepted by one: a survivor is consistent, no more. Balls that hold zero but are wide prove nothing
either way and call for more bits.

The receptance of a row that is to be realised, as balls.
"""

import itertools
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from itertools import combinations
from typing import TypeVar

from flint import acb, acb_poly, arb, ctx, fmpq, fmpq_poly

from disting.model.row import Row

Ball = acb
Poly = acb_poly
Item = TypeVar("Item")

# widest relative radius of a test ball that may pass as "consistent with zero"
TOLERANCE = 2.0**-40
# absolute widths tried where an isolation is too coarse for Newton's method
_ISOLATION = (2.0**-30, 2.0**-90)

_ENCLOSED = 2.0**-40


class Imprecise(Exception):
    """A ball too wide to decide anything: work again with more bits."""


def vanishes(value: Ball, scale: Ball | arb) -> bool:
    """False: proven non-zero. True: consistent with zero to TOLERANCE relative to |scale|. Raises
    Imprecise in between.

    >>> vanishes(acb(1) - acb(1), acb(1)), vanishes(acb(2) ** -50, acb(1))
    (True, False)
    """
    if not value.contains(0):
        return False
    if not bool(value.abs_upper() <= arb(TOLERANCE) * scale.abs_upper()):
        raise Imprecise("a test ball is too wide")
    return True


def is_boundary(value: Ball) -> bool:
    """Return True if an element or a leading coefficient that must be nonzero cannot be separated
    from zero.
    """
    return bool(value.contains(0))


def poly(coefficients: Sequence[Ball | int]) -> Poly:
    """Polynomial from its coefficients, lowest first."""
    return acb_poly(list(coefficients))


def cut(p: Poly, degree: int) -> Poly:
    """p without the coefficients above `degree`, which are exactly zero by theory.

    >>> cut(poly([1, 2, 3]), 1).degree()
    1
    """
    return acb_poly([p[i] for i in range(degree + 1)])


def shift(p: Poly, power: int) -> Poly:
    """p times x**power; for a negative power the lowest coefficients, zero by theory, are
    dropped.
    """
    if power >= 0:
        return acb_poly([acb(0)] * power + p.coeffs())
    return acb_poly(p.coeffs()[-power:])


def product(roots: list[Ball]) -> Poly:
    """Monic polynomial with the given roots."""
    return acb_poly.from_roots(roots)


def roots(p: Poly, degree: int, excluded: Callable[[Ball], bool] = lambda z: False) -> list[Ball]:
    """Balls, each with exactly one root, as narrow as the coefficients allow; wide ones that are
    `excluded` stay wide.

    Raises Imprecise if the leading coefficient or the isolation is not sure: multiple roots look
    like that at any precision.
    """
    if degree == 0:
        return []
    if is_boundary(p[degree]):
        raise Imprecise("a leading coefficient cannot be distinguished from zero")
    if degree == 1:
        return [-p[0] / p[1]]
    isolated = _isolate_roots(p, None)
    if not isolated:
        raise Imprecise("roots could not be isolated")
    slope = p.derivative()

    def sharpened(wide: list[Ball]) -> list[Ball | None]:
        """Each that is needed sharp, as sharp as may be."""
        return [z if excluded(z) else _sharpen_root(p, slope, z) for z in wide]

    sharp = sharpened(isolated)
    for tolerance in _ISOLATION:
        finer = [] if all(z is not None for z in sharp) else _isolate_roots(p, tolerance)
        if not finer:
            break
        isolated, sharp = finer, sharpened(finer)
    return [z if better is None else better for z, better in zip(isolated, sharp, strict=True)]


def enclose(p: Poly, degree: int) -> list[Ball]:
    """Like `roots`, in a fraction of the time, but wide balls: enough to refute."""
    isolated = [] if is_boundary(p[degree]) else _isolate_roots(p, _ENCLOSED)
    if not isolated:
        raise Imprecise("roots could not be isolated")
    return isolated


def _isolate_roots(p: Poly, tolerance: float | None) -> list[Ball]:
    """Disjoint balls with one root each, no wider than the tolerance; nothing if that fails."""
    try:
        return list(p.roots(tol=tolerance))
    except ValueError:
        return []


def _sharpen_root(p: Poly, slope: Poly, z: Ball) -> Ball | None:
    """Newton's method on midpoints, then one interval Newton step on a small box inside z: a
    proof that the root is there.
    """
    mid, near = z.mid(), arb(2) ** (-ctx.prec // 2)
    for _ in range(int(ctx.prec).bit_length() + 1):
        change = p(mid) / slope(mid)
        mid = (mid - change).mid()
        if bool(change.abs_upper() <= near * mid.abs_upper()):
            break  # the next change is about the square of this one
    value = p(mid)
    error = 4 * (value / slope(mid)).abs_upper() + mid.abs_upper() * arb(2) ** (4 - ctx.prec)
    spread = arb(0, error.upper())
    box = mid + acb(spread, spread)
    steep = slope(box)
    step = mid - value / steep
    proven = not steep.contains(0) and z.contains(box) and box.contains(step)
    return step if proven else None


def splits(items: list[Item], size: int) -> Iterator[tuple[list[Item], list[Item]]]:
    """Every choice of `size` items, with the rest."""
    for chosen in combinations(range(len(items)), size):
        yield [items[i] for i in chosen], [z for i, z in enumerate(items) if i not in chosen]


@dataclass(frozen=True, slots=True)
class Receptance:
    """Numerator over monic denominator, in s, or in x = s^2 where there is no damper.

    `exact`: the numerator as fmpq_poly, if the coefficients of both are rational and known.
    """

    numerator: Poly
    denominator: Poly
    exact: fmpq_poly | None = None

    def gain(self, row: Row) -> Ball:
        """Leading coefficient of the numerator, in the row's own variable."""
        return self.numerator[row.numerator_degree]

    def own(self, row: Row, q: int) -> "Receptance":
        """In the row's own variable, from that of q: in x for a row without any damper."""
        if row.q == q:
            return self
        return Receptance(
            acb_poly(self.numerator.coeffs()[::2]), acb_poly(self.denominator.coeffs()[::2])
        )


class Reason(StrEnum):
    """Why a branch ends without a solution; only NONZERO is a proof that it holds none."""

    NONZERO = "a ball leaves out a zero that every solution has"
    BOUNDARY = "an element or leading coefficient cannot be distinguished from zero"
    OPEN = "this type of chain is not covered"


@dataclass(frozen=True, slots=True)
class Dead:
    """A branch without a solution."""

    reason: Reason


@dataclass(frozen=True, slots=True)
class RowValues:
    """Numbers for the masses and springs of a row, from the left, or of masses next to a port, from
    the port outwards; k(s) = c + d s (undamped: c). `gauges`: how many free choices were made.

    `dampers`: from each mass to the ground, 0 where there is none; empty where no mass has one.
    """

    masses: tuple[Ball, ...] = ()
    springs: tuple[Poly, ...] = ()
    gauges: int = 0
    dampers: tuple[Ball, ...] = ()

    @property
    def all_dampers(self) -> tuple[Ball, ...]:
        """One for every mass."""
        return self.dampers or (acb(0),) * len(self.masses)


Leaf = RowValues | Dead
NONZERO, BOUNDARY, OPEN = (Dead(reason) for reason in Reason)


def mirror(leaf: Leaf) -> Leaf:
    """The same numbers read from right to left."""
    if not isinstance(leaf, RowValues):
        return leaf
    return replace(
        leaf, masses=leaf.masses[::-1], springs=leaf.springs[::-1], dampers=leaf.dampers[::-1]
    )


def combine(
    left: Iterable[Leaf],
    right: Callable[[], Iterable[Leaf]],
    join: Callable[[RowValues, RowValues], Leaf],
) -> Iterator[Leaf]:
    """All pairs, then what is left open; nothing but proofs if one side is proven impossible.

    `right` is evaluated only if the left side is not refuted.
    """
    first = list(left)
    second = [] if _refutes(first) else list(right())
    for side in (first, second):
        if _refutes(side):
            yield from side
            return
    for a, b in itertools.product(first, second):
        if isinstance(a, RowValues) and isinstance(b, RowValues):
            yield join(a, b)
    yield from (leaf for leaf in (*first, *second) if isinstance(leaf, Dead))


def _refutes(leaves: list[Leaf]) -> bool:
    return bool(leaves) and all(leaf == NONZERO for leaf in leaves)


def circle(degree: int, radius: float) -> list[Ball]:
    """As many points on a circle as a polynomial of this degree has coefficients."""
    return [radius * u for u in _unit(degree + 1)]


def through(values: list[Ball], radius: float) -> Poly:
    """The polynomial with these values on the `circle`."""
    count, unit = len(values), _unit(len(values))
    sums = [
        sum((v * unit[-i * k % count] for k, v in enumerate(values)), acb(0)) / count
        for i in range(count)
    ]
    return poly([c / acb(radius) ** i for i, c in enumerate(sums)])


def _unit(count: int) -> list[Ball]:
    """The roots of unity."""
    return [acb.exp_pi_i(acb(fmpq(2 * j, count))) for j in range(count)]
