"""Scene to PNG with Pillow: drawn larger than requested and reduced, which smooths the edges.

The letters are Pillow's own scalable font, so that no font has to be installed; it knows ASCII
only.
"""

from functools import cache
from io import BytesIO
from math import inf

from PIL import Image, ImageDraw, ImageFont

from disting.errors import InputError, short
from disting.report.scene import (
    FILE_PALETTE,
    Anchor,
    Circle,
    Ink,
    Path,
    Rect,
    Scene,
    Shape,
    Text,
    extent,
)

BAND = 128  # pixels
SLACK = 8  # pixels that a shape may reach beyond its extent, with its line
ANCHORS = {Anchor.START: "ls", Anchor.MIDDLE: "ms", Anchor.END: "rs"}


def png(
    scene: Scene,
    *,
    scale: float = 2,
    oversample: int = 3,
    colours: int = 0,
) -> bytes:
    """PNG bytes, `scale` pixels a unit, on paper of its colour; `colours`: at
    most so many, a file of a third of the size, 0 as many as there are. Raises InputError for a
    scale that is no positive number.
    """
    if not 0 < scale < inf:
        raise InputError(f"the scale of a picture is a positive number, not {short(scale)}")
    width, height = (max(1, round(side * scale)) for side in (scene.width, scene.height))
    image = Image.new("RGB", (width, height), FILE_PALETTE[Ink.PAPER])
    # band by band: drawn larger as a whole, the widest figures take 100 MB
    for top, shapes in zip(range(0, height, BAND), _by_band(scene, scale, height), strict=True):
        rows = top, min(top + BAND, height)
        image.paste(_band(shapes, width, rows, scale, oversample), (0, top))
    out = BytesIO()
    # 6: a twentieth larger than at 9, which takes half of the time of all figures
    if colours:
        image = image.quantize(colours, method=Image.Quantize.FASTOCTREE, dither=Image.Dither.NONE)
    image.save(out, "PNG", compress_level=6)
    return out.getvalue()


def _by_band(scene: Scene, scale: float, height: int) -> list[list[Shape]]:
    """The shapes that reach into each band, or into the slack around it, in their order."""
    bands: list[list[Shape]] = [[] for _ in range(0, height, BAND)]
    for shape in scene.shapes:
        _, upper, _, lower = extent(shape)
        first = int(upper * scale - SLACK) // BAND
        last = int(lower * scale + 2 * SLACK) // BAND
        for band in bands[max(0, first) : last + 1]:
            band.append(shape)
    return bands


def _band(
    shapes: list[Shape],
    width: int,
    rows: tuple[int, int],
    scale: float,
    oversample: int,
) -> Image.Image:
    """The picture between two rows. What begins above the canvas is rounded otherwise: not in the
    band itself.
    """
    first = max(0, rows[0] - SLACK)
    size = width * oversample, (rows[1] - first) * oversample
    canvas = Image.new("RGB", size, FILE_PALETTE[Ink.PAPER])
    pen = ImageDraw.Draw(canvas)
    for shape in shapes:
        _draw(pen, shape, scale * oversample, first * oversample)
    return canvas.reduce(oversample).crop((0, rows[0] - first, width, rows[1] - first))


def _draw(pen: ImageDraw.ImageDraw, shape: Shape, k: float, top: int) -> None:
    """Draw a shape, k pixels a unit, on a canvas that begins so many pixels below the scene's."""
    fill = _colour(shape.fill)
    match shape:
        case Text(x, _, text):
            bold = round(0.03 * shape.size * k) if shape.bold else 0
            font, anchor = _font(shape.size * k), ANCHORS[shape.anchor]
            pen.text((x * k, shape.baseline * k - top), text, fill, font, anchor, stroke_width=bold)
        case Rect(x, y, width, height):
            half = _half(shape, k)
            box = (
                x * k - half,
                y * k - half - top,
                (x + width) * k - 1 + half,
                (y + height) * k - 1 + half - top,
            )
            pen.rounded_rectangle(
                box, shape.radius * k + half, fill, _colour(shape.stroke), round(2 * half)
            )
        case Circle(x, y, radius):
            reach = radius * k + _half(shape, k)
            middle = y * k - top
            box = (x * k - reach, middle - reach, x * k + reach, middle + reach)
            pen.ellipse(box, fill, _colour(shape.stroke), round(2 * _half(shape, k)))
        case Path(points):
            _draw_path(pen, shape, [(x * k, y * k - top) for x, y in points], k)


def _draw_path(
    pen: ImageDraw.ImageDraw,
    path: Path,
    points: list[tuple[float, float]],
    k: float,
) -> None:
    if path.fill != Ink.NONE:
        pen.polygon(points, _colour(path.fill))
        points = [*points, points[0]]
    if path.stroke == Ink.NONE:
        return
    colour, half = FILE_PALETTE[path.stroke], path.line * k / 2
    pen.line(points, colour, max(1, round(2 * half)), joint="curve")
    for x, y in (points[0], points[-1]):  # round ends
        pen.ellipse((x - half, y - half, x + half, y + half), colour)


def _half(shape: Rect | Circle, k: float) -> float:
    return shape.line * k / 2 if shape.stroke != Ink.NONE else 0


def _colour(ink: Ink) -> str | None:
    return None if ink == Ink.NONE else FILE_PALETTE[ink]


@cache
def _font(size: float) -> ImageFont.FreeTypeFont:
    font = ImageFont.load_default(size)
    # Pillow was built with FreeType, as all its wheels are
    assert isinstance(font, ImageFont.FreeTypeFont)
    return font
