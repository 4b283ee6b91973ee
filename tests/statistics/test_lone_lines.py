"""Gains that rest on single lines, levels of explanation, and data of too few lines."""

from math import inf

import numpy as np
import pytest

from disting.fit import figure_1, select
from disting.fit.judge.explanation import (
    Level,
    chi2_apart,
    largest_cost,
    largest_miss,
    level_of,
    needed_lines,
    noise_limit,
)
from disting.measurement import FrequencyResponse, read
from disting.model.chain import Chain
from disting.statistics.lone_lines import lone_lines
from disting.statistics.scatter import Scatter
from tests.fit.drives import dense_response, response
from tests.measurement.bench_data import measured_data

OMEGA = 2 * np.pi * np.geomspace(3.0, 400.0, 120)
DRIVE = Chain(2, damped=True, dead_time=True)
VALUES = {"m1": 1e-3, "m2": 1e-3, "k12": 87.0, "d12": 0.012, "Td": 1.9e-4}
SMALL = Chain(3, damped=True, dead_time=True)
SMALL_VALUES = VALUES | {"m3": 1e-4, "k23": 12.0, "d23": 3e-3}
TWO_AND_THREE = [
    c for c in figure_1([2, 3]) if len(c.ground_dampers) < 2 and c.dead_time and not c.lag
]
FREE = [c for c in TWO_AND_THREE if not c.ground_dampers]


def disturbed(size, lines, seed=3):
    """A drive of two masses with lines that a disturbance moves by so many times the scatter."""
    data = response(DRIVE, VALUES, OMEGA, noise=1.5e-3, seed=seed)
    moved = data.G.copy()
    moved[list(lines)] *= 1 + size * 1.5e-3 * np.exp(0.7j)
    return FrequencyResponse(data.omega, moved)


@pytest.mark.full
@pytest.mark.parametrize(
    ("candidates", "size", "lines"),
    [
        (FREE, 12.0, (62, 63)),
        *[
            pytest.param(TWO_AND_THREE, size, at, marks=pytest.mark.slow)
            for size, at in ((12.0, (62, 63)), (20.0, (70,)), (20.0, (62, 63)))
        ],
    ],
)
def test_a_disturbed_line_makes_no_mass(candidates, size, lines):
    found = select(disturbed(size, lines), candidates)
    assert found.selected.chain.n_masses == 2
    kept = [m.candidate.chain for m in (*found.members, *found.containing)]
    assert DRIVE in kept
    resting = [c for c in found.candidates if c.rests_on is not None]
    assert all(
        c.excluded is None or c.excluded.by not in {r.chain for r in resting}
        for c in found.candidates
    )


@pytest.mark.full
@pytest.mark.parametrize(
    ("candidates", "seed"),
    [
        (FREE, 0),
        *(pytest.param(TWO_AND_THREE, k, marks=pytest.mark.slow) for k in range(10)),
    ],
)
def test_a_small_mass_that_several_lines_see_is_found(candidates, seed):
    """A tenth of the others, its resonance five lines wide."""
    data = response(SMALL, SMALL_VALUES, OMEGA, noise=1.5e-3, seed=seed)
    found = select(data, candidates)
    assert found.selected.chain.n_masses == 3 and found.selected.rests_on is None
    assert found.explanation.level is Level.EXPLAINS


@pytest.mark.slow
def test_a_mass_of_a_millionth_neither_is_selected_nor_excludes():
    path = measured_data("../cases/gear_0_A.csv")
    found = select(read(path), figure_1([2, 3]))
    assert found.selected.chain == Chain(2, damped=True, dead_time=True)
    assert all(c.excluded is None for c in found.candidates if c.chain == found.selected.chain)


@pytest.mark.slow
def test_lines_that_a_structure_misses_alone_are_named_where_a_mass_could_only_fit_them():
    path = measured_data("../cases/c4_2_A.csv")
    found = select(read(path), [c for c in figure_1([3, 4]) if not c.ground_dampers])
    assert found.explanation.level is Level.NOT and not found.members
    lone = [c for c in found.candidates if c.chain.n_masses == 4 and c.rests_on]
    assert any(abs(c.rests_on.low - 14.16) < 0.1 for c in lone)


def test_a_gain_over_many_lines_is_shown_by_the_rest():
    omega = np.tile(np.arange(1.0, 41.0), 2)
    one = np.full(80, 2.0)
    assert lone_lines(one, np.zeros(80), omega, lambda kept: one[kept] @ one[kept] > 20) is None
    one[:] = 0.1
    one[[6, 7, 46]] = 9.0
    found = lone_lines(one, np.zeros(80), omega, lambda kept: one[kept] @ one[kept] > 20)
    assert (found.low, found.high) == (7 / (2 * np.pi), 8 / (2 * np.pi))


def test_two_worst_neighbours_are_left_out_of_chi2():
    omega, residual = np.tile(np.arange(1.0, 11.0), 2), np.ones(20)
    residual[[3, 4, 13, 14]] = 7.0
    assert chi2_apart(residual, np.ones(20), omega) == (1.0, 1.0)
    residual[8] = 3.0
    assert chi2_apart(residual, np.ones(20), omega) == pytest.approx(((15 + 9) / 16, (1 + 9) / 2))


def test_a_few_lines_that_are_missed_by_far_do_not_hide_in_the_mean_of_many():
    """Chi2 per line 1.7, of which nearly all are three lines at one narrow resonance."""
    n, scatter = 120, Scatter(np.full(120, 0.1), np.ones(120), "repeats", inf)
    omega, residual = np.tile(np.arange(1.0, n + 1), 2), np.full(2 * n, 0.9)
    residual[[60, 61, 62]] = 9.0  # the model is too small there by a factor of 1 / (1 - 0.9)
    power = residual**2
    apart, worst = chi2_apart(residual, np.ones(2 * n), omega)
    assert power.mean() < 2 and apart < largest_cost(scatter)
    assert level_of(power.mean(), apart, worst, scatter) is Level.NOT
    residual[62] = 0.9  # two neighbouring lines alone may be a disturbance
    apart, worst = chi2_apart(residual, np.ones(2 * n), omega)
    assert level_of(1.6, apart, worst, scatter) is Level.APART
    source = np.random.default_rng(2)
    noise = source.normal(size=(2_000, n, 2))
    most = np.max(np.mean(noise**2, axis=2), axis=1) * largest_cost(scatter)
    assert np.mean(most > largest_miss(scatter)) < 5e-3  # once in 1,000 times


def test_noise_alone_rarely_exceeds_its_limit():
    scatter, source = (
        Scatter(np.full(60, 0.01), np.ones(60), "repeats", 200.0),
        np.random.default_rng(1),
    )
    level = source.chisquare(120, 20_000) / 120 / (source.chisquare(200, 20_000) / 200)
    assert np.mean(level > noise_limit(scatter)) == pytest.approx(1e-3, abs=7e-4)
    assert 1 < noise_limit(scatter) < 2 < largest_cost(scatter) == 3.0


def branch(s):
    """Acceleration of a motor that drives two loads beside each other: no chain of three."""
    m1, loads = 1e-3, [(8e-4, 60.0, 5e-3), (5e-4, 220.0, 8e-3)]
    whole = m1 * s**2
    for m, k, d in loads:
        whole = whole + m * s**2 * (k + d * s) / (m * s**2 + d * s + k)
    return s**2 / whole


@pytest.mark.slow
def test_what_no_candidate_can_do_is_told_apart_or_not_explained():
    """Damped branches are no chain: chi2 is above what noise gives, at whatever level."""
    source, s = np.random.default_rng(2), 1j * OMEGA
    noise = source.normal(size=(2, len(OMEGA)))
    data = FrequencyResponse(OMEGA, branch(s) * (1 + 1e-4 * (noise[0] + 1j * noise[1])))
    found = select(data, [Chain(3, damped=True), Chain(2, damped=True)])
    assert found.explanation.level is not Level.EXPLAINS


@pytest.mark.full
@pytest.mark.parametrize(
    ("count", "enough"), [pytest.param(12, False, marks=pytest.mark.slow), (15, False), (16, True)]
)
def test_few_lines_judge_no_structure(count, enough):
    omega = 2 * np.pi * np.geomspace(5.0, 200.0, count)
    data = response(DRIVE, VALUES, omega, noise=1e-3, seed=1)
    assert needed_lines(len(DRIVE.parameters)) == 16
    found = select(data, [DRIVE])
    assert found.explanation.too_few is not enough
    assert found.explanation.explains is enough and bool(found.members) is enough


def test_the_response_of_the_bench_of_these_tests_is_that_of_the_matrices():
    exact = np.array([dense_response(SMALL, SMALL_VALUES, x) for x in 1j * OMEGA])
    np.testing.assert_allclose(response(SMALL, SMALL_VALUES, OMEGA).G, exact, rtol=1e-9)


@pytest.mark.full
def test_a_larger_structure_that_needs_more_lines_is_not_judged():
    """20 lines are enough for two masses, not for the three that contain them."""
    omega = 2 * np.pi * np.geomspace(5.0, 200.0, 20)
    data = response(DRIVE, VALUES, omega, noise=1e-3, seed=1)
    found = select(data, [DRIVE, SMALL])
    assert [m.candidate.chain for m in (*found.members, *found.containing)] == [DRIVE]
