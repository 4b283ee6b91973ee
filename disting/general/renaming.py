"""Condition 6 for general models: functions in which a renaming of the parameters is seen by
colours, and its proof by comparing polynomials.

Both transfer functions are in lowest terms over the integers, so a renaming carries coefficients
into coefficients, all of them or none with the sign changed. The functions c_i a_m (a_m the
leading denominator coefficient) are then the same, whatever the sign and without any division, and
colour refinement looks at them, modulo a prime: columns that differ there are different, so no
renaming is missed, and one that is found is proven exactly.
"""

from disting.general.model import Model, Terms
from disting.general.samples import evaluated


def is_renaming(left: Model, right: Model, renaming: dict[str, str]) -> bool:
    """Whether renaming the left parameters, one to one, turns the left transfer function into
    the right one: exact.
    """
    if sorted(renaming) != sorted(left.parameters) or sorted(renaming.values()) != sorted(
        right.parameters
    ):
        return False
    sources = [
        {there: i for i, there in enumerate(map(renaming.__getitem__, left.parameters))}[q]
        for q in right.parameters
    ]
    sides = [(*m.numerator_terms, *m.denominator_terms) for m in (left, right)]
    moved = [_permuted(terms, sources) for terms in sides[0]]
    there = [dict(terms) for terms in sides[1]]
    negated = [{e: -c for e, c in terms.items()} for terms in there]
    return left.degrees == right.degrees and moved in (there, negated)


def _permuted(terms: Terms, sources: list[int]) -> dict[tuple[int, ...], int]:
    return {tuple(exponents[i] for i in sources): number for exponents, number in terms}


def products(
    model: Model, point: list[int], modulus: int
) -> tuple[tuple[int, ...], list[tuple[int, ...]]]:
    """Values and Jacobian columns of the functions c_i a_m at a point without zeros."""
    coefficients = (*model.numerator_terms, *model.denominator_terms)
    seen = [evaluated(terms, point, modulus) for terms in coefficients]
    lead, slopes = seen[-1]
    values = tuple(value * lead % modulus for value, _ in seen)
    rows = [
        [(g * lead + value * h) % modulus for g, h in zip(gradient, slopes, strict=True)]
        for value, gradient in seen
    ]
    return values, list(zip(*rows, strict=True))
