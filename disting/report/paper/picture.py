"""A figure of the page: its files (SVG, PNG, and PDF by matplotlib, one point a pixel; the same
scene gives the same bytes), and the element that stands in the page.
"""

from dataclasses import dataclass
from io import BytesIO
from typing import TYPE_CHECKING

from markupsafe import Markup

from disting.report.fit.style import METADATA, SETTINGS, FigureFiles
from disting.report.png import png
from disting.report.scene import (
    FILE_PALETTE,
    PAGE_PALETTE,
    Anchor,
    Circle,
    Ink,
    Path,
    Rect,
    Scene,
    Shape,
    Text,
)
from disting.report.svg import body, number, svg

if TYPE_CHECKING:
    from matplotlib.axes import Axes

POINTS = 72  # an inch
NARROWER = 0.92  # the font of the files is wider than those of browsers
SIDES = {Anchor.START: "left", Anchor.MIDDLE: "center", Anchor.END: "right"}


def pdf(scene: Scene) -> bytes:
    """PDF bytes of a scene."""
    import matplotlib
    from matplotlib.figure import Figure

    with matplotlib.rc_context():
        matplotlib.rcdefaults()
        matplotlib.rcParams.update(SETTINGS)
        figure = Figure(figsize=(scene.width / POINTS, scene.height / POINTS))
        figure.set_layout_engine("none")
        axes = figure.add_axes((0, 0, 1, 1))
        axes.set_axis_off()
        axes.set_xlim(0, scene.width)
        axes.set_ylim(scene.height, 0)
        for shape in scene.shapes:
            _draw(axes, shape)
        out = BytesIO()
        figure.savefig(out, format="pdf", metadata=METADATA["pdf"])
    return out.getvalue()


def _draw(axes: "Axes", shape: Shape) -> None:
    from matplotlib import patches

    match shape:
        case Text(x, _, text, size):
            words = axes.text(x, shape.baseline, text, ha=SIDES[shape.anchor], va="baseline")
            words.set(
                size=size * NARROWER,
                color=_colour(shape.fill),
                weight="bold" if shape.bold else "normal",
            )
            return
        case Rect(x, y, width, height):
            patch: patches.Patch = patches.Rectangle((x, y), width, height)
        case Circle(x, y, radius):
            patch = patches.Circle((x, y), radius)
        case Path(points):
            patch = patches.Polygon(points, closed=shape.fill != Ink.NONE)
    patch.set_facecolor(_colour(shape.fill))
    patch.set_edgecolor(_colour(shape.stroke))
    patch.set_linewidth(shape.line if shape.stroke != Ink.NONE else 0)
    axes.add_patch(patch)


def _colour(ink: Ink) -> str:
    return FILE_PALETTE[ink]


@dataclass(frozen=True, slots=True)
class Picture:
    """`name` of the files, `printed` = the paper's figures that it stands for, `caption`, the
    files, and its inline form.
    """

    name: str
    printed: str
    caption: str
    files: tuple[tuple[str, bytes], ...]
    inline: Markup


def of_scene(
    name: str, printed: str, caption: str, scene: Scene, narrow: Scene | None = None
) -> Picture:
    """A picture of a scene, in the page with the colours of the style sheet; `narrow` is shown
    on phones instead, if given.
    """
    inline = (
        _inline(scene, "wide") + _inline(narrow, "narrow") if narrow else _inline(scene, "both")
    )
    return Picture(
        name=name,
        printed=printed,
        caption=caption,
        files=((".svg", svg(scene).encode()), (".png", png(scene)), (".pdf", pdf(scene))),
        inline=inline,
    )


def _inline(scene: Scene, width: str) -> Markup:
    box = f"0 0 {number(scene.width)} {number(scene.height)}"
    opening = Markup(
        '<svg class="plot triangles {}" viewBox="{}" style="max-width:{}px" role="img"'
        ' aria-label="{}">'
    )
    return opening.format(width, box, number(scene.width), scene.title) + Markup(
        body(scene, PAGE_PALETTE) + "</svg>"
    )


def of_plot(name: str, printed: str, caption: str, plot: FigureFiles) -> Picture:
    """A picture of a plot, whatever name the plot has by itself."""
    return Picture(
        name=name,
        printed=printed,
        caption=caption,
        files=((".svg", plot.svg), (".png", plot.png), (".pdf", plot.pdf)),
        inline=plot.inline_as(name),
    )
