"""Records of closed loops: the reference gives what the input alone cannot; and lines that tell
nothing are left out.
"""

import numpy as np
import pytest
from scipy.optimize import least_squares
from scipy.signal import butter, chirp, freqz, lfilter

from disting.errors import InputError
from disting.measurement import TimeSeries, read
from disting.measurement.feedback_in_noise import loop_in_noise
from tests.measurement.bench_data import measured_data

RATE, N = 1000.0, 100_000
# of y = GAIN z^-1 / (1 - POLE z^-1) u, u = r - FEEDBACK z^-1 (y + noise)
POLE, GAIN, FEEDBACK = 0.9, 0.1, 4.0


def closed_loop(noise=0.5, seed=0):
    """Input, measured output and reference."""
    source = np.random.default_rng(seed)
    r, e = source.normal(size=N), noise * source.normal(size=N)
    opened, closed = [1, -POLE], [1, -POLE, FEEDBACK * GAIN]
    u = lfilter(opened, closed, r - FEEDBACK * np.roll(e, 1))
    return u, lfilter([0, GAIN], opened, u) + e, r


def true(frequency):
    return freqz([0, GAIN], [1, -POLE], frequency, fs=RATE)[1]


@pytest.mark.full
def test_the_reference_gives_the_plant_and_its_deviation_in_closed_loop():
    u, y, r = closed_loop()
    alone = TimeSeries(u, y, RATE).response(segment=1000, band=(5, 100))
    found = TimeSeries(u, y, RATE, reference=r).response(segment=1000, band=(5, 100))
    error = np.abs(found.G - true(found.frequency)) / found.deviation
    assert len(found) > 45 and 0.7 < np.mean(error**2) < 1.3
    biased = np.abs(alone.G - true(alone.frequency)) / alone.deviation
    own = np.abs(alone.G) * alone.loop.scatter
    assert np.median(biased * alone.deviation / own) > 10
    assert alone.is_biased_by_loop and found.loop is None
    assert "the input follows the past output" in alone.loop_sentence
    assert alone.loop_sentence in alone.suspicions
    assert "--read reference=NAME" in alone.loop_sentence
    # the bias is estimated, and stands in the deviation
    true_bias = np.abs(1 - true(alone.frequency) / alone.G)
    assert np.median(alone.loop.bias / true_bias) == pytest.approx(1, abs=0.15)
    assert np.median(biased) < 1.2


@pytest.mark.full
def test_a_reference_that_is_the_input_changes_nothing():
    u = np.random.default_rng(1).normal(size=20_000)
    y = lfilter([0, GAIN], [1, -POLE], u) + np.random.default_rng(2).normal(size=20_000)
    one, other = (
        TimeSeries(u, y, RATE, reference=r).response(segment=500, least_coherence=0)
        for r in (None, u)
    )
    np.testing.assert_allclose(one.G, other.G, rtol=1e-12)
    np.testing.assert_allclose(one.deviation, other.deviation, rtol=1e-9)
    ordinary = np.abs(one.G) * np.sqrt((1 - one.coherence) / one.coherence * (1 + 2 / 36) / 79)
    clear = one.coherence > 0.1
    # and what chance bends here and there
    assert np.all(one.deviation[clear] > 0.99 * ordinary[clear])
    assert np.median(one.deviation / ordinary) == pytest.approx(1)


@pytest.mark.thin(1)
@pytest.mark.parametrize("noise", [0.01, 0.1])
@pytest.mark.parametrize("kind", ["white", "low-pass", "binary", "steps", "chirp", "multisine"])
def test_no_open_loop_is_taken_for_a_closed_one(kind, noise):
    source, n = np.random.default_rng(3), 40_000
    white = source.normal(size=n)
    u = {
        "white": lambda: white,
        "low-pass": lambda: lfilter(*butter(3, 0.3), white),
        "binary": lambda: np.repeat(np.sign(white[: n // 10]), 10),
        "steps": lambda: np.repeat(white[: n // 500], 500),
        "chirp": lambda: chirp(np.arange(n) / RATE, 1, n / RATE, 200),
        "multisine": lambda: np.tile(
            np.cos(np.outer(np.arange(2000) * np.pi / 1000, range(5, 400, 4)) + white[:99]).sum(1),
            n // 2000,
        ),
    }[kind]()
    y = lfilter([0, 1e-3, 1e-3], [1, -1.98, 0.985], u)
    coloured = lfilter([1], [1, -0.95], source.normal(size=n))
    assert loop_in_noise(u, y + noise * np.std(y) * coloured, 1) is None
    assert loop_in_noise(u, y + noise * np.std(y) * coloured, 0) is None


@pytest.mark.parametrize("seed", range(3))
def test_a_sweep_of_a_position_is_no_loop(seed):
    """A rotor with friction, a disturbance and an encoder of 20 bits, excited in open loop."""
    source, n, rate = np.random.default_rng(seed), 40_000, 8000.0
    u = chirp(np.arange(n) / rate, 2, n / rate, 500) + 0.01 * source.normal(size=n)
    speed = lfilter([0, 1e-3], [1, -0.9995], u + 0.05 * source.normal(size=n))
    count = 2 * np.pi / 2**20
    assert loop_in_noise(u, np.round(np.cumsum(speed) / rate / count) * count, 0) is None


@pytest.mark.full
@pytest.mark.parametrize("noise", [0.05, 0.1])
def test_a_loop_shows_beside_a_strong_excitation(noise):
    """Little noise, of a speed and of a position."""
    u, y, _ = closed_loop(noise)
    assert loop_in_noise(u, y, 1) is not None and loop_in_noise(u, np.cumsum(y), 0) is not None


@pytest.mark.full
@pytest.mark.parametrize("seed", range(3))
def test_a_loop_that_is_slow_beside_the_sampling_shows_and_its_bias_is_estimated(seed):
    """A plant with a time constant of 100 samples, whose disturbance is as strong as its input."""
    source, n = np.random.default_rng(seed), 80_000
    r, d = source.normal(size=n), source.normal(size=n)
    y = lfilter([0, 0.05], [1, -0.99, 0.2 * 0.05], r + d)
    u = r - 0.2 * np.roll(y, 1)
    u[0] = r[0]
    found = TimeSeries(u, y, RATE, "velocity").response(segment=4000, band=(0.5, 20))
    assert found.is_biased_by_loop
    exact = freqz([0, 0.05], [1, -0.99], found.frequency, fs=RATE)[1]
    alone = np.abs(found.G - exact) / np.abs(found.G * found.loop.scatter)
    assert np.mean(np.abs(found.G - exact) ** 2 / found.deviation**2) < 2 < np.mean(alone**2)


@pytest.mark.full
def test_an_input_that_changes_between_samples_is_not_surely_fed_back():
    """A binary input held for 10 samples of which every fourth is recorded, in open loop."""
    source, n = np.random.default_rng(0), 80_000
    u = np.repeat(np.sign(source.normal(size=n // 10)), 10)
    position = np.cumsum(lfilter([0, 1e-3], [1, -0.999], u))
    loop = loop_in_noise(u[::4], position[::4], 0)
    assert loop is None or loop.evidence.endswith("changes between the recorded samples")
    u, y, _ = closed_loop()
    assert "unless" not in loop_in_noise(u, y, 1).evidence


def test_a_short_or_constant_record_has_no_such_test():
    u, y, _ = closed_loop()
    assert loop_in_noise(u[:400], y[:400], 1) is None
    assert loop_in_noise(u[:5000], y[:5000], 1) is not None
    assert loop_in_noise(u[:5000], np.ones(5000), 1) is None


@pytest.mark.full
def test_lines_without_coherence_are_left_out_and_counted():
    source = np.random.default_rng(4)
    u = lfilter(*butter(4, 0.1), source.normal(size=N))
    y = lfilter([0, GAIN], [1, -POLE], u) + 0.05 * source.normal(size=N)
    whole = TimeSeries(u, y, RATE).response(segment=1000, least_coherence=0)
    kept = TimeSeries(u, y, RATE).response(segment=1000)
    assert len(whole) == 249 and 25 < len(kept) < 75 and kept.frequency[0] == 2.0
    assert np.quantile(kept.frequency, 0.9) < 130  # the excitation ends at 50 Hz, 24 dB per octave
    assert any(
        f"{249 - len(kept)} of 249 lines left out" in note and "nine tenths" in note
        for note in kept.notes
    )


@pytest.mark.full
def test_too_few_lines_say_why():
    u, y, r = closed_loop()
    noise = np.random.default_rng(5).normal(size=N)
    for series, options, words in (
        (
            TimeSeries(u, y, RATE),
            {"segment": 1000, "band": (100, 102)},
            r"2 frequencies are too few.*band 100..102 Hz",
        ),
        (
            TimeSeries(r, noise, RATE),
            {"segment": 100},
            r"all 24 lines left out|of 24 lines left out",
        ),
        (
            TimeSeries(np.sin(0.1 * np.pi * np.arange(4000)), y[:4000], RATE),
            {},
            r"1 excited line in a period of 20 samples: too few.*--read segment=SAMPLES",
        ),
        (TimeSeries(u, y, RATE), {"least_coherence": 0.5}, "least_coherence is for Welch"),
    ):
        with pytest.raises(InputError, match=words):
            series.response(**options)
    with pytest.raises(InputError, match="reference has 10 samples"):
        TimeSeries(u, y, RATE, reference=r[:10])


def test_a_periodic_reference_tells_period_and_lines():
    lines = np.arange(5, 60, 3)
    r = np.tile(
        np.cos(2 * np.pi * np.outer(np.arange(1000) / 1000, lines) + lines**2).sum(axis=1), 20
    )
    opened, closed = [1, -POLE], [1, -POLE, FEEDBACK * GAIN]
    e = 2.0 * np.random.default_rng(6).normal(size=len(r))
    u = lfilter(opened, closed, r - FEEDBACK * np.roll(e, 1))
    y = lfilter([0, GAIN], opened, u) + e
    found = TimeSeries(u, y, RATE, reference=r).response()
    assert (
        np.allclose(found.frequency, lines)
        and np.mean(np.abs(found.G - true(found.frequency)) ** 2 / found.deviation**2) < 3
    )


@pytest.mark.full
@pytest.mark.parametrize("segment", [4096, 8192])
def test_the_mass_of_a_real_axis_in_closed_loop(segment):
    """95.1 kg published; without the reference the same lines say less than 1 kg."""
    path = measured_data("EMPS.mat")
    options = {"input": "vir", "output": "qm", "segment": segment, "to": "acceleration"}
    found = read(path, reference="qg", **options)
    weight = np.sqrt(found.coherence / (1 - found.coherence))

    def residual(logarithms):
        ratio = (np.exp(logarithms[0]) + np.exp(logarithms[1]) / (1j * found.omega)) * found.G
        return np.concatenate([weight * np.log(np.abs(ratio)), weight * np.angle(ratio)])

    force = 35.15065188  # N per unit of the input
    assert np.exp(least_squares(residual, [0.0, 0.0]).x[0]) * force == pytest.approx(95.1, rel=0.02)
    assert any("lines left out" in note for note in found.notes)
    assert "the input follows the past output" in read(path, **options).loop_sentence
