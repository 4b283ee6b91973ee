"""Drives with Coulomb friction or backlash, by time stepping of their own equations.

Velocity of mass 1 by a torque on it, two masses or one:

    m1 v1' = u - t - c sign(v1) - b v1,    m2 v2' = t,    t = k z(x1 - x2) + d (v1 - v2) where in
    contact,

z = 0 within half the play and less than x1 - x2 by that much outside. sign is tanh(v / v_s) with
a v_s far below the speeds of the motion. Runge-Kutta of fourth order.
"""

from dataclasses import dataclass, replace

import numpy as np

from disting.measurement import Signal, TimeSeries

RATE, SAMPLES = 1000.0, 1000  # Hz, of a period
STEPS = 4  # of the integration for each sample
HIGHEST = 160  # excited line
M1, M2, K, D, B = 4e-3, 6e-3, 200.0, 0.05, 0.02
TRUTH = {"m1": M1, "m2": M2, "k12": K, "d12": D, "b1": B}
SLOW = 0.05  # rad/s


@dataclass(frozen=True)
class Machine:
    """Coulomb friction [Nm] at the motor and play [rad] in the gear; one mass or two."""

    masses: int = 2
    coulomb: float = 0.0
    play: float = 0.0


def lines(grid, seed):
    """Excited lines: "odd": odd ones without one of each four, "all": all of them."""
    if grid == "all":
        return np.arange(3, HIGHEST)
    odd = np.arange(3, HIGHEST, 2).reshape(-1)
    left_out = np.random.default_rng(seed).integers(0, 4, len(odd) // 4 + 1)
    return np.delete(odd, [i for i in 4 * np.arange(len(left_out)) + left_out if i < len(odd)])


def torque(excited, rms, seed):
    """Spectrum of a multisine with random phases, shape (SAMPLES // 2 + 1,)."""
    phases = np.random.default_rng(seed).uniform(0, 2 * np.pi, len(excited))
    whole = np.zeros(SAMPLES // 2 + 1, complex)
    whole[excited] = np.exp(1j * phases)
    return whole * rms * SAMPLES / np.sqrt(2 * len(excited))


@dataclass(frozen=True)
class Run:
    """A machine with its excitation: spectrum of the torque over one period."""

    machine: Machine
    spectrum: np.ndarray


def run_of(machine, grid="odd", rms=1.0, realisation=0):
    """A test with random phases of its own."""
    return Run(machine, torque(lines(grid, 0), rms, [realisation, 1]))


def motion(tests, periods):
    """Velocities of mass 1, shape (n, periods * SAMPLES), of tests made side by side; a transient
    of two periods is dropped.
    """
    fine = 2 * STEPS * SAMPLES  # with the middle of each step
    u = np.fft.irfft([test.spectrum for test in tests], fine, axis=1) * (fine / SAMPLES)
    k = np.array([K * (test.machine.masses == 2) for test in tests])
    d = k * D / K
    coulomb, play = np.array([(t.machine.coulomb, t.machine.play) for t in tests]).T
    half, always, h = play / 2, play == 0, 1 / (RATE * STEPS)

    def slope(x, force):
        wound = x[0] - x[1]
        beyond = wound - np.clip(wound, -half, half)
        t = k * beyond + d * (x[2] - x[3]) * (always | (beyond != 0))
        dry = coulomb * np.tanh(x[2] / SLOW)
        return np.array([x[2], x[3], (force - t - dry - B * x[2]) / M1, t / M2])

    state = np.zeros((4, len(u)))
    out = np.empty((len(u), (periods + 2) * SAMPLES))
    for i in range(out.shape[1]):
        out[:, i] = state[2]
        for j in range(STEPS):
            at = 2 * (STEPS * (i % SAMPLES) + j)
            first, middle, last = u[:, at], u[:, at + 1], u[:, (at + 2) % fine]
            k1 = slope(state, first)
            k2 = slope(state + h / 2 * k1, middle)
            k3 = slope(state + h / 2 * k2, middle)
            k4 = slope(state + h * k3, last)
            state = state + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
    return out[:, 2 * SAMPLES :]


def responses(tests, periods=4, noise=0.002, seed=0):
    """Response of each test; `noise` of torque and speed as a share of their sizes."""
    source = np.random.default_rng([seed, 7])
    u = np.tile(np.fft.irfft([test.spectrum for test in tests], SAMPLES, axis=1), (1, periods))
    v = motion(tests, periods)
    size = noise * np.std(np.stack([u, v]), axis=2, keepdims=True)
    u, v = np.stack([u, v]) + size * source.normal(size=(2, *u.shape))
    signals = {"input": Signal("torque", "Nm"), "output": Signal("speed", "rad/s")}
    records = [
        replace(TimeSeries(each, speed, RATE, quantity="velocity"), **signals)
        for each, speed in zip(u, v, strict=True)
    ]
    return [record.response(period=SAMPLES, transient=0) for record in records]
