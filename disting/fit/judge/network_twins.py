"""Networks with the same responses as a fitted one, with their own values.

Where a verdict says that two networks give the same responses for all positive values, the values
of the other one are those at which its responses are the fitted ones: least squares without noise,
which ends at rounding. Where several sets of values do that, those found are given.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from disting.fit.judge.explanation import noises
from disting.fit.judge.interval import Interval
from disting.fit.judge.network_intervals import deviations, network_intervals
from disting.fit.search.data import WhitenedCost
from disting.fit.search.descent import Box, fine
from disting.fit.search.network_plant import AnyNetworkPlant
from disting.measurement import FrequencyResponse
from disting.measurement.arrays import Complex, Real
from disting.network.network import Network

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
