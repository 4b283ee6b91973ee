"""One look for all figures of a fit, and files that repeat byte by byte.

A figure is drawn in few tones. In a file they are colours; in the page each becomes a variable of
the style sheet, which knows light and dark. Every figure is drawn twice, wide for files and
screens, narrow for phones, with letters of one size; the page shows the one that fits. Settings of
the user's matplotlib, dates and version names do not enter the files, and no global state remains.

Axes that read like those drawn by hand: plain numbers, few ticks, labels that keep their
distance.
"""

import re
import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import StrEnum
from io import BytesIO
from math import ceil, log10
from textwrap import wrap
from typing import TYPE_CHECKING, Any

import numpy as np
from markupsafe import Markup, escape

from disting.measurement.arrays import Real
from disting.report.fit.words import readable

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.axis import Axis
    from matplotlib.figure import Figure

RESOLUTION = 200  # pixels an inch of a PNG
WIDE, NARROW = 9.4, 4.2  # inches
POINTS = 72  # an inch
TITLE_SIZE = 10.5  # points
# signs that no XML 1.0 may hold (its production 2); a name from a measured file may
NOT_XML = re.compile("[^\\t\\n\\r\\x20-\\ud7ff\\ue000-\\ufffd\\U00010000-\\U0010ffff]")
LETTER = 0.65  # width of a bold letter, in its size


def over_frequency(panels: Sequence["Axes"], low: float, high: float) -> None:
    """Panels over one axis of frequencies [Hz], which the lowest one shows."""
    panels[0].set_xscale("log")
    panels[0].set_xlim(low, high)
    logarithmic(panels[-1].xaxis, low, high)


def logarithmic(axis: "Axis", low: float, high: float) -> None:
    """Ticks of a logarithmic axis: every digit, 1-2-5, every or every n-th decade, what has
    room between `low` and `high`.
    """
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter, NullLocator

    decades = log10(high / low)
    digits = tuple(range(1, 10)) if decades < 0.7 else (1, 2, 5) if decades < 2.5 else (1,)
    axis.set_major_locator(LogLocator(subs=digits, numticks=12))
    axis.set_minor_locator(
        LogLocator(subs=range(1, 10), numticks=60) if decades < 3.2 else NullLocator()
    )
    axis.set_major_formatter(FuncFormatter(lambda value, _: readable(value)))
    axis.set_minor_formatter(NullFormatter())


def degrees(axis: "Axis", span: float) -> None:
    """At most six steps of 15, 30, 45, 90 degrees or whole half turns over a span of so many
    degrees.
    """
    from matplotlib.ticker import FuncFormatter, MultipleLocator

    fitting = [step for step in (15, 30, 45, 90) if span <= 6 * step]
    axis.set_major_locator(MultipleLocator(fitting[0] if fitting else 180 * ceil(span / (6 * 180))))
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:.0f}°".replace("-", "−")))


def spread(places: Sequence[float], distance: float) -> Real:
    """Rising places moved apart until neighbours keep `distance`, groups staying where they were
    on the whole.

    Pushing everything to the right and pushing everything to the left both keep the distance, and
    so does their mean.

    >>> spread([0.0, 0.5, 0.5, 1.0], 0.2).round(2).tolist()
    [0.0, 0.4, 0.6, 1.0]
    """
    right, left = np.array(places, dtype=float), np.array(places, dtype=float)
    for i in range(1, len(places)):
        right[i] = max(right[i], right[i - 1] + distance)
        left[-1 - i] = min(left[-1 - i], left[-i] - distance)
    return np.asarray((right + left) / 2)


class Tone(StrEnum):
    """A colour of the figures; pairs in one panel differ for colour-blind readers too, and in
    marker or dash.
    """

    INK = "#16202b"
    MUTED = "#55616e"
    RULE = "#d6dde4"
    PAPER = "#ffffff"
    BODY = "#e6ecf2"
    FIRST = "#00588f"
    SECOND = "#b0300a"
    THIRD = "#006b52"
    FOURTH = "#cc79a7"


VARIABLES = {
    Tone.INK: "ink",
    Tone.MUTED: "muted",
    Tone.RULE: "rule",
    Tone.PAPER: "paper",
    Tone.BODY: "body",
    Tone.FIRST: "link",
    Tone.SECOND: "force",
    Tone.THIRD: "sensor",
    Tone.FOURTH: "sometimes",
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
class FigureFiles:
    """A figure: its file name without ending, what it shows in words, its files, and an SVG for
    phones.
    """

    name: str
    title: str
    svg: bytes
    png: bytes
    pdf: bytes
    narrow: bytes

    @property
    def inline(self) -> Markup:
        """The SVGs as elements of a page, of which the style sheet shows one."""
        return self.inline_as(self.name)

    def inline_as(self, name: str) -> Markup:
        """The same with ids that begin with another name than the figure's own."""
        wide = inline(self.svg.decode(), name, self.title, "wide")
        return wide + inline(self.narrow.decode(), f"{name}-n", self.title, "narrow")


def draw_figure(
    name: str, title: str, heights: tuple[float, float], draw: Callable[["Figure"], None]
) -> FigureFiles:
    """SVG, PNG and PDF of what `draw` draws into a figure; `heights` [inch] of the wide and of
    the narrow one.
    """
    import matplotlib

    with matplotlib.rc_context(), warnings.catch_warnings():
        warnings.filterwarnings("ignore", "Glyph .* missing")  # names from a file may have any sign
        matplotlib.rcdefaults()
        matplotlib.rcParams.update(SETTINGS)
        wide, narrow = _laid_out(WIDE, heights[0], draw), _laid_out(NARROW, heights[1], draw)
        files = {kind: _file(wide, kind) for kind in METADATA}
        return FigureFiles(name, title, **files, narrow=_file(narrow, "svg"))


def _laid_out(width: float, height: float, draw: Callable[["Figure"], None]) -> "Figure":
    from matplotlib.figure import Figure

    figure = Figure(figsize=(width, height))
    draw(figure)
    for axis in (axis for panel in figure.axes for axis in (panel.xaxis, panel.yaxis)):
        if not axis.get_label_text():  # else its place is found anew from all ticks, each time
            axis.set_label_coords(0, 0)
    if figure.axes and (engine := figure.get_layout_engine()):
        engine.execute(figure)  # alone: nothing has to be drawn for it
    figure.set_layout_engine("none")  # the layout found once serves all files
    return figure


def is_narrow(figure: "Figure") -> bool:
    """Return True if it is drawn for a phone: panels one below the other, fewer columns in the
    legend.
    """
    return bool(figure.get_figwidth() < WIDE)


def heading(figure: "Figure", text: str) -> None:
    """The title, at the left, in as many lines as it needs."""
    room = int(figure.get_figwidth() * POINTS / (TITLE_SIZE * LETTER))
    figure.suptitle("\n".join(wrap(text, room)), x=0.01, ha="left", size=TITLE_SIZE, weight="bold")


def _file(figure: "Figure", kind: str) -> bytes:
    """Content that `savefig` writes, without its rehearsal: it draws everything twice, the first
    time for a layout that is known here.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.backends.backend_pdf import FigureCanvasPdf
    from matplotlib.backends.backend_svg import FigureCanvasSVG

    buffer, dpi = BytesIO(), figure.dpi
    if kind == "png":
        figure.dpi = RESOLUTION
        FigureCanvasAgg(figure).print_png(buffer, metadata=METADATA[kind])  # type: ignore[no-untyped-call]
        figure.dpi = dpi
    elif kind == "pdf":
        FigureCanvasPdf(figure).print_pdf(buffer, metadata=METADATA[kind])  # type: ignore[no-untyped-call]
    else:
        FigureCanvasSVG(figure).print_svg(buffer, metadata=METADATA[kind])  # type: ignore[no-untyped-call]
        return NOT_XML.sub("", buffer.getvalue().decode()).encode()
    return buffer.getvalue()


def inline(svg: str, name: str, title: str, width: str) -> Markup:
    """A stand-alone SVG of matplotlib as part of an HTML page; `width`: its class there, wide or
    narrow.

    Tones become variables, coordinates hundredths of a point; no other figure has its ids, and
    nothing refers to elsewhere.

    Its own style rule, which would act on the whole page, becomes attributes of the root.
    """
    box = re.search(r'viewBox="([^"]*)"', svg)
    body = re.search(r"<svg[^>]*>(.*)</svg>", svg, re.DOTALL)
    if box is None or body is None:
        raise ValueError("this is not an SVG")
    text = re.sub(
        r"<!--.*?-->|<metadata>.*?</metadata>|<style.*?</style>", "", body[1], flags=re.DOTALL
    )
    text = text.replace("xlink:href", "href")
    text = _with_own_ids(text, name)
    for tone, variable in VARIABLES.items():
        text = text.replace(tone.value, f"var(--{variable})")
    text = re.sub(
        r'( d="| x="| y="|translate\()([^")]*)',
        lambda m: m[1] + re.sub(r"(\.\d\d)\d+", r"\1", m[2]),
        text,
    )
    text = re.sub(
        r"<g([^>]*)>\s*((?:<use [^>]*/>\s*)+)</g>", _with_common_style, re.sub(r"\n\s*", "\n", text)
    )
    attributes = (
        f'viewBox="{box[1]}" role="img" aria-label="{escape(title)}" stroke-linejoin="round"'
        ' stroke-linecap="butt"'
    )
    return Markup(f'<svg class="plot {width}" {attributes}>{text}</svg>')


def _with_own_ids(text: str, name: str) -> str:
    """Ids that are referred to as NAME-1, NAME-2, ..., and no others."""
    old = dict.fromkeys(re.findall(r'(?:href="#|url\(#)([^")]*)', text))
    new = {key: f"{name}-{n}" for n, key in enumerate(old, 1)}
    text = re.sub(r'\s+id="([^"]*)"', lambda m: f' id="{new[m[1]]}"' if m[1] in new else "", text)
    return re.sub(r'(href="#|url\(#)([^")]*)', lambda m: m[1] + new[m[2]], text)


def _with_common_style(group: re.Match[str]) -> str:
    """Markers of one style with this style at their group: a measurement has hundreds of them."""
    members = set(re.findall(r' style="[^"]*"', group[2]))
    if len(members) != 1 or "style=" in group[1]:
        return group[0]
    (style,) = members
    return f"<g{group[1]}{style}>{group[2].replace(style, '')}</g>"
