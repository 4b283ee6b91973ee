"""What contains a structure that is left, is left, and is no rival of it: by fit, plan, next and the
files that a fit writes.
"""

import json
from itertools import permutations

import numpy as np
import pytest

from disting.fit import select
from disting.fit.judge.admissible import undetermined
from disting.fit.networks import fit_networks
from disting.fit.search.candidates import variants
from disting.fit.search.containment import contains
from disting.fit.search.plant import Plant
from disting.measurement import FrequencyResponse
from disting.model.chain import Chain
from disting.network import network_of
from disting.report.fit.selection_json import selection_to_dict
from disting.report.fit.write import export, not_exported
from tests.cli.process import called
from tests.fit.drives import response

pytestmark = pytest.mark.full

LINEAR = 2 * np.pi * np.linspace(3.0, 500.0, 100)
BOTH = {"lag": True, "dead_time": True}


def geared(seed):
    """A drive with a small third mass, 3 % noise a line, lines so far apart that a resonance may
    lie between two of them.
    """
    source = np.random.default_rng(seed)
    m = np.array([6e-3, 2e-2, 1e-3]) * np.exp(0.4 * source.normal(size=3))
    k = [300.0 * np.exp(0.4 * source.normal()), 60.0 * np.exp(source.normal())]
    b = 0.4 * np.exp(0.4 * source.normal())
    p = np.array([*m, *k, 8e-3, 2e-2, b, 3e-4, 1.5e-4])
    exact = Plant(Chain(3, ground_dampers=(1,), **BOTH).structure, LINEAR, 1).response(p)
    error = source.normal(size=100) + 1j * source.normal(size=100)
    return FrequencyResponse(LINEAR, exact * (1 + 0.03 * error / np.sqrt(2)))


def assert_closed(selection):
    """Every pair of candidates, by their costs, by what they explain, by what is left."""
    fitted = {c.chain: c for c in selection.candidates}
    every = (*selection.members, *selection.containing)
    left = {m.candidate.chain for m in every}
    pairs = [(a, b) for a, b in permutations(fitted, 2) if contains(a, b)]
    assert pairs and left
    assert not [(a, b) for a, b in pairs if b in left and a not in left]
    assert not any(contains(m.candidate.chain, selection.selected.chain) for m in selection.members)
    assert all(contains(m.candidate.chain, m.contains) for m in selection.containing)
    explaining = [b for a, b in pairs if a in left and b in left]
    assert all(fitted[b].chi2 < 1.5 for b in explaining)


@pytest.mark.slow
@pytest.mark.parametrize(
    "seed", [2, *(pytest.param(k, marks=pytest.mark.slow) for k in (1, 3, 4, 5))]
)
def test_what_contains_a_structure_that_is_left_is_left(seed):
    """A fold of the larger one's cross-validation runs away here, in a resonance at one line."""
    sets = ((1,), (2,), (1, 2), (1, 3))
    every = [c for n in (2, 3) for c in variants(Chain(n)) if c.lag and c.dead_time]
    selection = select(geared(seed), [c for c in every if c.ground_dampers in sets])
    assert selection.explanation.explains
    assert_closed(selection)


@pytest.fixture(scope="module")
def rigid():
    """A drive of two masses, and larger ones that are it where springs between masses are rigid."""
    true = Chain(2, ground_dampers=(1,), dead_time=True)
    values = {"m1": 0.002, "m2": 0.005, "k12": 300.0, "d12": 0.06, "b1": 0.01, "Td": 3e-4}
    train, test = (response(true, values, noise=0.011, seed=seed) for seed in (1, 2))
    larger = [Chain(n, ground_dampers=(n - 1,), dead_time=True) for n in (3, 4)]
    return select(train, [true, *larger], test=test)


def test_a_rigid_spring_makes_no_rival(rigid):
    assert [m.name for m in rigid.members] == ["2:1+b1+delay"]
    assert [m.name for m in rigid.containing] == ["3:1+b2+delay", "4:1+b3+delay"]
    assert {m.contains for m in rigid.containing} == {rigid.selected.chain}
    costs = [m.candidate.j_train for m in (*rigid.members, *rigid.containing)]
    assert costs[2] <= costs[1] * (1 + 1e-6) and costs[1] <= costs[0] * (1 + 1e-6)
    assert_closed(rigid)


def test_plan_and_next_say_the_same_even_of_a_file_that_does_not(rigid, tmp_path):
    plain = json.loads(json.dumps(selection_to_dict(rigid)))
    for says in (True, False):
        for entry in plain["not_excluded"]:
            entry["contains"] = entry["contains"] if says else None
        path = tmp_path / "fit.json"
        path.write_text(json.dumps(plain), encoding="utf-8")
        plan, further = called("plan", path), called("next", path)
        no_rival = "not a rival: 3:1+b2+delay, 4:1+b3+delay contain 2:1+b1+delay"
        assert "the fit left no rival: there is nothing to distinguish" in plan.stdout
        assert no_rival in plan.stdout and no_rival in further.stdout
        assert further.stdout.startswith(
            f"{path} leaves 2:1+b1+delay alone: no further measurement"
        )


def test_exports_leave_out_what_the_data_do_not_determine():
    """A massless first mass behind a stiff spring does what a lag does."""
    own, other = (
        Chain(2, ground_dampers=(1,), **BOTH),
        Chain(3, ground_dampers=(2,), dead_time=True),
    )
    selection = select(geared(7), [own, other])
    assert [m.candidate.chain for m in selection.members] == [own, other]
    assert not undetermined(selection.members[0].candidate)
    assert undetermined(selection.members[1].candidate)
    assert not_exported(selection) == ("3:1+b2+delay",)
    models = export(selection, selection.test)
    assert [m.name for m in models] == ["2:1+b1+lag+delay"]
    assert models[0].undetermined == ()


@pytest.mark.parametrize("seed", [0, *(pytest.param(k, marks=pytest.mark.slow) for k in (1, 2))])
def test_networks_that_contain_one_that_is_left_are_left(seed):
    texts = (
        "R0-C1",
        "R0-p(R1,C1)",
        "p(R0,R1-C1)",
        "R0-p(R1,C1)-p(R2,C2)",
        "R0-p(R1,P1)",
        "R0-p(R1-L1,C1)",
    )
    omega = np.logspace(0, 4, 60)
    noise = 0.02 * np.random.default_rng(seed).normal(size=(60, 2)) @ [1, 1j]
    cell = FrequencyResponse(
        omega, (1 + 2 / (1 + 0.02j * omega)) * (1 + noise), quantity="position"
    )
    selection = fit_networks(cell, [network_of(text) for text in texts])
    assert selection.selected is not None
    assert [f.network.name for f in selection.left] == ["R0-p(R1,C1)"]
    left = {f.network for f in (*selection.left, *selection.containing)}
    fits = {f.network: f for f in selection.fits}
    for large, small in permutations(fits, 2):
        if contains(large, small):
            assert fits[large].cost <= fits[small].cost * (1 + 1e-6)
            assert large in left or small not in left
    assert all(f.contains == "R0-p(R1,C1)" for f in selection.containing)
    assert len(selection.containing) == 3
