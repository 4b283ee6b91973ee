"""Laurent polynomials in the parameters with integer coefficients: sums such as m1 + m2, quotients
such as k01/m1.

They are few terms long and are differentiated by hand (d p^a = a p^a/p_i).
"""

from collections.abc import Mapping
from dataclasses import dataclass
from math import ceil, log2
from typing import Any

from disting.algebra.certainty import Size
from disting.algebra.notation import latex, text
from disting.algebra.symbols import Term

Number = Any  # an element of a field
Exponents = tuple[tuple[str, int], ...]
"""Parameter names with non-zero exponents, in the chain's order."""


@dataclass(frozen=True, slots=True)
class Formula:
    """Sum of coefficient * product of name^exponent.

    >>> Formula(((1, (("k12", 1), ("m1", -1), ("m2", -1))),)).text
    'k12/(m1*m2)'
    >>> Formula(((1, (("m1", 1),)), (2, (("m2", 1),)))).latex
    'm_{1} + 2 m_{2}'
    """

    terms: tuple[tuple[int, Exponents], ...]

    def value(self, at: Mapping[str, Number]) -> Number:
        """Value at a point of a field."""
        return sum(
            (c * _power(at, e) for c, e in self.terms[1:]),
            self.terms[0][0] * _power(at, self.terms[0][1]),
        )

    def gradient(self, at: Mapping[str, int], modulus: int) -> list[int]:
        """Derivatives by all parameters at a point modulo a prime."""
        slopes = dict.fromkeys(at, 0)
        for coefficient, exponents in self.terms:
            value = coefficient
            for name, exponent in exponents:
                value = value * pow(at[name], exponent, modulus) % modulus
            for name, exponent in exponents:
                slopes[name] += value * exponent * pow(at[name], -1, modulus)
        return [s % modulus for s in slopes.values()]

    @property
    def size(self) -> Size:
        """Bounds of the entries of the gradient after clearing denominators."""
        degree = max(sum(abs(e) for _, e in exponents) for _, exponents in self.terms)
        whole = sum(abs(c) * (1 + sum(abs(e) for _, e in exponents)) for c, exponents in self.terms)
        return Size((degree + 1) * (1 + len(self.terms)), ceil(log2(whole + 1)))

    @property
    def text(self) -> str:
        """For people: k01/m1."""
        return text(self._sum)

    @property
    def latex(self) -> str:
        r"""For print: \frac{k_{01}}{m_{1}}."""
        return latex(self._sum)

    def renamed(self, names: Mapping[str, str]) -> "Formula":
        """The same formula in other names."""
        return Formula(
            tuple((c, tuple((names[n], e) for n, e in exponents)) for c, exponents in self.terms)
        )

    @property
    def _sum(self) -> list[Term]:
        return [(c, dict(exponents)) for c, exponents in self.terms]


def monomial(**exponents: int) -> Formula:
    """A product of powers.

    >>> monomial(k01=1, m1=-1).text
    'k01/m1'
    """
    return Formula(((1, tuple((name, e) for name, e in exponents.items() if e)),))


def _power(at: Mapping[str, Number], exponents: Exponents) -> Number:
    value: Number = 1
    for name, exponent in exponents:
        value = value * at[name] ** exponent if exponent > 0 else value / at[name] ** -exponent
    return value
