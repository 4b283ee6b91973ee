"""Responses of a fitted network between the measured lines, with what the data leave uncertain."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import ceil

import numpy as np

from disting.fit.judge.exclusion import FELT
from disting.fit.results.networks import FittedNetwork, NetworkSelection
from disting.fit.results.selection import Confidence
from disting.fit.search.network_plant import network_plant
from disting.measurement import FrequencyResponse
from disting.measurement.arrays import Complex, Real
from disting.model.chain import Sort
from disting.statistics.practical import standard_errors
from disting.statistics.scatter import Scatter

POINTS = 400  # of a line
HIGHEST = 20.0  # phases are shown below this angle and 90 for each differentiation [degree]


@dataclass(frozen=True, slots=True, eq=False)
class NetworkLine:
    """Response G of a fitted network at rising angular frequencies [rad/s], its phase [degree]
    without jumps, standard errors of both, and `across`: those across the curve in the complex
    plane, in the unit of G; shape (n_f,) each.
    """

    omega: Real
    G: Complex
    phase: Real
    sure: Confidence
    across: Real

    @property
    def normal(self) -> Complex:
        """Unit vectors across the curve in the complex plane, shape (n_f,)."""
        return _normal(self.G)

    def at(self, measured: FrequencyResponse) -> Complex:
        """Return the response at the measured lines."""
        return np.asarray(self.G[np.searchsorted(self.omega, measured.omega)])

    def phase_of(self, measured: FrequencyResponse) -> Real:
        """Return the phase of the data [degree], without jumps against that of the line."""
        near = self.phase[np.searchsorted(self.omega, measured.omega)]
        return np.asarray(near + np.degrees(np.angle(measured.G / self.at(measured))))


def network_line(
    fit: FittedNetwork, selection: NetworkSelection, at: int, count: int = POINTS
) -> NetworkLine:
    """Return the line of response `at`, counted from 0, over the measured band: at `count`
    frequencies and at every measured line.
    """
    measured, p = selection.measured[at], np.array(list(fit.values.values()))
    between = np.geomspace(measured.omega[0], measured.omega[-1], count)[1:-1]
    omega = np.union1d(measured.omega, between)
    omegas = [r.omega[:1] for r in selection.measured]
    plant = network_plant(fit.network, [*omegas[:at], omega, *omegas[at + 1 :]])
    response, gradient = plant.logarithmic_gradient(p)
    own = slice(at, at + len(omega))  # the other responses have one line each
    fitted, slopes = response[own], (gradient[:, own] * p[:, None]).T
    order = 1 if fit.network.sort is Sort.CIRCUIT else measured.quantity.order
    across = (_normal(fitted).conj() * fitted)[:, None] * slopes
    errors = _errors(fit, np.concatenate([slopes.real, slopes.imag, across.real]))
    amplitude, phase, width = np.split(errors, 3)
    return NetworkLine(omega, fitted, _phase(fitted, order), Confidence(amplitude, phase), width)


def _normal(fitted: Complex) -> Complex:
    """Return unit vectors across a curve in the complex plane, shape (n_f,)."""
    along = np.gradient(fitted)
    size = np.abs(along)
    return np.asarray(1j * np.divide(along, size, out=np.ones_like(along), where=size > 0))


def _phase(fitted: Complex, order: int) -> Real:
    phase = np.degrees(np.unwrap(np.angle(fitted)))
    highest = HIGHEST + 90 * order
    return np.asarray(phase - 360 * ceil((phase.max() - highest) / 360))


def _errors(fit: FittedNetwork, slopes: Real) -> Real:
    """Return standard errors of functions with gradients `slopes` by the logarithms of the values,
    shape (n, n_p); values without effect on the data do not count.
    """
    columns = fit.columns
    felt = np.linalg.norm(columns, axis=0) > FELT
    kept = columns[:, felt]
    rank = min(fit.rank, kept.shape[1])
    return standard_errors(slopes[:, felt], kept, fit.noise, rank)


def scatters_of(selection: NetworkSelection) -> Sequence[Scatter]:
    """Return the scatter of the lines of each response."""
    ends = np.cumsum([0, *(len(response) for response in selection.measured)])
    return [selection.scatter.at(slice(a, b)) for a, b in pairwise(ends)]
