"""Margins of a loop: by hand for one mass, by closed-loop poles and python-control for chains."""

from math import atan, degrees, pi

import numpy as np
import pytest

from disting.errors import InputError
from disting.export import state_space
from disting.fit.results.loop import Controller, margins, read_controller
from disting.model.chain import Chain, Quantity
from tests.fit.drives import truth

ONE = Chain(1, damped=False, quantity=Quantity.VELOCITY)


def test_velocity_loop_around_one_mass_is_an_integrator():
    found = margins(ONE, np.array([0.5]), Controller(P=10.0))
    assert found.stable and found.phase == pytest.approx(90.0)
    assert found.crossover == pytest.approx(20.0 / (2 * pi), rel=1e-6)
    assert found.bandwidth == pytest.approx(20.0 / (2 * pi), rel=0.02)
    assert found.gain == np.inf and found.sensitivity == pytest.approx(1.0, abs=1e-3)


def test_dead_time_takes_phase_and_limits_the_gain():
    chain = Chain(1, damped=False, quantity=Quantity.VELOCITY, dead_time=True)
    found = margins(chain, np.array([0.5, 0.02]), Controller(P=10.0))
    assert found.stable and found.phase == pytest.approx(90.0 - degrees(20.0 * 0.02), rel=1e-4)
    assert found.gain == pytest.approx(pi / 2 / (20.0 * 0.02), rel=1e-3)
    for share, stable in ((0.99, True), (1.01, False)):
        limit = pi / 2 / 0.02 * 0.5 * share
        assert margins(chain, np.array([0.5, 0.02]), Controller(P=limit)).stable is stable


def test_cascade_around_one_mass():
    found = margins(ONE, np.array([0.5]), Controller(P=10.0, V=4.0, loop="cascade"))
    crossover = 2 * pi * found.crossover  # L = 20 (s + 4) / s^2
    assert abs(20 * (1j * crossover + 4) / crossover**2) == pytest.approx(1.0, rel=1e-4)
    assert found.phase == pytest.approx(degrees(atan(crossover / 4.0)), rel=1e-4)


@pytest.mark.full
@pytest.mark.parametrize("loop", ["position", "velocity", "cascade"])
def test_stability_is_that_of_the_closed_loop_poles_and_phase_that_of_python_control(loop):
    import control  # takes a second

    source, seen = np.random.default_rng(7), set()
    for k in range(60):
        n = int(source.integers(2, 5))
        force, sensor = (int(i) for i in source.integers(1, n + 1, 2))
        chain = Chain(
            n,
            act_plus=force,
            meas_plus=sensor,
            damped=True,
            lag=k % 3 == 0,
            quantity=Quantity.POSITION,
        )
        values = truth(chain, k)
        p = np.array([values[name] for name in chain.parameters])
        total = sum(p[:n])
        speed = float(np.sqrt(values["k12"] / total)) * 10 ** source.uniform(-1.5, 0.5)
        given = Controller(
            P=total * speed * (speed if loop == "position" else 1.0),
            D=total * speed if loop == "position" else 0.0,
            Tf=0.05 / speed,
            V=speed / 4 if loop == "cascade" else 0.0,
            I=total * speed**2 / 10 * (loop == "velocity"),
            loop=loop,
        )
        found = margins(chain, p, given)
        opened = _opened(control, chain, values, given)
        roots = control.feedback(opened, 1).poles()
        if np.any(np.abs(roots.real) < 1e-4 * np.abs(roots)) and loop != "velocity":
            continue  # on the border
        unstable = np.any(roots.real > 1e-6 * np.abs(roots).max())
        assert found.stable is not bool(unstable), (chain, given)
        seen.add(found.stable)
        if found.stable:
            omega = 2 * pi * found.crossover
            assert abs(opened(1j * omega)) == pytest.approx(1.0, rel=1e-3)
            angle = abs(np.degrees(np.angle(-opened(1j * omega))))
            assert found.phase <= angle + 0.5
    assert seen == {True, False}


def _opened(control, chain, values, given):
    """L(s) with matrices of python-control."""
    plant = state_space(chain, values)
    velocity = plant.C @ plant.A
    shown = {
        "position": plant.C, "velocity": velocity, "cascade": velocity + given.V * plant.C
    }[given.loop]  # fmt: skip
    control_law = control.tf([given.D, 0], [given.Tf, 1]) + given.P
    if given.I:
        control_law = control_law + control.tf([given.I], [1, 0])
    return control.ss(plant.A, plant.B, shown, 0) * control.ss(control_law)


def test_controller_is_read_from_text_and_file(tmp_path):
    path = tmp_path / "pi.json"
    path.write_text('{"P": 2, "I": 30.5, "loop": "velocity"}')
    assert read_controller(str(path)) == read_controller("P=2, I=30.5") == Controller(2.0, 30.5)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("P=2,Q=3", "a controller is written"),
        ("P=two", "a controller is written"),
        ("P=1,P=2", "a controller is written"),
        ("P=-1", "not below zero"),
        ("P=nan", "not below zero"),
        ("Tf=1", "does nothing"),
        ("P=1,loop=torque", "a loop is one of"),
        ("P=1,V=2", "position gain"),
        ("P=1,loop=cascade", "position gain"),
        ("none.json", "cannot be read"),
    ],
)
def test_bad_controllers_are_refused(text, words):
    with pytest.raises(InputError, match=words):
        read_controller(text)


def test_what_has_no_margins_says_so():
    free = Chain(2, damped=False, quantity=Quantity.VELOCITY)
    with pytest.raises(InputError, match="damped"):
        margins(free, np.array([1.0, 1.0, 100.0]), Controller(P=1.0))
    with pytest.raises(InputError, match="filter"):
        margins(ONE, np.array([1.0]), Controller(D=1.0, P=1.0))
