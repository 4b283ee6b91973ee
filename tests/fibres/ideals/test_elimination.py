"""Gröbner bases and solutions against SymPy, contradictions against plain Macaulay matrices."""

import random

import pytest
import sympy
from hypothesis import given, settings, strategies as st

from disting.algebra.groebner.elimination import TooLarge, basis_steps, free_variable, solution
from disting.algebra.groebner.modular import Order
from disting.fibres.ideals.confirm import reaches_one

P = 10007


def computed(generators, size, modulus=P):
    *_, basis = basis_steps(generators, size, modulus)
    return basis


def leading_by_sympy(generators, size, modulus=P):
    xs = sympy.symbols(f"x0:{size}")
    written = [
        sum(c * sympy.prod(x**e for x, e in zip(xs, m, strict=True)) for m, c in g.items())
        for g in generators
    ]
    basis = sympy.groebner(written, *xs, order="grevlex", modulus=modulus)
    return {p.monoms(order="grevlex")[0] for p in basis.polys}


def polynomials(size):
    exponents = st.tuples(*[st.integers(0, 2)] * size)
    return st.dictionaries(exponents, st.integers(1, P - 1), min_size=1, max_size=4)


@pytest.mark.full
@given(st.lists(polynomials(3), min_size=1, max_size=4))
@settings(max_examples=60, deadline=None)
def test_leading_monomials_are_those_of_sympy(generators):
    basis = computed(generators, 3)
    assert {basis.order.decode(row.codes[0]) for row in basis.rows} == leading_by_sympy(
        generators, 3
    )


@pytest.mark.full
@given(
    st.lists(polynomials(2), min_size=2, max_size=4),
    st.tuples(st.integers(1, 99), st.integers(1, 99)),
)
@settings(max_examples=60, deadline=None)
def test_a_planted_solution_is_found(generators, planted):
    def at(polynomial, q):
        return sum(c * q[0] ** e[0] * q[1] ** e[1] for e, c in polynomial.items()) % P

    shifted = [g | {(0, 0): g.get((0, 0), 0) - at(g, planted)} for g in generators]
    basis = computed(shifted, 2)
    assert not basis.is_one
    found = solution(basis, "test")
    if free_variable(basis) is not None:
        assert found is None
    elif found is not None:  # the eigenspace of each root in the field may be larger than a line
        assert all(at(g, found) == 0 for g in shifted)


def test_all_four_points_lie_in_the_field():
    found = solution(computed([{(2, 0): 1, (0, 0): -4}, {(0, 2): 1, (0, 0): -9}], 2), "test")
    assert found is not None and found[0] in (2, P - 2) and found[1] in (3, P - 3)


def test_no_solution_in_the_field_itself():
    root = next(a for a in range(2, P) if pow(a, (P - 1) // 2, P) == P - 1)  # not a square
    basis = computed([{(2,): 1, (0,): -root}], 1)
    assert not basis.is_one and solution(basis, "test") is None


def test_infinitely_many_solutions_are_seen():
    basis = computed([{(1, 1): 1, (0, 0): -1}], 2)
    assert free_variable(basis) == 1 and solution(basis, "test") is None


@pytest.mark.parametrize("modulus", [P, 2**31 - 1, 2**61 - 1, 18446744073709551557])
def test_contradictions_of_every_size_of_prime(modulus):
    generators = [{(1, 1): 1, (0, 0): -1}, {(1, 0): 1, (0, 0): -2}, {(0, 1): 3, (0, 0): -1}]
    assert computed(generators, 2, modulus).is_one
    assert reaches_one(generators, 2, modulus, 2)
    assert not reaches_one(generators[:2], 2, modulus, 3)


@given(st.integers(0, 10**6))
@settings(max_examples=30, deadline=None)
def test_macaulay_and_buchberger_agree(seed):
    rng = random.Random(seed)
    size, xs = 3, [(1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 0), (0, 1, 1), (2, 0, 0), (0, 0, 0)]
    generators = [{m: rng.randrange(1, P) for m in xs} for _ in range(rng.randrange(2, 6))]
    basis = computed(generators, size)
    assert reaches_one(generators, size, P, basis.degree) == basis.is_one


def test_order_is_degrevlex():
    monomials = [(a, b, c) for a in range(3) for b in range(3) for c in range(3)]
    order = Order(3)
    expected = sorted(monomials, key=sympy.polys.orderings.grevlex)
    assert sorted(monomials, key=order.encode) == expected
    assert all(
        order.decode(order.encode(m)) == m and order.degree(order.encode(m)) == sum(m)
        for m in monomials
    )
    assert order.encode((1, 2, 0)) + order.encode((0, 1, 1)) == order.encode((1, 3, 1))
    assert order.divides(order.encode((1, 0, 2)), order.encode((1, 1, 2)))
    assert not order.divides(order.encode((0, 2, 0)), order.encode((2, 1, 2)))


def test_degrees_beyond_the_codes_are_refused():
    with pytest.raises(TooLarge, match="degree"):
        computed([{(70,): 1, (0,): 1}], 1)
