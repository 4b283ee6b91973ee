"""Every verdict on networks holds from its file alone, over whatever parameters: of families, of
networks that somebody has damaged, of networks with an element twice.
"""

import json
import random
from dataclasses import replace
from itertools import combinations

import pytest

from disting import Engine, Query, View, verdict_file, verify
from disting.network.families import family_of
from disting.verdict.verification import Status
from tests.network.pairs import damaged, some

pytestmark = pytest.mark.full

VIEWS = (View.EXACT, View.REAL, View.POSITIVE)
FAMILIES = [
    ("machines-2", some(40), some(78)),
    ("machines-2-damped", some(20), some(78)),
    ("compartments-2", 40, 66),
    ("compartments-3", 0, 120),
    ("circuits-4", 60, 400),
    ("cells-4", 40, 200),
    ("machines-3", some(20), some(80)),
    ("machines-3-damped", 0, some(80)),
]


def test_elements_twice():
    """Equal ranks of a part and a whole are what condition 8 goes by."""
    told = files_of([(n, doubled(n)) for n in family_of("circuits-4").networks[:40]], [View.EXACT])
    assert sum(data["evidence"].get("kind") == "embedding" for data in told) > 2
    assert not refused(told)


def test_flows_twice_are_written_and_read_again():
    pairs = [(n, doubled(n)) for n in family_of("compartments-2").networks]
    assert not refused(files_of(pairs, VIEWS))


@pytest.mark.parametrize(("name", "changed", "whole"), [("circuits-4", 6, 1)])
def test_some_verdicts_hold(name, changed, whole):
    test_verdicts_hold(name, changed, whole)


@pytest.mark.slow
@pytest.mark.parametrize(("name", "changed", "whole"), FAMILIES)
def test_verdicts_hold(name, changed, whole):
    """Of so many pairs of the family, and of those of so many networks that were changed."""
    pairs = list(combinations(family_of(name).networks, 2))
    random.Random(name).shuffle(pairs)
    pairs = pairs[:whole] + (damaged(name, random.Random(name), changed) if changed else [])
    assert not refused(files_of(pairs, VIEWS))


def files_of(pairs, views):
    """All verdicts as they are read from files."""
    engine = Engine()
    made = [
        verdict_file(*pair, query=Query(view), engine=engine) for pair in pairs for view in views
    ]
    return [json.loads(json.dumps(data)) for data in made]


def refused(files):
    found = [(data, verify(data)) for data in files]
    return [
        f"{data['left']} | {data['right']}, {data['domain']}: {said.sentence}"
        for data, said in found
        if said.status is Status.FAILS
    ]


def doubled(network):
    """With its last element twice."""
    last = network.elements[-1]
    again = replace(last, value=f"{last.value}x")
    return replace(network, elements=(*network.elements, again), name=f"{network.name}, twice")
