"""Intervals of 95 % of the fitted values of a network.

A value that is well known lies within p exp(-+ t s), with the standard deviation s of its
logarithm. For one that is not, and for all where one is as good as unknown (the tangents that s
comes from do not show how far the others move with it), the profile of the likelihood decides,

    Q(v) = min |e|^2 over the other values with this one at v        (e whitened),

the values with Q(v) - Q_min at most the quantile of F of 1 and the degrees of freedom of the
scatter. An end is 0 or infinity where the profile does not reach that: the data allow the element
to vanish, or to become a direct connection.

Networks with the same responses as a fitted one, with their own values.

Where by a verdict two networks give the same responses for all positive values, the values of the
other one are those at which its responses are the fitted ones: least squares without noise, which
ends at rounding. Where several sets of values do that, those found are given.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import exp, inf, isfinite, log

import numpy as np
from scipy.special import stdtrit

from disting.fit.judge.candidate import OUTSIDE
from disting.fit.judge.exclusion import FELT, limit
from disting.fit.judge.explanation import noises
from disting.fit.judge.interval import ITERATIONS, STEP, STEPS, STRAIGHT, Interval
from disting.fit.search.data import WhitenedCost
from disting.fit.search.descent import Box, fine, rough
from disting.fit.search.network_plant import AnyNetworkPlant
from disting.measurement import FrequencyResponse
from disting.measurement.arrays import Complex, Real
from disting.network.network import Network
from disting.statistics.practical import NoiseModel

LEAST = 1e-6  # share of the largest sensitivity below which a combination is not determined
UNKNOWN = 0.5  # deviation of a logarithm from which on tangents do not describe the valley
NUDGE = 3.0  # factor by which it is seen which way an effect grows
HALVINGS = 12  # of the last step towards an end


def deviations(columns: Real, level: float, noise: NoiseModel) -> list[float]:
    """Return standard deviations of the logarithms of the values; infinite where a direction is not
    determined.

    `columns`: sensitivities S of the whitened residuals by the logarithms, shape (n_y, n_p). The
    deviation is sqrt of the diagonal of (S'S)^-1, times sqrt(`level`), the chi2 per line, where the
    fit misses more than the scatter; or with residuals that are correlated as `noise` says,
    whichever is larger.
    """
    left, sizes, right = np.linalg.svd(columns, full_matrices=False)
    is_seen = sizes > LEAST * sizes[0]
    lost = np.sum(right[~is_seen] ** 2, axis=0) > LEAST
    half = right[is_seen] / sizes[is_seen, None]
    white = np.sum(half**2, axis=0) * max(level, 1.0)
    carried = np.sum((noise.seen(left[:, is_seen]) @ half) ** 2, axis=0)
    return [float(x) for x in np.where(lost, np.inf, np.sqrt(np.maximum(white, carried)))]


@dataclass(frozen=True, slots=True, eq=False)
class _Valley:
    """A network about its best values `best`, shape (n_p,), where |e|^2 is `lowest`; `size`: of
    |e|^2 what one degree of freedom has, 1 for scatter alone.

    `felt`, shape (n_p,): the point with each value that has no effect, of an element that has gone
    to zero or infinity, moved to where it has a little: it does not come back by steps of its
    logarithm. `growth`: 1 where effect grows with such a value, -1 where it falls, else 0.
    """

    plant: AnyNetworkPlant
    whitened: WhitenedCost
    best: Real
    lowest: float
    size: float
    felt: Real
    growth: Real

    def rise(self, at: int, logarithm: float, point: Real) -> tuple[float, Real]:
        """Return Q - Q_min with one value held, and the point; the search starts at `point`."""
        held = point.copy()
        held[at] = exp(logarithm)
        low, high = np.zeros(len(held)), self.plant.highest.copy()
        low[at] = high[at] = held[at]
        box = Box(low, high)
        if not box.free.any():
            cost = float(self.whitened.total(self.plant.response(held[None]))[0])
            return max(cost - self.lowest, 0.0) / self.size, held
        back = np.where(self.growth != 0, self.felt, held)
        back[at] = held[at]
        starts = np.stack([held, back]) if np.any(back != held) else held[None]
        with np.errstate(all="ignore"):  # an element that vanishes leaves the range of numbers
            points, costs = rough(self.plant, self.whitened, box, starts, ITERATIONS)
        best = int(np.argmin(np.nan_to_num(costs, nan=inf)))
        risen = (float(costs[best]) - self.lowest) / self.size
        return (max(risen, 0.0) if isfinite(risen) else inf), points[best]


def network_intervals(
    plant: AnyNetworkPlant, whitened: WhitenedCost, best: Real, relative: Real
) -> dict[str, Interval]:
    """Return the interval of each value; `best` and `relative`, shape (n_p,): the fitted values
    and the standard deviations of their logarithms, infinite where these are not determined.
    """
    freedom = whitened.known.freedom
    wide = -float(stdtrit(freedom, OUTSIDE / 2))
    lowest = float(whitened.total(plant.response(best[None]))[0])
    count = max(whitened.n_residuals - len(best), 1)
    felt, growth = _effect_of_values(plant, whitened, best)
    valley = _Valley(plant, whitened, best, lowest, max(1.0, lowest / count), felt, growth)
    most = limit(1, freedom, level=OUTSIDE)
    straight = STRAIGHT if np.all(relative < UNKNOWN) else 0.0
    found = dict[str, Interval]()
    for at, name in enumerate(plant.parameters):
        spread, value = float(relative[at]), float(best[at])
        if spread <= straight:
            high = min(value * exp(wide * spread), float(plant.highest[at]))
            found[name] = value * exp(-wide * spread), high
        else:
            step = min(wide * spread, STEP)
            low, high = (_end(valley, at, sign * step, most) for sign in (-1, 1))
            found[name] = exp(low) if isfinite(low) else 0.0, exp(high) if isfinite(high) else inf
    return found


def _effect_of_values(
    plant: AnyNetworkPlant, whitened: WhitenedCost, best: Real
) -> tuple[Real, Real]:
    """Return `felt` and `growth` of a valley."""

    def effects(p: Real) -> Real:
        """Effect of a change of each single value, in units of the scatter."""
        with np.errstate(all="ignore"):
            columns = np.nan_to_num(whitened.of(plant, p)[1])
        return np.asarray(np.linalg.norm(columns, axis=0))

    own = effects(best)
    felt, growth = best.copy(), np.zeros(len(best))
    for at in np.flatnonzero((own < FELT) & (own > 0) & np.isinf(plant.highest)):
        moved = np.ones(len(best))
        moved[at] = NUDGE
        growth[at] = 1 if effects(best * moved)[at] > effects(best / moved)[at] else -1
        felt[at] *= (FELT / own[at]) ** growth[at]
    return felt, growth


def _end(valley: _Valley, at: int, step: float, most: float) -> float:
    """Return the logarithm at which the profile reaches `most`; infinite where it does not."""
    growth = valley.growth[at]
    if growth and growth != np.sign(step):
        return float(np.copysign(inf, step))
    inside, point = log(max(float(valley.felt[at]), np.finfo(float).tiny)), valley.best
    highest = log(valley.plant.highest[at]) if isfinite(valley.plant.highest[at]) else inf
    for _ in range(STEPS):
        outside = min(inside + step, highest)
        risen, reached = valley.rise(at, outside, point)
        if risen > most:
            return _between(valley, at, (inside, outside), most, point)
        if outside == highest:
            return highest
        inside, point, step = outside, reached, float(np.clip(2 * step, -STEP, STEP))
    return float(np.copysign(inf, step))


def _between(
    valley: _Valley, at: int, ends: tuple[float, float], most: float, point: Real
) -> float:
    """Return where the profile passes `most` between a value inside and one outside."""
    inside, outside = ends
    for _ in range(HALVINGS):
        middle = (inside + outside) / 2
        risen, reached = valley.rise(at, middle, point)
        if risen > most:
            outside = middle
        else:
            inside, point = middle, reached
    return outside


EQUAL = 1e-6  # relative distance of two responses that are the same but for rounding
SHARE = 1e-3  # of the scatter: the same where responses are known to fewer digits


@dataclass(frozen=True, slots=True)
class NetworkTwin:
    """A network that gives the responses of a fitted one with `values`, {} where these were not
    found; `free_choices`: dimension of the family of all such values; `intervals` of 95 %.
    """

    network: Network
    values: dict[str, float]
    intervals: dict[str, Interval]
    free_choices: int = 0

    def to_dict(self) -> dict[str, object]:
        """Plain data, ready for JSON; None for an end that is infinite."""
        return {
            "name": self.network.name,
            "values": self.values,
            "intervals": intervals_to_dict(self.intervals),
            "free_choices": self.free_choices,
        }


def intervals_to_dict(intervals: dict[str, Interval]) -> dict[str, list[float | None]]:
    """Return plain data of intervals, None for an end that is infinite."""
    return {
        name: [low, high if np.isfinite(high) else None] for name, (low, high) in intervals.items()
    }


def without_noise(data: Sequence[FrequencyResponse], stacked: Complex) -> list[FrequencyResponse]:
    """Return the responses with fitted ones, stacked in `stacked`, in place of the measured."""
    ends = np.cumsum([len(response) for response in data])[:-1]
    parts = np.split(stacked, ends)
    return [replace(r, G=own) for r, own in zip(data, parts, strict=True)]


def twin_at(
    plant: AnyNetworkPlant,
    start: Real,
    exact: WhitenedCost,
    measured: WhitenedCost,
    level: float,
    free_choices: int,
) -> NetworkTwin:
    """Return the twin whose values are searched from `start`, shape (n_p,); `exact`: the cost of
    the responses that it has to give, `measured`: that of the data, with the chi2 per line `level`.
    """
    p, _ = fine(plant, exact, Box(np.zeros(len(start)), plant.highest), start)
    missed = float(np.abs(exact.residual(plant.response(p[None]))[0]).max())
    smallest = float(np.min(measured.known.rho))
    if not missed <= max(EQUAL / smallest, SHARE):
        return NetworkTwin(plant.network, {}, {}, free_choices)
    residual, columns = measured.of(plant, p)
    noise = noises(measured.cost, residual, np.ones(len(residual)))
    relative = np.array(deviations(columns, level, noise))
    return NetworkTwin(
        plant.network,
        dict(zip(plant.parameters, map(float, p), strict=True)),
        network_intervals(plant, measured, p, relative),
        free_choices,
    )
