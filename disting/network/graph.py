"""Nodes and elements of a network as a graph: what is connected, what a port can see."""

from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any, TypeVar

from disting.network.element import Element, Port

Edge = tuple[int, int]
L = TypeVar("L")


def edges(element: Element) -> tuple[Edge, ...]:
    """Between which nodes it goes: a mass is felt against the ground; a gear of a ratio other than
    1 pushes against its casing, so it joins both nodes and the ground.
    """
    first, *others = element.nodes
    second = others[0] if others else 0
    if element.ratio and element.known_ratio != 1 and first and second:
        return (first, second), (first, 0), (second, 0)
    return ((first, second),)


def parts(nodes: Iterable[int], joined: Iterable[Edge]) -> dict[int, int]:
    """For each node the smallest one that it is connected with."""
    root = {node: node for node in nodes}

    def found(node: int) -> int:
        while root[node] != node:
            node = root[node]
        return node

    for a, b in joined:
        low, high = sorted((found(a), found(b)))
        root[high] = low
    return {node: found(node) for node in root}


def seen_by_blocks(
    elements: Sequence[Element], inputs: Iterable[Port], outputs: Iterable[Port]
) -> frozenset[int]:
    """Positions of the elements that can enter a transfer function of a reciprocal network.

    With an edge for each port, they lie in a block (a 2-connected component) with the edges of an
    input and of an output. Proof. P = sum p s^r u u^T, so det P is a sum over spanning trees, and
    c^T adj P b one over forests of two trees that both port edges connect. A block that is left out
    meets the rest in one node, so both sums have its own sum over trees as a factor, which cancels.
    """
    import networkx  # imported late: it takes longer than most of what is asked

    joined: list[tuple[Edge, tuple[int | str, int]]] = [
        *((edge, (at, i)) for at, e in enumerate(elements) for i, edge in enumerate(edges(e))),
        *(((p.plus, p.minus), ("in", i)) for i, p in enumerate(inputs)),
        *(((p.plus, p.minus), ("out", i)) for i, p in enumerate(outputs)),
    ]
    # networkx knows blocks of graphs without parallel edges: every edge gets a node in its middle
    graph: networkx.Graph[Any] = networkx.Graph()
    for (a, b), key in joined:
        graph.add_edges_from(((a, key), (key, b)))
    seen = set[int]()
    blocks: Iterable[Iterable[Any]] = networkx.biconnected_components(graph)
    for block in blocks:
        marks = {key[0] for key in block if isinstance(key, tuple)}
        if {"in", "out"} <= marks:
            seen |= {at for at in marks if isinstance(at, int)}
    return frozenset(seen)


def reachable(elements: Sequence[Element], start: Iterable[int], backwards: bool) -> set[int]:
    """Compartments that flows reach from some, or from which some are reached."""
    nodes = set(start)
    while True:
        more = {
            ends[not backwards]
            for ends in (e.nodes for e in elements if e.letter == "a")
            if ends[backwards] in nodes
        }
        if more <= nodes | {0}:
            return nodes
        nodes |= more - {0}


def seen_by_flows(
    elements: Sequence[Element], inputs: Iterable[Port], outputs: Iterable[Port]
) -> frozenset[int]:
    """Positions of the elements of compartments that can enter: those of compartments that an input
    reaches, and from which an output is reached. Others have a block of zeros in P.
    """
    ahead = reachable(elements, [p.plus for p in inputs], False)
    behind = reachable(elements, [p.plus for p in outputs], True)
    return frozenset(i for i, e in enumerate(elements) if e.nodes[0] in ahead & behind)


def renumber(places: Mapping[int, int], element: Element) -> Element:
    """The element at other nodes, of which one can be the ground unless it is a gear."""
    nodes = tuple(places[i] for i in element.nodes)
    ratio = "" if element.known_ratio == 1 else element.ratio
    return replace(element, nodes=nodes, ratio=ratio)


def join(
    labelled: Iterable[tuple[tuple[int, ...], L]],
    kept: Iterable[int],
    in_series: Callable[[Iterable[L]], L],
    in_parallel: Callable[[Iterable[L]], L],
) -> dict[frozenset[int], L]:
    """Labels of edges by their ends, when edges in parallel, and in series at nodes that are not
    `kept`, have become one. An edge of one end goes to the ground.
    """
    between: dict[frozenset[int], list[L]] = {}
    for nodes, label in labelled:
        between.setdefault(frozenset((*nodes, 0)[:2]), []).append(label)
    edges, held = {ends: in_parallel(labels) for ends, labels in between.items()}, set(kept)
    while True:
        degree = Counter(i for ends in edges for i in ends)
        at = next((i for i, count in degree.items() if count == 2 and i not in held), None)
        if at is None:
            return edges
        meeting = [ends for ends in edges if at in ends]
        across = frozenset().union(*meeting) - {at}
        made = in_series(edges.pop(ends) for ends in meeting)
        edges[across] = in_parallel([edges[across], made]) if across in edges else made


def move(e: Element, places: Mapping[int, int]) -> Element | None:
    """The element at other nodes; None of one whose ends are the same node."""
    nodes = tuple(places[i] for i in e.nodes)
    if len(nodes) == 1:
        return None if nodes[0] == 0 else replace(e, nodes=nodes)
    if nodes[0] == nodes[1]:
        return None
    return replace(e, nodes=nodes if nodes[0] else nodes[::-1])
