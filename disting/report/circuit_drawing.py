"""A one-port in series and parallel as a circuit diagram: series from left to right, parallel parts
one above the other, each element with its name above it.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import accumulate

from disting.model.structure import Sort
from disting.network import Element, Network
from disting.report.network_symbols import Track, draw_symbol
from disting.report.scene import Anchor, Circle, Ink, Layer, Path, Place, Text

CELL = 66.0, 40.0  # of one element
LEAD = 13.0  # between parallel parts and the nodes at their ends
TERMINAL = 16.0


@dataclass(frozen=True, slots=True)
class Part:
    """An element, or parts "in series" or "in parallel"; `first`: where its first element stands in
    the network.
    """

    first: int
    element: Element | None = None
    form: str = ""
    parts: tuple["Part", ...] = ()

    @property
    def size(self) -> Place:
        """Width and height of its drawing."""
        if self.element:
            return CELL
        widths, heights = zip(*(part.size for part in self.parts), strict=True)
        if self.form == "series":
            return sum(widths), max(heights)
        return max(widths) + 2 * LEAD, sum(heights)


def series_parallel(network: Network) -> Part | None:
    """What a one-port is made of, from its plus end to its minus end; None of another network.

    Parts between the same two nodes are in parallel, parts that share a node that nothing else
    touches are in series; what becomes one part by that is in series and parallel (Duffin).
    """
    one_port = network.inputs == network.outputs and network.shape == (1, 1)
    if network.sort is not Sort.CIRCUIT or not one_port:
        return None
    port = network.inputs[0]
    edges = list[Edge]()
    for i, e in enumerate(network.elements):
        a, b = e.nodes
        edges.append((a, b, Part(i, e)))
    while len(edges) > 1:
        pair = _pair(edges, {port.plus, port.minus})
        if pair is None:
            return None
        (a, b, part), (c, d, other) = pair
        edges = [e for e in edges if e not in pair]
        if {a, b} == {c, d}:
            edges.append((a, b, _joined("parallel", part, other)))
            continue
        shared = ({a, b} & {c, d}).pop()
        edges.append((a + b - shared, c + d - shared, _joined("series", part, other)))
    a, b, whole = edges[0]
    if {a, b} != {port.plus, port.minus}:
        return None
    return _from(network, whole, port.plus)


Edge = tuple[int, int, Part]


def _pair(edges: list[Edge], kept: set[int]) -> tuple[Edge, Edge] | None:
    """Two edges that are one part."""
    for i, parts in enumerate(edges):
        for other in edges[i + 1 :]:
            shared = {*parts[:2]} & {*other[:2]}
            if len(shared) == 2:
                return parts, other
            if shared and not shared & kept:
                (node,) = shared
                if sum(node in e[:2] for e in edges) == 2:
                    return parts, other
    return None


def _joined(form: str, *parts: Part) -> Part:
    """Parts of the same form within become parts of the whole."""
    flat = [p for part in parts for p in (part.parts if part.form == form else (part,))]
    return Part(min(p.first for p in flat), None, form, tuple(flat))


def _from(network: Network, part: Part, start: int) -> Part:
    """The part with its series parts in the order in which they are met from a node, and parallel
    ones in the order of the network.
    """
    if part.element:
        return part
    if part.form == "parallel":
        inner = sorted((_from(network, p, start) for p in part.parts), key=lambda p: p.first)
        return Part(part.first, None, part.form, tuple(inner))
    left, inside = list(part.parts), []
    while left:
        next_part = next(p for p in left if start in _ends(p))
        left.remove(next_part)
        inside.append(_from(network, next_part, start))
        start = sum(_ends(next_part)) - start
    return Part(part.first, None, part.form, tuple(inside))


def _ends(part: Part) -> tuple[int, int]:
    """Both end nodes."""
    if part.element:
        a, b = part.element.nodes
        return a, b
    ends = [_ends(p) for p in part.parts]
    if part.form == "parallel":
        return ends[0]
    nodes = [i for pair in ends for i in pair]
    a, b = sorted(i for i in set(nodes) if nodes.count(i) == 1)
    return a, b


def circuit_layers(whole: Part) -> Iterator[Layer]:
    """Layers of the diagram, an element each, between its terminals."""
    width, _ = whole.size
    ends = (-TERMINAL, 0.0), (width + TERMINAL, 0.0)
    leads = (Path((ends[0], (0.0, 0.0))), Path(((width, 0.0), ends[1])))
    yield Layer("wires", (*leads, *_wires(whole, 0.0, 0.0)))
    yield from _elements(whole, 0.0, 0.0)
    for name, (x, y), sign in zip(("plus", "minus"), ends, "+-", strict=True):
        side = -9 if sign == "+" else 9
        circle = Circle(x, y, 3.5, Ink.PAPER, Ink.LINE)
        yield Layer(name, (circle, Text(x + side, y, sign, 13, Ink.MUTED)))


def _placed(part: Part, x: float, y: float) -> Iterator[tuple[Part, float, float]]:
    """The parts within, each with its left end and the height of its middle."""
    if part.form == "series":
        widths = [p.size[0] for p in part.parts]
        yield from zip(part.parts, accumulate(widths, initial=x), [y] * len(widths), strict=False)
        return
    top = y - part.size[1] / 2
    for p in part.parts:
        width, height = p.size
        yield p, x + (part.size[0] - width) / 2, top + height / 2
        top += height


def _wires(part: Part, x: float, y: float) -> Iterator[Path | Circle]:
    """Upright lines at both ends of parallel parts, and lines from them to the parts."""
    inside = list(_placed(part, x, y)) if part.parts else []
    if part.form == "parallel":
        right = x + part.size[0]
        rows = [row for *_, row in inside]
        for end in (x, right):
            yield Path(((end, rows[0]), (end, rows[-1])))
            yield Circle(end, y, 2.5, Ink.LINE)
        for p, left, row in inside:
            yield Path(((x, row), (left, row)))
            yield Path(((left + p.size[0], row), (right, row)))
    for p, left, row in inside:
        yield from _wires(p, left, row)


def _elements(part: Part, x: float, y: float) -> Iterator[Layer]:
    if part.element:
        e, width = part.element, part.size[0]
        name = Text(x + width / 2, y - 16, e.value, 11, Ink.LABEL, Anchor.MIDDLE)
        yield Layer(e.value, (*draw_symbol(e.letter, Track((x, y), (x + width, y))), name))
    for p, left, row in _placed(part, x, y) if part.parts else ():
        yield from _elements(p, left, row)
