"""Intervals of 95 % of a fitted parameter.

Where a parameter is well known, p -+ t s with its standard error s. Where it is not, the error of
its logarithm tells nothing: a damper may as well be zero. There the profile of the likelihood
decides, Q(v) = min |e|^2 over the other parameters with this one at v (`whitened`): the values with
Q(v) - Q_min at most the quantile of F of 1 and the degrees of freedom of the scatter. Where zero is
among them the interval ends above where it holds 95 % on one side: the parameter is below that.
"""

from collections.abc import Callable
from dataclasses import replace
from math import exp, inf, log

import numpy as np
from scipy.stats import t as t_distribution

from disting.fit.judge.admissible import FROM_ZERO
from disting.fit.judge.candidate import Candidate, values_of
from disting.fit.judge.exclusion import limit
from disting.fit.noise.scatter import Scatter
from disting.fit.search.descent import fine
from disting.fit.search.estimate import Task
from disting.fit.search.starts import natural, scale
from disting.fit.search.whitened import Whitened

OUTSIDE = 0.05  # probability of a value outside
ZERO = 1e-4  # share of its natural size at which an element is as good as not there
STEP, STEPS = 3.0, 20  # factor of the search for an end, and how many
PRECISE = 0.02  # of the logarithm of an end

Interval = tuple[float, float]


def intervals(candidate: Candidate, task: Task, known: Scatter) -> dict[str, Interval]:
    """The interval of each fitted parameter; 0 and infinity where it has no end."""
    values, errors = candidate.estimate.parameters, candidate.practical.relative_errors
    wide = float(t_distribution.isf(OUTSIDE / 2, known.freedom))
    found = dict[str, Interval]()
    for name, error in errors.items():
        if error <= FROM_ZERO:
            found[name] = values[name] * (1 - wide * error), values[name] * (1 + wide * error)
        else:
            found[name] = profiled(candidate, task, known, name)
    return found


def profiled(candidate: Candidate, task: Task, known: Scatter, name: str) -> Interval:
    """The interval by the profile of the likelihood."""
    names, whitened = task.names(candidate.chain), Whitened(task.cost, known)
    plant, at = task.plant(candidate.chain), names.index(name)
    best, lowest = fine(plant, whitened, task.box(names), values_of(candidate.estimate, task))
    usual = natural(candidate.chain, scale(task.cost.measured)).get(name, float(best[at]))
    size = max(1.0, lowest / max(whitened.cost.n_residuals - len(best), 1))
    point = best

    def rise(logarithm: float) -> float:
        """Q - Q_min, in units of what is missed beside the scatter."""
        nonlocal point
        held = replace(task, fixed={**task.fixed, name: exp(logarithm)})
        point, cost = fine(plant, whitened, held.box(names), point)
        return (cost - lowest) / size

    value, zero = float(best[at]), log(ZERO * usual)
    felt = rise(zero) > limit(1, known.freedom, level=OUTSIDE)
    gone = value <= ZERO * usual  # the best value is as good as zero
    # what is as small and felt all the same, as others follow it, is followed from its own value
    middle = log(value) if value and (felt or not gone) else zero
    from_zero = gone or not felt
    most = limit(1, known.freedom, level=2 * OUTSIDE if from_zero else OUTSIDE)
    point = best
    high = _end(rise, middle, log(STEP), most)
    point = best
    return 0.0 if from_zero else exp(_end(rise, middle, -log(STEP), most)), exp(high)


def _end(rise: Callable[[float], float], start: float, step: float, most: float) -> float:
    """Where the profile reaches `most`, from `start` in steps; infinite where it does not."""
    inside = start
    for _ in range(STEPS):
        there = inside + step
        if rise(there) > most:
            return _bisected(rise, inside, there, most)
        inside = there
    return float(np.copysign(inf, step))


def _bisected(rise: Callable[[float], float], inside: float, outside: float, most: float) -> float:
    """Where the profile passes `most`: by halves, as a search that finds less than before must not
    matter.
    """
    while abs(outside - inside) > PRECISE:
        middle = (inside + outside) / 2
        inside, outside = (inside, middle) if rise(middle) > most else (middle, outside)
    return outside
