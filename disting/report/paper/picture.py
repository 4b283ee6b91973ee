"""A figure of the page: its files, and the element that stands in the page."""

from dataclasses import dataclass

from markupsafe import Markup

from disting.report.fit.style import Drawn
from disting.report.paper.pdf import pdf
from disting.report.png import png
from disting.report.scene import PAGE_PALETTE, Scene
from disting.report.svg import body, number, svg


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


def of_plot(name: str, printed: str, caption: str, plot: Drawn) -> Picture:
    """A picture of a plot, whatever name the plot has by itself."""
    return Picture(
        name=name,
        printed=printed,
        caption=caption,
        files=((".svg", plot.svg), (".png", plot.png), (".pdf", plot.pdf)),
        inline=plot.inline_as(name),
    )
