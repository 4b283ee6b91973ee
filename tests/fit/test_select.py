"""Selection: what is planted is selected, excluded candidates say why, indistinguishable ones
are fitted once and named.
"""

import json
from dataclasses import replace

import numpy as np
import pytest
from threadpoolctl import threadpool_info, threadpool_limits

from disting.errors import InputError
from disting.export import model_from_dict, predict
from disting.fit.judge.admissible import Rule
from disting.fit.judge.modes import oscillations, physical, poles, zeros
from disting.fit.results.selection import CRITERIA, profile, sweep
from disting.fit.search.candidates import figure_1, variants
from disting.fit.search.containment import contains
from disting.fit.search.cost import lines_by_deviation
from disting.fit.select import select
from disting.model.chain import Chain
from disting.report.fit.selection_json import selection_to_dict
from disting.statistics.practical import Thresholds
from disting.store.scheduling import executor
from disting.verdict.result import Relation
from tests.fit.drives import OMEGA, bench, response

PLANTED = Chain(2, damped=True, ground_dampers=(2,), dead_time=True)
VALUES = {"m1": 1.0, "m2": 0.6, "k12": 3e4, "d12": 8.0, "b2": 20.0, "Td": 4e-4}


def planted(seed):
    return response(PLANTED, VALUES, noise=0.01, seed=seed)


@pytest.fixture(scope="module")
def selection():
    return select(planted(1), figure_1((1, 2)), test=planted(2))


@pytest.mark.parametrize("word", [{"controller": "P=2,loop=round"}, {"rule": "none"}])
def test_a_word_that_cannot_be_is_refused_before_anything_is_fitted(word):
    told = []
    with pytest.raises(InputError, match=r"loop|rule"):
        select(planted(1), figure_1((1,)), progress=lambda *what: told.append(what), **word)
    assert told == []


@pytest.mark.full
def test_what_only_rounding_makes_cheaper_does_not_come_first(selection):
    small, large = sorted(selection.candidates[:2], key=lambda c: c.n_parameters)
    assert small.n_parameters < large.n_parameters
    same = [replace(large, j_test=small.j_test * (1 + step)) for step in (-3e-8, 3e-8)]
    assert all(sorted([c, small], key=lambda c: c.order) == [small, c] for c in same)
    better = replace(large, j_test=small.j_test * 0.999)
    assert sorted([small, better], key=lambda c: c.order) == [better, small]


@pytest.mark.full
def test_the_planted_structure_is_selected(selection):
    found = selection.selected
    assert (
        found.chain == PLANTED and found.n_parameters == 6 and selection.validation == "test data"
    )
    for name, value in VALUES.items():
        assert abs(found.estimate.parameters[name] - value) < 4 * found.standard_errors[name]
    assert found.standard_errors["m1"] < 0.01


@pytest.mark.full
def test_every_excluded_candidate_has_a_reason_and_kept_ones_share_the_weight(selection):
    assert len(selection.candidates) == 24
    assert all(c.admissible or (c.reasons and c.akaike_weight == 0) for c in selection.candidates)
    assert sum(c.akaike_weight for c in selection.candidates) == pytest.approx(1.0)
    costs = [c.order for c in selection.candidates]
    assert costs == sorted(costs)


@pytest.mark.full
def test_the_simplest_of_what_is_not_excluded_is_selected(selection):
    left = [m.candidate for m in selection.members]
    assert left[0] == selection.selected
    sizes = [(c.n_parameters, c.order) for c in left]
    assert sizes == sorted(sizes)
    names = [m.candidate.chain for m in selection.members]
    assert all(m.contains in names for m in selection.containing)
    assert all(contains(m.candidate.chain, m.contains) for m in selection.containing)
    assert not any(contains(m.candidate.chain, PLANTED) for m in selection.members)
    left += [m.candidate for m in selection.containing]
    out = [c for c in selection.candidates if c.excluded is not None]
    assert all(c.excluded.statistic > c.excluded.limit > 6.6 for c in out)
    assert not {c.chain for c in out} & {c.chain for c in left}


@pytest.mark.full
def test_the_json_reads_back_bit_equal(selection):
    plain = json.loads(json.dumps(selection_to_dict(selection)))
    assert model_from_dict(plain["selected"]) == (PLANTED, selection.selected.estimate.parameters)
    contract = {
        "n_masses",
        "ground_dampers",
        "lag",
        "delay",
        "n_parameters",
        "parameters",
        "standard_errors",
        "j_train",
    }
    contract |= {"j_test", "pii_ratio", "collinearity", "condition_index"}
    assert contract <= set(plain["selected"]) and contract | {"admissible", "reasons"} <= set(
        plain["candidates"][0]
    )
    assert plain["alternatives"] == []
    with pytest.raises(InputError, match="not a fitted model"):
        model_from_dict({"n_masses": 2})


@pytest.mark.slow
def test_the_same_seed_gives_the_same_bytes(selection):
    """All of it for fewer candidates; of the candidates of `selection`, what each fit found, in
    another company, which weighs the lines a little differently.
    """
    few = [c for c in figure_1((1, 2)) if not c.lag and len(c.ground_dampers) < 2]
    once, again = (select(planted(1), few, test=planted(2)) for _ in range(2))
    assert json.dumps(selection_to_dict(once)) == json.dumps(selection_to_dict(again))
    found = {c.chain: c.estimate.parameters for c in selection.candidates}
    assert once.selected.chain == PLANTED and once.selected.estimate.parameters == pytest.approx(
        found[PLANTED], rel=0.02
    )


@pytest.mark.full
def test_workers_give_the_same_selection_and_each_step_tells_how_far_it_is():
    """Without test data candidates are fitted to every fold, in the workers too."""
    few = [c for c in figure_1((1,)) if not c.lag]
    steps = []
    alone = select(planted(1), few, progress=lambda *step: steps.append(step))
    with executor(2, "") as pool:
        together = select(planted(1), few, executor=pool)
    assert json.dumps(selection_to_dict(alone)) == json.dumps(selection_to_dict(together))
    count = len(alone.candidates)
    assert [s[1:] for s in steps if s[0] == "cross-validation"] == [
        (done, count) for done in range(1, count + 1)
    ]


@pytest.mark.full
def test_physical_results_carry_their_errors(selection):
    results = {r.name: r for r in physical(selection.selected, selection.task)}
    assert results["total inertia"].value == pytest.approx(
        1.6, abs=4 * results["total inertia"].standard_error
    )
    antiresonance, resonance = results["antiresonance 1"], results["resonance 1"]
    exact = [
        oscillations(r(PLANTED.structure, np.array(list(VALUES.values()))))[0]
        for r in (zeros, poles)
    ]
    for found, root in zip((antiresonance, resonance), exact, strict=True):
        assert abs(found.value - abs(root) / 2 / np.pi) < 4 * found.standard_error < 0.2
    assert (
        results["dead time"].standard_error < 1e-5 and results["stiffness k12"].standard_error > 0
    )


@pytest.mark.full
def test_sweeps_count_what_each_criterion_allows(selection):
    for criterion in CRITERIA:
        found = sweep(selection.candidates, criterion)
        assert list(found.fulfilling) == sorted(found.fulfilling) and found.thresholds[
            [0, -1]
        ] == pytest.approx([1, 1e4])
        values = [getattr(c.practical, criterion) for c in selection.candidates]
        assert found.fulfilling[-1] == sum(v <= 1e4 for v in values)
    with pytest.raises(InputError, match="the criteria are"):
        sweep(selection.candidates, "beauty")


@pytest.mark.full
def test_a_profile_rises_on_both_sides(selection):
    found = profile(selection.selected, selection.task, "k12")
    middle = len(found.values) // 2
    assert found.values[middle] == pytest.approx(selection.selected.estimate.parameters["k12"])
    assert np.all(np.diff(found.costs[middle:]) > 0) and np.all(
        np.diff(found.costs[: middle + 1]) < 0
    )
    # Three standard errors raise J by about 9 times the mean square of the residuals, as in a
    # linear problem.
    expected = 9 * selection.selected.j_train / (2 * OMEGA.size - 6)
    assert found.costs[-1] - found.costs[middle] == pytest.approx(expected, rel=0.5)
    with pytest.raises(InputError, match="m9 is not a fitted parameter"):
        profile(selection.selected, selection.task, "m9")


@pytest.mark.full
def test_of_more_lines_so_many_are_fitted_and_the_reading_says_so():
    found = select(planted(1), [Chain(1, damped=True)], test=planted(2), lines=40)
    for data in (found.task.cost.measured, found.test):
        assert len(data) == 40 and "40 of 120 lines, evenly spaced" in data.reading
    assert selection_to_dict(found)["frequencies"]["lines"] == 40


@pytest.mark.full
def test_libraries_of_linear_algebra_get_one_thread_and_then_their_own_again():
    seen = []

    def weights(data):
        seen.extend(library["num_threads"] for library in threadpool_info())
        return np.ones(len(data))

    with threadpool_limits(2):
        select(planted(1), [Chain(1, damped=True)], weights=weights)
        after = {library["num_threads"] for library in threadpool_info()}
    assert seen and set(seen) == {1} and after == {2}


@pytest.mark.full
def test_without_test_data_lines_are_left_out_in_turn():
    found = select(planted(1), [c for c in figure_1((2,)) if not c.lag])
    assert "cross-validation" in found.validation and found.selected.chain.n_masses == 2
    assert all(c.j_test > c.j_train for c in found.candidates if c.admissible)


@pytest.mark.full
def test_nothing_is_selected_where_no_candidate_is_admissible():
    found = select(
        planted(1),
        figure_1((1,)),
        test=planted(2),
        thresholds=Thresholds(0.5, 0.5, 0.5),
        rule=Rule.PAPER,
    )
    assert (
        found.selected is None
        and found.alternatives == ()
        and selection_to_dict(found)["selected"] is None
    )


@pytest.mark.full
def test_indistinguishable_candidates_are_fitted_once_and_named():
    """Force and sensor at the two ends: reciprocity mirrors the chain, so a ground damper may
    sit at either end.
    """
    ends = Chain(2, meas_plus=2, damped=True)
    candidates = [c for c in variants(ends) if not c.lag and not c.dead_time]
    measured = response(
        Chain(2, meas_plus=2, damped=True, ground_dampers=(1,)), VALUES | {"b1": 20.0}, noise=0.01
    )
    wide = Thresholds(100.0, 1000.0, 50.0)
    pruned, whole = (
        select(measured, candidates, test=measured, thresholds=wide, prune=prune)
        for prune in (True, False)
    )
    first, second, third = (
        Chain(2, meas_plus=2, damped=True, ground_dampers=at) for at in ((1,), (2,), (1, 2))
    )
    assert (
        pruned.saved == 1
        and pruned.same_as[second] == first
        and third not in pruned.same_as
        and whole.saved == 0
    )
    costs = {c.chain: c.j_train for c in whole.candidates}
    assert (
        costs[first]
        == pytest.approx(costs[second], rel=1e-6)
        == pytest.approx(costs[third], rel=1e-6)
    )
    assert pruned.selected.chain == first
    said = [(a.chain, a.relation) for a in pruned.alternatives]
    assert said == [(second, Relation.INDISTINGUISHABLE), (third, Relation.UNDECIDED)]


@pytest.mark.full
def test_what_no_data_determine_is_said_by_its_combinations_and_never_selected():
    chain = Chain(2, meas_plus=2, damped=True)
    values = {"m1": 1.0, "m2": 0.6, "k12": 3e4, "d12": 8.0}
    loose = Thresholds(1e300, 1e300, 1e300)
    data = response(chain, values, noise=0.01, seed=1)  # fitted masses that are not equal
    found = select(data, [chain, replace(chain, ground_dampers=(1,))], test=data, thresholds=loose)
    (plain,) = (c for c in found.candidates if c.chain == chain)
    said = "not identifiable: no data determine more than k12/d12, m1 + m2, k12/(m1*m2)"
    assert (
        plain.reasons == (said,)
        and plain.practical.unidentifiable == said
        and plain.practical.rank == 3
    )
    assert found.selected is None or found.selected.chain != chain
    rows = json.loads(json.dumps(selection_to_dict(found), allow_nan=False))["candidates"]
    row = next(r for r in rows if not r["ground_dampers"])
    assert (row["unidentifiable"], row["condition_index"], row["collinearity"]) == (
        said,
        None,
        None,
    )
    errors = {r.name: r.standard_error / r.value for r in physical(plain, found.task)}
    assert (
        errors["total inertia"] < 0.01
        and errors["stiffness k12"] == np.inf
        and errors["resonance 1"] < 0.01
    )


def test_known_parameters_make_it_identifiable():
    chain = Chain(2, meas_plus=2, damped=True)
    values = {"m1": 1.0, "m2": 0.6, "k12": 3e4, "d12": 8.0}
    (found,) = select(response(chain, values, noise=0.01), [chain], fix={"m1": 1.0}).candidates
    assert found.admissible and found.practical.unidentifiable == "" and found.practical.rank == 3


@pytest.mark.full
def test_a_reversed_sensor_is_found():
    reversed_sensor = response(PLANTED, VALUES, noise=0.01, sign=-1)
    assert select(reversed_sensor, [PLANTED], sign=0).task.sign == -1
    assert select(planted(1), [PLANTED], sign=0).task.sign == 1


def test_input_that_does_not_fit_together_is_refused():
    with pytest.raises(InputError, match="at least one candidate"):
        select(planted(1), [])
    with pytest.raises(InputError, match="the data shows acceleration, a candidate velocity"):
        select(planted(1), [Chain(1, quantity="velocity", damped=False)])
    with pytest.raises(InputError, match="training shows acceleration, test velocity"):
        select(planted(1), [Chain(1, damped=False)], test=planted(2).to_quantity("velocity"))
    with pytest.raises(InputError, match="choose other weights"):
        select(planted(1), [Chain(1, damped=False)], weights=lines_by_deviation)


@pytest.mark.full
def test_the_bench_is_a_two_mass_drive_and_predicts_the_load_that_it_never_saw():
    train, test = bench("A"), bench("B")
    found = select(train, [c for c in figure_1((1, 2)) if not c.lag], test=test)
    chosen = found.selected
    assert chosen.chain.n_masses == 2
    # friction distorts what is measured at resonance: no noise of a bench describes these jumps
    assert found.explanation.explains
    assert found.explanation.scatter.source == "the difference of training and test data"
    results = {r.name: r for r in physical(chosen, found.task)}
    assert (
        52.0 < results["antiresonance 1"].value < 56.0
        and 75.0 < results["resonance 1"].value < 79.0
    )
    load = bench("A", "load")
    chain = Chain(
        2,
        meas_plus=2,
        damped=True,
        ground_dampers=chosen.chain.ground_dampers,
        dead_time=chosen.chain.dead_time,
    )
    seen = predict(chain, chosen.estimate.parameters, load.omega)
    band = load.omega < 2 * np.pi * 150
    assert np.median(np.abs(np.log(np.abs(seen / load.G))[band])) < 0.1
