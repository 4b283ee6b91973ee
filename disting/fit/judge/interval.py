"""Intervals of 95 % of a fitted parameter.

Where a parameter is well known, p -+ t s with its standard error s. Where it is not, the error of
its logarithm is less informative: the other parameters change, a damper may also be zero. There the
profile of the likelihood decides,

    Q(v) = min |e|^2 over the other parameters with this one at v        (`whitened`),

the values with Q(v) - Q_min at most the quantile of F of 1 and the degrees of freedom of the
scatter. Where zero is among them the interval ends above where it holds 95 % on one side: the
parameter is below that. An estimate by another cost is not where Q is lowest: it has p -+ t s
unless zero is near.

Q may have several valleys, and noise may make another one than the true one the deepest. Where the
parameters are true, Q there exceeds its minimum by at most the quantile of F of the number of
parameters, with 95 %, and so does the bottom of their valley. The intervals hold p -+ t s of each
valley that the search has found and that is no higher, and of each other set of values with exactly
the same response.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from math import exp, inf, isfinite, log, sqrt

import numpy as np
from scipy.special import stdtrit

from disting.fit.judge.admissible import FROM_ZERO
from disting.fit.judge.candidate import OUTSIDE, Candidate, values_of
from disting.fit.judge.exclusion import FELT, limit
from disting.fit.search.data import WhitenedCost
from disting.fit.search.descent import fine, rough
from disting.fit.search.estimate import Task
from disting.fit.search.starts import natural, scale
from disting.measurement.arrays import Real
from disting.statistics.covariance import equal
from disting.statistics.practical import covariance
from disting.statistics.scatter import Scatter

STRAIGHT = 0.05  # relative standard error up to which Q is as good as a parabola
MOST_LIKELY = 0.01  # of Q above its minimum
ZERO = 1e-4  # share of its natural size at which an element is as good as not there
STEP, STEPS = log(3.0), 20  # largest step of the search for an end in the logarithm, and how many
PRECISE = 0.03  # of the length of an end, in standard errors
ITERATIONS = 30  # of the search for the other parameters

Interval = tuple[float, float]


@dataclass(frozen=True)
class _Likelihood:
    """Q of a candidate about its minimum `lowest` at the parameters `best`; `size`: of Q, the
    misfit in addition to the scatter; `spread` = covariance of ln p where each residual scatters by
    1; `usual`: natural sizes of the parameters.
    """

    task: Task
    candidate: Candidate
    whitened: WhitenedCost
    known: Scatter
    best: Real
    lowest: float
    size: float
    spread: Real
    usual: Mapping[str, float]

    def error(self, at: int) -> float:
        """Standard error of one ln p; infinite where it is not determined."""
        return sqrt(float(self.spread[at, at]))


def intervals(
    candidate: Candidate, task: Task, scatter: Scatter, same: Sequence[Mapping[str, float]] = ()
) -> dict[str, Interval]:
    """The interval of each fitted parameter; 0 and infinity where it has no end. `same`: other
    values that give the same response.
    """
    values, errors = candidate.estimate.parameters, candidate.practical.relative_errors
    wide = -float(stdtrit(scatter.freedom, OUTSIDE / 2))
    intervals = {n: _about(values[n], wide * e) for n, e in errors.items()}
    about = _likelihood(candidate, task, scatter)
    if any(e > STRAIGHT for e in errors.values()):
        response = task.plant(candidate.chain).response(values_of(candidate.estimate, task))
        own = float(about.whitened.total(response))
        most = STRAIGHT if own - about.lowest <= MOST_LIKELY else FROM_ZERO
        intervals = {
            n: intervals[n] if e <= most else _profile_interval(about, n, e <= FROM_ZERO)
            for n, e in errors.items()
        }
    return _with_valleys(about, intervals, wide, same)


def _about(value: float, relative: float) -> Interval:
    return value * (1 - relative), value * (1 + relative)


def _with_valleys(
    about: _Likelihood,
    entries: Mapping[str, Interval],
    wide: float,
    same: Sequence[Mapping[str, float]],
) -> dict[str, Interval]:
    """Intervals that hold the other valleys too which the data do not exclude, and the values that
    give the `same` response.
    """
    task, candidate = about.task, about.candidate
    names, plant = task.names(candidate.chain), task.plant(candidate.chain)
    whole, box = dict(entries), task.box(names)
    starts = np.array([*candidate.estimate.valleys, *([x[n] for n in names] for x in same)])
    if not (starts.size and box.free.any()):
        return whole
    points, costs = rough(plant, about.whitened, box, starts, ITERATIONS)
    most = about.lowest + about.size * limit(
        int(box.free.sum()), about.known.freedom, level=OUTSIDE
    )
    for point in points[costs <= most]:
        at = {n: float(v) for n, v in zip(names, point, strict=True) if n in entries}
        if all(entries[n][0] <= value <= entries[n][1] for n, value in at.items()):
            continue  # the same valley
        columns = about.whitened.of(plant, point)[1][:, box.free]
        spread = covariance(columns, equal(float(len(columns)), len(columns), 0))
        for n, error in zip(np.array(names)[box.free], np.sqrt(np.diag(spread)), strict=True):
            low, high = _about(at[n], wide * sqrt(about.size) * float(error))
            whole[n] = min(whole[n][0], max(low, 0.0)), max(whole[n][1], high)
    return whole


def _likelihood(candidate: Candidate, task: Task, scatter: Scatter) -> _Likelihood:
    names, whitened = task.names(candidate.chain), WhitenedCost(task.cost, scatter)
    plant, box = task.plant(candidate.chain), task.box(names)
    best, lowest = fine(plant, whitened, box, values_of(candidate.estimate, task))
    columns = whitened.of(plant, best)[1][:, box.free]
    spread = np.full((len(best), len(best)), inf)
    if box.free.any():
        unit = equal(float(len(columns)), len(columns), 0)
        spread[np.ix_(box.free, box.free)] = covariance(columns, unit)
    size = max(1.0, lowest / max(whitened.cost.n_residuals - len(best), 1))
    usual = natural(candidate.chain, scale(task.cost.measured))
    return _Likelihood(task, candidate, whitened, scatter, best, lowest, size, spread, usual)


def _profile_interval(about: _Likelihood, name: str, is_felt: bool) -> Interval:
    """The interval by the profile of the likelihood; `is_felt`: it is known not to be zero."""
    task, candidate, scatter = about.task, about.candidate, about.known
    at = task.names(candidate.chain).index(name)
    usual = about.usual.get(name, float(about.best[at]))
    value, zero = float(about.best[at]), log(ZERO * usual)
    felt = is_felt or _rise(about, at, inf)(zero) > limit(1, scatter.freedom, level=OUTSIDE)
    gone = not is_felt and value <= ZERO * usual  # the best value is as good as zero
    # what is as small and felt all the same, as others follow it, is followed from its own value
    middle = log(value) if value and (felt or not gone) else zero
    from_zero = gone or not felt
    most = limit(1, scatter.freedom, level=2 * OUTSIDE if from_zero else OUTSIDE)
    wide = sqrt(most * about.size) * about.error(at)
    step = min(wide, STEP) if isfinite(wide) and wide > 0 else STEP
    high = _end(_rise(about, at, most), middle, step, most)
    return 0.0 if from_zero else exp(_end(_rise(about, at, most), middle, -step, most)), exp(high)


def _rise(about: _Likelihood, at: int, most: float) -> Callable[[float], float]:
    """Q - Q_min by the logarithm of one parameter, in units of the misfit in addition to the
    scatter; each search begins where the last one that found at most `most` ended.
    """
    task, chain = about.task, about.candidate.chain
    names, plant = task.names(chain), task.plant(chain)
    own = about.error(at)
    along = about.spread[:, at] / own**2 if isfinite(own) and own > 0 else np.zeros(len(names))
    along = np.where(np.isfinite(along), along, 0.0)
    # what missed beyond the scatter widens the errors of some parameters more than of others
    stated = about.candidate.practical.relative_errors[names[at]]
    size = max(about.size, (stated / own) ** 2 if 0 < own < inf and stated < inf else 1.0)
    point, before = about.best, log(max(about.best[at], np.finfo(float).tiny))

    def rise(logarithm: float) -> float:
        """The rise at this logarithm, the other parameters fitted again."""
        nonlocal point, before
        held = replace(task, fixed={**task.fixed, names[at]: exp(logarithm)})
        moved = np.exp(np.clip(along * (logarithm - before), -STEP, STEP))
        starts = _starts(about, held, point * moved)
        points, costs = rough(plant, about.whitened, held.box(names), starts, ITERATIONS)
        risen = max(float(costs.min()) - about.lowest, 0.0) / size
        if risen <= most:  # what has left the valley leads no further
            point, before = points[np.argmin(costs)], logarithm
        return risen

    return rise


def _starts(about: _Likelihood, held: Task, point: Real) -> Real:
    """A point, shape (1, n_p), and, where some of its parameters have no effect, one where they
    have as much as the data scatter: what has gone to zero or infinity does not come back by steps
    of its logarithm.
    """
    box = held.box(held.names(about.candidate.chain))
    point = box.clipped(point)
    columns = about.whitened.of(held.plant(about.candidate.chain), point)[1]
    effect = np.maximum(np.abs(columns).max(axis=0), np.finfo(float).tiny)
    usual = np.array([about.usual.get(n, 1.0) for n in held.names(about.candidate.chain)])
    lifted = point * np.where(point > usual, effect, 1 / effect)
    unfelt = box.free & (effect < FELT) & np.isfinite(lifted)
    both = np.stack([point, box.clipped(np.where(unfelt, lifted, point))])
    return both if unfelt.any() else both[:1]


def _end(rise: Callable[[float], float], start: float, step: float, most: float) -> float:
    """Where the profile reaches `most`, from `start` in steps that grow to `STEP`; infinite where
    it does not.
    """
    inside, at = (start, 0.0), start
    for _ in range(STEPS):
        at += step
        reached = rise(at)
        if reached > most:
            return _between(rise, inside, (at, reached), most)
        inside, step = (at, reached), float(np.clip(2 * step, -STEP, STEP))
    return float(np.copysign(inf, step))


def _between(
    rise: Callable[[float], float],
    inside: tuple[float, float],
    outside: tuple[float, float],
    most: float,
) -> float:
    """Where the profile passes `most` between two points with their rises: by its root, which is
    nearly straight, by halves where that does not get on, as a search that finds less than before
    must not matter.
    """
    wanted = sqrt(most)
    for turn in range(STEPS):
        low, high = sqrt(inside[1]), sqrt(outside[1])
        if high - wanted <= PRECISE * wanted:
            break
        share = 0.5 if turn % 3 == 2 or not high > low else (wanted - low) / (high - low)
        middle = inside[0] + min(max(share, PRECISE), 1 - PRECISE) * (outside[0] - inside[0])
        reached = rise(middle)
        if reached > most:
            outside = middle, reached
        else:
            inside = middle, reached
            if wanted - sqrt(reached) <= PRECISE * wanted:
                return middle
    return outside[0]
