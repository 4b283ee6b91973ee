"""What an experiment adds to the drawing of a chain.

A further sensor is a bar below that of the first; a moved force stands for that of the chain; a
locked mass is clamped between two pieces of ground; what is added is a block with its sign on the
mass, +J for a known inertia. Each is a layer over the drawing of any chain of the size, so that a
page holds it once.
"""

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from disting.experiments.changes import Change
from disting.experiments.menu import Item
from disting.model.chain import Chain
from disting.model.kinds import FORCE, SENSOR, Kind
from disting.report.drawing import (
    LOWER,
    MASS,
    RISE,
    WALL,
    Layout,
    draw,
    force_bar,
    sensor_bar,
)
from disting.report.page_drawing import Part
from disting.report.scene import Ink, Layer, Path, Rect, Scene, Shape, Text
from disting.report.svg import number

SMALL = 0.62  # of the natural width
ASIDE = 9.0  # x of a further sensor's post, from the middle of its mass
BLOCK = (17.0, 12.0)  # what is added
JAW = 18.0  # half of the width of the ground that holds a locked mass
Port = tuple[int, int]
"""Plus and minus mass; 0 is the ground."""


@dataclass(frozen=True, slots=True)
class Sketch:
    """The small drawing of a model of a catalogue under experiments, made of what the page holds:
    `parts` are their names, `label` says what is seen; `size` in pixels at scale 1.
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
    """What sketches are made of beside the drawings of the chains, each once."""
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
    """What one item adds to the drawing of a chain; layers of one name are the same for all chains
    of the size.
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
    """What is added to a mass, left of the post of a force, on top of `height` others."""
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
