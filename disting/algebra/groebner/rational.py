"""Groebner bases over Q, and the finite algebra Q[x]/I of an ideal with finitely many zeros.

For a zero-dimensional ideal the monomials that no leading monomial divides are a basis of A =
Q[x]/I. If the powers 1, u, u^2, .. of a linear form u span A, then I = <f(u), x_i - g_i(u)>: every
zero of I is a root of f, and the coordinates follow from it. For a radical ideal nearly every u
does (Gianni and Mora 1989); an ideal becomes radical by the squarefree parts of the minimal
polynomials of all unknowns (Seidenberg 1974). All of this is exact; an unsuitable linear form is
detected and drawn again.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, cast

from flint import Ordering, fmpq, fmpq_mat, fmpq_poly, fmpz_mpoly, fmpz_mpoly_ctx, fmpz_mpoly_vec

from disting.algebra.certainty import residues
from disting.algebra.groebner.modular import Sparse

FORMS = 5  # linear forms that are tried
Vector = dict[tuple[int, ...], fmpq]
"""Exponents of the unknowns and integer coefficient of each term."""


class TooLarge(Exception):
    """A computation that grew beyond its bounds."""


@dataclass(frozen=True, slots=True)
class Bounds:
    """Largest number of polynomials, of terms of one and of bits of a coefficient, and largest
    dimension of the algebra.
    """

    polynomials: int = 80
    terms: int = 120
    bits: int = 2000
    dimension: int = 40


@dataclass(frozen=True, slots=True)
class Shape:
    """f and g_1, g_2, ..: the zeros are (g_1(u), g_2(u), ..), u the roots of f."""

    polynomial: fmpq_poly
    coordinates: tuple[fmpq_poly, ...]


@dataclass(frozen=True)
class Basis:
    """Reduced Groebner basis in degree reverse lexicographic order; `size` unknowns."""

    polynomials: tuple[fmpz_mpoly, ...]
    size: int

    @property
    def is_one(self) -> bool:
        """True if there is no zero, not even a complex one."""
        return any(p.is_constant() for p in self.polynomials)

    @cached_property
    def leads(self) -> dict[tuple[int, ...], fmpz_mpoly]:
        """Polynomials by leading monomial."""
        return {tuple(map(int, p.monoms()[0])): p for p in self.polynomials}

    @property
    def free(self) -> list[int]:
        """Unknowns without a power among the leading monomials: no polynomial in such an
        unknown alone is in the ideal.
        """
        powers = {
            next(i for i, e in enumerate(m) if e) for m in self.leads if sum(map(bool, m)) == 1
        }
        return [i for i in range(self.size) if i not in powers]


def basis(generators: Sequence[Sparse], size: int, bounds: Bounds) -> Basis:
    """Groebner basis of the ideal of the generators; raises TooLarge."""
    context = fmpz_mpoly_ctx.get(tuple(f"x{i}" for i in range(size)), Ordering.degrevlex)
    vector = fmpz_mpoly_vec([context.from_dict(p) for p in generators], context)
    limits = (bounds.polynomials, bounds.terms, bounds.bits)
    grown, done = cast("Any", vector).buchberger_naive(limits=limits)
    if not done:
        raise TooLarge("the Groebner basis grows beyond its bounds")
    reduced = grown.autoreduction(groebner=True)
    return Basis(tuple(p for p in reduced if not p.is_zero()), size)


def shape(generators: Sequence[Sparse], size: int, bounds: Bounds, seed: str) -> Shape | None:
    """The shape of an ideal with finitely many zeros, or None if no linear form that was tried
    shows it; raises TooLarge.
    """
    algebra = Algebra(basis(generators, size, bounds), bounds)
    by_form = algebra.shape(seed)
    if by_form:
        return by_form
    radical = [*generators, *algebra.squarefree()]
    return Algebra(basis(radical, size, bounds), bounds).shape(seed)


class Algebra:
    """Q[x]/I with its basis of monomials; raises TooLarge beyond the bounds."""

    def __init__(self, ideal: Basis, bounds: Bounds) -> None:
        self.ideal = ideal
        self._forms: dict[tuple[int, ...], Vector] = {}
        self.monomials = self._standard(bounds.dimension)
        self._at = {m: i for i, m in enumerate(self.monomials)}

    def shape(self, seed: str) -> Shape | None:
        """The shape in the first linear form whose powers span the algebra."""
        unknowns = [self._matrix(i) for i in range(self.ideal.size)]
        unit = self._column({(0,) * self.ideal.size: fmpq(1)})
        for k in range(FORMS):
            weights = residues(f"form:{seed}:{k}", self.ideal.size, 8 << k)
            form = sum(
                (w * m for w, m in zip(weights[1:], unknowns[1:], strict=True)), 0 * unknowns[0]
            )
            powers = [unit]
            for _ in self.monomials:
                powers.append(form * powers[-1])
            if by_form := self._solve_basis(powers, [m * unit for m in unknowns]):
                return by_form
        return None

    def squarefree(self) -> list[Sparse]:
        """Squarefree parts of the minimal polynomials of the unknowns."""
        polynomials = []
        for i in range(self.ideal.size):
            least = self._matrix(i).minpoly()
            part = (least // least.gcd(least.derivative())).numer()
            polynomials.append(
                {_unit(i, k, self.ideal.size): int(c) for k, c in enumerate(part.coeffs()) if c}
            )
        return polynomials

    def _solve_basis(self, powers: list[fmpq_mat], unknowns: list[fmpq_mat]) -> Shape | None:
        """Each unknown and the last power in the powers before it, if these are a basis."""
        n = len(self.monomials)
        krylov = _side_by_side(powers[:n], n)
        if krylov.rank() < n:
            return None
        wanted = [*unknowns, powers[n]]
        parts = krylov.solve(_side_by_side(wanted, n))
        parametrised = [fmpq_poly([parts[i, j] for i in range(n)]) for j in range(len(wanted))]
        return Shape(fmpq_poly([0] * n + [1]) - parametrised[-1], tuple(parametrised[:-1]))

    def _standard(self, limit: int) -> list[tuple[int, ...]]:
        """The monomials that no leading monomial divides."""
        monomials, edge = list[tuple[int, ...]](), [(0,) * self.ideal.size]
        while edge:
            monomials += edge
            if len(monomials) > limit:
                raise TooLarge(f"more than {limit} solutions")
            grown = {_times(m, i) for m in edge for i in range(self.ideal.size)}
            edge = sorted(m for m in grown if not self._is_reducible(m))
        return monomials

    def _is_reducible(self, monomial: tuple[int, ...]) -> bool:
        return any(
            all(a <= b for a, b in zip(lead, monomial, strict=True)) for lead in self.ideal.leads
        )

    def _matrix(self, unknown: int) -> fmpq_mat:
        """Multiplication by an unknown."""
        columns = [self._column(self._form(_times(m, unknown))) for m in self.monomials]
        return _side_by_side(columns, len(self.monomials))

    def _column(self, vector: Vector) -> fmpq_mat:
        return fmpq_mat([[vector.get(m, fmpq(0))] for m in self.monomials])

    def _form(self, monomial: tuple[int, ...]) -> Vector:
        """Normal form of a monomial next to the standard ones."""
        if monomial in self._at:
            return {monomial: fmpq(1)}
        if monomial not in self._forms:
            self._forms[monomial] = (
                self._tail(monomial)
                if monomial in self.ideal.leads
                else self._reduce_monomial(monomial)
            )
        return self._forms[monomial]

    def _tail(self, lead: tuple[int, ...]) -> Vector:
        terms = {tuple(map(int, e)): c for e, c in self.ideal.leads[lead].to_dict().items()}
        top = terms.pop(lead)
        return {e: fmpq(-c) / top for e, c in terms.items()}

    def _reduce_monomial(self, monomial: tuple[int, ...]) -> Vector:
        """x_i times the normal form of monomial / x_i, which is smaller and not standard."""
        lower = ((i, _times(monomial, i, -1)) for i, e in enumerate(monomial) if e)
        i, smaller = next((i, m) for i, m in lower if m not in self._at)
        total: Vector = {}
        for standard, factor in self._form(smaller).items():
            for e, c in self._form(_times(standard, i)).items():
                total[e] = total.get(e, fmpq(0)) + factor * c
        return total


def _side_by_side(columns: Sequence[fmpq_mat], height: int) -> fmpq_mat:
    return fmpq_mat([[column[i, 0] for column in columns] for i in range(height)])


def _times(monomial: tuple[int, ...], unknown: int, power: int = 1) -> tuple[int, ...]:
    return (*monomial[:unknown], monomial[unknown] + power, *monomial[unknown + 1 :])


def _unit(unknown: int, power: int, size: int) -> tuple[int, ...]:
    return tuple(power if i == unknown else 0 for i in range(size))
