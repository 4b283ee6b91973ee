"""Trends of a record are removed before its response is estimated, and are reported."""

import numpy as np
import pytest
from scipy.signal import lfilter

from disting.errors import InputError
from disting.measurement import TimeSeries
from disting.measurement.trend import trend_between_periods, trend_of_one_period

RATE, PERIOD = 2000.0, 1000
LINES = np.arange(3, 400, 4)


def excitation(periods, period=PERIOD, lines=LINES):
    phases = np.random.default_rng(1).uniform(0, 2 * np.pi, len(lines))
    time = np.arange(period * periods) / period
    return np.cos(2 * np.pi * np.outer(time, lines) + phases).sum(axis=1)


def periodic_response(u, period=PERIOD):
    """Output of a damped resonance in its steady state: of order 2 at 80 Hz."""
    poles = 0.98 * np.exp(2j * np.pi * 80 / RATE)
    a = np.poly([poles, poles.conj()])
    return lfilter([1e-3], a, np.concatenate([u[:period]] * 6 + [u]))[6 * period :], a


def record(periods=4, slope=0.0, curve=0.0, noise=0.0, quantity="position", period=PERIOD):
    u = excitation(periods, period)
    y, _ = periodic_response(u, period)
    t = np.arange(len(y)) / RATE
    scatter = noise * np.random.default_rng(2).normal(size=len(y))
    return TimeSeries(
        u,
        y + 7.0 + slope * t + curve * t**2 + scatter,
        RATE,
        quantity,
        ("torque", "Nm"),
        ("angle", "rad"),
    )


@pytest.mark.thin(1)
@pytest.mark.parametrize("periods", [2, 3, 6])
@pytest.mark.parametrize("curve", [0.0, 0.7])
@pytest.mark.parametrize("noise", [0.0, 1e-3])
def test_a_constant_or_changing_speed_leaves_the_response_as_it_is(periods, curve, noise):
    still = record(periods, noise=noise).response(transient=0)
    moving = record(periods, slope=5.0, curve=curve, noise=noise).response(transient=0)
    expected = 1e-9 if not noise else 0.5 * still.deviation.max()
    assert np.abs(moving.G - still.G).max() <= expected
    kept = record(periods, slope=5.0, curve=curve, noise=noise).response(transient=0, trend="keep")
    assert np.abs(kept.G - still.G).max() > 0.1 * np.abs(still.G).max()


def test_a_single_period_shows_its_ramp_between_the_excited_lines():
    for period in (PERIOD, PERIOD + 1):
        still = record(1, period=period).response(period=period, transient=0)
        moving = record(1, slope=5.0, period=period).response(period=period, transient=0)
        np.testing.assert_allclose(moving.G, still.G, rtol=1e-7)
        assert any("drifts by 5 rad/s; the drift is subtracted" in note for note in moving.notes)


def test_a_single_period_with_all_lines_excited_tells_nothing_of_a_ramp():
    x = np.random.default_rng(0).normal(size=64) + 3.0 * np.arange(64)
    assert not trend_of_one_period(x, np.arange(1, 32))


def test_what_a_sweep_leaks_below_its_band_is_no_ramp():
    """A swept drive at rest: the few lines below the band hold the largest motion of all."""
    n = 1000
    t = np.arange(n) / n
    u = np.sin(2 * np.pi * (4 * t + 148 * t**2))
    lines = np.fft.rfft(u)
    lines[1:] /= -(np.arange(1, len(lines)) ** 2.0)
    y = np.fft.irfft(np.concatenate([[0], lines[1:]]), n)
    found = TimeSeries(u, y, 1000.0).response(
        period=n, transient=0, lines=np.arange(4.0, 301.0), trend="remove"
    )
    np.testing.assert_allclose(found.G, -(np.arange(4, 301) ** -2.0), rtol=1e-8)


@pytest.mark.parametrize(
    ("quantity", "slope", "curve", "said"),
    [
        ("position", 5.0, 0.0, "output angle [rad] drifts by 5 rad/s; the"),
        ("velocity", -2.0, 0.0, "output angle [rad] drifts by -2 rad/s; the"),
        ("position", 5.0, 0.5, "output angle [rad] drifts by 5.5 to 7 rad/s; the"),
    ],
)
def test_what_was_removed_is_reported_with_its_value(quantity, slope, curve, said):
    notes = record(4, slope, curve, quantity=quantity).response().notes
    assert [n for n in notes if n.startswith(said)], notes
    assert not any("drift" in note for note in record(4).response().notes)


def test_noise_alone_is_no_trend():
    source = np.random.default_rng(5)
    found = [trend_between_periods(source.normal(size=600), 100) for _ in range(500)]
    assert not any(found)


@pytest.mark.full
def test_a_position_that_moves_on_is_read_by_welch_as_one_at_rest():
    source = np.random.default_rng(4)
    u = source.normal(size=60_000)
    _, a = periodic_response(excitation(1))
    y = lfilter([1e-3], a, u)
    t = np.arange(len(y)) / RATE
    still, moving, kept = (
        TimeSeries(u, y + speed * t, RATE, "position", output=("angle", "rad")).response(
            segment=1000, trend=trend
        )
        for speed, trend in ((0.0, "remove"), (5.0, "remove"), (5.0, "keep"))
    )
    true = 1e-3 / np.polyval(a, z := np.exp(1j * still.omega / RATE)) * z**2
    np.testing.assert_allclose(moving.G, still.G, rtol=1e-8)
    assert np.median(np.abs(still.G / true - 1)) < 0.01
    low = kept.omega < 2 * np.pi * 40
    far = kept.G[low] / (1e-3 / np.polyval(a, z := np.exp(1j * kept.omega[low] / RATE)) * z**2)
    assert len(far) == 0 or np.max(np.abs(far - 1)) > 0.1
    assert any("drifts by 5 rad/s" in n for n in moving.notes)
    assert not any("drift" in n for n in (*still.notes, *kept.notes))


def test_other_words_are_refused():
    with pytest.raises(InputError, match="trend is remove or keep, not 'linear'"):
        record().response(trend="linear")


def wandering(seed, periods):
    """A free drive under a multisine and random torque, and its exact response at the lines."""
    random = np.random.default_rng(seed)
    lines = np.unique(np.geomspace(3, 0.1 * PERIOD, 40).astype(int))
    t = np.arange((periods + 1) * PERIOD)
    phases = random.uniform(0, 2 * np.pi, len(lines))
    u = np.cos(2 * np.pi * np.outer(t, lines) / PERIOD + phases).sum(axis=1)
    numerator, denominator = [0, 1e-4, 1e-4], [1, -1.9999, 0.9999]
    y = lfilter(numerator, denominator, u + 0.2 * random.normal(size=len(t)))
    z = np.exp(-2j * np.pi * lines / PERIOD)
    exact = np.polyval(numerator[::-1], z) / np.polyval(denominator[::-1], z)
    return TimeSeries(u, y, 1000.0), exact


@pytest.mark.full
@pytest.mark.parametrize("periods", [1, 2, 4])
def test_a_position_that_wanders_leaks_little_into_the_response(periods):
    """A random torque ends the position elsewhere in each period: the jump leaked into all lines."""
    errors = {"remove": [], "keep": []}
    for seed in range(5):
        series, exact = wandering(seed, periods)
        for trend, found in errors.items():
            found.append(np.abs(series.response(period=PERIOD, trend=trend).G / exact - 1))
    removed, kept = (float(np.median(errors[trend])) for trend in ("remove", "keep"))
    assert removed < kept / 3
    assert removed < 0.03


def test_the_deviation_of_a_position_that_wanders_is_that_of_its_lines():
    series, exact = wandering(1, 8)
    response = series.response(period=PERIOD)
    assert any("drifts irregularly" in note for note in response.notes)
    assert np.mean((np.abs(response.G - exact) / response.deviation) ** 2) == pytest.approx(
        1, abs=0.6
    )
