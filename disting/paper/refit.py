"""Fig. 12: A4 fitted to the exact frequency response of a damped A1.

Without damping the two are indistinguishable: both have rank 5 for 5 non-constant coefficients
(condition 7), so resonances and antiresonances can agree. With damping, two dampers face the
damping ratios of two poles and two zeros.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from math import pi
from types import MappingProxyType

import numpy as np

from disting.fit import Cost, Plant, Task, estimates
from disting.fit.judge.modes import oscillations, poles, zeros
from disting.measurement import FrequencyResponse
from disting.measurement.arrays import Real
from disting.model.chain import Chain
from disting.model.family import Family

GIVEN: Mapping[str, float] = MappingProxyType(
    {"m1": 0.005, "m2": 0.01, "m3": 0.01, "k12": 1000.0, "k23": 1000.0, "d12": 0.2, "d23": 0.02}
)
"""Parameters of A1 in SI units: the size of a small servo drive, its first coupling ten times
as damped as the second.
"""
LINES = 400
# the response reaches this factor below the first antiresonance and above the last resonance
BAND = 3.0


@dataclass(frozen=True, slots=True)
class Mode:
    """A resonance or antiresonance: frequencies [Hz] and damping ratios in A1 and in the fitted
    A4.
    """

    name: str
    frequencies: tuple[float, float]
    damping: tuple[float, float]

    @property
    def detuned(self) -> float:
        """Relative error of the frequency."""
        return abs(self.frequencies[1] / self.frequencies[0] - 1)

    @property
    def misdamped(self) -> float:
        """Relative error of the damping ratio."""
        return abs(self.damping[1] / self.damping[0] - 1)


@dataclass(frozen=True, eq=False)
class Refit:
    """A1 with numbers and the A4 that fits it best; `j` = cost (14) over `LINES` lines."""

    source: Chain
    fitted: Chain
    given_parameters: Mapping[str, float]
    fitted_parameters: Mapping[str, float]
    measured: FrequencyResponse
    j: float

    @property
    def modes(self) -> tuple[Mode, ...]:
        """Antiresonances and resonances of both, by rising frequency."""
        return (*self._modes("antiresonance"), *self._modes("resonance"))

    def _modes(self, kind: str) -> tuple[Mode, ...]:
        roots = zeros if kind == "antiresonance" else poles
        ours = oscillations(
            roots(self.source.structure, _vector(self.source, self.given_parameters))
        )
        theirs = oscillations(
            roots(self.fitted.structure, _vector(self.fitted, self.fitted_parameters))
        )
        pairs = enumerate(zip(ours, theirs, strict=True), 1)
        return tuple(
            Mode(
                f"{kind} {i}",
                (abs(a) / (2 * pi), abs(b) / (2 * pi)),
                (-a.real / abs(a), -b.real / abs(b)),
            )
            for i, (a, b) in pairs
        )


def refit(parameters: Mapping[str, float] = GIVEN) -> Refit:
    """The best A4 for the exact response of A1 with the given parameters."""
    family = Family(3, damped=True)
    source, target = family[1], family[4]
    p = _vector(source, parameters)
    low = abs(oscillations(zeros(source.structure, p))[0]) / BAND
    high = abs(oscillations(poles(source.structure, p))[-1]) * BAND
    omega = np.geomspace(low, high, LINES)
    measured = FrequencyResponse(omega, Plant(source.structure, omega).response(p))
    estimate = estimates([target], Task(Cost(measured)))[target]
    return Refit(
        source=source,
        fitted=target,
        given_parameters=parameters,
        fitted_parameters=estimate.parameters,
        measured=measured,
        j=estimate.j,
    )


def _vector(chain: Chain, values: Mapping[str, float]) -> Real:
    return np.array([values[name] for name in chain.parameters])
