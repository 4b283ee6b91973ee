"""The criteria of a candidate as a report puts them: value, threshold and meaning, what is
least determined, who is nearest.

What each criterion alone would select at other thresholds: Figs. 5 to 8 of the paper.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields
from math import isfinite
from typing import TYPE_CHECKING

import numpy as np

from disting.fit.judge.candidate import Candidate
from disting.fit.results.selection import CRITERIA, Selection, Sweep, sweep
from disting.measurement.arrays import Real
from disting.report.fit.style import FigureFiles, Tone, draw_figure, heading, is_narrow, logarithmic
from disting.report.fit.words import readable
from disting.statistics.practical import Thresholds

MEANINGS = {
    "condition_index": "how unevenly the data determine combinations of parameters: 1 is best",
    "importance_ratio": (
        "influence of the strongest parameter on the response, divided by that of the weakest"
    ),
    "collinearity": (
        "how far the other parameters can compensate a change of one: 1 not at all, 20 to 95 %"
    ),
}
HEADS = (("jointly", "condition index"), ("weakest", "PII ratio"), ("alike", "collinearity"))
"""The criteria as columns of a table, as `columns` explains them, and their terms."""


if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

TITLES = {
    "condition_index": "largest condition index",
    "importance_ratio": "largest / smallest importance (PII)",
    "collinearity": "collinearity index",
}

CROWDED = 0.3  # share of the height below which the line would meet a note at the foot of the panel


def parameters_by_threshold(candidates: Sequence[Candidate], thresholds: Thresholds) -> FigureFiles:
    """N_p of the best candidate that fulfils one criterion alone, against its threshold."""
    title = "Parameters of the best model that fulfils one criterion alone"
    return _panels(
        "parameters-by-threshold",
        title,
        "Parameters",
        candidates,
        thresholds,
        lambda s: s.n_parameters,
    )


def models_by_threshold(candidates: Sequence[Candidate], thresholds: Thresholds) -> FigureFiles:
    """Number of candidates that fulfil one criterion alone, against its threshold."""
    title = f"Models that fulfil one criterion alone, of {len(candidates)} fitted"
    return _panels(
        "models-by-threshold", title, "Models", candidates, thresholds, lambda s: s.fulfilling
    )


def _panels(
    name: str,
    title: str,
    counted: str,
    candidates: Sequence[Candidate],
    thresholds: Thresholds,
    values: Callable[[Sweep], Real],
) -> FigureFiles:
    """One panel a criterion, the threshold in use dashed, with its value."""

    def draw(figure: "Figure") -> None:
        """A panel a criterion, side by side or one below the other."""
        narrow = is_narrow(figure)
        panels = figure.subplots(
            *((len(CRITERIA), 1) if narrow else (1, len(CRITERIA))), sharey=True
        )
        for panel, criterion in zip(panels, CRITERIA, strict=True):
            the_sweep = sweep(candidates, criterion)
            _steps(panel, the_sweep.thresholds, values(the_sweep), getattr(thresholds, criterion))
            panel.set_title(TITLES[criterion], weight="normal")
        for panel in panels[-1:] if narrow else panels:
            panel.set_xlabel("Threshold")
        for panel in panels if narrow else panels[:1]:
            panel.set_ylabel(counted)
        heading(figure, title)

    return draw_figure(name, title, (3.1, 5.6), draw)


def _steps(panel: "Axes", thresholds: Real, counts: Real, used: float) -> None:
    """A staircase; nothing where no candidate is left. A threshold beyond the axis is written
    at its end.
    """
    from matplotlib.ticker import MaxNLocator

    shown = np.where(counts > 0, counts, np.nan)
    panel.set_xscale("log")
    panel.set_xlim(float(thresholds[0]), float(thresholds[-1]))
    panel.set_ylim(0, max(float(counts.max()) * 1.18, 1.0))
    panel.plot(thresholds, shown, color=Tone.FIRST, linewidth=1.8, drawstyle="steps-post")
    if thresholds[0] <= used <= thresholds[-1]:
        panel.axvline(used, color=Tone.SECOND, linewidth=1.2, linestyle=(0, (5, 3)))
    panel.yaxis.set_major_locator(MaxNLocator(nbins=6, integer=True, steps=[1, 2, 5, 10]))
    logarithmic(panel.xaxis, 1.0, 1e4)
    at = int(np.searchsorted(thresholds, used, side="right")) - 1
    if 0 <= at < len(thresholds) - 1 and counts[at] > 0:
        panel.plot(used, counts[at], "o", ms=6, mfc=Tone.PAPER, mec=Tone.SECOND, mew=1.4, zorder=4)
        note = f"{counts[at]:.0f} at {readable(used)}"
    else:
        note = f"in use: {readable(used)}"
    side, place = "right" if used > 100 else "left", min(max(used, thresholds[0]), thresholds[-1])
    low = float(np.interp(place, thresholds, counts)) < CROWDED * panel.get_ylim()[1]
    panel.annotate(
        note,
        (place, 0.78 if low else 0.03),
        xycoords=("data", "axes fraction"),
        xytext=(-5 if side == "right" else 5, 0),
        textcoords="offset points",
        ha=side,
        va="bottom",
        color=Tone.SECOND,
        size=8.5,
    )


def columns(thresholds: Thresholds) -> str:
    """Meaning of the columns of `HEADS`, in one sentence.

    >>> print(columns(Thresholds()).partition(";")[0])
    jointly, a combination of parameters (condition index, critical above 30)
    """
    return (
        "jointly, a combination of parameters (condition index, critical above"
        f" {thresholds.condition_index:g}); weakest, the parameter with the least effect, compared"
        f" with the one that has most (PII ratio, critical above {thresholds.importance_ratio:g});"
        " alike, a parameter whose change others can compensate (collinearity index, critical above"
        f" {thresholds.collinearity:g})"
    )


@dataclass(frozen=True, slots=True)
class Limit:
    """A criterion of the described candidate and its threshold."""

    title: str
    meaning: str
    value: float
    threshold: float

    @property
    def holds(self) -> bool:
        """True if the limit is satisfied."""
        return self.value <= self.threshold

    @property
    def said(self) -> str:
        """The value; nothing where it is infinite, which the candidate's reasons put in words."""
        return readable(self.value) if isfinite(self.value) else "–"


def nearest(selection: Selection) -> list[Candidate]:
    """Excluded candidates, those first whose worst criterion exceeds its threshold by the
    smallest factor.
    """
    return sorted(
        (c for c in selection.candidates if not c.admissible),
        key=lambda c: _excess(c, selection.thresholds),
    )


def _excess(candidate: Candidate, thresholds: Thresholds) -> float:
    return max(limit.value / limit.threshold for limit in limits(candidate, thresholds))


def limits(candidate: Candidate, thresholds: Thresholds) -> list[Limit]:
    """The three criteria."""
    names = [f.name for f in fields(thresholds)]
    return [
        Limit(TITLES[n], MEANINGS[n], getattr(candidate.practical, n), getattr(thresholds, n))
        for n in names
    ]


def weakest(candidate: Candidate) -> str:
    """The combination of parameters that the data determine least, such as "ln k12 + 0.81 ln
    m2".
    """
    terms = sorted(candidate.practical.worst_direction.items(), key=lambda row: -abs(row[1]))
    texts = [
        ("− " if v < 0 else "+ ") + (f"{abs(v):.2g} " if abs(v) < 0.995 else "") + f"ln {n}"
        for n, v in terms
    ]
    return " ".join(texts).removeprefix("+ ")
