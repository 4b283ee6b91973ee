"""Motion with Coulomb friction: a fixed-step Runge-Kutta integration of fourth order.

M x'' + D x' + K x = e_act f(t) - c tanh(v / v_s) - b v for each mass with friction, where tanh
stands for the sign (v_s = speed below which the friction is not fully there), so that the right
side is smooth and the integration converges. Dead time and lag act on the force alone, before it
reaches the masses; the force is a trigonometric polynomial, known at every instant.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from disting.errors import InputError
from disting.measurement.arrays import Complex, Real
from disting.simulation.mechanics import Matrices, motion

STEP = 0.25  # of the shortest time in which the motion changes
MOST_STEPS = 5_000_000


@dataclass(frozen=True, slots=True)
class Friction:
    """Friction of one mass towards the ground.

    `coulomb` [N or N m], `viscous` [N s/m or N m s/rad], `speed` = v_s [m/s or rad/s], at which
    tanh(1) = 76 % of the Coulomb friction is reached.

    >>> Friction(coulomb=0.05).viscous
    0.0
    """

    coulomb: float = 0.0
    viscous: float = 0.0
    speed: float = 1e-2

    def __post_init__(self) -> None:
        if not (
            0 <= self.coulomb < np.inf and 0 <= self.viscous < np.inf and 0 < self.speed < np.inf
        ):
            raise InputError("friction has coulomb >= 0, viscous >= 0 and speed > 0")


def step(
    m: Matrices,
    act: Real,
    force: Complex,
    period: float,
    samples: int,
    periods: int,
    friction: Sequence[Friction],
) -> Real:
    """Positions, velocities and accelerations of all masses, shape (3, samples * periods, N).

    `m` with the viscous friction; `force` = spectrum of one period, shape (samples // 2 + 1,), of
    numpy.fft.rfft; `period` [s]; `friction` of each mass. Begins in the periodic motion without
    Coulomb friction. Raises InputError where M has no inverse.
    """
    coulomb, speed = np.array([(kind.coulomb, kind.speed) for kind in friction]).T
    inverse = _inverse(m)
    highest = 2 * np.pi * int(np.flatnonzero(force)[-1]) / period
    steps = _steps(m, coulomb / speed, highest, period / samples)
    if steps * samples * periods > MOST_STEPS:
        raise InputError(
            f"{steps * samples * periods} steps are too many; raise the speed of the friction, or"
            " simulate less"
        )
    push = np.outer(_oversampled(force, samples, 2 * steps), act)

    def acceleration(x: Real, v: Real, f: Real) -> Real:
        """(f - D v - K x - F_c tanh(v/v_s)) / M."""
        return np.asarray(inverse @ (f - m.D @ v - m.K @ x - coulomb * np.tanh(v / speed)))

    x, v = _start(m, act, force, period, samples)
    h = period / samples / steps
    result = np.empty((3, samples * periods, len(act)))
    for sample in range(samples * periods):
        at = 2 * steps * (sample % samples)
        result[:, sample] = x, v, acceleration(x, v, push[at])
        for i in range(at, at + 2 * steps, 2):
            x, v = _next(acceleration, x, v, h, push[[i, i + 1, (i + 2) % len(push)]])
    return result


def _next(
    acceleration: Callable[[Real, Real, Real], Real], x: Real, v: Real, h: float, push: Real
) -> tuple[Real, Real]:
    """One step of Runge and Kutta; `push`: the force at its start, middle and end."""
    first, middle, last = push
    a1 = acceleration(x, v, first)
    v2 = v + h / 2 * a1
    a2 = acceleration(x + h / 2 * v, v2, middle)
    v3 = v + h / 2 * a2
    a3 = acceleration(x + h / 2 * v2, v3, middle)
    v4 = v + h * a3
    a4 = acceleration(x + h * v3, v4, last)
    return x + h / 6 * (v + 2 * v2 + 2 * v3 + v4), v + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4)


def _steps(m: Matrices, slope: Real, highest: float, sample: float) -> int:
    """Steps a sample [s]: from the force [rad/s], the eigenvalues (Gershgorin: rows of |K|,
    |D|), the slope of the friction.
    """
    inverse = _inverse(m)
    stiff, damped, rubbed = (
        np.max(np.abs(inverse @ matrix).sum(axis=1)) for matrix in (m.K, m.D, np.diag(slope))
    )
    fastest = np.sqrt(stiff) + damped + rubbed + highest
    return max(1, int(np.ceil(sample * fastest / STEP)))


def _inverse(m: Matrices) -> Real:
    try:
        return np.asarray(np.linalg.inv(m.M))
    except np.linalg.LinAlgError:
        raise InputError(
            "Coulomb friction needs a mass at every node: give each a mass, however small"
        ) from None


def _oversampled(spectrum: Complex, samples: int, factor: int) -> Real:
    """The trigonometric polynomial between its samples, `factor` values a sample."""
    wide = np.zeros(samples * factor // 2 + 1, dtype=complex)
    wide[: len(spectrum)] = spectrum * factor
    return np.asarray(np.fft.irfft(wide, samples * factor))


def _start(
    m: Matrices, act: Real, force: Complex, period: float, samples: int
) -> tuple[Real, Real]:
    """Position and velocity at time zero of the periodic motion without Coulomb friction."""
    lines = np.flatnonzero(np.abs(force) > 0)
    omega = np.asarray(2 * np.pi * lines / period, dtype=np.float64)
    moved = motion({2: m.M, 1: m.D, 0: m.K}, act, omega) * force[lines, None] * (2 / samples)
    return np.asarray(moved.sum(axis=0).real), np.asarray(
        (1j * omega[:, None] * moved).sum(axis=0).real
    )
