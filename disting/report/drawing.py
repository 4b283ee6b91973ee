"""A chain as an engineer sketches it: wall, masses, springs, dampers, actuator above, sensor below.

ground      force F: a circle on a bar above the masses, arrows push on the masses at its ends
  |/   k01  sensor y: a box on a bar below; filled dot: the measured mass, open dot: the reference
  |/--zz--[m1]  gap  [m2]

Every part carries the name of its parameter: a mass inside, a spring above it, a damper below it, a
damper to the ground on the left of its cup. Where names and signs stand, nothing else passes:
above and below the middle of a joint; upright lines are at masses only.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache

from disting.model.chain import Chain
from disting.model.structure import Element
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
)
from disting.report.svg import svg

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
    said = [row + (" with dampers beside the springs" if chain.damped else "")]
    only = "a damper but no spring" if chain.gap_damper else "no spring"
    said += [f"{only} between {_node(chain.gap)} and {_node(chain.gap + 1)}"]
    said += [f"force from {_node(chain.act_minus)} on {_node(chain.act_plus)}"]
    measured, reference = _node(chain.meas_plus), _node(chain.meas_minus)
    said += [f"{chain.sensor.value} of {measured} relative to {reference}"]
    said += [f"damper from mass {i} to the ground" for i in chain.ground_dampers]
    said += ["first-order lag of the force"] if chain.lag else []
    said += ["dead time"] if chain.dead_time else []
    return "; ".join(said) + "."


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
    """The name of a parameter beside its part."""
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
    """Dashpot that hangs from a mass and stands on a piece of ground."""
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
    """What the force passes before it acts, in words."""
    said = [("T1", "lag T1")] if at.chain.lag else []
    said += [("Td", "dead time Td")] if at.chain.dead_time else []
    for place, (name, text) in enumerate(said):
        yield Layer(name, (Text(WALL + 9 + 50 * place, 10, text, 11, Ink.FORCE, Anchor.START),))
