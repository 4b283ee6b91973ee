"""The set of structures that data do not exclude: names that commands read, twins from the
whole catalogue, the rules.
"""

import json
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from disting.export import predict
from disting.fit.judge.admissible import Rule, undetermined_sentence
from disting.fit.judge.alternatives import limits_of
from disting.fit.judge.candidate import observed_scatters
from disting.fit.judge.members import members, twins
from disting.fit.search.candidates import listed_form, reference
from disting.fit.select import select
from disting.model.chain import Chain
from disting.model.family import Family
from disting.model.names import chain_of
from disting.model.symmetry import forms
from disting.report.fit.links import commands, new_names
from disting.report.fit.selection_json import selection_to_dict
from disting.report.fit.sentences import first_lines
from disting.statistics.practical import Thresholds
from tests.fit.drives import OMEGA, response

ROW = Chain(3, damped=True)
VALUES = {"m1": 1.0, "m2": 0.6, "m3": 0.4, "k12": 3e4, "k23": 2e4, "d12": 8.0, "d23": 3.0}


@given(st.integers(1, 4), st.data())
@settings(max_examples=30)
def test_the_command_line_reads_the_names_that_a_fit_writes(n, data):
    family = Family(n, damped=True)
    chain = replace(
        family[data.draw(st.integers(1, len(family)))],
        ground_dampers=tuple(data.draw(st.sets(st.integers(1, n)))),
        lag=data.draw(st.booleans()),
        dead_time=data.draw(st.booleans()),
    )
    assert listed_form(chain).chain == chain
    for form in forms(chain):  # masses counted from the other end, force and sensor exchanged
        assert chain_of(reference(form.chain), Family(1, damped=True)) in {
            other.chain for other in forms(chain)
        }


MIRRORED = Chain(2, 0, 0, 2, 0, 2, damped=True, ground_dampers=(1,))


@pytest.mark.full
def test_a_machine_counted_from_the_other_end_is_named_after_the_one_that_is_listed():
    values = {"m1": 1.0, "m2": 0.6, "k12": 3e4, "d12": 8.0, "b1": 3.0}
    there = {"m1": 0.6, "m2": 1.0, "k12": 3e4, "d12": 8.0, "b2": 3.0}
    assert twins(MIRRORED, values, limits_of({}, {"m2": 0.6})) == twins(
        listed_form(MIRRORED).chain, there, limits_of({}, {"m1": 0.6})
    )
    train, test = (response(MIRRORED, values, noise=0.005, seed=s) for s in (1, 2))
    found = select(train, [MIRRORED], test=test)
    plain = selection_to_dict(found)
    assert "; 2:1+b2 explains" in first_lines(found)[1] and plain["selected"]["name"] == "2:1+b2"
    assert plain["selected"]["renamed"]["b1"] == "b2" and "m1 is m2 there" in new_names(found)
    command = commands(found)[-1].split()
    given = dict(pair.split("=") for pair in command[-1].split(","))
    assert command[2] == "2:1+b2" and float(given["b2"]) == pytest.approx(
        found.described.estimate.parameters["b1"], rel=1e-5
    )


@pytest.mark.full
def test_twins_come_from_the_whole_catalogue_and_behave_the_same():
    late = replace(ROW, dead_time=True)
    values = VALUES | {"Td": 1e-3}
    found, _ = twins(late, values, {})
    assert found[0].name == "3:11+delay"
    for twin in found:
        same = predict(twin.chain, twin.parameters, OMEGA) / predict(late, values, OMEGA)
        assert np.abs(same - 1).max() < 1e-9


@pytest.mark.full
def test_twins_keep_the_limits():
    found, _ = twins(ROW, VALUES, limits_of({}, {"m1": 1.0}))
    assert all(t.parameters["m1"] == pytest.approx(1.0) for t in found)


@pytest.fixture(scope="module")
def selection():
    train, test = (response(ROW, VALUES, noise=0.005, seed=s) for s in (1, 2))
    return select(train, [Chain(2, damped=True), ROW, replace(ROW, dead_time=True)], test=test)


@pytest.mark.slow
def test_each_member_has_its_own_twins_in_whatever_order_workers_finish(selection):
    """The first one takes longest, so its twins come last."""
    chosen = sorted(selection.candidates, key=lambda c: -c.chain.n_masses)
    known = observed_scatters([c.estimate for c in chosen], selection.task, None)
    with ThreadPoolExecutor(len(chosen)) as pool:
        among, alone = (
            members(chosen, selection.task, None, known, {}, executor) for executor in (pool, None)
        )
    assert among == alone and {t.chain.n_masses for t in among[0].twins} == {3}


@pytest.mark.full
def test_the_selected_one_comes_first_with_what_behaves_the_same(selection):
    plain = json.loads(json.dumps(selection_to_dict(selection), allow_nan=False))
    first = plain["not_excluded"][0]
    assert plain["explained"] is True and first["name"] == plain["selected"]["name"] == "3:1"
    assert first["equivalents"][0]["name"] == "3:11" and set(
        first["equivalents"][0]["parameters"]
    ) >= {"k01", "m3"}
    assert all(low < VALUES[n] < high for n, (low, high) in first["intervals"].items())
    assert "2:1" not in [m["name"] for m in plain["not_excluded"]]


@pytest.mark.full
def test_the_third_line_says_that_the_machine_may_as_well_be_another(selection):
    third = first_lines(selection)[2]
    assert "3:1 and 3:11" in third and "give identical responses here" in third
    assert commands(selection)[-1].startswith(
        'disting equivalents 3:1 --damped --to "3+b*" --set m1='
    )


@pytest.mark.full
def test_a_well_determined_model_is_never_hidden_but_by_the_rule_of_the_paper(selection):
    """Its condition index exceeds any threshold that is low enough, however little noise there
    is.
    """
    strict = Thresholds(1.5, 1.5, 1.01)
    train = response(ROW, VALUES, noise=1e-4, seed=1)
    weighed, paper = (select(train, [ROW], thresholds=strict, rule=rule) for rule in Rule)
    assert (
        weighed.selected.chain == ROW
        and undetermined_sentence(weighed.selected, weighed.task) == ""
    )
    assert paper.selected is None and "condition index" in paper.candidates[0].reasons[0]
    assert paper.candidates[0].estimate == weighed.selected.estimate


@pytest.mark.full
def test_what_is_known_badly_stays_excluded_and_says_so():
    train = response(ROW, VALUES, noise=0.3, seed=1)
    (candidate,) = select(train, [ROW], thresholds=Thresholds(1.5, 1.5, 1.01)).candidates
    assert not candidate.admissible and "known to ±" in candidate.reasons[-1]
