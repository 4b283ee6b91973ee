"""Drives with known parameters, and the measured bench where it is there."""

import numpy as np

from disting.fit.search.plant import Plant
from disting.measurement import FrequencyResponse
from disting.model.chain import Chain
from tests.measurement.bench_data import measured_data

OMEGA = 2 * np.pi * np.geomspace(5.0, 300.0, 120)


def bench(experiment, side="motor"):
    """Motor (or load) response of experiment A or B."""
    columns = np.loadtxt(
        measured_data(f"fditools_motorbench_frf_{experiment}.csv"), delimiter=","
    ).T
    first = 1 if side == "motor" else 5
    response = columns[first] + 1j * columns[first + 1]
    return FrequencyResponse(
        2 * np.pi * columns[0], response, columns[first + 2], columns[first + 3]
    )


def truth(chain, seed, spread=0.5):
    """Random parameters of a drive with resonances between about 20 and 100 Hz."""
    source = np.random.default_rng(seed)
    sizes = {"m": 1.0, "k": 5e4, "d": 5.0, "b": 5.0, "T": 1e-3}
    return {
        name: float(sizes[name[0]] * np.exp(spread * source.normal())) for name in chain.parameters
    }


def response(chain, values, omega=OMEGA, noise=0.0, seed=0, sign=1):
    """Response of a chain, with complex noise of this relative size."""
    source = np.random.default_rng(seed)
    exact = Plant(chain.structure, omega, sign).response(
        np.array([values[n] for n in chain.parameters])
    )
    error = (source.normal(size=omega.size) + 1j * source.normal(size=omega.size)) / np.sqrt(2)
    return FrequencyResponse(omega, exact * (1 + noise * error), quantity=chain.quantity)


def dense_response(chain, values, s):
    """A slow twin of `Plant.response`: the matrix equation solved at one s."""
    n = chain.n_masses
    whole = np.zeros((n + 1, n + 1), dtype=complex)
    for element in chain.structure.elements:
        v = np.zeros(n + 1)
        v[element.at + (element.kind in "kd")] = 1.0
        v[element.at if element.kind in "kd" else 0] -= 1.0
        whole += (
            values[element.parameter]
            * s ** {"m": 2, "k": 0, "d": 1, "b": 1}[element.kind]
            * np.outer(v, v)
        )
    force, shown = np.zeros(n + 1), np.zeros(n + 1)
    force[chain.act_plus], shown[chain.meas_plus] = 1.0, 1.0
    force[chain.act_minus] -= 1.0
    shown[chain.meas_minus] -= 1.0
    moved = np.linalg.solve(whole[1:, 1:], force[1:])
    lag = 1 + s * values["T1"] if chain.lag else 1.0
    return s**chain.quantity.order * (shown[1:] @ moved) / lag * np.exp(-s * values.get("Td", 0.0))


CHAINS = [
    Chain(1, damped=True, ground_dampers=(1,)),
    Chain(2, damped=True, dead_time=True),
    Chain(3, damped=True, ground_dampers=(2,), lag=True, dead_time=True),
    Chain(3, meas_plus=3, quantity="velocity", ground_dampers=(1, 3), damped=False),
    Chain(
        3,
        gap=1,
        act_minus=1,
        act_plus=3,
        meas_minus=1,
        meas_plus=2,
        damped=True,
        quantity="position",
    ),
    Chain(4, gap=2, act_minus=1, act_plus=3, meas_minus=2, meas_plus=4, damped=True, lag=True),
]
