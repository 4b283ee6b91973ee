"""What is said of several responses one by one: how much each scatters, and what its residuals are
like.

Responses of one machine share their parameters and no noise: nothing is carried from the last line
of one to the first of the next. Of one response all this is what `scatter`, `noise` and `explained`
say.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from disting.fit.judge.explanation import RANGES, Explanation, chi2, explanation
from disting.fit.noise.covariance import Noise, correlation, noise
from disting.fit.noise.scatter import Scatter, changed, scatter, widened
from disting.fit.search.joint import AnyCost
from disting.measurement import FrequencyResponse
from disting.measurement.arrays import Complex, Real


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
        return together(inside), together(inside)
    outside = scatters(judged, seen)
    for k, part in enumerate(judged.parts):
        at = train.setups.index(judged.setups[k])
        first = train.parts[at].measured
        tau = changed(first, part.measured, inside[at], outside[k])
        inside[at], outside[k] = widened(inside[at], tau), widened(outside[k], tau)
    return together(inside), together(outside)


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
    """What the whitened residuals of each response say."""
    ends = np.cumsum([len(part.measured) for part in cost.parts])
    rows = (cost.by_residual(a) for a in (residual, missed))
    each = zip(cost.parts, *rows, ends, strict=True)
    return tuple(
        explanation(own, expected, part, known.at(slice(end - len(part.measured), end)))
        for part, own, expected, end in each
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
    clearest = max(one.scatter.clear for one in each)
    return Explanation(
        chi2(residual, missed), known, largest, tuple(misses[:RANGES]), clear=clearest
    )


def _each(cost: AnyCost, fitted: Sequence[Complex]) -> list[list[Complex]]:
    """Stacked responses of candidates, for each measured response."""
    return [list(own) for own in zip(*map(cost.by_line, fitted), strict=True)] or [
        [] for _ in cost.parts
    ]


def together(each: Iterable[Scatter]) -> Scatter:
    """The scatter of all lines."""
    found = list(each)
    return Scatter(
        np.concatenate([one.rho for one in found]),
        np.concatenate([one.size for one in found]),
        ", ".join(dict.fromkeys(one.source for one in found)),
        sum(one.freedom for one in found),
        "; ".join(dict.fromkeys(one.doubt for one in found if one.doubt)),
    )
