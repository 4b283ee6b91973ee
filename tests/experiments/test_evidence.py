"""What the exact decision and the question of positive equivalents rest on, and its check."""

from dataclasses import replace
from itertools import combinations

import pytest

from disting import Certainty, Experiment, Family, Query, Settings, Verdict, View, compare, prove
from disting.evidence.decision import FibreUnder
from disting.evidence.ideals import Refutation, Solutions
from disting.evidence.positive import BothWays, OnlyOne, Points, PositiveFinding, Share
from disting.experiments.exact import LIMITS, by_ideals, exact_finding, positive_finding
from disting.experiments.experiment import MeasuredChain
from disting.experiments.listing import by_list
from disting.experiments.measured_evidence import confirms

A = Family(3, damped=True)
U = Family(3, damped=False)
AS_IT_IS = Experiment()


def measured(chain, further):
    return MeasuredChain(chain, (AS_IT_IS, further))


def inertia(i, j, left=A[2], right=A[5]):
    return (
        measured(left, Experiment(inertias={i: 1})),
        measured(right, Experiment(inertias={j: 1})),
    )


def test_a_list_refutes_and_is_made_again():
    left, right = inertia(1, 2)
    found = by_list(left, right, Settings())
    assert found.outcome.value == "fails" and found.safety >= 100
    evidence = found.evidence
    assert isinstance(evidence, FibreUnder) and set(evidence.missed) == {2}
    assert confirms(evidence, left, right)
    assert not confirms(evidence, *inertia(1, 3))
    assert not confirms(replace(evidence, missed=(1,)), left, right)
    assert not confirms(replace(evidence, listed=7), left, right)
    assert not confirms(replace(evidence, point=evidence.point[:-1]), left, right)
    assert "each gives another one in experiment 2" in evidence.sentence("A2", "A5")
    assert "A5 has no parameters" in replace(evidence, missed=()).sentence("A2", "A5")


def test_what_is_the_same_is_never_refuted_by_a_list():
    assert by_list(*inertia(1, 3), Settings()) is None


@pytest.mark.parametrize(("i", "j", "kind"), [(1, 3, Solutions), (2, 1, Refutation)])
def test_ideals_solve_and_refute(i, j, kind):
    left, right = inertia(i, j)
    found = by_ideals(left, right, Settings(), LIMITS)
    assert isinstance(found.evidence, kind) and found.safety >= 100
    assert confirms(found.evidence, left, right)
    other = inertia(2, 1) if kind is Solutions else inertia(1, 3)
    assert not confirms(found.evidence, *other)


def test_a_verdict_is_read_as_it_was_written():
    asked = [AS_IT_IS, (Experiment(inertias={1: 1}), Experiment(inertias={2: 1}))]
    query = Query(View.EXACT, conditions=("1", "2"))
    found = compare(A[2], A[5], experiments=asked, query=query)
    assert isinstance(found.evidence, FibreUnder)
    assert Verdict.from_dict(found.to_dict()) == found


def test_a_rank_of_several_experiments_is_not_proven_as_that_of_one():
    left, right = U[2], U[5]
    asked = [AS_IT_IS, Experiment(sensor=2)]
    found = compare(left, right, experiments=asked, query=Query(View.EXACT, conditions=("4",)))
    assert found.decided_by == "4" and prove(found, left, right) == found


@pytest.mark.full
def test_a_rank_with_a_moved_sensor_is_not_proven_as_that_of_the_chain():
    four = Query(View.EXACT, conditions=("4",))
    moved = [Experiment(sensor=2)]
    for left, right in combinations(U, 2):
        found = compare(left, right, experiments=moved, query=four)
        if found.decided_by == "4":
            assert prove(found, left, right) == found
            assert all("[1]" in row for row in found.evidence.rows)
            return
    raise AssertionError("no pair is told apart by its rank")


def test_the_order_of_sides_is_that_of_the_evidence():
    left, right = inertia(1, 2)
    for a, b in ((left, right), (right, left)):
        found = exact_finding(a, b, Settings())
        assert found.outcome.value == "fails" and confirms(found.evidence, a, b)


def test_over_positive_parameters_a_renaming_decides():
    found = compare(
        A[2], A[5], experiments=[AS_IT_IS, (Experiment(sensor=2), Experiment(sensor=3))]
    )
    assert (found.relation.value, found.domain.value) == ("indistinguishable", "positive")


@pytest.mark.full
def test_over_positive_parameters_the_only_equivalent_of_one_experiment_decides():
    """Foster's theorem, and one parameter vector for each behaviour: undamped, collocated."""
    pair = (Experiment(sensor=1), Experiment(sensor=2))
    found = compare(U[8], U[11], experiments=[AS_IT_IS, pair])
    assert (found.relation.value, found.decided_by) == ("indistinguishable", "admissible")
    assert found.evidence.left.evidence == OnlyOne(1)
    assert "no other, so it is that of all experiments" in found.sentence


@pytest.mark.full
def test_over_positive_parameters_points_of_one_kind_prove_nothing():
    pair = (Experiment(sensor=1), Experiment(sensor=2))
    found = compare(U[1], U[4], experiments=[AS_IT_IS, pair])
    assert found.relation.value == "undecided"
    assert "over complex parameters they are indistinguishable" in found.sentence


def test_points_that_are_not_of_two_kinds_are_no_evidence():
    """Whatever a file says of them: the equivalents at both points are listed again."""
    left, right = inertia(1, 3)
    at = tuple((name, "1") for name in A[2].parameters)
    nowhere, negative = (*at[1:], ("x", "1")), (*at[1:], (at[0][0], "-1"))
    for one, other in ((at, at), (nowhere, at), (negative, at), (at, nowhere)):
        said = PositiveFinding(Share.SOMETIMES, Certainty.BOUNDED, 100, Points(one, other))
        assert not confirms(BothWays(said, PositiveFinding(Share.UNKNOWN)), left, right)


def test_shares_of_single_experiments_are_checked_again():
    """That transfer functions decay differently, or that an equivalent is the only one."""
    left, right = (measured(U[n], Experiment(locked=3)) for n in (1, 2))
    never = positive_finding(left, right, Settings())
    either = BothWays(never, PositiveFinding(Share.UNKNOWN))
    assert confirms(either, left, right)
    assert not confirms(either, left, left)
    assert not confirms(replace(either, left=replace(never, share=Share.SOMETIMES)), left, right)
    only = PositiveFinding(Share.ALWAYS, Certainty.THEOREM, 0, OnlyOne(3))  # of two experiments
    assert not confirms(replace(either, left=only), left, right)
    alone = replace(only, evidence=OnlyOne(2))  # with a lock it is none of the class
    assert not confirms(replace(either, left=alone), left, right)


def test_no_positive_equivalents_in_one_experiment_are_none_in_all():
    """Transfer functions of A1 and A2 decay differently."""
    left, right = (measured(U[n], Experiment(locked=3)) for n in (1, 2))
    found = positive_finding(left, right, Settings())
    assert found.share.value == "never" and found.evidence.name == "decay"


def test_an_experiment_that_tells_nothing_leaves_the_verdict_of_today():
    pair = (Experiment(locked=1), Experiment(locked=2))
    today = compare(U[1], U[4])
    found = compare(U[1], U[4], experiments=[AS_IT_IS, pair])
    assert found == replace(today, notes=(*today.notes, *found.notes[-1:]))
    assert found.notes[-1] == "nothing is learned from experiment 2: its sensor never moves"
