"""Models with numbers of any size: stiffnesses of 10^3 to 10^12, exact decimals. The law is a change
of units: parameters times a positive number are the same models, so no verdict contradicts the
other. (One of the two may be open: points with large numbers are not drawn.)
"""

from fractions import Fraction

import pytest
from hypothesis import given, settings, strategies as st

from disting import Relation, compare
from disting.general.matrix_model import Model

TRANSFER = Model.from_transfer_function
PAIRS = [
    # denominators of the left one, of the right one; A and B are numbers, b and d in units of U
    ("(b/U + A)*(b/U + B)", "d"),
    ("(b/U + A)*(b/U - B)", "d"),
    ("(b/U + A)*(b/U + B)", "(d/U + A)*(d/U + B)"),
    ("(b/U)**2 + A*b/U", "(d/U)**2 - B"),
    ("A*b/U", "B*d/U"),
    ("(b/U - A)**2", "(d/U - B)**2"),
]


def relation(left, right, a, b, unit):
    """The verdict's relation with these numbers in place of A, B and U."""
    pair = []
    for name, text, gain in (("left", left, "a"), ("right", right, "c")):
        for letter, number in (("A", a), ("B", b), ("U", unit)):
            text = text.replace(letter, f"({Fraction(number)})")
        pair.append(TRANSFER([gain], [1, text], name=name))
    return compare(*pair).relation


@pytest.mark.full
def test_factors_that_differ_by_more_than_a_machine_word():
    left = TRANSFER(["a"], [1, "(b+3000000000)*(b+4000000000)"])
    assert compare(left, TRANSFER(["c"], [1, "d"])).relation is Relation.SOMETIMES


numbers = st.integers(1, 5)
decimals = st.decimals("0.001", "999.999", places=3)


@pytest.mark.full
@settings(max_examples=12)
@given(st.sampled_from(PAIRS), numbers, numbers, decimals, st.integers(3, 12))
def test_units_change_no_verdict(pair, a, b, scale, power):
    unit = Fraction(scale) * 10**power
    found = {relation(*pair, a, b, unit), relation(*pair, a, b, 1)} - {Relation.UNDECIDED}
    assert len(found) <= 1
