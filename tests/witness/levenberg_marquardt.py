"""Batched complex Levenberg-Marquardt on a fibre, in NumPy: an independent numeric witness.

num(s) = det A(s) e_meas' A(s)^-1 e_act and den(s) = det A(s) are evaluated on the unit circle, at
more points than their degree; a discrete Fourier transform gives the coefficients. A parameter
that enters as w v v' has, with x = A^-1 e_act and y = A^-1 e_meas,

    d det A = det A w v' A^-1 v        d (e_meas' A^-1 e_act) = -w (v' x)(v' y)

The unknowns are complex logarithms, so no element is ever zero. Residuals are relative errors of
the coefficients of num and den over the product of the masses, those that vanish for the given
model left out. A solution found is evidence for "same transfer function"; a failure to find one
proves nothing: it may lie far from all starts.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tests.witness.mechanics import elements, ports

Array = NDArray[np.complex128]
# a coefficient this small beside the largest one is zero: values between 1/2 and 2 leave no small
# ones
ZERO = 1e-9


@dataclass(frozen=True)
class Model:
    """A chain as arrays: vectors of the elements (n, N), powers of s (n,), ports (N,), which
    parameters are masses (n,).
    """

    vectors: NDArray[np.float64]
    powers: NDArray[np.int64]
    force: NDArray[np.float64]
    sensor: NDArray[np.float64]
    masses: NDArray[np.bool_]

    @property
    def circle(self) -> Array:
        """Points of evaluation: more than the degree 2 N."""
        count = 2 * len(self.force) + 1
        return np.exp(2j * np.pi * np.arange(count) / count)


def model(chain: Any) -> Model:
    """Arrays of a chain."""
    parts, (force, sensor) = elements(chain), ports(chain)
    return Model(
        np.array([e.vector for e in parts], float),
        np.array([e.power for e in parts]),
        np.array(force, float),
        np.array(sensor, float),
        np.array([e.power == 2 for e in parts]),
    )


def coefficients(m: Model, q: Array) -> tuple[Array, Array]:
    """Coefficients (b, c) of num and den over the product of the masses, and their Jacobian (b,
    c, n), at parameters (b, n).
    """
    weights = m.circle[:, None] ** m.powers  # (k, n)
    pencil = np.einsum("bn,kn,ni,nj->bkij", q, weights, m.vectors, m.vectors, optimize=True)
    inverse, det = np.linalg.inv(pencil), np.linalg.det(pencil)
    x, y = inverse @ m.force, inverse @ m.sensor
    transfer = x @ m.sensor
    d_det = (
        det[..., None]
        * weights
        * np.einsum("ni,bkij,nj->bkn", m.vectors, inverse, m.vectors, optimize=True)
    )
    d_transfer = -weights * (x @ m.vectors.T) * (y @ m.vectors.T)
    lead = np.prod(q[:, m.masses], axis=1)[:, None]
    values = _over_powers(np.stack([det * transfer, det], 1)) / lead
    slopes = (
        _over_powers(
            np.stack([d_det * transfer[..., None] + det[..., None] * d_transfer, d_det], 1)
        )
        / lead[..., None]
    )
    slopes[:, :, m.masses] -= values[..., None] / q[:, None, m.masses]
    return values, slopes


def _over_powers(at_points: Array) -> Array:
    """Values of num and den on the circle (b, 2, k, ..) to their coefficients (b, 2 k, ..)."""
    found = np.fft.fft(at_points, axis=2) / at_points.shape[2]
    return found.reshape(found.shape[0], -1, *found.shape[3:])


def best_residual(
    given: Any, searched: Any, starts: int = 64, steps: int = 150, seed: int = 0
) -> float:
    """Smallest residual (maximum norm) over random complex starts for a random positive model of
    `given`; infinite where the coefficients of the two chains do not vanish together.
    """
    draw = np.random.default_rng(seed)
    point = np.exp(draw.uniform(-0.7, 0.7, (1, len(given.parameters)))).astype(complex)
    goal = coefficients(model(given), point)[0][0]
    m = model(searched)
    shape = starts, len(searched.parameters)
    u = draw.uniform(-1, 1, shape) + 1j * draw.uniform(-0.5, 0.5, shape)
    used = np.abs(goal) > ZERO * np.abs(goal).max()
    if (used != (np.abs(coefficients(m, np.exp(u))[0]) > ZERO).all(axis=0)).any():
        return np.inf
    return float(_descended(m, goal[used], used, u, steps).min())


def _descended(
    m: Model, goal: Array, used: NDArray[np.bool_], u: Array, steps: int
) -> NDArray[np.float64]:
    """Residuals (maximum norm) of all starts after the steps; the damping of each start grows
    and shrinks by itself.
    """

    def at(u: Array) -> tuple[Array, Array]:
        q = np.exp(u)
        values, slopes = coefficients(m, q)
        return values[:, used] / goal - 1, slopes[:, used] / goal[:, None] * q[:, None, :]

    f, j = at(u)
    damping, size = np.full(len(u), 1e-1), np.linalg.norm(f, axis=1)
    identity = np.eye(u.shape[1])
    for _ in range(steps):
        adjoint = j.conj().transpose(0, 2, 1)
        normal = adjoint @ j + damping[:, None, None] * identity
        step = -np.linalg.solve(normal, adjoint @ f[..., None])[..., 0]
        trial = u + step / np.maximum(1, np.abs(step).max(axis=1, keepdims=True))
        f_new, j_new = at(trial)
        new = np.linalg.norm(f_new, axis=1)
        better = new < size
        u[better], f[better], j[better], size[better] = (
            trial[better],
            f_new[better],
            j_new[better],
            new[better],
        )
        damping = np.clip(np.where(better, damping / 4, damping * 4), 1e-15, 1e6)
    return np.abs(f).max(axis=1)
