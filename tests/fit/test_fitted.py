"""The confidence band of a fitted response against finite differences, repeated experiments and
known shares of a fit.
"""

from dataclasses import replace
from math import isnan

import numpy as np
import pytest

from disting.fit import confidence, fit_percent, select
from disting.fit.judge.candidate import judge, observed_scatters
from disting.fit.judge.members import QUANTILE
from disting.fit.results.selection import response_of
from disting.fit.search.cost import Cost
from disting.fit.search.descent import fine
from disting.fit.search.estimate import Estimate, Task
from disting.measurement import FrequencyResponse
from disting.model.chain import Chain
from disting.model.question import Settings
from disting.statistics.practical import covariance
from tests.fit.drives import response

DRIVE = Chain(2, damped=True, ground_dampers=(2,), quantity="acceleration")
VALUES = {"m1": 0.01, "m2": 0.02, "k12": 900.0, "d12": 0.12, "b2": 0.2}
OMEGA = 2 * np.pi * np.geomspace(5.0, 200.0, 60)
BETWEEN = 2 * np.pi * np.geomspace(4.0, 250.0, 37)
NOISE = 0.03
EXPERIMENTS = 30


@pytest.fixture(scope="module")
def found():
    return select(response(DRIVE, VALUES, OMEGA, NOISE, seed=4), [DRIVE])


@pytest.mark.full
def test_standard_errors_are_those_of_the_chain_rule_by_differences(found):
    candidate, task = found.described, found.task
    p = np.array([candidate.estimate.parameters[n] for n in DRIVE.parameters])
    step, plant = 1e-6, replace(task.plant(DRIVE), omega=BETWEEN)
    ends = [
        [np.log(plant.response(p * np.exp(sign * step * row))) for sign in (1, -1)]
        for row in np.eye(len(p))
    ]
    slopes = np.array([(high - low) / (2 * step) for high, low in ends]).T
    spread = covariance(task.cost.of(task.plant(DRIVE), p)[1], candidate.noise)
    sure = confidence(candidate, task, BETWEEN)
    for part, seen in ((slopes.real, sure.amplitude), (slopes.imag, sure.phase)):
        np.testing.assert_allclose(
            seen, np.sqrt(np.einsum("ij,jk,ik->i", part, spread, part)), rtol=1e-5
        )


@pytest.mark.full
def test_nineteen_of_twenty_bands_hold_the_true_response():
    """Repeated experiments on the true structure, each fitted and judged as a selection does:
    95 % in the mean.
    """
    exact, inside = response(DRIVE, VALUES, BETWEEN).G, []
    for seed in range(EXPERIMENTS):
        data = response(DRIVE, VALUES, OMEGA, NOISE, seed=1000 + seed)
        task = Task(Cost(replace(data, deviation=NOISE * np.abs(data.G))), 1, {}, {}, "x")
        p, j = fine(
            task.plant(DRIVE),
            task.cost,
            task.box(DRIVE.parameters),
            np.array(list(VALUES.values())),
        )
        fits = [Estimate(DRIVE, dict(zip(VALUES, p, strict=True)), j)]
        known = observed_scatters(fits, task, task.cost)
        (candidate,) = judge(fits, task, task.cost, known, Settings())
        sure, ratio = (
            confidence(candidate, task, BETWEEN),
            response_of(candidate, task, BETWEEN) / exact,
        )
        inside += [
            np.abs(np.log(np.abs(ratio))) < QUANTILE * sure.amplitude,
            np.abs(np.angle(ratio)) < QUANTILE * sure.phase,
        ]
    assert 0.92 < np.mean(inside) < 0.98


@pytest.mark.full
def test_the_response_is_sure_where_the_parameters_are_not():
    """Two masses with the sensor on the second one: no data determine all parameters, any the
    response.
    """
    chain = Chain(2, meas_plus=2, damped=True, quantity="acceleration")
    found = select(response(chain, {n: VALUES[n] for n in chain.parameters}, OMEGA, NOISE), [chain])
    sure = confidence(found.described, found.task, OMEGA)
    assert found.described.practical.unidentifiable
    assert (
        np.all(sure.amplitude < NOISE) and np.all(sure.phase < NOISE) and np.all(sure.amplitude > 0)
    )


@pytest.mark.full
def test_given_parameters_have_no_band():
    found = select(response(DRIVE, VALUES, OMEGA, NOISE), [DRIVE], fix=VALUES)
    assert not confidence(found.described, found.task, OMEGA).amplitude.any()


def test_fit_percent_of_a_constant_model():
    """1/m = 2: 0 for data of mean 2; 1 - sqrt(2) for 2 and 3 in turn, of mean 2.5; nothing for
    constant data.
    """
    flat = FrequencyResponse(OMEGA, np.full(60, 2.0 + 0j), quantity="acceleration")
    found = select(flat, [Chain(1, quantity="acceleration", damped=False)], fix={"m1": 0.5})
    first = np.arange(60) % 2 == 0
    values = [np.where(first, 1.0, 3.0), np.where(first, 2.0, 3.0), np.full(60, 2.0)]
    none, worse, constant = (
        fit_percent(found.described, found.task, replace(flat, G=g + 0j)) for g in values
    )
    assert (
        none == pytest.approx(0.0, abs=1e-9)
        and worse == pytest.approx(100 * (1 - np.sqrt(2)))
        and isnan(constant)
    )
    met = select(response(DRIVE, VALUES, OMEGA), [DRIVE], fix=VALUES)
    assert fit_percent(met.described, met.task, met.test) == pytest.approx(100.0)


@pytest.mark.full
def test_fit_percent_is_near_what_the_noise_leaves(found):
    """|G - G_m| is the noise of the lines, 3 % of |G| each."""
    data = found.task.cost.measured
    left = NOISE * np.linalg.norm(data.G) / np.linalg.norm(data.G - data.G.mean())
    assert fit_percent(found.described, found.task, data) == pytest.approx(
        100 * (1 - left), abs=0.5 * 100 * left
    )
