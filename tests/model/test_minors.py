"""Minors of structures: places that make a part of a whole, and what is none."""

from dataclasses import replace
from itertools import product

import networkx as nx
import pytest
from hypothesis import given, settings

from disting import Chain, Family
from disting.model.minors import embeddings, is_minor, minors
from tests.laws.strategies import chains

quick = settings(max_examples=40, deadline=None)


def found(part, whole, ports):
    return list(minors(part.structure, whole.structure, ports))


def test_a_missing_element_leaves_masses_where_they_are():
    for n, damped in ((2, False), (3, True)):
        same = {i: i for i in range(n + 1)}
        for chain in Family(n, damped):
            for more in ({"lag": True}, {"dead_time": True}, {"ground_dampers": (n,)}):
                whole = replace(chain, **more)
                assert next(minors(chain.structure, whole.structure, {})) == same
                assert is_minor(chain.structure, whole.structure, same)
                assert not is_minor(whole.structure, chain.structure, same)
                assert found(whole, chain, {}) == []


def test_a_spring_without_bound_and_a_mass_at_rest():
    assert found(Chain(1), Chain(2, meas_plus=2), {1: 1, 2: 1}) == [{0: 0, 1: 1, 2: 1}]
    fixed, free = Chain(2, 1, 1, 2, 1, 2), Chain(3, 1, 1, 2, 1, 2)
    assert {0: 0, 1: 1, 2: 2, 3: 2} in found(fixed, free, {1: 1, 2: 2})
    # a mass of the free row at rest is a wall for the one before it
    assert is_minor(fixed.structure, Chain(4, 1, 1, 2, 1, 2).structure, {0: 0, 1: 2, 2: 1, 3: 0})


@pytest.mark.thin(8)
@pytest.mark.parametrize(
    ("part", "whole", "places"),
    [
        (Chain(1), Chain(2), {0: 0, 1: 2}),  # no such node
        (Chain(1), Chain(2), {0: 0, 3: 1}),  # no such mass
        (Chain(1), Chain(2), {1: 1}),  # the ground has no place
        (Chain(1), Chain(2), {0: 1, 1: 1}),
        (Chain(2), Chain(3), {0: 0, 1: 1}),  # a node without a mass
        (Chain(2), Chain(3), {0: 0, 1: 1, 3: 2}),  # nothing joins them
        (Chain(1), Chain(3), {0: 0, 1: 1, 3: 1}),  # nor these
        (Chain(1), Chain(2, 1, 1, 2, 1, 2), {0: 0, 1: 1, 2: 1}),  # a gap is no spring
        (Chain(2, damped=True), Chain(3, damped=False), {0: 0, 1: 1, 2: 2}),
        (Chain(2, ground_dampers=(2,)), Chain(3, ground_dampers=(1,)), {0: 0, 1: 1, 2: 2}),
        (Chain(1, lag=True), Chain(2), {0: 0, 1: 1}),
        (Chain(1, dead_time=True), Chain(2), {0: 0, 1: 1}),
    ],
)
def test_what_is_no_minor(part, whole, places):
    assert not is_minor(part.structure, whole.structure, places)
    assert places not in found(part, whole, {})


def test_elements_that_come_together_add_up():
    """Dampers of two masses that are one body, one of them wanted."""
    part, whole = Chain(1, ground_dampers=(1,)), Chain(2, ground_dampers=(2,))
    assert found(part, whole, {1: 1}) == [{0: 0, 1: 1, 2: 1}]


# --- embeddings
# ----------------------------------------------------------------------------------------------------------


def embedded(part, whole):
    return list(embeddings(part.structure, whole.structure))


def graph(chain):
    """Node 0 is the ground; nodes carry what they hold, edges say which elements join them."""
    found, structure = nx.Graph(), chain.structure
    for i in range(chain.n_masses + 1):
        roles = {name for name, at in structure.ports._asdict().items() if at == i}
        damper = any(e.kind == "b" and e.at == i for e in structure.elements)
        found.add_node(i, fixed=(i == 0, roles), damper=damper)
    for e in structure.elements:
        if e.kind in "kd":
            kinds = found.get_edge_data(e.at, e.at + 1, {"kinds": set()})["kinds"]
            found.add_edge(e.at, e.at + 1, kinds=kinds | {e.kind})
    return found


def monomorphisms(part, whole):
    """Those of the graphs, by networkx."""
    matcher = nx.algorithms.isomorphism.GraphMatcher(
        graph(whole),
        graph(part),
        node_match=lambda a, b: a["fixed"] == b["fixed"] and a["damper"] >= b["damper"],
        edge_match=lambda a, b: a["kinds"] >= b["kinds"],
    )
    same = part.quantity == whole.quantity and part.lag <= whole.lag
    return [{b: a for a, b in m.items()} for m in matcher.subgraph_monomorphisms_iter() if same]


@pytest.mark.full
@pytest.mark.parametrize("damped", [False, True])
def test_embeddings_are_the_monomorphisms_of_graphs(damped):
    some = [Chain(1), *Family(2, damped), *Family(3, damped), *list(Family(4, True))[::5]]
    some += [replace(c, ground_dampers=(c.n_masses,), lag=True) for c in some]
    told = 0
    for part, whole in product(some, repeat=2):
        found, wanted = embedded(part, whole), monomorphisms(part, whole)
        assert sorted(sorted(m.items()) for m in found) == sorted(sorted(m.items()) for m in wanted)
        told += len(found)
    assert told > 80


@pytest.mark.full
@quick
@given(chains(dead_time=True))
def test_every_structure_is_a_part_of_itself(chain):
    assert {i: i for i in range(chain.n_masses + 1)} in embedded(chain, chain)


@quick
@given(chains())
def test_a_structure_without_an_element_is_a_part_and_not_the_other_way_round(chain):
    for element in chain.structure.elements:
        if element.kind != "m":
            kept = tuple(e for e in chain.structure.elements if e != element)
            part = replace(chain.structure, elements=kept)
            same = {i: i for i in range(chain.n_masses + 1)}
            assert same in list(embeddings(part, chain.structure))
            assert list(embeddings(chain.structure, part)) == []


def test_a_shorter_chain_is_a_part_of_a_longer_one():
    assert embedded(Chain(2, damped=False), Chain(3, damped=False)) == [{0: 0, 1: 1, 2: 2}]
    assert embedded(Chain(3, damped=False), Chain(2, damped=False)) == []


def test_a_shifted_run_in_the_middle():
    """Force and sensor at mass 2 of 3: the pair to its left and the pair to its right."""
    found = embedded(Chain(2, damped=False), Chain(3, act_plus=2, meas_plus=2, damped=False))
    assert sorted(sorted(m.items()) for m in found) == [
        [(0, 0), (1, 2), (2, 1)],
        [(0, 0), (1, 2), (2, 3)],
    ]


def test_a_grounded_part_stays_at_the_ground():
    part = Chain(2, 1, 1, 2, 1, 2, damped=False)
    assert embedded(part, Chain(3, 1, 1, 2, 1, 2, damped=False)) == [{0: 0, 1: 1, 2: 2}]
    assert (
        embedded(part, Chain(3, 2, 2, 3, 2, 3, damped=False)) == []
    )  # mass 2 is not joined to the ground


def test_undamped_is_a_part_of_damped():
    assert embedded(Chain(3, damped=False), Chain(3, damped=True)) == [{0: 0, 1: 1, 2: 2, 3: 3}]
    assert embedded(Chain(3, damped=True), Chain(3, damped=False)) == []


def test_without_lag_is_a_part_of_with_lag():
    assert len(embedded(Chain(2, damped=False), Chain(2, lag=True, damped=False))) == 1
    assert embedded(Chain(2, lag=True, damped=False), Chain(2, damped=False)) == []


@pytest.mark.parametrize(
    "other",
    [
        Chain(3, meas_plus=2, damped=False),
        Chain(3, quantity="position", damped=False),
        Chain(3, dead_time=True, damped=False),
        Chain(4, 1, 1, 2, 1, 2, damped=False),
    ],
    ids=str,
)
def test_other_ports_sensors_and_dead_times_are_no_whole(other):
    assert embedded(Chain(3, damped=False), other) == []


@pytest.mark.parametrize(
    ("mine", "theirs", "fits"),
    [
        ((), (1,), True),
        ((1,), (1,), True),
        ((1,), (2,), False),
        ((1,), (1, 3), True),
        ((1, 3), (3,), False),
    ],
)
def test_ground_dampers_must_be_there(mine, theirs, fits):
    left, right = (
        Chain(3, meas_plus=3, ground_dampers=masses, damped=False) for masses in (mine, theirs)
    )
    assert bool(embedded(left, right)) == fits
