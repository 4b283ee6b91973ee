"""One look for all figures of a fit, and files that repeat byte by byte.

A figure is drawn in few tones. In a file they are colours; in the page each becomes a variable of the style sheet, which knows
light and dark. Settings of the user's matplotlib, dates and version names do not enter the files, and no global state remains.
"""

import re
from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from io import BytesIO
from typing import TYPE_CHECKING, Any

from markupsafe import Markup, escape

if TYPE_CHECKING:
    from matplotlib.figure import Figure

RESOLUTION = 200  # pixels an inch of a PNG


class Tone(StrEnum):
    """A colour of the figures; pairs in one panel differ for colour-blind readers too, and in marker or dash."""

    INK = "#16202b"
    MUTED = "#55616e"
    RULE = "#d6dde4"
    PAPER = "#ffffff"
    BODY = "#e6ecf2"
    FIRST = "#00588f"
    SECOND = "#b0300a"


VARIABLES = {
    Tone.INK: "ink",
    Tone.MUTED: "muted",
    Tone.RULE: "rule",
    Tone.PAPER: "paper",
    Tone.BODY: "body",
    Tone.FIRST: "link",
    Tone.SECOND: "force",
}
"""The style sheet's name of each tone."""

SETTINGS: Any = {
    "axes.axisbelow": True,
    "axes.edgecolor": Tone.MUTED.value,
    "axes.facecolor": Tone.PAPER.value,
    "axes.grid": True,
    "axes.labelcolor": Tone.INK.value,
    "axes.labelsize": 9,
    "axes.linewidth": 0.8,
    "axes.spines.right": False,
    "axes.spines.top": False,
    "axes.titlelocation": "left",
    "axes.titlesize": 9.5,
    "axes.titleweight": "bold",
    "figure.constrained_layout.use": True,
    "figure.facecolor": Tone.PAPER.value,
    "font.family": "DejaVu Sans",
    "font.size": 9,
    "grid.color": Tone.RULE.value,
    "grid.linewidth": 0.7,
    "legend.fontsize": 8.5,
    "legend.frameon": False,
    "pdf.fonttype": 3,  # outlines: four times faster to write than subsets of a TrueType font
    "svg.fonttype": "path",  # the same letters everywhere, so that nothing overlaps elsewhere
    "svg.hashsalt": "disting",
    "text.color": Tone.INK.value,
    "text.parse_math": False,  # units and names are texts of the user
    "xtick.color": Tone.MUTED.value,
    "xtick.labelcolor": Tone.INK.value,
    "xtick.labelsize": 8.5,
    "ytick.color": Tone.MUTED.value,
    "ytick.labelcolor": Tone.INK.value,
    "ytick.labelsize": 8.5,
}
METADATA: dict[str, dict[str, Any]] = {
    "svg": {"Date": None, "Creator": None, "Format": None, "Type": None},
    "png": {"Software": None},
    "pdf": {"CreationDate": None, "Creator": None, "Producer": None},
}


@dataclass(frozen=True, slots=True)
class Drawn:
    """A figure: its file name without ending, what it shows in words, and its files."""

    name: str
    title: str
    svg: bytes
    png: bytes
    pdf: bytes

    @property
    def inline(self) -> Markup:
        """The SVG as an element of a page: tones as variables, ids that no other figure has, no reference to elsewhere."""
        return inlined(self.svg.decode(), self.name, self.title)


def drawn(name: str, title: str, size: tuple[float, float], draw: Callable[["Figure"], None]) -> Drawn:
    """SVG, PNG and PDF of what `draw` draws into a figure of `size` [inch]."""
    import matplotlib
    from matplotlib.figure import Figure

    with matplotlib.rc_context():
        matplotlib.rcdefaults()
        matplotlib.rcParams.update(SETTINGS)
        figure = Figure(figsize=size)
        draw(figure)
        figure.draw_without_rendering()
        figure.set_layout_engine("none")  # the layout found once serves all files
        files = {kind: _file(figure, kind) for kind in METADATA}
    return Drawn(name, title, **files)


def _file(figure: "Figure", kind: str) -> bytes:
    buffer = BytesIO()
    figure.savefig(buffer, format=kind, dpi=RESOLUTION if kind == "png" else "figure", metadata=METADATA[kind])
    return buffer.getvalue()


def inlined(svg: str, name: str, title: str) -> Markup:
    """A stand-alone SVG of matplotlib as part of an HTML page.

    Its own style rule, which would act on the whole page, becomes attributes of the root.
    """
    box = re.search(r'viewBox="([^"]*)"', svg)
    body = re.search(r"<svg[^>]*>(.*)</svg>", svg, re.DOTALL)
    if box is None or body is None:
        raise ValueError("this is no SVG")
    text = re.sub(r"<!--.*?-->|<metadata>.*?</metadata>|<style.*?</style>", "", body[1], flags=re.DOTALL)
    text = text.replace("xlink:href", "href")
    text = re.sub(r'(\bid="|href="#|url\(#)', rf"\g<1>{name}-", text)
    for tone, variable in VARIABLES.items():
        text = text.replace(tone.value, f"var(--{variable})")
    text = re.sub(r"\n\s*", "\n", text)
    attributes = f'viewBox="{box[1]}" role="img" aria-label="{escape(title)}" stroke-linejoin="round" stroke-linecap="butt"'
    return Markup(f'<svg class="plot" {attributes}>{text}</svg>')
