"""The fast response and its derivatives against a dense solve and differences."""

import warnings

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from disting.errors import InputError
from disting.fit.search.plant import Plant
from disting.model.chain import Chain, Quantity
from tests.fit.drives import CHAINS, OMEGA, dense_response, response, truth


@pytest.mark.thin(2)
@pytest.mark.parametrize("chain", CHAINS, ids=str)
@settings(max_examples=30)
@given(seed=st.integers(0, 10**6))
def test_the_response_is_that_of_the_matrix_equation(chain, seed):
    values = truth(chain, seed)
    p = np.array([values[n] for n in chain.parameters])
    expected = [dense_response(chain, values, 1j * w) for w in OMEGA[::20]]
    np.testing.assert_allclose(Plant(chain.structure, OMEGA[::20]).response(p), expected, rtol=1e-9)


@pytest.mark.thin(1)
@pytest.mark.parametrize("chain", CHAINS, ids=str)
@settings(max_examples=30)
@given(seed=st.integers(0, 10**6))
def test_derivatives_are_those_of_central_differences(chain, seed):
    values = truth(chain, seed)
    p = np.array([values[n] for n in chain.parameters])
    plant, h = Plant(chain.structure, OMEGA[::10]), 1e-6
    _, gradient = plant.logarithmic_gradient(p)
    for i in range(len(p)):
        step = h * p[i] * (np.arange(len(p)) == i)
        difference = np.log(plant.response(p + step) / plant.response(p - step)) / (2 * h)
        np.testing.assert_allclose(gradient[i] * p[i], difference, rtol=1e-5, atol=1e-6)


@pytest.mark.parametrize("chain", CHAINS, ids=str)
def test_a_batch_is_each_vector_alone(chain):
    p = np.array([list(truth(chain, seed).values()) for seed in range(3)])
    plant = Plant(chain.structure, OMEGA)
    response, gradient = plant.logarithmic_gradient(p)
    assert response.shape == (3, OMEGA.size) and gradient.shape == (3, p.shape[1], OMEGA.size)
    for k in range(3):
        np.testing.assert_array_equal(response[k], plant.response(p[k]))
        np.testing.assert_array_equal(gradient[k], plant.logarithmic_gradient(p[k])[1])


def test_a_reversed_sensor_changes_the_sign_and_no_derivative():
    chain, p = CHAINS[0], np.array([2.0, 3.0])
    plus, minus = (Plant(chain.structure, OMEGA, sign).logarithmic_gradient(p) for sign in (1, -1))
    np.testing.assert_array_equal(plus[0], -minus[0])
    np.testing.assert_array_equal(plus[1], minus[1])
    with pytest.raises(InputError, match="sign of a sensor is 1 or -1, not 2"):
        Plant(chain.structure, OMEGA, 2)


def test_a_free_mass_by_hand():
    response, gradient = Plant(Chain(1, damped=False).structure, OMEGA).logarithmic_gradient(
        np.array([4.0])
    )
    np.testing.assert_allclose(response, 0.25)
    np.testing.assert_allclose(gradient, -0.25 * np.ones((1, OMEGA.size)))


def test_a_line_on_an_antiresonance_without_damping_is_no_division_by_zero():
    """k = m2 w^2: the force meets a mass that does not move."""
    response, gradient = Plant(
        Chain(2, damped=False).structure, np.array([2.0])
    ).logarithmic_gradient(np.array([1.0, 1.0, 4.0]))
    assert np.all(np.abs(response) < 1e-12) and np.all(np.isfinite(gradient))


def test_a_line_on_a_resonance_without_damping_is_no_division_by_zero():
    """k (1/m1 + 1/m2) = w^2."""
    response, gradient = Plant(
        Chain(2, damped=False).structure, np.array([2.0])
    ).logarithmic_gradient(np.array([1.0, 1.0, 2.0]))
    assert np.all(np.abs(response) > 1e10) and np.all(np.isfinite(response))
    assert np.all(np.isfinite(gradient))


@pytest.mark.parametrize("chain", [c for c in CHAINS if c.quantity is Quantity.ACCELERATION])
def test_a_wrong_unit_of_frequency_makes_other_values_of_the_same_chain(chain):
    """Hz taken for rad/s: no fit can tell, so that a grid alone can make it suspicious."""
    c, values = 2 * np.pi, truth(chain, 3)
    powers = {"m": 0, "d": -1, "b": -1, "k": -2, "T": 1}
    other = {name: value * c ** powers[name[0]] for name, value in values.items()}
    right, wrong = response(chain, values), response(chain, other, OMEGA / c)
    np.testing.assert_allclose(wrong.G, right.G, rtol=1e-9)


def test_values_without_end_overflow_without_a_warning():
    """As an interval meets them that has no upper end."""
    plant = Plant(Chain(3).structure, OMEGA)
    p = np.full(len(plant.parameters), 1e200)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert plant.response(p).shape == plant.logarithmic_gradient(p)[0].shape == OMEGA.shape
