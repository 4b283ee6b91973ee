"""A held input against exact discretisation, and fits of digital drives."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import expm

from disting.cli import main
from disting.errors import InputError
from disting.fit import figure_1, predict, select
from disting.fit.judge.held import held
from disting.fit.search.cost import Cost
from disting.fit.search.descent import fine
from disting.fit.search.estimate import Estimate, Task
from disting.fit.search.plant import Plant
from disting.measurement import FrequencyResponse, read
from disting.measurement.observation import Hold, Observation
from disting.measurement.response import Method
from disting.model.chain import Chain
from disting.report.fit.sentences import first_lines

RATE = 4000.0
OMEGA = 2 * np.pi * np.geomspace(4.0, 400.0, 110)
VALUES = {"m1": 2e-3, "m2": 5e-3, "k12": 300.0, "d12": 0.02, "b1": 0.01}
DRIVE = Chain(2, damped=True, ground_dampers=(1,))
DEAD = {"dead_time": True}


def sampled(values, omega, order, delay=0, lag=None, rate=RATE):
    """Samples of position or speed per held torque, by the matrix exponential: two masses."""
    m1, m2, k, d, b = (values[n] for n in ("m1", "m2", "k12", "d12", "b1"))
    a = np.zeros((4, 4))
    a[:2, 2:] = np.eye(2)
    a[2:] = [[-k / m1, k / m1, -(d + b) / m1, d / m1], [k / m2, -k / m2, d / m2, -d / m2]]
    column = np.array([0, 0, 1 / m1, 0])
    row = np.eye(4)[0 if order == 0 else 2]
    if lag is not None:
        a = np.block([[a, column[:, None]], [np.zeros((1, 4)), np.array([[-1 / lag]])]])
        column, row = np.array([0, 0, 0, 0, 1 / lag]), np.append(row, 0.0)
    n = len(a)
    whole = expm(np.block([[a, column[:, None]], [np.zeros((1, n + 1))]]) / rate)
    z = np.exp(1j * omega / rate)
    solved = [row @ np.linalg.solve(x * np.eye(n) - whole[:n, :n], whole[:n, n]) for x in z]
    return np.array(solved) * z**-delay


@pytest.mark.thin(8)
@pytest.mark.parametrize("shown", ["position", "velocity", "acceleration"])
@pytest.mark.parametrize("order", [0, 1])
@pytest.mark.parametrize("delay", [0, 2])
def test_a_plant_behind_a_hold_is_the_exact_discretisation(shown, delay, order):
    """Up to a fifth of the sampling rate, an antiresonance between."""
    chain = Chain(2, damped=True, ground_dampers=(1,), quantity=shown, dead_time=delay > 0)
    omega = 2 * np.pi * np.geomspace(2.0, 0.2 * RATE, 200)
    p = np.array([{**VALUES, "Td": delay / RATE}[n] for n in chain.parameters])
    plant = Plant(chain.structure, omega, observation=Observation(hold=Hold(1 / RATE, order)))
    exact = sampled(VALUES, omega, order, delay) * (1j * omega) ** (chain.quantity.order - order)
    assert np.max(np.abs(plant.response(p) / exact - 1)) < (2e-4, 5e-4)[order]
    bare = Plant(chain.structure, omega).response(p)
    assert np.max(np.abs(bare / exact - 1)) > 0.5


def test_derivatives_are_those_of_the_response():
    plant = Plant(DRIVE.structure, OMEGA * 2, observation=Observation(hold=Hold(1 / RATE)))
    p = np.array([VALUES[n] for n in DRIVE.parameters])
    response, gradient = plant.logarithmic_gradient(p)
    np.testing.assert_allclose(response, plant.response(p), rtol=1e-12)
    for i, value in enumerate(p):
        step = np.zeros_like(p)
        step[i] = 1e-6 * value
        slope = (plant.response(p + step) - plant.response(p - step)) / (2 * step[i])
        np.testing.assert_allclose(
            gradient[i] * response, slope, rtol=1e-4, atol=1e-6 * abs(slope).max()
        )


@pytest.mark.full
@pytest.mark.parametrize(
    ("delay", "lag", "true"),
    [
        (1, None, Chain(2, damped=True, ground_dampers=(1,), dead_time=True)),
        pytest.param(0, None, DRIVE, marks=pytest.mark.slow),
        pytest.param(
            *(1, 5e-4, Chain(2, damped=True, ground_dampers=(1,), dead_time=True, lag=True)),
            marks=pytest.mark.slow,
        ),
    ],
)
def test_the_actuator_of_a_digital_drive_is_found_through_its_hold(delay, lag, true):
    source = np.random.default_rng(7)
    exact = sampled(VALUES, OMEGA, 0, delay, lag) * (1j * OMEGA) ** 2
    noise = source.normal(size=(2, len(OMEGA)))
    data = FrequencyResponse(OMEGA, exact * (1 + 7e-4 * (noise[0] + 1j * noise[1])))
    tried = [c for c in figure_1([2]) if lag or not c.lag]
    found = select(data.held(1 / RATE), tried)
    assert found.selected.chain == true
    values = found.selected.estimate.parameters
    assert values["m2"] == pytest.approx(VALUES["m2"], rel=3e-3)
    if delay:
        assert values["Td"] == pytest.approx(delay / RATE, rel=0.03)
    bare = select(data, tried)
    assert bare.selected.chain != true or bare.explanation.chi2 > 2


def recorded(order=1, delay=0, lag=None, noise=7e-4):
    """The response of a record of 4 kHz of position or speed, held or with a true actuator."""
    if lag is None:
        exact = sampled(VALUES, OMEGA, order, delay)
    else:
        chain = replace(DRIVE, lag=True, quantity=["position", "velocity"][order])
        p = np.array([{**VALUES, "T1": lag}[n] for n in chain.parameters])
        exact = Plant(chain.structure, OMEGA).response(p)
    parts = np.random.default_rng(7).normal(size=(2, len(OMEGA)))
    response = exact * (1 + noise * (parts[0] + 1j * parts[1]))
    sensor = ["position", "velocity"][order]
    method = Method(1000, 10, rate=RATE, order=order)
    return FrequencyResponse(OMEGA, response, quantity=sensor, method=method)


def near(data, chain, **values):
    """An estimate of a chain near these values, and its task."""
    task = Task(Cost(data))
    p = np.array([{**VALUES, **values}[n] for n in chain.parameters])
    p, j = fine(task.plant(chain), task.cost, task.box(chain.parameters), p)
    found = dict(zip(chain.parameters, map(float, p), strict=True))
    return Estimate(chain, found, j), task


@pytest.mark.full
@pytest.mark.parametrize("order", [0, 1])
@pytest.mark.parametrize(("delay", "dead_time"), [(0, 0.0), (1, 2.5e-4)])
def test_a_hold_that_explains_the_actuator_is_found(order, delay, dead_time):
    """A dead time of T/2 and 3 T/2, which is none and T behind the hold."""
    chain = replace(DRIVE, quantity=["position", "velocity"][order], **DEAD)
    data = recorded(order, delay)
    estimate, task = near(data, chain, Td=1e-4)
    assert estimate.parameters["Td"] == pytest.approx((delay + 0.5) / RATE, rel=0.02)
    found = held(estimate, task)
    assert found.period == 1 / RATE and found.is_better
    assert found.chain == replace(chain, dead_time=delay > 0)
    assert found.dead_time == pytest.approx(dead_time, rel=0.02)
    for other in (data.held(1 / RATE, order), replace(data, method=None)):
        assert held(estimate, Task(Cost(other))) is None


@pytest.mark.full
def test_no_hold_is_found_for_a_lag_that_is_none():
    chain = replace(DRIVE, quantity="velocity", lag=True)
    assert held(*near(recorded(lag=1.6e-3), chain, T1=1e-3)) is None


@pytest.mark.full
def test_the_third_line_suggests_the_hold():
    data = recorded(noise=7e-3)
    (line,) = (
        said
        for said in first_lines(select(data, [replace(DRIVE, quantity="velocity", **DEAD)]))
        if said.startswith("next: ")
    )
    assert "for the 0.00025 s between samples, give --hold record: so 2:1+b1 fits" in line


def test_hold_and_welch_are_seen_together():
    observation = Observation(segment=(0.5, 0), hold=Hold(1 / RATE))
    chain = Chain(1, damped=True, ground_dampers=(1,), quantity="position")
    p, omega = np.array([2e-3, 0.1]), 2 * np.pi * np.arange(4.0, 300.0, 4.0)
    both = Plant(chain.structure, omega, observation=observation).response(p)
    window = Plant(chain.structure, omega, observation=Observation(segment=(0.5, 0))).response(p)
    hold = Plant(chain.structure, omega, observation=Observation(hold=Hold(1 / RATE))).response(p)
    bare = predict(chain, dict(zip(chain.parameters, p, strict=True)), omega)
    np.testing.assert_allclose(both / window, hold / bare, rtol=2e-3)


@pytest.mark.full
def test_every_file_takes_a_hold(tmp_path):
    file = tmp_path / "frf.csv"
    rows = [f"{f},{-1 / f**2},0.01" for f in range(5, 40)]
    file.write_text("\n".join(["frequency [Hz],re,im", *rows]))
    held = read(file, hold="125e-6")
    assert held.hold == Hold(125e-6) and "input held for 0.000125 s" in held.reading
    assert read(file).hold is None and held.masked(10, 30).hold == held.hold
    for wrong in (0, -1e-3, "soon", "record"):
        with pytest.raises(InputError, match="a hold is given by its sampling time in seconds"):
            read(file, hold=wrong)
    with pytest.raises(InputError, match="not below half the sampling rate"):
        select(read(file, hold=0.02), figure_1([1]))


@pytest.mark.full
def test_the_command_line_takes_a_hold_and_refuses_it_for_networks(tmp_path, capsys):
    exact = sampled(VALUES, OMEGA, 0, 1) * (1j * OMEGA) ** 2
    noise = np.random.default_rng(3).normal(size=(2, len(OMEGA)))
    measured = exact * (1 + 7e-4 * (noise[0] + 1j * noise[1]))
    file = tmp_path / "drive.csv"
    rows = [f"{w / (2 * np.pi)},{g.real},{g.imag}" for w, g in zip(OMEGA, measured, strict=True)]
    file.write_text("\n".join(["frequency [Hz],Re [rad/s^2/Nm],Im [rad/s^2/Nm]", *rows]))
    assert main(["fit", str(file), "--masses", "2", "--hold", "250e-6"]) == 0
    shown = capsys.readouterr().out
    assert "input held for 0.00025 s" in shown and "2:1+b1+delay explains" in shown
    assert main(["fit", str(file), "--models", "1~2; F1; S1", "--hold", "250e-6"]) == 2
    assert "--hold is not supported for networks" in capsys.readouterr().err
