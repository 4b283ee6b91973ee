"""Lowest terms of a quotient and the derivatives of its coefficients, against SymPy's formulas."""

from fractions import Fraction

import pytest
from flint import nmod_poly
from hypothesis import given, strategies as st
from sympy import Poly, cancel, fraction, series, symbols

from disting.algebra.quotient import (
    coefficient_rows,
    constant,
    lowest_terms,
    matrix,
    rational,
    series_rows,
    variable,
)

P = 2**61 - 1
s, x, y, z = symbols("s x y z")
POINT = {x: 1234567, y: 7654321, z: 1122334455}


def residue(expression):
    top, bottom = fraction(cancel(expression).subs(POINT))
    return int(top) * pow(int(bottom), -1, P) % P


def in_s(expression):
    """The polynomial in s at the point, modulo P."""
    return nmod_poly([residue(c) for c in reversed(Poly(expression, s).all_coeffs())], P)


def found(num, den):
    slopes = [[in_s(part.expand().diff(p)) for p in POINT] for part in (num, den)]
    return lowest_terms(in_s(num), in_s(den), *slopes)


def expected_rows(polynomial, leading):
    """(coefficient/leading, its derivatives) from the lowest power up."""
    monic = [c / leading for c in reversed(Poly(polynomial, s).all_coeffs())]
    return [residue(c) for c in monic], [[residue(c.diff(p)) for p in POINT] for c in monic]


CASES = [
    pytest.param(x * s + y, z * s**2 + x * s + 3, 1, id="nothing in common"),
    pytest.param(x * s + y, z * s**2 + x * s + 3, s**2, id="a power of s"),
    pytest.param(x * s + y, z * s**2 + x * s + 3, s + x * y, id="a factor"),
    pytest.param(x * s + y, z * s**2 + x * s + 3, z * s + x, id="a factor that is not monic"),
    pytest.param(
        x * s + y, z * s**2 + x * s + 3, s * (y * s**2 + z * s + 1), id="a factor and a power of s"
    ),
    pytest.param(x * y + 0 * s, z * s + y, x * s + z, id="a constant numerator"),
    pytest.param(x * s**2 + y, 0 * s + z, s + x, id="a constant denominator"),
    pytest.param(x + 0 * s, y + 0 * s, s**2 + z, id="all in common"),
    pytest.param(x * s**3 + y * s, s**2 + z, y * s + 1, id="a numerator of higher degree"),
]


@pytest.mark.thin(1)
@pytest.mark.parametrize(("num", "den", "factor"), CASES)
def test_lowest_terms_and_their_derivatives(num, den, factor):
    q = found(num * factor, den * factor)
    leading = Poly(den, s).LC()
    for part, slopes, formula in ((q.num, q.num_derivatives, num), (q.den, q.den_derivatives, den)):
        values, rows = expected_rows(formula, leading)
        assert coefficient_rows(part, slopes, len(values)) == (values, rows)
        assert part.degree() == len(values) - 1
        assert all(d.degree() < len(values) for d in slopes)


@pytest.mark.full
@pytest.mark.parametrize(("num", "den", "factor"), CASES[:6])
def test_the_series_at_infinity_and_its_derivatives(num, den, factor):
    t = symbols("t")
    expansion = series(cancel((num / den).subs(s, 1 / t)), t, 0, 5).removeO()
    terms = [expansion.coeff(t, i) for i in range(5)]
    values, rows = series_rows(found(num * factor, den * factor), 4)
    assert values == [residue(c) for c in terms]
    assert rows == [[residue(c.diff(p)) for p in POINT] for c in terms]


def test_coefficients_without_parameters():
    assert coefficient_rows(nmod_poly([1, 2], 7), [], 3) == ([1, 2, 0], [[], [], []])


def test_small_builders():
    assert variable(7) == nmod_poly([0, 1], 7)
    assert constant(9, 7) == nmod_poly([2], 7)
    assert matrix([[1, 2], [3, 4], [5, 13]], 2, 11).tolist() == [[1, 2], [3, 4], [5, 2]]
    assert matrix([], 2, 11).rank() == 0


@given(st.integers(-(10**8), 10**8), st.integers(1, 10**8))
def test_a_fraction_is_found_from_its_residue(top, bottom):
    assert rational(top * pow(bottom, -1, P) % P, P) == str(Fraction(top, bottom))


@pytest.mark.parametrize(
    ("residue_", "text"), [(0, "0"), (1, "1"), (P - 1, "-1"), (pow(2, -1, P), "1/2"), (P - 7, "-7")]
)
def test_small_numbers_are_themselves(residue_, text):
    assert rational(residue_, P) == text
