"""What each criterion alone does at every threshold (Figs 5 to 8), and profiles of single
parameters.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from disting.errors import InputError, shown
from disting.fit.judge.candidate import Candidate
from disting.fit.search.descent import fine
from disting.fit.search.estimate import Task
from disting.measurement.arrays import Real
from disting.model.presentation import plural, summary

CRITERIA = ("condition_index", "importance_ratio", "collinearity")
STEPS = 200  # thresholds from 1 to 10000
PROFILE = 3.0  # standard errors on either side
POINTS = 15


@dataclass(frozen=True, eq=False)
class Sweep:
    """One criterion alone: at each threshold N_p of the best candidate (0: none fulfils it) and
    how many fulfil it.
    """

    criterion: str
    thresholds: Real
    n_parameters: Real
    fulfilling: Real

    def __repr__(self) -> str:
        return summary(self, f"{self.criterion}, {plural(len(self.thresholds), 'threshold')}")


def sweep(candidates: Sequence[Candidate], criterion: str) -> Sweep:
    """Thresholds from 1 to 10000; the best candidate is the one with the lowest test cost. Raises
    InputError for another criterion.
    """
    if criterion not in CRITERIA:
        raise InputError(f"the criteria are {', '.join(CRITERIA)}, not {shown(criterion)}")
    ordered = sorted(candidates, key=lambda c: c.j_test)
    values = np.array([getattr(c.practical, criterion) for c in ordered])
    sizes = np.array([c.n_parameters for c in ordered])
    thresholds = np.geomspace(1.0, 1e4, STEPS)
    holds = values[None, :] <= thresholds[:, None]
    best = np.where(holds.any(axis=1), sizes[holds.argmax(axis=1)], 0)
    return Sweep(criterion, thresholds, best, holds.sum(axis=1))


@dataclass(frozen=True, eq=False)
class Profile:
    """Smallest cost J over all other parameters at each value of one; flat: the data do not
    determine it.
    """

    name: str
    values: Real
    costs: Real

    def __repr__(self) -> str:
        return summary(self, f"{self.name}, {self.values[0]:.4g} to {self.values[-1]:.4g}")


def profile(candidate: Candidate, task: Task, name: str, span: float = 0.0) -> Profile:
    """Profile of a fitted parameter, `span` of its logarithm to either side; 0: three standard
    errors, at most a factor 10. Raises InputError for a parameter that was not fitted.
    """
    if name not in candidate.practical.names:
        raise InputError(
            f"{name} is no fitted parameter of this candidate; they are"
            f" {', '.join(candidate.practical.names)}"
        )
    names = task.names(candidate.chain)
    best = np.array([candidate.estimate.parameters[n] for n in names])
    width = span or min(PROFILE * candidate.practical.relative_errors[name], float(np.log(10)))
    steps = np.linspace(-width, width, POINTS)
    at, costs = names.index(name), np.empty(POINTS)
    for order in (np.flatnonzero(steps >= 0), np.flatnonzero(steps < 0)[::-1]):
        point = best
        for i in order:  # each from its neighbour's optimum, outwards
            held = replace(task, fixed={**task.fixed, name: float(best[at] * np.exp(steps[i]))})
            point, costs[i] = fine(held.plant(candidate.chain), task.cost, held.box(names), point)
    return Profile(name, best[at] * np.exp(steps), costs)
