"""Rational functions of named symbols over the integers: a field, in lowest terms.

Lowest terms are exact: numerator and denominator have no common factor in Z[symbols], numbers
included, and the first coefficient of the denominator (in the ring's lexicographic order) is
positive. So equal functions are equal pairs.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from flint import fmpz_mpoly

from disting.algebra.symbols import symbols, terms

Number = Any  # an element of a field


@dataclass(frozen=True, slots=True)
class RationalFunction:
    """num/den, polynomials of one ring; raises ZeroDivisionError where den is zero.

    >>> x, y = variables(["x", "y"]).values()
    >>> (x**2 - y**2) / (x + y) == x - y, (x / y).degree
    (True, 1)
    """

    num: fmpz_mpoly
    den: fmpz_mpoly

    def __post_init__(self) -> None:
        if self.den.is_zero():
            raise ZeroDivisionError("a rational function divided by zero")
        if self.den.is_one():
            return
        common = self.num.gcd(self.den)
        if self.den.leading_coefficient() < 0:
            common = -common
        if not common.is_one():
            object.__setattr__(self, "num", self.num // common)
            object.__setattr__(self, "den", self.den // common)

    def __add__(self, other: "RationalFunction") -> "RationalFunction":
        common = self.den.gcd(other.den)
        left, right = other.den // common, self.den // common
        return RationalFunction(self.num * left + other.num * right, self.den * left)

    def __sub__(self, other: "RationalFunction") -> "RationalFunction":
        return self + -other

    def __neg__(self) -> "RationalFunction":
        return RationalFunction(-self.num, self.den)

    def __mul__(self, other: "RationalFunction") -> "RationalFunction":
        return RationalFunction(self.num * other.num, self.den * other.den)

    def __truediv__(self, other: "RationalFunction") -> "RationalFunction":
        return RationalFunction(self.num * other.den, self.den * other.num)

    __floordiv__ = __truediv__  # in a field every division is exact

    def __pow__(self, exponent: int) -> "RationalFunction":
        top, bottom = (self.num, self.den) if exponent >= 0 else (self.den, self.num)
        return RationalFunction(top ** abs(exponent), bottom ** abs(exponent))

    @property
    def degree(self) -> int:
        """The larger total degree of numerator and denominator."""
        return max(int(p.total_degree()) for p in (self.num, self.den))

    def value(self, at: Mapping[str, Number]) -> Number:
        """Value at a point of a field. Raises ZeroDivisionError at a pole."""
        return _value(self.num, at) / _value(self.den, at)


def variables(names: Sequence[str]) -> dict[str, RationalFunction]:
    """The symbols as rational functions."""
    return {name: RationalFunction(symbol, symbol**0) for name, symbol in symbols(names).items()}


def _value(polynomial: fmpz_mpoly, at: Mapping[str, Number]) -> Number:
    total: Number = 0
    for coefficient, powers in terms(polynomial):
        term: Number = coefficient
        for name, exponent in powers.items():
            term = term * at[name] ** exponent
        total = total + term
    return total
