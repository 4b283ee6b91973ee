"""A dynamic stiffness taken apart into springs and masses, one after the other, from the port
outwards.

W = P/A (A monic of degree q nu) is what a port feels of nu masses behind a spring: W = k Z/(k +
Z), Z = m s^2 + W'. Then P = k Delta and A = k A' + Delta with Z = Delta/A', Delta monic. Undamped
(in x = s^2) k = lc P: Cauer's continued fraction, without a choice. Damped k = d (s - z) for a
root z of P; since A(z) = Delta(z), only roots with d A(z) = P'(z) can serve.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace

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


@dataclass(frozen=True, slots=True)
class Stiffness:
    """W = numerator/denominator (monic) of `masses` masses, ending at the wall or free; q = 2
    damped, 1 undamped.
    """

    numerator: Poly
    denominator: Poly
    masses: int
    wall: bool
    q: int


def peel(w: Stiffness) -> Iterator[Leaf]:
    """Yield all masses and springs with this stiffness, from the port outwards."""
    if w.masses == 0:
        yield _last(w)
    elif is_boundary(w.numerator[_degree(w)]):
        yield BOUNDARY
    elif w.q == 1:
        yield from _behind(w, poly([w.numerator[w.masses]]))
    else:
        yield from _damped_branches(w)


def _degree(w: Stiffness) -> int:
    """Degree of P: 2 nu + 1 damped, nu undamped."""
    return 2 * w.masses + 1 if w.q == 2 else w.masses


def _last(w: Stiffness) -> Leaf:
    """The spring to the wall is W itself; at a free end nothing is left."""
    if not w.wall:
        return RowValues()
    spring = cut(w.numerator, w.q - 1)
    return (
        BOUNDARY
        if any(is_boundary(spring[i]) for i in range(w.q))
        else RowValues(springs=(spring,))
    )


def _damped_branches(w: Stiffness) -> Iterator[Leaf]:
    """One branch for every root of P (at a free end: of P/s^2) that passes the test."""
    low = 0 if w.wall else 2
    d, slope = w.numerator[_degree(w)], w.numerator.derivative()

    def excess(z: Ball) -> Ball:
        """Zero where z is the spring's."""
        return w.denominator(z) * d - slope(z)

    others = shift(w.numerator, -low)
    for z in roots(others, _degree(w) - low, lambda z: not excess(z).contains(0)):
        if not vanishes(excess(z), slope(z)):
            yield NONZERO
        elif is_boundary(z):
            yield BOUNDARY
        else:
            yield from _behind(w, poly([-d * z, d]))


def _behind(w: Stiffness, spring: Poly) -> Iterator[Leaf]:
    """The mass behind the spring, and the peel of the rest."""
    q, nu = w.q, w.masses
    delta = cut(w.numerator // spring, q * nu)
    rest = cut((w.denominator - delta) // spring, q * (nu - 1))
    if is_boundary(rest[q * (nu - 1)]):
        yield BOUNDARY
        return
    mass: Ball = 1 / rest[q * (nu - 1)]
    inner = Stiffness(
        numerator=_remaining(delta, rest, mass, w),
        denominator=rest * mass,
        masses=nu - 1,
        wall=w.wall,
        q=q,
    )
    for leaf in peel(inner):
        yield (
            replace(leaf, masses=(mass, *leaf.masses), springs=(spring, *leaf.springs))
            if isinstance(leaf, RowValues)
            else leaf
        )


def _remaining(delta: Poly, rest: Poly, mass: Ball, w: Stiffness) -> Poly:
    """m (Delta - m s^2 A'), of degree 2 (nu-1) + 1 (undamped nu-1); its low coefficients vanish
    at a free end.
    """
    q, nu = w.q, w.masses
    raw = cut(mass * (delta - mass * shift(rest, q)), 2 * nu - 1 if q == 2 else nu - 1)
    return raw if w.wall else grounded_at_zero(raw, q)


def grounded_at_zero(p: Poly, q: int) -> Poly:
    """p with the coefficients s^0 .. s^(q-1) exactly zero: what a free end feels like in a
    motion of the whole.
    """
    return shift(shift(p, -q), q)
