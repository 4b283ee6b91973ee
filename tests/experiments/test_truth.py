"""What one further experiment leaves indistinguishable of the three damped pairs of three masses
that one measurement cannot tell apart: literal, from Gröbner bases modulo a prime by other code.
"""

from itertools import product

import pytest

from disting import Experiment, Family, Query, View, compare

A = Family(3, damped=True)
SAME = {
    (1, 11): ("", "", ""),
    (2, 5): ("2/3", "1/2 1/3 2/2 2/3 3/1", "1/3 2/2 3/1"),
    (9, 10): ("2/1 3/3", "1/1 1/2 2/1 2/2 3/3", "1/1 2/2 3/3"),
}
KINDS = {
    "sensor": lambda i: Experiment(sensor=i),
    "locked": lambda i: Experiment(locked=i),
    "inertia": lambda i: Experiment(inertias={i: 1}),
}
CASES = [
    (pair, kind, i, j, f"{i}/{j}" in same.split())
    for pair, sames in SAME.items()
    for kind, same in zip(KINDS, sames, strict=True)
    for i, j in product((1, 2, 3), repeat=2)
]
EXACT = Query(View.EXACT)
BY_THE_EXACT_DECISION = Query(View.EXACT, conditions=("1", "2"))


def told(pair, kind, i, j, query):
    further = (KINDS[kind](i), KINDS[kind](j))
    chains = (A[n] for n in pair)
    return compare(*chains, experiments=[Experiment(), further], query=query).relation.value


def said(same):
    return "indistinguishable" if same else "distinguishable"


def test_there_are_81_cases_of_which_19_remain():
    assert len(CASES) == 81 and sum(case[-1] for case in CASES) == 19


@pytest.mark.thin(1)
@pytest.mark.parametrize(("pair", "kind", "i", "j", "same"), CASES[::4])
def test_truth(pair, kind, i, j, same):
    assert told(pair, kind, i, j, EXACT) == said(same)


@pytest.mark.slow
@pytest.mark.parametrize(("pair", "kind", "i", "j", "same"), CASES)
def test_all_of_it(pair, kind, i, j, same):
    assert told(pair, kind, i, j, EXACT) == said(same)


@pytest.mark.slow
@pytest.mark.parametrize(("pair", "kind", "i", "j", "same"), CASES)
def test_all_of_it_by_lists_and_ideals_alone(pair, kind, i, j, same):
    assert told(pair, kind, i, j, BY_THE_EXACT_DECISION) == said(same)


@pytest.mark.full
@pytest.mark.parametrize(
    ("pair", "kind", "i", "j"), [((2, 5), "sensor", 2, 3), ((9, 10), "locked", 3, 3)]
)
def test_what_remains_by_ideals(pair, kind, i, j):
    assert told(pair, kind, i, j, BY_THE_EXACT_DECISION) == "indistinguishable"


@pytest.mark.parametrize(
    ("pair", "kind", "i", "j"), [((2, 5), "sensor", 3, 3), ((9, 10), "inertia", 1, 2)]
)
def test_what_is_settled_by_a_list(pair, kind, i, j):
    further = (KINDS[kind](i), KINDS[kind](j))
    found = compare(
        *(A[n] for n in pair), experiments=[Experiment(), further], query=BY_THE_EXACT_DECISION
    )
    assert found.relation.value == "distinguishable"
    assert found.decided_by in ("1", "exact")
