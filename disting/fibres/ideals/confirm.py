"""What one or more fibres show, checked without the search that found it.

The labels of the evidence stand for random primes and points (`fibre_ideal.drawn`).
"""

from collections.abc import Sequence

from flint import fmpz_mpoly, nmod_poly

from disting.algebra.groebner.macaulay import reaches_one
from disting.evidence.ideals import Refuted, Solved
from disting.fibres.ideals.fibre_ideal import agree, drawn, fibre_ideal
from disting.fibres.ideals.system import CoefficientMap, PolynomialMap, matched


def confirms(evidence: Solved | Refuted, left: CoefficientMap, right: CoefficientMap) -> bool:
    """Whether the evidence holds for these models, seen anew.

    A solution is put into both transfer functions. A refutation is found again by plain Macaulay
    matrices, which takes long and much memory for many unknowns and high degrees (10 unknowns,
    degree 5: minutes).
    """
    given, other = (left, right) if evidence.left_given else (right, left)
    if isinstance(evidence, Solved):
        runs = zip(evidence.labels, evidence.solutions, strict=True)
        return bool(evidence.labels) and all(_agree(given, other, label, q) for label, q in runs)
    return bool(evidence.labels) and all(
        _refuted(evidence, given, other, label) for label in evidence.labels
    )


def confirms_matched(evidence: Solved | Refuted, left: PolynomialMap, right: PolynomialMap) -> bool:
    """The same for maps whose coordinates can be compared, of whatever they are."""
    given, other = (left, right) if evidence.left_given else (right, left)
    if isinstance(evidence, Solved):
        runs = zip(evidence.labels, evidence.solutions, strict=True)
        return bool(evidence.labels) and all(
            len(q) == len(other.parameters) and agree(given, point, other, q, modulus)
            for (modulus, point), q in ((drawn(given, label), q) for label, q in runs)
        )
    ideals = (fibre_ideal(given, other, label, evidence.tangent) for label in evidence.labels)
    return bool(evidence.labels) and all(
        reaches_one(i.generators, len(i.unknowns), i.modulus, evidence.degree) for i in ideals
    )


def _agree(
    given: CoefficientMap, other: CoefficientMap, label: str, solution: Sequence[int]
) -> bool:
    if not len(other.parameters) <= len(solution) <= len(other.parameters) + 1:
        return False
    modulus, point = drawn(given, label)
    num1, den1 = _at(given, point, modulus)
    num2, den2 = _at(other, solution[: len(other.parameters)], modulus)
    return den2.degree() == den1.degree() >= 0 and num1 * den2 == num2 * den1


def _at(model: CoefficientMap, point: Sequence[int], modulus: int) -> tuple[nmod_poly, nmod_poly]:
    def value(polynomial: fmpz_mpoly) -> int:
        """Its value at the point, modulo the prime."""
        return int(polynomial(*point)) % modulus

    num, den = (
        [value(p) for p in polynomials] for polynomials in (model.numerator, model.denominator)
    )
    return nmod_poly(num, modulus), nmod_poly(den, modulus)


def _refuted(evidence: Refuted, given: CoefficientMap, other: CoefficientMap, label: str) -> bool:
    ideal = fibre_ideal(*matched(given, other), label, evidence.tangent)
    return reaches_one(ideal.generators, len(ideal.unknowns), ideal.modulus, evidence.degree)
