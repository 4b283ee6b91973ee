"""Inclusion of models of unequal rank: known cases, laws, and false evidence."""

from dataclasses import replace
from itertools import combinations, permutations

import pytest

from disting import Engine, Family, Query, Relation, View, compare
from disting.conditions.evidence import Counts
from disting.ideals import Vanishing, coefficient_map
from disting.inclusion import (
    Inclusion,
    Sense,
    confirms,
    inclusion_finding,
    inclusion_from_dict,
    inclusion_to_dict,
)
from disting.inclusion.finding import FullImage, LargerProjection, RelativeDegrees
from disting.inclusion.profiles import by_relative_degrees, part_falls
from disting.model.chain import Chain, Sensor

ENGINE = Engine()


def subjects(n, damped):
    return [ENGINE.subject(f"A{i}", chain) for i, chain in enumerate(Family(n, damped), 1)]


def unequal(n, damped):
    return [(a, b) for a, b in combinations(subjects(n, damped), 2) if a.rank != b.rank]


@pytest.mark.parametrize("damped", [False, True])
def test_findings_turn_round_with_the_pair_and_evidence_holds(damped):
    turned = {Inclusion.LEFT_IN_RIGHT: Inclusion.RIGHT_IN_LEFT, Inclusion.RIGHT_IN_LEFT: Inclusion.LEFT_IN_RIGHT}
    for a, b in unequal(3, damped):
        there, back = inclusion_finding(a, b), inclusion_finding(b, a)
        assert back.inclusion is turned.get(there.inclusion, there.inclusion)
        assert (there.sense, there.certainty, there.safety) == (back.sense, back.certainty, back.safety)
        assert inclusion_from_dict(inclusion_to_dict(there)) == there
        for found, pair in ((there, (a, b)), (back, (b, a))):
            if found.evidence is not None:
                assert confirms(found.evidence, *pair)
                assert found.evidence.sentence("L", "R") and found.evidence.formula
        smaller = Inclusion.LEFT_IN_RIGHT if a.rank < b.rank else Inclusion.RIGHT_IN_LEFT
        assert there.inclusion in (smaller, Inclusion.NEITHER, Inclusion.UNKNOWN)


def test_the_damped_model_7_lies_in_6_and_in_no_other():
    models = subjects(3, True)
    found = {i: inclusion_finding(models[6], models[i - 1]).inclusion for i in range(1, 12) if models[i - 1].rank == 7}
    assert [i for i, inclusion in found.items() if inclusion is Inclusion.LEFT_IN_RIGHT] == [6]
    assert inclusion_finding(models[6], models[5]).certainty == "bounded"


def test_a_full_image_holds_every_smaller_one_in_its_closure():
    models = subjects(3, False)
    found = inclusion_finding(models[1], models[0])
    assert (found.inclusion, found.sense) == (Inclusion.LEFT_IN_RIGHT, Sense.CLOSURE)
    assert found.evidence == FullImage(False, 5, ("b0", "b2", "b4", "a0", "a2"))


def test_false_evidence_is_refused():
    one, two = subjects(3, False)[:2]
    true = inclusion_finding(two, one).evidence
    assert confirms(true, two, one)
    assert not confirms(replace(true, left_is_larger=True), two, one)
    assert not confirms(replace(true, free=true.free[1:], rank=4), two, one)
    assert not confirms(LargerProjection(("a0",), 1, 1), one, two)
    assert not confirms(Counts((4, 4), (2, 4)), one, two)


def test_false_evidence_of_parts_is_refused():
    seven, six = (subjects(3, True)[k] for k in (6, 5))
    solved = inclusion_finding(seven, six).evidence
    assert solved.is_member and confirms(solved, seven, six) and not confirms(replace(solved, left_given=False), seven, six)
    first, second = solved.steps
    spoiled = tuple(tuple(x + 1 for x in q) for q in second.shown.solutions)
    false = replace(second, shown=replace(second.shown, solutions=spoiled))
    assert not confirms(replace(solved, steps=(first, false)), seven, six)
    for steps in ((first,), (), (first, replace(second, part=first.part)), (first, replace(second, split="same"))):
        assert not confirms(replace(solved, steps=steps), seven, six)


def test_false_refutations_of_parts_are_refused():
    small, large = (ENGINE.subject("", Chain(3, *ports, damped=True)) for ports in ((0, 0, 1, 0, 3), (2, 2, 3, 2, 3)))
    found = inclusion_finding(small, large)
    assert (found.inclusion, found.sense) == (Inclusion.NEITHER, Sense.IMAGE)
    (step,) = found.evidence.steps
    assert isinstance(step.shown, Vanishing) and found.certainty == "proven" and confirms(found.evidence, small, large)
    for index in (0, 1, step.shown.index + 1, step.shown.index + 2):
        assert not confirms(replace(found.evidence, steps=(replace(step, shown=Vanishing(index)),)), small, large)
    assert not confirms(replace(found.evidence, steps=()), small, large)


def test_false_relative_degrees_are_refused():
    small, large = (ENGINE.subject("", Chain(4, *ports)) for ports in ((2, 1, 3, 2, 4), (2, 2, 3, 2, 4)))
    found = inclusion_finding(small, large)
    assert (found.inclusion, found.sense, found.certainty) == (Inclusion.NEITHER, Sense.IMAGE, "proven")
    assert found.evidence == RelativeDegrees(False, 4, 2) and confirms(found.evidence, small, large)
    for false in (replace(found.evidence, left_is_larger=True), replace(found.evidence, right=3)):
        assert not confirms(false, small, large)
    assert not confirms(replace(found.evidence, left=5), small, large)


@pytest.mark.parametrize(("n", "damped"), [(3, False), (3, True), (4, False)])
def test_part_falls_are_relative_degrees(n, damped):
    for chain in Family(n, damped):
        for more in ({}, {"lag": True}, {"ground_dampers": (1,)}):
            form = replace(chain, sensor=Sensor.POSITION, **more)
            numerator, denominator = coefficient_map(form.structure).degrees
            assert denominator - numerator == min(part_falls(form))


def test_a_lag_on_one_side_is_no_refutation():
    """Relative degree 3 on both sides: by the distance of the ports, or by the lag."""
    apart, lagging = Chain(3, 0, 0, 1, 0, 2, damped=True), Chain(3, 0, 0, 1, 0, 1, damped=True, lag=True)
    assert by_relative_degrees(apart, lagging) is None and by_relative_degrees(apart, replace(lagging, lag=False)) is not None


@pytest.mark.parametrize(("n", "damped"), [(3, False), (3, True), (4, False)])
def test_no_inclusion_of_small_classes_is_unknown(n, damped):
    assert all(inclusion_finding(a, b).inclusion is not Inclusion.UNKNOWN for a, b in unequal(n, damped))


def test_verdicts_tell_it():
    family = Family(3, damped=True)
    assert compare(family[6], family[7]).inclusion is Inclusion.RIGHT_IN_LEFT
    assert compare(family[1], family[11]).inclusion is Inclusion.EQUAL
    assert compare(family[1], family[6]).inclusion is Inclusion.NEITHER
    assert compare(family[6], family[7], query=Query(View.COMBINED)).inclusion is Inclusion.UNKNOWN


def test_families_tell_it_as_pairs_do():
    family = subjects(3, True)
    decided = ENGINE.decisions(family, Query())
    for i, j in combinations(range(len(family)), 2):
        one = compare(family[i].chain, family[j].chain, engine=ENGINE)
        assert decided.verdict(i, j).inclusion is one.inclusion is decided.inclusion(i, j)
        assert decided.verdict(i, j).inclusion_finding == one.inclusion_finding
        assert (one.inclusion is Inclusion.EQUAL) == (one.relation is Relation.INDISTINGUISHABLE)


def test_equal_ranks_are_left_to_the_verdict():
    family = subjects(3, True)
    with pytest.raises(ValueError, match="equal rank"):
        inclusion_finding(family[0], family[5])


@pytest.mark.parametrize(("n", "damped"), [(3, False), (3, True), (4, False)])
def test_inclusion_is_transitive(n, damped):
    """A in B and B in (or equal to) C: no finding may say that A does not lie even in the closure of C."""
    models = subjects(n, damped)
    decided = ENGINE.decisions(models, Query())
    inside, apart = set(), set()
    for i, j in permutations(range(len(models)), 2):
        found = decided.inclusions.get((min(i, j), max(i, j)))
        inclusion = decided.inclusion(min(i, j), max(i, j))
        if inclusion is Inclusion.EQUAL or inclusion is (Inclusion.LEFT_IN_RIGHT if i < j else Inclusion.RIGHT_IN_LEFT):
            inside.add((i, j))
        elif inclusion is Inclusion.NEITHER and (found is None or found.sense is Sense.BOTH):
            apart.add((i, j))
    assert not [(i, j, k) for i, j in inside for k in range(len(models)) if (j, k) in inside and (i, k) in apart]
    assert inside and apart
