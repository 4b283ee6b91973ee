"""Undamped machines with force and sensor apart, against searches by numbers that know no theorem."""

import random
from itertools import combinations

import pytest

from disting import Relation, compare, verify
from disting.general.any_model import of_network
from disting.general.interlacing import machine_type
from disting.model.chain import Quantity
from disting.network.families import family_of
from disting.network.notation import network_of
from disting.network.notation.machine import machine
from disting.verdict.verdict_file import verdict_file
from tests.oracles.twins import twin

SAME = [
    ("#~1, 1~2, 1~3; F1; S2", "#~1, 1~2, 2~3; F1; S2"),  # a mass is held
    ("#~1, 1~2, 1~3; F1; S2:1", "#~1, 1~2, 2~3; F2:1; S3:2"),  # a spring is cut
    ("#~1, 1~2, 2~3; F2; S3", "#~1, 1~2, 2~3; F3; S2:1"),
    ("#~1, 1~2, 1~3; F2; S3", "#~1, 1~2, 2~3; F1; S3"),  # no antiresonance
    ("#~1, #~2, 1~2; F1; S2", "#~1, 1~2; F1; S2"),  # two springs to the ground
    ("#~1, #~2, 1~2, 1~3; F1; S3", "#~1, 1~2, 2~3; F3; S2:1"),
    ("#~1, #~2, #~3, 1~2, 1~3; F2; S3", "#~1, #~2, 1~3, 2~3; F1; S2"),
    ("#~1, 1~2, 1~3; F2:1; S2:1", "#~1, 1~2, 2~3; F3; S3:2"),  # as one with another ground
    ("1~2, 1~3, 1~4; F2; S3", "1~2, 1~3, 2~4; F1; S4"),  # free
    ("1~2, 1~3, 2~3, 1~4; F1; S4", "1~2, 2~3, 1~4; F4; S1"),  # free, with a loop
]
OTHER = [
    "#~1, #~2, 1~2, 1~3; F1; S2:1",  # zeros of no part
    "1~2, 2~3, 1~3; F1; S2",  # a free loop
    "#~1, 1~2, 1~3, 2~3; F1; S2",  # a loop
    "#=1, 1=2, 1=3; F1; S2",  # dampers
    "#~1, 1~2, 1~3; F1; S3:2",  # zeros that may be anywhere
    "R1-p(R2,C1)",
]


@pytest.mark.sampled(5)
@pytest.mark.full
@pytest.mark.parametrize("pair", SAME)
def test_trees_that_are_the_same(pair):
    assert compare(*pair).relation is Relation.INDISTINGUISHABLE
    assert both_ways(pair, 3)


def both_ways(pair, times):
    left, right = map(network_of, pair)
    draw = random.Random(pair[0])
    ways = ((left, right), (right, left))
    return all(twin(*way, draw)[1] is not None for way in ways for _ in range(times))


@pytest.mark.parametrize("text", OTHER)
def test_machines_that_the_theorem_does_not_speak_of(text):
    assert machine_type(of_network(network_of(text))) is None


def test_signs_and_numbers_of_zeros_are_told_apart():
    star, chain = ("#~1, 1~2, 1~3; F1; S2", "#~1, 1~2, 2~3; F1; S3")
    one, other = (machine_type(of_network(network_of(t))) for t in (star, chain))
    assert one != other
    turned = [of_network(network_of(f"#~1, 1~2, 1~3; F1; {s}")) for s in ("S2:1", "S1:2")]
    assert [m and m.sign for m in map(machine_type, turned)] == [-1, 1]


def test_quantities_and_free_machines_are_told_apart():
    free = [machine("1~2, 2~3; F1; S2", "", quantity) for quantity in Quantity]
    networks = [*free, network_of("#~1, 1~2; F1; S2"), network_of("1~2, 2~3; F1; S3")]
    assert len({machine_type(of_network(n)) for n in networks} - {None}) == len(networks)


@pytest.mark.full
def test_a_verdict_is_verified_and_a_lie_is_not():
    data = verdict_file(*SAME[0])
    assert data["evidence"]["name"] == "interlacing" and verify(data).status.value == "holds"
    other = verdict_file("#~1, 1~2, 1~3; F1; S3:2", SAME[0][1])
    lie = data | {"models": other["models"]}
    assert verify(lie).status.value != "holds"


@pytest.mark.slow
@pytest.mark.parametrize("name", ["machines-3", "trees-4"])
def test_all_pairs_of_a_family(name):
    """Each of 20 random points has a twin each way, and none is told apart otherwise."""
    models = [m for m in map(of_network, family_of(name).networks) if machine_type(m)]
    pairs = [p for p in combinations(models, 2) if machine_type(p[0]) == machine_type(p[1])]
    random.Random(name).shuffle(pairs)
    for left, right in pairs[:40]:
        assert both_ways((left.network.name, right.network.name), 20), (left.name, right.name)
