"""Scene to SVG. Neighbours of equal style share one group, which keeps a matrix of thousands of
fields small.
"""

from collections.abc import Iterable
from itertools import groupby

from markupsafe import escape

from disting.report.scene import (
    FILE_PALETTE,
    Circle,
    Ink,
    Layer,
    Palette,
    Path,
    Rect,
    Scene,
    Shape,
    Text,
)

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
    return f'<g data-part="{escape(layer.name)}">{_styled(layer.shapes, palette)}</g>'


def _styled(shapes: Iterable[Shape], palette: Palette) -> str:
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
