"""A measured file as it was read, as one HTML page: columns, facts, figures."""

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from disting.errors import InputError
from disting.files import __version__, json_text, write_whole
from disting.fit.judge.members import QUANTILE
from disting.measurement import FrequencyResponse, TimeSeries
from disting.measurement.arrays import Real
from disting.measurement.column_words import Role
from disting.measurement.look_text import fact_rows
from disting.measurement.looking import Look
from disting.report.environment import render
from disting.report.fit.series import Series, band, bars, gather, points
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
from disting.report.fit.words import response_unit, typeset
from disting.statistics.scatter import Scatter, scatter

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

EDGE = 1.02  # a diagram is this much wider than the data, on either side
WORTH = ("doubt", "assumed")  # facts that stand out
SMALLEST = 1e-12  # share of the largest amplitude below which a spectrum is rounding


def write_look(seen: Look, folder: Path) -> list[Path]:
    """Write look.html, look.json and the figures (SVG, PNG, PDF); the paths written. The same file
    gives the same bytes. `folder` is made if it does not exist.
    """
    figures = list(look_figures(seen))
    text = json_text(seen.to_dict(), indent=1)
    folder.mkdir(parents=True, exist_ok=True)
    files: list[tuple[str, bytes]] = [
        ("look.html", look_page(seen, figures).encode(errors="backslashreplace")),
        ("look.json", f"{text}\n".encode(errors="backslashreplace")),
    ]
    for figure in figures:
        files += [
            (f"{figure.name}.{kind}", getattr(figure, kind)) for kind in ("svg", "png", "pdf")
        ]
    return [write_whole(folder / name, content) for name, content in files]


def look_page(seen: Look, figures: list[FigureFiles]) -> str:
    """Return the HTML of the page."""
    response = seen.response
    rows = [
        {
            "number": column.number or "",
            "name": column.name or "–",
            "unit": typeset(column.unit),
            "role": column.role.value if column.is_used else Role.OTHER.value,
            "quantity": seen.quantity_of(column),
            "why": seen.reason(column),
            "first": ", ".join(f"{value:.5g}" for value in column.values),
            "is_used": column.is_used,
        }
        for column in seen.columns
    ]
    facts = list(fact_rows(seen))
    return render(
        "look.html",
        title=response.origin if response is not None else seen.file,
        rows=rows,
        is_numbered=any(row["number"] for row in rows),
        has_numbers=any(row["first"] for row in rows),
        facts=[(name, text) for name, text in facts if name not in WORTH],
        assumed=[text for name, text in facts if name == "assumed"],
        doubts=[text for name, text in facts if name == "doubt"],
        figures=figures,
        version=__version__,
        home=None,
    )


def look_figures(seen: Look) -> Iterator[FigureFiles]:
    """Yield the response with its uncertainty, and the spectra of a record."""
    if seen.response is not None:
        yield nyquist(seen.response) if seen.is_impedance else bode(seen.response)
    if seen.record is not None:
        period = seen.excitation.period if seen.excitation is not None else 0
        method = seen.response.method if seen.response is not None else None
        yield spectra(seen.record, period, method.periods if method is not None else 0)


def bode(response: FrequencyResponse) -> FigureFiles:
    """Return amplitude, phase and, where it is known, coherence over frequency."""
    known = _scatter(response)
    series = Series("measured", response, Tone.FIRST, "o", known)
    strips = response.coherence is not None

    def draw(figure: "Figure") -> None:
        """Panels one below the other."""
        heights = [3, 1.8, 0.7][: 2 + strips]
        panels = figure.subplots(len(heights), 1, sharex=True, height_ratios=heights)
        over_frequency(panels, response.frequency[0] / EDGE, response.frequency[-1] * EDGE)
        size, phase = np.abs(response.G), np.degrees(np.unwrap(np.angle(response.G)))
        wide = QUANTILE * known.rho
        panels[0].set_yscale("log")
        _uncertain(panels[0], series, size, size * np.exp(-wide), size * np.exp(wide))
        low, high = size.min() / 1.4, size.max() * 1.4
        panels[0].set_ylim(low, high)
        logarithmic(panels[0].yaxis, low, high)
        of = response_unit(response)
        shown = f" [{of}]" if of else f", {response.quantity} per input"
        panels[0].set_ylabel(f"Amplitude{shown}")
        _uncertain(panels[1], series, phase, phase - np.degrees(wide), phase + np.degrees(wide))
        degrees(panels[1].yaxis, float(np.ptp(phase)))
        panels[1].set_ylabel("Phase")
        if response.coherence is not None:
            points(panels[2], series, response.coherence)
            panels[2].set_ylim(min(0.9, float(response.coherence.min())), 1.01)
            panels[2].set_ylabel("Coherence")
        panels[-1].set_xlabel("Frequency [Hz]")
        heading(figure, "Measured response")
        figure.legend(*panels[0].get_legend_handles_labels(), loc="outside lower center", ncols=2)

    title = f"Bode diagram of {len(response)} measured lines"
    return draw_figure("bode", title, (6.2 + 0.8 * strips, 6.0 + 0.8 * strips), draw)


def nyquist(response: FrequencyResponse) -> FigureFiles:
    """Return the impedance in the complex plane, -Im over Re at one scale."""
    known = _scatter(response)
    wide = QUANTILE * known.rho * np.abs(response.G)

    def draw(figure: "Figure") -> None:
        """One panel."""
        panel = figure.subplots()
        panel.errorbar(
            response.G.real,
            -response.G.imag,
            xerr=wide,
            yerr=wide,
            fmt="o",
            ms=3.6,
            mfc="none",
            mec=Tone.FIRST,
            ecolor=Tone.FIRST,
            elinewidth=0.9,
            label="measured, 95 % bars",
        )
        panel.set_aspect("equal", adjustable="datalim")
        panel.set_xlabel("Re Z [ohm]")
        panel.set_ylabel("−Im Z [ohm]")
        heading(figure, "Measured impedance")
        figure.legend(loc="outside lower center")

    title = f"Nyquist diagram of {len(response)} measured lines"
    return draw_figure("nyquist", title, (5.6, 4.6), draw)


def spectra(record: TimeSeries, period: int, periods: int = 0) -> FigureFiles:
    """Return the amplitude spectra of input and output; of a periodic record, of `period` samples,
    those of the mean of its last `periods` (0: of all) and of their scatter.
    """
    signals = (("input", record.input, record.u), ("output", record.output, record.y))

    def draw(figure: "Figure") -> None:
        """A panel for each signal."""
        panels = figure.subplots(2, 1, sharex=True)
        for panel, (role, signal, samples) in zip(panels, signals, strict=True):
            _spectrum(panel, _periods(samples, period, periods), record.sampling_rate)
            unit = f" [{typeset(signal.unit)}]" if signal.unit else ""
            panel.set_ylabel(f"{role.capitalize()}{unit}")
        panels[-1].set_xlabel("Frequency [Hz]")
        heading(figure, "Spectra of input and output")
        columns = 1 if is_narrow(figure) else 2
        every = (zip(*panel.get_legend_handles_labels(), strict=True) for panel in panels)
        shown = {label: handle for pairs in every for handle, label in pairs}
        figure.legend([*shown.values()], [*shown], loc="outside lower center", ncols=columns)

    return draw_figure("spectra", "Amplitude spectra of input and output", (5.4, 5.6), draw)


def _periods(samples: Real, period: int, periods: int) -> Real:
    """Whole periods of a record, shape (P, N); one that is the record where it has none."""
    length = period if 0 < period <= len(samples) else len(samples)
    count = len(samples) // length
    whole = samples[: count * length].reshape(count, length)
    return whole[count - periods :] if 0 < periods <= count else whole


def _spectrum(panel: "Axes", whole: Real, rate: float) -> None:
    """Amplitudes of the mean of periods, shape (P, N), and their scatter."""
    length = whole.shape[1]
    lines = np.fft.rfft(whole - whole.mean(), axis=1)[:, 1:] * 2 / length
    hertz = np.arange(1, lines.shape[1] + 1) * rate / length
    panel.set_xscale("log")
    panel.set_yscale("log")
    size = np.abs(lines.mean(axis=0))
    shown = size > SMALLEST * size.max()
    at, level = (hertz[shown], size[shown])
    if len(whole) == 1:
        at, level = gather(at, level)
        panel.plot(at, level, color=Tone.FIRST, linewidth=1.2, label="whole record")
    else:
        panel.plot(at, level, ".", ms=2.5, color=Tone.FIRST, label=f"mean of {len(whole)} periods")
        noise = np.std(lines, axis=0, ddof=1) / np.sqrt(len(whole))
        kept = noise > SMALLEST * size.max()
        if kept.any():
            at, rest = gather(hertz[kept], noise[kept])
            panel.plot(at, rest, color=Tone.SECOND, linewidth=1.0, label="scatter of that mean")
    over_frequency([panel], float(hertz[0]), float(hertz[-1]))
    low, high = panel.get_ylim()
    logarithmic(panel.yaxis, low, high)


def _uncertain(panel: "Axes", series: Series, values: Real, low: Real, high: Real) -> None:
    """Measured points with bars where the data give their scatter, else with a band."""
    points(panel, series, values, label="measured" + (", 95 % bars" if series.has_bars else ""))
    bars(panel, series, values, low, high)
    if not series.has_bars and np.any(high > low):
        label = "95 % of the scatter of neighbouring lines"
        band(panel, series.measured.frequency, low, high, Tone.FIRST, label)


def _scatter(response: FrequencyResponse) -> Scatter:
    """Scatter of the lines; none of numbers that a fit does not compute with."""
    try:
        return scatter(response)
    except (InputError, ValueError, ArithmeticError):
        return Scatter(np.zeros(len(response)), np.abs(response.G), "nothing")
