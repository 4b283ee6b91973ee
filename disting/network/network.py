"""Linear networks: nodes, elements and ports, whatever they model.

    P(s; p) = sum_e p_e s^(r_e) u_e v_e^T ,     G(s; p) = s^q C P^-1 B

A machine shows motions per force, a circuit voltages per current, compartments contents per inflow.
q counts the differentiations of the sensor.
"""

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from math import lcm

from disting.errors import InputError, short
from disting.model.chain import Sort
from disting.model.presentation import NotebookPicture, plural, summary
from disting.network.element import Element, Port
from disting.network.graph import edges, parts, renumber, seen_by_blocks, seen_by_flows
from disting.quantities import refuse_improper

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
    and sensors (of a circuit: where the current enters and the voltage is seen); `order`, how often
    what the sensors show is differentiated.

    Node 0 is the ground. Immutable and hashable; equal if all is but the name. Raises InputError.

    >>> from disting.network.element import Element, Port
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
        """Whether half powers of s occur: those of Warburg elements."""
        return any(e.kind.halves % 2 for e in self.elements)

    @property
    def is_directed(self) -> bool:
        """Whether elements work in one direction: flows."""
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
        return _seen(self)

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
        """What is seen, with one node of every part that floats as its ground; differences of
        potentials do not change by it. Nodes are numbered anew from 1.

        What is not seen is contracted: of reciprocal networks no current flows in it, or none that
        a port sees. Compartments that are not seen are the outside.
        """
        seen, nodes = self.seen, (0, *self.nodes)
        if self.is_directed:
            rigid = [(0, i) for i in set(nodes) - {e.nodes[0] for e in seen}]
        else:
            whole = parts(nodes, (edge for e in self.elements for edge in edges(e)))
            rigid = [(0, i) for i in set(whole.values())]
            rigid += [edge for e in self.elements if e not in seen for edge in edges(e)]
        roots = parts(nodes, rigid)
        kept = sorted(set(roots.values()) - {0})
        numbers = {0: 0} | {i: at for at, i in enumerate(kept, 1)}
        places = {i: numbers[roots[i]] for i in nodes}
        moved = [Port(places[p.plus], places[p.minus]) for p in self.ports]
        return _unchecked(
            tuple(renumber(places, e) for e in seen),
            tuple(moved[: len(self.inputs)]),
            tuple(moved[len(self.inputs) :]),
            self,
        )

    @property
    def cells(self) -> tuple[tuple["Network", ...], ...]:
        """The network between each output and each input, a row for each output; where nothing is
        seen there is no way between both.
        """
        return tuple(
            tuple(_unchecked(self.elements, (enter,), (show,), self) for enter in self.inputs)
            for show in self.outputs
        )

    @property
    def ports(self) -> tuple[Port, ...]:
        """Inputs, then outputs."""
        return (*self.inputs, *self.outputs)


@lru_cache(maxsize=REMEMBERED)
def _seen(network: Network) -> tuple[Element, ...]:
    find = seen_by_flows if network.is_directed else seen_by_blocks
    chosen = find(network.elements, network.inputs, network.outputs)
    return tuple(e for i, e in enumerate(network.elements) if i in chosen)


def _unchecked(
    elements: tuple[Element, ...],
    inputs: tuple[Port, ...],
    outputs: tuple[Port, ...],
    like: Network,
) -> Network:
    """What is left of a network, which can be a port without any element or without a way."""
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
