"""What a frequency response is, refuses and says of itself."""

import copy
import pickle
import tracemalloc
from dataclasses import FrozenInstanceError, replace

import numpy as np
import pytest
from hypothesis import given, strategies as st

from disting.errors import InputError
from disting.measurement import FrequencyResponse, Signal, are_opposite
from disting.model.chain import Quantity

OMEGA = np.linspace(10.0, 200.0, 20)
MASS = np.full(20, 4.0 + 0j)


def test_arrays_cannot_change_and_do_not_follow_the_caller():
    omega = OMEGA.copy()
    response = FrequencyResponse(omega, MASS, deviation=np.ones(20))
    omega[0] = 99.0
    assert response.omega[0] == 10.0
    for array in (response.omega, response.G, response.deviation):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 1.0
    with pytest.raises(FrozenInstanceError):
        response.G = MASS


def test_equality_is_that_of_numbers_sensor_and_signals():
    response = FrequencyResponse(OMEGA, MASS, origin="a", notes=("read",))
    assert response == FrequencyResponse(OMEGA.tolist(), MASS.tolist(), origin="b")
    assert hash(response) == hash(FrequencyResponse(OMEGA, MASS))
    others = [
        replace(response, G=MASS * (1 + 1e-15)),
        replace(response, omega=OMEGA + 1e-12),
        replace(response, deviation=MASS.real),
        replace(response, coherence=MASS.real / 4),
        replace(response, quantity="velocity"),
        replace(response, output=Signal("x")),
        "response",
    ]
    assert all(response != other for other in others)


@pytest.mark.thin(8)
@pytest.mark.parametrize(
    ("changed", "words"),
    [
        ({"omega": np.append(OMEGA[:-1], np.nan)}, "omega is not finite at line 20"),
        ({"G": np.append(MASS[:-1], np.inf)}, r"G is not finite at line 20 \(31.831 Hz\)"),
        ({"G": np.append(MASS[:-1], complex(1, np.nan))}, "G is not finite"),
        ({"omega": OMEGA - 10}, "frequency 0 rad/s at line 1 is not positive"),
        ({"omega": OMEGA - 50}, "not positive"),
        ({"omega": np.append(OMEGA[:-1], 10.0)}, "10 rad/s.* occurs twice"),
        ({"omega": OMEGA[:-1]}, "G has 20 values for 19 frequencies"),
        ({"omega": OMEGA[:7], "G": MASS[:7]}, "7 frequencies are too few; at least 8"),
        ({"G": np.append(MASS[:-1], 0)}, "exactly zero at line 20"),
        ({"deviation": np.append(np.ones(19), -1e-9)}, "negative"),
        ({"deviation": MASS}, "deviation must be real"),
        ({"coherence": np.full(20, 1.01)}, "0..1.*per cent"),
        ({"coherence": np.full(20, -0.01)}, "coherence lies in 0..1"),
        ({"coherence": np.ones((20, 1))}, "shape"),
        ({"omega": "abc"}, "row of numbers"),
        ({"quantity": "jerk"}, "quantity is position, velocity or acceleration"),
        (
            {"quantity": "torque"},
            "drives the machine; the quantity is what the sensor shows: position",
        ),
    ],
)
def test_what_is_no_response_is_refused_with_cause_and_remedy(changed, words):
    with pytest.raises(InputError, match=words):
        FrequencyResponse(**({"omega": OMEGA, "G": MASS} | changed))


def test_unsorted_frequencies_are_sorted_with_all_columns_and_said():
    order = np.random.default_rng(0).permutation(20)
    G, coherence = MASS + 1j * OMEGA, OMEGA / 200
    response = FrequencyResponse(OMEGA[order], G[order], OMEGA[order], coherence[order])
    assert response == FrequencyResponse(OMEGA, G, OMEGA, coherence)
    assert response.notes == ("the frequencies were not in rising order and have been sorted",)
    assert FrequencyResponse(OMEGA, G).notes == ()


def test_a_mass_seen_by_three_sensors():
    position = FrequencyResponse(
        OMEGA, -1 / (0.25 * OMEGA**2), np.ones(20), quantity="position", output=Signal("x", "rad")
    )
    velocity, acceleration = (
        position.to_quantity("velocity"),
        position.to_quantity(Quantity.ACCELERATION),
    )
    np.testing.assert_allclose(velocity.G, 1 / (0.25j * OMEGA), rtol=1e-15)
    np.testing.assert_allclose(acceleration.G, 4.0, rtol=1e-15)
    np.testing.assert_allclose(acceleration.deviation, OMEGA**2, rtol=1e-15)
    assert (velocity.output.unit, acceleration.output.unit, acceleration.quantity) == (
        "rad/s",
        "rad/s^2",
        Quantity.ACCELERATION,
    )
    assert acceleration.to_quantity("acceleration") is acceleration


@given(st.sampled_from(list(Quantity)), st.sampled_from(list(Quantity)))
def test_conversions_are_undone_by_their_reverse(first, second):
    response = FrequencyResponse(OMEGA, MASS + 1j * OMEGA, OMEGA, quantity=first)
    back = response.to_quantity(second).to_quantity(first)
    np.testing.assert_allclose(back.G, response.G, rtol=1e-14)
    np.testing.assert_allclose(back.deviation, response.deviation, rtol=1e-14)


def test_lines_are_chosen_by_band_number_or_truth():
    response = FrequencyResponse(OMEGA, MASS + 1j * OMEGA, OMEGA)
    band = response.masked(30 / (2 * np.pi), 150 / (2 * np.pi))
    assert (band.omega[0], band.omega[-1], len(band)) == (30.0, 150.0, 13) and np.array_equal(
        band.deviation, band.omega
    )
    assert response.subset(OMEGA > 50) == response.subset(np.arange(5, 20))
    with pytest.raises(InputError, match="lie in the band; 8 are needed"):
        response.masked(low=1e3)
    for wrong in ([20, *range(8)], [0.5] * 9, np.ones(19, dtype=bool)):
        with pytest.raises(InputError):
            response.subset(wrong)


def test_thinned_lines_are_some_of_the_measured_ones_even_on_a_logarithmic_scale():
    response = FrequencyResponse(np.arange(1.0, 1001.0), np.ones(1000))
    thin = response.thinned(31)
    assert (
        len(thin) == 31
        and np.isin(thin.omega, response.omega).all()
        and thin.omega[[0, -1]].tolist() == [1.0, 1000.0]
    )
    assert np.ptp(np.diff(np.log(thin.omega[thin.omega > 20]))) < 0.1
    assert response.thinned(2000) is response
    for count in range(8, 20):
        assert len(FrequencyResponse(OMEGA, MASS).thinned(count)) == count
    with pytest.raises(InputError, match="at least 8"):
        response.thinned(7)


def test_many_lines_are_thinned_and_compared_without_a_table_of_all_pairs():
    dense = FrequencyResponse(np.linspace(1.0, 500.0, 100_000), np.ones(100_000))
    tracemalloc.start()
    assert len(dense.thinned(2000)) == 2000
    assert are_opposite(dense, dense.sign_reversed()) and not are_opposite(dense, dense)
    assert tracemalloc.get_traced_memory()[1] < 40e6
    tracemalloc.stop()


def test_a_reversed_sensor_is_suspected_at_a_free_mass_and_not_at_a_mass_on_a_spring():
    s = 1j * OMEGA
    free = FrequencyResponse(OMEGA, s**2 / (2 * s**2 + 3 * s))
    # phase 180 degrees too, and right
    sprung = FrequencyResponse(OMEGA, s**2 / (2 * s**2 + 3 * s + 1e5))
    assert abs(np.angle(sprung.G[0])) > 3
    assert free.suspicions == () == sprung.suspicions
    assert "--sign=-" in free.sign_reversed().suspicions[0]
    assert "--sign=-" in free.sign_reversed().to_quantity("position").suspicions[0]
    assert free.sign_reversed().sign_reversed() == free


@pytest.mark.parametrize("size", [1e308, 1.0, 1e-308, 5e-324])
def test_a_reversed_sensor_is_suspected_in_any_unit(size):
    response = FrequencyResponse(OMEGA, np.full(20, size + 0j))
    assert response.suspicions == () and "reversed sensor" in response.sign_reversed().suspicions[0]


def test_copies_for_other_processes_are_equal_and_read_only():
    response = FrequencyResponse(
        OMEGA[::-1], MASS, MASS.real, quantity="velocity", output=Signal("v", "m/s"), origin="a"
    )
    for found in (pickle.loads(pickle.dumps(response)), copy.deepcopy(response)):
        assert found == response and (found.origin, found.notes) == (
            response.origin,
            response.notes,
        )
        assert not found.G.flags.writeable and not found.deviation.flags.writeable


def test_notes_are_added_once():
    response = FrequencyResponse(OMEGA, MASS, notes=("a",)).noted("b", None, "a", "b")
    assert response.notes == ("a", "b")
