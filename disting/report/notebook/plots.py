"""Plots with matplotlib on axes that are given, or on a new figure."""

from collections.abc import Mapping, Sequence
from functools import singledispatch
from typing import TYPE_CHECKING, Any

import numpy as np

from disting.catalogs import Catalog
from disting.errors import DistingError
from disting.fit.results.selection import Selection, response_of
from disting.fit.search.candidates import reference
from disting.measurement import FrequencyResponse
from disting.measurement.arrays import Real
from disting.report.fit.words import response_unit
from disting.report.notebook.tables import FILLS
from disting.report.scene import FILE_PALETTE
from disting.report.words import SAID, title
from disting.verdict.result import Relation

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Style = Mapping[str, Any]
POINTS = 600  # of a model's line
MOST_LINES = 5  # structures that are drawn of a selection
MOST_NAMED = 30  # models whose numbers have room beside a matrix


@singledispatch
def drawn_on(shown: Any, ax: Any, style: Style) -> Any:
    """The object on axes, which are returned; raises TypeError for a kind that is not known."""
    raise TypeError(f"there is no plot of {type(shown).__name__}")


@drawn_on.register(FrequencyResponse)
def _response(shown: FrequencyResponse, ax: Any, style: Style) -> "tuple[Axes, ...]":
    panels = _panels(ax)
    phase = np.unwrap(np.angle(shown.G))
    _bode(panels, shown.frequency, np.abs(shown.G), phase, style)
    unit = response_unit(shown)
    panels[0].set_ylabel(f"Amplitude [{unit}]" if unit else f"{shown.sensor} per input")
    if "label" in style:
        panels[0].legend()
    return panels


@drawn_on.register(Selection)
def _selection(shown: Selection, ax: Any, style: Style) -> "tuple[Axes, ...]":
    """Measured lines as dots, structures as lines, whose phases stay beside those of the dots."""
    seen = shown.test
    dots = {"linestyle": "none", "marker": ".", "color": "0.55", "label": "measured"}
    panels = _response(seen, ax, dots)
    omega = np.geomspace(seen.omega[0], seen.omega[-1], POINTS)
    chosen = [m.candidate for m in shown.members[:MOST_LINES]] or [shown.described]
    beside = float(np.mean(np.unwrap(np.angle(seen.G))))
    for candidate in chosen:
        response = response_of(candidate, shown.task, omega)
        phase = np.unwrap(np.angle(response))
        phase += 2 * np.pi * np.round((beside - phase.mean()) / (2 * np.pi))
        lines = {"label": reference(candidate.chain)}
        _bode(panels, omega / (2 * np.pi), np.abs(response), phase, lines)
    panels[0].legend()
    return panels


@drawn_on.register(Catalog)
def _catalog(shown: Catalog, ax: Any, style: Style) -> "Axes":
    axes: Axes = _pyplot().subplots(figsize=(6, 6), layout="constrained")[1] if ax is None else ax
    from matplotlib.colors import ListedColormap
    from matplotlib.patches import Patch

    size, order = len(shown.family), list(Relation)
    colours = {r: FILE_PALETTE[ground] for r, (ground, _, _) in FILLS.items()}
    numbers = range(1, size + 1)
    fields = np.ma.masked_equal(
        [[-1 if i == j else order.index(shown.relation(i, j)) for j in numbers] for i in numbers],
        -1,
    )
    palette = ListedColormap([colours[r] for r in order])
    edges = (0.5, size + 0.5)
    axes.imshow(fields, cmap=palette, vmin=0, vmax=len(order) - 1, extent=(*edges, *edges[::-1]))
    if size <= MOST_NAMED:
        axes.set_xticks(list(numbers))
        axes.set_yticks(list(numbers))
    axes.set_title(f"{title(shown)}: positive parameters")
    relations = [r for r in order if (fields == order.index(r)).any()]
    entries = [Patch(color=colours[r], label=SAID[r]) for r in relations]
    axes.legend(handles=entries, loc="upper center", bbox_to_anchor=(0.5, -0.06), ncols=2)
    return axes


def _bode(panels: "Sequence[Axes]", hertz: Real, size: Real, phase: Real, style: Style) -> None:
    panels[0].loglog(hertz, size, **style)
    for panel in panels[1:2]:
        panel.semilogx(hertz, np.degrees(phase), **style)
        panel.set_ylabel("Phase [degree]")
    for panel in panels:
        panel.grid(True, linewidth=0.5, alpha=0.5)
    panels[-1].set_xlabel("Frequency [Hz]")


def _panels(ax: Any) -> "tuple[Axes, ...]":
    """Amplitude and phase of a new figure, or what is given: one axes, or two in any sequence."""
    if ax is None:
        figure = _pyplot().figure(figsize=(7, 5), layout="constrained")
        return tuple(figure.subplots(2, 1, sharex=True, height_ratios=[3, 2]))
    parts = tuple(np.ravel(np.asarray(ax, dtype=object)))
    if len(parts) not in (1, 2):
        raise DistingError(f"a Bode diagram has one or two axes, not {len(parts)}")
    return parts


def _pyplot() -> Any:
    try:
        from matplotlib import pyplot
    except ImportError:
        raise DistingError("a plot needs matplotlib; install it: pip install matplotlib") from None
    return pyplot
