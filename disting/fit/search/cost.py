"""The three cost functions of section 2.3 and their sensitivity matrices, equations (6) to (15).

With g = G(p)/G_M line by line, the residuals of one line are, each times its weights:

    case 1 (7):   Re G - Re G_M, Im G - Im G_M;  S_1 = Re, Im of G dlnG/dp           (9)
    case 2 (12):  |G| - |G_M|,   arg g;          S_2 = |G| Re dlnG/dp, Im dlnG/dp    (13)
    case 3 (14):  log10 |g|,     arg g;          S_3 = Re dlnG/dp / ln 10, Im dlnG/dp (15)

arg g lies in (-pi, pi]: the difference of two separately unwrapped phases would depend on where
each unwrapping began. Case 3 uses d ln G only, to which s^n adds nothing: cost and criteria do not
depend on the sensor quantity.
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass, replace
from enum import IntEnum
from functools import cached_property
from math import log, pi, sqrt

import numpy as np
from numpy.typing import NDArray

from disting.errors import InputError
from disting.fit.search.plant import Differentiable, Plant
from disting.fit.search.setup import Setup
from disting.measurement import FrequencyResponse
from disting.measurement.arrays import Complex, Real, spread
from disting.measurement.observation import Observation
from disting.model.chain import Chain, Structure
from disting.model.presentation import plural, summary
from disting.statistics.scatter import Scatter

Indices = NDArray[np.intp]
NOISE = 3.0  # times the usual step of a response from line to line: what noise may make


def comparable(cost: float) -> float:
    """A cost to six digits: further ones are those of the last step of a search, and differ from
    machine to machine.

    >>> comparable(207.80017266) == comparable(207.80018145)
    True
    """
    return float(f"{cost:.6g}")


class Case(IntEnum):
    """Definition of the residuals: complex plane (7), amplitude and phase (12), logarithm of the
    amplitude and phase (14).

    >>> Case(3) is Case.LOGARITHM
    True
    """

    COMPLEX = 1
    AMPLITUDE = 2
    LOGARITHM = 3


class SquaredCost(ABC):
    """J = |residual|^2, of one response or of several."""

    @property
    @abstractmethod
    def n_residuals(self) -> int:
        """N_y."""

    @abstractmethod
    def residual(self, response: Complex) -> Real:
        """Weighted residuals, shape (..., 2 n_f), of responses of shape (..., n_f)."""

    @abstractmethod
    def sensitivity(self, response: Complex, gradient: Complex) -> Real:
        """S, shape (..., 2 n_f, n_p), from G and d ln G / d p, shape (..., n_p, n_f)."""

    def of_starts(self, at: Indices) -> "SquaredCost":
        """The cost of the starts `at` of a search from several: the same of all."""
        return self

    def total(self, response: Complex) -> Real:
        """J of (6), (12) or (14), shape (...)."""
        residual = self.residual(response)
        return np.asarray(np.einsum("...i,...i->...", residual, residual))

    def of(self, plant: Differentiable, p: Real) -> tuple[Real, Real]:
        """Residuals and S d p / d ln p, the sensitivity to logarithms of the parameters:
        columns S_j p_j of (16).
        """
        response, gradient = plant.logarithmic_gradient(p)
        gradient *= p[..., None]
        return self.residual(response), self.sensitivity(response, gradient)


@dataclass(frozen=True, eq=False)
class CostOfEach(SquaredCost):
    """A cost of which each start of a search sees some residuals: `seen`, shape (n_s, N_y), is 1
    for those and 0 for the others.
    """

    whole: SquaredCost
    seen: Real

    @property
    def n_residuals(self) -> int:
        """N_y, seen or not."""
        return self.whole.n_residuals

    def of_starts(self, at: Indices) -> "CostOfEach":
        """The same of some of the starts."""
        return CostOfEach(self.whole, self.seen[at])

    def residual(self, response: Complex) -> Real:
        """Residuals, shape (n_s, N_y), of one response a start; 0 where it is not seen."""
        return self.whole.residual(response) * self.seen

    def sensitivity(self, response: Complex, gradient: Complex) -> Real:
        """S, shape (n_s, N_y, n_p), likewise."""
        return self.whole.sensitivity(response, gradient) * self.seen[..., None]


@dataclass(frozen=True, eq=False)
class Cost(SquaredCost):
    """J = |residual|^2 of a measured response; `weights` of the two residuals of a line, `lines`
    of each line, shape (n_f,).

    Weights default to (pi, 1) in case 3, as in the paper: 20 dB count as much as 180 degrees; to
    (1, 1) in cases 1 and 2.
    """

    measured: FrequencyResponse
    case: Case = Case.LOGARITHM
    weights: tuple[float, float] | None = None
    lines: Real | None = None

    def __post_init__(self) -> None:
        if self.lines is not None and np.shape(self.lines) != np.shape(self.measured.omega):
            raise InputError(
                f"one weight a line is needed: {len(self.measured.omega)}, not"
                f" {np.size(self.lines)}"
            )

    def __repr__(self) -> str:
        return summary(self, f"case {self.case.value}, {plural(len(self.measured), 'line')}")

    @property
    def n_residuals(self) -> int:
        """N_y = 2 n_f."""
        return 2 * len(self.measured.omega)

    def residual(self, response: Complex) -> Real:
        """Weighted residuals, shape (..., 2 n_f), of responses of shape (..., n_f)."""
        first, second = self._both
        if self.case is Case.COMPLEX:
            error = response - self.measured.G
            return np.concatenate([error.real * first, error.imag * second], axis=-1)
        ratio = response * self._inverse
        if self.case is Case.AMPLITUDE:
            amplitude = np.abs(response) - np.abs(self.measured.G)
        else:
            amplitude = np.log(ratio.real**2 + ratio.imag**2) * (0.5 / log(10))
        return np.concatenate(
            [amplitude * first, np.arctan2(ratio.imag, ratio.real) * second], axis=-1
        )

    def sensitivity(self, response: Complex, gradient: Complex) -> Real:
        """S, shape (..., 2 n_f, n_p), from G and d ln G / d p, shape (..., n_p, n_f)."""
        first, second = self._both
        if self.case is Case.COMPLEX:
            gradient = gradient * response[..., None, :]
        n_f = response.shape[-1]
        columns = np.empty((*gradient.shape[:-1], 2 * n_f))
        amplitude = first * np.abs(response)[..., None, :] if self.case is Case.AMPLITUDE else first
        scale = amplitude / log(10) if self.case is Case.LOGARITHM else amplitude
        np.multiply(gradient.real, scale, out=columns[..., :n_f])
        np.multiply(gradient.imag, second, out=columns[..., n_f:])
        return columns.swapaxes(-1, -2)

    def scatter(self, scatter: Scatter) -> Real:
        """Standard deviation of the residuals, shape (2 n_f,), of data that scatter so."""
        first, second = self._both
        plane = scatter.rho * scatter.size
        amplitude = scatter.rho / log(10) if self.case is Case.LOGARITHM else plane
        phase = plane if self.case is Case.COMPLEX else scatter.rho
        return np.concatenate([first * amplitude, second * phase])

    def likely(self, scatter: Scatter) -> "Cost":
        """Minus twice the logarithm of the likelihood of data that scatter so, but for a constant:
        squared distances in the complex plane in units of sigma / sqrt 2, of variance 1 each.
        """
        return replace(self, case=Case.COMPLEX, weights=None, lines=sqrt(2) / scatter.sigma)

    def windowed(self) -> "Cost":
        """Of what Welch's method shows, which is the response under a window."""
        return replace(self, measured=self.measured.windowed())

    @property
    def observation(self) -> Observation | None:
        """Observation by which lines show a response; None where they show it unchanged."""
        window, hold = self.measured.window, self.measured.hold
        segment: tuple[float, int] | None = None
        if window is not None and window.ratio is None:
            segment = window.duration, window.order
        return Observation(segment, hold) if segment or hold else None

    @property
    def leading(self) -> "Cost":
        """The cost that leads a search: of logarithms, each line with its relative weight."""
        if self.case is Case.LOGARITHM:
            return self
        lines = 1.0 if self.lines is None else self.lines
        return replace(
            self, case=Case.LOGARITHM, weights=None, lines=lines * np.abs(self.measured.G)
        )

    @property
    def parts(self) -> tuple["Cost", ...]:
        """The costs of the single responses: this one."""
        return (self,)

    @property
    def setups(self) -> tuple[Setup, ...]:
        """Setups of the responses."""
        return (Setup(),)

    def setups_of(self, structure: Structure) -> tuple[Setup, ...]:
        """The same of every structure."""
        return self.setups

    @property
    def delays(self) -> tuple[str, ...]:
        """Dead times in addition to that of the chain: none."""
        return ()

    def plant(self, structure: Structure, sign: int) -> Plant:
        """The structure at the lines of the data."""
        return Plant(structure, self.measured.omega, sign, observation=self.observation)

    def on(self, chain: Chain) -> "Cost":
        """Of the responses that a chain has: every chain has this one."""
        return self

    def thinned(self, count: int) -> "Cost":
        """The cost of `count` of the lines, half of them evenly spaced on a logarithmic scale, half
        where the response moves; itself if there are no more.
        """
        if count >= len(self.measured):
            return self
        at = spread(_way(self.measured), count)
        lines = None if self.lines is None else self.lines[at]
        return replace(self, measured=self.measured.subset(at), lines=lines)

    def by_line(self, values: NDArray) -> list[NDArray]:  # type: ignore[type-arg]
        """Values of lines for each response."""
        return [values]

    def by_residual(self, values: Real) -> list[Real]:
        """Values of residuals for each response."""
        return [values]

    @cached_property
    def _both(self) -> tuple[Real, Real]:
        first, second = self.weights or ((pi, 1.0) if self.case is Case.LOGARITHM else (1.0, 1.0))
        lines = np.ones(len(self.measured.omega)) if self.lines is None else self.lines
        return first * lines, second * lines

    @cached_property
    def _inverse(self) -> Complex:
        return 1.0 / self.measured.G


def _way(measured: FrequencyResponse) -> Real:
    """The logarithm of the frequency, and how far ln G has moved by more than it does from line to
    line by noise, each from 0 to 1, in sum; shape (n_f,).
    """
    logarithm = np.log(measured.omega / measured.omega[0])
    steps = np.abs(np.log(measured.G[1:] / measured.G[:-1]))
    moved = np.append(0.0, np.cumsum(np.maximum(steps - NOISE * np.median(steps), 0.0)))
    tiny = np.finfo(float).tiny
    return np.asarray(logarithm / logarithm[-1] + moved / max(float(moved[-1]), tiny))


def lines_by_deviation(measured: FrequencyResponse) -> Real:
    """Weight |G|/sigma of each line, scaled to a mean square of 1; raises InputError where the
    data has no deviation.

    >>> from disting.measurement import from_arrays
    >>> data = from_arrays(range(1, 9), [1, 7] * 4, deviation=[1.0] * 8)
    >>> lines_by_deviation(data)[:2].round(6).tolist()
    [0.2, 1.4]
    """
    if measured.deviation is None:
        raise InputError(
            "weights by standard deviation need a response that carries one; choose other weights"
        )
    return _scale_weights(
        np.abs(measured.G) / np.maximum(measured.deviation, 1e-12 * np.abs(measured.G))
    )


def lines_by_coherence(measured: FrequencyResponse) -> Real:
    """Weight sqrt(gamma^2 / (1 - gamma^2)), the inverse of the relative deviation, scaled to a mean
    square of 1. Raises InputError for a response without coherence.

    >>> from disting.measurement import from_arrays
    >>> data = from_arrays(range(1, 9), [1] * 8, coherence=[0.9] * 8)
    >>> lines_by_coherence(data)[:2].round(6).tolist()
    [1.0, 1.0]
    """
    if measured.coherence is None:
        raise InputError(
            "weights by coherence need a response that carries one; choose other weights"
        )
    squared = np.clip(measured.coherence, 0.0, 1.0 - 1e-9)
    return _scale_weights(np.sqrt(squared / (1.0 - squared)))


def _scale_weights(weights: Real) -> Real:
    size = sqrt(float(np.mean(weights**2)))
    if not size > 0:
        raise InputError("all lines have weight zero")
    return np.asarray(weights / size)
