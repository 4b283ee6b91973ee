"""A network as an engineer sketches it: machines with masses, springs, dampers and ground,
compartments with arrows, circuits in series and parallel as circuit diagrams, other circuits as
graphs.

A graph has nodes with what joins them, ground, forces and sensors. Nodes are in columns by their
distance from the force (the port, the input), so that no joint passes a node of a column between
its ends; a column in which a joint passes a third node is bent. What hangs at one node, a joint to
the ground, a force or a sensor, and every name takes the place round its node or joint where it
meets least of what is drawn before it.

A circuit diagram has what is in series from left to right, parallel parts
one above the other, each element with its name above it.
"""

from collections import Counter, defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import accumulate, combinations
from math import cos, pi, sin

from disting.general import AnyModel, as_chain
from disting.model.chain import Chain, Sensor, Sort
from disting.network import Element, Network
from disting.network.network import edges
from disting.report.drawing import draw
from disting.report.network_symbols import Sheet, Track, draw_symbol, gear
from disting.report.png import png
from disting.report.scene import (
    Anchor,
    Circle,
    Ink,
    Layer,
    Path,
    Place,
    Rect,
    Scene,
    Shape,
    Text,
    arrow,
    frame,
    svg,
)
from disting.report.words import plural

CELL = 66.0, 40.0  # of one element
LEAD = 13.0  # between parallel parts and the nodes at their ends
TERMINAL = 16.0


@dataclass(frozen=True, slots=True)
class Part:
    """An element, or parts "in series" or "in parallel"; `first`: the place of its first element in
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
    """Series-parallel tree of a one-port, from its plus end to its minus end; None for any other
    network.

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
            edges.append((a, b, _join_parts("parallel", part, other)))
            continue
        shared = ({a, b} & {c, d}).pop()
        edges.append((a + b - shared, c + d - shared, _join_parts("series", part, other)))
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


def _join_parts(form: str, *parts: Part) -> Part:
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


def _place_parts(part: Part, x: float, y: float) -> Iterator[tuple[Part, float, float]]:
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
    inside = list(_place_parts(part, x, y)) if part.parts else []
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
    for p, left, row in _place_parts(part, x, y) if part.parts else ():
        yield from _elements(p, left, row)


COLUMN, ROW = 112.0, 84.0  # from one node to the next; more where joints are parallel
RADIUS = {Sort.MACHINE: 17.0, Sort.CIRCUIT: 3.0, Sort.COMPARTMENTS: 18.0}  # of a node
ASIDE = 20.0  # between parallel joints
ARM = 62.0  # length of what hangs at a node, from its rim
DIRECTIONS = 16
LETTERS = 11.0


def port_signs(network: Network) -> tuple[list[str], list[str]]:
    """Signs of the inputs and outputs: F, or F1 and F2."""
    names = {
        Sort.MACHINE: ("F", "y"),
        Sort.CIRCUIT: ("i", "v"),
        Sort.COMPARTMENTS: ("in", "out"),
    }[network.sort]
    sides = network.inputs, network.outputs
    return tuple(
        [f"{name}{k}" if len(side) > 1 else name for k in range(1, len(side) + 1)]
        for name, side in zip(names, sides, strict=True)
    )  # type: ignore[return-value]


def graph_layers(network: Network) -> list[Layer]:
    """Layers of the drawing as a graph."""
    places = _places(network)
    radius = RADIUS[network.sort]
    sheet = Sheet()
    for i, place in places.items():
        sheet.add(f"node-{i}", _node(network, i, place))
    nodes, sheet.layers = sheet.layers, []
    joints, hanging = _joints(network, places)
    names = list[tuple[Element, Track, float]]()
    for ends, elements in joints.items():
        whole = Track(*(places[i] for i in ends))
        for e, aside in zip(elements, _asides(len(elements)), strict=True):
            track = whole.shifted(aside, radius)
            turned = Track(track.end, track.start) if e.nodes[0] != ends[0] else track
            sheet.add(e.value, (*_fan(whole, aside, radius), *_element(e, turned)))
            names.append((e, track, aside))
    for e, track, aside in names:
        sheet.add(f"name-{e.value}", (sheet.clearest(list(_names(e, track, aside))),))
    for place, kind, sign in _ends_of_ports(network, places):
        _arm_of_port(sheet, Track(place, place), kind, sign, radius)
    for i, elements in hanging.items():
        _arm_to_ground(sheet, places[i], elements, radius, network.sort)
    # nodes lie above the ends of what leads to them
    return [*sheet.layers, *nodes]


def _places(network: Network) -> dict[int, Place]:
    """Places of the nodes: column after column by their distance from the first input, a part that
    is not connected with it behind it.
    """
    kept = network.nodes if network.sort is not Sort.CIRCUIT else (*network.nodes, 0)
    members = {i for e in network.elements for i in e.nodes} | {
        i for p in network.ports for i in (p.plus, p.minus)
    }
    left = [i for i in kept if i in members]
    near = defaultdict[int, list[int]](list)
    for a, b in (edge for e in network.elements for edge in edges(e)[:1]):
        if {a, b} <= set(left):
            near[a].append(b)
            near[b].append(a)
    starts = [i for p in network.ports for i in (p.plus, p.minus)]
    places, x = dict[int, Place](), 0.0
    most = max(Counter(frozenset(e.nodes) for e in network.elements).values())
    row, width = ROW + 1.4 * ASIDE * most, COLUMN + 12 * (most - 1)
    while left:
        start = next((i for i in starts if i in left), left[0])
        for column in _columns(start, near):
            bent = len(column) > 2 and any(
                j in near[i] and abs(column.index(i) - column.index(j)) > 1
                for i, j in combinations(column, 2)
            )
            middle = (len(column) - 1) / 2
            for k, i in enumerate(column):
                bow = (1 - ((k - middle) / max(middle, 1)) ** 2) * 0.7 * width * bent
                places[i] = x + bow, (k - middle) * row
            x += width * (1 + 0.7 * bent)
            left = [i for i in left if i not in column]
    return places


def _columns(start: int, near: dict[int, list[int]]) -> Iterator[list[int]]:
    """The nodes that are 0, 1, 2, .. joints away, each column in the order of the one before."""
    visited, column = {start}, [start]
    while column:
        yield column
        column = list(dict.fromkeys(j for i in column for j in near[i] if j not in visited))
        visited |= set(column)


def _node(network: Network, i: int, place: Place) -> tuple[Shape, ...]:
    x, y = place
    radius = RADIUS[network.sort]
    if network.sort is Sort.CIRCUIT:
        return (Circle(x, y, radius, Ink.LINE),)
    if network.sort is Sort.COMPARTMENTS:
        return Circle(x, y, radius, Ink.BODY, Ink.LINE), Text(x, y, str(i), 13, bold=True)
    mass = next((e.value for e in network.elements if e.letter == "m" and e.nodes == (i,)), "")
    if not mass:
        return (Circle(x, y, 4, Ink.LINE),)
    box = Rect(x - radius, y - radius, 2 * radius, 2 * radius, Ink.BODY, Ink.LINE, radius=3)
    return box, Text(x, y, mass, 13 if len(mass) < 4 else 9, bold=True)


Joints = dict[tuple[int, int], list[Element]]


def _joints(network: Network, places: dict[int, Place]) -> tuple[Joints, dict[int, list[Element]]]:
    """The elements between two nodes, and those that hang at one, to the ground or the outside."""
    joints, hanging = Joints(), dict[int, list[Element]]()
    for e in network.elements:
        if e.kind.ends == 1:
            continue
        a, b = e.nodes
        if {a, b} <= set(places):
            joints.setdefault((min(a, b), max(a, b)), []).append(e)
        else:
            hanging.setdefault(a or b, []).append(e)
    return joints, hanging


def _asides(count: int) -> list[float]:
    """Offsets of parallel joints to the right of the straight line."""
    return [(k - (count - 1) / 2) * ASIDE for k in range(count)]


def _fan(whole: Track, aside: float, radius: float) -> Iterator[Path]:
    """From the nodes to the ends of a joint that lies aside."""
    if abs(aside) > 0.75 * radius:
        for along in (radius, whole.length - radius):
            yield Path((whole.at(along), whole.at(along, aside)))


def _element(e: Element, track: Track) -> tuple[Shape, ...]:
    return *draw_symbol(e.letter, track), *(gear(track) if e.ratio else ())


def _names(e: Element, track: Track, aside: float) -> Iterator[Text]:
    """Where the name of an element can be: outside first, next to its middle, then elsewhere."""
    name = f"{e.value} *{e.ratio}" if e.ratio else e.value
    outer = -1.0 if aside <= 0 else 1.0
    for shift in (0.0, -0.1, 0.1, -0.2, 0.2, -0.3, 0.3):
        for side in (outer, -outer):
            for away in (15.0, 19.0):
                yield _beside(name, track, track.length * (0.5 + shift), side, away)


def _beside(said: str, track: Track, along: float, side: float, away: float) -> Text:
    """A text next to a track, which begins or ends there unless the track is nearly level."""
    x, y = track.at(along, side * away)
    x0, _ = track.at(along)
    _, uy = track.direction
    if abs(uy) < 0.3:
        return Text(x, y, said, LETTERS, Ink.LABEL)
    anchor = Anchor.START if x > x0 else Anchor.END
    return Text(x - (3 if x > x0 else -3), y, said, LETTERS, Ink.LABEL, anchor)


def _arms(place: Place, radius: float, first: float, length: float = ARM) -> Iterator[Track]:
    """Ways from a node outwards, the first direction (in turns, 0 to the right, 1/4 down) and its
    neighbours before others.
    """
    x, y = place
    turns = sorted(range(DIRECTIONS), key=lambda k: (min(k, DIRECTIONS - k), k))
    for k in turns:
        angle = 2 * pi * (first + k / DIRECTIONS)
        ux, uy = cos(angle), sin(angle)
        yield Track(
            (x + radius * ux, y + radius * uy),
            (x + (radius + length) * ux, y + (radius + length) * uy),
        )


def _ends_of_ports(network: Network, places: dict[int, Place]) -> Iterator[tuple[Place, str, str]]:
    """Place, "force" or "sensor" (of a circuit both: "port"), and sign of each end of a port
    that is no ground.
    """
    both = network.sort is Sort.CIRCUIT and network.inputs == network.outputs
    sides = zip(
        ("force", "sensor"), (network.inputs, network.outputs), port_signs(network), strict=True
    )
    for kind, ports, signs in sides:
        for p, sign in zip(ports, signs, strict=True):
            for i, minus in ((p.plus, ""), (p.minus, "-")):
                if i in places and not (both and kind == "sensor"):
                    text = (minus or "+") if both else minus + sign
                    yield places[i], "port" if both else kind, text


def _arm_of_port(sheet: Sheet, at: Track, kind: str, sign: str, radius: float) -> None:
    """An arrow to a node for a force, a line with a dot and a box for a sensor, a terminal."""
    ink = {"force": Ink.FORCE, "sensor": Ink.SENSOR, "port": Ink.LINE}[kind]
    first = 0.5 if kind == "force" or sign == "+" else 0.0
    length = 26.0
    arms = list(_arms(at.start, radius, first, length))
    arm = min(arms, key=lambda t: sheet.crowd(Track(t.at(2), t.at(length + 22)), 11))
    half = 5.0 + 4 * max(len(sign), 1)
    x, y = arm.at(length + 8)
    x += (half - 9) * arm.direction[0]
    text = Text(x, y, sign, 12, ink, bold=True)
    lines: tuple[Shape, ...]
    if kind == "force":
        lines = (
            *arrow(arm.end, arm.start, ink),
            Rect(x - half, y - 9, 2 * half, 18, Ink.PAPER, ink, radius=9),
        )
    elif kind == "sensor":
        dot = Circle(*arm.at(3), 4, Ink.SENSOR if sign[0] != "-" else Ink.PAPER, ink)
        lines = (
            Path((arm.start, arm.end), ink, line=2),
            dot,
            Rect(x - half, y - 9, 2 * half, 18, Ink.PAPER, ink),
        )
    else:
        lines = Path((arm.start, arm.end)), Circle(*arm.end, 3.5, Ink.PAPER, ink)
    sheet.add(f"{kind}{sign}", (*lines, text))


def _arm_to_ground(
    sheet: Sheet, place: Place, elements: Sequence[Element], radius: float, sort: Sort
) -> None:
    """Joints of one node to the ground, side by side, with the piece of ground; flows outside."""
    half = 13.0 + ASIDE / 2 * (len(elements) - 1)
    arms = list(_arms(place, radius, 0.25))
    arm = min(arms, key=lambda t: sheet.crowd(Track(t.at(2), t.at(ARM + 8)), half))
    for e, aside in zip(elements, _asides(len(elements)), strict=True):
        track = arm.shifted(aside, 0)
        sheet.add(e.value, (*_fan_at(arm, aside, radius), *_element(e, track)))
    if sort is Sort.MACHINE:
        sheet.add("ground", hatching(arm, half))
    for e, aside in zip(elements, _asides(len(elements)), strict=True):
        names = list(_names(e, arm.shifted(aside, 0), aside))
        sheet.add(f"name-{e.value}", (sheet.clearest(names),))


def _fan_at(arm: Track, aside: float, radius: float) -> Iterator[Path]:
    if abs(aside) > 0.75 * radius:
        yield Path((arm.start, arm.at(0, aside)))


def hatching(arm: Track, half: float) -> Iterator[Path]:
    """A piece of ground at the end of an arm."""
    n = arm.length
    yield Path((arm.at(n, -half), arm.at(n, half)), line=2)
    for k in range(int(2 * half // 6)):
        aside = -half + 6 * k + 4
        yield Path((arm.at(n, aside), arm.at(n + 5, aside - 4)), Ink.MUTED, line=1)


def network_svg(network: Network) -> str:
    """Stand-alone SVG of a network.

    >>> from disting import network_of
    >>> network_svg(network_of("R0-p(R1,C1)"))[:4]
    '<svg'
    """
    return svg(draw_network(network))


def network_png(network: Network, *, scale: float = 3) -> bytes:
    """PNG of a network, `scale` pixels a unit. Raises InputError for a scale that is no positive
    number.

    >>> from disting import network_of
    >>> network_png(network_of("1=2=3, 2=4; F1; S4"))[1:4]
    b'PNG'
    """
    return png(draw_network(network), scale=scale)


def scene_of(model: Chain | AnyModel) -> Scene | None:
    """The drawing of a chain, or of a model that is a chain or a network; None of another one."""
    chain = as_chain(model)
    if chain is not None:
        return draw(chain)
    network = model.network if not isinstance(model, Chain) else None
    return draw_network(network) if network is not None else None


@lru_cache(maxsize=1_000)
def draw_network(network: Network) -> Scene:
    """The drawing of a network; each of its elements is one layer, named like its value."""
    whole = series_parallel(network)
    layers = circuit_layers(whole) if whole else graph_layers(network)
    return frame(layers, describe_network(network))


def describe_network(network: Network) -> str:
    """The network in words.

    >>> from disting.network.notation import network_of
    >>> describe_network(network_of("1>2, 2>0; in 1; out 2"))
    '2 compartments: a12 from 1 to 2, a20 from 2 to the outside; in at 1; out at 2.'
    """
    what = {
        Sort.MACHINE: plural(len(network.nodes), "mass", "masses"),
        Sort.CIRCUIT: plural(len(network.elements), "element"),
        Sort.COMPARTMENTS: plural(len(network.nodes), "compartment"),
    }[network.sort]
    joints = [_in_words(e, network.sort) for e in network.elements if e.kind.ends == 2]
    end = "the ground" if network.sort is Sort.MACHINE else "the outside"
    ports = []
    sides = network.inputs, network.outputs
    for signs, side in zip(port_signs(network), sides, strict=True):
        for sign, p in zip(signs, side, strict=True):
            other = f" against {p.minus or end}" if p.minus or network.sort is Sort.CIRCUIT else ""
            shown = f" ({list(Sensor)[network.order]})" if sign[0] == "y" else ""
            ports.append(f"{sign}{shown} at {p.plus}{other}")
    if network.inputs == network.outputs and network.sort is Sort.CIRCUIT:
        ports = [f"port between {p.plus} and {p.minus}" for p in network.inputs]
    return f"{what}: {', '.join(joints)}; {'; '.join(ports)}."


def _in_words(e: Element, sort: Sort) -> str:
    a, b = e.nodes
    if sort is Sort.COMPARTMENTS:
        return f"{e.value} from {a} to {b or 'the outside'}"
    ground = "the ground" if sort is Sort.MACHINE else "0"
    ratio = f", ratio {e.ratio}" if e.ratio else ""
    return f"{e.value} between {a or ground} and {b or ground}{ratio}"
