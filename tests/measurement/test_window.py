"""What a line of Welch's method shows: the response under the window of its segments."""

from dataclasses import replace

import numpy as np
import pytest
import scipy.signal

from disting.errors import InputError
from disting.fit.search.cost import Cost
from disting.fit.search.joint import JointCost
from disting.fit.search.setup import Setup
from disting.measurement import TimeSeries, mean_of
from disting.measurement.observation import Window, line_weights
from disting.model.chain import Chain
from disting.statistics.scatter import scatter
from tests.fit.monte_carlo import drive, measured, response_at, truth
from tests.measurement.test_time_series import RATE, resonance

CHAIN = Chain(2, ground_dampers=(1,))
VALUES = np.array([5e-3, 4e-3, 500.0, 0.01, 0.05])


def hann_autocorrelation(samples):
    """By numpy alone, lags 0 .. samples - 1."""
    window = scipy.signal.get_window("hann", samples)
    r = np.correlate(window, window, "full")[samples - 1 :]
    return r / r[0]


@pytest.mark.parametrize("damping", [0.002, 0.05, 0.7])
def test_the_weights_are_the_integral_over_the_impulse_response(damping):
    """A resonance: its impulse response is known, and cut off by the correlation of the window."""
    pole = 2 * np.pi * 41.3 * (-damping + 1j * np.sqrt(1 - damping**2))
    omega, n = 2 * np.pi * np.arange(4.0, 101.0, 2.0), 4000
    time = np.arange(n) / n  # T = 1 s
    h = 2 * np.real(np.exp(pole * time))
    r, step = hann_autocorrelation(n), np.where(time > 0, 1.0, 0.5) / n
    direct = np.exp(-1j * np.outer(omega, time)) @ (h * r * step)
    points, weights = line_weights(Window(1.0, 0), omega, 0)
    s = 1j * points
    found = weights @ (1 / (s - pole) + 1 / (s - pole.conjugate()))
    np.testing.assert_allclose(found, direct, rtol=0, atol=2e-3 * np.abs(direct).max())


@pytest.mark.full
def test_short_segments_show_the_response_under_their_window():
    """A resonance of 0.5 % damping in segments of half the time in which it rings."""
    record, true = resonance(200_000)
    found = record.response(segment=500, band=(20, 200))
    window = found.window
    shown = found.windowed()
    assert window.duration == 500 / RATE and shown.window.ratio is None
    points, weights = line_weights(shown.window, shown.omega, shown.quantity.order)
    pole = np.exp((-0.005 + 1j) * 2 * np.pi * 50 / RATE)
    z = np.exp(1j * points / RATE)
    model = weights @ (z / (z - pole) / (z - pole.conjugate()))
    error = np.abs(model - shown.G) / shown.deviation
    assert np.mean(error**2) == pytest.approx(1, abs=0.35) and error.max() < 4
    plain = np.abs(true(found.frequency) - shown.G) / shown.deviation
    assert plain.max() > 5


@pytest.mark.full
def test_the_window_goes_with_the_lines_and_their_quantity():
    data = measured(drive(2, 1, "random"), 1)
    few = data.masked(20.0, 90.0).to_quantity("position").sign_reversed().windowed()
    whole = data.windowed()
    inside = (data.frequency >= 20) & (data.frequency <= 90)
    np.testing.assert_allclose(-few.G * (1j * few.omega) ** 2, whole.G[inside], rtol=1e-12)
    np.testing.assert_allclose(few.deviation * few.omega**2, whole.deviation[inside], rtol=1e-12)
    assert whole.windowed() is whole
    assert mean_of([data, data]).window is None


@pytest.mark.full
def test_derivatives_of_what_a_line_shows_are_those_of_differences():
    data = measured(drive(2, 1, "random"), 1)
    cost = Cost(data).windowed()
    plant = cost.plant(CHAIN.structure, 1)
    response, gradient = plant.logarithmic_gradient(VALUES)
    np.testing.assert_array_equal(plant.response(VALUES), response)
    for i, value in enumerate(VALUES):
        moved = VALUES.copy()
        moved[i] = value * (1 + 1e-6)
        slope = np.log(plant.response(moved) / response) / (1e-6 * value)
        np.testing.assert_allclose(gradient[i], slope, atol=1e-4 * np.abs(gradient[i]).max())
    assert Cost(data).observation is None
    both = JointCost((Cost(data), Cost(data)), (Setup(), Setup(sensor="1"))).windowed()
    together = both.plant(CHAIN.structure, 1)
    np.testing.assert_allclose(together.response(VALUES), np.tile(response, 2), rtol=1e-12)
    np.testing.assert_allclose(
        together.logarithmic_gradient(VALUES)[1], np.tile(gradient, 2), rtol=1e-12
    )


def test_a_weakly_excited_line_scatters_by_more():
    """The edge of a sweep has half the amplitude of the rest."""
    machine = drive(3, 18, "swept")
    data = measured(machine, 2)
    exact = response_at(truth(machine), machine.values, data.omega)
    known, blind = (scatter(d, [exact]) for d in (data, replace(data, drive=None)))
    missed = np.abs(exact - data.G) / known.sigma
    assert missed.max() < 3 and known.sigma[-1] > 1.5 * blind.sigma[-1]
    few = data.masked(10.0, 290.0)
    assert len(few.drive) == len(few)
    with pytest.raises(InputError, match="the amplitude of the input must be positive"):
        replace(data, drive=0 * data.drive)


@pytest.mark.full
def test_lines_that_stand_apart_are_not_smoothed():
    """A multisine in segments of its period; a controller's loop with a reference."""
    lines = np.arange(8, 200, 4)
    phases = np.random.default_rng(2).uniform(0, 2 * np.pi, len(lines))
    time = np.arange(20_000) / RATE
    u = np.cos(2 * np.pi * np.outer(time, lines) + phases).sum(axis=1)
    y = u + 1e-3 * np.random.default_rng(3).normal(size=len(u))
    alone = TimeSeries(u, y, RATE).response(segment=int(RATE), band=(8, 199))
    assert alone.window is None and alone.windowed() is alone
    noise = np.random.default_rng(4).normal(size=len(u))
    with_noise = TimeSeries(noise, noise + y, RATE)
    assert with_noise.response(segment=1000).window is not None
    looped = TimeSeries(noise, noise + y, RATE, reference=noise).response(segment=1000)
    assert looped.window is None
