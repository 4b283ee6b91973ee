"""Parts that can replace each other: truth by hand, and values of the other network found by a plain
least squares that knows nothing of the theorem.
"""

import random
from itertools import combinations

import pytest

from disting import Query, View, compare, verify
from disting.network.families import family_of
from disting.network.network import Network
from disting.network.notation import network_of
from disting.network.simplest import simplest
from disting.verdict.verdict_file import verdict_file
from tests.oracles.twins import STARTS, twin

SAME = [
    ("R0-p(R1,C1)-p(R2,C2)", "R0-p(C1,R1-p(R2,C2))"),
    ("R0-p(R1,C1)-p(R2,C2)", "p(R0,R1-C1,R2-C2)"),
    ("L1-p(L2,C1)", "p(L1,L2-C1)"),
    ("R1-p(C1,R2-W1)", "R1-p(C1,W1-R2)"),
    # a part of two kinds inside one of three
    ("L1-p(C1,R0-p(R1,C2)-p(R2,C3))", "L1-p(C1,R0-p(C2,R1-p(R2,C3)))"),
    ("1~2~3; F1; S1", "1~2, 1~3; F1; S1"),
    ("1~2~3, 3~#; F1; S1", "1~2~3, 1~#; F1; S1"),
    # a branch of two masses hangs between force and sensor
    ("1~2~3, 2~4~5; F1; S3", "1~2~3, 2~4, 2~5; F1; S3"),
    ("1>2, 2>1, 2>3, 3>2, 3>0; in 1; out 1", "1>2, 2>1, 1>3, 3>1, 1>0; in 1; out 1"),
    ("1>2, 2>3, 3>2, 3>4, 4>3; in 1; out 2", "1>2, 2>3, 3>2, 2>4, 4>2; in 1; out 2"),
]
OTHER = [
    ("R0-p(R1,C1)", "p(R1,C1)"),
    ("p(R1,C1)-p(R2,L1)", "p(R1,L1)-p(R2,L2)"),
    ("1~2~3; F1; S3", "1~2, 2~3; F1; S2"),
    ("1~2~3, 3~#; F1; S1", "1~2~3; F1; S1"),
    ("1=2~3; F1; S1", "1~2=3; F1; S1"),
    ("1~2; F1; S2", "1~2; F1; S2; position"),
    ("1>2, 2>1; in 1; out 1", "1>2, 2>1, 2>0; in 1; out 1"),
    ("1>2, 2>3, 3>2; in 1; out 2", "1>2, 2>3, 3>2, 3>0; in 1; out 2"),
]
TURNED = [
    ("1~2; F1:2; S1:2", "1~2; F1:2; S2:1"),
    ("1~2, 2~3, 1~3; F1:2; S1:2", "1~2, 2~3; F1:2; S2:1"),
    ("1~2~3~1, 1~#; F1; S1", "1~2~3~1, 1~#; F1; S#:1"),
]


@pytest.mark.full
@pytest.mark.sampled(3)
@pytest.mark.parametrize(("left", "right"), SAME)
def test_parts_that_replace_each_other(left, right):
    assert has_one_form(network_of(left), network_of(right))
    found = compare(left, right)
    assert found.relation.value == "indistinguishable"
    assert compare(left, right, query=Query(View.EXACT)).relation is found.relation
    assert has_twin(network_of(left), network_of(right), random.Random(1))
    assert has_twin(network_of(right), network_of(left), random.Random(2))


@pytest.mark.parametrize(("left", "right"), OTHER)
def test_parts_that_do_not(left, right):
    assert not has_one_form(network_of(left), network_of(right))


@pytest.mark.full
@pytest.mark.parametrize(("left", "right"), TURNED)
def test_a_sensor_that_is_turned_changes_the_sign(left, right):
    """Positive values give a positive and a negative leading coefficient; complex ones agree."""
    assert compare(left, right).relation.value == "distinguishable"
    assert compare(left, right, query=Query(View.EXACT)).relation.value == "indistinguishable"
    turned = right.replace("S2:1", "S1:2").replace("S#:1", "S1")
    assert compare(left, turned).relation.value == "indistinguishable"


@pytest.mark.full
def test_a_verdict_by_replacement_is_checked_again():
    data = verdict_file(*SAME[-2])
    assert data["decided_by"] == "admissible" and verify(data).sentence == "holds"
    forged = data | {"right": "other"}
    assert verify(forged).status.value == "does not hold"


FAMILIES = ["machines-3", "trees-4", "circuits-5", "cells-4", "compartments-3"]


@pytest.mark.full
@pytest.mark.parametrize(
    "name",
    [pytest.param(n, marks=pytest.mark.slow) if n == "trees-4" else n for n in FAMILIES],
)
def test_pairs_of_families_have_twins_both_ways(name):
    draw = random.Random(name)
    for left, right in draw.sample(list(same_pairs(name)), 4):
        assert has_twin(left, right, draw), (left.name, right.name)
        assert has_twin(right, left, draw), (right.name, left.name)


@pytest.mark.slow
@pytest.mark.parametrize("name", FAMILIES)
def test_all_pairs_of_families_have_twins_both_ways(name):
    draw = random.Random(name)
    for left, right in same_pairs(name):
        for given, other in ((left, right), (right, left)):
            assert has_twin(given, other, draw), (given.name, other.name)


def same_pairs(name: str) -> list[tuple[Network, Network]]:
    return [
        pair
        for pair in combinations(family_of(name).networks, 2)
        if has_one_form(*pair) and pair[0].elements != pair[1].elements
    ]


def has_one_form(left: Network, right: Network) -> bool:
    one = simplest(left)
    return one is not None and one == simplest(right)


def has_twin(given: Network, other: Network, draw: random.Random) -> bool:
    """Whether positive values of the other network are found that give the transfer function of the
    given one at random positive values.
    """
    return twin(given, other, draw, 4 * STARTS)[1] is not None
