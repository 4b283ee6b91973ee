"""Polynomials in the parameters p of a given model and the unknowns q of a searched one, and the
signs that are obvious.

Over positive numbers a polynomial whose coefficients all have one sign has this sign everywhere,
and so has a x^2 + b x + c with a, c of one sign and 4 a c - b^2 > 0 everywhere. Over real numbers
the same holds for one in which all exponents are even, coefficients have one sign and some term
contains no unknown: it has this sign for all q and all p without zeros. Over complex numbers only
constants have a sign, which then means that they are nonzero. Polynomials in the p alone that are
not zero vanish on no open set; they are passed over and listed by whoever rests on that.
"""

from collections.abc import Iterable
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property, reduce
from operator import mul
from typing import Any

from flint import Ordering, fmpz_mpoly, fmpz_mpoly_ctx

from disting.algebra.symbols import RationalFunction, factorise
from disting.general.matrix_model import AnyModel, Model, Terms
from disting.model.question import Domain

QUADRATIC = 2
SQUARES = 2  # discriminants of discriminants
LARGEST = 10_000  # terms of a discriminant before like ones are collected
Parts = tuple[int, tuple[fmpz_mpoly, ...]]
"""A sign and distinct irreducible factors whose signs are not known: their product has the sign of
a polynomial, or is zero.
"""


class TooMuch(Exception):
    """More cases or terms than the bounds allow."""


@dataclass(frozen=True, slots=True)
class Effort:
    """Effort of the search for equivalents: `points` of either model, with all equivalents listed
    for `listed` of them, number of `orders` of the unknowns, combinations of equations by products
    of this `degree`, number of `parts` of either network, elimination of this number of `unknowns`
    at most, and in each step at most this number of `terms` of polynomials that are factored or
    substituted into each other (None: unlimited).
    """

    points: int = 40
    listed: int = 24
    orders: int = 24
    degree: int = 2
    parts: int = 12
    unknowns: int | None = None
    terms: int | None = None


THOROUGH = Effort()
BRIEF = Effort(points=10, listed=3, orders=6, degree=1, parts=0, unknowns=9, terms=5_000)
"""So far searches a shipped family that has thousands of pairs."""


@dataclass(frozen=True)
class Orthant:
    """The ring Z[p, q, t] with its admissible values; t is a path's parameter, positive like
    the rest (see `intermediate_value`).
    """

    n_given: int
    n_unknown: int
    domain: Domain
    terms: int = 400  # of one polynomial: factoring stays a matter of milliseconds
    degree: int = 40
    effort: Effort = THOROUGH
    spent: list[int] = field(default_factory=lambda: [0], compare=False)  # terms of this step

    @cached_property
    def context(self) -> fmpz_mpoly_ctx:
        """FLINT's ring."""
        names = (
            [f"p{i}" for i in range(self.n_given)]
            + [f"q{i}" for i in range(self.n_unknown)]
            + ["t"]
        )
        return fmpz_mpoly_ctx.get(tuple(names), Ordering.degrevlex)

    @cached_property
    def generators(self) -> tuple[fmpz_mpoly, ...]:
        """p, q and t."""
        return tuple(self.context.gens())

    @property
    def unknowns(self) -> range:
        """Positions of the q."""
        return range(self.n_given, self.n_given + self.n_unknown)

    @property
    def path(self) -> int:
        """Position of t."""
        return self.n_given + self.n_unknown

    def number(self, value: int) -> fmpz_mpoly:
        """A constant."""
        return self.context.constant(value)

    def lifted(self, terms: Terms, first: int) -> fmpz_mpoly:
        """A polynomial whose variables become those from position `first`."""
        size = self.path + 1
        return self.context.from_dict(
            {(*[0] * first, *e, *[0] * (size - first - len(e))): c for e, c in terms}
        )

    def equations(self, model: AnyModel, other: AnyModel) -> list[fmpz_mpoly]:
        """u_2(q) v_1(p) = u_1(p) v_2(q) for all invariants u/v: the same transfer function, for
        generic p (see `cases`).
        """
        polynomials: list[fmpz_mpoly] = []
        for own_model, searched in zip(model.entries, other.entries, strict=True):
            own_functions, other_functions = (
                self._invariants(own_model, 0),
                self._invariants(searched, self.n_given),
            )
            every = (
                b.num * a.den - a.num * b.den
                for a, b in zip(own_functions, other_functions, strict=True)
            )
            polynomials += [e for e in every if e not in polynomials]
        return polynomials

    def monic(self, model: AnyModel) -> list[RationalFunction]:
        """All coefficients over the leading one, in the p."""
        functions: list[RationalFunction] = []
        for entry in model.entries:
            sides = [self.lifted(c, 0) for c in (*entry.numerator_terms, *entry.denominator_terms)]
            every = (RationalFunction(c, sides[-1]) for c in sides[:-1])
            functions += [ratio for ratio in every if ratio not in functions]
        return functions

    def _invariants(self, model: Model, first: int) -> list[RationalFunction]:
        """Coefficients of G over the leading one, the numerator without the multiple of the
        denominator that G is at s = oo.
        """
        top, bottom = (
            [self.lifted(c, first) for c in side]
            for side in (model.numerator_terms, model.denominator_terms)
        )
        lead = bottom[-1]
        monic = [RationalFunction(c, lead) for c in bottom[:-1]]
        if len(top) != len(bottom):
            return [*(RationalFunction(c, lead) for c in top), *monic]
        rest = [b * lead - top[-1] * a for a, b in zip(bottom[:-1], top[:-1], strict=True)]
        return [
            RationalFunction(top[-1], lead),
            *(RationalFunction(c, lead * lead) for c in rest),
            *monic,
        ]

    def lead(self, other: AnyModel) -> fmpz_mpoly:
        """Leading denominator coefficients of the searched model, multiplied."""
        leads = dict.fromkeys(entry.denominator_terms[-1] for entry in other.entries)
        return self.product(self.lifted(lead, self.n_given) for lead in leads)

    def occurring(self, polynomials: Iterable[fmpz_mpoly]) -> list[int]:
        """Positions of the unknowns that occur in any of the polynomials."""
        degrees = [p.degrees() for p in polynomials]
        return [i for i in self.unknowns if any(d[i] for d in degrees)]

    def sign(self, polynomial: fmpz_mpoly) -> int:
        """1 or -1 where it has this sign for all admissible values (see above), 0 where that is not
        found.
        """
        if self.domain is Domain.COMPLEX and not polynomial.is_constant():
            return 0
        terms = polynomial.to_dict()
        signs = {1 if c > 0 else -1 for c in terms.values()}
        if len(signs) != 1:
            return self._by_squares(polynomial) if self.domain is Domain.POSITIVE else 0
        if self.domain is Domain.REAL:
            even = all(e % 2 == 0 for exponents in terms for e in exponents)
            if not even or all(any(exponents[i] for i in self.unknowns) for exponents in terms):
                return 0
        return signs.pop()

    def _by_squares(self, polynomial: fmpz_mpoly, depth: int = SQUARES) -> int:
        """The sign of a polynomial of mixed terms that is quadratic in a variable, if its
        discriminant shows one.
        """
        if len(polynomial) > self.terms:
            return 0
        terms = [(e, c > 0) for e, c in polynomial.to_dict().items()]
        for at, degree in enumerate(polynomial.degrees()):
            if degree != QUADRATIC or len({up for e, up in terms if e[at] != 1}) > 1:
                continue
            c, b, a = self.coefficients(polynomial, at)
            if len(a) * len(c) + len(b) ** 2 > LARGEST or not c:
                continue
            rest = 4 * a * c - b**2
            if _of_terms(rest) > 0 or (depth > 1 and self._by_squares(rest, depth - 1) > 0):
                return _of_terms(a)
        return 0

    def parts(self, polynomial: fmpz_mpoly, odd: bool) -> Parts:
        """Sign and factors; `odd`: without factors of even multiplicity, which are not
        negative. Raises TooMuch.
        """
        self._spend(len(polynomial))
        if len(polynomial) > self.terms or polynomial.total_degree() > self.degree:
            raise TooMuch(
                f"a polynomial of {len(polynomial)} terms and degree {polynomial.total_degree()}"
            )
        number, factors = factorise(polynomial)
        sign, kept = 1 if number > 0 else -1, []
        for factor, power in factors:
            known = self.sign(factor)
            if known:
                sign *= known if power % 2 else 1
            elif power % 2 or not odd:
                kept.append(factor)
        return sign, tuple(kept)

    def begin(self) -> None:
        """A step begins, of which terms are counted."""
        self.spent[0] = 0

    def _spend(self, terms: int) -> None:
        self.spent[0] += terms
        if self.effort.terms is not None and self.spent[0] > self.effort.terms:
            raise TooMuch(f"more than {self.effort.terms} terms in one step")

    def product(self, factors: Iterable[fmpz_mpoly]) -> fmpz_mpoly:
        """Product, 1 of none."""
        return reduce(mul, factors, self.number(1))

    def coefficients(self, polynomial: fmpz_mpoly, at: int) -> list[fmpz_mpoly]:
        """Coefficients of the powers 0, 1, .. of one variable."""
        parts: dict[int, dict[tuple[int, ...], Any]] = {}
        for exponents, number in polynomial.to_dict().items():
            power = int(exponents[at])
            parts.setdefault(power, {})[(*exponents[:at], 0, *exponents[at + 1 :])] = number
        return [self.context.from_dict(parts.get(k, {})) for k in range(max(parts, default=0) + 1)]

    def put(
        self, polynomial: fmpz_mpoly, at: int, num: fmpz_mpoly, den: fmpz_mpoly
    ) -> tuple[fmpz_mpoly, int]:
        """den^d times the value at num/den of one variable, and the degree d in this variable."""
        self._spend(len(polynomial))
        coefficients = self.coefficients(polynomial, at)
        degree = len(coefficients) - 1
        if len(polynomial) * len(num) ** min(degree, 2) > 100 * self.terms:
            raise TooMuch(
                f"a fraction of {len(num)} terms put into a polynomial of {len(polynomial)}"
            )
        total, power = self.number(0), self.number(1)
        for c in reversed(coefficients):
            total, power = total * num + c * power, power * den
        return total, degree


def _of_terms(polynomial: fmpz_mpoly) -> int:
    """The sign that all coefficients have, 0 if there are two."""
    signs = {1 if c > 0 else -1 for c in polynomial.coeffs()}
    return signs.pop() if len(signs) == 1 else 0


def value_at(polynomial: fmpz_mpoly, point: dict[int, Fraction]) -> Fraction:
    """Value of a polynomial all of whose variables are given.

    >>> ring = Orthant(1, 1, Domain.POSITIVE)
    >>> p, q, _ = ring.generators
    >>> value_at(p * q**2 - 1, {0: Fraction(2), 1: Fraction(1, 2)})
    Fraction(-1, 2)
    """
    total = Fraction(0)
    for exponents, number in polynomial.to_dict().items():
        term = Fraction(int(number))
        for i, e in enumerate(exponents):
            if e:
                term *= point[i] ** int(e)
        total += term
    return total
