"""From candidates to listed solutions: which are real, which are positive."""

from dataclasses import replace

from flint import arb

from disting.fibres.synthesis.ball import Ball
from disting.fibres.synthesis.confirm import Checked, confirmation
from disting.fibres.synthesis.result import Answer, Solution
from disting.fibres.synthesis.target import Target
from disting.model.chain import Chain

Values = dict[str, Ball]


def listed(
    chain: Chain, leaves: list[Checked], target: Target, *, complete: bool, confirm: bool
) -> tuple[Solution, ...]:
    """Solutions with their properties. A complete list is closed under conjugation; otherwise
    nothing is known to be real.

    `confirm`: whether those that are no members of a family are looked at by `confirmation`.
    """
    solutions = (
        _solution(c, [x.values for x in leaves if x is not c or not complete]) for c in leaves
    )
    return tuple(
        (
            replace(s, confirmation=confirmation(chain, s.values, target))
            if confirm and not s.gauges
            else s
        )
        for s in solutions
    )


def _solution(c: Checked, others: list[Values]) -> Solution:
    """`others` are the candidates for its conjugate; with itself among them nothing is proven."""
    real = _real(c.values, others)
    return Solution(
        values=c.values,
        real=real,
        positive=_positive(c.values, real),
        gauges=c.gauges,
        width=c.width,
    )


def _real(values: Values, others: list[Values]) -> Answer:
    """NO if an imaginary part leaves zero out; YES if the conjugate, a solution too, can be
    none of the others.
    """
    if not all(v.imag.contains(0) for v in values.values()):
        return Answer.NO
    conjugate = {name: v.conjugate() for name, v in values.items()}
    return Answer.UNKNOWN if any(_meets(conjugate, other) for other in others) else Answer.YES


def _meets(left: Values, right: Values) -> bool:
    return all(left[name].overlaps(right[name]) for name in left)


def _positive(values: Values, real: Answer) -> Answer:
    if real is Answer.NO or any(bool(v.real < arb(0)) for v in values.values()):
        return Answer.NO
    return real if all(bool(v.real > arb(0)) for v in values.values()) else Answer.UNKNOWN
