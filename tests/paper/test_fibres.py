"""Every verdict on models of equal rank against a fibre by Groebner basis, which knows nothing
of the conditions.
"""

from dataclasses import replace
from itertools import combinations

import pytest

from disting import Chain, Engine, Family, Query, Relation, View
from disting.behaviour.sample import Representation
from tests.paper.fibre import fibre_is_empty

ENGINE = Engine()


def pairs(chains):
    """(left, right, decisions, i, j) for pairs of equal degrees and rank, where a fibre decides."""
    subjects = [ENGINE.subject(str(chain), chain) for chain in chains]
    decided = ENGINE.decisions(subjects, Query(View.EXACT))
    profiles = [s.profile(Representation.TF, 0) for s in subjects]
    for i, j in combinations(range(len(subjects)), 2):
        if (profiles[i].degrees, profiles[i].rank) == (profiles[j].degrees, profiles[j].rank):
            yield subjects[i].chain, subjects[j].chain, decided.verdict(i, j)


def disagreements(chains):
    """Pairs whose verdict and fibre contradict each other, and the number of pairs that were
    decided.
    """
    found = [(a, b, v.relation, fibre_is_empty(a, b)) for a, b, v in pairs(chains)]
    decided = [x for x in found if x[2] is not Relation.UNDECIDED]
    return [x for x in decided if (x[2] is Relation.DISTINGUISHABLE) != x[3]], len(decided)


@pytest.mark.thin(2)
@pytest.mark.parametrize(
    ("n_masses", "damped", "number"),
    [
        (2, False, 1),
        (2, True, 1),
        (3, False, 14),
        pytest.param(3, True, 22, marks=pytest.mark.slow),
        pytest.param(4, False, 87, marks=pytest.mark.slow),
    ],
)
def test_families(n_masses, damped, number):
    assert disagreements(Family(n_masses, damped)) == ([], number)


@pytest.mark.full
def test_some_pairs_of_three_damped_masses():
    """The two of a group, and one that is told from both."""
    family = Family(3, damped=True)
    assert disagreements([family[i] for i in (1, 4, 11)]) == ([], 3)


def with_dampers(chain, *sets):
    return [replace(chain, ground_dampers=masses) for masses in sets]


GAP = Chain(2, 1, 1, 2, 1, 2, damped=False)


@pytest.mark.thin(1)
@pytest.mark.parametrize(
    ("chains", "number"),
    [
        pytest.param(
            with_dampers(GAP, (1,), (2,)) + with_dampers(replace(GAP, damped=True), (), (1,)),
            3,
            id="condition 8",
        ),
        pytest.param(
            with_dampers(Chain(3, 2, 1, 3, 2, 3, damped=True), (1,), (2,)), 1, id="condition 9"
        ),
        pytest.param(
            with_dampers(Chain(2, meas_plus=2, damped=True), (1,), (2,), (1, 2)), 3, id="one chain"
        ),
        pytest.param(
            with_dampers(Chain(3, meas_plus=3, damped=True), (1,), (2,)),
            1,
            id="A3",
            marks=pytest.mark.slow,
        ),
    ],
)
def test_ground_dampers(chains, number):
    assert disagreements(chains) == ([], number)
