"""What fitted candidates are worth: criteria, standard errors, cost on data that no fit has
seen, chi2 per line.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from disting.fit.candidates import reference
from disting.fit.descent import fine
from disting.fit.each import noises, scatters, yardsticks
from disting.fit.estimate import Estimate, Task
from disting.fit.explained import chi2
from disting.fit.joint import AnyCost
from disting.fit.noise import expected
from disting.fit.plant import Complex, Real
from disting.fit.practical import Practical, Seen, practical
from disting.fit.scatter import Scatter
from disting.fit.structural import with_structure
from disting.model.chain import Chain
from disting.model.settings import Settings
from disting.model.shown import summary

FOLDS = 5  # of the cross-validation
AT_BOUND = 1e-6  # relative distance at which a parameter counts as being at its bound
WITNESSES = 5  # best candidates that help to see how much the data scatter

Scatters = tuple[Scatter, Scatter]
"""Scatter of the lines of the training data, and of those that candidates are judged by."""


@dataclass(frozen=True)
class Candidate:
    """A fitted candidate; `reasons` say why it is excluded, `residual` is that on the test data,
    shape (n_y,).

    `missed` = what it is expected to be and `chi2` per line, see `explained`; `noise` = covariance
    of the residuals on the training data, from which all standard errors follow.
    """

    chain: Chain
    estimate: Estimate
    practical: Practical
    j_test: float
    chi2: float
    at_bound: tuple[str, ...]
    residual: Real = field(repr=False, compare=False)
    missed: Real = field(repr=False, compare=False)
    noise: Seen = field(repr=False, compare=False)
    reasons: tuple[str, ...] = ()
    akaike_weight: float = 0.0

    def __repr__(self) -> str:
        excluded = f", excluded: {self.reasons[0]}" if self.reasons else ""
        return summary(
            self,
            f"{reference(self.chain)}, N_p = {self.n_parameters}, J = {self.j_test:.4g}{excluded}",
        )

    @property
    def admissible(self) -> bool:
        """Whether all criteria hold."""
        return not self.reasons

    @property
    def j_train(self) -> float:
        """Cost on the training data."""
        return self.estimate.j

    @property
    def n_parameters(self) -> int:
        """N_p: all parameters that the fit was free to choose."""
        return len(self.practical.names)

    @property
    def standard_errors(self) -> dict[str, float]:
        """Standard error of each fitted parameter, in its unit."""
        return {
            n: e * self.estimate.parameters[n] for n, e in self.practical.relative_errors.items()
        }


def judged(
    known: Mapping[Chain, Estimate], task: Task, test_cost: AnyCost | None, settings: Settings
) -> tuple[list[Candidate], Scatter]:
    """What each estimate is worth, in the order of the cost on test, and the scatter that it
    was judged by.
    """
    cost = test_cost or task.cost
    best = sorted(known.values(), key=lambda e: e.j)[:WITNESSES]
    inside = scatters(task.cost, [_response(e, task) for e in best])
    outside = yardsticks(task.cost, cost, [_response(e, replace(task, cost=cost)) for e in best])
    first = {c: _criteria(found, task, inside) for c, found in known.items()}
    criteria = with_structure({c: found for c, (found, _) in first.items()}, task, settings)
    fitted = [
        _candidate(found, criteria[c], first[c][1], task, test_cost, (inside, outside))
        for c, found in known.items()
    ]
    return sorted(fitted, key=lambda c: c.j_test), outside


def _response(found: Estimate, task: Task) -> Complex:
    return task.plant(found.chain).response(
        np.array([found.parameters[n] for n in task.names(found.chain)])
    )


def _criteria(found: Estimate, task: Task, known: Scatter) -> tuple[Practical, Seen]:
    """The criteria at the optimum, of the parameters that are free, and what the residuals
    there are like.
    """
    chain, names = found.chain, task.names(found.chain)
    p = np.array([found.parameters[n] for n in names])
    free = task.box(names).free
    residual, columns = task.cost.of(task.plant(chain), p)
    sigma = task.cost.scatter(known.rho)
    there = noises(task.cost, residual, sigma, expected(columns[:, free], sigma))
    return (
        practical(
            columns[:, free], [n for n, chosen in zip(names, free, strict=True) if chosen], there
        ),
        there,
    )


def _candidate(
    found: Estimate,
    criteria: Practical,
    there: Seen,
    task: Task,
    test: AnyCost | None,
    known: Scatters,
) -> Candidate:
    """Test cost of one estimate with its criteria."""
    chain, names = found.chain, task.names(found.chain)
    p = np.array([found.parameters[n] for n in names])
    box = task.box(names)
    residual = _cross_validated(found, task, p) if test is None else _residual(chain, task, test, p)
    near = (box.high - p <= AT_BOUND * p) | ((box.low > 0) & (p - box.low <= AT_BOUND * p))
    at_bound = tuple(n for n, hit, free in zip(names, near, box.free, strict=True) if hit and free)
    missed = _expected(found, task, test or task.cost, *known)
    size = chi2(residual, missed)
    return Candidate(
        chain, found, criteria, float(residual @ residual), size, at_bound, residual, missed, there
    )


def _expected(
    found: Estimate, task: Task, judging: AnyCost, inside: Scatter, outside: Scatter
) -> Real:
    """What the residuals on the judged data are expected to be, shape (n_y,)."""
    names = task.names(found.chain)
    p, free = np.array([found.parameters[n] for n in names]), task.box(names).free
    columns = task.cost.of(task.plant(found.chain), p)[1][:, free]
    seen = judging.of(replace(task, cost=judging).plant(found.chain), p)[1][:, free]
    return expected(columns, task.cost.scatter(inside.rho), seen, judging.scatter(outside.rho))


def _residual(chain: Chain, task: Task, cost: AnyCost, p: Real) -> Real:
    return cost.residual(replace(task, cost=cost).plant(chain).response(p))


def _cross_validated(found: Estimate, task: Task, p: Real) -> Real:
    """Residuals of each line under the fit to the other folds, lines dealt out in turn; shape
    (n_y,).
    """
    if not task.box(task.names(found.chain)).free.any():
        return _residual(found.chain, task, task.cost, p)  # no fit sees any line
    cost = task.cost
    whole = np.empty(cost.n_residuals)
    at = [np.arange(len(part.measured)) % FOLDS for part in cost.parts]
    for fold in range(FOLDS):
        out = [turns == fold for turns in at]
        kept = replace(task, cost=cost.without(np.concatenate(out)))
        there, _ = fine(kept.plant(found.chain), kept.cost, kept.box(task.names(found.chain)), p)
        both = np.concatenate([np.tile(own, 2) for own in out])
        whole[both] = cost.residual(task.plant(found.chain).response(there))[both]
    return whole
