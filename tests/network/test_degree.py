"""Bridges that give all functions of their kind, by the degree of a map; values of them found by a
plain least squares that knows nothing of it.
"""

import random
from fractions import Fraction

import pytest

from disting import compare, verify
from disting.general.any_model import of_network
from disting.general.fibre_lists import goal_of, orientation, positive
from disting.general.replacement import covers, full_set, set_of
from disting.network.notation import network_of
from disting.verdict.verdict_file import verdict_file
from tests.oracles.twins import twin

# two masses hang at a third one that is held; force and sensor between the two
BRIDGE, CHAIN = "#~1, 1~2, 1~3; F3:2; S3:2", "#~1, 1~2, 2~3; F3; S3"
# force and sensor between the ends of a chain that is held at one of them: one mass is the bridge
ENDS = "#~1, 1~2, 2~3; F3:1; S3:1"
SOME = [
    "C1 1 2; R1 1 3; C2 2 3; R2 2 0; R3 3 0",
    "C1 1 2; R1 1 3; R2 2 3; R3 2 0; C2 3 0",
]


def signs(text, draw):
    """Signs of all positive values with the function of random ones; none if not all are found."""
    model = of_network(network_of(text))
    values = {name: Fraction(draw.randint(1, 9)) for name in model.parameters}
    return [orientation(model, e) for e in positive(goal_of(model, values), model, True) or ()]


@pytest.mark.full
@pytest.mark.parametrize(
    ("text", "degree"), [(BRIDGE, 2), (ENDS, 1), *((text, 0) for text in SOME)]
)
def test_the_sum_of_signs_is_the_same_everywhere(text, degree):
    draw = random.Random(text)
    found = [signs(text, draw) for _ in range(8)]
    assert all(0 not in one and abs(sum(one)) == degree for one in found)
    assert all(found)


@pytest.mark.full
@pytest.mark.parametrize("bridge", [BRIDGE, pytest.param(ENDS, marks=pytest.mark.slow)])
def test_a_bridge_whose_degree_is_not_0_gives_all(bridge):
    model = of_network(network_of(bridge))
    assert covers(model, set_of(model)[1], set_of) and full_set(model)
    draw = random.Random(7)
    for given, other in ((CHAIN, bridge), (bridge, CHAIN)) * 3:
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


def test_where_something_remains_that_gives_as_much_nothing_is_said():
    """A chain with a loop has the chain in it: its map is not proper."""
    model = of_network(network_of("#~1, 1~2, 2~3, 1~3; F1; S1"))
    assert not covers(model, set_of(model)[1], set_of)
    assert full_set(model)
