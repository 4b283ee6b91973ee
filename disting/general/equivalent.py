"""One parameter vector of a fibre: exact numbers of Q(u), u one root of an irreducible polynomial,
with certified signs.

A zero of an ideal is real exactly if u is, a rational linear combination of its coordinates that
determines them. Real roots are isolated by FLINT's isolation of roots. A coordinate g(u) is zero
exactly if f divides g; the sign of any other one is found in ball arithmetic once the balls are
small enough.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from flint import acb, arb, ctx, fmpq_poly, fmpz_poly

from disting.algebra.groebner.rational import Shape
from disting.general.target import fraction
from disting.model.presentation import summary
from disting.model.question import Domain

FIRST_BITS = 128


@dataclass(frozen=True, slots=True)
class Equivalent:
    """Parameter i is `coordinates`[i], a polynomial (ascending) in the root u of the irreducible
    `polynomial` inside `box`.

    `box` = (least, largest) real and imaginary part; `domain`: POSITIVE if all parameters are,
    else REAL or COMPLEX: certified. `numbers` are rounded values of the parameters.
    """

    parameters: tuple[str, ...]
    polynomial: tuple[int, ...]
    box: tuple[tuple[Fraction, Fraction], tuple[Fraction, Fraction]]
    coordinates: tuple[tuple[Fraction, ...], ...]
    domain: Domain
    numbers: tuple[complex, ...]

    def __repr__(self) -> str:
        return summary(self, f"{self.domain}, {self}")

    @property
    def values(self) -> dict[str, Fraction | float | complex]:
        """Parameters by name: exact where rational, rounded to 15 digits elsewhere."""
        return {name: self._value(i) for i, name in enumerate(self.parameters)}

    @property
    def is_rational(self) -> bool:
        """True if all values are exact."""
        return all(len(c) <= 1 for c in self.coordinates)

    def __str__(self) -> str:
        return ", ".join(f"{name} = {spell(x)}" for name, x in self.values.items())

    def _value(self, at: int) -> Fraction | float | complex:
        exact, number = self.coordinates[at], self.numbers[at]
        if len(exact) <= 1:
            return exact[0] if exact else Fraction(0)
        return number if self.domain is Domain.COMPLEX else number.real


def rational(values: Mapping[str, Fraction]) -> Equivalent:
    """A parameter vector of positive fractions.

    >>> str(rational({"k": Fraction(1, 2)}))
    'k = 1/2'
    """
    point, numbers = (Fraction(0), Fraction(0)), tuple(map(complex, values.values()))
    exact = tuple((x,) for x in values.values())
    return Equivalent(tuple(values), (0, 1), (point, point), exact, Domain.POSITIVE, numbers)


def equivalents(shape: Shape, parameters: tuple[str, ...]) -> Iterator[Equivalent]:
    """Yield the zeros, one irreducible factor after the other; `coordinates[0]` of the shape is
    t, no parameter.
    """
    for factor, _ in shape.polynomial.numer().factor()[1]:
        reduced = [g % fmpq_poly(factor) for g in shape.coordinates[1:]]
        yield from _certify_zeros(factor, reduced, parameters)


def _certify_zeros(
    factor: fmpz_poly, reduced: list[fmpq_poly], parameters: tuple[str, ...]
) -> list[Equivalent]:
    """The zeros that belong to the roots of an irreducible factor, with as many bits as the
    signs need.
    """
    bits = FIRST_BITS
    while True:
        with ctx.workprec(bits):
            isolated: list[Any] = factor.complex_roots()
            roots = [root for root, _ in isolated]
            the_equivalents = [_equivalent(factor, root, reduced, parameters) for root in roots]
        sure = [x for x in the_equivalents if x]
        if len(sure) == len(roots):
            return sure
        bits *= 2


def _equivalent(
    factor: fmpz_poly, root: acb, reduced: list[fmpq_poly], parameters: tuple[str, ...]
) -> Equivalent | None:
    """The zero at one root; None if a ball is too wide for a sign."""
    images = [evaluate(g, root) for g in reduced]
    signs = [_sign(g, x) for g, x in zip(reduced, images, strict=True)]
    if root.imag.is_zero() and None in signs:
        return None
    exact = tuple(tuple(map(fraction, g.coeffs())) for g in reduced)
    box = (_interval(root.real), _interval(root.imag))
    numbers = tuple(complex(x) for x in images)
    return Equivalent(
        parameters, tuple(map(int, factor.coeffs())), box, exact, _domain(root, signs), numbers
    )


def evaluate(polynomial: fmpq_poly, at: acb) -> acb:
    """Value at a ball, by Horner's rule."""
    total = 0 * at
    for c in reversed(polynomial.coeffs()):
        total = total * at + arb(c)
    return total


def _sign(polynomial: fmpq_poly, image: acb) -> int | None:
    """Sign of a real number; None if the ball is too wide."""
    if polynomial.is_zero():
        return 0
    return 1 if image.real > 0 else -1 if image.real < 0 else None


def sign_at(polynomial: fmpq_poly, at: Equivalent) -> int:
    """Sign of a polynomial in the root of a real vector, reduced modulo that root's polynomial."""
    bits = FIRST_BITS
    while not polynomial.is_zero():
        with ctx.workprec(bits):
            isolated: list[Any] = fmpz_poly(list(at.polynomial)).complex_roots()
            balls = [root for root, _ in isolated if root.imag.is_zero() and _meets(root, at)]
            signs = {_sign(polynomial, evaluate(polynomial, ball)) for ball in balls}
        if len(balls) == 1 and None not in signs:
            return signs.pop() or 0
        bits *= 2
    return 0


def _meets(root: acb, at: Equivalent) -> bool:
    low, high = _interval(root.real)
    return low <= at.box[0][1] and at.box[0][0] <= high


def _domain(root: acb, signs: list[int | None]) -> Domain:
    if not root.imag.is_zero():
        return Domain.COMPLEX
    return Domain.POSITIVE if all(sign == 1 for sign in signs) else Domain.REAL


def _interval(ball: arb) -> tuple[Fraction, Fraction]:
    middle, radius = fraction(ball.mid().fmpq()), fraction(ball.rad().fmpq())
    return middle - radius, middle + radius


def spell(number: Fraction | float | complex) -> str:
    """A value as text: a fraction exactly, others rounded to 6 digits."""
    return str(number) if isinstance(number, Fraction) else f"{number:.6g}"
