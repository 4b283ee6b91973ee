"""Models made to mislead: constants that agree modulo the first public prime, nothing left to
vary, signs that never meet.
"""

import pytest

from disting import InputError, Model, Query, Relation, View, compare
from disting.algebra.certainty import prime

MODEL = Model.from_transfer_function
FIRST = prime("disting:0")


@pytest.mark.parametrize("view", [View.EXACT, View.MARKOV, View.TF])
def test_a_constant_markov_parameter_is_compared_exactly(view):
    """(a s + a b + c)/(s + b) has G0 = a, G1 = c, G2 = -b c: 7 is not 7 + p, whatever they are
    modulo p.
    """
    one, other = (MODEL(["a", f"a*b + {c}"], ["1", "b"]) for c in (7, 7 + FIRST))
    assert compare(one, other, query=Query(view)).relation is not Relation.INDISTINGUISHABLE
    if view is View.EXACT:
        assert compare(one, other, query=Query(view)).relation is Relation.DISTINGUISHABLE


@pytest.mark.thin(8)
@pytest.mark.parametrize("view", [View.EXACT, View.REAL, View.POSITIVE])
@pytest.mark.parametrize(
    ("one", "other"),
    [(2, 5), (2, -2), (10**30, 10**30 + 1), (7, 7 + FIRST), ("1/3", "333333/1000000")],
)
def test_unequal_constants_of_rank_0_are_told_apart(one, other, view):
    left, right = (MODEL([f"({c})*{p}"], [p, f"3*{p}"]) for c, p in ((one, "a"), (other, "b")))
    for pair in ((left, right), (right, left)):
        assert compare(*pair, query=Query(view)).relation is Relation.DISTINGUISHABLE


@pytest.mark.parametrize("view", [View.EXACT, View.REAL, View.POSITIVE])
def test_equal_constants_of_rank_0_are_the_same(view):
    """All values of all parameters give 2/(s + 3), however many parameters there are."""
    left, right = MODEL(["2*a"], ["a", "3*a"]), MODEL(["2*b*c"], ["b*c", "3*b*c"])
    assert compare(left, right, query=Query(view)).relation is Relation.INDISTINGUISHABLE


@pytest.mark.full
@pytest.mark.parametrize(
    ("left", "right", "expected"),
    [
        (["a"], ["-b"], Relation.DISTINGUISHABLE),  # of opposite signs
        (["a"], ["b**2"], Relation.INDISTINGUISHABLE),  # b = sqrt(a)
        (["a"], ["b**3"], Relation.INDISTINGUISHABLE),
        (["a*b"], ["c**2"], Relation.INDISTINGUISHABLE),
        (["a+b"], ["c"], Relation.INDISTINGUISHABLE),
        (["a+b"], ["-c"], Relation.DISTINGUISHABLE),
        (["a"], ["b**2+1"], Relation.SOMETIMES),  # a > 1
        (["(a-1)**2"], ["u*v"], Relation.INDISTINGUISHABLE),  # but for a = 1, which is special
    ],
)
def test_gains_over_positive_parameters(left, right, expected):
    for pair in ((left, right), (right, left)):
        models = (MODEL(gain, ["1", "1"]) for gain in pair)
        assert compare(*models, query=Query(View.POSITIVE)).relation is expected


@pytest.mark.full
def test_a_root_of_odd_degree_is_real():
    left, right = MODEL(["a"], ["1", "1"]), MODEL(["b**3"], ["1", "1"])
    assert compare(left, right, query=Query(View.REAL)).relation is Relation.INDISTINGUISHABLE


def test_numbers_of_many_digits_are_compared_or_refused():
    """More than 4300 digits are not written as text by Python."""
    try:
        one, other = (MODEL([f"a + (10**1000)**5 + {c}*b", "a*b"], ["1", "1"]) for c in (1, 2))
        assert compare(one, other).relation is not Relation.UNDECIDED
    except InputError:
        pass
