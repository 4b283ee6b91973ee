"""Equality of networks up to numbering: nodes renumbered, parameters renamed one to one.

Both networks become coloured graphs. Vertices are nodes, elements, ports, and the names of ratios
and exponents, which several elements may share; an edge gives the place of an element or a port,
and its name. Two networks are the same if an isomorphism carries one graph to the other.

Colours are refined until all vertices of one colour have neighbours of the same colours. Where
several vertices have one colour, one is fixed on the left and every one is tried on the right.
THEOREM. If the refined colours of both graphs are equally frequent and each occurs once, they name
an isomorphism. Proof. Vertices of one colour have neighbours of the same colours over the same
labels, and a colour names one vertex on each side.
"""

from collections import Counter
from collections.abc import Hashable, Iterator, Mapping
from dataclasses import dataclass, field

from disting.model.chain import Sort
from disting.network.network import Element, Network

MOST_TRIALS = 2_000  # vertices that are fixed; symmetric networks need one for each of their twins
Vertex = tuple[object, ...]
Labels = Mapping[Vertex, Hashable]
Colours = dict[Vertex, int]


def is_same_network(left: Network, right: Network) -> bool:
    """Return True if both are one network up to numbers of nodes and names of parameters.

    Forces, sensors and their quantity must be the same, so networks that only behave alike are
    different. The ground is a node of its own for machines and compartments, and any node for
    circuits. A gear is the same if it is written from the same side. False too for regular graphs
    for which the search would be long; no notation of some few elements needs it.

    >>> from disting.network import network_of
    >>> one, other = network_of("R1-p(R2,C1)"), network_of("Rx 1 n; Ry n 0; C n 0; port 1 0")
    >>> is_same_network(one, other), is_same_network(one, network_of("p(R2,C1)-R1"))
    (True, False)
    """
    if left == right:
        return True
    if (left.sort, left.order, left.shape) != (right.sort, right.order, right.shape):
        return False
    if len(left.elements) != len(right.elements) or len(left.nodes) != len(right.nodes):
        return False
    return _Pair(_graph(left, 0), _graph(right, 1)).match({}, Counter())


@dataclass(frozen=True, slots=True)
class _Graph:
    """Labels of vertices, and neighbours of each with the label of the edge."""

    labels: dict[Vertex, Hashable] = field(default_factory=dict)
    near: dict[Vertex, list[tuple[Hashable, Vertex]]] = field(default_factory=dict)

    def add(self, vertex: Vertex, label: Hashable) -> None:
        """Add a vertex that is not there yet."""
        if vertex not in self.labels:
            self.labels[vertex] = label
            self.near[vertex] = []

    def join(self, one: Vertex, other: Vertex, label: Hashable) -> None:
        """Add an edge."""
        self.near[one].append((label, other))
        self.near[other].append((label, one))


def _graph(network: Network, side: int) -> _Graph:
    graph = _Graph()
    ends = {i for e in network.elements for i in e.nodes}
    ends |= {i for port in network.ports for i in (port.plus, port.minus)}
    for i in ends:
        is_ground = i == 0 and network.sort is not Sort.CIRCUIT
        graph.add((side, "node", i), ("ground" if is_ground else "node",))
    for at, element in enumerate(network.elements):
        vertex = (side, "element", at)
        graph.add(vertex, ("element", *_label(element)))
        for place, node in enumerate(element.nodes):
            graph.join(vertex, (side, "node", node), place if _is_directed(element) else "end")
        for name, label in _names(element):
            graph.add((side, label, name), (label,))
            graph.join(vertex, (side, label, name), label)
    for kind, ports in (("input", network.inputs), ("output", network.outputs)):
        for at, port in enumerate(ports):
            graph.add((side, kind, at), (kind, str(at)))
            graph.join((side, kind, at), (side, "node", port.plus), "plus")
            graph.join((side, kind, at), (side, "node", port.minus), "minus")
    return graph


def _label(element: Element) -> tuple[str, str]:
    """Kind, and a ratio that is a known number."""
    ratio = element.known_ratio
    return element.letter, "unknown" if ratio is None else str(ratio)


def _is_directed(element: Element) -> bool:
    """Return True if the ends differ: of flows, and of gears with a ratio other than 1."""
    return element.letter == "a" or element.known_ratio != 1


def _names(element: Element) -> Iterator[tuple[str, str]]:
    """Yield the names that other elements may have too."""
    if element.known_ratio is None:
        yield element.ratio, "ratio"
    if element.exponent:
        yield element.exponent, "exponent"


@dataclass(frozen=True, slots=True)
class _Pair:
    left: _Graph
    right: _Graph

    def match(self, fixed: Labels, trials: Counter[str]) -> bool:
        """Return True if an isomorphism respects the vertices that are fixed on both sides."""
        colours = self._refine(fixed)
        mine, others = ([colours[v] for v in graph.labels] for graph in (self.left, self.right))
        sizes = Counter(mine)
        if sizes != Counter(others):
            return False
        several = [colour for colour, size in sizes.items() if size > 1]
        if not several:
            return True
        colour = min(several, key=lambda c: (sizes[c], c))
        first = next(v for v in self.left.labels if colours[v] == colour)
        for twin in (v for v in self.right.labels if colours[v] == colour):
            trials["fixed"] += 1
            if trials["fixed"] > MOST_TRIALS:
                return False
            if self.match({**fixed, first: len(fixed), twin: len(fixed)}, trials):
                return True
        return False

    def _refine(self, fixed: Labels) -> Colours:
        near = self.left.near | self.right.near
        first = {
            v: (label, fixed.get(v, -1))
            for v, label in (self.left.labels | self.right.labels).items()
        }
        colours, count = _number_labels(first), 0
        while len(set(colours.values())) > count:
            count = len(set(colours.values()))
            colours = _number_labels(
                {
                    v: (colours[v], tuple(sorted((str(label), colours[w]) for label, w in near[v])))
                    for v in colours
                }
            )
        return colours


def _number_labels(labels: Labels) -> Colours:
    """Numbers of the labels, the same for equal ones."""
    numbers: dict[Hashable, int] = {}
    return {v: numbers.setdefault(label, len(numbers)) for v, label in labels.items()}
