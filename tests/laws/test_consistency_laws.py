"""No condition contradicts another one, and indistinguishability is transitive."""

from dataclasses import replace
from itertools import combinations, permutations

import pytest
from hypothesis import given

from disting import ContradictionError, Family, Query, Relation, View
from disting.conditions.chain_view import ChainView
from disting.conditions.side import Side
from disting.verdict.cascade import audit, decide
from tests.laws.pairs import (
    ENGINE,
    PAPER,
    SMALL,
    any_pair,
    audited,
    family,
    often,
    subject,
    with_examples,
)


@pytest.mark.sampled(6)
@pytest.mark.full
@pytest.mark.parametrize("view", [View.COMBINED, View.EXACT])
@pytest.mark.parametrize(("n_masses", "damped"), SMALL)
def test_no_condition_contradicts_another(n_masses, damped, view):
    """Of four masses a third of the models here, the others by hand."""
    audited(family(n_masses, damped)[:: 3 if n_masses == 4 else 1], Query(view))


@pytest.mark.slow
@pytest.mark.parametrize("damped", [False, True])
def test_no_condition_contradicts_another_for_all_models_of_four_and_five_masses(damped):
    audited(family(4, damped), Query(View.EXACT))
    audited(family(5, damped), PAPER)


@pytest.mark.full
@often
@with_examples
@given(pair=any_pair)
def test_no_condition_contradicts_another_for_any_pair(pair):
    audited([subject(chain) for chain in pair], PAPER)


@pytest.mark.parametrize("reverse", [False, True])
def test_a_contradiction_is_an_error(reverse):
    """One model with two profiles: condition 4 tells it from itself, condition 6 does not."""
    chain = Family(3, damped=True)[1]
    false = Side(
        "false", ChainView(chain), source=lambda *what: replace(ENGINE.profile(*what), rank=6)
    )
    pair = (false, subject(chain)) if reverse else (subject(chain), false)
    assert decide(*pair, PAPER).decided_by == "4"
    assert decide(*pair, Query(View.COMBINED, conditions=(6, 7))).decided_by == "6"
    with pytest.raises(ContradictionError, match="indistinguishable by condition 6"):
        audit(*pair, PAPER)


def assert_transitive(relations, n):
    """No triangle has two equalities and one difference."""
    same, apart = Relation.INDISTINGUISHABLE, Relation.DISTINGUISHABLE
    for a, b, c in permutations(range(n), 3):
        if a < c and relations(a, b) is same and relations(b, c) is same:
            assert relations(a, c) is not apart


@pytest.mark.sampled(10)
@pytest.mark.full
@pytest.mark.parametrize("view", View)
@pytest.mark.parametrize(("n_masses", "damped"), [(3, False), (3, True), (4, False), (4, True)])
def test_indistinguishability_is_transitive(n_masses, damped, view):
    assert_transitive(
        ENGINE.decisions(family(n_masses, damped), Query(view)).relation,
        len(family(n_masses, damped)),
    )


@pytest.mark.full
@pytest.mark.sampled(2)
@pytest.mark.parametrize("model", range(1, 12))
def test_indistinguishability_is_transitive_among_ground_dampers(model):
    chain = Family(3, damped=True)[model]
    sets = [masses for size in range(4) for masses in combinations((1, 2, 3), size)]
    subjects = [subject(replace(chain, ground_dampers=masses)) for masses in sets]
    assert_transitive(ENGINE.decisions(subjects, PAPER).relation, len(subjects))
