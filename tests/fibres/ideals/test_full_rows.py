"""Parts that can have any receptance: against SymPy's ranks, and against what the other methods
decide.
"""

from dataclasses import replace
from itertools import combinations

import pytest
import sympy

from disting import Certainty, Chain, Family, Outcome, Query, Relation, View, compare
from disting.catalogs.dampers import DamperSets
from disting.decide.same.evidence_check import Witness
from disting.decide.same.exact import by_full_rows, by_ideals
from disting.evidence.ideals import FullRows
from disting.fibres.ideals import Limits, same_by_full_rows
from disting.model.question import Settings

LIMITS = Limits(seconds=600, entries=500_000, safety=100)


def found(a: Chain, b: Chain) -> FullRows | None:
    return same_by_full_rows(a.structure, b.structure)


def rank_and_coefficients(dampers: tuple[int, ...], at: int) -> tuple[int, int]:
    """Two masses at the wall with damped springs, force and sensor at one of them: plain SymPy."""
    m1, m2, k1, k2, d1, d2, b1, b2, s = sympy.symbols("m1 m2 k1 k2 d1 d2 b1 b2 s")
    own = [b for number, b in ((1, b1), (2, b2)) if number in dampers]
    friction = sympy.diag(*(b if b in own else 0 for b in (b1, b2)))
    joints = [k1 + d1 * s, k2 + d2 * s]
    motion = (
        sympy.Matrix(
            [[m1 * s**2 + joints[0] + joints[1], -joints[1]], [-joints[1], m2 * s**2 + joints[1]]]
        )
        + s * friction
    )
    numerator, denominator = motion.cofactor(at - 1, at - 1), motion.det()
    lead = m1 * m2
    coefficients = [
        c / lead
        for p in (numerator, denominator)
        for c in sympy.Poly(sympy.expand(p), s).all_coeffs()
    ]
    coefficients.remove(1)
    names = [m1, m2, k1, k2, d1, d2, *own]
    point = dict(zip(names, map(sympy.Rational, (3, 5, 7, 11, 13, 17, 19, 23)), strict=False))
    return sympy.Matrix(coefficients).jacobian(names).subs(point).rank(), len(coefficients)


@pytest.mark.full
@pytest.mark.parametrize("dampers", [(), (1,), (2,), (1, 2)])
def test_a_grounded_part_is_full_exactly_where_its_rank_is_the_number_of_its_coefficients(dampers):
    full = all(len(set(rank_and_coefficients(dampers, at))) == 1 for at in (1, 2))
    inner, outer = (Chain(3, 2, at, 3, at, 3, damped=True, ground_dampers=dampers) for at in (1, 2))
    assert (found(inner, outer) is not None) is full
    assert full is (2 in dampers)


def test_what_it_says():
    a, b = (Chain(3, 2, at, 3, at, 3, damped=True, ground_dampers=(2,)) for at in (1, 2))
    evidence = found(a, b)
    assert evidence == FullRows((7, 0))
    assert (
        evidence.sentence("A", "B")
        == "In A and B both grounded rows have as many determinable parameters as coefficients (7)"
        " and the free rows are equal, so each can have the rows of the other."
    )
    assert evidence.formula == "N_R = 7 = |Φ_R|"


@pytest.mark.full
def test_compare_gives_it_as_proven_evidence_that_can_be_checked_again():
    a, b = (Chain(3, 2, at, 3, at, 3, damped=True, ground_dampers=(1, 2)) for at in (1, 2))
    finding = by_full_rows(a, b, Settings())
    assert finding.outcome is Outcome.HOLDS and finding.certainty is Certainty.PROVEN
    assert Witness().confirms(finding.evidence, "fibre", a, b)
    other = replace(b, ground_dampers=())
    assert not Witness().confirms(finding.evidence, "fibre", a, other)
    assert not Witness().confirms(FullRows((6, 0)), "fibre", a, b)
    assert compare(a, b, query=Query(View.EXACT)).relation is Relation.INDISTINGUISHABLE


@pytest.mark.parametrize("extra", [{"lag": True}, {"dead_time": True}, {"quantity": "position"}])
def test_a_factor_that_only_one_chain_has_is_not_overlooked(extra):
    a, b = (Chain(3, 2, at, 3, at, 3, damped=True, ground_dampers=(2,)) for at in (1, 2))
    assert found(replace(a, **extra), replace(b, **extra)) == FullRows((7, 0))
    assert found(replace(a, **extra), b) is None


def test_it_speaks_of_chains_with_one_gap():
    assert found(Chain(3, damped=True), Chain(3, 0, 0, 2, 0, 2, damped=True)) is None
    assert (
        found(Chain(3, 1, 1, 2, 1, 2, damped=False), Chain(3, 2, 1, 3, 1, 3, damped=False)) is None
    )
    assert (
        found(Chain(3, 1, 1, 2, 1, 2, damped=False), Chain(3, 1, 1, 2, 1, 2, damped=False)) is None
    )  # nothing to prove


@pytest.mark.full
@pytest.mark.parametrize("damped", [False, True])
def test_ideals_say_the_same_of_three_masses(damped):
    chains = [replace(c, ground_dampers=s) for c in Family(3, damped) for s in DamperSets.ALL.of(3)]
    proven = [
        (a, b)
        for a, b in combinations(chains, 2)
        if a.gap and a.indices != b.indices and found(a, b)
    ]
    assert len(proven) > 10
    said = [by_ideals(a, b, Settings(), LIMITS).outcome for a, b in proven]
    assert Outcome.FAILS not in said
    assert said.count(Outcome.HOLDS) > len(proven) / 2
