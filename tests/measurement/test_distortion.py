"""What lines without excitation show, against records whose distortion and noise are known."""

import pickle

import numpy as np
import pytest

from disting.measurement import TimeSeries, read
from disting.measurement.scaling import scale
from tests.measurement.bench_data import measured_data

PERIOD, PERIODS = 1000, 21
LINES = np.arange(5, 200, 4)  # odd, and not all the odd ones


def record(square=0.0, cube=0.0, noise=0.0, distorted_input=0.0):
    time = np.arange(PERIOD) / PERIOD
    u = np.cos(2 * np.pi * np.outer(time, LINES) + 0.3 * LINES**2).sum(axis=1) / 5
    u = np.tile(u + distorted_input * (u**2 - np.mean(u**2)), PERIODS)
    y = 0.5 * np.roll(u, 2) + square * u**2 + cube * u**3
    return TimeSeries(u, y + noise * np.random.default_rng(0).normal(size=len(y)), 1000.0)


def levels(series):
    """Medians of odd lines, even lines and noise, relative to G = 0.5."""
    found = series.response().distortion
    assert (np.count_nonzero(~found.even), np.count_nonzero(found.even)) == (48, 96)
    assert not np.any(np.isin(np.rint(found.omega / (2 * np.pi)), LINES))
    return tuple(
        float(np.median(x)) / 0.5
        for x in (found.level[~found.even], found.level[found.even], found.noise)
    )


def test_even_and_odd_nonlinearities_show_on_their_own_lines():
    odd, even, _ = levels(record(square=0.05))
    assert even > 0.01 > 1e-10 > odd
    odd, even, _ = levels(record(cube=0.05))
    assert odd > 0.01 > 1e-10 > even


def test_noise_is_told_from_distortion():
    odd, even, noise = levels(record(noise=0.1))
    # std of the mean per amplitude of a line
    expected = 0.1 * np.sqrt(PERIOD) / np.sqrt(PERIODS - 1) / (PERIOD / 2 / 5) / 0.5
    assert noise == pytest.approx(expected, rel=0.1) and odd == pytest.approx(
        expected, rel=0.4
    ) == pytest.approx(even, rel=0.4)


def test_what_a_distorted_input_makes_through_the_plant_does_not_count():
    assert max(levels(record(distorted_input=0.1))[:2]) < 1e-3


def test_distortion_follows_conversion_and_scale_and_copies():
    found = record(square=0.05, noise=0.01).response()
    moved = scale(found.to_quantity("acceleration"), 3.0)
    np.testing.assert_allclose(
        moved.distortion.level, 3 * found.distortion.level * found.distortion.omega**2
    )
    np.testing.assert_allclose(
        moved.distortion.noise, 3 * found.distortion.noise * found.distortion.omega**2
    )
    assert np.array_equal(
        pickle.loads(pickle.dumps(found)).distortion.level, found.distortion.level
    )
    assert any(
        "144 lines without excitation show" in note and "even" in note for note in found.notes
    )


def test_odd_and_even_are_told_apart_where_all_excited_lines_are_odd():
    """x^2 and x^3 of lines that are odd and even make distortion everywhere."""
    odd = record(cube=0.05, noise=0.01).response().distortion
    assert [(kind, int(chosen.sum())) for kind, _, chosen in odd.kinds] == [
        ("odd distortion", 48),
        ("even distortion", 96),
        ("noise", 144),
    ]
    time, lines = np.arange(PERIOD) / PERIOD, np.arange(5, 200, 5)
    u = np.cos(2 * np.pi * np.outer(time, lines) + 0.3 * lines**2).sum(axis=1) / 5
    both = (
        TimeSeries(u, 0.5 * u + 0.05 * u**3, 1000.0).response(period=PERIOD, transient=0).distortion
    )
    assert [(kind, int(chosen.sum())) for kind, _, chosen in both.kinds] == [
        ("distortion", len(both.omega))
    ]


def test_no_lines_between_give_none_and_one_period_no_noise():
    time = np.arange(PERIOD) / PERIOD
    u = np.cos(2 * np.pi * np.outer(time, np.arange(1, 40)) + np.arange(39) ** 2).sum(axis=1)
    assert (
        TimeSeries(np.tile(u, 3), np.tile(np.roll(u, 1), 3), 1000.0).response().distortion is None
    )
    one = record(square=0.1)
    single = TimeSeries(one.u[:PERIOD], one.y[:PERIOD], 1000.0).response(period=PERIOD, transient=0)
    assert single.distortion.noise is None and "noise" not in single.notes[-1].split("show")[-1]


@pytest.mark.full
def test_the_odd_odd_multisine_of_the_bench_shows_its_distortion():
    found = read(
        measured_data("fditools_motorbench_B.mat"),
        input="iq_adx",
        output="theta_mx",
        to="acceleration",
    ).distortion
    assert (np.count_nonzero(~found.even), np.count_nonzero(found.even)) == (59, 118)
    assert np.median(found.level / found.noise) > 2
    assert (
        read(
            measured_data("fditools_motorbench_A.mat"), input="iq_adx", output="theta_mx"
        ).distortion
        is None
    )
