"""Sensitivity of the parameters of one model by the criteria: importance by parameter, collinearity
by set of parameters.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from disting.fit.judge.candidate import Candidate
from disting.fit.search.estimate import Task
from disting.measurement.arrays import Real
from disting.report.fit.style import FigureFiles, Tone, draw_figure, heading, is_narrow, logarithmic
from disting.report.fit.words import readable
from disting.statistics.practical import Thresholds, collinearity_by_subset

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MOST = 14  # parameters whose 2^n sets are all shown
DECADES = 3  # below the threshold that bars are drawn
ONE_DOT = 0.01  # decades of the index within which dots of one size are one
INFINITE = 1e12  # indices are drawn up to here


def importance_bars(candidate: Candidate, thresholds: Thresholds) -> FigureFiles | None:
    """Importance delta^msqr (16) of each parameter, the smallest admissible one dashed; None
    where all are given.
    """
    if not candidate.practical.names:
        return None
    rows = sorted(candidate.practical.importance.items(), key=lambda row: row[1])
    highest = max(value for _, value in rows)
    least = highest / thresholds.importance_ratio
    floor = max(min(rows[0][1], least) / 2, least * 10.0**-DECADES)
    ratio = readable(candidate.practical.importance_ratio)
    title = (
        f"Importance of each parameter: largest / smallest = {ratio}, allowed"
        f" {readable(thresholds.importance_ratio)}"
    )

    def draw(figure: "Figure") -> None:
        """Bars over a logarithmic axis, with what is allowed."""
        panel = figure.subplots()
        _bars(panel, rows, floor, least)
        panel.set_xlim(floor, highest * 2.2)
        panel.axvline(least, color=Tone.SECOND, linewidth=1.2, linestyle=(0, (5, 3)), zorder=2)
        panel.annotate(
            f"smallest allowed: largest / {readable(thresholds.importance_ratio)}",
            (least, 1.0),
            xycoords=("data", "axes fraction"),
            xytext=(4, 3),
            textcoords="offset points",
            color=Tone.SECOND,
            size=8.5,
        )
        panel.grid(axis="y", visible=False)
        logarithmic(panel.xaxis, floor, highest * 2.2)
        parted = "\n" if is_narrow(figure) else " "
        panel.set_xlabel(
            f"Importance: change of the residuals{parted}for a relative change of the parameter"
        )
        heading(figure, title)

    return draw_figure("importance", title, (1.5 + 0.29 * len(rows), 2.0 + 0.29 * len(rows)), draw)


def _bars(panel: "Axes", rows: Sequence[tuple[str, float]], floor: float, least: float) -> None:
    """A bar a parameter with its value, the most important on top; those below `least` marked."""
    names, values = [name for name, _ in rows], np.array([value for _, value in rows])
    tones = [Tone.FIRST if value >= least else Tone.SECOND for value in values]
    panel.barh(names, np.maximum(values, floor) - floor, left=floor, color=tones, height=0.62)
    panel.set_xscale("log")
    for i, value in enumerate(values):
        panel.annotate(
            readable(value),
            (max(value, floor), i),
            xytext=(5, 0),
            textcoords="offset points",
            va="center",
            size=8.5,
            bbox={"facecolor": Tone.PAPER.value, "edgecolor": "none", "pad": 1.0},
        )


def collinearity_dots(
    candidate: Candidate, task: Task, thresholds: Thresholds
) -> FigureFiles | None:
    """Collinearity index (17) of every set of parameters against its size; None for one
    parameter or for very many.
    """
    names = candidate.practical.names
    if not 2 <= len(names) <= MOST:
        return None
    pairs = [
        (chosen, min(index, INFINITE))
        for chosen, index in collinearity_by_subset(_triangle(candidate, task))
    ]
    indices = np.array([index for _, index in pairs])
    pair, worst = max((row for row in pairs if len(row[0]) == 2), key=lambda row: row[1])
    both = " and ".join(names[i] for i in pair)
    values = (
        f"{_index(indices[-1])} for all {len(names)}, {_index(worst)} for the worst pair, {both}"
    )
    title = f"Collinearity of sets of parameters: {values}"

    def draw(figure: "Figure") -> None:
        """Dots by their size, with what is allowed."""
        panel = figure.subplots()
        _dots(panel, np.array([len(chosen) for chosen, _ in pairs]), indices)
        limit = thresholds.collinearity
        panel.axhline(
            limit,
            color=Tone.SECOND,
            linewidth=1.2,
            linestyle=(0, (5, 3)),
            label=f"threshold {readable(limit)}",
        )
        top = max(limit, float(indices.max())) ** 1.05 * 1.3
        panel.set_ylim(0.9, top)
        panel.set_xlim(1.7, len(names) + 0.3)
        logarithmic(panel.yaxis, 0.9, top)
        panel.set_xlabel("Parameters in the set")
        panel.set_ylabel("Collinearity index")
        heading(figure, title)
        figure.legend(loc="outside lower center", ncols=2 if is_narrow(figure) else 3)

    return draw_figure("collinearity", title, (3.7, 4.0), draw)


def _dots(panel: "Axes", sizes: NDArray[np.intp], indices: Real) -> None:
    """A dot a set, and a line through the largest index of each size."""
    dots = np.unique(np.stack([sizes, np.round(np.log10(indices) / ONE_DOT)]), axis=1)
    panel.semilogy(
        dots[0],
        10 ** (dots[1] * ONE_DOT),
        "o",
        ms=4,
        mfc="none",
        mec=Tone.FIRST,
        mew=0.9,
        label="one set",
    )
    steps = np.unique(sizes)
    worsts = [indices[sizes == size].max() for size in steps]
    panel.plot(steps, worsts, color=Tone.INK, linewidth=1.4, label="largest of each size")
    panel.set_xticks(steps)


def _index(value: float) -> str:
    return "∞" if value >= INFINITE else readable(value)


def _triangle(candidate: Candidate, task: Task) -> Real:
    """A matrix with few rows whose sets of columns are as collinear as those of the sensitivity
    matrix: R of S = Q R.
    """
    names = task.names(candidate.chain)
    p = np.array([candidate.estimate.parameters[name] for name in names])
    columns = task.cost.of(task.plant(candidate.chain), p)[1][:, task.box(names).free]
    return np.asarray(np.linalg.qr(columns, mode="r"))
