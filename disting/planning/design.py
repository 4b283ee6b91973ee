"""What to excite: bands and spectra beside the planned lines, as an excitation that can be run.

A bench limits the power of an excitation, or its largest value. The peak of a multisine is its root
mean square times its crest factor; so at an equal peak the noncentrality of a spectrum is that at
an equal power times the squared ratio of the crest factors.
"""

from dataclasses import dataclass
from math import ceil
from typing import Any

import numpy as np

from disting.planning.power import Answer, Plan, plan_to_dict
from disting.planning.spectrum import Adversary, Band, Spectrum, best_band, optimal, runnable
from disting.measurement.arrays import Real
from disting.model.presentation import plural, summary
from disting.simulation import Excitation

OVERSAMPLED = 5.0  # sampling rate, in highest frequencies
RESOLVED = 20  # lines of the bench below the lowest planned one


@dataclass(frozen=True, slots=True, eq=False)
class Design:
    """The best band, the optimal spectrum, and the one to be run, on lines [Hz]."""

    hertz: Real
    band: Band
    optimum: Spectrum
    run: Spectrum

    def __repr__(self) -> str:
        return summary(
            self,
            f"{plural(len(self.hertz), 'line')}, {self.hertz[0]:.4g} to {self.hertz[-1]:.4g} Hz",
        )

    @property
    def rate(self) -> float:
        """Sampling rate [Hz] at which the spectrum can be run."""
        return float(ceil(OVERSAMPLED * self.hertz[-1]))

    @property
    def samples(self) -> int:
        """Of a period."""
        return 2 * ceil(self.rate * RESOLVED / float(self.hertz[0]) / 2)

    def excitation(self, shares: Real) -> Excitation:
        """The multisine of a spectrum, root mean square 1."""
        amplitudes = np.sqrt(shares / shares.max())
        pairs = zip(self.hertz.tolist(), amplitudes.tolist(), strict=True)
        return Excitation(spectrum=tuple((f, a) for f, a in pairs if a > 0))

    def crest(self, shares: Real) -> float:
        """Crest factor of its multisine."""
        return float(np.abs(self.excitation(shares).period(self.samples, self.rate)).max())

    @property
    def crests(self) -> tuple[float, float]:
        """Crest factors of equal lines and of the spectrum to be run."""
        alike = np.full(len(self.hertz), 1.0 / len(self.hertz))
        return self.crest(alike), self.crest(self.run.shares)

    @property
    def at_equal_peak(self) -> float:
        """Noncentrality of the spectrum to be run whose peak, not power, is that of equal lines."""
        before, after = self.crests
        return self.run.noncentrality * (before / after) ** 2


def design(plan: Plan) -> Design | None:
    """Band and spectra against a rival; None where no effort is enough."""
    if plan.rival is None or plan.answer is Answer.SAME:
        return None
    adversary = Adversary(plan.rival)
    band = best_band(adversary)
    best = optimal(adversary)
    return Design(plan.rival.hertz, band, best, runnable(adversary, best))


def designed_to_dict(plan: Plan, best: Design | None) -> dict[str, Any]:
    """Plain data of a plan with its spectra; `shares` of the power by line."""
    plain = plan_to_dict(plan)
    if best is None:
        return plain
    return plain | {
        "band": _sized(plan, best.band.noncentrality)
        | {"low": best.band.low, "high": best.band.high},
        "optimal": _sized(plan, best.optimum.noncentrality)
        | {"bound": best.optimum.bound, "lines": best.optimum.lines},
        "run": _sized(plan, best.run.noncentrality)
        | {
            "noncentrality_at_equal_peak": best.at_equal_peak,
            "crest_factors": list(best.crests),
            "rate": best.rate,
            "samples": best.samples,
        },
        "frequency": best.hertz.tolist(),
        "shares_optimal": best.optimum.shares.tolist(),
        "shares_run": best.run.shares.tolist(),
    }


def _sized(plan: Plan, noncentrality: float) -> dict[str, float]:
    return {
        "noncentrality": noncentrality,
        "power": plan.power_at(noncentrality),
        "factor": plan.needed / noncentrality,
    }
