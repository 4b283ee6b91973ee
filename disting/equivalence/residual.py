"""How well two parameter vectors agree: the coefficients of both transfer functions, in exact
or ball arithmetic.
"""

from collections.abc import Iterator, Mapping
from itertools import zip_longest
from typing import Any

from flint import acb, acb_poly, ctx, fmpq, fmpq_poly

from disting.behaviour.transfer import plain_receptance
from disting.model.chain import Chain

Number = Any  # fmpq or acb
BITS = 320  # of the evaluation; inputs of 15 digits leave far more than enough


def exactly_equal(left: Chain, a: Mapping[str, fmpq], right: Chain, b: Mapping[str, fmpq]) -> bool:
    """Whether two models at rational points have the same transfer function: exact, common
    factors do not matter.
    """
    one, s = fmpq_poly([1]), fmpq_poly([0, 1])
    (f_num, f_den), (g_num, g_den) = (
        plain_receptance(
            chain.structure, {name: fmpq_poly([v]) for name, v in values.items()}, s, one
        )
        for chain, values in ((left, a), (right, b))
    )
    return bool(f_num * g_den == g_num * f_den)


def difference(left: Chain, a: Mapping[str, fmpq], right: Chain, b: Mapping[str, Number]) -> float:
    """Upper bound of the largest relative difference of a coefficient, denominators made monic.

    Relative to the coefficient of the left model, or to its largest one where that coefficient is
    zero.
    """
    with ctx.workprec(BITS):
        pairs = zip(_coefficients(left, a), _coefficients(right, b), strict=True)
        return max(_relative(*pair) for pair in pairs)


def _coefficients(chain: Chain, values: Mapping[str, Number]) -> Iterator[list[acb]]:
    """Numerator and denominator, coefficients from low to high."""
    lifted = {name: acb_poly([acb(value)]) for name, value in values.items()}
    num, den = plain_receptance(chain.structure, lifted, acb_poly([0, 1]), acb_poly([1]))
    lead = den[den.degree()]
    for p in (num, den):
        yield [p[i] / lead for i in range(den.degree() + 1)]


def _relative(given: list[acb], ours: list[acb]) -> float:
    largest = max((c.abs_upper() for c in given), key=float)
    worst = 0.0
    for a, b in zip_longest(given, ours, fillvalue=acb(0)):
        scale = largest if a.contains(0) else a.abs_lower()
        worst = max(worst, float((a - b).abs_upper() / scale))
    return worst
