"""Costs and sensitivities of the three cases: equations (6) to (15), literally."""

from dataclasses import replace

import numpy as np
import pytest

from disting.errors import InputError
from disting.fit.search.cost import (
    Case,
    Cost,
    CostOfEach,
    lines_by_coherence,
    lines_by_deviation,
)
from disting.fit.search.descent import Box, fine, rough
from disting.fit.search.plant import Plant
from disting.measurement import FrequencyResponse
from disting.model.chain import Chain
from disting.statistics.practical import condition_indices, importance
from tests.fit.drives import CHAINS, OMEGA, response, truth


def both(chain, seed):
    values = [truth(chain, s) for s in (seed, seed + 1)]
    p = np.array([values[0][n] for n in chain.parameters])
    return p, Plant(chain.structure, OMEGA), response(chain, values[1])


@pytest.mark.parametrize("case", Case)
def test_residuals_are_those_of_the_paper(case):
    p, plant, measured = both(CHAINS[1], 3)
    g, gm = plant.response(p), measured.G
    amplitude, phase = (2.0, 3.0)
    literal = {
        Case.COMPLEX: [amplitude * (g - gm).real, phase * (g - gm).imag],
        Case.AMPLITUDE: [amplitude * (abs(g) - abs(gm)), phase * np.angle(g / gm)],
        Case.LOGARITHM: [
            amplitude * (np.log10(abs(g)) - np.log10(abs(gm))),
            phase * np.angle(g / gm),
        ],
    }[case]
    cost = Cost(measured, case, (amplitude, phase))
    np.testing.assert_allclose(cost.residual(g), np.concatenate(literal), atol=1e-12)
    np.testing.assert_allclose(cost.total(g), np.sum(np.concatenate(literal) ** 2))


@pytest.mark.thin(8)
@pytest.mark.parametrize("case", Case)
@pytest.mark.parametrize("chain", CHAINS, ids=str)
def test_the_sensitivity_is_the_derivative_of_the_residual(case, chain):
    p, plant, measured = both(chain, 5)
    cost = Cost(measured, case, lines=np.linspace(0.5, 2.0, OMEGA.size))
    residual, columns = cost.of(plant, p)
    assert columns.shape == (cost.n_residuals, len(p)) and residual.shape == (cost.n_residuals,)
    for i in range(len(p)):
        factor = np.exp(1e-6 * (np.arange(len(p)) == i))
        difference = cost.residual(plant.response(p * factor)) - cost.residual(
            plant.response(p / factor)
        )
        scale = np.abs(columns).max()
        np.testing.assert_allclose(columns[:, i] / scale, difference / 2e-6 / scale, atol=2e-7)


def test_a_start_that_does_not_see_some_lines_is_fitted_to_the_others_alone():
    """As a fit of the other lines alone, by scipy, ends; starts may end one after the other."""
    chain = CHAINS[1]
    p, plant, measured = both(chain, 3)
    box = Box(np.zeros(len(p)), np.full(len(p), np.inf))
    rng = np.random.default_rng(1)
    noisy = measured.G * (1 + 0.05 * rng.standard_normal((2, OMEGA.size)).T @ [1, 1j])
    whole = Cost(replace(measured, G=noisy))
    start, _ = fine(plant, whole, box, p)
    fold = np.arange(OMEGA.size) % 3
    seen = (np.tile(fold, 2) != np.arange(3)[:, None]).astype(float)
    starts = np.tile(start, (3, 1))
    ends, costs = rough(plant, CostOfEach(whole, seen), box, starts, 100, 1e-9)
    for k, (end, cost) in enumerate(zip(ends, costs, strict=True)):
        alone = replace(whole, lines=(fold != k) * 1.0)
        assert cost == pytest.approx(float(alone.total(plant.response(end))), rel=1e-12)
        assert cost == pytest.approx(fine(plant, alone, box, start)[1], rel=1e-6)
        assert cost < float(alone.total(plant.response(start)))


def test_weights_of_the_paper_count_20_db_as_180_degrees():
    measured = FrequencyResponse(OMEGA, np.ones(OMEGA.size, complex))
    assert Cost(measured).residual(np.full(OMEGA.size, 10.0 + 0j))[0] == pytest.approx(np.pi)
    assert Cost(measured).residual(np.full(OMEGA.size, -1.0 + 0j))[-1] == pytest.approx(np.pi)


@pytest.mark.parametrize("quantity", ["position", "velocity"])
def test_case_3_does_not_see_the_sensor_quantity(quantity):
    chain = Chain(3, damped=True, ground_dampers=(2,), dead_time=True)
    p, plant, measured = both(chain, 8)
    other = Chain(3, damped=True, ground_dampers=(2,), dead_time=True, quantity=quantity)
    there = Cost(measured.to_quantity(quantity)).of(Plant(other.structure, OMEGA), p)
    here = Cost(measured).of(plant, p)
    np.testing.assert_allclose(here[0], there[0], atol=1e-12)
    np.testing.assert_allclose(importance(here[1]), importance(there[1]))
    np.testing.assert_allclose(condition_indices(here[1]), condition_indices(there[1]))


def test_the_phase_difference_never_wraps():
    """Two turns of dead time against none: a difference of unwrapped phases would grow beyond
    pi.
    """
    measured = FrequencyResponse(OMEGA, np.ones(OMEGA.size, complex))
    turned = np.exp(-1j * OMEGA * (4 * np.pi / OMEGA[-1]))
    phases = Cost(measured, weights=(0.0, 1.0)).residual(turned)[OMEGA.size :]
    assert np.abs(phases).max() <= np.pi


def test_line_weights_come_from_deviation_and_coherence():
    n = OMEGA.size
    deviation, coherence = np.full(n, 0.1), np.linspace(0.5, 0.9, n)
    measured = FrequencyResponse(OMEGA, np.linspace(1.0, 2.0, n) + 0j, deviation, coherence)
    by_deviation, by_coherence = lines_by_deviation(measured), lines_by_coherence(measured)
    np.testing.assert_allclose(by_deviation / by_deviation[0], np.linspace(1.0, 2.0, n))
    np.testing.assert_allclose((by_coherence / by_coherence[0]) ** 2, coherence / (1 - coherence))
    assert np.mean(by_deviation**2) == pytest.approx(1.0) == np.mean(by_coherence**2)
    for weigh in (lines_by_deviation, lines_by_coherence):
        with pytest.raises(InputError, match="choose other weights"):
            weigh(FrequencyResponse(OMEGA, np.ones(n) + 0j))
    with pytest.raises(InputError, match=f"{n}, not 3"):
        Cost(measured, lines=np.ones(3))
