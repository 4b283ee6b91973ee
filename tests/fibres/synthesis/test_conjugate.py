"""One way to share out conjugate zeros speaks for all: groups against SymPy, fibres against
those with every way tried.
"""

import sys

import pytest
import sympy
from flint import fmpq, fmpq_poly
from sympy.polys.numberfields.galoisgroups import galois_group

from disting.fibres.synthesis.conjugate import conjugate_factors
from disting.fibres.synthesis.decide import rational_point
from disting.fibres.synthesis.fibre import fibre
from disting.fibres.synthesis.task import Status, target
from disting.model.chain import Chain
from disting.model.family import Family

POLYNOMIALS = [
    [1, 1, 1], [-1, 0, 1], [-2, 0, 0, 1], [1, -3, 0, 1], [1, 1, 0, 0, 1], [1, 0, 0, 0, 1], [-2, 0, 0, 0, 1],
    [-1, -1, 0, 0, 0, 1], [-2, 0, 0, 0, 0, 1], [1, 1, 0, 0, 0, 0, 1], [2, 3, 1],
]  # fmt: skip


@pytest.mark.thin(8)
@pytest.mark.parametrize("coefficients", POLYNOMIALS, ids=str)
def test_the_symmetric_group_is_found_where_sympy_finds_it(coefficients):
    x = sympy.Symbol("x")
    p = sympy.Poly(coefficients[::-1], x)
    whole = p.is_irreducible and galois_group(p)[0].order() == sympy.factorial(p.degree())
    found = conjugate_factors(fmpq_poly([fmpq(c, 7) for c in coefficients]))
    assert (len(found) == 1) == whole


@pytest.mark.parametrize(
    ("factors", "independent"),
    [
        ([[1, 1], [-2, 0, 0, 1]], True),
        ([[-2, 0, 1], [-3, 0, 1]], True),  # square roots of 2 and of 3
        ([[-2, 0, 1], [-8, 0, 1]], False),  # one field: what moves one moves the other
        # the field of the cube roots of 2 holds the square root of -3
        ([[-2, 0, 0, 1], [3, 0, 1]], False),
        ([[-2, 0, 0, 1], [-2, 0, 1]], True),
        ([[-2, 0, 1], [-2, 0, 1]], False),  # multiple
        ([[0, 1], [1, 1, 1]], True),
    ],
    ids=str,
)
def test_factors_are_told_apart_where_their_fields_are_independent(factors, independent):
    whole = fmpq_poly([1])
    for coefficients in factors:
        whole *= fmpq_poly(coefficients)
    assert len(conjugate_factors(whole)) == (len(factors) if independent else 0)


def _without_factors(monkeypatch):
    monkeypatch.setattr(
        sys.modules["disting.fibres.synthesis.conjugate"], "conjugate_factors", lambda _: ()
    )


@pytest.mark.thin(5)
@pytest.mark.parametrize("number", range(0, 29, 3))
def test_a_fibre_is_the_same_as_with_every_way_tried(number, monkeypatch):
    family = Family(4, True)
    searched = next(c for c in family if c.indices[1:] == (0, 0, 2, 0, 3))
    given = list(family)[number]
    goal = target(given.structure, rational_point(given, "test"))
    quick = fibre(searched, goal)
    _without_factors(monkeypatch)
    slow = fibre(searched, goal)
    assert (quick.status, len(quick.solutions)) == (slow.status, len(slow.solutions))
    assert quick.tests.refuted <= slow.tests.refuted


@pytest.mark.full
def test_the_solutions_of_a_models_own_fibre_are_those_of_every_way(monkeypatch):
    """The zeros of a chain's own receptance fall into kinds: each row of the chain has its own."""
    chain = Chain(4, 0, 0, 2, 0, 3, damped=True)
    goal = target(chain.structure, rational_point(chain, "own"))
    quick = fibre(chain, goal)
    _without_factors(monkeypatch)
    slow = fibre(chain, goal)
    assert quick.status is slow.status is Status.COMPLETE
    assert len(quick.solutions) == len(slow.solutions)
    for one in quick.solutions:
        assert any(
            all(one.values[name].overlaps(other.values[name]) for name in one.values)
            for other in slow.solutions
        )
    assert quick.tests.refuted < slow.tests.refuted
