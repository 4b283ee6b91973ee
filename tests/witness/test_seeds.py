"""Verdicts are facts about models: the seed, the order of a pair and the sensor quantity change
nothing.
"""

from itertools import combinations

import pytest

from disting import Engine, Family, Quantity, Query, Relation, Settings, Verdict, View, catalog

Relations = dict[tuple[int, int], Relation]


def computed(family: Family, seed: str = "disting", *, backwards: bool = False) -> Relations:
    """Relation of every pair of a family by a fresh engine, the models numbered from 1."""
    numbers = range(len(family), 0, -1) if backwards else range(1, len(family) + 1)
    engine = Engine(Settings(seed=seed))
    found = engine.decisions(
        [engine.subject(f"A{n}", family[n]) for n in numbers], Query(View.EXACT)
    )
    place = {number: i for i, number in enumerate(numbers)}
    return {
        (i, j): found.relation(place[i], place[j])
        for i, j in combinations(range(1, len(family) + 1), 2)
    }


def shipped(n: int, damped: bool) -> Relations:
    return {(i, j): v.relation for i, j, v in catalog(n, damped=damped).pairs(View.EXACT)}


@pytest.mark.full
@pytest.mark.parametrize("damped", [False, True])
@pytest.mark.parametrize("seed", ["first", pytest.param("second", marks=pytest.mark.slow)])
def test_three_masses_with_other_seeds(damped: bool, seed: str) -> None:
    assert computed(Family(3, damped), seed) == shipped(3, damped)


@pytest.mark.slow
@pytest.mark.parametrize(("n", "damped"), [(3, False), (3, True), (4, True)])
@pytest.mark.parametrize("seed", [f"seed {i}" for i in range(20)])
def test_twenty_seeds(n: int, damped: bool, seed: str) -> None:
    assert computed(Family(n, damped), seed) == shipped(n, damped)


@pytest.mark.full
@pytest.mark.parametrize("damped", [False, True])
def test_three_masses_in_the_other_order(damped: bool) -> None:
    assert computed(Family(3, damped), backwards=True) == shipped(3, damped)


@pytest.mark.slow
@pytest.mark.parametrize("damped", [False, True])
def test_four_masses_in_the_other_order(damped: bool) -> None:
    assert computed(Family(4, damped), backwards=True) == shipped(4, damped)


@pytest.mark.full
def test_a_verdict_of_a_pair_does_not_depend_on_its_order() -> None:
    """Pair by pair, each order by an engine of its own: the relation, what decided it, and how
    surely.
    """
    family = Family(3, damped=True)
    for i, j in list(combinations(range(1, len(family) + 1), 2))[::3]:
        one, other = (_verdict(family, *pair) for pair in ((i, j), (j, i)))
        fields = ("relation", "decided_by", "representation", "certainty", "safety")
        assert [getattr(one, f) for f in fields] == [getattr(other, f) for f in fields], (i, j)


def _verdict(family: Family, left: int, right: int) -> Verdict:
    engine = Engine()
    return engine.verdict(
        engine.subject("left", family[left]),
        engine.subject("right", family[right]),
        Query(View.EXACT),
    )


@pytest.mark.full
@pytest.mark.parametrize("damped", [False, True])
@pytest.mark.parametrize("sensor", [Quantity.POSITION, Quantity.VELOCITY])
def test_three_masses_with_other_sensors(damped: bool, sensor: Quantity) -> None:
    assert computed(Family(3, damped, sensor)) == shipped(3, damped)


@pytest.mark.slow
@pytest.mark.parametrize("damped", [False, True])
@pytest.mark.parametrize("sensor", [Quantity.POSITION, Quantity.VELOCITY])
def test_four_masses_with_other_sensors(damped: bool, sensor: Quantity) -> None:
    assert computed(Family(4, damped, sensor)) == shipped(4, damped)


@pytest.mark.thin(4)
@pytest.mark.parametrize("n", [3, 4, 5])
@pytest.mark.parametrize("damped", [False, True])
def test_groups_of_indistinguishable_models_are_closed(n: int, damped: bool) -> None:
    """a ~ b and b ~ c give a ~ c."""
    c = catalog(n, damped=damped)
    numbers = range(1, len(c.family) + 1)
    same = {(i, j) for i, j, v in c.pairs(View.EXACT) if v.relation is Relation.INDISTINGUISHABLE}
    same |= {(j, i) for i, j in same}
    assert same
    triples = [(i, j, k) for i, j in same for k in numbers if (j, k) in same and i != k]
    assert [t for t in triples if (t[0], t[2]) not in same] == []
