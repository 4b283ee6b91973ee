"""Estimates of frequency responses against systems whose response is known."""

import pickle

import numpy as np
import pytest
import scipy.signal
from hypothesis import given, strategies as st

from disting.errors import InputError
from disting.measurement import TimeSeries, periodic
from disting.measurement.periodic import detected_period, excited_lines, holds_transient
from disting.measurement.table import split_header
from disting.measurement.time_series import said
from disting.model.chain import Quantity

RATE, PERIOD = 1000.0, 500
LINES = np.arange(11, 120, 2)


def multisine(lines=LINES, period=PERIOD, periods=6, seed=0):
    phases = np.random.default_rng(seed).uniform(0, 2 * np.pi, len(lines))
    time = np.arange(period * periods) / period
    return np.cos(2 * np.pi * np.outer(time, lines) + phases).sum(axis=1)


def filtered(u):
    """y = u(t - 3 samples) / 2, periodic: G = exp(-3 j omega / rate) / 2."""
    return 0.5 * np.roll(u, 3)


def test_a_delay_is_found_exactly_with_period_and_lines_detected():
    u = multisine()
    found = TimeSeries(u, filtered(u), RATE, quantity="velocity").response()
    np.testing.assert_allclose(found.frequency, LINES * RATE / PERIOD, rtol=1e-14)
    np.testing.assert_allclose(found.G, 0.5 * np.exp(-3j * found.omega / RATE), rtol=1e-10)
    assert (
        found.coherence.min() > 1 - 1e-12
        and found.deviation.max() < 1e-10
        and found.quantity is Quantity.VELOCITY
    )
    assert found.notes == (
        "period of 500 samples (0.5 s) detected in the input",
        "55 excited lines detected in the input",
    )


def test_the_transient_is_dropped():
    u = multisine()
    y = filtered(u)
    y[:PERIOD] += 100.0
    series = TimeSeries(u, y, RATE)
    good = series.response()
    assert abs(good.G / (0.5 * np.exp(-3j * good.omega / RATE)) - 1).max() < 1e-10
    y[PERIOD:] = filtered(u)[PERIOD:]
    y[:PERIOD] = np.random.default_rng(1).normal(size=PERIOD)
    assert abs(TimeSeries(u, y, RATE).response(transient=0).G / good.G - 1).max() > 1e-3


@pytest.mark.parametrize(("size", "periods"), [(0.0, 2), (0.02, 1), (1.0, 1)])
def test_the_first_of_two_periods_is_dropped_where_it_shows_a_transient(size, periods):
    """Kept, it gives the scatter of the lines."""
    u = multisine(periods=2)
    time = np.arange(len(u))
    y = filtered(u) + 0.002 * np.random.default_rng(3).normal(size=len(u))
    y += size * np.exp(-time / 100) * np.cos(0.2 * time)
    found = TimeSeries(u, y, RATE).response()
    assert found.method.periods == periods and (found.deviation is None) == (periods == 1)
    assert (periodic.SETTLED if periods == 2 else periodic.DECAYS) in found.notes
    assert TimeSeries(u, y, RATE).response(transient=0).method.periods == 2
    assert abs(found.G / (0.5 * np.exp(-3j * found.omega / RATE)) - 1).max() < 0.01


@pytest.mark.full
def test_two_periods_of_noise_are_rarely_taken_for_a_transient():
    draw = np.random.default_rng(4)
    resonant = scipy.signal.lfilter([1], [1, -1.98, 0.9801], draw.normal(size=(200, 2400)))[:, 400:]
    seen = [holds_transient(x[:1000], x[1000:]) for x in resonant]
    assert sum(seen) <= 12
    decay = np.exp(-np.arange(1000) / 100) * resonant.std() * 20
    assert sum(holds_transient(x[:1000] + decay, x[1000:]) for x in resonant) >= 150


def test_conversion_and_sign():
    u = multisine()
    series = TimeSeries(u, filtered(u), RATE)
    position, acceleration = series.response(), series.sign_reversed().response("acceleration")
    np.testing.assert_allclose(acceleration.G, position.omega**2 * position.G, rtol=1e-12)
    assert acceleration.quantity is Quantity.ACCELERATION


@pytest.mark.full
def test_deviation_and_coherence_are_those_of_the_noise():
    u = multisine(periods=201)
    source = np.random.default_rng(3)
    found = TimeSeries(u, filtered(u) + 2.0 * source.normal(size=len(u)), RATE).response()
    true = 0.5 * np.exp(-3j * found.omega / RATE)
    # |U| = N/2 of a line of amplitude 1
    expected = 2.0 * np.sqrt(PERIOD) / (PERIOD / 2) / np.sqrt(200)
    np.testing.assert_allclose(found.deviation, expected, rtol=0.2)
    assert 0.85 < np.mean(np.abs((found.G - true) / expected) ** 2) < 1.25
    share = PERIOD * 4.0 / (PERIOD / 2) ** 2 / 0.25  # noise power per power of the output
    np.testing.assert_allclose(found.coherence, 1 / (1 + share), rtol=0.05)


def test_given_lines_band_and_period():
    u = multisine()
    series = TimeSeries(u, filtered(u), RATE)
    assert np.allclose(
        series.response(period=PERIOD, lines=np.arange(22.0, 100.0, 4.0)).frequency,
        np.arange(22.0, 100.0, 4.0),
    )
    assert series.response(band=(30, 90)).frequency[[0, -1]].round(9).tolist() == [30.0, 90.0]
    one = TimeSeries(u[:PERIOD], filtered(u)[:PERIOD], RATE).response(period=PERIOD, transient=0)
    assert one.deviation is None and one.coherence is None and "one period alone" in one.notes[-1]


@pytest.mark.thin(8)
@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"period": PERIOD, "transient": 6}, "6 whole periods of 500.*none remains"),
        ({"period": 1}, "period is a whole number of at least 2"),
        ({"period": 10.5}, "period is a whole number"),
        ({"transient": -1}, "transient is a whole number"),
        ({"lines": np.arange(20.5, 60.0)}, "multiples of 2 Hz"),
        ({"lines": [0.0]}, "multiples of 2 Hz"),
        ({"lines": [np.nan]}, "multiples of 2 Hz"),
        ({"lines": [600.0]}, "up to 500 Hz"),
        ({"band": (400, 500)}, "0 frequencies are too few"),
        ({"segment": 100, "period": PERIOD}, "give one of them"),
        ({"segment": 100, "outliers": "drop"}, "not segments of Welch's method"),
        ({"segment": 4}, "at least 8 samples"),
        ({"segment": 2000}, "half-overlapping segments"),
        ({"quantity": "jerk"}, "quantity is"),
    ],
)
def test_bad_options_are_refused(options, words):
    u = multisine()
    with pytest.raises(InputError, match=words):
        TimeSeries(u, filtered(u), RATE).response(**options)


def test_an_input_that_does_not_repeat_needs_welch():
    u = np.random.default_rng(0).normal(size=3000)
    with pytest.raises(InputError, match=r"no period was found.*segment="):
        TimeSeries(u, filtered(u), RATE).response()


@pytest.mark.full
@given(st.integers(40, 400), st.integers(2, 7), st.integers(0, 10**6), st.floats(0, 0.1))
def test_the_shortest_period_is_detected_under_noise(period, periods, seed, noise):
    source = np.random.default_rng(seed)
    # line 1: no shorter period
    lines = np.unique(np.append(source.integers(1, period // 2 - 1, 12), [1, 2]))
    u = multisine(lines, period, periods, seed) + noise * source.normal(size=period * periods)
    assert detected_period(u) == period


def test_slow_signals_have_no_short_period():
    time = np.arange(8000) / 1000
    assert (
        detected_period(
            np.sin(2 * np.pi * time) + 1e-4 * np.random.default_rng(0).normal(size=8000)
        )
        == 1000
    )
    for signal in (time, time**2, np.where(time > 4, 1.0, 0.0)):
        with pytest.raises(InputError, match="does not repeat"):
            detected_period(signal)


def test_excited_lines_are_those_above_the_widest_gap():
    amplitude = np.full(101, 0.02)
    amplitude[[3, 5, 9]] = 1.0, 0.5, 0.7
    amplitude[0] = amplitude[-1] = 50.0  # constant part and half the sampling rate never count
    assert excited_lines(amplitude).tolist() == [3, 5, 9]
    assert excited_lines(np.ones(101)).tolist() == list(range(1, 100))


@pytest.mark.full
def test_welch_of_a_filter_with_noise_on_the_output():
    source = np.random.default_rng(5)
    u = source.normal(size=400_000)
    numerator, denominator = scipy.signal.butter(2, 0.2)
    y = scipy.signal.lfilter(numerator, denominator, u) + 0.05 * source.normal(size=len(u))
    found = TimeSeries(u, y, RATE).response(segment=1000, band=(5, 120))
    true = scipy.signal.freqz(numerator, denominator, found.frequency, fs=RATE)[1]
    error = np.abs(found.G - true) / found.deviation
    assert len(found) == 58 and 0.75 < np.mean(error**2) < 1.25
    assert np.all((found.coherence > 0.5) & (found.coherence < 1))


def resonance(samples):
    """A record of a resonance of 0.5 % damping at 50 Hz, with noise, and its response."""
    source, pole = np.random.default_rng(3), np.exp((-0.005 + 1j) * 2 * np.pi * 50 / RATE)
    a = np.poly([pole, pole.conj()])
    u = source.normal(size=samples)
    y = scipy.signal.lfilter([0, 1], a, u)
    record = TimeSeries(u, y + 0.02 * y.std() * source.normal(size=samples), RATE)
    return record, lambda f: scipy.signal.freqz([0, 1], a, f, fs=RATE)[1]


@pytest.mark.full
@pytest.mark.parametrize(
    ("segment", "short"),
    [
        (500, True),
        pytest.param(8000, True, marks=pytest.mark.slow),
        (40_000, False),
    ],
)
def test_segments_that_are_too_short_for_a_resonance_say_so_and_count_what_they_miss(
    segment, short
):
    record, true = resonance(200_000)
    found = record.response(segment=segment, band=(20, 200))
    error = (found.G - true(found.frequency)) / found.deviation
    assert np.mean(np.abs(error) ** 2) < 1.4
    said = [doubt for doubt in found.doubts if f"--read segment={2 * segment}" in doubt]
    assert len(said) == short and all(
        "is taken out, the rest counts as scatter" in doubt for doubt in said
    )


@pytest.mark.slow
def test_what_segments_smooth_is_taken_out_as_far_as_neighbouring_lines_tell():
    """At a resonance four lines wide a plain quotient of spectra is too small by 5 %."""
    record, true = resonance(2_000_000)
    found = record.response(segment=8000, band=(48, 52))
    u, y = record.u, record.y
    (_, uy), (f, uu) = (
        (None, scipy.signal.csd(u, y, RATE, "hann", 8000)[1]),
        scipy.signal.welch(u, RATE, "hann", 8000),
    )
    plain = (uy / uu)[np.searchsorted(f, found.frequency)]
    near = np.abs(found.frequency - 50) < 0.3
    exact = true(found.frequency)[near]
    before, after = (np.mean(np.abs(g[near] / exact - 1)) for g in (plain, found.G))
    assert after < 0.5 * before


@pytest.mark.full
def test_errors_of_neighbouring_lines_of_welch_are_not_correlated():
    u, noise = np.random.default_rng(8).normal(size=(2, 400_000))
    found = TimeSeries(u, u + noise, RATE).response(segment=1000)
    error = found.G - 1
    assert abs(np.vdot(error[1:], error[:-1])) < 0.15 * np.vdot(error, error).real


@pytest.mark.parametrize(
    ("changed", "words"),
    [
        ({"u": np.ones(100)}, "u does not move in 100 samples"),
        ({"y": []}, "y does not move in 0 samples"),
        ({"y": np.arange(99.0)}, "input has 100 samples, the output 99"),
        ({"y": np.append(np.arange(99.0), np.nan)}, "sample 100 of y is not finite"),
        ({"sampling_rate": 0}, "sampling rate is positive"),
        ({"sampling_rate": "fast"}, "sampling rate is a number"),
        ({"sampling_rate": np.inf}, "sampling rate is positive"),
        ({"quantity": "x"}, "quantity is"),
    ],
)
def test_what_is_no_record_is_refused(changed, words):
    with pytest.raises(InputError, match=words):
        TimeSeries(
            **({"u": np.arange(100.0), "y": np.arange(100.0), "sampling_rate": RATE} | changed)
        )


def test_records_are_equal_by_content_and_cannot_change():
    record = TimeSeries(np.arange(100.0), np.arange(100.0), RATE, origin="a")
    assert (
        record == TimeSeries(list(range(100)), np.arange(100.0), 1000, origin="b")
        and len({record, record}) == 1
    )
    assert record != record.sign_reversed() and record != "record"
    assert pickle.loads(pickle.dumps(record)) == record
    with pytest.raises(ValueError, match="read-only"):
        record.u[0] = 1.0


@pytest.mark.parametrize(
    ("header", "quantity", "is_assumed"),
    [
        ("speed", "velocity", False),
        ("motor_speed_1", "velocity", False),
        ("Drehzahl", "velocity", False),
        ("ActAngle", "position", True),  # no word of its own
        ("acc [g]", "acceleration", False),
        ("speed [rad]", "position", False),  # a unit says more than a name
        ("speed or angle", "position", True),
        ("y", "position", True),
    ],
)
def test_the_quantity_of_an_output_is_that_of_its_unit_or_name(header, quantity, is_assumed):
    found, notes = said(None, split_header(header))
    assert (found, bool(notes)) == (quantity, is_assumed)
    assert said("acceleration", split_header(header)) == ("acceleration", ())
