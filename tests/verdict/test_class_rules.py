"""The rule that is told of a pair in classes: the same from both sides, and true of this pair;
weak answers are not used.
"""

from itertools import combinations

import pytest

from disting import Certainty, Chain, Engine, Finding, Relation
from disting.algebra.certainty import LEAST_SAFETY
from disting.catalogs.dampers import damper_family
from disting.conditions.rule import EXACT, Outcome
from disting.conditions.sufficient import condition_8, condition_9
from disting.decide.same.low_cost import QUICKLY
from disting.verdict.class_search import classes
from disting.verdict.engine import question_key

ENGINE = Engine()


@pytest.mark.full
@pytest.mark.parametrize("damped", [False, True])
def test_structural_rules_are_told_from_both_sides_and_hold(damped):
    found, told = damper_family(3, damped=damped, engine=ENGINE).found, set()
    for i, j, relation, rule in found.pairs():
        assert found.look_up(j, i) == (relation, rule)
        if rule in ("8", "9"):
            check = {"8": condition_8, "9": condition_9}[rule]
            assert (
                check(*(ENGINE.subject(str(k), found.chains[k]) for k in (i, j))).outcome
                is Outcome.HOLDS
            )
            told.add(rule)
    assert told == {"8", "9"}


@pytest.mark.full
@pytest.mark.parametrize("outcome", [Outcome.HOLDS, Outcome.FAILS])
def test_an_answer_that_may_be_wrong_too_often_is_none(outcome):
    """Over millions of pairs an error of 2^-60 is too likely to be taken over."""
    ports = ((1, 1, 2, 1, 2), (2, 1, 3, 1, 3), (2, 2, 3, 2, 3))
    chains = [Chain(3, *p, damped=True, ground_dampers=(2, 3)) for p in ports]

    def relations(safety):
        engine = Engine()
        subjects = [engine.subject(str(i), c) for i, c in enumerate(chains)]
        for i, j in combinations(range(3), 2):
            key = question_key(QUICKLY, subjects[i].view.pair(subjects[j].view), engine.settings)
            engine.answers[key] = Finding(EXACT, outcome, Certainty.BOUNDED, safety)
        return {relation for *_, relation, _ in classes(chains, engine).pairs()}

    decided = Relation.INDISTINGUISHABLE if outcome is Outcome.HOLDS else Relation.DISTINGUISHABLE
    assert relations(LEAST_SAFETY) == {decided}
    assert relations(LEAST_SAFETY - 1) == {Relation.UNDECIDED}
