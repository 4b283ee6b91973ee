"""How much a measured line scatters: the yardstick of every statement on a fit.

rho_k is the standard deviation of ln |G| and of arg G of line k (0.01 = 1 %, 0.01 rad). It comes
from what is known, in this order:

- the standard deviations that come with the data, rho = deviation / (|G| sqrt 2);
- its coherence, for which rho is proportional to sqrt((1 - g^2) / g^2), and neighbouring lines for
  the factor;
- neighbouring lines alone: ln G of four lines, less the parabola through them, leaves one complex
  number c' ln G, |c| = 1, with E |c' ln G|^2 = 2 rho^2, exponentially distributed; its lower
  quarter among the lines near by does not see resonances. Where the response bends more than it
  scatters, it is divided first by those of fitted candidates; the smallest result counts, since
  division by a wrong model adds bends and takes no scatter away.

Deviations from repeats of one excitation do not see what the excitation makes itself: distortion
by friction and play repeats with it, and jumps from line to line. So neighbouring lines count
there too where they scatter more, up to `DISTORTED`. And between two measurements of a machine
more changes than scatters within one of them, as friction changes with the amplitude. Lines that
both have, rho^2 = mean |ln(G_1/G_2)|^2 / 4, show that (`between`): a fit to the one must be
expected to miss the other by so much.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import log, sqrt

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray
from scipy.ndimage import median_filter

from disting.fit.plant import Complex, Real
from disting.measurement import FrequencyResponse
from disting.model.shown import summary

COMMON = 8  # lines that two measurements must share
SAME = 1e-6  # relative distance of two frequencies that count as one
NEAR = 41  # contrasts of neighbouring lines of which the lower quarter is taken
QUARTER = 0.25
# rho up to which lines that jump are distorted; beyond, the grid may be too coarse for the
# resonances
DISTORTED = 0.05
LEAST = 1e-5  # scatter below this is the rounding of a file
BESIDE = 11  # lines near by whose deviations are compared
UNEVEN = 0.5  # of their median: a deviation below is chance, of few repeats
# ratio of what neighbouring lines scatter to their deviations, from which on it is no chance
JUMPING = 1.5


@dataclass(frozen=True, eq=False)
class Scatter:
    """rho of every line, shape (n_f,), and in words where it comes from."""

    rho: Real
    source: str

    def __repr__(self) -> str:
        return summary(self, f"{100 * self.typical:.3g} %, from {self.source}")

    @property
    def typical(self) -> float:
        """Root mean square of rho: 0.01 means 1 % in amplitude, 0.01 rad in phase."""
        return sqrt(float(np.mean(self.rho**2)))


def scatter(measured: FrequencyResponse, fitted: Sequence[Complex] = ()) -> Scatter:
    """Scatter of a measured response; `fitted` = responses of candidates at its lines, shape
    (n_f,) each.
    """
    if measured.deviation is not None and np.any(measured.deviation > 0):
        known = measured.deviation / np.abs(measured.G) / sqrt(2)
        usual = median_filter(known, BESIDE, mode="nearest")
        known = np.maximum(known, np.maximum(UNEVEN * usual, LEAST))
        jumps = _neighbours(measured, fitted, np.ones(len(measured)))
        if np.median(jumps / known) > JUMPING and np.median(jumps) <= DISTORTED:
            return Scatter(
                np.maximum(known, jumps),
                "neighbouring lines, which jump by more than their standard deviations",
            )
        return Scatter(known, "the standard deviations of the data")
    if measured.coherence is not None and np.any(measured.coherence < 1):
        squared = np.clip(measured.coherence, 1e-6, 1 - 1e-6)
        rho, source = (
            np.sqrt((1 - squared) / squared),
            "the coherence, its level from neighbouring lines",
        )
        return Scatter(np.maximum(_neighbours(measured, fitted, rho), LEAST), source)
    return Scatter(
        np.maximum(_neighbours(measured, fitted, np.ones(len(measured))), LEAST),
        "neighbouring lines",
    )


def _neighbours(measured: FrequencyResponse, fitted: Sequence[Complex], shape: Real) -> Real:
    """The smallest estimate from neighbouring lines, of the response and of its quotients by
    fitted ones.
    """
    responses = [measured.G, *(measured.G / other for other in fitted)]
    found = [_from_neighbours(measured.omega, response, shape) for response in responses]
    return min(found, key=lambda rho: float(np.median(rho)))


def between(one: FrequencyResponse, other: FrequencyResponse) -> float | None:
    """Typical rho that two measurements differ by at the lines that they share; None where
    these are too few.
    """
    at, common = shared(one, other)
    if one is other or common.sum() < COMMON:
        return None
    ratio = np.log(other.G[common] / one.G[at[common]])
    return sqrt(float(np.mean(np.abs(ratio) ** 2)) / 4)  # two measurements, two components


def shared(
    one: FrequencyResponse, other: FrequencyResponse
) -> tuple[NDArray[np.intp], NDArray[np.bool_]]:
    """For each line of `other` the nearest one of `one`, and whether they are the same; shape
    (n_f,) each.
    """
    at = np.clip(np.searchsorted(one.omega, other.omega), 1, len(one.omega) - 1)
    at -= other.omega - one.omega[at - 1] < one.omega[at] - other.omega
    return at, np.abs(one.omega[at] - other.omega) <= SAME * other.omega


def _from_neighbours(omega: Real, response: Complex, shape: Real) -> Real:
    """rho from contrasts of four neighbouring lines, shape (n_f,); `shape` of the scatter over
    the lines as far as known.
    """
    logarithm = np.log(np.abs(response)) + 1j * np.unwrap(np.angle(response))
    x, y, w = (sliding_window_view(a, 4) for a in (np.log(omega), logarithm, shape))
    apart = x[:, :, None] - x[:, None, :] + np.eye(4)
    contrast = 1.0 / apart.prod(axis=2)  # divided differences of third order vanish on parabolas
    power = np.abs((contrast * y).sum(axis=1)) ** 2 / (
        -2 * log(1 - QUARTER) * ((contrast * w) ** 2).sum(axis=1)
    )
    if len(power) <= NEAR:
        return np.asarray(shape * sqrt(float(np.quantile(power, QUARTER))))
    low = np.quantile(sliding_window_view(power, NEAR), QUARTER, axis=1)
    before = (len(omega) - len(low)) // 2
    return np.asarray(
        shape * np.sqrt(np.pad(low, (before, len(omega) - len(low) - before), mode="edge"))
    )
