"""Random networks against Kirchhoff's and Newton's laws: the same transfer functions, in lowest
terms, and the same networks without any.
"""

import random
from fractions import Fraction
from math import prod

import pytest
from hypothesis import assume, given, settings, strategies as st
from sympy import ZZ, ring

from disting.errors import InputError
from disting.general.any_model import of_network
from disting.network import Element, Network, Port, network_of
from tests.network.drawn import built, descriptions
from tests.oracles.plain_network import response

POINTS = 3


def is_as_the_laws_say(description, seed):
    network = built(description)
    assume(not isinstance(network, str) and network.parameters)
    draw = random.Random(seed)
    points = [
        (
            {p: draw.randrange(1, 10**9) for p in (*network.parameters, *network.exponents)},
            draw.randrange(1, 10**9),
        )
        for _ in range(POINTS)
    ]
    expected = [response(network, values, root) for values, root in points]
    try:
        model = of_network(network)
    except InputError as problem:
        entries = [y for matrix in expected for line in matrix for y in line]
        # so are machines without gears: also where only differences are seen
        loose = "hangs on gears alone and has nothing that holds it" in str(problem)
        assert None in entries or not any(entries) or loose
        return
    assert model.parameters == network.parameters
    for (values, root), matrix in zip(points, expected, strict=True):
        seen = [0 if e is None else value(e, values, root) for e in model.cells]
        assert seen == [y for line in matrix for y in line]
    assert all(is_in_lowest_terms(e) for e in model.entries)


def value(model, values, root):
    """G at these values, this root of s, and values of s^n by the name of n."""
    bases = [root if model.powers.halves else root**2]
    bases += [values[name] for name in model.powers.exponents]
    point = [values[p] for p in model.parameters]
    top, bottom = (
        sum(polynomial(c, point) * power(bases, model.powers.parts(i)) for i, c in enumerate(side))
        for side in (model.numerator_terms, model.denominator_terms)
    )
    return Fraction(top, bottom)


def power(bases, parts):
    return prod(base**part for base, part in zip(bases, parts, strict=True))


def polynomial(terms, point):
    total = 0
    for exponents, number in terms:
        for x, e in zip(point, exponents, strict=True):
            number *= x**e
        total += number
    return total


def is_in_lowest_terms(model):
    """By SymPy, over the integers."""
    domain, *_ = ring(["s", *model.parameters], ZZ)
    top, bottom = (
        domain.from_dict({(i, *e): c for i, terms in enumerate(side) for e, c in terms})
        for side in (model.numerator_terms, model.denominator_terms)
    )
    return top.gcd(bottom) in (1, -1)


@pytest.mark.full
@settings(max_examples=60)
@given(descriptions(), st.integers(0, 2**32))
def test_transfer_functions_of_networks(description, seed):
    is_as_the_laws_say(description, seed)


@pytest.mark.slow
@settings(max_examples=3000)
@given(descriptions(), st.integers(0, 2**32))
def test_transfer_functions_of_many_networks(description, seed):
    is_as_the_laws_say(description, seed)


def test_what_a_port_does_not_see_changes_nothing():
    assert text("R1 1 2; R2 2 0; port 1 2") == "G(s) = R1"
    # what flows to compartments that do not reach the output is lost
    assert text("1>2, 2>3; in 1; out 1") == "G(s) = 1/(a12 + s)"
    # a sensor between which nothing moves shows nothing
    r = [Element("R1", "R", (1, 2)), Element("R2", "R", (2, 0))]
    two = Network(tuple(r), (Port(1, 2),), (Port(1, 2), Port(2, 0)))
    assert str(of_network(two)) == "G(s) = [[R1], [0]]"


def test_a_port_needs_a_way_between_its_ends():
    floating = Element("R1", "R", (1, 2))
    with pytest.raises(InputError, match="between nodes 2 and 0, which no elements connect"):
        Network((floating,), (Port(2, 0),), (Port(2, 0),))
    massless = Element("k1", "k", (1, 2))
    for port in (Port(2, 0), Port(2, 1)):  # though differences have a response
        with pytest.raises(InputError, match="node 1 has no mass and is not connected"):
            Network((massless,), (port,), (port,))
    geared = Element("k1", "k", (1, 2), "3"), Element("k2", "k", (2, 3), "1/3")
    loose = Network(geared, (Port(1, 3),), (Port(1, 3),))
    with pytest.raises(InputError, match=r"node 1 hangs on gears alone and .* give it a mass"):
        of_network(loose)
    held = Network((*geared, Element("m2", "m", (2,))), loose.inputs, loose.outputs)
    assert str(of_network(held)) == "G(s) = (9*k1 + k2)/(k1*k2)"
    flow = Element("", "v", (1,)), Element("", "v", (2,)), Element("a12", "a", (1, 2))
    with pytest.raises(InputError, match="of compartments it is at one"):
        Network(flow, (Port(1),), (Port(2, 1),))


def text(description):
    return str(of_network(network_of(description)))
