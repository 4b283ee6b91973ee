"""Results of one or more fibres, checked without the search that found them.

The labels of the evidence denote random primes and points (`fibre_ideal.draw_point`). The error
bound is that of labels that a seed draws (`safety_of`): labels that somebody chose bound nothing.

Contradictions by plain Macaulay matrices: slow, simple, and independent of the search for
Gröbner bases.

The span of the generators of degree up to D is multiplied by the variables, as long as a product
of degree up to D is new, elements whose degree fell included. If 1 lies in the span, there are no
common zeros.
"""

from collections.abc import Iterable, Sequence
from math import comb

from disting.algebra.groebner.modular import Sparse, matrix as modular_matrix
from disting.evidence.ideals import Refutation, Solutions
from disting.fibres.ideals.bounds import bits_of, safety_of_empty, safety_of_member
from disting.fibres.ideals.fibre_ideal import agree, draw_point, fibre_ideal
from disting.fibres.ideals.membership import SPARE, Limits, is_empty, labels_of
from disting.fibres.ideals.system import CoefficientMap, PolynomialMap, match_maps

PLAIN_MONOMIALS = 3000  # that plain elimination can bear
AGAIN = Limits(seconds=1800.0, entries=10**9, safety=1)  # of a contradiction that is found again


def reaches_one(generators: Iterable[Sparse], size: int, modulus: int, degree: int) -> bool:
    """Return True if 1 is found in that degree.

    >>> reaches_one([{(1, 1): 1, (0, 0): -1}, {(1, 0): 1}], 2, 101, 2)
    True
    """
    rows = [dict(g) for g in generators if max(map(sum, g)) <= degree]
    multiplied: set[tuple[int, ...]] = set()
    while True:
        rows = _echelon(rows, modulus)
        fresh = [row for row in rows if _lead(row) not in multiplied and sum(_lead(row)) < degree]
        if any(not any(_lead(row)) for row in rows):
            return True
        if not fresh:
            return False
        multiplied |= {_lead(row) for row in fresh}
        rows += [{_times(e, i): c for e, c in row.items()} for row in fresh for i in range(size)]


def _lead(row: Sparse) -> tuple[int, ...]:
    return max(row, key=_rank)


def _rank(exponents: tuple[int, ...]) -> tuple[int, tuple[int, ...]]:
    return sum(exponents), exponents


def _times(exponents: tuple[int, ...], at: int) -> tuple[int, ...]:
    return tuple(e + (i == at) for i, e in enumerate(exponents))


def _echelon(
    rows: list[dict[tuple[int, ...], int]], modulus: int
) -> list[dict[tuple[int, ...], int]]:
    columns = sorted({e for row in rows for e in row}, key=_rank, reverse=True)
    table = [row.get(e, 0) % modulus for row in rows for e in columns]
    matrix, rank = modular_matrix(len(rows), len(columns), table, modulus).rref()
    return [
        {e: int(matrix[i, j]) for j, e in enumerate(columns) if int(matrix[i, j])}
        for i in range(rank)
    ]


def find_again(
    evidence: Solutions | Refutation,
    left: PolynomialMap,
    right: PolynomialMap,
    limits: Limits = AGAIN,
) -> bool:
    """Return True if the solutions fit and the contradictions are found again, for maps whose
    coordinates can be compared: by plain elimination, or, where that is too large, by the fast one
    at one fresh point, in the direction of the evidence.

    A contradiction of some degree is one of any larger degree too. Raises NotSeenError where none
    is found within the limits.
    """
    if isinstance(evidence, Refutation) and evidence.degree < 0:
        return False
    unknowns = max(len(left.parameters), len(right.parameters))
    if isinstance(evidence, Solutions) or _is_small(evidence.degree, unknowns):
        return confirms(evidence, left, right)
    return refuted_at(labels_of("verify", left, right, 1), evidence, left, right, limits)


def holds_for(
    evidence: Solutions | Refutation, left: CoefficientMap, right: CoefficientMap
) -> bool:
    """The same for the maps of any two models: of unequally many poles nothing is shown."""
    alike = left.degrees[1] == right.degrees[1]
    return alike and find_again(evidence, *match_maps(left, right))


def refuted_at(
    labels: Sequence[str],
    evidence: Refutation,
    left: PolynomialMap,
    right: PolynomialMap,
    limits: Limits = AGAIN,
) -> bool:
    """Return True if the fibre is empty at all of these labels, in the direction of the evidence;
    raises NotSeenError where that is not found within the limits.
    """
    model, other = (left, right) if evidence.left_given else (right, left)
    return all(
        is_empty(model, other, equal_rank=evidence.tangent, label=label, limits=limits)
        for label in labels
    )


def _is_small(degree: int, unknowns: int) -> bool:
    return degree <= PLAIN_MONOMIALS and comb(unknowns + degree, degree) <= PLAIN_MONOMIALS


def confirms(evidence: Solutions | Refutation, left: PolynomialMap, right: PolynomialMap) -> bool:
    """Return True if the evidence holds for these maps, whose coordinates can be compared
    (recomputed from scratch).

    A solution is put into both. A refutation is found again by plain Macaulay matrices, which takes
    long and much memory for many unknowns and high degrees (10 unknowns, degree 5: minutes).
    """
    model, other = (left, right) if evidence.left_given else (right, left)
    if isinstance(evidence, Solutions):
        runs = zip(evidence.labels, evidence.solutions, strict=True)
        return bool(evidence.labels) and all(
            len(q) == len(other.parameters) and agree(model, point, other, q, modulus)
            for (modulus, point), q in ((draw_point(model, label), q) for label, q in runs)
        )
    bits = bits_of(model, other, evidence.tangent)
    ideals = (fibre_ideal(model, other, label, evidence.tangent, bits) for label in evidence.labels)
    return bool(evidence.labels) and all(
        reaches_one(i.generators, len(i.unknowns), i.modulus, evidence.degree) for i in ideals
    )


def safety_of(
    evidence: Solutions | Refutation, left: PolynomialMap, right: PolynomialMap, seed: str
) -> int:
    """Bits b of the bound 2**-b on the error of evidence on two models of equal rank, as
    `membership.decide_matched` counts them; 0 where the seed does not draw its labels.

    Refutations have the first labels that are drawn, solutions those at which there is one.
    """
    count = len(evidence.labels)
    model, other = (left, right) if evidence.left_given else (right, left)
    most = SPARE * count if isinstance(evidence, Solutions) else count
    drawn_ones = labels_of(seed, left, right, most)
    named = [label for label in drawn_ones if label in set(evidence.labels)]
    if not count or tuple(named) != evidence.labels:
        return 0
    if isinstance(evidence, Solutions):
        return safety_of_member(model, other) * count - 1
    if not evidence.tangent:
        return 0
    return safety_of_empty(model, other, True, bits_of(model, other, True)) * count - 1
