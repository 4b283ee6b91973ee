"""The independent programs against truths derived by hand: a program that is always of one mind
would fail here.
"""

from random import Random

import pytest

from disting import InputError
from tests.oracles import plain_by_sympy
from tests.oracles.drawn_models import pair
from tests.oracles.plain_models import (
    Plain,
    Zeros,
    by_elimination,
    by_fibres,
    shaped_zeros,
    truth,
    zeros,
)
from tests.oracles.singular import PROGRAM

needs_singular = pytest.mark.skipif(not PROGRAM, reason="Singular is not installed")


def quotient(parameters, above, below):
    return Plain(tuple(parameters), ((below,),), ("1",), ("1",), above=above)


POLES, SUMS = quotient("ab", "1", "(s+a)*(s+b)"), quotient("uv", "1", "s^2+u*s+v")
PAIRS = [
    (POLES, SUMS, True),  # sums and products of two numbers
    (quotient("a", "(a-1)^2", "s+1"), quotient("uv", "u*v", "s+1"), True),  # both: any gain
    # 2/(s+3) and 5/(s+3)
    (quotient("a", "2*a", "a*(s+3)"), quotient("b", "5*b", "b*(s+3)"), False),
    (quotient("a", "2*a", "a*(s+3)"), quotient("b", "4*b", "2*b*(s+3)"), True),
    # curves y = x^2, y = 2 x^2
    (quotient("a", "a", "s^2+a*s+a^2"), quotient("b", "b", "s^2+b*s+2*b^2"), False),
    (quotient("a", "a^2", "s^2+a^2*s+a^4"), quotient("b", "b", "s^2+b*s+b^2"), True),  # one curve
    (quotient("ab", "s+a", "(s+a)*(s+b)"), quotient("c", "1", "s+c"), True),  # a cancels
    (quotient("ab", "a*b", "s+a*b"), quotient("cd", "c", "s+d"), False),  # ranks 1 and 2
]


@needs_singular
@pytest.mark.parametrize(("left", "right", "expected"), PAIRS)
def test_singular(left, right, expected):
    assert by_elimination(left, right).same is by_fibres(left, right, Random(1)).same is expected


@pytest.mark.slow
@pytest.mark.parametrize(("left", "right", "expected"), PAIRS)
def test_sympy(left, right, expected):
    assert plain_by_sympy.same(left, right, Random(1)) is expected


@pytest.mark.full
@needs_singular
@pytest.mark.parametrize(
    ("u", "v", "expected"), [("3", "2", (2, 2, 2)), ("-3", "2", (2, 2, 0)), ("1", "2", (2, 0, 0))]
)
def test_zeros(u, v, expected):
    """The roots of x^2 - u x + v: 1 and 2; -1 and -2; complex ones."""
    values = {"u": u, "v": v}
    assert zeros(SUMS, values, POLES) == Zeros(0, *expected)
    assert shaped_zeros(SUMS, values, POLES, Random(1)) == Zeros(0, *expected)


@needs_singular
def test_no_zeros_and_infinitely_many():
    values = {"u": "3", "v": "2"}
    assert zeros(SUMS, values, quotient("ab", "2", "(s+a)*(s+b)")) == Zeros(-1)
    assert zeros(SUMS, values, quotient("abc", "1", "(s+a)*(s+b*c)")).dimension == 1


@needs_singular
@pytest.mark.slow
def test_programs_agree_on_drawn_models():
    compared = 0
    for k in range(25):
        draw = Random(f"programs:{k}")
        try:
            _, left, right = pair(draw)
            left.model("left"), right.model("right")  # refused where a transfer function is zero
        except InputError:
            continue
        here, there = (
            truth(left.plain(), right.plain(), draw),
            plain_by_sympy.same(left.plain(), right.plain(), draw),
        )
        if here is not None and there is not None:
            assert here.same is there, k
            compared += 1
    assert compared > 10
