"""Which of the fitted candidates is selected, and what stands beside it.

Where some admissible candidates explain the data, the others are excluded by it. Of those left, the
one with the lowest cost on test is left for one with fewer parameters that loses to it by no more
than noise explains (`repeatability.margin`); those that are as near form the set of which one is
selected.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import exp, log

import numpy as np

from disting.fit.admissible import Rule
from disting.fit.cost import Cost
from disting.fit.each import explained, noises, repeatabilities
from disting.fit.estimate import Task
from disting.fit.explained import LARGEST, Explanation
from disting.fit.joint import AnyCost
from disting.fit.judged import Candidate
from disting.fit.noise import Noise
from disting.fit.plant import Real
from disting.fit.practical import Seen
from disting.fit.repeatability import margin
from disting.fit.scatter import Scatter


def akaike_weighted(candidates: Sequence[Candidate], task: Task) -> list[Candidate]:
    """Akaike weights among the admissible ones: exp(-AIC/2), AIC = sum n_y ln(J/n_y) + 2 N_p over
    the responses, each with its own variance; in all 1.
    """
    criteria = {
        c.chain: sum(n_y * log(max(j, 1e-300) / n_y) for j, n_y in _costs(c, task))
        + 2 * c.n_parameters
        for c in candidates
        if c.admissible
    }
    lowest = min(criteria.values(), default=0.0)
    sizes = {chain: exp((lowest - value) / 2) for chain, value in criteria.items()}
    total = sum(sizes.values())
    return [
        replace(c, akaike_weight=sizes[c.chain] / total) if c.chain in sizes else c
        for c in candidates
    ]


def _costs(candidate: Candidate, task: Task) -> list[tuple[float, int]]:
    """Cost on the training data and number of residuals of each response."""
    cost = task.cost
    if isinstance(cost, Cost):
        return [(candidate.j_train, cost.n_residuals)]
    p = np.array([candidate.estimate.parameters[n] for n in task.names(candidate.chain)])
    each = cost.by_residual(cost.residual(task.plant(candidate.chain).response(p)))
    return [(float(own @ own), own.size) for own in each]


@dataclass(frozen=True)
class Choice:
    """`candidates` in the order of the cost on test. `near`: those that lose to the best by no more
    than noise explains, the selected one first; the others as in `select.Selection`.
    """

    candidates: tuple[Candidate, ...]
    repeatability: Scatter
    explanation: Explanation
    selected: Candidate | None = None
    near: tuple[Candidate, ...] = ()
    margin: float = 0.0
    better: tuple[Candidate, ...] = ()


def choice(
    fitted: Sequence[Candidate], train: AnyCost, judging: AnyCost, seen: Scatter, rule: Rule
) -> Choice:
    """Which candidate is selected, and what stands beside it; `fitted` in the order of J on
    test, `train` and `judging` the costs on training data and on test.
    """
    typical = repeatabilities(train, judging, _best(fitted).residual)
    kept = _explaining([c for c in fitted if c.admissible])
    if not kept:
        return Choice(tuple(fitted), typical, _explained(fitted[0], judging, seen))
    sigma = judging.scatter(seen.rho)
    there = _left(kept[0], sigma, judging)
    noise = Noise(judging.scatter(typical.rho)) if rule is Rule.PAPER else there
    selected, allowed = _simplest(kept, noise)
    lowest = kept[0]
    near = [
        c for c in kept if c.j_test <= lowest.j_test + margin(c.residual, lowest.residual, there)
    ]
    return Choice(
        tuple(fitted),
        typical,
        _explained(selected, judging, seen),
        selected,
        (selected, *(c for c in near if c is not selected)),
        allowed,
        _better(selected, fitted, sigma, judging),
    )


def _explained(described: Candidate, judging: AnyCost, seen: Scatter) -> Explanation:
    return explained(judging, described.residual, described.missed, seen)


def _explaining(kept: list[Candidate]) -> list[Candidate]:
    """Those that explain the data, where any does. The costs do not see what a candidate misses at
    quiet lines when loud ones make the most of them; the standard deviations do.
    """
    return [c for c in kept if c.chi2 <= LARGEST] or kept


def _best(fitted: Sequence[Candidate]) -> Candidate:
    """The admissible candidate with the lowest J on test; of all, where none is admissible."""
    return next((c for c in fitted if c.admissible), fitted[0])


def _simplest(kept: Sequence[Candidate], noise: Seen) -> tuple[Candidate, float]:
    """The candidate with the fewest parameters that loses to the best by no more than its
    margin; then the lower cost.
    """
    lowest = kept[0]
    allowed = {c.chain: margin(c.residual, lowest.residual, noise) for c in kept}
    near = [
        c
        for c in kept
        if c is lowest
        or (c.n_parameters < lowest.n_parameters and c.j_test <= lowest.j_test + allowed[c.chain])
    ]
    winner = min(near, key=lambda c: (c.n_parameters, c.j_test))
    return winner, allowed[winner.chain]


def _better(
    selected: Candidate, fitted: Sequence[Candidate], sigma: Real, cost: AnyCost
) -> tuple[Candidate, ...]:
    """Excluded candidates that win against the selected one by more than their margin, those with
    few parameters first.

    The margin is that of the noise which they leave: what the selected one misses beside is no
    noise.
    """
    lower = [c for c in fitted if not c.admissible and c.j_test < selected.j_test]
    found = [
        c
        for c in lower
        if c.j_test < selected.j_test - margin(c.residual, selected.residual, _left(c, sigma, cost))
    ]
    return tuple(sorted(found, key=lambda c: (c.n_parameters, c.j_test)))


def _left(candidate: Candidate, sigma: Real, cost: AnyCost) -> Seen:
    """What a candidate leaves of the judged data, whose residuals scatter by `sigma`: what
    misses them widely is no noise.
    """
    if candidate.chi2 > LARGEST:
        return Noise(sigma)
    return noises(cost, candidate.residual, sigma, candidate.missed)
