"""Fig. 12: the responses of A1 and of the fitted A4, and the damping ratios of their poles and
zeros side by side.
"""

from math import pi
from typing import TYPE_CHECKING

import numpy as np

from disting.fit.results.export import predict
from disting.measurement.arrays import Complex
from disting.paper import Refit
from disting.report.fit.style import (
    FigureFiles,
    Tone,
    degrees,
    draw_figure,
    heading,
    is_narrow,
    logarithmic,
)
from disting.report.fit.words import readable

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

SIGNS = {"antiresonance": "▽", "resonance": "△"}
GAP = 0.18  # between the two damping ratios of a mode, in rows


def refit_figure(refit: Refit) -> FigureFiles:
    """Both Bode curves; on the right frequency and damping of the four modes."""
    fitted = predict(refit.fitted, dict(refit.fitted_parameters), refit.measured.omega)

    def draw(figure: "Figure") -> None:
        """The Bode diagram, and the damping ratios beside it or, on a phone, below."""
        if is_narrow(figure):
            grid = figure.add_gridspec(3, 1, height_ratios=[2, 1.2, 1.9])
            places = (grid[0, 0], grid[1, 0], grid[2, 0])
        else:
            grid = figure.add_gridspec(2, 2, width_ratios=[1.9, 1], height_ratios=[2, 1.2])
            places = (grid[0, 0], grid[1, 0], grid[:, 1])
        top = figure.add_subplot(places[0])
        _amplitude(top, refit, fitted)
        _phase(figure.add_subplot(places[1], sharex=top), refit, fitted)
        _damping(figure.add_subplot(places[2]), refit)
        figure.legend(*top.get_legend_handles_labels(), loc="outside lower left", ncols=2)
        heading(figure, "The best A4 has the resonances of A1, but not their damping")

    said = "; ".join(
        f"{m.name}: damping {readable(m.damping[0])} and {readable(m.damping[1])}"
        for m in refit.modes
    )
    return draw_figure(
        "figure-12", f"Bode diagrams of A1 and of A4 fitted to it. {said}", (4.9, 7.6), draw
    )


def _amplitude(panel: "Axes", refit: Refit, fitted: Complex) -> None:
    hertz = refit.measured.omega / (2 * pi)
    panel.loglog(hertz, np.abs(refit.measured.G), color=Tone.FIRST, linewidth=2.2, label="A1")
    panel.loglog(
        hertz,
        np.abs(fitted),
        color=Tone.SECOND,
        linewidth=1.4,
        linestyle=(0, (5, 2)),
        label="A4, fitted to A1",
    )
    panel.set_xlim(float(hertz[0]), float(hertz[-1]))
    low, high = (float(f(np.abs([refit.measured.G, fitted]))) for f in (np.min, np.max))
    panel.set_ylim(low / 1.4, high * 1.4)
    logarithmic(panel.xaxis, float(hertz[0]), float(hertz[-1]))
    logarithmic(panel.yaxis, low / 1.4, high * 1.4)
    panel.set_ylabel("Amplitude [(m/s²)/N]")
    panel.tick_params(labelbottom=False)


def _phase(panel: "Axes", refit: Refit, fitted: Complex) -> None:
    hertz = refit.measured.omega / (2 * pi)
    for response, tone, dashes in (
        (refit.measured.G, Tone.FIRST, "-"),
        (fitted, Tone.SECOND, (0, (5, 2))),
    ):
        panel.semilogx(
            hertz,
            np.degrees(np.unwrap(np.angle(response))),
            color=tone,
            linewidth=1.6,
            linestyle=dashes,
        )
    logarithmic(panel.xaxis, float(hertz[0]), float(hertz[-1]))
    degrees(panel.yaxis, 180.0)
    panel.set_ylabel("Phase")
    panel.set_xlabel("Frequency [Hz]")


def _damping(panel: "Axes", refit: Refit) -> None:
    """A row a mode, a dot each for A1 and A4, joined by a line as long as the misfit."""
    rows = sorted(refit.modes, key=lambda m: m.frequencies[0])
    for row, mode in enumerate(rows):
        panel.plot(mode.damping, [row, row], color=Tone.MUTED, linewidth=1.2, zorder=2)
        panel.plot(mode.damping[0], row, "o", color=Tone.FIRST, ms=7, zorder=3)
        panel.plot(
            mode.damping[1], row, "s", mfc=Tone.PAPER, mec=Tone.SECOND, mew=1.6, ms=6.5, zorder=3
        )
        change = f"{100 * (mode.damping[1] / mode.damping[0] - 1):+.0f} %".replace("-", "−")
        panel.text(
            sum(mode.damping) / 2,
            row - GAP,
            change,
            ha="center",
            va="bottom",
            color=Tone.MUTED,
            size=8.5,
        )
    labels = [
        f"{SIGNS[m.name.split()[0]]} {readable(m.frequencies[0], 3)}"
        f" Hz\n{readable(m.frequencies[1], 3)} Hz"
        for m in rows
    ]
    panel.set_yticks(range(len(rows)), labels)
    panel.set_ylim(len(rows) - 0.5, -0.6)
    panel.set_xlim(0, 1.12 * max(max(m.damping) for m in rows))
    panel.set_xlabel("Damping ratio")
    panel.set_title("A1 ●  and A4 □", weight="normal")
