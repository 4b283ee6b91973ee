"""Factors of polynomials with coefficients of any size; the oracle is SymPy."""

from math import prod

import pytest
import sympy
from hypothesis import given, settings, strategies as st

from disting.algebra.symbols import factorise, symbols

X, Y = symbols(["x", "y"]).values()
SIZES = [2**30, 2**31, 2**32, 2**62, 2**63, 2**64, 2**200]


@pytest.mark.parametrize("size", SIZES)
def test_literal_factors_of_every_size(size):
    number, found = factorise(-12 * (X + size) * (X - size) * (X + size + 1) * (size * X + Y) ** 2)
    assert number == -12
    assert set(map(str, (f for f, e in found if e == 1))) == {
        f"x + {size}",
        f"x - {size}",
        f"x + {size + 1}",
    }
    assert [(str(f), e) for f, e in found if e == 2] == [(f"{size}*x + y", 2)]


def test_numbers_have_no_factors():
    assert factorise(0 * X + 2**70) == (2**70, [])


numbers = st.integers(-9, 9) | st.sampled_from([s + d for s in SIZES for d in (-1, 0, 1)])
terms = st.tuples(st.integers(0, 2), st.integers(0, 2), numbers)
polynomials = st.lists(st.lists(terms, min_size=1, max_size=3), min_size=1, max_size=3)


@pytest.mark.full
@settings(max_examples=40)
@given(polynomials)
def test_factors_are_those_of_sympy(sides):
    x, y = sympy.symbols("x y")
    ours, theirs = 0 * X + 1, sympy.Integer(1)
    for side in sides:
        ours *= sum((c * X**a * Y**b for a, b, c in side), 0 * X)
        theirs *= sum(c * x**a * y**b for a, b, c in side)
    if ours.is_zero():
        return
    number, found = factorise(ours)
    assert prod((f**e for f, e in found), start=0 * X + number) == ours
    _, wanted = sympy.factor_list(sympy.expand(theirs), x, y)
    spelled = {(sympy.sympify(str(f).replace("^", "**")).expand(), e) for f, e in found}
    assert spelled <= {((sign * f).expand(), e) for f, e in wanted for sign in (1, -1)}
    assert len(spelled) == len(found) == len(wanted)
