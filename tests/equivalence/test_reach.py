"""Which part of a model another one reaches: literal conditions, and at random points against lists
of all equivalents, which know no cases.
"""

import random
from fractions import Fraction

import pytest
from sympy import Poly, Symbol, sympify

from disting import network_of
from disting.equivalence.reach import Piece, Reach, inequality, reach
from disting.general.any_model import of_network, on_one_variable
from disting.general.fibre_lists import goal_of, positive

PAIRS = [
    ("1>0, 1>2, 2>0; in 1; out 2", "1>0, 1>2, 2>1; in 2; out 1"),
    ("1>0, 1>2, 2>0; in 1; out 2", "1>0, 1>2, 2>1; in 1; out 2"),
    ("1>0, 1>2, 2>1; in 1; out 2", "1>0, 1>2, 2>1; in 2; out 1"),
    ("R1-p(R2,L1)-p(R3,C1)", "p(R1,L1-p(R2,R3-C1))"),
    ("p(R1,R2-L1,R3-C1)", "p(R1,L1-p(R2,R3-C1))"),
]


def models(*texts):
    return on_one_variable([of_network(network_of(text)) for text in texts])


def test_conditions_are_those_worked_out_by_hand():
    """b0 = a12, a0 = a20 (a10 + a12), a1 = a10 + a12 + a20 of the first; of the second b0 = a21, a0
    = a21 a10, a1 = a10 + a12 + a21 in its own: so a10' = a20 (a10 + a12)/a12, a12' = a10 + a20 -
    a10' = a10 (a12 - a20)/a12.
    """
    assert reach(*models(*PAIRS[0])) == Reach((Piece(("a12 - a20",)),))
    (piece,) = reach(*models(*PAIRS[3])).pieces
    assert piece.positive == (
        "C1**2*R1*R2**3*R3 + 2*C1*L1*R2**2*R3 - L1**2*R1 - L1**2*R2 - L1**2*R3",
        "C1*R2**2 - L1",
        "R2 - R3",
    )
    assert {*map(inequality, piece.positive)} >= {"R2 > R3", "C1*R2**2 > L1"}


@pytest.mark.full
@pytest.mark.sampled(3)
@pytest.mark.parametrize("texts", PAIRS)
@pytest.mark.parametrize("way", [1, -1])
def test_at_random_points_conditions_hold_where_equivalents_are(texts, way):
    given, other = models(*texts)[::way]
    found = reach(given, other)
    if found is None:
        assert (texts, way) in [(PAIRS[3], -1), (PAIRS[4], -1)]  # no short conditions
        return
    seen, draw = [], random.Random("conditions")
    for _ in range(25):
        values = {
            p: Fraction(draw.randint(1, 9999), draw.randint(1, 9999)) for p in given.parameters
        }
        equivalents = positive(goal_of(given, values), other)
        assert holds(found, values) == bool(equivalents), values
        seen.append(bool(equivalents))
    assert {*seen} == ({True} if found.is_everything else {True, False})


def holds(found, values):
    """Whether one of the pieces does, by plain SymPy."""
    put = {Symbol(name): x for name, x in values.items()}
    return any(_holds(piece, put) for piece in found.pieces)


def _holds(piece, put):
    asked = [sympify(text).subs(put) for text in piece.positive]
    if not piece.equation:
        return all(g > 0 for g in asked)
    x = Symbol(piece.root)
    roots = Poly(sympify(piece.equation).subs(put), x).nroots(n=30)
    real = [r for r in roots if abs(r.as_real_imag()[1]) < 1e-20 and r.as_real_imag()[0] > 0]
    return any(all(g.subs(x, r.as_real_imag()[0]) > 0 for g in asked) for r in real)


def test_more_parameters_are_not_asked():
    assert reach(*models("#=1, 1=2; F1; S2", "#=1, #=2, 1=2; F1; S2")) is None


def test_words():
    piece = Piece(("a - x",), "a*b - x**2", "x", "m1")
    assert Reach((piece, Piece(("b - a",)))).sentence("A1", "A2") == (
        "A1 has a positive equivalent A2 exactly where a*b - x**2 = 0 has a positive root x with"
        " a > x, the m1 of A2, or where b > a, special values aside."
    )
    assert Reach((Piece(()),)).sentence("A1", "A2") == Reach(()).sentence("A1", "A2") == ""
