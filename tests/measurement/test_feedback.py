"""Closed loops that periodic records show by their noise, without a reference."""

import numpy as np
import pytest
from scipy.signal import freqz, lfilter

from disting.measurement import TimeSeries, look, mean_of
from disting.measurement.feedback import feedback_in_periods

RATE, N, PERIODS = 1000.0, 1000, 9
# of y = GAIN z^-1 / (1 - POLE z^-1) u, u = r - FEEDBACK z^-1 (y + noise)
POLE, GAIN, FEEDBACK = 0.95, 0.2, 2.0
LINES = np.arange(3, 200, 3)


def record(feedback=0.0, noise=0.3, acting=0.0, sensing=0.0, seed=0, size=1.0, periods=PERIODS):
    """A multisine through the plant: noise of the output, recorded noise that acts, and noise of
    the sensor of the input.
    """
    source, n = np.random.default_rng(seed), N * periods
    phases = 2 * np.pi * source.random(len(LINES))
    one = np.cos(2 * np.pi * np.outer(np.arange(N) / N, LINES) + phases).sum(axis=1)
    r = np.tile(size * one, periods) + acting * source.normal(size=n)
    e = noise * source.normal(size=n)
    opened, closed = [1, -POLE], [1, -POLE, feedback * GAIN]
    u = lfilter(opened, closed, r - feedback * np.roll(e, 1))
    y = lfilter([0, GAIN], opened, u) + e
    return TimeSeries(u + sensing * source.normal(size=n), y, RATE, "velocity")


def true(frequency):
    return freqz([0, GAIN], [1, -POLE], frequency, fs=RATE)[1]


def test_noise_that_a_controller_feeds_back_shows_the_loop():
    found = record(FEEDBACK).response()
    assert found.loop is not None and not found.is_biased_by_loop
    assert found.loop_sentence.startswith("input and output were recorded in a closed loop: their")
    assert found.loop_sentence.endswith("its bias of the response is negligible")
    assert found.suspicions == ()
    # a bias that is said to be negligible is none
    error = np.abs(found.G - true(found.frequency)) / found.deviation
    assert np.mean(error**2) < 2


@pytest.mark.full
@pytest.mark.parametrize(
    "noises",
    [
        {"sensing": 0.3},
        {"acting": 0.3},
        {"acting": 0.3, "sensing": 0.3},
        {"acting": 1.0, "noise": 0.003},
        {},
        {"noise": 0.0},
    ],
)
def test_no_open_loop_is_taken_for_a_closed_one(noises):
    assert not [s for s in range(25) if record(seed=s, **noises).response().loop]


def test_a_disturbance_of_one_period_is_no_loop():
    """A soft start, kept as data, moves the input, and the machine swings on its own."""
    open_loop = record(noise=0.01)
    u, y = open_loop.u.copy(), open_loop.y.copy()
    u[:N] *= np.linspace(0, 1, N)
    y[:N] += np.exp(-np.arange(N) / 50) * 5
    assert TimeSeries(u, y, RATE, "velocity").response(transient=0, period=N).loop is None


@pytest.mark.parametrize("periods", [2, 3])  # one of them is dropped
def test_too_few_periods_show_no_loop(periods):
    assert record(FEEDBACK, periods=periods).response().loop is None


def test_a_reference_settles_it():
    closed = record(FEEDBACK)
    with_reference = TimeSeries(closed.u, closed.y, RATE, "velocity", reference=closed.u)
    assert with_reference.response().loop is None


def test_the_bias_of_a_ratio_of_means_is_as_stated():
    """Against the mean over many records of one line with as much noise as excitation."""
    source, n, periods = np.random.default_rng(1), 40_000, 4

    def noise():
        return source.normal(size=(periods, n)) + 1j * source.normal(size=(periods, n))

    feedback, v = -0.5 + 1.0j, noise()
    u, y = 1.5 + feedback * v, 3.0 + v
    ratio = np.mean(y.mean(axis=0) / u.mean(axis=0))
    share = np.exp(-(1.5**2) / (np.abs(feedback) ** 2 * 2 / periods))
    assert ratio == pytest.approx(2.0 + (1 / feedback - 2.0) * share, abs=0.05)
    found = feedback_in_periods(u[:, :200], y[:, :200], np.zeros(200))
    assert found is not None
    bias = (1 / feedback / 2 - 1) * share
    assert np.median(found.bias) == pytest.approx(abs(bias / (1 + bias)), rel=0.5)


def test_lines_as_weak_as_their_noise_are_named():
    found = record(FEEDBACK, noise=3.0, size=0.03).response(period=N, lines=LINES)
    assert found.is_biased_by_loop
    assert found.suspicions[0] == found.loop_sentence
    assert "the response is biased toward minus the inverse controller" in found.loop_sentence
    assert found.loop_sentence.endswith("more strongly")
    count = np.count_nonzero(found.loop.harmed)
    assert f"at {count} line" in found.loop_sentence
    part = found.masked(0, 100)
    assert len(part.loop.bias) == len(part) < len(found)


def written(path, series):
    table = np.column_stack([np.arange(len(series)) / RATE, series.u, series.y])
    header = "time [s],torque [Nm],speed [rad/s]"
    np.savetxt(path, table, delimiter=",", header=header, comments="", fmt="%.17g")
    return path


@pytest.mark.full
def test_look_states_a_loop_or_what_it_assumes(tmp_path):
    options = {"input": "torque [Nm]", "output": "speed [rad/s]"}
    file = written(tmp_path / "closed.csv", record(FEEDBACK))
    seen = look(file, **options)
    assert f"loop: {seen.response.loop_sentence}" in " ".join(repr(seen).split())
    assert seen.to_dict()["loop"] == seen.response.loop_sentence != ""
    assert not any("loop" in a.what for a in seen.assumed) and seen.doubts == ()
    assert look(file, reference="torque [Nm]", **options).to_dict()["loop"] == ""
    # a bias beyond scatter is a doubt
    noisy = look(file, segment=500, **options)
    assert noisy.response.loop_sentence in noisy.doubts and "\nloop:" not in repr(noisy)
    # means over periods hold in closed loop too; one period shows nothing, nor does Welch's method
    file = written(tmp_path / "open.csv", record())
    assert not any("loop" in a.what for a in look(file, **options).assumed)
    short = written(tmp_path / "short.csv", record(FEEDBACK, periods=2))
    for other in (look(short, transient=1, **options), look(file, segment=500, **options)):
        (assumed,) = [a for a in other.assumed if "loop" in a.what]
        assert str(assumed).endswith("if not, give --read reference=NAME")


def test_the_mean_of_repeats_keeps_a_loop_with_its_own_scatter():
    one, other = (record(FEEDBACK, seed=seed).response() for seed in (1, 2))
    mean = mean_of([one, other])
    np.testing.assert_allclose(mean.loop.bias, one.loop.bias)
    np.testing.assert_allclose(mean.loop.scatter, mean.deviation / np.abs(one.G))
