"""Deviations by distortion, against static nonlinearities whose best linear approximation is known
from many realisations.
"""

import pickle
from dataclasses import replace

import numpy as np
import pytest

from disting.measurement import TimeSeries
from disting.measurement.linearity import describe_levels, describe_nonlinearity
from disting.measurement.repeats import mean_of
from disting.measurement.scaling import scale

PERIOD, PERIODS = 1000, 5
# odd lines but for one of each three, drawn at random
ODD = np.setdiff1d(
    np.arange(5, 301, 2), 5 + 6 * np.arange(49) + 2 * np.random.default_rng(0).integers(0, 3, 49)
)
ALL = np.arange(5, 200)


def response(seed, cube=0.0, square=0.0, noise=0.0, lines=ODD, level=1.0, phases=None):
    """Response of y = 0.5 u + square u^2 + cube u^3 to random phases."""
    source = np.random.default_rng([seed, 1])
    phase = np.random.default_rng(seed if phases is None else phases).uniform(0, 7, len(lines))
    time = np.arange(PERIOD) / PERIOD
    u = np.cos(2 * np.pi * np.outer(time, lines) + phase).sum(axis=1) * np.sqrt(2 / len(lines))
    u = np.tile(level * u, PERIODS)
    y = 0.5 * u + square * u**2 + cube * u**3 + noise * source.normal(size=len(u))
    return TimeSeries(u, y, 1000.0).response(period=PERIOD, transient=0)


@pytest.mark.full
def test_lines_without_excitation_predict_how_realisations_scatter():
    each = [response(seed, cube=0.02, noise=0.002) for seed in range(40)]
    best = np.mean([r.G for r in each], axis=0)
    measured = [np.mean(np.abs(r.G - best) ** 2 / r.deviation**2) for r in each]
    alone = [np.mean(np.abs(r.G - best) ** 2 / r.noise**2) for r in each]
    assert np.mean(measured) == pytest.approx(1.0, abs=0.25) and np.mean(alone) > 50


@pytest.mark.full
def test_realisations_show_their_distortion_by_their_scatter():
    each = [response(seed, cube=0.02, noise=0.002, lines=ALL) for seed in range(120)]
    best = np.mean([r.G for r in each], axis=0)
    means = [mean_of(each[k : k + 4]) for k in range(0, 120, 4)]
    assert all(m.nonlinear is not None and each[0].nonlinear is None for m in means)
    ratios = [np.mean(np.abs(m.G - best) ** 2 / m.deviation**2) for m in means]
    assert np.mean(ratios) == pytest.approx(1.0, abs=0.2)
    noise = np.median([m.noise / np.abs(m.G) for m in means])
    own = np.median([r.deviation / np.abs(r.G) for r in each])
    assert noise == pytest.approx(own / 2, rel=0.15)
    assert "changes between the repeats" in describe_nonlinearity(means[0])


def test_distortion_of_one_excitation_is_not_averaged_away():
    one, *others = [response(seed, cube=0.02, noise=0.01, phases=3) for seed in range(4)]
    mean = mean_of([one, *others])
    assert np.median(mean.nonlinear / one.nonlinear) == pytest.approx(1, abs=0.05)
    assert np.median(mean.noise / one.noise) == pytest.approx(0.5, abs=0.2)


@pytest.mark.full
@pytest.mark.parametrize("square", [0.0, 0.05])
def test_where_no_odd_distortion_is_measured_deviations_are_those_of_the_periods(square):
    """Products of an even number of odd lines are even: they do not fall on excited ones."""
    for seed in range(20):
        found = response(seed, square=square, noise=0.02)
        assert found.nonlinear is None and found.noise is found.deviation
        assert bool(describe_nonlinearity(found)) == bool(square)
    assert mean_of([response(seed, noise=0.02) for seed in range(4)]).nonlinear is None


def test_deviations_of_distortion_follow_the_response():
    found = response(0, cube=0.02, noise=0.002)
    moved = scale(found.to_quantity("velocity"), 3.0).subset(np.arange(10, 30))
    factor = 3 * found.omega[10:30]
    np.testing.assert_allclose(moved.nonlinear, found.nonlinear[10:30] * factor)
    np.testing.assert_allclose(moved.noise, found.noise[10:30] * factor, rtol=1e-6)
    copy = pickle.loads(pickle.dumps(found))
    assert copy == found and np.array_equal(copy.nonlinear, found.nonlinear)


def test_the_sentence_names_both_sizes():
    found = response(0, cube=0.02, noise=0.002)
    size = np.abs(found.G)
    noise, level = (100 * np.median(x / size) for x in (found.noise, found.nonlinear))
    said = describe_nonlinearity(found)
    assert said.startswith(f"noise {noise:.2g} %, distortion {level:.2g} % (probably friction")
    assert said.endswith("values hold for this amplitude, and may lie outside their intervals")
    assert not describe_nonlinearity(replace(found, nonlinear=None, distortion=None))


def test_levels_are_compared_where_both_are_known_and_differ():
    one, other = response(0), response(1, level=0.2)
    assert describe_levels(one, other) == ("1", "0.2")
    assert describe_levels(one, response(1)) is None
    assert describe_levels(one, replace(other, method=None)) is None
