"""Bode diagram of data and model, as in Figs. 3 and 4 of the paper: asymptotes, resonances and
antiresonances marked.

Data with known scatter have error bars, the model has its confidence band, and the levels of a
multisine's lines without excitation are drawn below the response, in the same unit.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil, log, pi, sqrt
from typing import TYPE_CHECKING

import numpy as np

from disting.fit.judge.candidate import Candidate
from disting.fit.judge.members import QUANTILE
from disting.fit.judge.modes import Result
from disting.fit.results.selection import Confidence, confidence, response_of
from disting.fit.search.estimate import Task
from disting.measurement import FrequencyResponse
from disting.measurement.arrays import Complex, Real
from disting.model.chain import Chain
from disting.report.fit.series import Series, band, bars, beneath, points, series_of
from disting.report.fit.style import (
    FigureFiles,
    Tone,
    degrees,
    draw_figure,
    heading,
    is_narrow,
    logarithmic,
    over_frequency,
    spread,
)
from disting.report.fit.words import name, readable, response_unit, result_unit

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

POINTS = 1200  # of the model's line
PEAK = 1 / sqrt(2)  # damping ratio from which on a second-order factor has no extremum
HIGHEST = 20.0  # phases are shown below this angle and 90 for each differentiation [degree]
EDGE = 1.02  # the diagram is this much wider than the data, on either side
LABEL, SHORT_LABEL = 0.75, 0.48  # room of a label [inch]
FRAME = 0.9  # of the figure's width that is not the diagram's [inch]
MARGIN = 0.06  # of the phases' range, above and below
WIDEST = 10.0  # standard error from which on a band fills the panel
CLEAN = 0.9  # coherence: if no line is below, the axis begins here
SIGNS = {"antiresonance": "▽", "resonance": "△"}
MARKERS = {"antiresonance": "v", "resonance": "^"}


@dataclass(frozen=True, slots=True)
class Mark:
    """A resonance or antiresonance [Hz] that shows in the measured band, with its damping ratio."""

    kind: str
    frequency: float
    damping: float

    def label(self, unit: str = " Hz") -> str:
        """Sign, frequency and damping ratio, in two lines."""
        return f"{SIGNS[self.kind]} {readable(self.frequency)}{unit}\nζ {readable(self.damping, 2)}"


@dataclass(frozen=True, eq=False)
class Line:
    """The model at rising angular frequencies [rad/s], its phase [degree] without jumps, and
    standard errors.
    """

    omega: Real
    G: Complex
    phase: Real
    sure: Confidence

    def phase_of(self, measured: FrequencyResponse) -> Real:
        """Phase of the data [degree]: that of the model and the difference arg(G/G_model),
        which is free of jumps.
        """
        at = np.searchsorted(self.omega, measured.omega)
        return np.asarray(self.phase[at] + np.degrees(np.angle(measured.G / self.G[at])))


def bode(
    candidate: Candidate,
    task: Task,
    results: Sequence[Result],
    train: FrequencyResponse,
    test: FrequencyResponse | None = None,
    at: int = 0,
) -> FigureFiles:
    """Training and test data, coherence where there is one, the model, its inertia asymptotes
    and its resonances; `at` = which one of several responses, further ones without what belongs
    to the first.
    """
    series = series_of(candidate, task, train, test, at)
    line = model_line(candidate, task, [s.measured for s in series], at)
    the_marks = marks(results, line.omega) if at == 0 else []
    inertias = asymptotes(candidate.chain, results, line.omega, train) if at == 0 else []
    what = name(candidate.chain) + (f", {task.cost.setups[at].text}" if at else "")
    strips = any(s.measured.coherence is not None for s in series)
    under = next((s for s in series if s.measured.distortion is not None), None)
    tall = 1.2 if under else 0.0

    def draw(figure: "Figure") -> None:
        """Amplitude, phase and coherence, one below the other."""
        heights = [3 + tall, 1.8, 0.7][: 2 + strips]
        panels = figure.subplots(len(heights), 1, sharex=True, height_ratios=heights)
        low, high = line.omega[0] / (2 * pi) / EDGE, line.omega[-1] / (2 * pi) * EDGE
        over_frequency(panels, low, high)
        named = _short if is_narrow(figure) else str
        _amplitude(panels[0], line, series, [(named(label), y) for label, y in inertias])
        if under:
            beneath(panels[0], under, float(np.abs(line.G).min()))
            logarithmic(panels[0].yaxis, *panels[0].get_ylim())
        _phase(panels[1], line, series)
        if strips:
            _coherence(panels[2], series)
        _marks(panels[0], panels[1], line, the_marks, figure.get_figwidth() - FRAME)
        panels[-1].set_xlabel("Frequency [Hz]")
        heading(figure, f"Measured response and model: {what}")
        columns = 2 if is_narrow(figure) else 3
        figure.legend(loc="outside lower center", ncols=columns, columnspacing=2)

    title = f"Bode diagram of {what} and the data. {_in_words(the_marks)}"
    size = 6.4 + 0.8 * strips + tall, 6.2 + 0.8 * strips + tall
    return draw_figure(f"bode-{at + 1}" if at else "bode", title, size, draw)


def _in_words(the_marks: Sequence[Mark]) -> str:
    return ", ".join(
        f"{m.kind} {readable(m.frequency)} Hz with damping ratio {readable(m.damping, 2)}"
        for m in the_marks
    )


def _short(label: str) -> str:
    """An asymptote's name without its value."""
    return " ".join(label.split()[:2])


def model_line(
    candidate: Candidate,
    task: Task,
    measured: Sequence[FrequencyResponse],
    at: int = 0,
    count: int = POINTS,
) -> Line:
    """The model at `count` frequencies between the lowest and the highest measured line, at every
    measured line too.
    """
    lines = np.concatenate([m.omega for m in measured])
    omega = np.unique(np.concatenate([lines, np.geomspace(lines.min(), lines.max(), count)[1:-1]]))
    response = response_of(candidate, task, omega, at)
    phase = np.degrees(np.unwrap(np.angle(response)))
    highest = HIGHEST + 90 * measured[0].quantity.order
    return Line(
        omega,
        response,
        phase - 360 * ceil((phase.max() - highest) / 360),
        confidence(candidate, task, omega, at),
    )


def marks(results: Sequence[Result], omega: Real) -> list[Mark]:
    """The resonances and antiresonances in the measured band that are damped little enough to
    show, by rising frequency.
    """
    values = {r.name: r.value for r in results}
    low, high = omega[0] / (2 * pi), omega[-1] / (2 * pi)
    the_marks = [
        Mark(kind, value, values[f"damping ratio of {key}"])
        for key, value in values.items()
        for kind in MARKERS
        if key.startswith(kind)
        and low <= value <= high
        and values[f"damping ratio of {key}"] < PEAK
    ]
    return sorted(the_marks, key=lambda m: m.frequency)


def asymptotes(
    chain: Chain, results: Sequence[Result], omega: Real, measured: FrequencyResponse
) -> list[tuple[str, Real]]:
    """Label and amplitude of omega^(n-2)/inertia: all masses move together at low, the motor alone
    at high frequencies.

    Only where the response tends to them: a free chain, force and sensor against the ground, for
    the motor's at one mass.
    """
    inertias = {r.name: r for r in results}
    free = chain.gap == 0 and chain.act_minus == 0 and chain.meas_minus == 0
    wanted = ["total inertia"] if free else []
    wanted += ["motor inertia"] if free and chain.collocated else []
    return [
        (
            f"{key} {readable(inertias[key].value)} {result_unit(inertias[key], measured)}",
            _inertia(inertias[key], chain, omega),
        )
        for key in wanted
        if key in inertias
    ]


def _inertia(result: Result, chain: Chain, omega: Real) -> Real:
    return np.asarray(omega ** (chain.quantity.order - 2) / result.value)


def _amplitude(
    panel: "Axes", line: Line, series: Sequence[Series], inertias: Sequence[tuple[str, Real]]
) -> None:
    hertz = line.omega / (2 * pi)
    for s in series:
        size, factor = np.abs(s.measured.G), np.exp(QUANTILE * s.scatter.rho)
        points(panel, s, size, label=s.label + (", 95 % bars" if s.has_bars else ""))
        bars(panel, s, size, size / factor, size * factor)
    panel.semilogy(
        hertz, np.abs(line.G), color=Tone.INK, linewidth=1.5, label="model, 95 % band", zorder=3
    )
    wide = np.exp(QUANTILE * np.minimum(line.sure.amplitude, WIDEST))
    band(panel, hertz, np.abs(line.G) / wide, np.abs(line.G) * wide)
    for (label, values), dashes in zip(inertias, ((0, (6, 3)), (0, (1.5, 2))), strict=False):
        panel.semilogy(hertz, values, color=Tone.MUTED, ls=dashes, lw=1.2, label=label, zorder=1.5)
    shown = np.concatenate([np.abs(line.G), *(np.abs(s.measured.G) for s in series)])
    low, high = shown.min() / 1.4, shown.max() * 1.4
    panel.set_ylim(low, high)
    logarithmic(panel.yaxis, low, high)
    panel.grid(which="minor", linewidth=0.35)
    of = response_unit(series[0].measured)
    panel.set_ylabel(
        f"Amplitude [{of}]" if of else f"Amplitude, {series[0].measured.quantity.value} per input"
    )


def _phase(panel: "Axes", line: Line, series: Sequence[Series]) -> None:
    for s in series:
        at, wide = line.phase_of(s.measured), np.degrees(QUANTILE * s.scatter.rho)
        points(panel, s, at)
        bars(panel, s, at, at - wide, at + wide)
    wide = np.degrees(QUANTILE * np.minimum(line.sure.phase, WIDEST))
    band(panel, line.omega / (2 * pi), line.phase - wide, line.phase + wide)
    panel.plot(line.omega / (2 * pi), line.phase, color=Tone.INK, linewidth=1.5, zorder=3)
    shown = np.concatenate([line.phase, *(line.phase_of(s.measured) for s in series)])
    low, high = shown.min(), shown.max()
    panel.set_ylim(low - MARGIN * (high - low) - 1.0, high + MARGIN * (high - low) + 1.0)
    degrees(panel.yaxis, float(high - low))
    panel.grid(which="minor", axis="x", linewidth=0.35)
    panel.set_ylabel("Phase")


def _coherence(panel: "Axes", series: Sequence[Series]) -> None:
    for s in series:
        if s.measured.coherence is not None:
            points(panel, s, s.measured.coherence)
    lowest = min(
        float(s.measured.coherence.min()) for s in series if s.measured.coherence is not None
    )
    floor = CLEAN if lowest >= CLEAN else 0.0
    panel.set_ylim(floor, 1 + 0.1 * (1 - floor))
    panel.set_yticks([floor, (1 + floor) / 2, 1])
    panel.set_ylabel("Coherence")


def _marks(top: "Axes", below: "Axes", line: Line, the_marks: Sequence[Mark], width: float) -> None:
    """Signs on the model's line, thin lines through both panels, and labels above that keep their
    distance.

    `width` of the panels [inch]; where it is scarce, the labels go without their unit.
    """
    low, high = top.get_xlim()
    places = [log(m.frequency / low) / log(high / low) for m in the_marks]
    unit = " Hz" if LABEL * len(the_marks) <= width else ""
    labels = spread(
        places, min((LABEL if unit else SHORT_LABEL) / width, 1 / max(len(the_marks), 1))
    )
    for kind, marker in MARKERS.items():
        at = [m.frequency for m in the_marks if m.kind == kind]
        heights = np.interp(np.array(at), line.omega / (2 * pi), np.abs(line.G))
        text = f"{kind}, ζ: damping ratio" if at else ""
        top.plot(
            at, heights, marker, ms=7, mfc=Tone.PAPER, mec=Tone.INK, mew=1.2, zorder=4, label=text
        )
    for mark, place, label in zip(the_marks, places, labels, strict=True):
        for panel in (top, below):
            panel.axvline(
                mark.frequency, color=Tone.MUTED, linewidth=0.7, linestyle=(0, (1, 2)), zorder=1
            )
        top.plot(
            [place, label],
            [1.0, 1.035],
            transform=top.transAxes,
            color=Tone.MUTED,
            linewidth=0.7,
            clip_on=False,
        )
        top.text(
            label,
            1.045,
            mark.label(unit),
            transform=top.transAxes,
            ha="center",
            va="bottom",
            size=8.5,
        )
