"""Figures of fitted networks: Nyquist and Bode diagram with the band of the model, residuals.

An impedance is drawn as usual: -Im Z upward over Re Z, both axes in one scale, so that the arc of a
resistor and a capacitor is a half circle.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from disting.fit.judge.members import QUANTILE
from disting.fit.results.networks import NetworkSelection
from disting.measurement import FrequencyResponse
from disting.measurement.arrays import Real
from disting.model.chain import Sort
from disting.report.fit.network_curves import NetworkLine, network_line, scatters_of
from disting.report.fit.series import BAND, Series, band, bars, points
from disting.report.fit.style import (
    FigureFiles,
    Tone,
    degrees,
    draw_figure,
    heading,
    is_narrow,
    logarithmic,
    over_frequency,
)
from disting.report.fit.words import readable, response_unit

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

EDGE = 1.02  # the diagram is this much wider than the data, on either side
WIDEST = 10.0  # standard error from which on a band fills the panel
OTHERS = ((Tone.SECOND, (0, (6, 3))), (Tone.THIRD, (0, (2, 2))), (Tone.FOURTH, (0, (6, 2, 1, 2))))
MARGIN = 0.06  # of an axis, around what is shown
LABELLED = 4  # decades that are named along a Nyquist curve, at most
LARGEST = 0.98  # quantile of the residuals that the axis shows


@dataclass(frozen=True, slots=True, eq=False)
class Drawn:
    """Content of the figures of one response: data, line of the described network, lines of the
    remaining others.
    """

    series: Series
    name: str
    line: NetworkLine
    others: tuple[tuple[str, NetworkLine], ...]
    which: str
    is_circuit: bool

    @property
    def lines(self) -> list[NetworkLine]:
        """All lines."""
        return [self.line, *(line for _, line in self.others)]


def network_figures(selection: NetworkSelection) -> list[FigureFiles]:
    """Return Nyquist (of impedances), Bode diagram and residuals of each response."""
    figures = list[FigureFiles]()
    for at in range(len(selection.measured)):
        drawn = _draw_response(selection, at)
        end = f"-{at + 1}" if at else ""
        if drawn.is_circuit:
            figures.append(nyquist(drawn, f"nyquist{end}"))
        figures += [bode(drawn, f"bode{end}"), residuals(drawn, f"residuals{end}")]
    return figures


def _draw_response(selection: NetworkSelection, at: int) -> Drawn:
    described, measured = selection.fits[0], selection.measured[at]
    others = [f for f in selection.left if f is not described][: len(OTHERS)]
    which = f", response {at + 1}" if len(selection.measured) > 1 else ""
    return Drawn(
        Series("data", measured, Tone.FIRST, "o", scatters_of(selection)[at]),
        described.network.name,
        network_line(described, selection, at),
        tuple((f.network.name, network_line(f, selection, at)) for f in others),
        which,
        described.network.sort is Sort.CIRCUIT,
    )


def nyquist(drawn: Drawn, file: str) -> FigureFiles:
    """Return the impedance in the complex plane, -Im upward, both axes in one scale."""
    every = np.concatenate([drawn.series.measured.G, *(line.G for line in drawn.lines)])
    wide, high = float(np.ptp(every.real)), float(np.ptp(every.imag))
    slope = high / max(wide, 1e-3 * high, 1e-300)
    tall, narrow = (
        float(np.clip(1.6 + room * slope, 2.8, most)) for room, most in ((8.0, 7.0), (3.4, 5.2))
    )

    def draw(figure: "Figure") -> None:
        """One panel."""
        panel = figure.subplots()
        measured, line = drawn.series.measured, drawn.line
        _tube(panel, line)
        panel.plot(line.G.real, -line.G.imag, color=Tone.INK, lw=1.5, label=drawn.name, zorder=3)
        for (name, other), (tone, dash) in zip(drawn.others, OTHERS, strict=False):
            panel.plot(other.G.real, -other.G.imag, color=tone, ls=dash, lw=1.3, label=name)
        panel.plot(
            measured.G.real, -measured.G.imag, "o", ms=3.6, mfc="none", mec=Tone.FIRST, label="data"
        )
        _decades(panel, measured)
        panel.margins(0.08)
        panel.set_aspect("equal", adjustable="datalim")
        panel.set_xlabel("Re Z [ohm]")
        panel.set_ylabel("−Im Z [ohm]")
        heading(figure, f"Nyquist diagram: {drawn.name}{drawn.which}")
        figure.legend(loc="outside lower center", ncols=1 if is_narrow(figure) else 3)

    title = f"Nyquist diagram of {drawn.name} and the data{drawn.which}, -Im Z upward"
    return draw_figure(file, title, (tall, narrow), draw)


def _tube(panel: "Axes", line: NetworkLine) -> None:
    """Draw the 95 % band of a curve, as wide across it as it is uncertain."""
    size = float(np.abs(line.G).max())
    half = QUANTILE * np.minimum(line.across, WIDEST * size) * line.normal
    edge = np.concatenate([line.G + half, (line.G - half)[::-1]])
    panel.fill(edge.real, -edge.imag, color=Tone.INK, alpha=BAND, lw=0, label="95 % band")


def _decades(panel: "Axes", measured: FrequencyResponse) -> None:
    """Name the frequencies of a few decades along the data."""
    low, high = np.log10(measured.frequency[[0, -1]])
    decades = np.arange(np.ceil(low), np.floor(high) + 1)
    for decade in decades[:: max(1, -(-len(decades) // LABELLED))]:
        at = int(np.argmin(np.abs(np.log10(measured.frequency) - decade)))
        z = measured.G[at]
        panel.plot(z.real, -z.imag, "o", ms=4.5, mfc=Tone.FIRST, mec=Tone.FIRST, zorder=4)
        panel.annotate(
            f"{readable(measured.frequency[at], 3)} Hz",
            (z.real, -z.imag),
            xytext=(0, -7),
            textcoords="offset points",
            ha="center",
            va="top",
            size=8,
            color=Tone.INK,
            bbox={"facecolor": Tone.PAPER, "edgecolor": "none", "pad": 0.6},
            zorder=2.5,
        )


def bode(drawn: Drawn, file: str) -> FigureFiles:
    """Return amplitude and phase over frequency, the line with its 95 % bands."""

    def draw(figure: "Figure") -> None:
        """Two panels, one below the other."""
        panels = figure.subplots(2, 1, sharex=True, height_ratios=[3, 2])
        hertz = drawn.series.measured.frequency
        over_frequency(panels, hertz[0] / EDGE, hertz[-1] * EDGE)
        _amplitude(panels[0], drawn)
        _phase(panels[1], drawn)
        panels[-1].set_xlabel("Frequency [Hz]")
        heading(figure, f"Bode diagram: {drawn.name}{drawn.which}")
        figure.legend(loc="outside lower center", ncols=1 if is_narrow(figure) else 3)

    title = f"Bode diagram of {drawn.name} and the data{drawn.which}"
    return draw_figure(file, title, (5.4, 5.6), draw)


def _amplitude(panel: "Axes", drawn: Drawn) -> None:
    s, line = drawn.series, drawn.line
    size, factor = np.abs(s.measured.G), np.exp(QUANTILE * s.scatter.rho)
    points(panel, s, size, label=s.label + (", 95 % bars" if s.has_bars else ""))
    bars(panel, s, size, size / factor, size * factor)
    hertz, model = line.omega / (2 * np.pi), np.abs(line.G)
    panel.set_yscale("log")
    wide = np.exp(QUANTILE * np.minimum(line.sure.amplitude, WIDEST))
    band(panel, hertz, model / wide, model * wide, label="95 % band")
    panel.plot(hertz, model, color=Tone.INK, lw=1.5, label=drawn.name, zorder=3)
    for (name, other), (tone, dash) in zip(drawn.others, OTHERS, strict=False):
        panel.plot(other.omega / (2 * np.pi), np.abs(other.G), color=tone, ls=dash, label=name)
    shown = np.concatenate([model, size])
    low, high = float(shown.min()) / 1.1, float(shown.max()) * 1.1
    panel.set_ylim(low, high)
    logarithmic(panel.yaxis, low, high)
    what = "|Z|" if drawn.is_circuit else "Amplitude"
    unit = "ohm" if drawn.is_circuit else response_unit(s.measured)
    panel.set_ylabel(f"{what} [{unit}]" if unit else what)


def _phase(panel: "Axes", drawn: Drawn) -> None:
    s, line = drawn.series, drawn.line
    own, wide = line.phase_of(s.measured), np.degrees(QUANTILE * s.scatter.rho)
    points(panel, s, own)
    bars(panel, s, own, own - wide, own + wide)
    hertz = line.omega / (2 * np.pi)
    half = np.degrees(QUANTILE * np.minimum(line.sure.phase, WIDEST))
    band(panel, hertz, line.phase - half, line.phase + half)
    panel.plot(hertz, line.phase, color=Tone.INK, lw=1.5, zorder=3)
    for (_, other), (tone, dash) in zip(drawn.others, OTHERS, strict=False):
        panel.plot(other.omega / (2 * np.pi), other.phase, color=tone, ls=dash)
    shown = np.concatenate([line.phase, own])
    low, high = float(shown.min()), float(shown.max())
    room = MARGIN * (high - low) + 1.0
    panel.set_ylim(low - room, high + room)
    degrees(panel.yaxis, high - low)
    panel.set_ylabel("Phase")


def residuals(drawn: Drawn, file: str) -> FigureFiles:
    """Return data against model over frequency, with the scatter of the lines as a band about
    zero: a model without misfit leaves 95 % of the signs inside.
    """
    measured, rho = drawn.series.measured, drawn.series.scatter.rho
    ratio = measured.G / drawn.line.at(measured)
    outside = np.abs(np.concatenate([np.log(np.abs(ratio)), np.angle(ratio)]))
    share = float(np.mean(outside > QUANTILE * np.tile(rho, 2)))

    def draw(figure: "Figure") -> None:
        """Amplitude above, phase below."""
        panels = figure.subplots(2, 1, sharex=True)
        over_frequency(panels, measured.frequency[0] / EDGE, measured.frequency[-1] * EDGE)
        _misses(panels[0], drawn, 100 * (np.abs(ratio) - 1), 100 * QUANTILE * rho)
        _misses(panels[1], drawn, np.degrees(np.angle(ratio)), np.degrees(QUANTILE * rho))
        panels[0].set_ylabel("Amplitude [%]")
        panels[1].set_ylabel("Phase [degree]")
        panels[-1].set_xlabel("Frequency [Hz]")
        heading(figure, f"Residuals, data against model: {drawn.name}{drawn.which}")
        handles, labels = panels[0].get_legend_handles_labels()
        columns = 1 if is_narrow(figure) else 3
        figure.legend(handles, labels, loc="outside lower center", ncols=columns)

    title = (
        f"Residuals of {drawn.name}{drawn.which} over frequency: {100 * share:.0f} % lie outside"
        " the 95 % band of the scatter"
    )
    return draw_figure(file, title, (4.4, 5.0), draw)


def _misses(panel: "Axes", drawn: Drawn, values: Real, scatter: Real) -> None:
    hertz = drawn.series.measured.frequency
    band(panel, hertz, -scatter, scatter, Tone.FIRST, label="scatter of the lines, 95 %")
    panel.axhline(0, color=Tone.INK, lw=1)
    most = 1.3 * max(float(np.quantile(np.abs(values), LARGEST)), float(np.median(scatter)))
    points(panel, drawn.series, np.clip(values, -most, most), label="data less model")
    panel.set_ylim(-1.05 * most, 1.05 * most)


def captions(selection: NetworkSelection) -> Sequence[str]:
    """Return a sentence a figure, in the order of `network_figures`."""
    described = selection.fits[0].network.name
    sentences = list[str]()
    for _ in selection.measured:
        if selection.fits[0].network.sort is Sort.CIRCUIT:
            sentences.append(
                f"The line is {described}. The band holds the true curve with 95 % if the circuit"
                " is the true one. Both axes have one scale."
            )
        sentences.append(f"Amplitude and phase of the data and of {described}.")
        sentences.append(
            "Signs beyond the axis stand at its edge. Signs that follow each other on one side, or"
            " many outside the band, show what the network misses."
        )
    return sentences
