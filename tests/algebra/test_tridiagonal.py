"""Determinants and adjugates of tridiagonal matrices against SymPy, over the integers and over
polynomials.
"""

import pytest
from flint import fmpz_poly
from hypothesis import given, settings, strategies as st
from sympy import Matrix

from disting.algebra.determinants import Tridiagonal

numbers = st.integers(-5, 5)


@st.composite
def tridiagonals(draw):
    n = draw(st.integers(1, 5))
    diagonal = draw(st.lists(numbers, min_size=n, max_size=n))
    return Tridiagonal(
        tuple(diagonal), tuple(draw(st.lists(numbers, min_size=n - 1, max_size=n - 1))), 1
    )


def dense(t):
    n = len(t.diagonal)
    return Matrix(
        n, n, lambda i, j: t.diagonal[i] if i == j else -t.off[min(i, j)] if abs(i - j) == 1 else 0
    )


@pytest.mark.full
@settings(max_examples=60, deadline=None)
@given(tridiagonals())
def test_determinant_and_adjugate(t):
    a = dense(t)
    n, adjugate = a.rows, a.adjugate()
    assert t.determinant == a.det()
    assert [t.adjugate_column(j) for j in range(n)] == [list(adjugate[:, j]) for j in range(n)]
    assert [t.adjugate_diagonal(i) for i in range(n)] == [adjugate[i, i] for i in range(n)]
    assert [t.adjugate_beside(i) for i in range(n - 1)] == [
        adjugate[i, i + 1] for i in range(n - 1)
    ]


@settings(max_examples=30, deadline=None)
@given(tridiagonals())
def test_minors(t):
    a, n = dense(t), len(t.diagonal)
    assert t.leading == [a[:i, :i].det() for i in range(n + 1)]
    assert t.trailing == [a[i:, i:].det() for i in range(n + 1)]


@pytest.mark.parametrize("column", [0, 1, 2])
def test_a_matrix_times_its_adjugate_is_the_determinant_over_polynomials(column):
    s, one = fmpz_poly([0, 1]), fmpz_poly([1])
    t = Tridiagonal((s * s + 3, 2 * s * s + s + 5, 4 * s * s + 2), (s + 3, 2 * one), one)
    entries = t.adjugate_column(column)
    rows = [
        t.diagonal[0] * entries[0] - t.off[0] * entries[1],
        t.diagonal[1] * entries[1] - t.off[0] * entries[0] - t.off[1] * entries[2],
        t.diagonal[2] * entries[2] - t.off[1] * entries[1],
    ]
    assert rows == [t.determinant if i == column else fmpz_poly() for i in range(3)]
