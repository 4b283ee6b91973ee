"""What gives the same for all positive values, by the verdicts, is constructed both ways: positive
values to 60 digits, found without any theorem.
"""

import random
from collections import Counter, defaultdict
from itertools import combinations

import pytest

from disting import Relation, compare
from disting.general.any_model import of_network
from disting.general.interlacing import machine_type
from disting.general.replacement import full_set
from disting.network.families import family_of
from disting.network.notation import network_of
from disting.network.simplest import simplest
from tests.general.test_ways import positive
from tests.oracles.constructions import construct

DRAWS = 1000  # of each theorem, one way or the other
POINTS = 20  # of each pair
BRIDGES = ["#~1, 1~2, 1~3; F3:2; S3:2", "#~1, 1~2, 2~3; F3:1; S3:1", "#~1, 1~2, 2~3; F3; S3"]


def replaced(model):
    return simplest(model.network)


FAMILIES = {
    "degree": ("", full_set),
    "trees of masses": ("trees-4", replaced),
    "two kinds of elements": ("circuits-4", full_set),
    "parts of two kinds": ("cells-4", replaced),
    "parts of three kinds": ("circuits-5", replaced),
    "compartments": ("compartments-3", replaced),
    "interlacing": ("machines-3", machine_type),
    "interlacing of 4": ("trees-4", machine_type),
}


def classes_of(theorem):
    """Models that the theorem says are the same, by what they have in common."""
    name, common = FAMILIES[theorem]
    networks = family_of(name).networks if name else map(network_of, BRIDGES)
    found = defaultdict(list)
    for model in map(of_network, networks):
        kept = found[common(model)]
        if all(model.content != other.content for other in kept):
            kept.append(model)
    return [models for what, models in found.items() if what is not None and len(models) > 1]


@pytest.mark.full
@pytest.mark.parametrize("theorem", ["degree", "two kinds of elements", "compartments"])
def test_some_constructions(theorem):
    assert not lacking(theorem, 20)


@pytest.mark.slow
@pytest.mark.parametrize("theorem", FAMILIES)
def test_a_thousand_constructions_of_each_theorem(theorem, record_property):
    found = lacking(theorem, DRAWS)
    record_property("constructions", DRAWS)
    assert not found, found


def lacking(theorem, draws):
    draw = random.Random(theorem)
    classes = classes_of(theorem)
    assert classes
    chosen = [draw.sample(draw.choice(classes), 2) for _ in range(draws)]
    return Counter(
        f"{given.name} in {other.name}"
        for given, other in chosen
        if construct(given, other, draw) is None
    )


@pytest.mark.full
def test_what_is_not_the_same_is_not_constructed():
    """A chain of four compartments where real poles are asked for, and a cycle without them."""
    draw = random.Random(1)
    cycle, chain = (
        of_network(network_of(text))
        for text in (
            "1>2, 2>3, 3>1; in 1; out 3",
            "1>2, 2>3, 3>2, 1>0; in 1; out 3",
        )
    )
    assert compare(cycle, chain).relation is Relation.SOMETIMES
    assert all(construct(chain, cycle, draw) for _ in range(10))
    assert any(construct(cycle, chain, draw, 5) is None for _ in range(10))


@pytest.mark.slow
def test_twenty_points_of_each_verdict_on_three_masses():
    draw = random.Random("machines-3")
    wrong = [
        (given.name, other.name)
        for pair in same_by_verdict()
        for given, other in (pair, pair[::-1])
        for _ in range(POINTS)
        if construct(given, other, draw) is None
    ]
    assert not wrong, Counter(wrong)


def same_by_verdict():
    """Pairs of machines of at most three springs that are INDISTINGUISHABLE for positive values."""
    networks = family_of("machines-3").networks
    models = [of_network(n) for n in networks if sum(e.letter == "k" for e in n.elements) <= 3]
    pairs = [(a, b) for a, b in combinations(models, 2) if a.degrees == b.degrees]
    return [p for p in pairs if positive(*p).relation is Relation.INDISTINGUISHABLE]
