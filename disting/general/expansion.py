"""Trees multiplied out, with a bound on the work: what would grow too large is refused before it
is computed.

A product of polynomials of m and n terms takes m n products of coefficients; a power of t terms
has at most as many as there are monomials of its degree. Work is counted in words of 64 bits, so
that it bounds time and memory alike: a few seconds, and some hundred megabytes. The terms of a sum
that are written out, numbers times powers of symbols, are gathered at once; all else is taken in
halves, so that long sums and products take n log n steps.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import comb, lcm, prod

from flint import fmpz_mpoly

from disting.algebra.symbols import RationalFunction
from disting.errors import InputError
from disting.general.expression import Power, Product, Sum, Tree

MOST_WORK = 30_000_000
STEP = 20  # work of an operation, however small
HIGHEST_DEGREE = 5000
LONGEST = 50_000  # bits of a coefficient on the way
COMMON = 50  # work per term of a common factor
TOO_LARGE = (
    "the expressions grow too large when they are multiplied out; write the model with fewer terms,"
    " powers or states"
)


class TooLargeError(InputError):
    """Raised before what would grow too large is multiplied out."""

    def __init__(self) -> None:
        super().__init__(TOO_LARGE)


Term = tuple[Fraction, dict[str, int]]
"""A number times powers of symbols."""
Operation = Callable[[RationalFunction, RationalFunction], RationalFunction]


@dataclass(slots=True)
class Expansion:
    """The field of fractions of a ring with its generators by name, and the work that is left."""

    ring: dict[str, fmpz_mpoly]
    one: fmpz_mpoly
    left: float = MOST_WORK

    def value(self, of: Tree) -> RationalFunction:
        """Value of a tree; raises InputError for x/0 and for what grows too large."""
        term = self._term(of)
        if term:
            return self._gather_terms([term])
        match of:
            case Sum(parts):
                terms = [self._term(part) for part in parts]
                others = [
                    self.value(part)
                    for part, term in zip(parts, terms, strict=True)
                    if term is None
                ]
                return self._halve_powers(
                    self._plus, [self._gather_terms([term for term in terms if term]), *others]
                )
            case Product(parts):
                return self._halve_powers(self._times, [self.value(part) for part in parts])
            case Power(base, exponent):
                return self._power(self.value(base), exponent)
        raise TypeError(f"{type(of).__name__} is no tree")

    def times(self, a: fmpz_mpoly, b: fmpz_mpoly) -> fmpz_mpoly:
        """Product of two polynomials."""
        bits = _bits(a) + _bits(b)
        self._spend(len(a) * len(b) * (1 + bits // 64))
        if bits > LONGEST or any(
            x + y > HIGHEST_DEGREE for x, y in zip(a.degrees(), b.degrees(), strict=True)
        ):
            raise TooLargeError
        return a * b

    def ratio(self, num: fmpz_mpoly, den: fmpz_mpoly) -> RationalFunction:
        """A fraction in lowest terms."""
        self._spend(
            0
            if den.is_one()
            else COMMON * sum(len(side) * (1 + _bits(side) // 64) for side in (num, den))
        )
        return _over(num, den)

    def quotient(self, a: RationalFunction, b: RationalFunction) -> RationalFunction:
        """a/b; raises InputError for b = 0."""
        return self._times(a, _over(b.den, b.num))

    def common(self, first: fmpz_mpoly, second: fmpz_mpoly) -> fmpz_mpoly:
        """A polynomial of smallest degree that both divide."""
        return first if first == second else self.times(self.ratio(first, second).num, second)

    def _plus(self, a: RationalFunction, b: RationalFunction) -> RationalFunction:
        self._spend(len(a.num) + len(b.num))
        if a.den == b.den:
            return self.ratio(a.num + b.num, a.den)
        return self.ratio(
            self.times(a.num, b.den) + self.times(b.num, a.den), self.times(a.den, b.den)
        )

    def _times(self, a: RationalFunction, b: RationalFunction) -> RationalFunction:
        return self.ratio(self.times(a.num, b.num), self.times(a.den, b.den))

    def _power(self, base: RationalFunction, exponent: int) -> RationalFunction:
        for side in (base.num, base.den):
            self._spend(self._of_power(side, abs(exponent)))
        return base**exponent if exponent >= 0 else _over(base.den, base.num) ** -exponent

    def _of_power(self, base: fmpz_mpoly, n: int) -> float:
        """Work of a power: its terms times those of the base, times the words of its
        coefficients.
        """
        terms, degrees = len(base), [n * int(d) for d in base.degrees()]
        bits = n * (_bits(base) + max(terms, 1).bit_length())
        if max(degrees, default=0) > HIGHEST_DEGREE or (bits > LONGEST and not base.is_one()):
            raise TooLargeError
        most = min(comb(n + terms - 1, n) if terms else 1, prod(d + 1 for d in degrees))
        return most * max(terms, 1) * (1 + bits // 64)

    def _halve_powers(
        self, operation: Operation, values: Sequence[RationalFunction]
    ) -> RationalFunction:
        while len(values) > 1:
            pairs = [operation(a, b) for a, b in zip(values[::2], values[1::2], strict=False)]
            values = [*pairs, *values[2 * len(pairs) :]]
        return values[0]

    def _term(self, of: Tree) -> Term | None:
        """A tree that is one term with whole powers, as such; None for others."""
        match of:
            case Fraction():
                return of, {}
            case str():
                return Fraction(1), {of: 1}
            case Power(Fraction() as base, n) if (base or n >= 0) and _length(base) * abs(
                n
            ) <= LONGEST:
                return base**n, {}
            case Power(str() as name, n) if n > 0:
                return Fraction(1), {name: n}
            case Product(parts):
                return self._term_of_product(parts)
        return None

    def _term_of_product(self, parts: Sequence[Tree]) -> Term | None:
        number, powers = Fraction(1), dict[str, int]()
        for part in parts:
            term = self._term(part)
            if term is None:
                return None
            number *= term[0]
            for name, n in term[1].items():
                powers[name] = powers.get(name, 0) + n
            if _length(number) > LONGEST or any(n > HIGHEST_DEGREE for n in powers.values()):
                raise TooLargeError
        return number, powers

    def _gather_terms(self, terms: Sequence[Term]) -> RationalFunction:
        """The sum of terms."""
        at = {name: i for i, name in enumerate(self.ring)}
        total, below = dict[tuple[int, ...], Fraction](), 1
        for number, powers in terms:
            self._spend(4)
            exponents = [0] * max(len(at), 1)
            for name, n in powers.items():
                exponents[at[name]] = n
            key = tuple(exponents)
            total[key] = total.get(key, Fraction(0)) + number
            below = lcm(below, number.denominator)
            if below.bit_length() > LONGEST:
                raise TooLargeError
        whole = {key: int(number * below) for key, number in total.items() if number}
        return self.ratio(self.one.context().from_dict(whole), self.one * below)

    def _spend(self, work: float) -> None:
        self.left -= STEP + work * (1 + len(self.ring) // 8)
        if self.left < 0:
            raise TooLargeError


def _over(num: fmpz_mpoly, den: fmpz_mpoly) -> RationalFunction:
    if den.is_zero():
        raise InputError("an expression divides by zero")
    return RationalFunction(num, den)


def _length(number: Fraction) -> int:
    return max(number.numerator.bit_length(), number.denominator.bit_length())


def _bits(polynomial: fmpz_mpoly) -> int:
    return max((abs(int(c)).bit_length() for c in polynomial.coeffs()), default=0)
