"""Linear networks: nodes, elements and ports, whatever they model.

    P(s; p) = sum_e p_e s^(r_e) u_e v_e^T ,     G(s; p) = s^q C P^-1 B

A machine shows motions per force, a circuit voltages per current, compartments contents per inflow.
q counts the differentiations of the sensor.

An element of value p connects nodes: it adds p s^r u v^T to the matrix P(s), where u gives the
nodes at which it acts and v what drives it; of a resistor, an inductor and a Warburg element 1/p
replaces p. The power r of a constant phase element is its exponent, a parameter that has a name.
Node 0 is the ground (a reference node, the outside) and has no row. As a graph, nodes and elements
show what is connected and what a port can measure.
"""

import re
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import lru_cache
from math import lcm
from typing import Any, TypeVar

from disting.errors import InputError, short
from disting.model.chain import Sort
from disting.model.presentation import NotebookPicture, plural, summary
from disting.quantities import refuse_improper


@dataclass(frozen=True, slots=True)
class Kind:
    """A kind of element: its letter, its name, and its term of P(s).

    `halves`: 2 r, as the power of s is a half for a Warburg element; `divides`: 1/p enters;
    `ends`: at how many nodes it sits.
    """

    letter: str
    word: str
    sort: Sort
    halves: int
    divides: bool = False
    ends: int = 2


_M, _C, _F = Sort
KINDS = {
    kind.letter: kind
    for kind in (
        Kind("m", "mass", _M, 4, ends=1),
        Kind("j", "inerter", _M, 4),
        Kind("d", "damper", _M, 2),
        Kind("k", "spring", _M, 0),
        Kind("R", "resistor", _C, 0, divides=True),
        Kind("L", "inductor", _C, -2, divides=True),
        Kind("C", "capacitor", _C, 2),
        Kind("W", "Warburg element", _C, 1, divides=True),
        Kind("P", "constant phase element", _C, 0),
        Kind("a", "flow", _F, 0),
        Kind("v", "compartment", _F, 2, ends=1),
    )
}


PHASE = "P"  # the letter of a constant phase element, whose exponent is a parameter


@dataclass(frozen=True, slots=True)
class Element:
    """One element: the name of its value (none of a compartment, whose contents are the state
    itself), the letter of its kind, the nodes at its ends, the ratio of a gear, and the exponent of
    a constant phase element.

    Kinds are m mass, j inerter, d damper, k spring; R resistor, L inductor, C capacitor, W Warburg
    element, P constant phase element; a flow, v compartment; the name of a value begins with the
    letter of its kind (of a damper b too). Node 0 is the ground. Of two ends i and j with a ratio
    g the element feels x_i - g x_j: g is the name of a parameter or a number such as "3/2". A flow
    goes from its first node to its second one. The admittance of a constant phase element is p s^n:
    n is the name of its exponent, n1 of P1 where none is given. Immutable and hashable. Raises
    InputError.

    >>> spring = Element("k12", "k", (1, 2), "3/2")
    >>> spring.kind.word, spring.parameters, str(spring)
    ('spring', ('k12',), 'k12 1 2 *3/2')
    >>> Element("P1", "P", (1, 2)).exponent
    'n1'
    """

    value: str
    letter: str
    nodes: tuple[int, ...]
    ratio: str = ""
    exponent: str = ""

    def __post_init__(self) -> None:
        if self.letter == PHASE and not self.exponent and isinstance(self.value, str):
            object.__setattr__(self, "exponent", f"n{self.value[1:]}")
        for problem in _problems_of_element(self):
            raise InputError(problem)

    @property
    def kind(self) -> Kind:
        """Kind of the element."""
        return KINDS[self.letter]

    @property
    def power(self) -> tuple[int, str]:
        """Its power of s: 2 r, and the exponent that is added to r."""
        return self.kind.halves, self.exponent

    @property
    def known_ratio(self) -> Fraction | None:
        """The ratio where it is a number: 1 without a gear."""
        return as_number(self.ratio) if self.ratio else Fraction(1)

    @property
    def parameters(self) -> tuple[str, ...]:
        """Its value, and a ratio that is unknown."""
        unknown = [self.ratio] if self.known_ratio is None else []
        return (*([self.value] if self.value else []), *unknown)

    @property
    def feels(self) -> dict[int, Fraction | str]:
        """The vector v, by nodes other than the ground; a text denotes minus a parameter."""
        first, *others = self.nodes
        if self.letter == "a" or not others:
            return {first: Fraction(1)}
        ratio = self.known_ratio
        number: Fraction | str = self.ratio if ratio is None else -ratio
        return {i: x for i, x in ((first, Fraction(1)), (others[0], number)) if i}

    @property
    def pulls(self) -> dict[int, Fraction | str]:
        """The vector u."""
        if self.letter != "a":
            return self.feels
        return {i: x for i, x in zip(self.nodes, (Fraction(1), Fraction(-1)), strict=True) if i}

    def __str__(self) -> str:
        where = " ".join(map(str, self.nodes))
        more = f" *{self.ratio}" if self.ratio else ""
        more += f" ^{self.exponent}" if self.exponent else ""
        return f"{self.value or self.letter} {where}{more}"


@dataclass(frozen=True, slots=True)
class Port:
    """Where a force acts or a current enters (+ at `plus`, - at `minus`), or what a sensor shows:
    x[plus] - x[minus]. Node 0 is the ground. Immutable and hashable. Raises InputError.

    >>> Port(3), Port(2, 1).ends
    (Port(plus=3, minus=0), {2: 1, 1: -1})
    """

    plus: int
    minus: int = 0

    def __post_init__(self) -> None:
        for end in (self.plus, self.minus):
            if type(end) is not int or end < 0:
                raise InputError(f"a port is at nodes 1, 2, .. or 0, the ground, not {short(end)}")

    @property
    def ends(self) -> dict[int, int]:
        """The vector b or c, by nodes other than the ground; nothing where both ends are one."""
        apart = self.plus != self.minus
        return {i: x for i, x in ((self.plus, 1), (self.minus, -1)) if i and apart}


def _problems_of_element(e: Element) -> Iterator[str]:
    """Yield what is wrong with one element, each with its remedy."""
    for text in (e.value, e.letter, e.ratio, e.exponent):
        if not isinstance(text, str):
            yield f"name, kind, ratio and exponent of an element are texts, not {short(text)}"
    if e.letter not in KINDS:
        yield f"kinds of elements are {_words(KINDS)}, not {short(e.letter)}"
    if not isinstance(e.nodes, tuple) or not all(type(i) is int for i in e.nodes):
        yield f"nodes of an element are a tuple of whole numbers, not {short(e.nodes)}"
    called = e.value or "one"
    if min(e.nodes, default=-1) < 0 or len(e.nodes) != e.kind.ends or len({*e.nodes}) < e.kind.ends:
        ends = {1: "one node", 2: "two different nodes"}[e.kind.ends]
        yield f"{called} is a {e.kind.word}: it sits at {ends}, 0 for the ground"
    if e.nodes[0] == 0 and e.kind.sort is Sort.COMPARTMENTS:
        yield (
            f"{called} is a {e.kind.word}: number compartments from 1; 0 is the outside, where a"
            " flow ends"
        )
    if e.nodes[0] == 0 and e.kind.ends == 1:
        yield f"{called} is a {e.kind.word}: it cannot be at the ground"
    if e.letter == "v" and e.value:
        yield f"{short(e.value)} is a compartment, which has no value: leave its name empty"
    if e.letter != "v" and not _is_name(e.value):
        yield f"{short(e.value)} is no name of a value: use letters, digits and _, and not s alone"
    if e.letter != "v" and kind_of(e.value) != e.kind:
        yield (
            f"{e.value} names a {kind_of(e.value).word}: begin the name of a {e.kind.word} with"
            f" {e.letter}"
        )
    if e.ratio and (e.kind.ends == 1 or e.letter == "a" or 0 in e.nodes):
        yield f"{called} has a ratio, as of a gear: that needs two nodes other than the ground"
    if e.exponent and e.letter != "P":
        yield f"{called} is a {e.kind.word}, which has no exponent: leave that away"
    if e.exponent and not _is_name(e.exponent):
        yield f"{short(e.exponent)} is no exponent: use a name such as n1"
    if e.known_ratio == 0:
        yield f"the ratio of {called} is zero: leave the gear away"
    if e.known_ratio is None and not _is_name(e.ratio):
        yield f"{short(e.ratio)} is no ratio: use a name other than s, or a number such as 3/2"


def _is_name(text: str) -> bool:
    """Return True if the text can name a value: s is the frequency variable."""
    return text.isidentifier() and text.isascii() and text != "s"


def _words(letters: Iterable[str]) -> str:
    return ", ".join(f"{letter} {KINDS[letter].word}" for letter in letters)


def as_number(text: str) -> Fraction | None:
    """The number that a text is: 3, 3/2, 0.25; None of another text."""
    if not re.fullmatch(r"\d{1,30}(\.\d{1,30}|/\d{1,30})?", text) or re.search(r"/0+$", text):
        return None
    return Fraction(text)


def kind_of(name: str) -> Kind:
    """Kind by the first letter of a name: b is a damper too, as of bearings; raises InputError.

    >>> kind_of("k12").word, kind_of("b2").word
    ('spring', 'damper')
    """
    letter = "d" if name[:1] == "b" else name[:1]
    if name[:3] == "CPE":
        raise InputError(f"{short(name)} is a constant phase element: call it P{name[3:]}")
    if letter not in KINDS or letter == "v":
        letters = _words(letter for letter in KINDS if letter != "v")
        raise InputError(f"{short(name)} begins with no letter of an element; there are {letters}")
    return KINDS[letter]


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
    found = set[int]()
    blocks: Iterable[Iterable[Any]] = networkx.biconnected_components(graph)
    for block in blocks:
        marks = {key[0] for key in block if isinstance(key, tuple)}
        if {"in", "out"} <= marks:
            found |= {at for at in marks if isinstance(at, int)}
    return frozenset(found)


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


MOST_NODES = 40
MOST_ELEMENTS = 300
MOST_PORTS = 10
PORTS = {
    Sort.MACHINE: (("a force", "F1"), ("a sensor", "S2")),
    Sort.CIRCUIT: (("a port", "port 1 0"),) * 2,
    Sort.COMPARTMENTS: (("an input", "in 1"), ("an output", "out 2")),
}  # what they are called, and an example as texts have it
REMEMBERED = 4096  # networks, of which it is known what is seen


@dataclass(frozen=True, slots=True)
class Network(NotebookPicture):
    """A linear network: `elements`, all of one sort; `inputs` and `outputs`, the ports of forces
    and sensors (of a circuit: where the current enters and the voltage is measured); `order`, how
    often what the sensors show is differentiated.

    Node 0 is the ground. Immutable and hashable; equal if all is but the name. Raises InputError.

    >>> from disting.network.network import Element, Port
    >>> r, c = Element("R", "R", (1, 0)), Element("C", "C", (1, 0))
    >>> Network((r, c), (Port(1),), (Port(1),)).parameters
    ('C', 'R')
    """

    elements: tuple[Element, ...]
    inputs: tuple[Port, ...]
    outputs: tuple[Port, ...]
    order: int = 0
    name: str = field(default="network", compare=False)

    def __post_init__(self) -> None:
        for problem in _problems(self):
            raise InputError(problem)

    def __repr__(self) -> str:
        size = f"{self.sort}, {plural(len(self.nodes), 'node')}"
        return summary(self, f"{self.name}, {size}, {', '.join(self.parameters)}")

    @property
    def sort(self) -> Sort:
        """Machine, circuit or compartments."""
        return self.elements[0].kind.sort

    @property
    def nodes(self) -> tuple[int, ...]:
        """All but the ground, sorted."""
        return tuple(sorted({i for e in self.elements for i in e.nodes} - {0}))

    @property
    def parameters(self) -> tuple[str, ...]:
        """Names of the values and of the ratios that are unknown, sorted."""
        return tuple(sorted({p for e in self.elements for p in e.parameters}))

    @property
    def exponents(self) -> tuple[str, ...]:
        """Names of the exponents of constant phase elements, sorted: parameters too, which enter
        as s^n.
        """
        return tuple(sorted({e.exponent for e in self.elements if e.exponent}))

    @property
    def shape(self) -> tuple[int, int]:
        """Numbers of outputs and inputs."""
        return len(self.outputs), len(self.inputs)

    @property
    def halves(self) -> bool:
        """True if half powers of s occur: those of Warburg elements."""
        return any(e.kind.halves % 2 for e in self.elements)

    @property
    def is_directed(self) -> bool:
        """True if elements work in one direction: flows."""
        return self.sort is Sort.COMPARTMENTS

    @property
    def sign_of_one_port(self) -> int:
        """1 where force and sensor, or current and voltage, are at the same two nodes, -1 where one
        is turned; 0 of another network, and of one with gears.
        """
        if self.is_directed or any(e.ratio for e in self.elements) or self.shape != (1, 1):
            return 0
        (force,), (sensor,) = self.inputs, self.outputs
        ways = {(force.plus, force.minus): 1, (force.minus, force.plus): -1}
        return ways.get((sensor.plus, sensor.minus), 0)

    @property
    def reference(self) -> int:
        """The node that potentials are measured against: the ground, of a circuit the negative
        node of its first port.
        """
        return self.inputs[0].minus if self.sort is Sort.CIRCUIT else 0

    @property
    def seen(self) -> tuple[Element, ...]:
        """The elements that can enter: for the others the place in the graph shows that they do
        not.
        """
        return _observable_elements(self)

    @property
    def unseen(self) -> tuple[str, ...]:
        """Parameters that do not enter, as their elements hang behind the ground or a node.

        >>> from disting.network import network_of
        >>> network_of("1~2, 2~#, 2~3; F1; S1").unseen
        ()
        >>> network_of("1~2, 2~#, 3~#; F1; S1").unseen
        ('k03', 'm3')
        """
        entering = {p for e in self.seen for p in (*e.parameters, e.exponent)}
        every = sorted((*self.parameters, *self.exponents))
        return tuple(p for p in every if p not in entering)

    @property
    def ratio_scale(self) -> int:
        """The smallest number that makes all ratios that are numbers whole."""
        ratios = (e.known_ratio for e in self.elements)
        return lcm(*(ratio.denominator for ratio in ratios if ratio is not None))

    @property
    def grounded(self) -> "Network":
        """Measurable part, with one node of every floating part as its ground; differences of
        potentials are unchanged by it. Nodes are renumbered from 1.

        Unobservable parts are contracted: in reciprocal networks no current flows in them, or none
        that a port measures. Compartments that are not observable are the outside.
        """
        observable, nodes = self.seen, (0, *self.nodes)
        if self.is_directed:
            rigid = [(0, i) for i in set(nodes) - {e.nodes[0] for e in observable}]
        else:
            whole = parts(nodes, (edge for e in self.elements for edge in edges(e)))
            rigid = [(0, i) for i in set(whole.values())]
            rigid += [edge for e in self.elements if e not in observable for edge in edges(e)]
        roots = parts(nodes, rigid)
        kept = sorted(set(roots.values()) - {0})
        numbers = {0: 0} | {i: at for at, i in enumerate(kept, 1)}
        places = {i: numbers[roots[i]] for i in nodes}
        moved = [Port(places[p.plus], places[p.minus]) for p in self.ports]
        return _build_unchecked(
            tuple(renumber(places, e) for e in observable),
            tuple(moved[: len(self.inputs)]),
            tuple(moved[len(self.inputs) :]),
            self,
        )

    @property
    def cells(self) -> tuple[tuple["Network", ...], ...]:
        """The network between each output and each input, a row for each output; where nothing is
        measured there is no path between both.
        """
        return tuple(
            tuple(_build_unchecked(self.elements, (enter,), (show,), self) for enter in self.inputs)
            for show in self.outputs
        )

    @property
    def ports(self) -> tuple[Port, ...]:
        """Inputs, then outputs."""
        return (*self.inputs, *self.outputs)


@lru_cache(maxsize=REMEMBERED)
def _observable_elements(network: Network) -> tuple[Element, ...]:
    find = seen_by_flows if network.is_directed else seen_by_blocks
    chosen = find(network.elements, network.inputs, network.outputs)
    return tuple(e for i, e in enumerate(network.elements) if i in chosen)


def _build_unchecked(
    elements: tuple[Element, ...],
    inputs: tuple[Port, ...],
    outputs: tuple[Port, ...],
    like: Network,
) -> Network:
    """Remainder of a network, which can be a port without any element or without a path; not
    validated.
    """
    made = object.__new__(Network)
    for name, value in (
        ("elements", elements),
        ("inputs", inputs),
        ("outputs", outputs),
        ("order", like.order),
        ("name", like.name),
    ):
        object.__setattr__(made, name, value)
    return made


def _problems(network: Network) -> Iterator[str]:
    """Yield what is wrong, each with its remedy."""
    for what, kind in (("elements", Element), ("inputs", Port), ("outputs", Port)):
        value = getattr(network, what)
        if not isinstance(value, tuple) or not all(isinstance(x, kind) for x in value):
            yield f"{what} of a network are a tuple of {kind.__name__}, not {short(value)}"
    if not isinstance(network.name, str) or not network.name.isprintable():
        yield f"the name of a network has printable characters only, not {short(network.name)}"
    elements, ports = network.elements, network.ports
    if not elements:
        yield "a network has at least one element"
    sorts = sorted({e.kind.sort for e in elements})
    if len(sorts) > 1:
        examples = (next(e.value for e in elements if e.kind.sort == s) for s in sorts)
        phrase = " and ".join(f"{x} of {s}" for x, s in zip(examples, sorts, strict=True))
        yield f"elements of one sort make a network, not {phrase}; describe them apart"
    if len(network.nodes) > MOST_NODES or len(elements) > MOST_ELEMENTS:
        yield (
            f"a network has {MOST_NODES} nodes and {MOST_ELEMENTS} elements at most, not"
            f" {len(network.nodes)} and {len(elements)}; leave away what is not seen"
        )
    yield from _problems_of_names(elements)
    yield from _problems_of_ports(network, ports)


def _problems_of_names(elements: Sequence[Element]) -> Iterator[str]:
    count = Counter(e.value for e in elements if e.value)
    for name in sorted(n for n, times in count.items() if times > 1):
        yield f"{name} is the value of {count[name]} elements: give each its own name"
    both = sorted({e.ratio for e in elements if e.known_ratio is None} & count.keys())
    if both:
        yield f"{both[0]} is a ratio and something else: give it its own name"
    used = {p for e in elements for p in e.parameters}
    for name in sorted({e.exponent for e in elements} & used):
        yield f"{name} is an exponent and something else: give it its own name"


def _problems_of_ends(network: Network, port: Port, what: str) -> Iterator[str]:
    nodes = (0, *network.nodes)
    missing = sorted({port.plus, port.minus} - {*nodes})
    if missing:
        yield (
            f"{what} is at node {missing[0]}, but no element is; nodes are"
            f" {', '.join(map(str, nodes))}"
        )
    if port.plus == port.minus:
        yield f"{what} is between node {port.plus} and itself: it needs two different ends"


def _problems_of_ports(network: Network, ports: Sequence[Port]) -> Iterator[str]:
    (entering, _), (seeing, _) = names = PORTS[network.sort]
    for side, (what, example) in zip((network.inputs, network.outputs), names, strict=True):
        if not side:
            yield f"{what} is missing: say where it is, such as {example} in a text"
    if len(ports) > 2 * MOST_PORTS:
        yield f"a network has {MOST_PORTS} inputs and outputs at most"
    for p in ports:
        yield from _problems_of_ends(network, p, entering if p in network.inputs else seeing)
    if type(network.order) is not int:
        yield f"the order of a network is a whole number, not {short(network.order)}"
    refuse_improper(network.order)
    if network.order and network.sort is not Sort.MACHINE:
        yield "only what sensors of machines show is differentiated: leave the order 0"
    held = {e.nodes[0] for e in network.elements if e.letter == "v"}
    if network.is_directed and set(network.nodes) - held:
        node = min(set(network.nodes) - held)
        yield f"a flow or a port is at node {node}, but no compartment: add the element v there"
    joined = [edge for e in network.elements for edge in edges(e)]
    ends = {i for p in ports for i in (p.plus, p.minus)}
    roots = parts({0, *network.nodes, *ends}, joined)
    lost = [i for i in network.nodes if roots[i]] if network.sort is Sort.MACHINE else []
    if lost:
        yield f"node {lost[0]} has no mass and no way to the rest: connect it or leave it away"
    for p in ports:
        if network.is_directed and (p.minus or not p.plus):
            yield f"a port is between nodes {p.plus} and {p.minus}: of compartments it is at one"
        if not network.is_directed and roots[p.plus] != roots[p.minus]:
            yield (
                f"a port is between nodes {p.plus} and {p.minus}, which no elements connect:"
                " connect them"
            )
    if not network.seen:
        yield f"there is no way from {entering} to {seeing}: connect them"
