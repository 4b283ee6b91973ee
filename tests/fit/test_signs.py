"""The sign of a sensor: found by more than one model, the same in training and test; and what
ports mean with one mass.
"""

from dataclasses import replace

import numpy as np
import pytest

from disting.errors import InputError
from disting.fit import select
from disting.fit.judge.readings import better_sign
from disting.fit.search.candidates import chosen_ports
from disting.fit.search.cost import Cost
from disting.fit.search.estimate import Task
from disting.fit.search.joint import JointCost
from disting.fit.search.setup import Setup
from disting.measurement import are_opposite
from disting.model.chain import Chain
from tests.fit.drives import response
from tests.measurement.bench_data import measured_data

ONE, TWO = Chain(1, damped=True), Chain(2, 0, 0, 1, 0, 2, damped=True)
VALUES = {"m1": 1.0, "m2": 0.5, "k12": 2e4, "d12": 3.0}
# most lines above the resonance at 39 Hz, where the load moves against
ABOVE = 2 * np.pi * np.geomspace(20.0, 200.0, 60)


def load(sign=1, noise=0.01, seed=0, omega=ABOVE):
    return response(TWO, VALUES, omega, noise, seed, sign)


@pytest.mark.full
def test_the_smallest_candidate_alone_would_take_the_wrong_sign():
    assert select(load(), [ONE], test=load(seed=1), sign=0).task.sign == -1


@pytest.mark.full
@pytest.mark.parametrize("signs", [(1, -1), (-1, -1)])
def test_each_of_several_responses_takes_its_own_sign(signs):
    """The second one is that of the driven mass, the first one that of the load."""
    motor = replace(TWO, meas_plus=1)
    parts = [
        Cost(load(signs[0])),
        Cost(response(motor, VALUES, ABOVE, 0.01, 1, signs[1])),
    ]
    task = Task(JointCost(tuple(parts), (Setup(), Setup(sensor="1"))))
    found = better_sign(task, [TWO])
    assert (found.sign, found.sign * found.cost.setups[1].sign) == signs
    assert found.cost.parts == task.cost.parts


@pytest.mark.slow
@pytest.mark.parametrize("sign", [1, pytest.param(-1, marks=pytest.mark.slow)])
def test_all_candidates_together_take_the_right_sign(sign):
    both = select(load(sign), [ONE, TWO], test=load(sign, seed=1), sign=0)
    assert both.task.sign == sign
    found = both.candidates[0].estimate.parameters
    # No data determine more of this chain than m1 + m2, k12/d12 and k12/(m1 m2): a stiffness alone
    # may come out anywhere.
    assert found["k12"] / (found["m1"] * found["m2"]) == pytest.approx(4e4, rel=0.02)
    assert found["m1"] + found["m2"] == pytest.approx(1.5, rel=0.02)


def test_training_and_test_of_opposite_sign_are_refused():
    with pytest.raises(InputError, match="training and test are of opposite sign"):
        select(load(), [TWO], test=load(-1, seed=1))
    assert are_opposite(load(), load(-1, seed=1, omega=ABOVE * 1.003))
    assert not are_opposite(load(), load(seed=1, noise=0.5))
    # no shared frequencies, nothing known
    assert not are_opposite(load(), load(-1, omega=ABOVE + 10 * ABOVE[-1]))


def test_sensor_last_is_not_the_driven_mass():
    assert {c.n_masses for c in chosen_ports((1, 2, 3), "1", "last")} == {2, 3}
    assert {c.n_masses for c in chosen_ports((1, 2, 3), "last", "2")} == {3}
    assert {c.n_masses for c in chosen_ports((1, 2), "last", "last")} == {1, 2}
    with pytest.raises(InputError, match="force 1 and sensor last are the same mass"):
        chosen_ports((1,), "1", "last")


def test_the_two_experiments_of_the_bench_have_one_sign():
    from disting.measurement import read

    one, other = (
        read(measured_data(f"fditools_motorbench_frf_{x}.csv"), column="ReG_load") for x in "AB"
    )
    assert not are_opposite(one, other) and are_opposite(one, other.sign_reversed())
    assert not are_opposite(one, replace(other, G=other.G * np.exp(0.8j)))
