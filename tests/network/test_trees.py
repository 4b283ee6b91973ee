"""Spanning forests against all sets of edges, tried one by one."""

import random
from collections import Counter
from itertools import combinations

import networkx
import pytest
from hypothesis import given, strategies as st

from disting.network.forests import forests

NODES = range(6)
EDGES = st.sets(st.sampled_from(list(combinations(NODES, 2))), min_size=1, max_size=9)


def tried(weights, kept):
    """Every set of edges without a loop whose trees all hold a node that is kept."""
    found = Counter()
    for count in range(len(weights) + 1):
        for chosen in combinations(weights, count):
            graph = networkx.Graph([tuple(edge) for edge in chosen])
            graph.add_nodes_from(i for edge in weights for i in edge)
            graph.add_nodes_from(kept)
            trees = list(map(frozenset, networkx.connected_components(graph)))
            if networkx.is_forest(graph) and all(tree & kept for tree in trees):
                total = 1
                for edge in chosen:
                    total *= weights[edge]
                found[frozenset(tree & kept for tree in trees)] += total
    return found


@pytest.mark.full
@given(EDGES, st.sets(st.sampled_from(NODES), min_size=1, max_size=4), st.integers(0, 99))
def test_random_graphs(edges, kept, seed) -> None:
    draw = random.Random(seed)
    weights = {frozenset(edge): draw.randrange(1, 9) for edge in sorted(edges)}
    found = forests(weights, kept)
    assert {k: v for k, v in found.items() if v} == tried(weights, frozenset(kept))


@pytest.mark.full
def test_a_tangle_is_not_counted() -> None:
    tangle = {frozenset(edge): 1 for edge in combinations(range(14), 2)}
    assert forests(tangle, [0]) is None


@pytest.mark.parametrize("size", [12, 30])
def test_cayley_of_a_long_ladder(size) -> None:
    """A row of nodes all joined to the ground: Fibonacci numbers."""
    row = {frozenset((i, i + 1)): 1 for i in range(1, size)}
    ground = {frozenset((0, i)): 1 for i in range(1, size + 1)}
    a, b = 1, 1
    for _ in range(2 * size - 1):
        a, b = b, a + b
    assert forests(row | ground, [0]) == {frozenset([frozenset([0])]): a}
