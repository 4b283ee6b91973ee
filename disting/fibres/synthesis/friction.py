"""A dynamic stiffness taken apart where masses may have dampers to the ground: Z = m s^2 + b s +
W'.

As in `peel`, W = P/A = k Z/(k + Z), P = k Delta, A = k A' + Delta, Z = Delta/A', k = d (s - z), so
that P(z) = 0 and P'(z) = d A(z). Far away W' grows like d' s, d' the damper of its first spring, so
that Z determines only b + d', and W' is known up to a multiple of s: its slope is open. That costs
no unknown. If W = W0 + d s, W0 = P0/A bounded, then at the root z of k

    W0(z) + d z = 0  and  W0'(z) + d = d,  hence  P0'(z) A(z) - P0(z) A'(z) = 0  and  d = -W0(z)/z

4 nu - 2 candidates for z without a test, in place of 2 nu + 1 with one (the leading coefficients
cancel twice). The slope is known again where the masses behind are free and without dampers, W'(0)
= 0 = dW'/ds(0), which gives b = dZ/ds(0). Springs without dampers, k = c, leave nothing open: W'
is bounded, k = W at infinity, and b is the coefficient of s of Z.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace

from flint import acb, arb

from disting.algebra.certainty import residues
from disting.fibres.synthesis.branch import (
    BOUNDARY,
    NONZERO,
    Ball,
    Leaf,
    Poly,
    RowValues,
    cut,
    is_boundary,
    poly,
    roots,
    shift,
    vanishes,
)
from disting.fibres.synthesis.peel import Stiffness, peel

NOTHING = acb(0)


@dataclass(frozen=True, slots=True)
class Side:
    """W = numerator/denominator (monic) of the masses behind a spring, from the port outwards, in
    s.

    No mass next to a wall has a damper that could be merged with that of its spring (see `fibre`).

    `dampers`: which of these masses have one to the ground; `elastic`: springs without dampers;
    `slope_open`: W is known but for a multiple of s, and given without growth.
    """

    numerator: Poly
    denominator: Poly
    dampers: tuple[bool, ...]
    wall: bool
    elastic: bool
    slope_open: bool = False

    @property
    def is_loose(self) -> bool:
        """Free and without dampers: W(0) = W'(0) = 0."""
        return not self.wall and not any(self.dampers)


@dataclass(frozen=True, slots=True)
class Node:
    """Z - m s^2 = numerator/denominator (monic) at a mass, `damper`: whether it has one;
    `dampers` of the masses behind.
    """

    numerator: Poly
    denominator: Poly
    damper: bool
    dampers: tuple[bool, ...]
    wall: bool
    elastic: bool


def slope(leaf: RowValues) -> Ball:
    """Growth of W far away: the damper of its first spring."""
    return leaf.springs[0][1] if leaf.springs else NOTHING


def peel_side(w: Side) -> Iterator[Leaf]:
    """Yield all masses, springs and dampers with this stiffness, from the port
    outwards.
    """
    if not w.dampers:
        yield _last(w)
    elif w.elastic:
        yield from _elastic(w)
    elif w.slope_open:
        yield from _open(w)
    elif any(w.dampers):
        yield from _damped_branches(w)
    else:
        yield from peel(
            Stiffness(
                numerator=w.numerator,
                denominator=w.denominator,
                masses=len(w.dampers),
                wall=w.wall,
                q=2,
            )
        )


def solve_behind(node: Node) -> Iterator[tuple[Ball, Leaf]]:
    """Yield b (zero without a damper) with all that can be behind the mass."""
    nu = len(node.dampers)
    side = Side(
        numerator=node.numerator,
        denominator=node.denominator,
        dampers=node.dampers,
        wall=node.wall,
        elastic=node.elastic,
    )
    if not node.damper and not node.elastic:
        yield from (
            (NOTHING, leaf)
            for leaf in peel_side(replace(side, numerator=without_low(node.numerator, side)))
        )
        return
    is_open = node.damper and not node.elastic and not side.is_loose
    b = (
        node.numerator[1] / node.denominator[0]
        if node.damper and side.is_loose
        else node.numerator[2 * nu + 1]
    )
    rest = node.numerator - b * shift(node.denominator, 1)
    side = replace(
        side,
        numerator=without_low(cut(rest, 2 * nu + (not is_open and not node.elastic)), side),
        slope_open=is_open,
    )
    if not node.damper and not vanishes(b, _size(node.numerator)):
        yield NOTHING, NONZERO
        return
    for leaf in peel_side(side):
        yield (b - slope(leaf) if isinstance(leaf, RowValues) else NOTHING) if is_open else b, leaf


def attach(spring: Poly, mass: Ball, b: Ball, damper: bool, leaf: Leaf) -> Leaf:
    """The same with one more mass and spring in front; at the boundary if the damper cannot be
    separated from zero.
    """
    if not isinstance(leaf, RowValues):
        return leaf
    if damper and is_boundary(b):
        return BOUNDARY
    dampers = (b if damper else NOTHING, *leaf.all_dampers)
    return RowValues((mass, *leaf.masses), (spring, *leaf.springs), leaf.gauges, dampers)


def _last(w: Side) -> Leaf:
    """The spring to the wall is W itself; at a free end nothing is left."""
    if not w.wall:
        return RowValues()
    spring = cut(w.numerator, 0 if w.elastic else 1)
    return (
        BOUNDARY
        if any(is_boundary(spring[i]) for i in range(2 - w.elastic))
        else RowValues(springs=(spring,))
    )


def random(count: int) -> list[Ball]:
    """Distinct positive numbers, exact in binary: free choices."""
    return [
        acb(i + (1 + r) / 4096)
        for i, r in enumerate(residues("synthesis:friction", count, 1 << 12))
    ]


def _elastic(w: Side) -> Iterator[Leaf]:
    nu = len(w.dampers)
    c = w.numerator[2 * nu]
    if is_boundary(c):
        yield BOUNDARY
    else:
        yield from _behind(w, w.numerator, poly([c]))


def _damped_branches(w: Side) -> Iterator[Leaf]:
    """One branch for every root of P (at a free end: of P/s) that passes the test."""
    degree, low = 2 * len(w.dampers) + 1, 0 if w.wall else 1
    d, steepness = w.numerator[degree], w.numerator.derivative()
    if is_boundary(d):
        yield BOUNDARY
        return

    def excess(z: Ball) -> Ball:
        """Zero where z is the spring's."""
        return w.denominator(z) * d - steepness(z)

    others = shift(w.numerator, -low)
    for z in roots(others, degree - low, lambda z: not excess(z).contains(0)):
        if not vanishes(excess(z), steepness(z)):
            yield NONZERO
        elif is_boundary(z):
            yield BOUNDARY
        else:
            yield from _behind(w, w.numerator, poly([-d * z, d]))


def _open(w: Side) -> Iterator[Leaf]:
    """One branch for every stationary point of W0."""
    p, a = w.numerator, w.denominator
    degree = 4 * len(w.dampers) - 2
    for z in roots(cut(p.derivative() * a - p * a.derivative(), degree), degree):
        if is_boundary(z) or is_boundary(a(z)):
            yield BOUNDARY
            continue
        d = -p(z) / (z * a(z))
        yield from (
            [BOUNDARY] if is_boundary(d) else _behind(w, p + d * shift(a, 1), poly([-d * z, d]))
        )


def _behind(w: Side, numerator: Poly, spring: Poly) -> Iterator[Leaf]:
    """The mass behind the spring, its damper, and the peel of the rest."""
    nu = len(w.dampers)
    delta = cut(numerator // spring, 2 * nu)
    rest = cut((w.denominator - delta) // spring, 2 * nu - 1 if w.elastic else 2 * nu - 2)
    if w.elastic and not vanishes(rest[2 * nu - 1], _size(w.denominator) / spring[0]):
        yield NONZERO
        return
    rest = cut(rest, 2 * nu - 2)
    if is_boundary(rest[2 * nu - 2]):
        yield BOUNDARY
        return
    mass: Ball = 1 / rest[2 * nu - 2]
    raw = cut(mass * (delta - mass * shift(rest, 2)), 2 * nu - 1)
    raw = raw if w.wall else shift(shift(raw, -1), 1)
    for b, leaf in solve_behind(
        Node(
            numerator=raw,
            denominator=rest * mass,
            damper=w.dampers[0],
            dampers=w.dampers[1:],
            wall=w.wall,
            elastic=w.elastic,
        )
    ):
        yield attach(spring, mass, b, w.dampers[0], leaf)


def without_low(p: Poly, side: Side) -> Poly:
    """p with the low coefficients exactly zero that are so by theory."""
    low = 0 if side.wall else 2 if side.is_loose else 1
    return shift(shift(p, -low), low)


def _size(p: Poly) -> Ball | arb:
    return sum((abs(c) for c in p.coeffs()), NOTHING)
