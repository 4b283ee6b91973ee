"""An equivalent checked alone: put into the transfer function, with its reality and signs seen in
rational intervals.

The substitution is exact in Q[u]/f: N2(q) D - N D2(q) = 0, and the leading coefficient of D2(q) is
prime to f. A sign change of f over the interval proves a real root there, and interval arithmetic
the signs of the coordinates at it.
"""

from collections.abc import Sequence
from fractions import Fraction

from flint import fmpq, fmpq_poly

from disting.general.equivalent import Equivalent
from disting.general.matrix_model import Model, Terms
from disting.general.target import Target
from disting.model.question import Domain

Interval = tuple[Fraction, Fraction]


def certified(found: Equivalent, goal: Target, other: Model) -> bool:
    """Whether these parameters of `other` have the target's transfer function and are real or
    positive as they say.
    """
    if not _fits(found, goal, other) or found.parameters != other.parameters:
        return False
    if found.domain is Domain.COMPLEX:
        return True
    ends = [_value(found.polynomial, (x, x))[0] for x in found.box[0]]
    images = [_value(c, found.box[0]) for c in found.coordinates]
    positive = found.domain is not Domain.POSITIVE or all(least > 0 for least, _ in images)
    return ends[0] * ends[1] <= 0 and positive


def _fits(found: Equivalent, goal: Target, other: Model) -> bool:
    modulus = fmpq_poly([fmpq(c) for c in found.polynomial])
    point = [_poly(c) % modulus for c in found.coordinates]
    above, below = (
        [_at(c, point, modulus) for c in side]
        for side in (other.numerator_terms, other.denominator_terms)
    )
    crossed = [fmpq_poly([0])] * (
        max(len(above) + len(goal.denominator), len(below) + len(goal.numerator)) - 1
    )
    for searched, given, sign in ((above, goal.denominator, 1), (below, goal.numerator, -1)):
        for i, a in enumerate(searched):
            for j, b in enumerate(given):
                crossed[i + j] += sign * a * fmpq(b.numerator, b.denominator)
    return all((c % modulus).is_zero() for c in crossed) and modulus.gcd(below[-1]).degree() == 0


def _at(terms: Terms, point: list[fmpq_poly], modulus: fmpq_poly) -> fmpq_poly:
    total = fmpq_poly([0])
    for exponents, number in terms:
        term = fmpq_poly([number])
        for x, e in zip(point, exponents, strict=True):
            for _ in range(e):
                term = term * x % modulus
        total += term
    return total


def _poly(coefficients: tuple[Fraction, ...]) -> fmpq_poly:
    return fmpq_poly([fmpq(c.numerator, c.denominator) for c in coefficients])


def _value(coefficients: Sequence[Fraction | int], at: Interval) -> Interval:
    """An interval that holds all values of a polynomial on an interval, by Horner's rule in
    exact fractions.
    """
    least = largest = Fraction(0)
    for c in map(Fraction, reversed(coefficients)):
        products = [x * y for x in (least, largest) for y in at]
        least, largest = min(products) + c, max(products) + c
    return least, largest
