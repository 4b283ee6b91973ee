"""Whether a candidate explains the data: its residuals against the scatter of the lines, in
absolute terms.

With residuals r in units of the scatter (`whitened`) and what they are expected to be, the errors
of the parameters included (`covariance.expected`),

    chi2 per line = mean (r / expected)^2

is 1 for the true model and independent of what other candidates do. A candidate explains the data
if it is at most `LARGEST`, more where the scatter itself is known from little (F test); none does
where the data themselves are mostly noise: less than `FEW_CLEAR` of the lines scatter by less than
20 %.
"""

from dataclasses import dataclass
from math import degrees, isfinite, pi

import numpy as np
from scipy.stats import chi2 as chi2_distribution
from scipy.stats import f as f_distribution

from disting.fit.noise.covariance import correlation
from disting.fit.noise.scatter import Scatter
from disting.fit.search.cost import Cost
from disting.measurement.arrays import Real
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
        return self.chi2 <= allowed(self.scatter) and not self.noisy

    @property
    def noisy(self) -> bool:
        """Whether the data are mostly noise."""
        return (self.scatter.clear if self.clear is None else self.clear) < FEW_CLEAR


def allowed(known: Scatter) -> float:
    """Largest chi2 per line of a model that explains data of this scatter."""
    count = 2 * len(known.rho)
    if isfinite(known.freedom):
        return max(LARGEST, float(f_distribution.isf(LEVEL, count, known.freedom)))
    return max(LARGEST, float(chi2_distribution.isf(LEVEL, count)) / count)


def chi2(residual: Real, missed: Real) -> float:
    """chi2 per line of residuals, shape (n_y,), with their expected sizes; lines of weight zero
    do not count.
    """
    used = missed > 0
    return float(np.mean((residual[used] / missed[used]) ** 2)) if used.any() else 0.0


def explanation(residual: Real, missed: Real, cost: Cost, known: Scatter) -> Explanation:
    """What whitened residuals, shape (n_y,), of data with this scatter say; `missed` = their
    expected sizes.
    """
    return Explanation(
        chi2(residual, missed), known, correlation(residual), _misses(residual, missed, cost, known)
    )


def _misses(residual: Real, missed: Real, cost: Cost, known: Scatter) -> tuple[Miss, ...]:
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
    factor, angle = _plain(residual, known)
    hertz, total = cost.measured.frequency, max(float(power.sum()), 1e-300)
    shares = [float(power[run[0] : run[-1] + 1].sum()) / total for run in runs]
    found = [
        Miss(
            low=float(hertz[run[0]]),
            high=float(hertz[run[-1]]),
            factor=float(factor[run].max()),
            angle=float(angle[run].max()),
            share=share,
        )
        for run, share in zip(runs, shares, strict=True)
    ]
    return tuple(sorted(found, key=lambda miss: -miss.share)[:RANGES])


def _plain(residual: Real, known: Scatter) -> tuple[Real, Real]:
    """|ln of the amplitudes' ratio| and |difference of the phases| [rad], shape (n_f,) each."""
    along, across = residual.reshape(2, -1) * known.rho
    ratio = np.log(np.maximum(np.abs(1 + along + 1j * across), 1e-300))
    return np.abs(ratio), np.minimum(np.abs(np.arctan2(across, 1 + along)), pi)
