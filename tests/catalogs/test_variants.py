"""Lag, dead time and sensor quantity over whole families: the paper's statements, and what
changes and what does not.
"""

from collections import Counter
from dataclasses import replace
from itertools import combinations

import pytest

from disting import Certainty, Chain, Engine, Family, Quantity, Query, Relation, compare
from disting.decide.same.evidence_check import Witness
from disting.decide.same.exact import exact_finding
from disting.evidence.decision import DeadTime
from disting.evidence.kinds import evidence_from
from disting.model.question import Settings
from tests.catalogs.variants import (
    originals_against_lagged,
    sensor_effects,
    sensor_sentence,
    with_and_without_dead_time,
    with_and_without_lag,
)

APART = Relation.DISTINGUISHABLE
ENGINE = Engine()
FAMILIES = [(n, damped) for n in range(1, 6) for damped in (False, True)]
SIZE = {1: 1, 2: 3, 3: 11, 4: 29, 5: 73}


# Printed, for 3 masses: "the first-order hold model leads to augmented models that are
# distinguishable from the original models in all eleven cases".
@pytest.mark.thin(2)
@pytest.mark.parametrize(("n", "damped"), FAMILIES)
@pytest.mark.sampled(5)
def test_a_lag_is_always_distinguishable_from_none(n, damped):
    found = with_and_without_lag(Family(n, damped), ENGINE)
    assert Counter((v.relation, v.decided_by, v.certainty) for v in found) == {
        (APART, "1", Certainty.PROVEN): SIZE[n]
    }


@pytest.mark.sampled(4)
@pytest.mark.full
@pytest.mark.parametrize(("n", "damped"), FAMILIES)
def test_no_lagged_model_is_any_original_one(n, damped):
    found = originals_against_lagged(Family(n, damped), ENGINE)
    assert {relation for relation, _ in found} == {APART}
    assert sum(found.values()) == SIZE[n] ** 2
    if not damped:
        assert set(found) == {(APART, "1")}


@pytest.mark.full
def test_lagged_against_original_damped_ones_by_condition():
    assert {
        n: {rule: k for (_, rule), k in originals_against_lagged(Family(n, True), ENGINE).items()}
        for n in (3, 4, 5)
    } == {
        3: {"1": 103, "2": 18},
        4: {"1": 743, "2": 98},
        5: {"1": 4496, "2": 833},
    }


@pytest.mark.sampled(4)
@pytest.mark.thin(2)
@pytest.mark.parametrize(("n", "damped"), FAMILIES)
def test_a_dead_time_is_told_from_none_by_a_theorem(n, damped):
    found = with_and_without_dead_time(Family(n, damped), ENGINE)
    assert Counter((v.relation, v.decided_by, v.certainty) for v in found) == {
        (APART, "3", Certainty.THEOREM): SIZE[n]
    }
    assert all("no rational function" in v.sentence and v.error_bound == "0" for v in found)


def test_a_dead_time_cannot_be_made_up_for_by_other_elements():
    plain = Chain(2, damped=True)
    for other in (
        replace(plain, dead_time=True),
        Chain(2, meas_plus=2, damped=True, dead_time=True),
    ):
        for left, right in ((plain, other), (other, plain)):
            assert compare(left, right, engine=ENGINE).relation is APART


def test_the_exact_decision_knows_the_theorem():
    plain, other = Chain(2, damped=True), Chain(2, damped=True, dead_time=True)
    found = exact_finding(plain, other, Settings())
    assert (found.outcome, found.certainty, found.evidence) == (
        "fails",
        Certainty.THEOREM,
        DeadTime(False),
    )
    assert found.turned == exact_finding(other, plain, Settings())
    assert "B has a dead time, A has none" in found.evidence.sentence("A", "B")
    assert evidence_from(found.evidence.to_dict()) == found.evidence
    witness = Witness()
    assert witness.confirms(found.evidence, "fibre", plain, other)
    assert not witness.confirms(found.evidence, "fibre", other, plain)
    assert not witness.confirms(found.evidence, "fibre", other, other)


@pytest.mark.full
def test_a_dead_time_on_both_sides_changes_nothing():
    chain = Family(3, damped=True)
    for left, right in (
        (chain[1], chain[11]),
        (chain[1], chain[4]),
        (chain[6], chain[7]),
        (chain[2], chain[5]),
    ):
        late = [replace(c, dead_time=True) for c in (left, right)]
        assert (
            compare(*late, engine=ENGINE).relation is compare(left, right, engine=ENGINE).relation
        )


@pytest.mark.parametrize("masses", [((2,), (3,)), ((1, 2), (2, 3))])
def test_the_exact_decision_covers_lag_and_dead_time_on_both_sides(masses):
    pair = [Chain(3, damped=True, ground_dampers=m, lag=True, dead_time=True) for m in masses]
    verdict = compare(*pair, engine=ENGINE)
    assert (verdict.relation, verdict.decided_by) == (APART, "exact")
    assert Witness().confirms(verdict.evidence, verdict.representation, *pair)


@pytest.mark.thin(1)
@pytest.mark.parametrize(
    ("n", "damped"),
    [
        pytest.param(n, d, marks=[pytest.mark.slow] * (n == 4))
        for n in (1, 2, 3, 4)
        for d in (False, True)
    ],
)
def test_the_sensor_quantity_changes_no_verdict(n, damped):
    """Relations and deciding conditions of all pairs, for position, velocity and acceleration."""
    query = Query(inclusion=False)
    found = [
        ENGINE.decisions(
            [ENGINE.subject(str(i), c) for i, c in enumerate(Family(n, damped, sensor))], query
        )
        for sensor in Quantity
    ]
    for i, j in combinations(range(SIZE[n]), 2):
        assert len({d.relation(i, j) for d in found}) == 1
    assert all((d.decided_by == found[0].decided_by).all() for d in found)


@pytest.mark.full
def test_with_ground_dampers_another_condition_may_decide_but_the_same():
    """One model with a damper to the ground in its free row, the other without: poles at zero
    of different multiplicity.
    """
    chains = [Chain(2, damped=True, ground_dampers=m) for m in ((), (1,), (2,), (1, 2))]
    query, rules = Query(inclusion=False), {}
    for left, right in combinations(chains, 2):
        found = [
            compare(*(replace(c, quantity=s) for c in (left, right)), query=query, engine=ENGINE)
            for s in Quantity
        ]
        assert {v.relation for v in found} == {APART}
        rules[left.ground_dampers, right.ground_dampers] = [v.decided_by for v in found]
    assert {pair for pair, seen in rules.items() if len(set(seen)) > 1} == {
        ((), (1,)),
        ((), (2,)),
        ((), (1, 2)),
    }
    assert rules[(), (1,)] == ["3", "3", "1"]


@pytest.mark.full
@pytest.mark.parametrize("damped", [False, True])
@pytest.mark.parametrize("n", [1, 2, 3, 4])
def test_what_a_sensor_quantity_shifts(n, damped):
    """Every model moves freely: two poles at zero, which two differentiations cancel; the free
    coefficients stay.
    """
    for chain in Family(n, damped):
        position, velocity, acceleration = sensor_effects(chain, ENGINE)
        assert {e.numerator_degree for e in (position, velocity, acceleration)} == {
            position.numerator_degree
        }
        assert [e.denominator_degree for e in (position, velocity, acceleration)] == [
            2 * n,
            2 * n - 1,
            2 * n - 2,
        ]
        assert {(e.free, e.rank) for e in (position, velocity, acceleration)} == {
            (position.free, position.rank)
        }
        assert {"a0", "a1"} <= set(position.zeros) and "a0" in velocity.zeros
        assert "a0" not in acceleration.zeros


def test_a_ground_damper_leaves_one_pole_to_cancel():
    seen = sensor_effects(Chain(1, ground_dampers=(1,), damped=False), ENGINE)
    assert [(e.numerator_degree, e.denominator_degree, e.zeros) for e in seen] == [
        (0, 2, ("a0",)),
        (0, 1, ()),
        (1, 1, ("b0",)),
    ]
    assert "b0 zero; free coefficients (2)" in sensor_sentence(
        Chain(1, ground_dampers=(1,), damped=False)
    )
