"""What networks give at special values too. The oracle puts all values of a small set into the
impedance, cancels, and counts poles: it knows of no theorem.
"""

from fractions import Fraction
from itertools import permutations, product

import pytest
from sympy import QQ, Poly, Symbol

from disting.network.exact import within
from disting.network.families import FAMILIES
from disting.network.notation import network_of

S = Symbol("s")
LARGER = (
    "p(R1,C1)-p(R2,C2)-p(R3,C3)",
    "p(R1,R2-C1,R3-C2)-p(R4,C3)",
    "C1-p(R1-C2,R2-C3)",
    "p(C1,R1-p(R2,C2)-p(R3,C3))",
)
KNOWN = [
    # inner, outer, and both ways
    ("p(C1,R1-p(C2,R2))", "p(R1,C1)-p(R2,C2)", True, False),
    ("R1-p(R2,C1)-p(R3,C2)", "p(R1,R2-C1,R3-C2)", True, True),
    ("R1-p(R2,C1)", "R1-p(R2,C1)-p(R3,C2)", True, False),
    ("R1-C1", "p(R1-C1,R2-C2)", True, False),
    ("p(R1,L1)-p(R2,R3-C1)", "R1-p(R2,L1)-p(R3,C1)", True, True),
    ("1~2~3; F1; S1", "1~2, 1~3; F1; S1", True, False),
    ("1~2~3~4; F1; S1", "1~2, 1~3, 3~4; F1; S1", True, False),
    # two masses hang at the middle of a machine: nothing is said of the converse
    ("1~2~3, 2~4~5; F1; S3", "1~2~3, 2~4, 2~5; F1; S3", True, None),
    # other kinds, a sensor that is turned, exponents, gears, compartments
    ("p(R1,C1)-p(R2,C2)", "p(R1,L1)-p(R2,L2)", None, None),
    ("1~2; F1:2; S1:2", "1~2; F1:2; S2:1", None, None),
    ("R1-p(R2,P1)", "p(R1,R2-P1)", None, None),
    ("1~2*g; F1; S2", "1~2*g; F1; S2", None, None),
    ("1>2, 2>1; in 1; out 1", "1>2, 2>1; in 1; out 1", None, None),
]


class Impedance:
    """n/d; a - b is a series, p(a, b, ..) parallel, as the notation has it."""

    def __init__(self, top, bottom):
        self.top, self.bottom = top, bottom

    def __sub__(self, other):
        top = self.top * other.bottom + other.top * self.bottom
        return Impedance(top, self.bottom * other.bottom)


def p(*branches):
    first, *others = (Impedance(z.bottom, z.top) for z in branches)
    for z in others:
        first -= z
    return Impedance(first.bottom, first.top)


def reached(text):
    """(Number of poles away from 0, whether there is a constant at infinity, a pole at 0) for all
    values of a small set.
    """
    names = network_of(text).parameters
    one, s = Poly(1, S, domain=QQ), Poly(S, S, domain=QQ)
    found = set()
    for values in product((1, 2), repeat=len(names)):
        known = {
            name: Impedance(value * one, one) if name[0] == "R" else Impedance(one, value * s)
            for name, value in zip(names, values, strict=True)
        }
        z = eval(text, {"p": p, **known})
        top, bottom = z.top.cancel(z.bottom, include=True)
        at_zero = bottom.eval(0) == 0
        order = bottom.degree() - at_zero
        found.add((order, top.degree() == bottom.degree(), at_zero))
    return found


RC = [
    n.name
    for n in FAMILIES["circuits-5"].networks
    if {e.letter for e in n.elements} == {"R", "C"} and ";" not in n.name
]


@pytest.fixture(scope="module")
def orders():
    return {text: reached(text) for text in (*RC, *LARGER)}


@pytest.mark.full
def test_one_network_is_within_another_one_exactly_where_its_orders_are(orders):
    networks = {text: network_of(text) for text in orders}
    held = 0
    for inner, outer in permutations(orders, 2):
        found = within(networks[inner], networks[outer])
        assert found == (orders[inner] <= orders[outer]), (inner, outer)
        held += found
    assert len(RC) == 34 and held > 100


@pytest.mark.thin(8)
@pytest.mark.parametrize(("inner", "outer", "there", "back"), KNOWN)
def test_both_ways(inner, outer, there, back):
    one, other = network_of(inner), network_of(outer)
    assert (within(one, other), within(other, one)) == (there, back)


def test_a_special_impedance_is_that_of_the_other_network():
    """R1 = 1, R2 C1 = R3 C2: Z = 1 + (R2 + R3)/(1 + s R2 C1), put into p(R1, R2-C1, R3-C2)."""
    r, c = [Fraction(1), Fraction(2), Fraction(4)], [Fraction(6), Fraction(3)]
    total, rate = r[1] + r[2], 1 / (r[1] * c[0])
    assert rate == 1 / (r[2] * c[1])
    # 1/Z has the one zero -rate and the one pole -b, b = rate (R1 + total)/R1; its term is shared
    b = rate * (r[0] + total) / r[0]
    lowest, highest = 1 / (r[0] + total), 1 / r[0]
    half = (highest - lowest) / 2
    theirs = {"R1": 1 / lowest, "R2": 1 / half, "R3": 1 / half, "C1": half / b, "C2": half / b}
    assert all(x > 0 for x in theirs.values())
    for s in map(Fraction, (1, 2, 5, "1/3")):
        mine = r[0] + sum(a / (1 + s * a * b) for a, b in zip(r[1:], c, strict=True))
        branches = ((theirs[f"R{i}"] + 1 / (s * theirs[f"C{j}"])) for i, j in ((2, 1), (3, 2)))
        assert 1 / mine == 1 / theirs["R1"] + sum(1 / z for z in branches)


@pytest.mark.full
def test_what_never_falls_together_has_one_order(orders):
    """Cauer's ladders determine the order, Foster's forms do not."""
    one = [text for text, found in orders.items() if len(found) == 1]
    assert {"p(C1,R1-p(R2,C2))", "R1-p(R2,C1)"} <= set(one)
    assert not {"p(R1,C1)-p(R2,C2)", "p(R1-C1,R2-C2)"} & set(one)
    sizes = [len(found) for found in orders.values()]
    assert max(sizes) == 3 and all(
        {m for m, *_ in found} == set(range(min(found)[0], max(found)[0] + 1))
        for found in orders.values()
    )
