"""Levels of noise and distortion under a response: what a multisine's lines without excitation
show.
"""

from typing import TYPE_CHECKING

import numpy as np

from disting.measurement.arrays import Real
from disting.report.fit.series import MANY, Series
from disting.report.fit.style import Tone

if TYPE_CHECKING:
    from matplotlib.axes import Axes

# share of the smallest amplitude of the model below which nothing is drawn: it is rounding
DEEPEST = 1e-4
LOWEST = 0.05  # quantile of the levels that the axis still shows
LOOKS = {
    "noise": (Tone.MUTED, ".", 3.0),
    "odd distortion": (Tone.THIRD, "+", 4.2),
    "even distortion": (Tone.FOURTH, "s", 2.8),
    "distortion": (Tone.THIRD, "+", 4.2),
}


def beneath(panel: "Axes", s: Series, smallest: float) -> None:
    """The levels on the axis of the amplitude, which grows downwards to hold them; `smallest`
    amplitude of the model.
    """
    found = s.measured.distortion
    if found is None:
        return
    low, high = panel.get_xlim()
    shown = []
    for kind, levels, chosen in found.kinds:
        hertz = found.omega / (2 * np.pi)
        kept = chosen & (hertz >= low) & (hertz <= high) & (levels > DEEPEST * smallest)
        if not kept.any():
            continue
        at, size = gathered(hertz[kept], levels[kept])
        tone, marker, width = LOOKS[kind]
        panel.plot(
            at, size, marker, ms=width, mfc="none", mec=tone, mew=0.8, zorder=1.7, label=kind
        )
        shown.append(size)
    if shown:
        floor, top = panel.get_ylim()
        panel.set_ylim(min(floor, float(np.quantile(np.concatenate(shown), LOWEST)) / 1.4), top)


def beneath_in_words(s: Series) -> str:
    """Where the signs under the response come from."""
    count = 0 if s.measured.distortion is None else len(s.measured.distortion.omega)
    return (
        f"Under the response, in its unit: noise and distortion, at {count} lines of the {s.label}"
        " without excitation."
    )


def gathered(hertz: Real, levels: Real) -> tuple[Real, Real]:
    """Where there are many lines, the root mean square of those near each other on a
    logarithmic axis, and their middle.
    """
    if len(hertz) <= MANY:
        return hertz, levels
    edges = np.geomspace(hertz[0], hertz[-1], MANY + 1)[1:-1]
    groups = np.split(np.arange(len(hertz)), np.searchsorted(hertz, edges))
    filled = [group for group in groups if group.size]
    middle = [float(np.exp(np.mean(np.log(hertz[group])))) for group in filled]
    return np.array(middle), np.array(
        [float(np.sqrt(np.mean(levels[group] ** 2))) for group in filled]
    )
