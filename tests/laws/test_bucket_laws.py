"""All pairs at once are the pairs one by one, in any order."""

import random
from dataclasses import replace
from itertools import combinations

import pytest
from hypothesis import given, settings, strategies as st

from disting import Chain, Engine, Family, Quantity, Query, Settings, View
from disting.verdict.cascade import decide
from disting.verdict.result import ALL_CONDITIONS
from tests.laws.pairs import BY_CONDITIONS, ENGINE, family, subject
from tests.laws.strategies import chains


def assert_bucketed_as_pairwise(subjects, query, engine=ENGINE):
    found = engine.decisions(subjects, query)
    for i, j in combinations(range(len(subjects)), 2):
        one = decide(subjects[i], subjects[j], query)
        assert found.verdict(i, j) == found.verdict(j, i) == one
        assert found.relation(i, j) == found.relation(j, i) == one.relation
        assert found.rule(i, j) == one.decided_by


@pytest.mark.full
@pytest.mark.parametrize("view", View)
@pytest.mark.parametrize(("n_masses", "damped"), [(2, True), (3, False), (3, True)])
def test_buckets_decide_as_pairs_do(n_masses, damped, view):
    assert_bucketed_as_pairwise(family(n_masses, damped), Query(view))


@pytest.mark.slow
@pytest.mark.parametrize("view", View)
@pytest.mark.parametrize("damped", [False, True])
def test_buckets_decide_as_pairs_do_for_four_masses(damped, view):
    assert_bucketed_as_pairwise(family(4, damped), Query(view))


@pytest.mark.full
@pytest.mark.parametrize("view", View)
@pytest.mark.parametrize("damped", [False, True])
def test_buckets_decide_as_pairs_do_for_some_models_of_four_masses(damped, view):
    """With the pairs that conditions leave open, and a group of indistinguishable ones."""
    chosen = (1, 2, 6, 11, 13, 14, 20, 29)
    assert_bucketed_as_pairwise([family(4, damped)[i - 1] for i in chosen], Query(view))


@pytest.mark.full
@pytest.mark.parametrize("limit", [0, 36, 84])
def test_buckets_decide_as_pairs_do_where_matroids_are_too_large(limit):
    engine = Engine(Settings(subset_limit=limit))
    assert_bucketed_as_pairwise(
        [subject(chain, engine) for chain in Family(3, damped=True)], Query(), engine
    )


def queries():
    """Conditions 1 to 4 and any of the others, any view, any number of Markov parameters."""
    some = st.sets(st.sampled_from(ALL_CONDITIONS[4:])).map(
        lambda chosen: (*"1234", *sorted(chosen))
    )
    few = st.sets(st.sampled_from([c for c in ALL_CONDITIONS if c != "5"])).map(
        lambda chosen: tuple(sorted(chosen))
    )
    return st.builds(
        Query, st.sampled_from(BY_CONDITIONS), st.one_of(some, few), st.integers(0, 14)
    )


@settings(max_examples=25, deadline=None)
@given(
    query=queries(),
    damped=st.booleans(),
    chosen=st.sets(st.integers(0, 10), min_size=2, max_size=5),
)
def test_buckets_decide_as_pairs_do_for_any_query(query, damped, chosen):
    assert_bucketed_as_pairwise([family(3, damped)[i] for i in sorted(chosen)], query)


@pytest.mark.full
@settings(max_examples=15, deadline=None)
@given(st.data())
def test_buckets_decide_as_pairs_do_for_any_models_of_one_size(data):
    """Dampers, sensors and ports may differ; equally many states are asked for."""
    n, lag = data.draw(st.integers(1, 3)), data.draw(st.booleans())
    models = data.draw(st.lists(chains(n, n, dead_time=True), min_size=2, max_size=6))
    assert_bucketed_as_pairwise([subject(replace(chain, lag=lag)) for chain in models], Query())


@pytest.mark.full
@pytest.mark.parametrize("damped", [False, True])
def test_grades_are_those_of_the_verdicts(damped):
    found = ENGINE.decisions(family(3, damped), Query())
    for i, j, rule, where, certainty, safety in found.grades():
        one = decide(*(family(3, damped)[k] for k in (i, j)), Query())
        assert (rule, where, certainty, safety) == (
            one.decided_by,
            one.representation,
            one.certainty or "",
            one.safety,
        )


@pytest.mark.full
def test_the_order_of_the_models_does_not_matter():
    shuffled = list(family(3, True))
    random.Random(1).shuffle(shuffled)
    base, other = (ENGINE.decisions(subjects, Query()) for subjects in (family(3, True), shuffled))
    names = [s.name for s in family(3, True)]
    places = [[s.name for s in shuffled].index(name) for name in names]
    for i, j in combinations(range(11), 2):
        assert base.relation(i, j) == other.relation(places[i], places[j])


@pytest.mark.parametrize("sensor", Quantity)
def test_few_and_no_models(sensor):
    assert ENGINE.decisions([], Query()).counts() == {"": 0}
    assert ENGINE.decisions(
        [subject(Chain(1, quantity=sensor, damped=False))], Query()
    ).counts() == {"": 0}
