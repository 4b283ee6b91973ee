"""Ranks, kernels and numbers of solutions against plain SymPy, which shares no code with what
it checks.
"""

import pytest

from disting import Family
from disting.decide.identifiability.analysis import identifiability
from disting.decide.identifiability.parts import Level
from tests.decide.identifiability.oracle import (
    PRIME,
    derivative_along,
    solutions,
    symbolic_kernel,
)
from tests.oracles.sympy_twin import summary

SMALL = [
    (n, damped, number)
    for n in (2, 3)
    for damped in (False, True)
    for number in range(1, len(Family(n, damped=False)) + 1)
]
# seconds to minutes for a Groebner basis
LONG = {(3, True, number) for number in range(1, 12) if number not in (1, 4, 7)}


def marked(cases):
    return [pytest.param(*case, marks=pytest.mark.slow) if case in LONG else case for case in cases]


@pytest.mark.thin(1)
@pytest.mark.sampled(5)
@pytest.mark.parametrize(("n_masses", "damped", "number"), marked(SMALL))
def test_number_of_solutions_modulo_a_prime(n_masses, damped, number):
    chain = Family(n_masses, damped)[number]
    assert solutions(chain) == identifiability(chain).most


@pytest.mark.thin(1)
@pytest.mark.parametrize(
    ("n_masses", "damped", "number"), [case for case in SMALL if case[:2] != (3, True)]
)
def test_number_of_solutions_over_the_rationals(n_masses, damped, number):
    chain = Family(n_masses, damped)[number]
    assert solutions(chain, modulus=0) == identifiability(chain).most


@pytest.mark.slow
@pytest.mark.parametrize("number", [1, 5, 21, 25, 29])
def test_number_of_solutions_of_four_masses(number):
    """Models 8, 11, 13 and 19 take SymPy more than half a minute each."""
    chain = Family(4, damped=False)[number]
    assert solutions(chain, PRIME) == identifiability(chain).most


@pytest.mark.full
@pytest.mark.parametrize(
    ("n_masses", "damped"), [(2, False), (2, True), (3, False), (3, True), (4, False)]
)
def test_ranks(n_masses, damped):
    for chain in list(Family(n_masses, damped))[:: 5 if n_masses == 4 else 1]:
        assert identifiability(chain).rank == summary(chain).rank, chain


@pytest.mark.thin(1)
@pytest.mark.parametrize("damped", [False, True])
@pytest.mark.parametrize("n_masses", [2, 3])
def test_combinations_are_constant_along_the_symbolic_kernel(n_masses, damped):
    """An identity of formulas; and a parameter that is not listed as identifiable changes along
    the kernel.
    """
    for chain in Family(n_masses, damped):
        found = identifiability(chain)
        if found.level is not Level.NOT:
            continue
        field, kernel = symbolic_kernel(chain)
        assert kernel.shape[0] == len(chain.parameters) - found.rank
        for combination in (*found.basis, *found.singles):
            assert not any(derivative_along(field, kernel, combination.formula.text)), (
                chain,
                combination.text,
            )
        singles = {c.text for c in found.singles}
        for name in chain.parameters:
            assert (name in singles) == (not any(derivative_along(field, kernel, name))), (
                chain,
                name,
            )


@pytest.mark.full
@pytest.mark.parametrize("damped", [False, True])
def test_combinations_are_independent(damped):
    for chain in Family(3, damped):
        found = identifiability(chain)
        at = {name: i * i + 2 for i, name in enumerate(chain.parameters)}
        rows = [c.formula.gradient(at, 10**9 + 7) for c in found.basis]
        assert _rank(rows, 10**9 + 7) == found.rank == len(found.basis)


def _rank(rows, modulus):
    rows, rank = [list(row) for row in rows], 0
    for column in range(len(rows[0])):
        pivot = next((r for r in rows[rank:] if r[column]), None)
        if pivot is None:
            continue
        rows.remove(pivot)
        rows.insert(rank, pivot)
        for i in range(rank + 1, len(rows)):
            factor = rows[i][column] * pow(pivot[column], -1, modulus)
            rows[i] = [(a - factor * b) % modulus for a, b in zip(rows[i], pivot, strict=True)]
        rank += 1
    return rank
