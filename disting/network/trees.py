"""Spanning forests of a graph counted by what they connect, with edges of many kinds as weights.

Nodes are taken one after another, the one with fewest neighbours first. What is kept of a forest is
which nodes that are still there hang together: so chains, trees and narrow loops have few states,
whatever their size.
"""

from collections import Counter
from collections.abc import Iterable, Mapping

Partition = frozenset[frozenset[int]]
Edge = frozenset[int]
MOST_STATES = 5000


def forests(weights: Mapping[Edge, int], kept: Iterable[int]) -> Mapping[Partition, int] | None:
    """For each way in which the nodes `kept` can hang together the sum, over the spanning forests
    that join them like that and hold no other tree, of the products of their edges' weights; None
    of a graph that has too many states.

    >>> triangle = {frozenset(edge): 1 for edge in ((0, 1), (1, 2), (0, 2))}
    >>> {len(trees): count for trees, count in forests(triangle, [0, 1]).items()}
    {2: 2, 1: 3}
    """
    held, left = frozenset(kept), dict(weights)
    inner = frozenset().union(*left) - held
    states = Counter({frozenset(frozenset([i]) for i in inner | held): 1})
    while inner or left:
        degree = Counter(i for edge in left for i in edge)
        node = min(inner or degree, key=lambda i: (degree[i], i))
        for edge in [edge for edge in left if node in edge]:
            states = _with_edge(states, edge, left.pop(edge))
        if node in inner:
            states, inner = _without(states, node), inner - {node}
        if len(states) > MOST_STATES:
            return None
    return states


def _with_edge(states: Counter[Partition], edge: Edge, weight: int) -> Counter[Partition]:
    """Without the edge and, where that closes no loop, with it."""
    found = Counter(states)
    for blocks, total in states.items():
        joined = frozenset(block for block in blocks if block & edge)
        if len(joined) > 1:
            found[blocks - joined | {frozenset().union(*joined)}] += total * weight
    return found


def _without(states: Counter[Partition], node: int) -> Counter[Partition]:
    """The node forgotten; a tree that holds no other one would end here."""
    found = Counter[Partition]()
    for blocks, total in states.items():
        (own,) = (block for block in blocks if node in block)
        if len(own) > 1:
            found[blocks - {own} | {own - {node}}] += total
    return found
