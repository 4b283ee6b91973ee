"""Whether a candidate explains the data: its residuals against the scatter of the lines, in
absolute terms.

With residuals r in units of the scatter (`whitened`) and what they are expected to be, the errors
of the parameters included (`covariance.expected_deviation`),

    chi2 per line = mean (r / expected)^2

is 1 for the true model and independent of what other candidates do. A candidate explains the data
if it is at most `LARGEST`, more where the scatter itself is known from little (F test); none does
where the data themselves are mostly noise: less than `FEW_CLEAR` of the lines scatter by less than
20 %.

What is said of several responses one by one: how much each scatters, and what its residuals are
like.

Responses of one machine share their parameters and no noise: nothing is carried from the last line
of one to the first of the next. Of one response all this is what `scatter`, `noise` and `explain`
say.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from math import degrees, isfinite, pi

import numpy as np
from scipy.stats import chi2 as chi2_distribution, f as f_distribution

from disting.fit.noise.covariance import Noise, correlation, noise
from disting.fit.noise.scatter import Scatter, change, scatter, widen
from disting.fit.search.cost import Cost
from disting.fit.search.joint import AnyCost
from disting.measurement import FrequencyResponse
from disting.measurement.arrays import Complex, Real
from disting.model.presentation import summary

# chi2 per line up to which a model explains the data: what a machine does beside being a chain
LARGEST = 3.0
LEVEL = 0.01  # of the test that allows more
FEW_CLEAR = 0.2  # share of the lines that must scatter by less than 20 %
SMOOTHED = 5  # lines over which what is missed is averaged before it is called a range
RANGES = 3  # that are named, those that miss most


@dataclass(frozen=True, slots=True)
class Miss:
    """Frequencies `low` to `high` [Hz] where a model misses the data by more than their scatter,
    and by how much at most.

    `factor` = largest |G_model / G - 1| in logarithms (0.1 = 10 %), `angle` [rad] likewise, of
    lines averaged over their neighbours; `share` of chi2 that comes from there; `response`: which
    one, where there are several.
    """

    low: float
    high: float
    factor: float
    angle: float
    share: float
    response: str = ""

    @property
    def sentence(self) -> str:
        """Where, and by how much."""
        where = (
            f"{self.low:.3g} to {self.high:.3g} Hz"
            if self.high > self.low
            else f"{self.low:.3g} Hz"
        )
        size = (
            f"a factor {np.exp(self.factor):.2g}"
            if self.factor > 0.5
            else f"{100 * self.factor:.2g} %"
        )
        return (
            f"{where}{self.response and f' of {self.response}'} (by up to {size} and"
            f" {max(degrees(self.angle), 0.1):.{0 if self.angle > 0.1 else 1}f} degrees)"
        )


@dataclass(frozen=True, eq=False)
class Explanation:
    """What the residuals of a candidate say of it: chi2 per line, correlation of neighbouring
    lines, what it misses where; `clear`: share of the lines that carry information in that one of
    several responses that has most.
    """

    chi2: float
    scatter: Scatter
    correlation: float
    misses: tuple[Miss, ...]
    clear: float | None = None

    def __repr__(self) -> str:
        explains = "explains the data" if self.explains else "does not explain the data"
        said = "the data are mostly noise" if self.noisy else explains
        return summary(self, f"chi2 {self.chi2:.3g}, {said}")

    @property
    def explains(self) -> bool:
        """Whether the candidate misses no more than the data scatter, and there is more than
        noise.
        """
        return self.chi2 <= largest_cost(self.scatter) and not self.noisy

    @property
    def noisy(self) -> bool:
        """Whether the data are mostly noise."""
        return (self.scatter.clear if self.clear is None else self.clear) < FEW_CLEAR


def largest_cost(own_scatter: Scatter) -> float:
    """Largest chi2 per line of a model that explains data of this scatter."""
    count = 2 * len(own_scatter.rho)
    if isfinite(own_scatter.freedom):
        return max(LARGEST, float(f_distribution.isf(LEVEL, count, own_scatter.freedom)))
    return max(LARGEST, float(chi2_distribution.isf(LEVEL, count)) / count)


def chi2(residual: Real, missed: Real) -> float:
    """chi2 per line of residuals, shape (n_y,), with their expected sizes; lines of weight zero
    do not count.
    """
    used = missed > 0
    return float(np.mean((residual[used] / missed[used]) ** 2)) if used.any() else 0.0


def explanation(residual: Real, missed: Real, cost: Cost, own_scatter: Scatter) -> Explanation:
    """What whitened residuals, shape (n_y,), of data with this scatter say; `missed` = their
    expected sizes.
    """
    return Explanation(
        chi2(residual, missed),
        own_scatter,
        correlation(residual),
        _misses(residual, missed, cost, own_scatter),
    )


def _misses(residual: Real, missed: Real, cost: Cost, own_scatter: Scatter) -> tuple[Miss, ...]:
    """Ranges of lines whose averaged excess is above `LARGEST`, those with the largest share of
    chi2 first.
    """
    power = np.sum((residual / np.maximum(missed, 1e-300)).reshape(2, -1) ** 2, axis=0) / 2
    ones = np.ones(min(SMOOTHED, len(power)))
    averaged = np.convolve(power, ones, mode="same") / np.convolve(
        np.ones(len(power)), ones, mode="same"
    )
    beyond = np.flatnonzero(averaged > LARGEST)
    runs = np.split(beyond, np.flatnonzero(np.diff(beyond) > SMOOTHED) + 1) if beyond.size else []
    factor, angle = _plain(residual, own_scatter)
    hertz, total = cost.measured.frequency, max(float(power.sum()), 1e-300)
    shares = [float(power[run[0] : run[-1] + 1].sum()) / total for run in runs]
    misses = [
        Miss(
            low=float(hertz[run[0]]),
            high=float(hertz[run[-1]]),
            factor=float(factor[run].max()),
            angle=float(angle[run].max()),
            share=share,
        )
        for run, share in zip(runs, shares, strict=True)
    ]
    return tuple(sorted(misses, key=lambda miss: -miss.share)[:RANGES])


def _plain(residual: Real, own_scatter: Scatter) -> tuple[Real, Real]:
    """|ln of the amplitudes' ratio| and |difference of the phases| [rad], shape (n_f,) each."""
    along, across = residual.reshape(2, -1) * own_scatter.rho
    ratio = np.log(np.maximum(np.abs(1 + along + 1j * across), 1e-300))
    return np.abs(ratio), np.minimum(np.abs(np.arctan2(across, 1 + along)), pi)


@dataclass(frozen=True, eq=False)
class JointNoise:
    """The noise of each response: its own deviations, its own correlation, none between two."""

    parts: tuple[Noise, ...]

    def seen(self, columns: Real) -> Real:
        """F' columns, with C = F F', shape (n_y, n)."""
        ends = np.cumsum([len(part.sigma) for part in self.parts])[:-1]
        each = zip(self.parts, np.split(columns, ends), strict=True)
        return np.concatenate([part.seen(rows) for part, rows in each])


def scatters(cost: AnyCost, fitted: Sequence[Complex]) -> list[Scatter]:
    """Scatter of the lines of each response; `fitted` = stacked responses of candidates."""
    return [
        scatter(part.measured, own)
        for part, own in zip(cost.parts, _each(cost, fitted), strict=True)
    ]


def yardsticks(
    train: AnyCost, judged: AnyCost, fitted: Sequence[Complex], seen: Sequence[Complex]
) -> tuple[Scatter, Scatter]:
    """Scatter of the training data and of those on which candidates are judged, what the machine
    changes by between them included; `fitted`, `seen` = responses of candidates at the lines of
    the one and of the other.
    """
    inside = scatters(train, fitted)
    if train is judged:
        return merge(inside), merge(inside)
    outside = scatters(judged, seen)
    for k, part in enumerate(judged.parts):
        at = train.setups.index(judged.setups[k])
        first = train.parts[at].measured
        tau = change(first, part.measured, inside[at], outside[k])
        inside[at], outside[k] = widen(inside[at], tau), widen(outside[k], tau)
    return merge(inside), merge(outside)


def partners(train: AnyCost, judged: AnyCost) -> list[FrequencyResponse]:
    """The training data of each response that is judged."""
    rest = iter(zip(train.setups, train.parts, strict=True))
    return [
        next(part.measured for other_setup, part in rest if other_setup == setup)
        for setup in judged.setups
    ]


def noises(
    cost: AnyCost, residual: Real, sigma: Real, missed: Real | None = None
) -> Noise | JointNoise:
    """C of the residuals, shape (n_y,), as in `noise`."""
    rows = [cost.by_residual(a) for a in (residual, sigma)]
    missing = [None] * len(cost.parts) if missed is None else cost.by_residual(missed)
    noises = [noise(*own) for own in zip(*rows, missing, strict=True)]
    return noises[0] if len(noises) == 1 else JointNoise(tuple(noises))


def correlations(cost: AnyCost, residual: Real) -> float:
    """The largest correlation of residuals of neighbouring lines."""
    return max(map(correlation, cost.by_residual(residual)))


def explanations(
    cost: AnyCost, residual: Real, missed: Real, own_scatter: Scatter
) -> tuple[Explanation, ...]:
    """What the whitened residuals of each response say."""
    ends = np.cumsum([len(part.measured) for part in cost.parts])
    rows = (cost.by_residual(a) for a in (residual, missed))
    each = zip(cost.parts, *rows, ends, strict=True)
    return tuple(
        explanation(own, expected, part, own_scatter.at(slice(end - len(part.measured), end)))
        for part, own, expected, end in each
    )


def explain(cost: AnyCost, residual: Real, missed: Real, own_scatter: Scatter) -> Explanation:
    """What the residuals of all responses say together."""
    each = explanations(cost, residual, missed, own_scatter)
    if len(each) == 1:
        return each[0]
    power = [
        this_explanation.chi2 * part.n_residuals
        for this_explanation, part in zip(each, cost.parts, strict=True)
    ]
    whole = max(sum(power), 1e-300)
    misses = [
        replace(miss, share=miss.share * own / whole, response=setup.text)
        for this_explanation, own, setup in zip(each, power, cost.setups, strict=True)
        for miss in this_explanation.misses
    ]
    misses.sort(key=lambda miss: -miss.share)
    largest = correlations(cost, residual)
    clearest = max(this_explanation.scatter.clear for this_explanation in each)
    return Explanation(
        chi2(residual, missed), own_scatter, largest, tuple(misses[:RANGES]), clear=clearest
    )


def _each(cost: AnyCost, fitted: Sequence[Complex]) -> list[list[Complex]]:
    """Stacked responses of candidates, for each measured response."""
    return [list(own) for own in zip(*map(cost.by_line, fitted), strict=True)] or [
        [] for _ in cost.parts
    ]


def merge(each: Iterable[Scatter]) -> Scatter:
    """The scatter of all lines."""
    the_scatters = list(each)
    return Scatter(
        np.concatenate([this_scatter.rho for this_scatter in the_scatters]),
        np.concatenate([this_scatter.size for this_scatter in the_scatters]),
        ", ".join(dict.fromkeys(this_scatter.source for this_scatter in the_scatters)),
        sum(this_scatter.freedom for this_scatter in the_scatters),
        "; ".join(
            dict.fromkeys(this_scatter.doubt for this_scatter in the_scatters if this_scatter.doubt)
        ),
    )
