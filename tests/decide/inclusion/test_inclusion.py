"""Inclusion of models of unequal rank: known cases, laws, and false evidence."""

from dataclasses import replace
from itertools import combinations, permutations

import pytest

from disting import Engine, Family, Query, Relation, View, compare
from disting.algebra.certainty import Certainty
from disting.conditions.inclusion import (
    Inclusion,
    InclusionFinding,
    Inclusions,
    Sense,
    inclusions_from_dict,
    inclusions_to_dict,
)
from disting.decide.inclusion import confirmation
from disting.decide.inclusion.confirmation import confirms
from disting.decide.inclusion.decide import CLOSURE_LIMITS, inclusions
from disting.decide.inclusion.profiles import by_relative_degrees, row_falls
from disting.decide.inclusion.row_closures import Task, holds
from disting.evidence.conditions import Counts
from disting.evidence.ideals import Refutation, Vanishing
from disting.evidence.limits import (
    FullImage,
    LargerProjection,
    Outside,
    RelativeDegrees,
    RowLimits,
    RowsInside,
    Why,
)
from disting.fibres.ideals import (
    coefficient_map,
    included_by_rows,
    normalise,
    refuted_by_rows,
)
from disting.model.chain import Chain, Quantity
from disting.model.row import Row

ENGINE = Engine()


def subjects(n, damped):
    return [ENGINE.subject(f"A{i}", chain) for i, chain in enumerate(Family(n, damped), 1)]


def unequal(n, damped):
    return [(a, b) for a, b in combinations(subjects(n, damped), 2) if a.rank != b.rank]


@pytest.mark.full
@pytest.mark.parametrize("damped", [False, True])
def test_findings_turn_round_with_the_pair_and_evidence_holds(damped):
    for a, b in unequal(3, damped):
        both, reverse = inclusions(a, b), inclusions(b, a)
        assert inclusions_from_dict(inclusions_to_dict(both)) == both and both.sentence("L", "R")
        for there, back in ((both.image, reverse.image), (both.closure, reverse.closure)):
            assert back.inclusion is there.inclusion.turned
            assert (there.certainty, there.safety) == (back.certainty, back.safety)
            for found, pair in ((there, (a, b)), (back, (b, a))):
                if found.evidence is not None:
                    assert confirms(found.evidence, *pair)
                    assert found.evidence.sentence("L", "R") and found.evidence.formula
            smaller = Inclusion.LEFT_IN_RIGHT if a.rank < b.rank else Inclusion.RIGHT_IN_LEFT
            assert there.inclusion in (smaller, Inclusion.NEITHER, Inclusion.UNKNOWN)


@pytest.mark.full
def test_the_damped_model_7_lies_in_6_and_in_no_other():
    models = subjects(3, True)
    found = {
        i: inclusions(models[6], models[i - 1]).closure
        for i in range(1, 12)
        if models[i - 1].rank == 7
    }
    assert [i for i, f in found.items() if f.inclusion is Inclusion.LEFT_IN_RIGHT] == [6]
    assert all(
        f.certainty == "proven" or isinstance(f.evidence, LargerProjection) for f in found.values()
    )


def test_a_full_image_holds_every_smaller_one_in_its_closure():
    models = subjects(3, False)
    found = inclusions(models[1], models[0]).closure
    assert found.inclusion is Inclusion.LEFT_IN_RIGHT
    assert found.evidence == FullImage(False, 5, ("b0", "b2", "b4", "a0", "a2"))


def test_finite_elements_and_limits_are_two_answers():
    """Three masses with dampers: model 3 has no equivalent in model 2, all elements finite, but
    is a limit of such models.
    """
    three, two, one = (subjects(3, True)[k] for k in (2, 1, 0))
    both = inclusions(three, two)
    assert (both.image.inclusion, both.closure.inclusion) == (
        Inclusion.NEITHER,
        Inclusion.LEFT_IN_RIGHT,
    )
    assert isinstance(both.image.evidence, RelativeDegrees) and isinstance(
        both.closure.evidence, RowsInside
    )
    assert "limit of models A2" in both.sentence(
        "A3", "A2"
    ) and "no finite element values" in both.sentence("A3", "A2")
    neither = inclusions(three, one)
    assert neither.image == neither.closure and neither.closure.inclusion is Inclusion.NEITHER


def test_evidence_on_finite_elements_says_nothing_of_limits():
    falls = InclusionFinding(
        Inclusion.NEITHER, Certainty.PROVEN, evidence=RelativeDegrees(False, 4, 2)
    )
    full = InclusionFinding(
        Inclusion.LEFT_IN_RIGHT, Certainty.BOUNDED, 100, FullImage(False, 5, ("b0",))
    )
    unknown = InclusionFinding(Inclusion.UNKNOWN, reason="not tried")
    assert "whether limits do" in Inclusions(falls, unknown).sentence("L", "R")
    assert "whether finite element values do is not known" in Inclusions(unknown, full).sentence(
        "L", "R"
    )
    for image, closure in (
        (falls, falls),
        (full, full),
        (unknown, falls),
        (unknown, replace(falls, evidence=Outside(True, ()))),
    ):
        with pytest.raises(
            ValueError, match=r"does not prove|equivalents are limits|no equivalent"
        ):
            Inclusions(image, closure)


@pytest.mark.sampled(2)
@pytest.mark.full
@pytest.mark.parametrize(
    ("n", "damped", "unknown"), [(3, False, 0), (3, True, 0), (4, False, 0), (4, True, 4)]
)
def test_limits_that_are_not_known(n, damped, unknown):
    found = [inclusions(a, b) for a, b in unequal(n, damped)]
    assert sum(not both.closure.is_known for both in found) == unknown
    for both in found:
        assert both.closure.is_known or both.image.inclusion is Inclusion.NEITHER
        grades = {
            f.certainty
            for f in (both.image, both.closure)
            if isinstance(f.evidence, Outside | RowsInside)
        }
        assert grades <= {"proven", "bounded"} and all(
            f.safety >= 100 for f in (both.image, both.closure) if f.safety
        )


@pytest.mark.full
def test_the_closures_of_three_damped_masses_are_proven():
    """All but those that rest on ranks of projections; of 13 that are no equivalents, 2 are
    limits.
    """
    models, found = subjects(3, True), {}
    for i, j in (
        (3, 1),
        (7, 1),
        (3, 2),
        (3, 4),
        (3, 5),
        (3, 6),
        (3, 8),
        (3, 9),
        (3, 10),
        (3, 11),
        (7, 4),
        (7, 8),
        (7, 11),
    ):
        both = inclusions(models[i - 1], models[j - 1])
        assert both.image.inclusion is Inclusion.NEITHER and both.closure.certainty == "proven"
        found[i, j] = both.closure.inclusion
    assert [pair for pair, inclusion in found.items() if inclusion is Inclusion.LEFT_IN_RIGHT] == [
        (3, 2),
        (3, 5),
    ]


def test_false_rows_are_refused():
    seven, one, two, three = (subjects(3, True)[k] for k in (6, 0, 1, 2))
    outside = inclusions(seven, one).closure.evidence
    (step,) = outside.steps
    assert step.why is Why.RESULTANT and confirms(outside, seven, one)
    inside = inclusions(three, two).closure.evidence
    assert confirms(inside, three, two) and not confirms(inside, two, three)
    for false in (
        replace(outside, left_given=False),
        replace(outside, steps=()),
        replace(outside, steps=(step, step)),
        replace(outside, steps=(step._replace(why=Why.COEFFICIENT, detail="b4"),)),
        replace(outside, steps=(step._replace(split="same"),)),
        RowsInside(True, (step._replace(why=Why.FULL),)),
        RowsInside(True, (step,)),
    ):
        assert not confirms(false, seven, one)
    assert not confirms(replace(outside, steps=inside.steps), three, two)
    assert not confirms(RowsInside(True, (inside.steps[0]._replace(why=Why.FULL),)), three, two)


@pytest.mark.full
def test_a_row_of_no_larger_dimension_holds_nothing_but_itself():
    """The wall's row of three masses has the rank 9 with force and sensor at 1 and 3 as with 1 and
    2.
    """
    pair = [ENGINE.subject("", Family(5, damped=True)[k]) for k in (45, 42)]
    closure = inclusions(*pair).closure
    (step,) = closure.evidence.steps
    assert (closure.inclusion, step.why, step.detail) == (
        Inclusion.NEITHER,
        Why.DIMENSION,
        "9 = 9",
    )
    assert closure.certainty == "bounded" and closure.safety >= 100
    assert confirms(closure.evidence, *pair)
    assert "something else" in closure.evidence.sentence("L", "R")
    for other in ("9 = 10", "8 = 8", "13 = 13"):
        false = replace(closure.evidence, steps=(step._replace(detail=other),))
        assert not confirms(false, *pair)


def test_a_row_is_not_told_from_itself():
    row = Row(3, False, 1, 1, True)
    itself = Task("whole", "whole", *[normalise(row.structure)] * 2, row)
    assert not holds(RowLimits("whole", "whole", Why.DIMENSION, "7 = 7"), itself)


@pytest.mark.parametrize("small", [16, 22, 25])
def test_what_is_wanted_of_a_row_at_its_middle_mass(small):
    """Two masses on either side: four of eight zeros have terms that add up to 0."""
    pair = [ENGINE.subject("", Family(5, damped=True)[k]) for k in (small, 10)]
    closure = inclusions(*pair).closure
    assert closure.inclusion is Inclusion.NEITHER and closure.certainty == "proven"
    assert [step.why for step in closure.evidence.steps] == [Why.RESULTANT]
    assert confirms(closure.evidence, *pair)


@pytest.mark.full
def test_a_refutation_that_is_too_large_for_plain_elimination_is_found_again(monkeypatch):
    """At fresh points and primes, by the same ideals."""
    models = subjects(3, False)
    three, eleven = models[2], models[10]
    found = inclusions(three, eleven).image
    assert isinstance(found.evidence, Refutation)
    monkeypatch.setattr(confirmation, "PLAIN_MONOMIALS", 0)
    assert confirms(found.evidence, three, eleven)
    assert not confirms(found.evidence, eleven, three)


def test_false_evidence_is_refused():
    one, two = subjects(3, False)[:2]
    true = inclusions(two, one).closure.evidence
    assert confirms(true, two, one)
    assert not confirms(replace(true, left_is_larger=True), two, one)
    assert not confirms(replace(true, free=true.free[1:], rank=4), two, one)
    assert not confirms(LargerProjection(("a0",), 1, 1), one, two)
    assert not confirms(Counts((4, 4), (2, 4)), one, two)


@pytest.mark.full
def test_false_evidence_of_rows_is_refused():
    seven, six = (subjects(3, True)[k] for k in (6, 5))
    solved = included_by_rows(
        *(s.chain.structure for s in (seven, six)), "test", CLOSURE_LIMITS
    ).evidence
    assert (
        solved.is_member
        and confirms(solved, seven, six)
        and not confirms(replace(solved, left_given=False), seven, six)
    )
    first, second = solved.steps
    spoiled = tuple(tuple(x + 1 for x in q) for q in second.shown.solutions)
    false = replace(second, shown=replace(second.shown, solutions=spoiled))
    assert not confirms(replace(solved, steps=(first, false)), seven, six)
    for steps in (
        (first,),
        (),
        (first, replace(second, part=first.part)),
        (first, replace(second, split="same")),
    ):
        assert not confirms(replace(solved, steps=steps), seven, six)


def test_false_refutations_of_rows_are_refused():
    small, large = (
        ENGINE.subject("", Chain(3, *ports, damped=True))
        for ports in ((0, 0, 1, 0, 3), (2, 2, 3, 2, 3))
    )
    evidence = refuted_by_rows(*(s.chain.structure for s in (small, large)), "test")
    (step,) = evidence.steps
    assert isinstance(step.shown, Vanishing) and confirms(evidence, small, large)
    for index in (0, 1, step.shown.index + 1, step.shown.index + 2):
        assert not confirms(
            replace(evidence, steps=(replace(step, shown=Vanishing(index)),)), small, large
        )
    assert not confirms(replace(evidence, steps=()), small, large)


def test_false_relative_degrees_are_refused():
    small, large = (
        ENGINE.subject("", Chain(4, *ports, damped=False))
        for ports in ((2, 1, 3, 2, 4), (2, 2, 3, 2, 4))
    )
    found = inclusions(small, large).image
    assert (found.inclusion, found.certainty) == (Inclusion.NEITHER, "proven")
    assert found.evidence == RelativeDegrees(False, 4, 2) and confirms(found.evidence, small, large)
    for false in (replace(found.evidence, left_is_larger=True), replace(found.evidence, right=3)):
        assert not confirms(false, small, large)
    assert not confirms(replace(found.evidence, left=5), small, large)


@pytest.mark.parametrize(("n", "damped"), [(3, False), (3, True), (4, False)])
def test_row_falls_are_relative_degrees(n, damped):
    for chain in Family(n, damped):
        for more in ({}, {"lag": True}, {"ground_dampers": (1,)}):
            form = replace(chain, quantity=Quantity.POSITION, **more)
            numerator, denominator = coefficient_map(form.structure).degrees
            assert denominator - numerator == min(row_falls(form))


def test_a_lag_on_one_side_is_no_refutation():
    """Relative degree 3 on both sides: by the distance of the ports, or by the lag."""
    apart, lagging = (
        Chain(3, 0, 0, 1, 0, 2, damped=True),
        Chain(3, 0, 0, 1, 0, 1, damped=True, lag=True),
    )
    assert (
        by_relative_degrees(apart, lagging) is None
        and by_relative_degrees(apart, replace(lagging, lag=False)) is not None
    )
    # what falls faster may do so for special elements only, what falls slower never does
    mixed = Chain(4, 2, 1, 3, 1, 3, damped=True)
    assert by_relative_degrees(replace(mixed, lag=True), mixed) is None
    assert by_relative_degrees(mixed, replace(mixed, lag=True)) is not None


@pytest.mark.full
@pytest.mark.parametrize(("n", "damped"), [(3, False), (3, True), (4, False)])
def test_no_inclusion_of_small_classes_is_unknown(n, damped):
    assert all(inclusions(a, b).closure.is_known for a, b in unequal(n, damped))


SIZES = [(1, False), (2, False), (2, True), (3, False), (3, True)]


@pytest.mark.thin(6)
@pytest.mark.parametrize(("n", "damped"), SIZES)
@pytest.mark.parametrize("more", [{"lag": True}, {"dead_time": True}, {"ground_dampers": (1,)}])
def test_a_chain_is_a_limit_of_itself_with_an_element_more(n, damped, more):
    """T1, Td or b1 goes to zero; no finite one does it. The relative degree rises with a lag: that
    denied the limit, and was said to be proven.
    """
    for chain in Family(n, damped):
        small, large = (ENGINE.subject("", c) for c in (chain, replace(chain, **more)))
        if small.rank == large.rank:
            continue
        found = inclusions(small, large)
        assert (found.closure.inclusion, found.closure.certainty) == (
            Inclusion.LEFT_IN_RIGHT,
            Certainty.THEOREM,
        )
        assert inclusions(large, small).closure.inclusion is Inclusion.RIGHT_IN_LEFT
        assert confirms(found.closure.evidence, small, large)
        if "ground_dampers" not in more:
            assert found.image.inclusion is Inclusion.NEITHER
            assert confirms(found.image.evidence, small, large)


def test_relative_degrees_refute_no_limit():
    """Evidence that denied T1 -> 0 is refused, in either sense."""
    small, large = (ENGINE.subject("", Chain(2, lag=lag)) for lag in (False, True))
    counts = Counts((2, 2), (2, 3))
    assert not confirms(counts, small, large)
    assert not confirms(replace(counts, left=(2, 3), right=(2, 2)), large, small)
    slower = RelativeDegrees(False, 2, 3)
    assert confirms(slower, small, large) and "at least as fast as s^-3" in slower.sentence(
        "A", "B"
    )
    for false in (RelativeDegrees(False, 3, 2), RelativeDegrees(False, 1, 3)):
        assert not confirms(false, small, large)
    with pytest.raises(ValueError, match="does not prove"):
        Inclusions(*(InclusionFinding(Inclusion.NEITHER, Certainty.PROVEN, evidence=slower),) * 2)


def test_a_dead_time_of_the_smaller_model_alone_is_no_limit():
    for small, large in (
        (Chain(2, damped=False, dead_time=True), Chain(2, ground_dampers=(1,))),
        (Chain(1, dead_time=True), Chain(2, damped=True)),
    ):
        one, other = (ENGINE.subject("", chain) for chain in (small, large))
        found = inclusions(one, other)
        assert found.image == found.closure
        assert found.closure.evidence == LargerProjection(("Td",), 1, 0)
        assert confirms(found.closure.evidence, one, other)
        assert inclusions(other, one).closure.evidence == LargerProjection(("Td",), 0, 1)


@pytest.mark.full
def test_verdicts_tell_it():
    family = Family(3, damped=True)
    assert compare(family[6], family[7]).closure is Inclusion.RIGHT_IN_LEFT
    for found in (compare(family[1], family[11]), compare(family[1], family[6])):
        assert found.image is found.closure
    assert compare(family[1], family[11]).closure is Inclusion.EQUAL
    assert compare(family[1], family[6]).closure is Inclusion.NEITHER
    assert compare(family[6], family[7], query=Query(View.COMBINED)).closure is Inclusion.UNKNOWN


@pytest.mark.full
def test_families_tell_it_as_pairs_do():
    family = subjects(3, True)
    decided = ENGINE.decisions(family, Query())
    for i, j in combinations(range(len(family)), 2):
        one = compare(family[i].chain, family[j].chain, engine=ENGINE)
        assert decided.verdict(i, j).image is one.image is decided.inclusion(i, j, Sense.IMAGE)
        assert (
            decided.verdict(i, j).closure is one.closure is decided.inclusion(i, j, Sense.CLOSURE)
        )
        assert decided.verdict(i, j).inclusions == one.inclusions
        assert (one.closure is Inclusion.EQUAL) == (one.relation is Relation.INDISTINGUISHABLE)


def test_equal_ranks_are_left_to_the_verdict():
    family = subjects(3, True)
    with pytest.raises(ValueError, match="ranks are equal"):
        inclusions(family[0], family[5])


@pytest.mark.full
@pytest.mark.parametrize(("n", "damped"), [(3, False), (3, True), (4, False)])
def test_inclusion_is_transitive(n, damped):
    """A in B and B in (or equal to) C: no finding may say that A does not lie even in the
    closure of C.
    """
    models = subjects(n, damped)
    decided = ENGINE.decisions(models, Query())
    inside, apart = set(), set()
    for i, j in permutations(range(len(models)), 2):
        inclusion = decided.inclusion(min(i, j), max(i, j), Sense.CLOSURE)
        if inclusion is Inclusion.EQUAL or inclusion is (
            Inclusion.LEFT_IN_RIGHT if i < j else Inclusion.RIGHT_IN_LEFT
        ):
            inside.add((i, j))
        elif inclusion is Inclusion.NEITHER:
            apart.add((i, j))
    assert not [
        (i, j, k)
        for i, j in inside
        for k in range(len(models))
        if (j, k) in inside and (i, k) in apart
    ]
    assert inside and apart
