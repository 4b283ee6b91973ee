"""Renamings of variables: planted ones are found again, all of them, and where there are none,
none is found.
"""

from itertools import permutations

import pytest
from flint import Ordering, fmpz_mpoly_ctx
from hypothesis import assume, given, settings, strategies as st

from disting.algebra.colouring import colouring, renamings
from disting.algebra.symbols import coefficients, rename_symbols, symbols

P = 2**61 - 1
NAMES = ("p", "q", "r", "t")
RING = fmpz_mpoly_ctx.get(NAMES, Ordering.lex)


def polynomial(terms):
    """From {exponents: coefficient}."""
    return RING.from_dict(terms)


def moved(functions, permutation):
    """The functions with variable i called permutation[i]."""
    return [
        polynomial(
            {
                tuple(powers[permutation.index(i)] for i in range(4)): int(c)
                for powers, c in f.to_dict().items()
            }
        )
        for f in functions
    ]


def columns(functions):
    """What `renamings` asks for: values and, per variable, a column of derivatives."""

    def look(point):
        values = tuple(int(f(*point)) % P for f in functions)
        return values, [
            tuple(int(f.derivative(i)(*point)) % P for f in functions) for i in range(4)
        ]

    return look


def found(left, right):
    return [c for c in renamings(columns(left), columns(right), 4) if moved(left, c) == right]


def all_renamings(left, right):
    return [c for c in permutations(range(4)) if moved(left, c) == right]


exponents = st.tuples(*[st.integers(0, 2)] * 4)
functions = st.lists(
    st.dictionaries(exponents, st.integers(1, 3), min_size=1, max_size=4).map(polynomial),
    min_size=1,
    max_size=3,
)
any_order = st.permutations(range(4)).map(tuple)
often = settings(max_examples=80, deadline=None)


@pytest.mark.full
@often
@given(functions, any_order)
def test_a_planted_renaming_is_among_all_that_are_found(left, planted):
    right = moved(left, planted)
    assert sorted(found(left, right)) == all_renamings(left, right)
    assert planted in found(left, right)


@pytest.mark.full
@often
@given(functions, functions)
def test_nothing_is_found_where_there_is_nothing(left, right):
    assert sorted(found(left, right)) == all_renamings(left, right)


@pytest.mark.full
@often
@given(functions, functions, any_order)
def test_fingerprints_are_equal_for_renamings(left, right, planted):
    one, other, planted_one = (
        colouring(columns(f), ("",) * 4).fingerprint for f in (left, right, moved(left, planted))
    )
    assert one == planted_one
    if one != other:
        assert all_renamings(left, right) == []


@pytest.mark.full
@often
@given(functions, any_order)
def test_colours_move_with_the_variables(left, planted):
    before, after = (
        colouring(columns(left), ("",) * 4),
        colouring(columns(moved(left, planted)), ("",) * 4),
    )
    assert [after.colours[image] for image in planted] == list(before.colours)


P_, Q_, R_, T_ = RING.gens()


@pytest.mark.parametrize(
    ("left", "number"),
    [
        ([P_ + Q_ + R_ + T_], 24),
        ([P_ * Q_ + R_ * T_], 8),
        ([P_ * Q_ + Q_ * R_ + R_ * T_ + T_ * P_], 8),
        ([P_ * Q_ + Q_ * R_ + R_ * T_], 2),
        ([P_ + 2 * Q_, R_ + 2 * T_], 1),
        ([P_ * Q_, R_ * T_], 4),
        ([P_ + Q_**2], 2),  # r and t do not occur
    ],
)
def test_ties_are_all_broken(left, number):
    assert len(found(left, left)) == len(all_renamings(left, left)) == number


@pytest.mark.parametrize(
    ("left", "right"),
    [
        ([P_ + Q_, P_ * Q_], [P_ + Q_, P_ * R_]),
        ([P_ + Q_], [P_ + Q_, P_ * Q_]),
        ([P_ + Q_], [P_ + 2 * Q_]),
        ([P_, Q_], [P_, P_]),
        ([P_ * Q_ + Q_ * R_ + R_ * P_], [P_ * Q_ + Q_ * R_ + R_ * T_]),
    ],
)
def test_lists_that_differ_have_no_candidates(left, right):
    assert list(renamings(columns(left), columns(right), 4)) == []


@pytest.mark.full
@often
@given(functions, any_order)
def test_one_wrong_function_spoils_a_renaming(left, planted):
    right = moved(left, planted)
    assume(right[0] + 1 != right[0])
    assert list(renamings(columns(left), columns([right[0] + 1, *right[1:]]), 4)) == []


def test_symbols_renamed_and_their_coefficients():
    ring, other = symbols(["s", "m1", "k1"]), symbols(["s", "k2", "m2"])
    f = 3 * ring["s"] ** 2 * ring["m1"] + ring["k1"] * ring["m1"] - 2
    g = rename_symbols(f, other, {"m1": "m2", "k1": "k2"})
    assert g == 3 * other["s"] ** 2 * other["m2"] + other["k2"] * other["m2"] - 2
    assert [str(c) for c in coefficients(g, "s")] == ["k2*m2 - 2", "0", "3*m2"]
    assert [str(c) for c in coefficients(g, "m2")] == ["-2", "3*s^2 + k2"]
