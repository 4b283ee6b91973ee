"""More conditions, more Markov parameters, other seeds and points never turn a relation round."""

import numpy as np
import pytest
from hypothesis import given

from disting import Engine, Family, Query, Relation, Settings, View
from disting.verdict.result import ALL_CONDITIONS
from tests.laws.pairs import (
    BY_CONDITIONS,
    ENGINE,
    SMALL,
    any_pair,
    family,
    quick,
    subject,
    verdict,
    with_examples,
)


@pytest.mark.full
@quick
@with_examples
@given(pair=any_pair)
def test_more_markov_parameters_never_turn_a_relation_round(pair):
    relations = [
        verdict(*pair, Query(View.MARKOV, markov=count)).relation
        for count in (1, 2, 3, 4, 6, 8, 11, 12, 16)
    ]
    decided = [r for r in relations if r is not Relation.UNDECIDED]
    assert len(set(decided)) <= 1
    first = relations.index(decided[0]) if decided else len(relations)
    assert Relation.UNDECIDED not in relations[first:]


@pytest.mark.full
@quick
@with_examples
@given(pair=any_pair)
def test_more_conditions_and_views_never_turn_a_relation_round(pair):
    whole = verdict(*pair).relation
    for query in [Query(view) for view in BY_CONDITIONS] + [
        Query(View.COMBINED, conditions=(c,)) for c in ALL_CONDITIONS
    ]:
        assert verdict(*pair, query).relation in (whole, Relation.UNDECIDED)


def assert_equal_decisions(n_masses, damped, seeds):
    base = ENGINE.decisions(family(n_masses, damped), Query())
    for seed in seeds:
        engine = Engine(Settings(seed=seed))
        other = engine.decisions([subject(c, engine) for c in Family(n_masses, damped)], Query())
        assert np.array_equal(base.decided_by, other.decided_by)
        assert np.array_equal(base.representation, other.representation)


@pytest.mark.full
@pytest.mark.parametrize("damped", [False, True])
def test_verdicts_do_not_depend_on_the_seed(damped):
    assert_equal_decisions(3, damped, ["one", "two"])


@pytest.mark.slow
@pytest.mark.parametrize(("n_masses", "damped"), [*SMALL, (5, False), (5, True)])
def test_verdicts_do_not_depend_on_any_of_twenty_seeds(n_masses, damped):
    assert_equal_decisions(n_masses, damped, [f"seed {i}" for i in range(20)])


@pytest.mark.full
@pytest.mark.parametrize("points", [1, 2, 6])
def test_verdicts_do_not_depend_on_the_number_of_points(points):
    engine = Engine(Settings(points=points))
    other = engine.decisions([subject(c, engine) for c in Family(3, damped=True)], Query())
    assert np.array_equal(ENGINE.decisions(family(3, True), Query()).decided_by, other.decided_by)
