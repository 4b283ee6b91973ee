"""Elements of a figure: a few frozen shapes in layers. `svg` and `png` turn a scene into a file.

Colours are roles (`Ink`), so that the same scene serves a page that knows light and dark, and a
stand-alone file. Coordinates run to the right and downwards, in pixels at scale 1.

In SVG, neighbours of equal style share one group, which keeps a matrix of thousands of
fields small.
"""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from enum import StrEnum
from itertools import groupby
from math import hypot

from markupsafe import escape

Place = tuple[float, float]


class Ink(StrEnum):
    """Role of a colour; NONE draws nothing."""

    NONE = "none"
    LINE = "line"
    MUTED = "muted"
    LABEL = "label"
    PAPER = "paper"
    BODY = "body"
    FORCE = "force"
    SENSOR = "sensor"
    DISTINGUISHABLE = "distinguishable"
    ON_DISTINGUISHABLE = "on-distinguishable"
    INDISTINGUISHABLE = "indistinguishable"
    ON_INDISTINGUISHABLE = "on-indistinguishable"
    SOMETIMES = "sometimes"
    ON_SOMETIMES = "on-sometimes"
    UNDECIDED = "undecided"
    OPEN = "open"


Palette = Mapping[Ink, str]

FILE_PALETTE: Palette = {
    Ink.NONE: "none",
    Ink.LINE: "#16202b",
    Ink.MUTED: "#5a6673",
    Ink.LABEL: "#16202b",
    Ink.PAPER: "#ffffff",
    Ink.BODY: "#e9eef3",
    Ink.FORCE: "#b0300a",
    Ink.SENSOR: "#006b52",
    Ink.DISTINGUISHABLE: "#0072b2",
    Ink.ON_DISTINGUISHABLE: "#ffffff",
    Ink.INDISTINGUISHABLE: "#f0a818",
    Ink.ON_INDISTINGUISHABLE: "#16130a",
    Ink.SOMETIMES: "#cc79a7",
    Ink.ON_SOMETIMES: "#16130a",
    Ink.UNDECIDED: "#818c98",
    Ink.OPEN: "#cdd5dd",
}
"""Explicit colours for stand-alone files."""

PAGE_PALETTE: Palette = {ink: f"var(--{ink})" for ink in Ink} | {
    Ink.NONE: "none",
    Ink.LINE: "currentColor",
}
"""Colours that the page's style sheet gives, light or dark."""


class Anchor(StrEnum):
    """Where a text begins, as seen from its point."""

    START = "start"
    MIDDLE = "middle"
    END = "end"


@dataclass(frozen=True, slots=True)
class Rect:
    """Rectangle with its upper left corner at (x, y)."""

    x: float
    y: float
    width: float
    height: float
    fill: Ink = Ink.NONE
    stroke: Ink = Ink.NONE
    line: float = 1.5
    radius: float = 0


@dataclass(frozen=True, slots=True)
class Path:
    """Line through points, closed if it is filled."""

    points: tuple[Place, ...]
    stroke: Ink = Ink.LINE
    fill: Ink = Ink.NONE
    line: float = 1.5


@dataclass(frozen=True, slots=True)
class Circle:
    """Circle around (x, y)."""

    x: float
    y: float
    radius: float
    fill: Ink = Ink.NONE
    stroke: Ink = Ink.NONE
    line: float = 1.5


@dataclass(frozen=True, slots=True)
class Text:
    """One line of text, vertically centred at y."""

    x: float
    y: float
    text: str
    size: float = 12
    fill: Ink = Ink.LINE
    anchor: Anchor = Anchor.MIDDLE
    bold: bool = False

    @property
    def baseline(self) -> float:
        """y of the line of the baseline."""
        return self.y + 0.35 * self.size


Shape = Rect | Path | Circle | Text


@dataclass(frozen=True, slots=True)
class Layer:
    """Shapes that together show one thing, such as the spring k12."""

    name: str
    shapes: tuple[Shape, ...]


@dataclass(frozen=True, slots=True)
class Scene:
    """A figure: its size, its layers from back to front, and what it shows in words."""

    width: float
    height: float
    layers: tuple[Layer, ...]
    title: str = ""

    @property
    def shapes(self) -> Iterator[Shape]:
        """All shapes from back to front."""
        return (shape for layer in self.layers for shape in layer.shapes)


HEAD = 8.0  # length of an arrow's head


def arrow(start: Place, end: Place, ink: Ink) -> tuple[Path, ...]:
    """A straight shaft and a filled head whose tip is `end`."""
    length = hypot(end[0] - start[0], end[1] - start[1])
    ux, uy = (end[0] - start[0]) / length, (end[1] - start[1]) / length
    neck = (end[0] - HEAD * ux, end[1] - HEAD * uy)
    half = 0.45 * HEAD
    wings = ((neck[0] - half * uy, neck[1] + half * ux), (neck[0] + half * uy, neck[1] - half * ux))
    return Path((start, neck), ink, line=2), Path((end, *wings), Ink.NONE, ink)


def extent(shape: Shape) -> tuple[float, float, float, float]:
    """Box (left, top, right, bottom) around a shape; a text counts 0.62 em a letter."""
    match shape:
        case Rect(x, y, width, height):
            return x, y, x + width, y + height
        case Circle(x, y, radius):
            return x - radius, y - radius, x + radius, y + radius
        case Path(points):
            xs, ys = zip(*points, strict=True)
            return min(xs), min(ys), max(xs), max(ys)
        case Text(x, y, text, size):
            width = 0.62 * size * len(text)
            left = (
                x - {Anchor.START: 0.0, Anchor.MIDDLE: 0.5, Anchor.END: 1.0}[shape.anchor] * width
            )
            return left, y - size / 2, left + width, y + size / 2


MARGIN = 8.0  # around shapes that stand anywhere


def frame(layers: Iterable[Layer], title: str) -> Scene:
    """A scene of shapes at any place: moved so that all lie in it, with a margin."""
    drawn = tuple(layers)
    boxes = [extent(shape) for layer in drawn for shape in layer.shapes]
    left, top = (min(box[i] for box in boxes) - MARGIN for i in (0, 1))
    right, bottom = (max(box[i] for box in boxes) + MARGIN for i in (2, 3))
    moved = (
        Layer(layer.name, tuple(_move_shape(shape, -left, -top) for shape in layer.shapes))
        for layer in drawn
    )
    return Scene(right - left, bottom - top, tuple(moved), title)


def _move_shape(shape: Shape, dx: float, dy: float) -> Shape:
    if isinstance(shape, Path):
        return replace(shape, points=tuple((x + dx, y + dy) for x, y in shape.points))
    return replace(shape, x=shape.x + dx, y=shape.y + dy)


NAMESPACE = "http://www.w3.org/2000/svg"
FONT = "system-ui, 'Segoe UI', Roboto, 'Liberation Sans', 'DejaVu Sans', Arial, sans-serif"


def svg(scene: Scene) -> str:
    """A stand-alone SVG document on paper of its colour."""
    size = f'width="{number(scene.width)}" height="{number(scene.height)}"'
    return (
        f'<svg xmlns="{NAMESPACE}" {size} viewBox="0 0 {number(scene.width)}'
        f' {number(scene.height)}" role="img"><title>{escape(scene.title)}</title><rect {size}'
        f' fill="{FILE_PALETTE[Ink.PAPER]}"/>{body(scene, FILE_PALETTE)}</svg>\n'
    )


def body(scene: Scene, palette: Palette) -> str:
    """The scene's elements without the enclosing svg element."""
    common = f'font-family="{FONT}" stroke-linejoin="round" stroke-linecap="round"'
    return f"<g {common}>{''.join(draw_layer(layer, palette) for layer in scene.layers)}</g>"


def number(value: float) -> str:
    """Shortest text of a coordinate to a hundredth.

    >>> number(12.0), number(0.125), number(-0.001)
    ('12', '0.12', '0')
    """
    text = f"{value:.2f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def draw_layer(layer: Layer, palette: Palette) -> str:
    """A layer's elements, without the font and the round ends of lines that all layers share."""
    return f'<g data-part="{escape(layer.name)}">{_style_shapes(layer.shapes, palette)}</g>'


def _style_shapes(shapes: Iterable[Shape], palette: Palette) -> str:
    runs = groupby(shapes, key=lambda shape: _style(shape, palette))
    return "".join(f"<g {style}>{''.join(map(_element, run))}</g>" for style, run in runs)


def _style(shape: Shape, palette: Palette) -> str:
    if isinstance(shape, Text):
        weight = ' font-weight="600"' if shape.bold else ""
        return (
            f'fill="{palette[shape.fill]}" font-size="{number(shape.size)}"'
            f' text-anchor="{shape.anchor}"{weight}'
        )
    stroke = (
        f' stroke="{palette[shape.stroke]}" stroke-width="{number(shape.line)}"'
        if shape.stroke != Ink.NONE
        else ""
    )
    return f'fill="{palette[shape.fill]}"{stroke}'


def _element(shape: Shape) -> str:
    match shape:
        case Rect(x, y, width, height):
            corner = f' rx="{number(shape.radius)}"' if shape.radius else ""
            return (
                f'<rect x="{number(x)}" y="{number(y)}" width="{number(width)}"'
                f' height="{number(height)}"{corner}/>'
            )
        case Circle(x, y, radius):
            return f'<circle cx="{number(x)}" cy="{number(y)}" r="{number(radius)}"/>'
        case Path(points):
            way = "L".join(f"{number(x)} {number(y)}" for x, y in points)
            return f'<path d="M{way}{"" if shape.fill == Ink.NONE else "z"}"/>'
        case Text(x, _, text):
            return f'<text x="{number(x)}" y="{number(shape.baseline)}">{escape(text)}</text>'
