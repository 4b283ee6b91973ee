"""Test of whether a candidate explains the data: its residuals against the scatter of the lines, in
absolute terms.

With residuals r in units of the scatter (`whitened`) and their expected values, the errors of the
parameters included (`covariance.expected_deviation`),

    chi2 per line = mean (r / expected)^2

is 1 for the true model and independent of what other candidates do. There are four levels:

- a candidate explains the data if noise alone gives its chi2 more often than once in 1,000 times
  (F test with the degrees of freedom of the scatter);
- it explains them apart from something where chi2 is larger, but at most `LARGEST` (more where the
  scatter is known from little) without the two neighbouring lines that it misses most. Machines do
  a little that no chain does, and a bench may disturb single lines: a misfit of one line is no more
  a proof against a structure than a gain at one line is one for another (`lone_lines`). Nor may any
  other line be missed by more than noise of that chi2 gives at one of n lines once in 1,000 times:
  a few lines that are missed by far hide in the mean of many. Nor may two ranges be missed by as
  much as the response itself, |G_model / G - 1| >= 1, however large the scatter is;
- it explains them nearly where chi2 is no larger than that, but what is left hangs together: the
  residuals of neighbouring lines, each counted up to `MOST_OF_A_LINE`, are correlated by more than
  noise gives once in 1,000 times. Disturbed lines and the distortion of a multisine jump from line
  to line; a smooth miss over many lines is that of another structure, whose values differ by more
  than any scatter. So it is where a machine outside the candidates explains the data better
  (`outside`);
- else it does not explain them, and none does where the data are mostly noise: less than
  `FEW_CLEAR` of the lines scatter by less than 20 %.

None explains data of too few lines. A structure of p parameters takes p of 2 n real residuals, and
the scatter of a line is known from its `BESIDE` neighbours, so 2 p + `BESIDE` lines are needed:
then three quarters of the residuals are left to speak against it.

Each of several responses has its own scatter and its own residuals.

Responses of one machine share their parameters and no noise: nothing is carried from the last line
of one to the first of the next. For one response all this is given by `scatter`, `noise` and
`explain`.
"""

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from math import degrees, inf, isfinite, pi

import numpy as np
from scipy.special import chdtri, fdtri, ndtri

from disting.fit.search.cost import Cost
from disting.fit.search.joint import AnyCost
from disting.measurement import FrequencyResponse
from disting.measurement.arrays import Complex, Real
from disting.model.presentation import summary
from disting.statistics.covariance import Noise, correlation, noise
from disting.statistics.scatter import DIFFERENCE, Scatter, change, scatter, widen

# chi2 per line up to which a model explains the data: what a machine does beside being a chain
LARGEST = 3.0
LEVEL = 0.01  # of the test that allows more
CHANCE = 1e-3  # of a chi2, or of a correlation, that noise alone gives
MOST_OF_A_LINE = 3.0  # in units of what is expected: single lines make no correlation
BESIDE = 6  # neighbours of a line from which its scatter is known
FEW_CLEAR = 0.2  # share of the lines that must scatter by less than 20 %
SMOOTHED = 5  # lines over which what is missed is averaged before it is called a range
# |G_model / G - 1| = 1: twice the amplitude, or an angle of 60 degrees [rad]
GROSS_FACTOR, GROSS_ANGLE = np.log(2.0), np.pi / 3
RANGES = 3  # that are named, those that miss most


class Level(StrEnum):
    """Degree to which a structure explains data."""

    EXPLAINS = "explains"
    APART = "explains apart from"
    NEARLY = "nearly explains"
    NOT = "does not explain"


STATUS = {
    Level.EXPLAINS: "explained",
    Level.APART: "explained apart from misses",
    Level.NEARLY: "not explained fully",
    Level.NOT: "not explained",
}  # of the data, in files


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
    def is_gross(self) -> bool:
        """True if the model misses the response by as much as the response itself."""
        return self.factor >= GROSS_FACTOR or self.angle >= GROSS_ANGLE

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
    """Analysis of a candidate's residuals: chi2 per line, correlation of neighbouring lines, where
    lines are missed; `clear`: share of the lines that carry information in the most informative of
    several responses; `chi2_apart`: without the two neighbouring lines with the largest misfit;
    `worst_apart`: that of the worst line besides these; `lines` of the data, and `needed` ones;
    `systematic`: the correlation of the misfit (`systematic_share`), 0 where it may be noise;
    `is_beaten`: a machine outside the candidates shows that the misfit is more than noise
    (`outside`).
    """

    chi2: float
    scatter: Scatter
    correlation: float
    misses: tuple[Miss, ...]
    clear: float | None = None
    chi2_apart: float = inf
    worst_apart: float = inf
    lines: int = 0
    needed: int = 0
    systematic: float = 0.0
    is_beaten: bool = False

    def __repr__(self) -> str:
        verdict = "the data are mostly noise" if self.noisy else f"{self.level.value} the data"
        return summary(self, f"chi2 {self.chi2:.3g}, {verdict}")

    @property
    def level(self) -> Level:
        """Degree to which the candidate explains the data."""
        misses_more = self.systematic > 0 or self.is_beaten
        is_near = self.size_level is not Level.NOT and misses_more
        return Level.NEARLY if is_near else self.size_level

    @property
    def size_level(self) -> Level:
        """The level by the size of what is missed alone, whatever it looks like."""
        if self.noisy or self.too_few:
            return Level.NOT
        level = level_of(self.chi2, self.chi2_apart, self.worst_apart, self.scatter)
        gross = Counter(miss.response for miss in self.misses if miss.is_gross)
        # one place may be disturbed; a model that is elsewhere in two explains nothing apart
        is_elsewhere = level is Level.APART and max(gross.values(), default=0) > 1
        return Level.NOT if is_elsewhere else level

    @property
    def explains(self) -> bool:
        """True if the candidate explains the data, perhaps apart from something that is named."""
        return self.level in (Level.EXPLAINS, Level.APART)

    @property
    def is_near(self) -> bool:
        """True if the candidate explains the data, or does so nearly."""
        return self.level is not Level.NOT

    @property
    def too_few(self) -> bool:
        """True if the data have fewer lines than the candidate needs."""
        return self.lines < self.needed

    @property
    def noisy(self) -> bool:
        """True if the data are mostly noise."""
        return (self.scatter.clear if self.clear is None else self.clear) < FEW_CLEAR


def level_of(whole: float, apart: float, worst: float, own_scatter: Scatter) -> Level:
    """Degree to which a structure explains data of this scatter: by its chi2 per line, by that
    without the two neighbouring lines with the largest misfit, and by that of the worst line
    besides these.
    """
    if whole <= noise_limit(own_scatter):
        return Level.EXPLAINS
    near = apart <= largest_cost(own_scatter) and worst <= largest_miss(own_scatter)
    return Level.APART if near else Level.NOT


def noise_limit(own_scatter: Scatter) -> float:
    """Chi2 per line that noise alone exceeds once in 1,000 times."""
    return _critical(CHANCE, own_scatter)


def largest_cost(own_scatter: Scatter) -> float:
    """Largest chi2 per line of a model that explains data of this scatter apart from something."""
    return max(LARGEST, _critical(LEVEL, own_scatter))


def largest_miss(own_scatter: Scatter) -> float:
    """Largest chi2 of one line, besides the two with the largest misfit, of a model that explains
    data of this scatter with exceptions.
    """
    lines = len(own_scatter.rho)
    return largest_cost(own_scatter) * _critical(CHANCE / lines, own_scatter, count=2)


def _critical(level: float, own_scatter: Scatter, count: int = 0) -> float:
    """Mean square of `count` residuals, of all where it is 0, that noise exceeds so rarely."""
    count = count or 2 * len(own_scatter.rho)
    if isfinite(own_scatter.freedom):
        return float(fdtri(count, own_scatter.freedom, 1 - level))
    return float(chdtri(count, level)) / count


def needed_lines(n_parameters: int) -> int:
    """Lines without which a structure of so many parameters is not judged.

    >>> needed_lines(5)
    16
    """
    return 2 * n_parameters + BESIDE


def chi2(residual: Real, missed: Real) -> float:
    """chi2 per line of residuals, shape (n_y,), with their expected sizes; lines of weight zero
    do not count.
    """
    used = missed > 0
    return float(np.mean((residual[used] / missed[used]) ** 2)) if used.any() else 0.0


def chi2_apart(residual: Real, missed: Real, omega: Real) -> tuple[float, float]:
    """chi2 per line of residuals without the two neighbouring lines with the largest misfit, and
    that of the worst line besides these; `omega`: frequency of each residual, shape (n_y,).
    """
    used = missed > 0
    if not used.any():
        return 0.0, 0.0
    power = (residual[used] / missed[used]) ** 2
    lines, at = np.unique(omega[used], return_inverse=True)
    if len(lines) < 3:
        return float(power.mean()), float(power.max())
    size, count = np.bincount(at, power), np.bincount(at)
    worst = int(np.argmax(size[:-1] + size[1:]))
    rest = np.delete(np.arange(len(lines)), [worst, worst + 1])
    return float(size[rest].sum() / count[rest].sum()), float((size / count)[rest].max())


def systematic_share(residual: Real, missed: Real) -> float:
    """Correlation of the residuals of neighbouring lines, shape (n_y,), amplitudes first, with
    their expected sizes; 0 where noise gives it more often than once in 1,000 times.

    >>> wave = np.tile(np.sin(np.arange(50) / 3.0), 2)
    >>> round(systematic_share(wave, np.ones(100)), 2)
    0.93
    >>> systematic_share(np.tile([1.0, 1.0, -1.0, -1.0], 25), np.ones(100))
    0.0
    """
    used = np.where(missed > 0, missed, np.inf)  # a line of weight zero does not count
    kept = np.clip(residual / used, -MOST_OF_A_LINE, MOST_OF_A_LINE)
    # errors of parameters are smooth over the lines: those where they prevail tell nothing
    halves = (kept / np.maximum(used, 1.0)).reshape(2, -1)
    power = float(np.sum(halves**2))
    share = float(np.sum(halves[:, 1:] * halves[:, :-1])) / power if power else 0.0
    return share if share > -ndtri(CHANCE) / np.sqrt(residual.size) else 0.0


def line_frequencies(cost: AnyCost) -> Real:
    """Frequency of each residual [rad/s], shape (n_y,)."""
    return np.concatenate([np.tile(part.measured.omega, 2) for part in cost.parts])


def explanation(residual: Real, missed: Real, cost: Cost, own_scatter: Scatter) -> Explanation:
    """Analyse whitened residuals, shape (n_y,), of data with this scatter; `missed` = their
    expected sizes.
    """
    apart, worst = chi2_apart(residual, missed, line_frequencies(cost))
    return Explanation(
        chi2(residual, missed),
        own_scatter,
        correlation(residual),
        _misses(residual, missed, cost, own_scatter),
        chi2_apart=apart,
        worst_apart=worst,
        lines=len(cost.measured),
        # a machine that changes does so alike at neighbouring lines: no sign of its structure
        systematic=0.0 if own_scatter.source == DIFFERENCE else systematic_share(residual, missed),
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
    """Scatter of the training data and of those on which candidates are judged, including the
    change of the machine between them; `fitted`, `seen` = responses of candidates at the lines of
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
    """Analyse the whitened residuals of each response."""
    ends = np.cumsum([len(part.measured) for part in cost.parts])
    rows = (cost.by_residual(a) for a in (residual, missed))
    each = zip(cost.parts, *rows, ends, strict=True)
    return tuple(
        explanation(own, expected, part, own_scatter.at(slice(end - len(part.measured), end)))
        for part, own, expected, end in each
    )


def explain(cost: AnyCost, residual: Real, missed: Real, own_scatter: Scatter) -> Explanation:
    """Analyse the residuals of all responses together."""
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
    apart, worst = chi2_apart(residual, missed, line_frequencies(cost))
    return Explanation(
        chi2(residual, missed),
        own_scatter,
        largest,
        tuple(misses[:RANGES]),
        clear=clearest,
        chi2_apart=apart,
        worst_apart=worst,
        lines=sum(one.lines for one in each),
        systematic=max(one.systematic for one in each),
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
