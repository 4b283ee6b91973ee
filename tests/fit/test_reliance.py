"""What holds for all structures that a fit leaves: the true machine is within, twins count."""

import json
from dataclasses import replace

import numpy as np
import pytest

from disting.fit.judge.modes import oscillations, poles
from disting.fit.results.loop import Controller, margins
from disting.fit.results.reliance import (
    BETWEEN,
    FAMILY,
    WITHIN,
    Kind,
    ParameterSamples,
    Statement,
    draw_samples,
    draws,
    total_inertia,
    with_twins,
)
from disting.fit.search.plant import Plant
from disting.fit.select import select
from disting.model.chain import Chain
from disting.report.fit.selection_json import selection_to_dict
from tests.fit.drives import response
from tests.fit.monte_carlo import drive as bench_drive, measured as bench_data, truth as bench_truth

ROW = Chain(3, damped=True)
VALUES = {"m1": 1.0, "m2": 0.6, "m3": 0.4, "k12": 3e4, "k23": 2e4, "d12": 8.0, "d23": 3.0}
LAW = Controller(P=60.0, I=400.0)


@pytest.fixture(scope="module")
def left():
    train, test = (response(ROW, VALUES, noise=0.01, seed=s) for s in (1, 2))
    return select(train, [ROW, Chain(2, damped=True)], test=test, controller=LAW)


@pytest.mark.full
def test_the_true_machine_lies_within_what_is_said(left):
    said = {s.name: s for s in left.relied_on}
    p = np.array(list(VALUES.values()))
    true = {f"resonance {i}": abs(r) / (2 * np.pi) for i, r in
            enumerate(oscillations(poles(ROW.structure, p)), 1)}  # fmt: skip
    own = margins(ROW, p, LAW)
    true |= {"crossover": own.crossover, "phase margin": own.phase, "bandwidth": own.bandwidth}
    true |= {"peak of the sensitivity": own.sensitivity, "total inertia": 2.0}
    assert len(true) == 7 and own.stable and said["closed loop"].kind is Kind.STABLE
    for name, value in true.items():
        slack = 0.3 * (said[name].high - said[name].low)  # two draws of noise in forty lie outside
        assert said[name].low - slack <= value <= said[name].high + slack, name


@pytest.mark.full
def test_twins_share_what_the_sensor_shows_and_not_masses_nor_loads(left):
    twins = left.members[0].twins
    said = {s.name: s for s in left.relied_on}
    assert "3:11" in [t.name for t in twins]
    assert said["resonance 1"].total == said["resonance 1"].holds == 1 + len(twins)
    assert said["total inertia"].high > 1.5 * said["total inertia"].low
    assert said["total inertia"].note == f"{FAMILY}; {BETWEEN}" and not said["resonance 1"].note
    assert said["response at the sensor"].high < 0.5  # the uncertainty of one
    assert said["position of the load per force"].high > 1.0
    for twin in twins:
        p = np.array([twin.parameters[name] for name in twin.chain.parameters])
        fit = left.members[0].candidate
        same = margins(fit.chain, np.array(list(fit.estimate.parameters.values())), LAW)
        assert margins(twin.chain, p, LAW).phase == pytest.approx(same.phase, rel=1e-3)


@pytest.mark.full
def test_a_twin_is_drawn_along_with_its_structure(left):
    omega = left.task.cost.measured.omega
    own, *twins = with_twins(left.members, draw_samples(left.members, left.task), omega)
    assert [one.chain for one in twins] == [t.chain for t in left.members[0].twins]
    exact = Plant(own.chain.structure, omega).response(own.p)
    moved = np.abs(np.log(exact[1:] / exact[0])).max()
    for twin in twins:
        apart = np.abs(np.log(Plant(twin.chain.structure, omega).response(twin.p) / exact)).max()
        assert apart < 0.05 * moved and np.ptp(twin.p, axis=0).min() > 0


@pytest.mark.full
def test_a_twin_of_values_far_away_does_the_same_or_is_left_out(left):
    """To first order values a factor e away lead to responses that are others, and overflow."""
    omega = left.task.cost.measured.omega
    (own,) = draw_samples(left.members[:1], left.task)
    away = np.exp(np.random.default_rng(5).normal(size=(40, own.p.shape[1])))
    away[0] = 1.0
    wide = ParameterSamples(own.chain, own.p[0] * away)
    exact = Plant(own.chain.structure, omega).response(wide.p)
    most = np.abs(np.log(exact / exact[0])).max()
    _, *twins = with_twins(left.members[:1], [wide], omega)
    assert twins
    for twin in twins:
        seen = Plant(twin.chain.structure, omega).response(twin.p)
        apart = np.abs(np.log(seen[:, None] / exact)).max(axis=-1).min(axis=1)
        assert len(seen) > 10 and apart.max() < 0.1 * most


def test_what_is_known_badly_says_what_helps():
    source = np.random.default_rng(2)
    wide, narrow = (np.exp(s * source.normal(size=(200, 1))) for s in (0.5, 0.01))
    chain = Chain(1)
    (said,) = [total_inertia([ParameterSamples(chain, wide), ParameterSamples(chain, narrow)], "")]
    assert said.note == WITHIN
    assert total_inertia(
        [ParameterSamples(chain, narrow), ParameterSamples(chain, 3 * narrow)], FAMILY
    ).note == (f"{FAMILY}; {BETWEEN}")
    assert total_inertia([ParameterSamples(chain, narrow)], "").note == ""


def test_zero_has_no_sign():
    assert (
        Statement(Kind.RANGE, "damping", 0.0, -0.0, "", 1, 1).text == "damping: 0, in every"
        " structure"
    )


@pytest.mark.full
def test_draws_scatter_as_the_standard_errors_say(left):
    fit = left.members[0].candidate
    drawn = draws(fit, left.task, 4000)
    errors = np.log(drawn).std(axis=0)
    known = [fit.practical.relative_errors[name] for name in fit.chain.parameters]
    assert errors == pytest.approx(known, rel=0.1)
    assert drawn[0] == pytest.approx(list(fit.estimate.parameters.values()))


@pytest.mark.full
def test_a_file_of_the_fit_holds_the_statements(left):
    plain = json.loads(json.dumps(selection_to_dict(left), allow_nan=False))
    assert [s["text"] for s in plain["relied_on"]] == [s.text for s in left.relied_on]
    ends = {s["name"]: s["high"] for s in plain["relied_on"]}
    assert (
        ends["gain margin"] is None
    )  # collocated velocity without dead time: as much as one likes


@pytest.mark.slow
def test_draws_fit_the_data_where_a_parameter_is_not_determined():
    """Along a valley that bends the covariance leads away from the data, by a hundred times J."""
    machine = bench_drive(3, 9)
    larger = replace(bench_truth(machine), n_masses=4)
    found = select(bench_data(machine, 1), [larger])
    (candidate,) = found.candidates
    drawn_all = draws(candidate, found.task)
    plant = found.task.plant(larger)
    j = found.task.cost.total(plant.response(drawn_all))
    assert len(drawn_all) > 50 and np.all(j <= 1.2 * candidate.estimate.j)
    assert np.ptp(np.log(drawn_all), axis=0).max() > 0.5
