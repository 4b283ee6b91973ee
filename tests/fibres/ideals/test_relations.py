"""Bounds of algebraic relations against relations that plain SymPy finds, and against known
ones.
"""

from math import log2

import pytest
import sympy as sp
from hypothesis import given, settings, strategies as st

from disting.fibres.ideals.bounds import PolynomialBound, relation

X, Y, A, B, C = sp.symbols("x y a b c")


def bounded(q, variables):
    terms = sp.Poly(q, *variables).terms()
    norm = sum(abs(int(c)) for _, c in terms)
    return PolynomialBound(max(1, *(sum(e) for e, _ in terms)) if terms else 1, log2(max(norm, 1)))


def check(found, polynomials, variables, names):
    """A true, primitive, irreducible relation keeps to the bounds."""
    bounds = relation([bounded(q, variables) for q in polynomials])
    degrees = [bounded(q, variables).degree for q in polynomials]
    substituted = found.subs(dict(zip(names, polynomials, strict=True)), simultaneous=True)
    assert sp.expand(substituted) == 0
    for exponents, number in sp.Poly(found, *names).terms():
        assert sum(d * e for d, e in zip(degrees, exponents, strict=True)) <= bounds.weight
        assert log2(abs(int(number))) <= bounds.bits


one_variable = (
    st.lists(st.integers(-9, 9), min_size=2, max_size=4)
    .filter(lambda c: c[-1])
    .map(lambda c: sum(x * X**i for i, x in enumerate(c)))
)


@pytest.mark.full
@settings(max_examples=40, deadline=None)
@given(one_variable, one_variable)
def test_relations_of_two_polynomials_in_one_variable(p, q):
    """The resultant, and each of its factors."""
    whole = sp.resultant(sp.Poly(p - A, X), sp.Poly(q - B, X), X)
    whole = sp.expand(getattr(whole, "as_expr", lambda: whole)())
    for factor, _ in sp.factor_list(whole, A, B)[1]:
        if sp.expand(factor.subs({A: p, B: q}, simultaneous=True)) == 0:
            check(factor, (p, q), (X,), (A, B))


@pytest.mark.parametrize(
    "polynomials",
    [
        (X * Y, X + Y, X**2 + Y**2),
        (X**2, X * Y, Y**2),
        (X**2 + 3 * Y, X * Y - 7, 5 * Y**2 + X),
        (X, 2 * X + 9, Y),
        (X * Y, X * Y + 4, Y**3),
    ],
    ids=str,
)
def test_relations_of_three_polynomials_in_two_variables(polynomials):
    """By elimination; the second and the last ones have infinitely many common zeros at
    infinity.
    """
    names = (A, B, C)
    basis = sp.groebner(
        [n - q for n, q in zip(names, polynomials, strict=True)], X, Y, *names, order="lex"
    )
    found = [g for g in basis.exprs if not g.free_symbols & {X, Y}]
    assert len(found) == 1
    check(sp.primitive(found[0])[1], polynomials, (X, Y), names)


def test_constants_are_allowed():
    check(A - 5, (sp.Integer(5), X), (X,), (A, B))


@pytest.mark.full
@given(
    st.lists(
        st.builds(PolynomialBound, st.integers(1, 6), st.floats(0, 40)), min_size=2, max_size=12
    ),
    st.integers(0, 11),
)
def test_larger_degrees_and_norms_give_larger_bounds(polynomials, at):
    """So that bounds of degrees and norms serve for polynomials that are smaller."""
    at %= len(polynomials)
    q, found = polynomials[at], relation(polynomials)
    for larger in (PolynomialBound(q.degree + 1, q.norm), PolynomialBound(q.degree, q.norm + 1)):
        other = relation([*polynomials[:at], larger, *polynomials[at + 1 :]])
        assert other.weight >= found.weight and other.bits >= found.bits
