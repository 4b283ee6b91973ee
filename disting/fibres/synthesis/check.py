"""Candidates multiplied out: the coefficients of the chain's receptance, and their derivatives,
as balls.
"""

from dataclasses import dataclass

from flint import acb, acb_poly

from disting.behaviour.transfer import Rational, plain_receptance, receptance
from disting.fibres.synthesis.ball import TOLERANCE, Ball, Imprecise
from disting.fibres.synthesis.branch_ends import NONZERO, Dead
from disting.fibres.synthesis.target import Exact, Target
from disting.model.chain import Chain


@dataclass(frozen=True, slots=True)
class Checked:
    """Parameter values whose receptance agrees with the target within the balls; `width` as in
    Solution.
    """

    values: dict[str, Ball]
    gauges: int
    width: float


def evaluated(chain: Chain, values: dict[str, Ball]) -> Rational:
    """Receptance and gradients over balls."""
    return receptance(chain.structure, _lifted(values), acb_poly([0, 1]), acb_poly([1]))


def checked(chain: Chain, values: dict[str, Ball], gauges: int, target: Target) -> Checked | Dead:
    """Compare every coefficient, the denominator made monic; a ball without the given
    coefficient refutes the candidate.
    """
    num, den = plain_receptance(chain.structure, _lifted(values), acb_poly([0, 1]), acb_poly([1]))
    lead = den[den.degree()]
    width = 0.0
    for ours, given in ((num, target.numerator), (den, target.denominator)):
        largest = max(abs(c) for c in given.coeffs())
        for i, coefficient in enumerate(_padded(given, ours.degree())):
            gap = ours[i] / lead - acb(coefficient)
            if not gap.is_finite():
                raise Imprecise("a coefficient is not finite")
            if not gap.contains(0):
                return NONZERO
            width = max(width, float(gap.abs_upper() / acb(coefficient or largest).abs_lower()))
    if width > TOLERANCE:
        raise Imprecise("a solution is not sharp enough")
    return Checked(values, gauges, width)


def _padded(given: Exact, degree: int) -> list[Exact]:
    return [given[i] for i in range(max(degree, given.degree()) + 1)]


def _lifted(values: dict[str, Ball]) -> dict[str, acb_poly]:
    return {name: acb_poly([value]) for name, value in values.items()}
