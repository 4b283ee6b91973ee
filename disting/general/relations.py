"""Quadratic equations between the coefficients of transfer functions that hold for all values of
two models, such as a_1 b_0 = a_0 b_1 of machines that nothing holds: two models whose functions are
the same have them in common.

They are guessed from values modulo a prime and put in exactly: what is found is true.
"""

from collections.abc import Sequence
from fractions import Fraction
from functools import lru_cache
from itertools import combinations_with_replacement
from typing import Any

from flint import fmpz_mpoly, nmod_mat

from disting.algebra.certainty import prime, residues
from disting.general.matrix_model import Model, Terms

REMEMBERED = 256
MOST = 140  # products of two coefficients, and
MOST_TERMS = 1000  # of both models: few models that large are met, and none of their equations
SPARE = 8  # more points than unknowns
SMALL = 1 << 28  # of numerators and denominators of their numbers
Relation = tuple[tuple[tuple[int, int], Fraction], ...]
"""Numbers by pairs of coefficients, of which the products are taken."""


def coefficients(model: Model) -> list[Terms]:
    """All of them, the leading one of the denominator first, those of the numerator last."""
    return [*reversed(model.denominator_terms), *model.numerator_terms]


@lru_cache(maxsize=REMEMBERED)
def relations(left: Model, right: Model) -> tuple[Relation, ...]:
    """A basis of the quadratic forms that are zero at the coefficients of both, those left out that
    are always zero; none are searched between many coefficients.

    >>> from disting.general.any_model import of_network
    >>> from disting.network import network_of
    >>> free = of_network(network_of("1=2, 1=3; F1; S2"))
    >>> [relation] = relations(free, free)
    >>> [(i, j, str(number)) for (i, j), number in relation]
    [(3, 5, '-1'), (4, 6, '1')]
    """
    count = sum(map(bool, coefficients(left)))
    pairs = list(combinations_with_replacement(range(count), 2))
    if (
        len(pairs) > MOST
        or sum(len(t) for m in (left, right) for t in coefficients(m)) > MOST_TERMS
    ):
        return ()
    modulus, rows = prime("relations"), []
    for side, model in enumerate((left, right)):
        for k in range(len(pairs) // 2 + SPARE):
            point = residues(f"relations:{side}:{k}", len(model.parameters), modulus)
            drawn = [_value(terms, point, modulus) for terms in coefficients(model) if terms]
            rows.append([drawn[i] * drawn[j] % modulus for i, j in pairs])
    return tuple(
        relation
        for line in _kernel(rows, modulus)
        if (relation := _lift_relation(line, pairs, modulus))
        and all(_holds(relation, model) for model in (left, right))
    )


@lru_cache(maxsize=REMEMBERED)
def dimension_at_most(model: Model) -> int:
    """A bound of the dimension of its transfer functions: the number of ratios of coefficients less
    that of independent equations between them, computed modulo a prime.

    >>> dimension_at_most(Model.from_transfer_function(["1"], ["1", "a + b", "a*b"]))
    2
    """
    own_relations, modulus = relations(model, model), prime("relations")
    point = residues("dimension", len(model.parameters), modulus)
    at = [Fraction(_value(t, point, modulus)) for t in coefficients(model) if t]
    slopes = [[slope(r, at, i, Fraction(0)) for i in range(len(at))] for r in own_relations]
    rows = [[x.numerator * pow(x.denominator, -1, modulus) % modulus for x in r] for r in slopes]
    return len(at) - 1 - (nmod_mat(rows, modulus).rank() if rows else 0)


@lru_cache(maxsize=REMEMBERED)
def dimension_at_least(model: Model) -> int:
    """The rank of the coefficients and their derivatives, less 1, at a point modulo a prime: the
    dimension of what they are up to a common factor is not smaller.

    >>> dimension_at_least(Model.from_transfer_function(["1"], ["1", "a + b", "a*b"]))
    2
    """
    modulus = prime("relations")
    point = residues("rank", len(model.parameters), modulus)
    other_rows = [terms for terms in coefficients(model) if terms]
    rows = [[_value(terms, point, modulus) for terms in other_rows]]
    for i in range(len(point)):
        rows.append([_value(_derivative(terms, i), point, modulus) for terms in other_rows])
    return int(nmod_mat(rows, modulus).rank()) - 1


def _derivative(terms: Terms, by: int) -> Terms:
    return tuple(
        ((*e[:by], e[by] - 1, *e[by + 1 :]), number * e[by]) for e, number in terms if e[by]
    )


def slope(relation: Relation, at: Sequence[Any], by: int, zero: Any) -> Any:
    """The derivative of a quadratic form by one variable."""
    total = zero
    for (i, j), number in relation:
        for first, second in ((i, j), (j, i)):
            if first == by:
                total += at[second] * number.numerator / number.denominator
    return total


def _value(terms: Terms, point: Sequence[int], modulus: int) -> int:
    total = 0
    for exponents, number in terms:
        term = int(number)
        for x, e in zip(point, exponents, strict=True):
            if e:
                term = term * pow(x, int(e), modulus) % modulus
        total += term
    return total % modulus


def _kernel(rows: list[list[int]], modulus: int) -> list[list[int]]:
    """Basis of the vectors orthogonal to all rows, one vector for each column without a pivot."""
    reduced, rank = nmod_mat(rows, modulus).rref()
    width = len(rows[0])
    pivots = [next(j for j in range(width) if int(reduced[i, j])) for i in range(rank)]
    the_rows = []
    for free in sorted({*range(width)} - {*pivots}):
        line = [0] * width
        line[free] = 1
        for i, at in enumerate(pivots):
            line[at] = -int(reduced[i, free]) % modulus
        the_rows.append(line)
    return the_rows


def _lift_relation(
    line: Sequence[int], pairs: Sequence[tuple[int, int]], modulus: int
) -> Relation | None:
    """Small fractions with these remainders."""
    the_pairs = []
    for pair, residue in zip(pairs, line, strict=True):
        if residue:
            number = _fraction(residue, modulus)
            if number is None:
                return None
            the_pairs.append((pair, number))
    return tuple(the_pairs)


def _fraction(residue: int, modulus: int) -> Fraction | None:
    """By Euclid's algorithm."""
    (a, x), (b, y) = (modulus, 0), (residue, 1)
    while b > SMALL:
        (a, x), (b, y) = (b, y), (a - a // b * b, x - a // b * y)
    return Fraction(b, y) if 0 < abs(y) <= SMALL else None


def _holds(relation: Relation, model: Model) -> bool:
    """Return True if the relation holds for all values."""
    sides = [*reversed(model.denominator), *model.numerator]
    polynomials = [c for c in sides if not c.is_zero()]
    total: fmpz_mpoly = polynomials[0] * 0
    common = 1
    for _, number in relation:
        common *= number.denominator
    for (i, j), number in relation:
        total += polynomials[i] * polynomials[j] * int(number * common)
    return bool(total.is_zero())
