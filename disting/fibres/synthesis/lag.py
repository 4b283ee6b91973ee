"""A first-order lag: H = H0/(1 + T1 s), so -1/T1 is one of the poles of H, and H0 = H (1 + T1 s).

Without any damper H0 is a function of s^2, and the denominator of H, monic, is (s + 1/T1) E(s^2):
its odd part is s E, its even part E/T1, which gives T1 as a fraction.
"""

from collections.abc import Iterator
from dataclasses import replace

from flint import acb, ctx, fmpq, fmpq_poly

from disting.fibres.synthesis.ball import Ball, poly, product, roots, shifted
from disting.fibres.synthesis.receptance import Receptance
from disting.fibres.synthesis.result import Answer, Fibre, Solution
from disting.fibres.synthesis.target import Target
from disting.model.chain import Chain


def lag_poles(data: Receptance, low: int) -> Iterator[tuple[Receptance, dict[str, Ball]]]:
    """Yield H0 and T1 for every pole but that at 0, of multiplicity `low`."""
    poles = roots(shifted(data.denominator, -low), data.denominator.degree() - low)
    for i, p in enumerate(poles):
        rest = shifted(product(poles[:i] + poles[i + 1 :]), low)
        yield Receptance(data.numerator * poly([-1 / p]), rest), {"T1": -1 / p}


def without_lag(t: Target) -> tuple[Target, fmpq] | None:
    """H0 = H (1 + T1 s) as a function of s^2, and T1; None if there is no such T1."""
    odd = fmpq_poly([0 if i % 2 == 0 else c for i, c in enumerate(t.denominator.coeffs())])
    even = t.denominator - odd
    if not odd.degree() > even.degree() >= 0 or any(t.numerator.coeffs()[1::2]):
        return None
    time = 1 / even[even.degree()]
    denominator = even * time
    if denominator * fmpq_poly([0, 1]) != odd:
        return None
    return Target(t.numerator * time, denominator), time


def lagged(chain: Chain, found: Fibre, time: fmpq) -> Fibre:
    """The fibre of the undamped chain with its lag."""
    with ctx.workprec(max(found.precision_bits, ctx.prec)):
        return replace(found, solutions=tuple(_with(chain, s, acb(time)) for s in found.solutions))


def _with(chain: Chain, solution: Solution, time: Ball) -> Solution:
    """T1 is known exactly; an undamped solution that a Krawczyk step proves stays one."""
    values = {name: time if name == "T1" else solution.values[name] for name in chain.parameters}
    positive = solution.positive if time.real > 0 else Answer.NO
    return replace(solution, values=values, positive=positive)
