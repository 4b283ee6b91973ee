"""What neighbouring lines tell of the scatter of a line: pure error, which no model explains.

A local quadratic through the six nearest lines predicts each line k of R = G / G_fit,

    e_k = R_k - sum_j h_kj R_j,    E |e_k G_fit,k|^2 = sum_j C_kj sigma_j^2,
    C_kj = (delta_kj + h_kj^2) |G_fit,k / G_fit,j|^2,

sigma_j^2 = E |noise of G_j|^2. Division by a fitted response takes bends of resonances away; one by
a wrong response adds bends and takes no scatter away, so of several the smallest result counts.
"""

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_array

from disting.measurement.arrays import Complex, Real

SIDE = 3  # lines to either side
DEGREE = 2


@dataclass(frozen=True, slots=True, eq=False)
class Contrasts:
    """`power` = |e_k G_fit,k|^2, shape (n_f,); `at` = which lines each sees, itself first, and
    `weight` = C of these, shape (n_f, 7) each; `size` = |G_fit|, shape (n_f,).
    """

    power: Real
    at: np.ndarray[tuple[int, int], np.dtype[np.intp]]
    weight: Real
    size: Real

    def expected(self, variance: Real) -> Real:
        """E of `power` for variances of the lines, shape (n_f, ...)."""
        return np.asarray(np.einsum("kj,kj...->k...", self.weight, variance[self.at]))


def contrasts(omega: Real, response: Complex, fitted: Complex | None = None) -> Contrasts:
    """Contrasts of a response, shape (n_f,), divided by a fitted one; without one those of its
    logarithm, which bends less than it does.
    """
    at, h = stencil(omega)
    if fitted is None:
        size = np.abs(response)
        ratio = np.log(size) + 1j * np.unwrap(np.angle(response))
    else:
        size, ratio = np.abs(fitted), response / fitted
    left = ratio - np.einsum("kj,kj->k", h, ratio[at[:, 1:]])
    spread = np.concatenate([np.ones((len(omega), 1)), h**2], axis=1)
    weight = spread * (size[:, None] / size[at]) ** 2
    return Contrasts(np.abs(left * size) ** 2, at, weight, size)


def stencil(omega: Real) -> tuple[np.ndarray[tuple[int, int], np.dtype[np.intp]], Real]:
    """Lines near each line, itself first, shape (n_f, 7), and the weights h of the others, shape
    (n_f, 6): those of a quadratic in ln omega through them, by least squares.
    """
    n = len(omega)
    first = np.clip(np.arange(n) - SIDE, 0, n - 2 * SIDE - 1)
    window = first[:, None] + np.arange(2 * SIDE + 1)
    own = np.arange(n)[:, None]
    others = window[window != own].reshape(n, 2 * SIDE)
    x = np.log(omega)
    apart = x[others] - x[own]
    scaled = apart / np.abs(apart).max(axis=1, keepdims=True)
    powers = scaled[:, :, None] ** np.arange(DEGREE + 1)
    h = np.linalg.pinv(powers)[:, 0, :]
    return np.concatenate([own, others], axis=1), np.asarray(h)


def freedom(omega: Real) -> float:
    """Degrees of freedom of the mean of the contrasts of lines that scatter alike, real ones:
    2 (tr A)^2 / tr A^2 with A = L'L of their coefficients L.
    """
    at, h = stencil(omega)
    n = len(omega)
    rows = np.concatenate([np.ones((n, 1)), -h], axis=1)
    rows /= np.linalg.norm(rows, axis=1, keepdims=True)
    matrix = csr_array((rows.ravel(), at.ravel(), np.arange(0, rows.size + 1, rows.shape[1])))
    return float(2 * n**2 / (matrix @ matrix.T).power(2).sum())
