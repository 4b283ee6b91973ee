"""Foster's theorem on random instances: as many solutions as it says, all real and positive."""

from math import comb
from random import Random

import pytest
from sympy import cancel, degree

from disting import Chain, Family, transfer_function
from disting.decide.positive.points import random_point
from disting.decide.positive.shares import is_continued_fraction
from disting.fibres.synthesis.fibre import fibre
from disting.fibres.synthesis.task import Status, target
from disting.model.question import Answer

CASES = [
    (2, 1, 1, 2),
    (3, 0, 0, 2),
    (3, 1, 1, 2),
    (4, 2, 1, 4),
    (5, 2, 2, 4),
    (5, 0, 0, 3),
    (6, 1, 1, 3),
    (6, 5, 2, 6),
]
LARGE = [(7, 6, 6, 7), (7, 1, 1, 2), (8, 7, 1, 8), (8, 0, 0, 2)]


def count(n, g, a, b):
    """C(N-1, g) C(g-1, a-1) C(N-g-1, b-g-1); without a gap C(N-1, b-1)."""
    return comb(n - 1, g) * (comb(g - 1, a - 1) if g else 1) * comb(n - g - 1, b - g - 1)


@pytest.mark.thin(1)
@pytest.mark.parametrize(("n", "g", "a", "b"), CASES + LARGE)
def test_all_solutions_are_positive(n, g, a, b):
    other = Chain(n, g, a, b, a, b, damped=False)
    gap = Random(n * 100 + b).randrange(n)
    given = Chain(n, gap, min(gap, 1), gap + 1, min(gap, 1), gap + 1, damped=False)
    found = fibre(other, target(given.structure, random_point(given, f"foster{n}{g}{a}{b}")))
    assert found.status is Status.COMPLETE and len(found.solutions) == count(n, g, a, b)
    assert all(s.real is s.positive is Answer.YES for s in found.solutions)


@pytest.mark.parametrize("n", range(2, 7))
def test_a_continued_fraction_is_a_chain_with_one_solution(n):
    """The chains without exception are those that the count gives one set of values."""
    places = [(g, a, b) for g in range(n) for a in range(g + 1) for b in range(g + 1, n + 1)]
    for g, a, b in places:
        if bool(a) == bool(g):
            chain = Chain(n, g, a, b, a, b, damped=False)
            assert is_continued_fraction(chain) is (count(n, g, a, b) == 1), chain


def order(chain):
    """Degree in s of the response, at equal masses and springs, where a resonance inside a row has a node and two
    rows alike share one, common factors cancelled by SymPy.
    """
    g = transfer_function(chain)
    s = next(x for x in g.free_symbols if x.name == "s")
    at_one = g.subs(dict.fromkeys(g.free_symbols - {s}, 1))
    return degree(cancel(at_one).as_numer_denom()[0], s)


@pytest.mark.full
@pytest.mark.parametrize("n", [3, 5])
def test_no_resonance_of_a_continued_fraction_is_ever_cancelled(n):
    """In others one is, at equal elements, of some of them."""
    collocated = [chain for chain in Family(n, damped=False) if chain.collocated]
    assert {order(c) for c in collocated if is_continued_fraction(c)} == {2 * n - 2}
    assert min(map(order, collocated)) < 2 * n - 2
