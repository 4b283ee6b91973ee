"""Equal closures are as sure as the ranks that say so: what is seen at points is a lower bound,
and two of them may differ.
"""

from fractions import Fraction

import pytest

from disting import Chain, Engine, Family, Outcome, Query, View, compare
from disting.algebra.certainty import LEAST_SAFETY, USELESS, Certainty, joint_safety
from disting.behaviour.profile import profile
from disting.behaviour.sample import Representation
from disting.conditions.rule import EXACT, Finding
from disting.decide import asking
from disting.decide.asking import resting_on_ranks
from disting.decide.same.exact import by_synthesis
from disting.general.any_model import same
from disting.general.behaviour import GeneralModel
from disting.general.matrix_model import Model
from disting.model.question import Settings
from disting.verdict.joint import family_safety, joint_in_words
from disting.verdict.result import error_bound
from tests.conditions.handmade import handmade

RANK_1_OF_2 = [[1, 2], [2, 4]]  # two coefficients that vary, two parameters


def sum_of(*bits):
    return sum(Fraction(1, 2**b) for b in bits)


@pytest.mark.full
def test_equal_closures_of_chains_count_both_ranks():
    """Five undamped masses whose ranks are less than both their parameters and their
    coefficients.
    """
    engine = Engine()
    left, right = (
        engine.subject(str(c), c)
        for c in (Chain(5, 4, 1, 5, 2, 5, damped=False), Chain(5, 4, 2, 5, 3, 5, damped=False))
    )
    profiles = [s.profile(Representation.TF, 0) for s in (left, right)]
    assert not any(p.rank_proven for p in profiles)
    fibre = by_synthesis(left.view.form, right.view.form, Settings())
    for found in (asking.same(left, right), asking.same(right, left)):
        assert fibre.outcome is found.outcome is Outcome.HOLDS and found.safety >= LEAST_SAFETY
        assert sum_of(found.safety) >= sum_of(fibre.safety, *(p.safety for p in profiles))


def test_equal_closures_of_general_models_count_the_rank_that_is_not_proven():
    """One of two parameters is determined, through three coefficients: nothing but points says
    that it is not more.
    """
    left = Model.from_transfer_function(["a*b"], ["1", "a*b", "(a*b)**2"], name="two")
    right = Model.from_transfer_function(["c"], ["1", "c", "c**2"], name="one")
    seen, proven = (
        profile(GeneralModel(m), Representation.TF, 0, Settings()) for m in (left, right)
    )
    assert proven.rank_proven and not seen.rank_proven
    fibre, found = (
        same(left, right, Settings()),
        compare(left, right, query=Query(View.EXACT)),
    )
    assert found.decided_by == "exact" and found.safety >= LEAST_SAFETY
    assert sum_of(found.safety) >= sum_of(fibre.safety, seen.safety)


@pytest.mark.parametrize("outcome", [Outcome.HOLDS, Outcome.FAILS])
def test_only_equality_needs_ranks_and_only_those_that_are_not_proven(outcome):
    """Where one closure is not in the other they differ, whatever the ranks."""
    unproven, proven = handmade(RANK_1_OF_2), handmade([[1, 0], [0, 1]])
    assert proven.rank_proven and not unproven.rank_proven
    bounded, certain = Finding(EXACT, outcome, Certainty.BOUNDED, 105), Finding(EXACT, outcome)
    assert resting_on_ranks(bounded, proven, proven) == bounded
    assert resting_on_ranks(certain, unproven, unproven) == certain
    joined = resting_on_ranks(bounded, proven, unproven)
    assert joined.outcome is outcome
    total = sum_of(105, unproven.safety) if outcome is Outcome.HOLDS else sum_of(105)
    assert sum_of(joined.safety + 1) < total <= sum_of(joined.safety)


@pytest.mark.full
@pytest.mark.parametrize("damped", [False, True])
def test_a_family_counts_each_rank_that_tells_who_may_lie_in_whom(damped):
    """Also where no condition that decides looks at the model's profile."""
    engine = Engine()
    for left in (engine.subject(str(c), c) for c in Family(4, damped)):
        own = left.profile(Representation.TF, 0)
        other = engine.subject("one", Chain(1, damped=damped))
        found = engine.decisions([other, left], Query(View.EXACT))
        if not own.rank_proven:
            assert 0 < family_safety(found) <= own.safety


def test_no_bound_is_told_from_none_needed():
    assert joint_safety([]) == 0
    assert (
        joint_safety([1, 1, 1])
        == joint_safety([1, 100])
        == joint_safety([0])
        == joint_safety([-5, 120])
        == USELESS
    )
    assert joint_safety([2, 2]) == 1
    assert joint_in_words(USELESS) != joint_in_words(0) and "-1" not in joint_in_words(USELESS)
    assert error_bound("bounded", USELESS) == "1"
