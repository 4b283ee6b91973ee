"""Polynomials and rational functions with named symbols.

Lowest terms are exact: numerator and denominator have no common factor in Z[symbols], numbers
included, and the first coefficient of the denominator (in the ring's lexicographic order) is
positive. So equal functions are equal pairs.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeVar, cast

from flint import Ordering, fmpq_mpoly_ctx, fmpz_mpoly, fmpz_mpoly_ctx

if TYPE_CHECKING:
    from flint.typing import scalar_p

Polynomial = fmpz_mpoly
Term = tuple[int, Mapping[str, int]]
"""Coefficient and {symbol: exponent}."""
Content = tuple[tuple[str, ...], tuple[tuple[tuple[int, ...], int], ...]]
"""Names, and (exponents, coefficient) of every term; unlike a polynomial it has a hash."""
Scalar = TypeVar("Scalar", bound="scalar_p")
"""An element of a field."""


def symbols(names: Sequence[str]) -> dict[str, fmpz_mpoly]:
    """The generators of Z[names], in lexicographic order of the names as given."""
    context = fmpz_mpoly_ctx.get(tuple(names), Ordering.lex)
    return dict(zip(names, context.gens(), strict=True))


def content(polynomial: Polynomial) -> Content:
    """The names of its ring, and its terms, in an order: equal polynomials have equal content.

    >>> m, k = symbols(["m1", "k12"]).values()
    >>> content(k - 2 * m)
    (('m1', 'k12'), (((1, 0), -2), ((0, 1), 1)))
    """
    entries = tuple((powers, int(number)) for powers, number in polynomial.to_dict().items())
    return polynomial.context().names(), entries


def polynomial_of(entries_of: Content) -> Polynomial:
    """The polynomial of this content.

    >>> polynomial_of((("m1", "k12"), (((1, 0), -2), ((0, 1), 1))))
    -2*m1 + k12
    """
    names, entries = entries_of
    return fmpz_mpoly_ctx.get(names, Ordering.lex).from_dict(dict(entries))


def rename_symbols(
    polynomial: fmpz_mpoly, ring: Mapping[str, fmpz_mpoly], renaming: Mapping[str, str]
) -> fmpz_mpoly:
    """The polynomial with each symbol replaced by the one that `renaming` names (itself where
    not named), in `ring`.
    """
    names = [str(g) for g in polynomial.context().gens()]
    images = [ring[renaming.get(name, name)] for name in names]
    return polynomial.compose(*images, ctx=images[0].context())


def coefficients(polynomial: fmpz_mpoly, variable: str) -> list[fmpz_mpoly]:
    """Coefficients of the powers 0, 1, .. of one symbol.

    >>> s, m = symbols(["s", "m1"]).values()
    >>> [str(c) for c in coefficients(m * s**2 + 3, "s")]
    ['3', '0', 'm1']
    """
    context = polynomial.context()
    names = [str(g) for g in context.gens()]
    at = names.index(variable)
    parts: list[dict[tuple[int, ...], int]] = [{} for _ in range(polynomial.degrees()[at] + 1)]
    for powers, number in polynomial.to_dict().items():
        rest = tuple(0 if i == at else power for i, power in enumerate(powers))
        parts[powers[at]][rest] = int(number)
    return [context.from_dict(part) for part in parts]


def terms(polynomial: fmpz_mpoly) -> list[Term]:
    """Every term, in the ring's order.

    >>> m, k = symbols(["m1", "k12"]).values()
    >>> terms(k - 2 * m**2)
    [(-2, {'m1': 2}), (1, {'k12': 1})]
    """
    names = polynomial.context().names()
    pairs = polynomial.terms()
    return [
        (int(c), {name: int(e) for name, e in zip(names, powers, strict=True) if e})
        for powers, c in pairs
    ]


def factors(polynomial: fmpz_mpoly) -> tuple[int, list[tuple[fmpz_mpoly, int]]]:
    """The integer content with sign, and the irreducible factors with exponents, single symbols
    first.
    """
    content, powers = factorise(polynomial)
    return content, sorted(powers, key=lambda pe: (len(pe[0]), str(pe[0])))


def factorise(polynomial: fmpz_mpoly) -> tuple[int, list[tuple[fmpz_mpoly, int]]]:
    """The integer content with sign, and the irreducible factors with exponents, in FLINT's order;
    of coefficients of any size.

    `fmpz_mpoly.factor()` of python-flint 0.9 sorts what it found by differences of coefficients
    that it takes for C integers: from 2^31 on it raises OverflowError. `fmpq_mpoly.factor()` finds
    the same factors, primitive and in the same order, and compares numbers of any size.

    >>> x, y = symbols(["x", "y"]).values()
    >>> factorise(6 * (x + 3 * 10**9) * (x + 1) ** 2 * (x - 10**9))
    (6, [(x - 1000000000, 1), (x + 3000000000, 1), (x + 1, 2)])
    """
    try:
        number, powers = polynomial.factor()
    except OverflowError:
        return _over_rationals(polynomial)
    return int(number), [(factor, int(power)) for factor, power in powers]


def _over_rationals(polynomial: fmpz_mpoly) -> tuple[int, list[tuple[fmpz_mpoly, int]]]:
    ring = polynomial.context()
    field = fmpq_mpoly_ctx.get(ring.names(), ring.ordering())
    number, powers = field.from_dict(polynomial.to_dict()).factor()
    return int(number), [
        (ring.from_dict({e: int(c) for e, c in factor.to_dict().items()}), power)
        for factor, power in powers
    ]


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

    def value(self, at: Mapping[str, Scalar]) -> Scalar:
        """Value at a point of a field. Raises ZeroDivisionError at a pole."""
        return _value(self.num, at) / _value(self.den, at)


def variables(names: Sequence[str]) -> dict[str, RationalFunction]:
    """The symbols as rational functions."""
    return {name: RationalFunction(symbol, symbol**0) for name, symbol in symbols(names).items()}


def _value(polynomial: fmpz_mpoly, at: Mapping[str, Scalar]) -> Scalar:
    total = cast("Scalar", 0)  # whole numbers are in every field
    for coefficient, powers in terms(polynomial):
        term = cast("Scalar", coefficient)
        for name, exponent in powers.items():
            term = term * at[name] ** exponent
        total = total + term
    return total
