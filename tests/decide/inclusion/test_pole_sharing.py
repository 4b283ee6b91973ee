"""Poles of a smaller model among two rows: SymPy's Groebner bases, known limits that must not
be refuted, and row equations.
"""

from dataclasses import replace
from itertools import product

import pytest
import sympy as sp

from disting import Chain, Family
from disting.algebra.certainty import prime, residues
from disting.decide.inclusion.across_sizes import show_inclusion
from disting.decide.inclusion.pole_sharing import TRIALS, excludes, excluding_points
from disting.decide.inclusion.row_equations import (
    equation_safety,
    label_of,
    model_at,
    row_equation,
)
from disting.model.row import Row
from disting.model.symmetry import canonical


def pair(small, large, damped=False):
    return canonical(Family(3, damped)[small]).chain, canonical(Family(4, damped)[large]).chain


@pytest.mark.full
@pytest.mark.parametrize(
    ("small", "zeros", "grounded", "is_limit"),
    [
        # force and sensor one mass apart, poles in a grounded mass and a free row of three, ends
        # apart
        (2, 1, 1, False),
        (3, 0, 1, True),
        (2, 1, 3, False),
        (3, 0, 3, True),
    ],
)
def test_against_groebner_bases(small, zeros, grounded, is_limit):
    """All c, D_1, D_2 and l_1, l_2 at once, for one model in fractions: n/d = l_1/D_1 + l_2/(t
    D_2) after cancelling c.
    """
    t = sp.Symbol("t")
    free = 4 - grounded
    c, p, q = sp.symbols("c0:2"), sp.symbols(f"p0:{grounded + 1}"), sp.symbols(f"q0:{free}")
    u, v = sp.symbols("u v")  # both rows have force and sensor at their ends, or one mass alone
    n = (2 * t + 5) if zeros else sp.Integer(3)
    d = t * (t + 1) * (t + 4)
    first, second = (
        sum(x * t**i for i, x in enumerate(p)),
        t * sum(x * t**i for i, x in enumerate(q)),
    )
    factor = c[0] + c[1] * t
    equations = [
        sp.expand(factor * n - u * second - v * first),
        sp.expand(factor * d - first * second),
    ]
    rows = [x for e in equations for x in sp.Poly(e, t).all_coeffs()]
    bases = [
        sp.groebner([*rows, at], *c, *p, *q, u, v, order="grevlex") for at in (c[1] - 1, c[0] - 1)
    ]
    assert any(b.exprs != [1] for b in bases) == is_limit
    chains = pair(small, 10 if grounded == 1 else 23)
    assert (excluding_points(*chains, "oracle") == ()) == is_limit


@pytest.mark.full
@pytest.mark.parametrize("damped", [False, True])
def test_no_limit_is_refuted(damped):
    chains = [canonical(c).chain for n in (1, 2, 3) for c in Family(n, damped)]
    larger = [canonical(Family(4, damped)[i]).chain for i in (10, 16, 23)] + [
        c for c in chains if c.n_masses == 3
    ]
    seen = [
        (show_inclusion(a, b, False) is not None, excluding_points(a, b, "law") != ())
        for a, b in product(chains, larger)
        if a.n_masses < b.n_masses
    ]
    assert (True, True) not in seen and (True, False) in seen and (False, True) in seen


@pytest.mark.full
def test_one_point_is_a_proof_and_is_checked_again():
    small, large = pair(1, 16, damped=True)
    points = excluding_points(small, large, "one")
    assert len(points) == 1 and excludes(small, large, "one", points)
    assert not excludes(small, large, "other", points)
    assert not excludes(small, large, "one", ())
    assert not excludes(small, large, "one", (points[0][:-1],))
    inside = canonical(Family(3, True)[2]).chain
    assert show_inclusion(inside, large, False) is not None
    assert not any(
        excludes(inside, large, f"trial {k}", (tuple(residues(f"{k}", 7, 10**6)),))
        for k in range(20)
    )


@pytest.mark.full
def test_an_equation_of_the_grounded_row_refutes_with_a_bound():
    small, large = pair(3, 14, damped=True)
    points = excluding_points(small, large, "several")
    assert len(points) == TRIALS and excludes(small, large, "several", points)
    assert not excludes(small, large, "several", points[:1])
    assert not excludes(small, large, "several", points[:2])


@pytest.mark.parametrize("more", [{"lag": True}, {"ground_dampers": (1,)}])
def test_what_is_not_covered_is_not_refuted(more):
    small, large = pair(1, 16, damped=True)
    assert excluding_points(replace(small, **more), replace(large, **more), "x") == ()
    assert excluding_points(small, Chain(4, damped=True), "x") == ()
    assert excluding_points(canonical(Family(3, damped=False)[1]).chain, large, "x") == ()


@pytest.mark.full
def test_the_equation_of_two_grounded_masses_by_hand():
    """Force and sensor at the inner mass: D = -w^2 modulo N, up to a factor, where w is the
    linear part of N.
    """
    s = sp.Symbol("s")
    b, a = sp.symbols("b0:3"), sp.symbols("a0:5")
    num, linear = b[0] + b[1] * s + b[2] * s**2, b[0] + b[1] * s
    rests = [
        sp.Poly(sp.rem(x, num, s), s).all_coeffs()
        for x in (sum(x * s**i for i, x in enumerate(a)), linear**2)
    ]
    by_hand = sp.fraction(sp.factor(rests[0][0] * rests[1][1] - rests[0][1] * rests[1][0]))[0]
    found = row_equation(Row(2, True, 1, 1, True), "hand")
    names = (*b, *a)
    terms = [
        int(c) * sp.prod(names[i] for i in m)
        for c, m in zip(found.numbers, found.monomials, strict=True)
    ]
    theirs = sp.Poly(sum(terms), *names, modulus=found.modulus)
    factors = [sp.Poly(f, *names, modulus=found.modulus) for f, _ in sp.factor_list(by_hand)[1]]
    assert any(f.monic() == theirs.monic() for f in factors)
    assert found.modulus == prime("hand") and equation_safety(Row(2, True, 1, 1, True)) >= 45


@pytest.mark.full
def test_equations_hold_in_other_models_and_not_elsewhere():
    row = Row(2, True, 2, 2, True)
    found = row_equation(row, "models")
    m1, m2, k0, k1, d0, d1 = residues("models", 6, 10**6)
    inner, outer = [k0 + k1, d0 + d1, m1], [k1, d1, m2]
    den = [
        sum(inner[i] * outer[j] for i in range(3) for j in range(3) if i + j == n) for n in range(5)
    ]
    den = [x - y for x, y in zip(den, (k1 * k1, 2 * k1 * d1, d1 * d1, 0, 0), strict=True)]
    assert found.holds((*inner, *den)) and not found.holds((*inner, *den[:-1], den[-1] + 1))
    assert len(found.monomials[0]) == 8


@pytest.mark.full
def test_rows_with_any_coefficients_have_no_equation():
    assert row_equation(Row(1, True, 1, 1, True), "none") is None
    assert row_equation(Row(2, True, 1, 2, True), "none") is None


@pytest.mark.full
def test_coefficients_are_polynomials_also_where_the_lowest_vanish():
    """Springs and dampers that are 0 modulo 5 do not shift the coefficients of such a model."""
    row, modulus, s = Row(2, True, 1, 1, True), 5, sp.Symbol("s")
    for masses in product((1, 3), repeat=2):
        for k0, k1, d0, d1 in product((0, 5), (0, 2, 5), (0, 3), (0, 4)):
            (m1, m2), names = masses, row.structure.parameters
            values = {"m1": m1, "m2": m2, "k01": k0, "k12": k1, "d01": d0, "d12": d1}
            outer, inner = sp.Poly([m2, d1, k1], s), sp.Poly([m1, d0 + d1, k0 + k1], s)
            den = outer * inner - sp.Poly([d1, k1], s) ** 2
            plain = [
                p.coeff_monomial(s**i) % modulus
                for p, top in ((outer, 2), (den, 4))
                for i in range(top + 1)
            ]
            assert model_at(row, [values[name] for name in names], modulus) == tuple(plain)


def test_the_label_of_a_row_stays_as_it_is_stored():
    """It stands in labels of stored evidence, from which primes and points are drawn again."""
    stored = "Row(n_masses=2, walled=True, act=2, meas=2, damped=True, ground_dampers=())"
    assert label_of(Row(2, True, 2, 2, True)) == stored
