"""Places of springs to the ground, against searches by numbers that know no theorem."""

import random

import pytest

from disting import Relation, compare, verify
from disting.network.grounds import grounded_everywhere
from disting.network.notation import network_of
from disting.verdict.verdict_file import verdict_file
from tests.oracles.twins import twin

SAME = [
    ("#~1, 1~2, 1~3, 2~3; F1; S2", "#~1, #~3, 1~2, 1~3, 2~3; F1; S2"),
    ("#~1, 1~2, 1~3, 2~3; F1; S2", "#~1, 1~2, 1~3, 2~3; F2; S3"),
    ("#~1, #~2, 1~2, 1~3, 2~3; F1; S2", "#~1, #~2, #~3, 1~2, 1~3, 2~3; F1; S2"),
]
OTHER = [
    "1~2, 1~3, 2~3; F1; S2",  # none at the ground
    "#~1, #~2, 1~3; F1; S3",  # of two parts
    "#~1, 1~2, 1~3; F1; S3:2",  # a sensor between two masses
    "#=1, 1=2, 1=3, 2=3; F1; S2",  # dampers
    "#~1, 1~2*3/2; F1; S2",  # a gear
    "p(R1,C1)",
]


@pytest.mark.parametrize("text", OTHER)
def test_networks_that_the_theorem_does_not_speak_of(text):
    assert grounded_everywhere(network_of(text)) is None


@pytest.mark.thin(1)
@pytest.mark.parametrize("pair", SAME)
def test_machines_that_are_the_same(pair):
    assert compare(*pair).relation is Relation.INDISTINGUISHABLE


@pytest.mark.full
@pytest.mark.parametrize("pair", SAME)
def test_each_point_has_a_twin_both_ways(pair):
    left, right = map(network_of, pair)
    draw = random.Random(pair[0])
    for way in ((left, right), (right, left)):
        assert all(twin(*way, draw)[1] is not None for _ in range(3))


@pytest.mark.full
def test_a_verdict_is_verified_and_a_lie_is_not():
    data = verdict_file(*SAME[0])
    assert data["evidence"]["name"] == "springs to the ground"
    assert verify(data).status.value == "holds"
    other = verdict_file("#~1, 1~2, 1~3, 2~3; F1; S1", SAME[0][1])
    assert verify(data | {"models": other["models"]}).status.value != "holds"
