"""Rational functions of the parameters with integer coefficients: a field, in lowest terms, that prints its factors.

Lowest terms are exact: numerator and denominator have no common factor, and the first coefficient of the denominator (in the
ring's lexicographic order) is positive. So equal functions are equal pairs.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from disting.algebra.symbols import symbols

Polynomial = Any  # fmpz_mpoly
Number = Any  # an element of a field


@dataclass(frozen=True, slots=True)
class Expression:
    """num/den, polynomials of one ring; raises ZeroDivisionError where den is zero.

    >>> x, y = variables(["x", "y"]).values()
    >>> str((x * x - y * y) / (x + y)), (x / y).degree
    ('x - y', 1)
    """

    num: Polynomial
    den: Polynomial

    def __post_init__(self) -> None:
        if self.den.is_zero():
            raise ZeroDivisionError("a rational function divided by zero")
        common = self.num.gcd(self.den)
        if self.den.leading_coefficient() < 0:
            common = -common
        if not common.is_one():
            object.__setattr__(self, "num", self.num // common)
            object.__setattr__(self, "den", self.den // common)

    def __add__(self, other: "Expression") -> "Expression":
        common = self.den.gcd(other.den)
        left, right = other.den // common, self.den // common
        return Expression(self.num * left + other.num * right, self.den * left)

    def __sub__(self, other: "Expression") -> "Expression":
        return self + Expression(-other.num, other.den)

    def __neg__(self) -> "Expression":
        return Expression(-self.num, self.den)

    def __mul__(self, other: "Expression") -> "Expression":
        return Expression(self.num * other.num, self.den * other.den)

    def __truediv__(self, other: "Expression") -> "Expression":
        return Expression(self.num * other.den, self.den * other.num)

    __floordiv__ = __truediv__  # in a field every division is exact

    def __pow__(self, exponent: int) -> "Expression":
        return Expression(self.num**exponent, self.den**exponent)

    @property
    def degree(self) -> int:
        """The larger total degree of numerator and denominator."""
        return max(int(p.total_degree()) for p in (self.num, self.den))

    def value(self, at: Mapping[str, Number]) -> Number:
        """Value at a point of a field. Raises ZeroDivisionError at a pole."""
        return _value(self.num, at) / _value(self.den, at)

    def __str__(self) -> str:
        from disting.equivalence.writing import text

        return text(self)


Factors = list[tuple[Polynomial | int, int]]


def factors(polynomial: Polynomial) -> tuple[int, Factors]:
    """The integer content with sign, and the irreducible factors with exponents, single symbols first."""
    content, found = polynomial.factor()
    return int(content), sorted(((p, int(e)) for p, e in found), key=lambda pe: (len(pe[0]), str(pe[0])))


def variables(names: Sequence[str]) -> dict[str, Expression]:
    """The symbols as rational functions."""
    ring = symbols(names)
    return {name: Expression(symbol, symbol**0) for name, symbol in ring.items()}


def terms(polynomial: Polynomial) -> list[tuple[int, dict[str, int]]]:
    """Coefficient and {symbol: exponent} of every term, in the ring's order."""
    names = [str(symbol) for symbol in polynomial.context().gens()]
    return [
        (int(c), {name: int(e) for name, e in zip(names, powers, strict=True) if e})
        for powers, c in zip(polynomial.monoms(), polynomial.coeffs(), strict=True)
    ]


def _value(polynomial: Polynomial, at: Mapping[str, Number]) -> Number:
    total: Number = 0
    for coefficient, powers in terms(polynomial):
        term: Number = coefficient
        for name, exponent in powers.items():
            term = term * at[name] ** exponent
        total = total + term
    return total
