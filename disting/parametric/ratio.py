"""Fractions of polynomials with integer coefficients, in lowest terms: what the entries of a model are made of.

Lowest terms are exact: numerator and denominator have no common factor in Z[symbols], numbers included, and the first
coefficient of the denominator (in the ring's lexicographic order) is positive. So equal fractions are equal pairs.
"""

from dataclasses import dataclass

from flint import fmpz_mpoly

from disting.errors import InputError


@dataclass(frozen=True, slots=True)
class Ratio:
    """num/den of one ring; raises InputError where den is zero."""

    num: fmpz_mpoly
    den: fmpz_mpoly

    def __post_init__(self) -> None:
        if self.den.is_zero():
            raise InputError("an expression divides by zero")
        if self.den.is_one():
            return
        common = self.num.gcd(self.den)
        if self.den.leading_coefficient() < 0:
            common = -common
        object.__setattr__(self, "num", self.num // common)
        object.__setattr__(self, "den", self.den // common)

    def __add__(self, other: "Ratio") -> "Ratio":
        return Ratio(self.num * other.den + other.num * self.den, self.den * other.den)

    def __mul__(self, other: "Ratio") -> "Ratio":
        return Ratio(self.num * other.num, self.den * other.den)

    def __truediv__(self, other: "Ratio") -> "Ratio":
        return Ratio(self.num * other.den, self.den * other.num)

    def __pow__(self, exponent: int) -> "Ratio":
        if exponent < 0:
            return Ratio(self.den, self.num) ** -exponent
        return Ratio(self.num**exponent, self.den**exponent)
