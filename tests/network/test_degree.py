"""Bridges that give all functions of their kind, by the degree of a map; solutions and values of
them found by a plain least squares that knows nothing of it.
"""

import random

import pytest

from disting import compare, verify
from disting.general.any_model import of_network
from disting.general.replacement import degree, full_set
from disting.network.notation import network_of
from disting.verdict.verdict_file import verdict_file
from tests.oracles.twins import signs, twin

# two masses hang at a third one that is held; force and sensor between the two
BRIDGE, CHAIN = "#~1, 1~2, 1~3; F3:2; S3:2", "#~1, 1~2, 2~3; F3; S3"
# force and sensor between the ends of a chain that is held at one of them: one mass is the bridge
ENDS = "#~1, 1~2, 2~3; F3:1; S3:1"
SOME = [
    "C1 1 2; R1 1 3; C2 2 3; R2 2 0; R3 3 0",
    "C1 1 2; R1 1 3; R2 2 3; R3 2 0; C2 3 0",
]

# four masses, one of them held by a spring, force and sensor between two of them
FOUR = {
    "1~2, 1~3, 1~4, #~2; F3:2; S3:2": 2,
    "1~2, 1~3, 1~4, #~2; F4:3; S4:3": 2,
    "1~2, 1~3, 2~4, #~1; F3:2; S3:2": 5,
    "1~2, 1~3, 2~4, #~1; F4:3; S4:3": 3,
    "1~2, 1~3, 2~4, #~3; F4:1; S4:1": 1,
    "1~2, 1~3, 2~4, #~3; F3:2; S3:2": 3,
    "1~2, 1~3, 2~4, #~3; F4:3; S4:3": 1,
}
LONG = "#~1, 1~2, 2~3, 3~4; F1; S1"


@pytest.mark.parametrize(("text", "known"), [(BRIDGE, 2), (ENDS, 1), *((t, 0) for t in SOME)])
def test_the_degree_of_small_bridges(text, known):
    assert abs(degree(network_of(text))) == known


@pytest.mark.full
@pytest.mark.parametrize(("text", "known"), FOUR.items())
def test_the_degree_of_bridges_of_four_masses(text, known):
    assert abs(degree(network_of(text))) == known
    assert full_set(of_network(network_of(text)))


@pytest.mark.sampled(2)
@pytest.mark.full
@pytest.mark.parametrize("text", [BRIDGE, ENDS, *SOME])
def test_the_sum_of_signs_is_the_degree_everywhere(text):
    """All solutions, as many starts find them."""
    draw, known = random.Random(text), abs(degree(network_of(text)))
    found = [signs(network_of(text), draw, 40) for _ in range(2)]
    assert all(0 not in one and abs(sum(one)) == known for one in found)
    assert all(found)


@pytest.mark.slow
@pytest.mark.parametrize("text", FOUR)
def test_a_bridge_of_four_masses_gives_what_a_chain_gives(text):
    draw = random.Random(text)
    for _ in range(4):
        assert twin(network_of(LONG), network_of(text), draw)[1] is not None


def test_one_element_more_and_the_same_functions_have_no_degree():
    """Nor has a loop, in which a chain remains that gives as much."""
    assert not degree(network_of("#~1, 1~2, 2~3, 1~3; F1; S1"))
    assert not degree(network_of("R1-p(R2,R3-C1)"))


@pytest.mark.full
@pytest.mark.parametrize("bridge", [BRIDGE, ENDS])
def test_a_bridge_whose_degree_is_not_0_gives_all(bridge):
    draw = random.Random(7)
    for given, other in ((CHAIN, bridge), (bridge, CHAIN)):
        assert twin(network_of(given), network_of(other), draw)[1] is not None
    assert compare(bridge, CHAIN).relation.value == "indistinguishable"
    assert verify(verdict_file(bridge, CHAIN)).sentence == "holds"


@pytest.mark.full
@pytest.mark.parametrize("text", SOME)
def test_bridges_of_degree_0_do_not(text):
    """What they give and what they do not is shown by points."""
    model = of_network(network_of(text))
    assert full_set(model) is None
    assert compare(text, "R1-p(C1,R2-p(C2,R3))").relation.value == "sometimes"
