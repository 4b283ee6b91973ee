"""Verdicts on networks against programs that know nothing of their theorems: over complex values
Singular, which has Kirchhoff's and Newton's laws; over positive ones a plain search for the values
of the other network.
"""

import random

import pytest

from disting import Query, View, compare
from tests.network.pairs import damaged, of_family, some
from tests.oracles.plain_models import truth
from tests.oracles.plain_network import plain
from tests.oracles.singular import PROGRAM
from tests.oracles.twins import twin

needs_singular = pytest.mark.skipif(not PROGRAM, reason="Singular is not installed")
SECONDS = 5.0
TRIED = 3  # points of each network at which a twin is looked for that should not be
FEW = [("machines-2", 20), ("compartments-2", 40), ("circuits-4", 25), ("cells-4", 20)]
MANY = [
    ("circuits-4", 200),
    ("cells-4", 250),
    ("machines-2-damped", 100),
    ("compartments-3", 300),
    ("circuits-5", 100),
    ("machines-3", 30),
    ("trees-4", 30),
]
DAMAGED = ["machines-2", "machines-2-damped", "circuits-4", "cells-4", "compartments-2"]


@pytest.mark.sampled(2)
@pytest.mark.full
@needs_singular
@pytest.mark.parametrize(("name", "most"), FEW)
def test_some_verdicts_over_complex_values(name, most, record_property):
    agree_with_singular(of_family(name, most), record_property)


@needs_singular
@pytest.mark.slow
@pytest.mark.parametrize(("name", "most"), MANY)
def test_verdicts_over_complex_values(name, most, record_property):
    agree_with_singular(of_family(name, most), record_property)


@needs_singular
@pytest.mark.slow
@pytest.mark.parametrize("name", DAMAGED)
def test_verdicts_on_damaged_networks_over_complex_values(name, record_property):
    agree_with_singular(of_damaged(name), record_property)


def agree_with_singular(pairs, record_property):
    seen, wrong = [], []
    for left, right in pairs:
        halves = left.powers.halves
        true = truth(*(plain(m.network, halves) for m in (left, right)), random.Random(1), SECONDS)
        if true is None:
            continue
        found = compare(left, right, query=Query(View.EXACT)).relation.value
        seen.append(true.same)
        if found != ("indistinguishable" if true.same else "distinguishable"):
            wrong.append(f"{left.name} | {right.name}: {found}")
    told = f"{len(seen)} of {len(pairs)} pairs, {sum(seen)} of them the same"
    record_property("oracle", told)
    assert not wrong, "\n".join(wrong)
    assert 3 * len(seen) > len(pairs), told


@pytest.mark.full
@pytest.mark.parametrize(
    ("name", "most"),
    [
        ("machines-2", 8),
        ("compartments-2", 10),
        pytest.param("circuits-4", 6, marks=pytest.mark.slow),
    ],
)
def test_some_verdicts_over_positive_values(name, most, record_property):
    agree_with_twins(of_family(name, most), 1, record_property)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "most"),
    [
        ("machines-2", 400),
        ("compartments-2", 400),
        ("circuits-4", 400),
        ("cells-4", 400),
        ("circuits-5", some(300)),
        ("machines-3", 60),
    ],
)
def test_verdicts_over_positive_values(name, most, record_property):
    agree_with_twins(of_family(name, most), TRIED, record_property)


@pytest.mark.slow
@pytest.mark.parametrize("name", DAMAGED)
def test_verdicts_on_damaged_networks_over_positive_values(name, record_property):
    agree_with_twins(of_damaged(name, 10 if "damped" in name else 60), TRIED, record_property)


def of_damaged(name, most=400):
    found = damaged(name, random.Random(name), 120)
    random.Random(name).shuffle(found)
    return found[:most]


def agree_with_twins(pairs, tried, record_property):
    """What is always the same has a twin both ways, what never is has none at random points."""
    draw, counts, wrong = random.Random(1), {}, []
    for left, right in pairs:
        found = compare(left, right).relation.value
        counts[found] = counts.get(found, 0) + 1
        ways = [(left.network, right.network), (right.network, left.network)]
        if found == "indistinguishable":
            lacking = [given.name for given, other in ways if twin(given, other, draw)[1] is None]
            wrong += [f"{left.name} | {right.name}: no twin of {given}" for given in lacking]
        elif found == "distinguishable":
            refuted = [twin(given, other, draw, 8) for given, other in ways for _ in range(tried)]
            wrong += [f"{left.name} | {right.name}: {pair}" for pair in refuted if pair[1]]
    record_property("oracle", f"{counts}")
    assert not wrong, "\n".join(wrong)


@pytest.mark.full
def test_formulas_in_six_unknowns_are_found_in_one_of_many_orders():
    """With half as many orders the pair stays open."""
    verdict = compare("#=1, 1=2; F1; S1", "#=1, 1=2; F2:1; S2:1")
    assert (verdict.relation, verdict.evidence.kind) == ("indistinguishable", "explicit")
