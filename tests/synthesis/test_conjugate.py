"""One way to share out conjugate zeros speaks for all: groups against SymPy, fibres against those with every way tried."""

import sys

import pytest
import sympy
from flint import fmpq, fmpq_poly
from sympy.polys.numberfields.galoisgroups import galois_group

from disting.model.family import Family
from disting.synthesis.conjugate import zeros_are_conjugate
from disting.synthesis.decide import rational_point
from disting.synthesis.fibre import fibre
from disting.synthesis.target import target

POLYNOMIALS = [
    [1, 1, 1], [-1, 0, 1], [-2, 0, 0, 1], [1, -3, 0, 1], [1, 1, 0, 0, 1], [1, 0, 0, 0, 1], [-2, 0, 0, 0, 1],
    [-1, -1, 0, 0, 0, 1], [-2, 0, 0, 0, 0, 1], [1, 1, 0, 0, 0, 0, 1], [2, 3, 1],
]  # fmt: skip


@pytest.mark.parametrize("coefficients", POLYNOMIALS, ids=str)
def test_the_symmetric_group_is_found_where_sympy_finds_it(coefficients):
    x = sympy.Symbol("x")
    p = sympy.Poly(coefficients[::-1], x)
    whole = p.is_irreducible and galois_group(p)[0].order() == sympy.factorial(p.degree())
    assert zeros_are_conjugate(fmpq_poly([fmpq(c, 7) for c in coefficients])) == whole


@pytest.mark.parametrize("number", range(0, 29, 3))
def test_a_fibre_is_the_same_as_with_every_way_tried(number, monkeypatch):
    family = Family(4, True)
    searched = next(c for c in family if c.indices[1:] == (0, 0, 2, 0, 3))
    given = list(family)[number]
    goal = target(given.structure, rational_point(given, "test"))
    quick = fibre(searched, goal)
    monkeypatch.setattr(sys.modules["disting.synthesis.fibre"], "zeros_are_conjugate", lambda _: False)
    slow = fibre(searched, goal)
    assert (quick.status, len(quick.solutions)) == (slow.status, len(slow.solutions))
    assert quick.tests.refuted <= slow.tests.refuted
