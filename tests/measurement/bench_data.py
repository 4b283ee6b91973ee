"""Measured third-party data, beside the checkout where they are there at all."""

from pathlib import Path

import numpy as np
import pytest

DATA = Path(__file__).parents[3] / "shared" / "data"


def measured_data(name):
    """Path of a file; the test is skipped where it is absent."""
    path = DATA / name
    if not path.exists():
        pytest.skip(f"measured data {name} is not in ../shared/data")
    return path


def write_branched_drive(path: Path) -> None:
    """Acceleration of a motor with a bearing and two loads side by side, with 0.3 % noise."""
    s = 2j * np.pi * np.geomspace(5, 300, 40)
    loads = sum(
        1 / (1 / (k + d * s) + 1 / (m * s**2))
        for m, k, d in ((2e-3, 300, 0.02), (1.5e-3, 900, 0.03))
    )
    noise = np.random.default_rng(3).standard_normal((2, len(s)))
    G = s**2 / (1e-3 * s**2 + 0.005 * s + loads) * (1 + 0.003 * (noise[0] + 1j * noise[1]))
    head = "Frequency [Hz],Re [rad/s^2/Nm],Im [rad/s^2/Nm]"
    columns = np.c_[s.imag / (2 * np.pi), G.real, G.imag]
    np.savetxt(path, columns, header=head, delimiter=",", comments="")
