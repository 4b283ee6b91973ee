"""Residuals over frequency against the scatter of the data and the confidence band of the model:
where the model misses.

With G measured and G_m fitted, ln |G / G_m| and arg (G / G_m) of each line; a line that only
scatters lies within +-1.96 rho of the model with 95 % (`disting.statistics.scatter`), the model
itself within its band about zero (`disting.fit.results.selection`).
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from disting.fit.judge.explanation import Miss
from disting.fit.judge.members import QUANTILE
from disting.fit.results.selection import Confidence, Selection, confidence, response_of
from disting.measurement import FrequencyResponse
from disting.measurement.arrays import Real
from disting.report.fit.series import Series, band, beneath_in_words, points, series_of
from disting.report.fit.style import (
    FigureFiles,
    Tone,
    draw_figure,
    heading,
    is_narrow,
    over_frequency,
)
from disting.report.fit.words import name, percent, readable
from disting.statistics.scatter import Scatter

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

EDGE = 1.02  # the diagram is this much wider than the data, on either side
LARGE = 0.4  # ln of an amplitude's ratio from which on decibels are drawn, no percent
MOST = 0.98  # quantile of the residuals that the axis shows; what lies beyond is marked at its edge
ROOM = 1.35  # of the axis, beyond that
LINES = 300  # of the model's band
LOST = 20.0  # ln of a factor that no longer says anything
DECIBEL = 20 / np.log(10)


@dataclass(frozen=True, eq=False)
class Misfit:
    """ln |G / G_m| and arg (G / G_m) [rad] of one measurement, shape (n_f,) each, and by how
    much its lines scatter.
    """

    series: Series
    amplitude: Real
    phase: Real

    @property
    def outside(self) -> float:
        """Share of the residuals beyond 1.96 standard deviations of the scatter: 0.05 where
        noise alone is left.
        """
        both = np.concatenate([self.amplitude, self.phase])
        return float(np.mean(np.abs(both) > QUANTILE * np.tile(self.series.scatter.rho, 2)))


def misfits(
    selection: Selection, train: FrequencyResponse, test: FrequencyResponse | None, at: int = 0
) -> list[Misfit]:
    """Residuals of the shown candidate; those that it is judged by against the scatter that it
    is judged by; `at` = which one of several responses.
    """
    candidate, task, judged = selection.described, selection.task, _judging_scatter(selection, at)
    misses = []
    for s in series_of(candidate, task, train, test, at):
        ratio = s.measured.G / response_of(candidate, task, s.measured.omega, at)
        is_judged = s.measured is test and judged and len(judged.rho) == len(s.measured)
        scatter = judged if judged and is_judged else s.scatter
        misses.append(Misfit(replace(s, scatter=scatter), np.log(np.abs(ratio)), np.angle(ratio)))
    return misses


def _judging_scatter(selection: Selection, at: int) -> Scatter | None:
    """The scatter of the lines of a response that candidates are judged by; None where it has no
    data of its own for that.
    """
    cost, whole = selection.judging, selection.explanation.scatter
    if len(selection.task.cost.setups) == 1:
        return whole
    setup = selection.task.cost.setups[at]
    if setup not in cost.setups:
        return None
    which = cost.setups.index(setup)
    ends = np.cumsum([0, *(len(part.measured) for part in cost.parts)])
    return whole.at(slice(ends[which], ends[which + 1]))


def misses_of(selection: Selection, at: int) -> list[Miss]:
    """The ranges of a response that the described candidate misses."""
    setups, misses = selection.task.cost.setups, selection.explanation.misses
    return [m for m in misses if len(setups) == 1 or m.response == setups[at].text]


def residuals(
    selection: Selection,
    train: FrequencyResponse,
    test: FrequencyResponse | None = None,
    at: int = 0,
) -> FigureFiles:
    """Amplitude above, phase below; each measurement's scatter and the model's confidence as
    bands about zero; `at` = which one of several responses.
    """
    misses = misfits(selection, train, test, at)
    model = name(selection.described.chain)
    model += f", {selection.task.cost.setups[at].text}" if at else ""
    low, high = (
        end(m.series.measured.frequency[i] for m in misses) for end, i in ((min, 0), (max, -1))
    )
    omega = 2 * np.pi * np.geomspace(low, high, LINES)
    sure = confidence(selection.described, selection.task, omega, at)
    unit, scaled = _amplitude_unit(misses)

    def draw(figure: "Figure") -> None:
        """Two panels over one axis of frequencies."""
        panels = figure.subplots(2, 1, sharex=True)
        over_frequency(panels, low / EDGE, high * EDGE)
        _panel(panels[0], misses, "amplitude", scaled, omega, sure)
        _panel(panels[1], misses, "phase", np.degrees, omega, sure)
        _missed_ranges(panels, misses_of(selection, at))
        panels[0].set_ylabel(f"Amplitude [{unit}]")
        panels[1].set_ylabel("Phase [degree]")
        panels[-1].set_xlabel("Frequency [Hz]")
        heading(figure, f"Residuals, data against model: {model}")
        figure.legend(
            loc="outside lower center", ncols=1 if is_narrow(figure) else 3, columnspacing=2
        )

    return draw_figure(
        f"residuals-{at + 1}" if at else "residuals",
        f"Residuals of {model} over frequency. {_outside(misses)}",
        (4.6, 5.4),
        draw,
    )


def bands_in_words(
    selection: Selection,
    train: FrequencyResponse,
    test: FrequencyResponse | None = None,
    at: int = 0,
) -> tuple[list[str], list[str]]:
    """Meaning of bars and bands, with their sizes: sentences for below the Bode diagram, and for
    below the residuals; `at` = index of the response among several.
    """
    candidate, task, omega = selection.described, selection.task, train.omega
    misses = misfits(selection, train, test, at)
    sure = confidence(candidate, task, omega, at)
    own = series_of(candidate, task, train, test, at)
    bars = [_bars(s) for s in own if s.has_bars]
    texts = {s.label: s.scatter.source for s in own if s.has_bars}
    sentences = [
        f"Scatter of the {m.series.label}: {_interval(m.series.scatter.typical)} (95 %), from"
        f" {m.series.scatter.source}."
        for m in misses
        if texts.get(m.series.label) != m.series.scatter.source
    ]
    under = [beneath_in_words(s) for s in own if s.measured.distortion is not None]
    return [*bars, _model_band(sure, omega), *under[:1]], [*sentences, _outside(misses)]


def _bars(s: Series) -> str:
    size = float(np.median(s.scatter.rho))
    return (
        f"Error bars of the {s.label} hold 95 %: {_interval(size)} in the median, from"
        f" {s.scatter.source}."
    )


def _model_band(sure: Confidence, omega: Real) -> str:
    if not np.all(np.isfinite(sure.amplitude)):
        return (
            "The data do not determine the response of the model everywhere: where its band fills"
            " the panel, it is open."
        )
    if not sure.amplitude.any():
        return "All parameters are given, so the model has no band."
    widest = int(np.argmax(sure.amplitude))
    typical, largest = (
        _interval(float(size)) for size in (np.median(sure.amplitude), sure.amplitude[widest])
    )
    return (
        f"The band of the model holds 95 % at each frequency, if the structure is right: {typical}"
        f" in the median, at most {largest}, at {readable(float(omega[widest]) / (2 * np.pi))} Hz."
    )


def _interval(error: float) -> str:
    """95 % of an amplitude whose logarithm has this standard error."""
    wide = QUANTILE * error
    if wide > LARGE:
        return f"a factor {readable(float(np.exp(min(wide, LOST))), 2)} either way"
    return f"± {percent(wide)}".replace(" ", "\N{NO-BREAK SPACE}")


def _outside(misses: Sequence[Misfit]) -> str:
    each = " and ".join(f"{percent(m.outside)} of those of the {m.series.label}" for m in misses)
    return f"Residuals outside the scatter: {each}; noise alone leaves 5 % there."


def _amplitude_unit(misses: Sequence[Misfit]) -> tuple[str, Callable[[Real], Real]]:
    """Percent, or decibels where amplitudes differ by factors."""
    if max(float(np.quantile(np.abs(m.amplitude), MOST)) for m in misses) < LARGE:
        return "%", lambda ratio: np.asarray(100 * np.expm1(ratio))
    return "dB", lambda ratio: np.asarray(DECIBEL * ratio)


def _panel(
    panel: "Axes",
    misses: Sequence[Misfit],
    what: str,
    scaled: Callable[[Real], Real],
    omega: Real,
    sure: Confidence,
) -> None:
    """One component: scatter of each measurement, band of the model, residuals, those beyond
    the axis at its edge.
    """
    first = what == "amplitude"
    for m in misses:
        _scatter(panel, m, scaled, f"scatter of the {m.series.label}, 95 %" * first)
    wide = QUANTILE * getattr(sure, what)
    wide = np.where(np.isfinite(wide), wide, np.nan)
    band(panel, omega / (2 * np.pi), scaled(-wide), scaled(wide), label="model, 95 %" * first)
    panel.axhline(0.0, color=Tone.INK, linewidth=1.0, zorder=1.9)
    limit = _limit(
        [(scaled(getattr(m, what)), scaled(QUANTILE * m.series.scatter.rho)) for m in misses]
    )
    for m in misses:
        values = scaled(getattr(m, what))
        points(
            panel,
            m.series,
            np.where(np.abs(values) <= limit, values, np.nan),
            label=m.series.label * first,
        )
        for sign, marker in ((1, "^"), (-1, "v")):
            at = m.series.measured.frequency[sign * values > limit]
            panel.plot(
                at,
                np.full(len(at), sign * 0.97 * limit),
                marker,
                ms=4,
                mfc=m.series.tone,
                mec="none",
                zorder=3,
            )
    panel.set_ylim(-limit, limit)
    panel.grid(which="minor", axis="x", linewidth=0.35)


def _missed_ranges(panels: Sequence["Axes"], misses: Sequence[Miss]) -> None:
    """Ranges of frequencies where the model misses the data by more than they scatter, in all
    panels.
    """
    for panel in panels:
        for i, miss in enumerate(misses):
            label = "missed by more than the scatter" if i == 0 and panel is panels[0] else ""
            panel.axvspan(
                miss.low / EDGE,
                miss.high * EDGE,
                color=Tone.SECOND,
                alpha=0.13,
                lw=0,
                label=label,
                zorder=0,
            )


def _scatter(panel: "Axes", m: Misfit, scaled: Callable[[Real], Real], label: str) -> None:
    """A band for the first measurement, dashed edges for the second: they lie upon each other."""
    hertz, rho = m.series.measured.frequency, QUANTILE * m.series.scatter.rho
    if m.series.marker == "o":
        band(panel, hertz, scaled(-rho), scaled(rho), m.series.tone, label)
        return
    for sign in (1, -1):
        dashes = (0, (4, 2))
        panel.plot(
            hertz,
            scaled(sign * rho),
            color=m.series.tone,
            lw=0.9,
            ls=dashes,
            label=label if sign > 0 else "",
            zorder=1.9,
        )


def _limit(each: Sequence[tuple[Real, Real]]) -> float:
    """Half of the axis: most residuals and half of the scatter bands lie within."""
    return ROOM * max(
        max(float(np.quantile(np.abs(r), MOST)), float(np.median(wide))) for r, wide in each
    )
