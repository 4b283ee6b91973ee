"""A star as a triangle and back: beside the elimination of the node in the middle."""

from fractions import Fraction

import pytest
from hypothesis import given, settings, strategies as st

from disting.general.balls import Balls
from disting.general.star_triangle import without_bridges
from disting.general.target import fraction
from disting.network.notation import network_of

STAR = "{0}1 1 4; {0}2 2 4; {0}3 4 0; {1}1 1 2; {1}2 2 0; {1}3 2 5; {1}4 5 0; port 1 0"
POSITIVE = st.fractions(Fraction(1, 9), 9, max_denominator=9)


def ends(network):
    return {e.value: {*e.nodes} for e in network.elements}


@pytest.mark.thin(2)
@pytest.mark.parametrize(("kind", "other"), [("R", "C"), ("C", "R"), ("L", "R"), ("W", "C")])
@settings(deadline=None, max_examples=20)
@given(values=st.tuples(POSITIVE, POSITIVE, POSITIVE))
def test_the_middle_is_eliminated(kind, other, values):
    """Without its current the node in the middle has the mean of the three potentials, weighted by
    the admittances y: from i to j flows y_i y_j / (y_1 + y_2 + y_3) (u_i - u_j).
    """
    network = network_of(STAR.format(kind, other), "spice")
    plain, (made,) = without_bridges(network)
    before, after = ends(network), ends(plain)
    known = dict(zip(made.names, values, strict=True))
    numbers = Balls(known)
    triangle = made.forth(numbers, {n: numbers[n] for n in made.names})
    y = {n: 1 / x if kind != "C" else x for n, x in known.items()}
    for name in made.names:
        first, second = (n for n in made.names if n != name)
        flow = y[first] * y[second] / sum(y.values())
        assert fraction(triangle[name]) == (flow if kind == "C" else 1 / flow)
        assert after[name] == before[first] ^ before[second]  # opposite to where it was
    assert made.back(numbers, triangle) == {n: numbers[n] for n in made.names}


@pytest.mark.parametrize(
    ("text", "count"),
    [
        ("R1 1 2; R2 2 3; C1 2 0; C2 3 0; R3 1 3; port 1 0", 1),  # a triangle
        ("R1 1 2; L1 2 3; C1 2 0; C2 3 0; R3 1 3; port 1 0", 0),  # of two kinds
        ("R1 1 2; R2 1 2; R3 2 0; C1 2 0; port 1 0", 0),  # in series and parallel already
        ("C1 1 2; R1 1 3; R2 2 3; C2 2 0; R3 3 0; port 3 0", 0),  # the middle is a port
        (
            "R1 1 4; R2 2 4; R3 3 4; C1 2 0; C2 2 5; C3 3 0; C4 3 5; L1 5 0; L2 1 5; port 1 0",
            0,  # as many edges as before
        ),
    ],
)
def test_only_what_leaves_fewer_edges(text, count):
    network = network_of(text, "spice")
    plain, made = without_bridges(network)
    assert len(made) == count
    assert (plain == network) is (count == 0)
