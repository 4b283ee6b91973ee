"""What is said of several responses one by one: how much each scatters, and what its residuals are
like.

Responses of one machine share their parameters and no noise: nothing is carried from the last line
of one to the first of the next. Of one response all this is what `scatter`, `noise`, `explained`
and `repeatability` say.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from disting.fit.explained import RANGES, Explanation, chi2, explanation, yardstick
from disting.fit.joint import AnyCost
from disting.fit.noise import Noise, correlation, noise
from disting.fit.plant import Complex, Real
from disting.fit.repeatability import repeatability
from disting.fit.scatter import Scatter, scatter
from disting.measurement import FrequencyResponse


@dataclass(frozen=True, eq=False)
class JointNoise:
    """The noise of each response: its own deviations, its own correlation, none between two."""

    parts: tuple[Noise, ...]

    def seen(self, columns: Real) -> Real:
        """F' columns, with C = F F', shape (n_y, n)."""
        ends = np.cumsum([len(part.sigma) for part in self.parts])[:-1]
        each = zip(self.parts, np.split(columns, ends), strict=True)
        return np.concatenate([part.seen(rows) for part, rows in each])


def scatters(cost: AnyCost, fitted: Sequence[Complex]) -> Scatter:
    """Scatter of all lines; `fitted` = responses of candidates, shape (n_f,) each."""
    return _together(
        scatter(part.measured, own)
        for part, own in zip(cost.parts, _each(cost, fitted), strict=True)
    )


def yardsticks(train: AnyCost, judged: AnyCost, fitted: Sequence[Complex]) -> Scatter:
    """Scatter of the data on which candidates are judged; `fitted` = responses at its lines."""
    each = zip(partners(train, judged), judged.parts, _each(judged, fitted), strict=True)
    return _together(yardstick(first, part.measured, own) for first, part, own in each)


def repeatabilities(train: AnyCost, judged: AnyCost, best: Real) -> Scatter:
    """What training data, test data and residuals of the best candidate tell of the noise."""
    each = zip(partners(train, judged), judged.parts, judged.by_residual(best), strict=True)
    return _together(repeatability(first, part.measured, own) for first, part, own in each)


def partners(train: AnyCost, judged: AnyCost) -> list[FrequencyResponse]:
    """The training data of each response that is judged."""
    rest = iter(zip(train.setups, train.parts, strict=True))
    return [
        next(part.measured for there, part in rest if there == setup) for setup in judged.setups
    ]


def noises(
    cost: AnyCost, residual: Real, sigma: Real, missed: Real | None = None
) -> Noise | JointNoise:
    """C of the residuals, shape (n_y,), as in `noise`."""
    rows = [cost.by_residual(a) for a in (residual, sigma)]
    missing = [None] * len(cost.parts) if missed is None else cost.by_residual(missed)
    found = [noise(*own) for own in zip(*rows, missing, strict=True)]
    return found[0] if len(found) == 1 else JointNoise(tuple(found))


def correlations(cost: AnyCost, residual: Real) -> float:
    """The largest correlation of residuals of neighbouring lines."""
    return max(map(correlation, cost.by_residual(residual)))


def explanations(
    cost: AnyCost, residual: Real, missed: Real, known: Scatter
) -> tuple[Explanation, ...]:
    """What the residuals of each response say."""
    rows = (cost.by_residual(a) for a in (residual, missed))
    each = zip(cost.parts, *rows, cost.by_line(known.rho), strict=True)
    return tuple(
        explanation(own, expected, part, Scatter(rho, known.source))
        for part, own, expected, rho in each
    )


def explained(cost: AnyCost, residual: Real, missed: Real, known: Scatter) -> Explanation:
    """What the residuals of all responses say together."""
    each = explanations(cost, residual, missed, known)
    if len(each) == 1:
        return each[0]
    power = [one.chi2 * part.n_residuals for one, part in zip(each, cost.parts, strict=True)]
    whole = max(sum(power), 1e-300)
    misses = [
        replace(miss, share=miss.share * own / whole, response=setup.text)
        for one, own, setup in zip(each, power, cost.setups, strict=True)
        for miss in one.misses
    ]
    misses.sort(key=lambda miss: -miss.share)
    largest = correlations(cost, residual)
    quietest = min(one.scatter.typical for one in each)
    return Explanation(
        chi2(residual, missed), known, largest, tuple(misses[:RANGES]), quietest=quietest
    )


def _each(cost: AnyCost, fitted: Sequence[Complex]) -> list[list[Complex]]:
    """Stacked responses of candidates, for each measured response."""
    return [list(own) for own in zip(*map(cost.by_line, fitted), strict=True)] or [
        [] for _ in cost.parts
    ]


def _together(each: Iterable[Scatter]) -> Scatter:
    found = list(each)
    sources = ", ".join(dict.fromkeys(one.source for one in found))
    return Scatter(np.concatenate([one.rho for one in found]), sources)
