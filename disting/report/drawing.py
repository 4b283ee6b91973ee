"""A chain as an engineer sketches it: wall, masses, springs, dampers, actuator above, sensor below.

ground      force F: a circle on a bar above the masses, arrows push on the masses at its ends
  |/   k01  sensor y: a box on a bar below; filled dot: the measured mass, open dot: the reference
  |/--zz--[m1]  gap  [m2]

Every part carries the name of its parameter: a mass inside, a spring above it, a damper below it, a
damper to the ground on the left of its cup. Nothing crosses names and signs: above and below the
middle of a joint; upright lines are at masses only.

A page holds each drawing once, and shows it wherever it refers to it. Drawings share their parts: a
mass, a spring, a place of the force is held once by a page. Dampers to the ground are parts of
their own, one a mass, laid over the drawing of any chain of that size; where one crosses the bar of
a sensor the bar is broken, as in the drawing of a single chain.

What an experiment adds is drawn too. A further sensor is a bar below that of the first; a moved
force replaces that of the chain; a locked mass is clamped between two pieces of ground; what is
added is a block with its sign on the mass, +J for a known inertia. Each is a layer over the drawing
of any chain of the size, so that a page holds it once.
"""

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache

from markupsafe import Markup

from disting.experiments.changes import Change
from disting.experiments.menu import Item
from disting.model.chain import Chain, Element
from disting.model.kinds import FORCE, SENSOR, Kind
from disting.report.png import png
from disting.report.scene import (
    PAGE_PALETTE,
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
    draw_layer,
    number,
    svg,
)

WALL = 15.0  # x of the wall's face
MASS = 32.0  # side of a mass
JOINT = 36.0  # length of a spring
PITCH = MASS + JOINT
NOTE = 16.0  # height of the line that tells lag and dead time
RISE = 38.0  # from the middle of the masses to the actuator's and to the sensor's bar
PORT = 13.0  # height of a bar with its sign, from the middle
LETTERS = 11.0  # size of the name of a spring or a damper
BESIDE = 21.5  # from the middle of the masses to the names of springs and of dampers
LOWER = 25.0  # from one sensor's bar to that of a further one
STEM = 11.0  # a ground damper hangs this far left of its mass's middle


@dataclass(frozen=True, slots=True)
class Layout:
    """Where things are in the drawing of one chain; `more`: bars of further sensors."""

    chain: Chain
    more: int = 0

    @property
    def axis(self) -> float:
        """y of the masses' middle."""
        return RISE + PORT + (NOTE if self.chain.lag or self.chain.dead_time else 0)

    @property
    def width(self) -> float:
        """Width of the drawing; the notes on the force need room above one mass."""
        row = WALL + PITCH * self.chain.n_masses + 6
        return max(row, 165.0) if self.chain.lag or self.chain.dead_time else row

    @property
    def height(self) -> float:
        """Height of the drawing."""
        bars = RISE + PORT + LOWER * self.more
        return self.axis + bars + 32 * bool(self.chain.ground_dampers)

    def middle(self, node: int) -> float:
        """x of a mass's middle, of the wall's face for the ground."""
        return WALL + PITCH * node - MASS / 2 if node else WALL

    def joint(self, node: int) -> tuple[float, float]:
        """x where the joint between a node and its right neighbour begins and ends."""
        return WALL + PITCH * node, WALL + PITCH * node + JOINT

    def joint_middle(self, node: int) -> float:
        """x of the middle of the joint between a node and its right neighbour."""
        return WALL + PITCH * node + JOINT / 2

    def sign(self, ends: tuple[int, int]) -> float:
        """x of the sign on the bar between two nodes: at a joint near its middle, where no post
        is.
        """
        return self.joint_middle((sum(ends) - 1) // 2)


def chain_svg(chain: Chain) -> str:
    """Stand-alone SVG of a chain.

    >>> chain_svg(Chain(2))[:4]
    '<svg'
    """
    return svg(draw(chain))


def chain_png(chain: Chain, *, scale: float = 3) -> bytes:
    """PNG of a chain, `scale` pixels a unit. Raises InputError for a scale that is no positive
    number.

    >>> chain_png(Chain(2))[1:4]
    b'PNG'
    """
    return png(draw(chain), scale=scale)


@lru_cache(maxsize=1_000)  # asked for again and again: every experiment is drawn on it
def draw(chain: Chain, more: int = 0) -> Scene:
    """The drawing of a chain, with room for bars of `more` further sensors; each of its elements
    is one layer, named like its parameter; the force is the last.
    """
    at = Layout(chain, more)
    elements = (Layer(e.parameter, _element(e, at)) for e in chain.structure.elements)
    return Scene(
        at.width,
        at.height,
        (*_ground(at), *elements, _gap(at), _sensor(at), *_notes(at), _force(at)),
        describe(chain),
    )


def describe(chain: Chain) -> str:
    """The chain in words.

    >>> describe(Chain(2, 1, 1, 2, 1, 2, damped=False)).split("; ")[1:3]
    ['no spring between mass 1 and mass 2', 'force from mass 1 on mass 2']
    """
    row = "1 mass" if chain.n_masses == 1 else f"{chain.n_masses} masses in a row"
    words = [row + (" with dampers beside the springs" if chain.damped else "")]
    only = "a damper but no spring" if chain.gap_damper else "no spring"
    words += [f"{only} between {_node(chain.gap)} and {_node(chain.gap + 1)}"]
    words += [f"force from {_node(chain.act_minus)} on {_node(chain.act_plus)}"]
    measured, reference = _node(chain.meas_plus), _node(chain.meas_minus)
    words += [f"{chain.sensor.value} of {measured} relative to {reference}"]
    words += [f"damper from mass {i} to the ground" for i in chain.ground_dampers]
    words += ["first-order lag of the force"] if chain.lag else []
    words += ["dead time"] if chain.dead_time else []
    return "; ".join(words) + "."


def _node(index: int) -> str:
    return f"mass {index}" if index else "the ground"


def _element(element: Element, at: Layout) -> tuple[Shape, ...]:
    name = element.parameter
    match element.kind:
        case "m":
            return _mass(name, at.middle(element.at), at.axis)
        case "k":
            spring = _spring(*at.joint(element.at), at.axis - 8 * at.chain.damped)
            return spring, _label(name, at.joint_middle(element.at), at.axis - BESIDE)
        case "d":
            damper = _damper(*at.joint(element.at), at.axis + 9)
            return *damper, _label(name, at.joint_middle(element.at), at.axis + BESIDE)
        case _:
            x = at.middle(element.at) - STEM
            label = _label(name, x - 8, at.height - 21, Anchor.END)
            return *_ground_damper(x, at), label


def _label(name: str, x: float, y: float, anchor: Anchor = Anchor.MIDDLE) -> Text:
    """The name of a parameter next to its part."""
    return Text(x, y, name, LETTERS, Ink.LABEL, anchor)


def _mass(label: str, x: float, y: float) -> tuple[Shape, ...]:
    box = Rect(x - MASS / 2, y - MASS / 2, MASS, MASS, Ink.BODY, Ink.LINE, radius=3)
    return box, Text(x, y, label, 13, bold=True)


def _spring(x0: float, x1: float, y: float) -> Path:
    """Zigzag of three periods between two straight ends."""
    lead, turns = 5.0, 6
    step = (x1 - x0 - 2 * lead) / turns
    tops = ((x0 + lead + (i + 0.5) * step, y + (-6 if i % 2 == 0 else 6)) for i in range(turns))
    return Path(((x0, y), (x0 + lead, y), *tops, (x1 - lead, y), (x1, y)))


def _damper(x0: float, x1: float, y: float) -> tuple[Shape, ...]:
    """Dashpot: a cup open to the right and a piston in it."""
    left, piston = x0 + 11, x0 + 18
    cup = Path(((x1 - 10, y - 5), (left, y - 5), (left, y + 5), (x1 - 10, y + 5)))
    return (
        Path(((x0, y), (left, y))),
        cup,
        Path(((piston, y - 3), (piston, y + 3)), line=2.5),
        Path(((piston, y), (x1, y))),
    )


def _ground_damper(x: float, at: Layout) -> tuple[Shape, ...]:
    """Dashpot that hangs from a mass above a piece of ground."""
    top, foot = at.axis + MASS / 2, at.height - 9
    piston = foot - 13
    cup = Path(((x - 5, piston - 4), (x - 5, foot - 7), (x + 5, foot - 7), (x + 5, piston - 4)))
    rod = Path(((x, top), (x, piston)))
    return (
        rod,
        cup,
        Path(((x - 3, piston), (x + 3, piston)), line=2.5),
        Path(((x, foot - 7), (x, foot))),
        Path(((x - 9, foot), (x + 9, foot)), line=2),
        *(Path(((x + dx, foot), (x + dx - 4, foot + 5)), Ink.MUTED, line=1) for dx in (-4, 1, 6)),
    )


def _ground(at: Layout) -> Iterator[Layer]:
    """The hatched wall, as high as what is fixed to it; nothing if nothing is."""
    ports = [-RISE] if at.chain.act_minus == 0 else []
    ports += [RISE] if at.chain.meas_minus == 0 else []
    reach = [y + side for y in ports for side in (-9, 9)]
    reach += [-MASS / 2 - 3, MASS / 2 + 3] if at.chain.gap > 0 else []
    if reach:
        top, bottom = at.axis + min(reach), at.axis + max(reach)
        strokes = range(round(top) + 8, round(bottom) + 1, 7)
        hatching = (Path(((WALL, y - 8), (WALL - 8, y)), Ink.MUTED, line=1) for y in strokes)
        yield Layer("ground", (*hatching, Path(((WALL, top), (WALL, bottom)), line=2.5)))


def _gap(at: Layout) -> Layer:
    y = at.axis - 9 * at.chain.gap_damper
    return Layer("gap", (Text(at.joint_middle(at.chain.gap), y, "gap", 11, Ink.MUTED),))


def _force(at: Layout) -> Layer:
    return Layer("force", force_bar(at, (at.chain.act_minus, at.chain.act_plus)))


def force_bar(at: Layout, ends: tuple[int, int]) -> tuple[Shape, ...]:
    """Bar with arrows that push apart what it connects, minus and plus mass; the ground's end is
    fixed to the wall.
    """
    y = at.axis - RISE
    x0, x1 = map(at.middle, ends)
    centre = at.sign(ends)
    posts = [_post(at.middle(i), at.axis - MASS / 2, y - 4, Ink.FORCE) for i in ends if i]
    back = (
        arrow((centre, y), (x0 + 1, y), Ink.FORCE)
        if ends[0]
        else (Path(((centre, y), (x0 + 2, y)), Ink.FORCE, line=2),)
    )
    sign = (
        Circle(centre, y, 9, Ink.PAPER, Ink.FORCE),
        Text(centre, y, "F", 12, Ink.FORCE, bold=True),
    )
    return (*posts, *back, *arrow((centre, y), (x1 - 1, y), Ink.FORCE), *sign)


def _sensor(at: Layout) -> Layer:
    ends = at.chain.meas_minus, at.chain.meas_plus
    return Layer("sensor", sensor_bar(at, ends, at.axis + RISE, "y"))


def sensor_bar(
    at: Layout, ends: tuple[int, int], y: float, sign: str, aside: float = 0.0
) -> tuple[Shape, ...]:
    """Bar from the reference (open dot, or the wall) to the measured mass (filled dot); `aside`:
    how far right of the middle of a mass it hangs.
    """
    x0, x1 = (at.middle(i) + (aside if i else 0) for i in ends)
    centre = at.sign(ends)
    posts = [
        _post(x, at.axis + MASS / 2, y, Ink.SENSOR)
        for x, i in zip((x0, x1), ends, strict=True)
        if i
    ]
    bar = [
        Path(((a, y), (b, y)), Ink.SENSOR, line=2)
        for a, b in _pieces(x0 + 2 * (not ends[0]), x1, _stems(at))
    ]
    dots = [Circle(x0, y, 3.5, Ink.PAPER, Ink.SENSOR, 2)] if ends[0] else []
    dots += [Circle(x1, y, 4.5, Ink.SENSOR)]
    box = (
        Rect(centre - 8, y - 8, 16, 16, Ink.PAPER, Ink.SENSOR),
        Text(centre, y - 1, sign, 12 if len(sign) == 1 else 10.5, Ink.SENSOR, bold=True),
    )
    return (*posts, *bar, *dots, *box)


def _post(x: float, y0: float, y1: float, ink: Ink) -> Path:
    return Path(((x, y0), (x, y1)), ink, line=2)


def _stems(at: Layout) -> tuple[float, ...]:
    return tuple(at.middle(i) - STEM for i in at.chain.ground_dampers)


def _pieces(x0: float, x1: float, cuts: tuple[float, ...]) -> Iterator[Place]:
    """The parts of x0..x1 that keep clear of vertical lines at the cuts."""
    inside = [c for c in cuts if x0 < c < x1]
    return zip([x0, *(c + 4 for c in inside)], [*(c - 4 for c in inside), x1], strict=True)


def _notes(at: Layout) -> Iterator[Layer]:
    """Elements that the force passes before it acts, in words."""
    notes = [("T1", "lag T1")] if at.chain.lag else []
    notes += [("Td", "dead time Td")] if at.chain.dead_time else []
    for place, (name, text) in enumerate(notes):
        yield Layer(name, (Text(WALL + 9 + 50 * place, 10, text, 11, Ink.FORCE, Anchor.START),))


@dataclass(frozen=True)
class Drawing:
    """A chain's drawing, held once by a page and shown wherever it is referred to."""

    number: int
    scene: Scene

    @property
    def label(self) -> str:
        """Description of the drawing in words."""
        return f"A{self.number}: {self.scene.title}"

    @cached_property
    def layers(self) -> tuple[str, ...]:
        """Drawn once: the pages of a model, of its twins and of the family show them."""
        return tuple(draw_layer(layer, PAGE_PALETTE) for layer in self.scene.layers)

    @property
    def width(self) -> str:
        """Natural width [px]."""
        return number(self.scene.width)

    @property
    def box(self) -> str:
        """viewBox."""
        return f"0 0 {number(self.scene.width)} {number(self.scene.height)}"


@dataclass(frozen=True, slots=True)
class Part:
    """Something that several drawings show."""

    name: str
    layer: Layer

    @property
    def definition(self) -> Markup:
        """The part itself; the style sheet sets the font and the ends of lines."""
        return Markup(f'<g id="{self.name}">{draw_layer(self.layer, PAGE_PALETTE)}</g>')


def share(drawings: Iterable[Drawing], more: Iterable[Part] = ()) -> Markup:
    """Share the parts of drawings on a page: parts, each once, with `more` of them; and the
    drawings, which refer to their parts from back to front. All but the last, the force of a chain,
    is a part of its own, rest-5 of chain-5.

    >>> two = [Drawing(k, draw(Chain(2, meas_plus=k, damped=False))) for k in (1, 2)]
    >>> share(two).count('<g id="part-'), share(two).count("<use")
    (8, 14)
    """
    numbers, lines = dict[str, int](), list[str]()
    for n, layers in ((d.number, d.layers) for d in drawings):
        at = (numbers.setdefault(layer, len(numbers)) for layer in layers)
        *rest, force = (f'<use href="#part-{i}"/>' for i in at)
        lines.append(f'<g id="chain-{n}"><g id="rest-{n}">{"".join(rest)}</g>{force}</g>')
    parts = (f'<g id="part-{i}">{layer}</g>' for layer, i in numbers.items())
    return Markup("\n".join([*parts, *(part.definition for part in more), *lines]))


def ground_dampers(n_masses: int) -> Iterator[Part]:
    """The damper from each mass to the ground, as a part named ground-1, ground-2, .."""
    masses = tuple(range(1, n_masses + 1))
    at = Layout(all_dampers(n_masses))
    dampers = {layer.name: layer for layer in draw(at.chain).layers}
    for mass in masses:
        x, y = at.middle(mass) - STEM, at.axis + RISE
        broken = Path(((x, y - 2), (x, y + 2)), Ink.PAPER, line=6)
        yield Part(f"ground-{mass}", Layer(f"b{mass}", (broken, *dampers[f"b{mass}"].shapes)))


def height_with_dampers(n_masses: int) -> float:
    """Height of a drawing with dampers to the ground."""
    return Layout(all_dampers(n_masses)).height


def all_dampers(n_masses: int) -> Chain:
    """A chain with a damper to the ground at every mass."""
    return replace(Chain(n_masses, damped=False), ground_dampers=tuple(range(1, n_masses + 1)))


SMALL = 0.62  # of the natural width
ASIDE = 9.0  # x of a further sensor's post, from the middle of its mass
BLOCK = (17.0, 12.0)  # what is added
JAW = 18.0  # half of the width of the ground that holds a locked mass
Port = tuple[int, int]
"""Plus and minus mass; 0 is the ground."""


@dataclass(frozen=True, slots=True)
class Sketch:
    """The small drawing of a model of a catalogue under experiments, made of what the page holds:
    `parts` are their names, `label` describes the picture; `size` in pixels at scale 1.
    """

    size: tuple[float, float]
    parts: tuple[str, ...]
    label: str

    @property
    def width(self) -> str:
        """Width [px]."""
        return number(SMALL * self.size[0])

    @property
    def box(self) -> str:
        """viewBox."""
        return f"0 0 {number(self.size[0])} {number(self.size[1])}"


def sketch(model: int, chain: Chain, items: Sequence[Item]) -> Sketch:
    """The drawing of a model that its page holds, with what these items add."""
    moved = any(item.kind == FORCE for item in items)
    below = draw(chain, sum(item.kind == SENSOR for item in items))
    text = " and ".join(item.text for item in items)
    parts = (f"{'rest' if moved else 'chain'}-{model}", *(f"more-{_name(i)}" for i in items))
    return Sketch((below.width, below.height), parts, f"A{model}: {text}")


def additions(used: Iterable[tuple[Chain, Item]]) -> list[Part]:
    """Parts of sketches in addition to the drawings of the chains, each once."""
    layers = {layer.name: layer for layer in (draw_item(*pair) for pair in used)}
    return [Part(f"more-{name}", layer) for name, layer in sorted(layers.items())]


def state(
    chain: Chain,
    sensors: Mapping[str, Port],
    changes: Sequence[Change[int]] = (),
    force: Port | None = None,
) -> Scene:
    """A chain with the sensors that are read in one state of the machine, each under its sign; "y"
    is that of the chain, as is a `force` that is None.
    """
    further = [sign for sign in sensors if sign != "y"]
    first = int("y" in sensors)
    at = Layout(chain, len(further) + first - 1)
    own = draw(chain, at.more)
    layers = [layer for layer in own.layers if layer.name != "sensor" or first]
    for place, sign in enumerate(further, first):
        layers.append(Layer(f"sensor {sign}", further_sensor(at, sensors[sign], place, sign)))
    if force:
        moved = (*_wall(at.axis - RISE), *force_bar(at, (force[1], force[0])))
        layers = [*(layer for layer in layers if layer.name != "force"), Layer("force", moved)]
    height = Counter[int]()
    for change in changes:
        shapes = on_mass(at, change.kind, change.place, height[change.place])
        layers.append(Layer(f"{change.kind.name} {change.place}", shapes))
        height[change.place] += change.kind.takes_size
    return replace(own, layers=tuple(layers))


def draw_item(chain: Chain, item: Item) -> Layer:
    """Layer that one item adds to the drawing of a chain; layers of one name are the same for all
    chains of the size.
    """
    at, node = Layout(chain), item.at
    name = _name(item)
    if item.kind == SENSOR:
        return Layer(name, further_sensor(at, (node, 0), 1, "y2"))
    if item.kind == FORCE:
        return Layer(name, (*_wall(at.axis - RISE), *force_bar(at, (0, node))))
    return Layer(name, on_mass(at, item.kind, node))


def _name(item: Item) -> str:
    return f"{item.kind.name}-{item.at}"


def on_mass(at: Layout, kind: Kind, node: int, height: int = 0) -> tuple[Shape, ...]:
    """A change of the machine: what holds the mass, or a block on it and on so many others."""
    return block(at, node, f"+{kind.sign}", height) if kind.takes_size else clamp(at, node)


def further_sensor(at: Layout, port: Port, place: int, sign: str) -> tuple[Shape, ...]:
    """The bar of a further sensor, `place` bars below that of the first, with the piece of the
    wall where it is fixed to that.
    """
    y = at.axis + RISE + LOWER * place
    wall = () if port[1] else tuple(_wall(y))
    return *wall, *sensor_bar(at, (port[1], port[0]), y, sign, ASIDE)


def clamp(at: Layout, node: int) -> tuple[Shape, ...]:
    """The ground that holds a mass from above and below."""
    x, shapes = at.middle(node), list[Shape]()
    for side in (-1, 1):
        y = at.axis + side * (MASS / 2 + 1.5)
        starts = [x + 2 * side + 6.4 * (k - 2.5) for k in range(6)]
        shapes += [Path(((a, y), (a - 4 * side, y + 5 * side)), Ink.MUTED, line=1) for a in starts]
        shapes.append(Path(((x - JAW, y), (x + JAW, y)), line=3))
    return tuple(shapes)


def block(at: Layout, node: int, sign: str, height: int = 0) -> tuple[Shape, ...]:
    """Block added to a mass, left of the post of a force, on top of `height` others."""
    width, depth = BLOCK
    x = at.middle(node) - 2.5 - width / 2
    y = at.axis - (MASS + depth) / 2 - height * (depth - 0.5)  # neighbours share a line
    box = Rect(x - width / 2, y - depth / 2, width, depth, Ink.PAPER, Ink.LINE, radius=2)
    return box, Text(x, y, sign, 10.5, bold=True)


def _wall(y: float) -> Iterator[Shape]:
    """A piece of the wall, hatched as the whole is."""
    for end in (y - 1, y + 6):
        yield Path(((WALL, end - 8), (WALL - 8, end)), Ink.MUTED, line=1)
    yield Path(((WALL, y - 9), (WALL, y + 9)), line=2.5)


def parts_of(chains: Iterable[Chain]) -> tuple[Part, ...]:
    """The layers of some chains' drawings, each once."""
    named = {part_name(chain, layer): layer for chain in chains for layer in draw(chain).layers}
    return tuple(Part(name, layer) for name, layer in named.items())


def part_name(chain: Chain, layer: Layer) -> str:
    """Name of a layer's part: what the layer shows, and what its place depends on.

    >>> two = Chain(2, damped=True)
    >>> [part_name(two, layer) for layer in draw(two).layers][-4:]
    ['part-d12', 'part-gap-0', 'part-sensor-0-1', 'part-force-0-1']
    """
    depends = {
        "ground": (int(chain.gap > 0),),
        "gap": (chain.gap,),
        "force": (chain.act_minus, chain.act_plus),
        "sensor": (chain.meas_minus, chain.meas_plus),
    }
    # a spring makes room for the damper below it
    above = ("damped",) if chain.damped and layer.name.startswith("k") else ()
    return "-".join(map(str, ("part", layer.name, *depends.get(layer.name, ()), *above)))
