"""Covariance C of the residuals of a fit: the scatter of the lines, the misfit of the model in
addition, and the correlation of both.

    C_ij = sigma_i sigma_j r^|i-j|  for amplitudes of lines i and j, and likewise for phases; none
                                    between both.

sigma is the scatter of the lines (`Cost.scatter`), and larger where the residuals near by are
significantly larger: what a model misses is an error of its parameters too. r is the correlation
of residuals of neighbouring lines, zero unless it is significant. With sensitivities S the
parameters of a fit by least squares have the covariance

    H (S' C S) H,    H = (S' S)^-1

(the sandwich of Huber 1967 and White 1980; for correlated residuals Newey and West 1987). H J /
(n_y - n_p) is right for equal and independent residuals alone, while a fit in logarithms weighs
lines alike that scatter differently.
"""

from dataclasses import dataclass
from math import sqrt

import numpy as np
from scipy.linalg import solve_banded

from disting.measurement.arrays import Real

NEAR = 5  # lines to either side whose residuals are looked at together
# standard deviations by which they must exceed the scatter, or a correlation zero: all lines are
# tried
SIGNIFICANT = 4.0
MOST = 0.97  # of a correlation
# share of the largest singular value below which a direction of the parameters has no effect
VANISHING = 1e-8


@dataclass(frozen=True, eq=False)
class Noise:
    """sigma, shape (n_y,), amplitudes of all lines first; `correlation` r of neighbouring
    lines, 0 <= r < 1.

    >>> round(Noise(np.ones(8), correlation=0.5).effective, 3)
    0.333
    """

    sigma: Real
    correlation: float = 0.0

    def seen(self, columns: Real) -> Real:
        """F' columns, with C = F F': shape (n_y, n). S' C S is the square of F' S, which is
        never formed.
        """
        scaled = np.asarray(columns * self.sigma[:, None])
        if not self.correlation:
            return scaled
        halves = np.split(scaled, 2)
        return np.concatenate([_carry_rows(half, self.correlation) for half in halves])

    @property
    def effective(self) -> float:
        """Share of the lines that count as independent: (1 - r) / (1 + r)."""
        return (1 - self.correlation) / (1 + self.correlation)


def equal(j: float, n_y: int, n_p: int) -> Noise:
    """Independent residuals of equal variance s^2 = J / (n_y - n_p)."""
    return Noise(np.full(n_y, sqrt(j / (n_y - n_p)) if n_y > n_p else np.inf))


def expected_deviation(
    fitted: Real, sigma: Real, seen: Real | None = None, other_values: Real | None = None
) -> Real:
    """Standard deviation of residuals of the true structure, shape (n_y,): scatter of the lines
    and of the parameters.

    `fitted` = sensitivities S at the lines of the fit, shape (n_y, n_p), which scatter by `sigma`;
    `seen`, `other_values` = the same at the lines that are judged, if these are others. A fit drawn
    by loud lines misses quiet ones by more than they scatter.
    """
    seen, other_values = (
        (fitted, sigma) if seen is None or other_values is None else (seen, other_values)
    )
    if not fitted.shape[1]:
        return other_values
    length = np.linalg.norm(fitted, axis=0)
    length = np.where(length > 0, length, 1.0)
    left, values, right = np.linalg.svd(fitted / length, full_matrices=False)
    is_seen = values > VANISHING * values[0]
    half = (left[:, is_seen] * sigma[:, None]) / values[is_seen] @ right[is_seen]
    # in units of the lengths: the square of a column that hardly matters has no number
    seen = seen / length
    return np.asarray(
        np.sqrt(
            other_values**2 + np.maximum(np.einsum("ij,jk,ik->i", seen, half.T @ half, seen), 0.0)
        )
    )


def noise(residual: Real, sigma: Real, missed: Real | None = None) -> Noise:
    """C of residuals, shape (n_y,), at lines that scatter by `sigma`; `missed` = what a fit is
    to miss (`expected_deviation`).
    """
    sigma = np.maximum(sigma, np.finfo(float).tiny)  # a line of weight zero
    missed = sigma if missed is None else np.maximum(missed, sigma)
    power = ((residual / missed) ** 2).reshape(2, -1).sum(axis=0)
    count = 2 * _near(np.ones(len(power)))
    local = _near(power) / count
    excess = np.tile(np.where(local > 1 + SIGNIFICANT * np.sqrt(2 / count), local, 1.0), 2)
    # Errors of parameters are smooth over the lines: those where they prevail tell nothing of a
    # correlation.
    return Noise(
        sigma * np.sqrt(excess), correlation(residual * sigma / (missed**2 * np.sqrt(excess)))
    )


def _near(power: Real) -> Real:
    """Sums over the lines near each line, also of fewer lines than lie near one."""
    return np.asarray(np.convolve(power, np.ones(2 * NEAR + 1))[NEAR : NEAR + len(power)])


def correlation(residual: Real) -> float:
    """Correlation of residuals, shape (n_y,), of neighbouring lines; zero unless it is
    significant.
    """
    halves = residual.reshape(2, -1)
    power = float(np.sum(halves**2))
    correlation = float(np.sum(halves[:, 1:] * halves[:, :-1])) / power if power else 0.0
    return min(correlation, MOST) if correlation > SIGNIFICANT / sqrt(residual.size) else 0.0


def _carry_rows(rows: Real, r: float) -> Real:
    """L' rows, with L L' = r^|i-j|: what each independent innovation of the chain of lines
    moves.
    """
    bands = np.repeat([[-r], [1.0]], len(rows), axis=1)
    moved = np.asarray(solve_banded((0, 1), bands, rows))
    moved[1:] *= sqrt(1 - r * r)
    return moved
