"""Measured points with their error bars, and bands, as all panels over frequency draw them.

Levels of noise and distortion under a response: what a multisine's lines without excitation
show.
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from disting.fit.judge.candidate import Candidate
from disting.fit.results.selection import response_of
from disting.fit.search.estimate import Task
from disting.measurement import FrequencyResponse
from disting.measurement.arrays import Real, nearest
from disting.report.fit.style import Tone
from disting.statistics.scatter import Scatter, scatter

if TYPE_CHECKING:
    from matplotlib.axes import Axes

MANY = 120  # lines of one measurement from which on its points are drawn smaller
BARRED = 48  # lines of one measurement that have an error bar, at most
BAND = 0.28  # opacity
FINE = 1e-3  # of the range of a curve: less is not seen


@dataclass(frozen=True, eq=False)
class Series:
    """Measured points with the model's line, and how much they scatter."""

    label: str
    measured: FrequencyResponse
    tone: Tone
    marker: str
    scatter: Scatter

    @property
    def has_bars(self) -> bool:
        """True if the data themselves give their scatter."""
        return self.measured.deviation is not None or self.measured.coherence is not None


def series_of(
    candidate: Candidate,
    task: Task,
    train: FrequencyResponse,
    test: FrequencyResponse | None,
    at: int = 0,
) -> list[Series]:
    """Training and test data, each with its own scatter; `at` = which one of several responses."""
    named = (("training data", train, Tone.FIRST, "o"), ("test data", test, Tone.SECOND, "x"))
    return [
        Series(
            label=label,
            measured=data,
            tone=tone,
            marker=marker,
            scatter=scatter(data, [response_of(candidate, task, data.omega, at)]),
        )
        for label, data, tone, marker in named
        if data is not None
    ]


def points(panel: "Axes", s: Series, values: Real, label: str = "") -> None:
    """One sign a line."""
    panel.plot(
        s.measured.frequency,
        values,
        linestyle="none",
        marker=s.marker,
        markersize=(3.6 if s.marker == "o" else 4.6) * (0.7 if len(values) > MANY else 1.0),
        markerfacecolor="none",
        markeredgecolor=s.tone,
        markeredgewidth=0.9,
        label=label,
        zorder=2,
    )


def bars(panel: "Axes", s: Series, values: Real, low: Real, high: Real) -> None:
    """Error bars from `low` to `high` where the data give their scatter, at lines that are spread
    over the axis.
    """
    if not s.has_bars:
        return
    at = bar_lines(s.measured.omega)
    panel.errorbar(
        s.measured.frequency[at],
        values[at],
        yerr=np.stack([(values - low)[at], (high - values)[at]]),
        fmt="none",
        ecolor=s.tone,
        elinewidth=0.9,
        zorder=2,
    )


def bar_lines(omega: Real) -> NDArray[np.intp]:
    """Indices of at most `BARRED` lines, as evenly spread over a logarithmic axis as the lines
    allow.
    """
    wanted = np.linspace(np.log(omega[0]), np.log(omega[-1]), BARRED)
    some = len(omega) > BARRED
    return np.unique(nearest(np.log(omega), wanted)) if some else np.arange(len(omega))


def band(
    panel: "Axes", hertz: Real, low: Real, high: Real, tone: Tone = Tone.INK, label: str = ""
) -> None:
    """A translucent band between two lines."""
    plain = np.log if panel.get_yscale() == "log" else np.asarray
    at = corners(np.log(hertz), plain(low), plain(high))
    panel.fill_between(
        hertz[at], low[at], high[at], color=tone, alpha=BAND, linewidth=0, label=label, zorder=1.8
    )


def corners(x: Real, *curves: Real, fine: float = FINE) -> NDArray[np.intp]:
    """Indices of points, straight lines between which stay within a share `fine` of each curve's
    range; a band has few of them.

    (D. H. Douglas, T. K. Peucker, Algorithms for the reduction of the number of points, 1973.)
    """
    scaled = np.stack([curve / (np.ptp(curve) or 1.0) for curve in curves])
    kept, open_spans = {0, len(x) - 1}, [(0, len(x) - 1)]
    while open_spans:
        i, j = open_spans.pop()
        if j - i < 2:
            continue
        share = (x[i + 1 : j] - x[i]) / (x[j] - x[i])
        straight = scaled[:, [i]] + share * (scaled[:, [j]] - scaled[:, [i]])
        apart = np.abs(scaled[:, i + 1 : j] - straight).max(axis=0)
        if apart.max() > fine:
            middle = i + 1 + int(apart.argmax())
            kept.add(middle)
            open_spans += [(i, middle), (middle, j)]
    return np.array(sorted(kept))


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
    distortion = s.measured.distortion
    if distortion is None:
        return
    low, high = panel.get_xlim()
    shown = []
    for kind, levels, chosen in distortion.kinds:
        hertz = distortion.omega / (2 * np.pi)
        kept = chosen & (hertz >= low) & (hertz <= high) & (levels > DEEPEST * smallest)
        if not kept.any():
            continue
        at, size = gather(hertz[kept], levels[kept])
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


def gather(hertz: Real, levels: Real) -> tuple[Real, Real]:
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
