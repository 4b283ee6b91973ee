"""The simplest network of a normal form: what can replace each other became the same part.

Of the parts that give all of a set K(n, c, z) (see `normal_form`) the ladder is the simplest: all
its values are fractions of the coefficients of what it gives (Cauer's continued fraction). A tree
of compartments becomes a chain with the outflow where it hangs, for the same reason. Networks of
one normal form become one network with one numbering, as long as not too many nodes can be
exchanged.
"""

from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace
from functools import lru_cache
from itertools import islice, pairwise, permutations, product
from typing import Any

from disting.model.chain import Sort
from disting.network.gears import without_gears
from disting.network.network import KINDS, PHASE, Element, Network, Port
from disting.network.normal_form import NormalForm, Part, Power, dual, normal_form

REMEMBERED = 4096
TWO = 2
RESISTOR: Power = (0, "")  # its power of s; a spring has the same, and the lowest of a machine
MOST_ORDERS = 720  # of nodes that look alike
NumberedGraph = tuple[
    list[tuple[int, int]], list[tuple[tuple[int, int], Any]], list[tuple[int, Any]]
]
"""Ports, edges with what is there, nodes with what hangs there."""
Tree = Power | tuple[str, tuple["Tree", ...]]
"""The power of s of an element, or "S" or "P" and what is in series or parallel."""


@lru_cache(maxsize=REMEMBERED)
def simplest(network: Network, whole: Part | None = None) -> Network | None:
    """The simplest network that gives the same transfer functions for all positive values, special
    ones aside; None of a network without a normal form. `whole`: what a one-port is known to be.

    >>> from disting.network.notation import network_of
    >>> simplest(network_of("p(R1,C1)-p(R2,R3-C2)")).name
    'R1-p(C1,R2-p(C2,R3))'
    """
    plain = without_gears(network)
    form = None if plain is None else normal_form(plain)
    if plain is None or form is None:
        return None
    if whole is not None:
        port = plain.inputs[0]
        form = NormalForm(((port.minus, port.plus, whole),), ())
    ends, edges, nodes = min(canonical_numbers(plain, f) for f in _ways_round(plain, form))
    made = _Drawing(
        plain.sort, 1 + max(i for pair in (*ends, *(p for p, _ in edges)) for i in pair)
    )
    texts = [made.joint(label, *pair) for pair, label in edges]
    for i, (count, leaky) in nodes:
        made.compartments(i, count, leaky)
    ports = tuple(Port(plus, minus) for plus, minus in ends)
    inputs, outputs = ports[: len(plain.inputs)], ports[len(plain.inputs) :]
    is_one = plain.sort is Sort.CIRCUIT and len(texts) == 1 and inputs == outputs
    name = texts[0] if is_one else network_text(made.elements, inputs, outputs)
    return Network(tuple(made.elements), inputs, outputs, plain.order, name)


def _ways_round(network: Network, form: NormalForm) -> Iterator[NormalForm]:
    """Yield it, and with all flows turned round where that gives the same (see `outflows`)."""
    yield form
    if network.is_directed and network.inputs == network.outputs and network.shape == (1, 1):
        yield replace(form, edges=tuple(sorted((b, a, label) for a, b, label in form.edges)))


def network_text(
    elements: Iterable[Element], inputs: Iterable[Port], outputs: Iterable[Port]
) -> str:
    """Elements and ports as text."""
    words = [f"in {p.plus} {p.minus}" for p in inputs] + [
        f"out {p.plus} {p.minus}" for p in outputs
    ]
    return ", ".join([*map(str, elements), *words])


def same_drawing(network: Network, other: Network) -> bool:
    """Return True if they are one network with other numbers: no part is replaced.

    >>> from disting.network.notation import network_of
    >>> series, parallel = network_of("R1-p(R2,C1)"), network_of("p(R1,R2-C1)")
    >>> same_drawing(series, simplest(series)), same_drawing(parallel, simplest(parallel))
    (True, False)
    """
    return len(network.elements) == len(other.elements) and _plain(network) == _plain(other)


def same_but_for_gears(network: Network, other: Network) -> bool:
    """Return True if they are one machine without their gears, and at least one has gears (see
    `disting.network.gears`).

    >>> from disting.network.notation import network_of
    >>> same_but_for_gears(network_of("1~2*5/2; F1; S2"), network_of("1~2; F2; S1"))
    True
    """
    first, second = without_gears(network), without_gears(other)
    if first is None or second is None or (first is network and second is other):
        return False
    alike = (network.sort, network.order, network.shape) == (other.sort, other.order, other.shape)
    return alike and same_drawing(first, second)


def _plain(network: Network) -> NumberedGraph:
    """Every element by itself, in the smallest numbers."""
    ends = [(*e.nodes, 0)[:2] for e in network.elements]
    kinds = [(e.power, e.letter == "a") for e in network.elements]
    edges = tuple((a, b, kind) for (a, b), kind in zip(ends, kinds, strict=True))
    return canonical_numbers(network, NormalForm(edges, ()))


def canonical_numbers(network: Network, form: NormalForm) -> NumberedGraph:
    """Ports, edges and nodes in numbers, those of ports first: the smallest of what readings of the
    ports and orders of nodes that look alike make of them.
    """
    outside = (0,) if network.is_directed else ()  # it stays 0
    inside = {i for a, b, _ in form.edges for i in (a, b)} | {i for i, _ in form.nodes}
    the_pairs = list[NumberedGraph]()
    for ends in _readings(network):
        held = [i for plus, minus in ends for i in ((plus,) if outside else (minus, plus))]
        for order in _orders(form, held, sorted(inside - {*outside, *held}), bool(outside)):
            new = {i: at for at, i in enumerate(dict.fromkeys((*outside, *held, *order)))}
            pairs = [((new[a], new[b]), label) for a, b, label in form.edges]
            edges = [(p if outside else (min(p), max(p)), label) for p, label in pairs]
            ports = [(new[plus], new[minus]) for plus, minus in ends]
            the_pairs.append((ports, sorted(edges), sorted((new[i], x) for i, x in form.nodes)))
    return min(the_pairs)


def _orders(
    form: NormalForm, held: list[int], others: list[int], is_directed: bool
) -> Iterator[tuple[int, ...]]:
    """Yield the orders of the other nodes, those first that come first by their colours: what is at
    a node, then the colours of its neighbours, until no more nodes are distinguished.
    """
    everyone = dict.fromkeys((*held, *others))
    first = [(0, a, b, label) for a, b, label in form.edges] + [
        (int(is_directed), b, a, label) for a, b, label in form.edges
    ]
    hanging = dict(form.nodes)
    look: dict[int, Any] = {
        i: ([at for at, j in enumerate(held) if i == j], [hanging[i]] if i in hanging else [])
        for i in everyone
    }
    colours = 0
    while len(ranks := _rank_looks(look.values())) > colours:
        colours = len(ranks)
        colour = {i: ranks.index(look[i]) for i in everyone}
        look = {
            i: (
                colour[i],
                sorted((way, colour.get(b, -1), label) for way, a, b, label in first if a == i),
            )
            for i in everyone
        }
    groups = [[i for i in others if colour[i] == c] for c in range(colours)]
    alike = [permutations(group) for group in groups if group]
    for chosen in islice(product(*alike), MOST_ORDERS):
        yield tuple(i for group in chosen for i in group)


def _rank_looks(looks: Iterable[Any]) -> list[Any]:
    ranked = list[Any]()
    for look in sorted(looks):
        if not ranked or ranked[-1] != look:
            ranked.append(look)
    return ranked


def _readings(network: Network) -> Iterator[tuple[tuple[int, int], ...]]:
    """Yield the ports as they are, with all signs changed, and of one force and one sensor of a
    reciprocal network exchanged: the transfer functions are the same.
    """
    plain = tuple((p.plus, p.minus) for p in network.ports)
    orders = [plain]
    if network.shape == (1, 1) and not network.is_directed:
        orders.append(plain[::-1])
    for ports in orders:
        yield ports
        if not network.is_directed:
            yield tuple((minus, plus) for plus, minus in ports)


@dataclass(slots=True)
class _Drawing:
    """Elements as they are drawn; `free`: the next number of a node."""

    sort: Sort
    free: int
    elements: list[Element] = field(default_factory=list)
    count: Counter[str] = field(default_factory=Counter)

    def add(self, letter: str, *nodes: int, exponent: str = "") -> None:
        """One element, named by its number."""
        self.count[letter] += 1
        value = "" if letter == "v" else f"{letter}{self.count[letter]}"
        self.elements.append(Element(value, letter, nodes, exponent=exponent))

    def node(self) -> int:
        """A new one."""
        self.free += 1
        return self.free - 1

    def joint(self, label: object, a: int, b: int) -> str:
        """Text of an edge of a normal form."""
        if isinstance(label, Part):
            return self.part(label, a, b)
        self.add("a", a, b)
        return ""

    def part(self, part: Part, a: int, b: int) -> str:
        """A part between two nodes; as text."""
        return self.tree(_tree(part), a, b)

    def tree(self, tree: Tree, a: int, b: int) -> str:
        """Elements in series and parallel between two nodes; as text."""
        form, inside = tree
        if not isinstance(form, str) or isinstance(inside, str):
            halves, exponent = int(form), str(inside)
            self.add(self.letter(halves, exponent), a, b, exponent=exponent)
            return self.elements[-1].value
        if form == "P":
            return f"p({','.join([self.tree(part, a, b) for part in inside])})"
        ends = [a, *(self.node() for _ in inside[1:]), b]
        return "-".join(
            [self.tree(x, *pair) for x, pair in zip(inside, pairwise(ends), strict=True)]
        )

    def letter(self, halves: int, exponent: str) -> str:
        """Of the kind with this power of s."""
        kinds = (k for k in KINDS.values() if (k.sort, k.ends) == (self.sort, TWO))
        free = {k.halves: k.letter for k in kinds if k.letter != PHASE}
        return PHASE if exponent else free[halves]

    def compartments(self, at: int, count: int, leaky: bool) -> None:
        """A compartment, a chain of so many that hangs at it, and its outflow."""
        self.add("v", at)
        if leaky:
            self.add("a", at, 0)
        for _ in range(count):
            place = self.node()
            self.add("v", place)
            self.add("a", at, place)
            self.add("a", place, at)
            at = place


def _tree(part: Part) -> Tree:
    """A part in series and parallel, what is of two kinds as a ladder."""
    if len(part.kinds) <= TWO:
        return _ladder(part if part.form == "S" else dual(part))
    inside = [Part("S", (r,)) for r in part.single]
    inside += [Part(part.form, (), ((pair, n),)) for pair, n in part.terms]
    return part.form, tuple(map(_tree, (*inside, *part.others)))


def _ladder(part: Part) -> Tree:
    """F = [r_0] + 1/(c_1 x + 1/(r_1 + 1/(c_2 x + ..))), which ends with r_n, or with c_n x where F
    has a pole at x = 0. In 1/x F is of the same form, with the other kind for r: r is a resistor
    where there is one.
    """
    if len(part.kinds) == 1:
        return part.single[0]
    low, high = sorted(part.kinds)
    terms = dict(part.terms).get((low, high), 0)
    if high == RESISTOR:
        low, high = high, low
    tree: Tree | None = high if high in part.single else None
    for _ in range(terms):
        inner: Tree = ("S", (low, tree)) if tree else low
        tree = ("P", (high, inner))
    if low not in part.single:
        return tree or low
    return ("S", (low, tree)) if tree else low
