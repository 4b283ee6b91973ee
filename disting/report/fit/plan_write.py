"""Writes a plan into a folder: figure, lines, the spectrum to be run, JSON."""

import json
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from disting.files import write_whole
from disting.fit.plan.design import Designed, designed_to_dict
from disting.fit.plan.power import Plan, typical
from disting.measurement.arrays import Real
from disting.report.fit.onward import named_with_values
from disting.report.fit.style import Drawn, Tone, drawn, heading, is_narrow, logarithmic

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def write_plan(found: Plan, best: Designed, folder: Path) -> str:
    """Write plan.svg, .png, .pdf, plan.json, lines.csv and spectrum.csv; the command that simulates
    the spectrum. The same plan gives the same bytes.
    """
    folder.mkdir(parents=True, exist_ok=True)
    figure = plan_figure(found, best)
    text = json.dumps(designed_to_dict(found, best), indent=1, ensure_ascii=False, allow_nan=False)
    for name, content in (
        ("plan.svg", figure.svg),
        ("plan.png", figure.png),
        ("plan.pdf", figure.pdf),
        ("plan.json", [text, "\n"]),
        ("lines.csv", [_lines(found, best)]),
        ("spectrum.csv", [best.excitation(best.run.shares).spectrum_csv]),
    ):
        write_whole(folder / name, content)
    return simulation(found, best, folder / "spectrum.csv")


def simulation(found: Plan, best: Designed, path: Path) -> str:
    """The command that runs a spectrum on the model."""
    return (
        f"disting simulate {named_with_values(found.model, found.values)}"
        f" --spectrum {path} --rate {best.rate:g} --samples {best.samples}"
    )


def _lines(found: Plan, best: Designed) -> str:
    """A row a line: frequency, difference, noise, shares of the power."""
    rows = ["frequency_hz,difference,noise,share_optimal,share_run\n"]
    rival = found.rival
    if rival is not None:
        columns = (best.hertz, rival.apart, rival.rho, best.optimum.shares, best.run.shares)
        rows += [",".join(f"{v:.9g}" for v in row) + "\n" for row in zip(*columns, strict=True)]
    return "".join(rows)


def plan_figure(found: Plan, best: Designed) -> Drawn:
    """Difference of the two structures over frequency beside the noise, and the shares of the power
    of the optimal spectrum below.
    """
    model, name = found.names
    rival = found.rival
    title = f"Where {name}, fitted to {model}, differs from it, and where the power has to go"
    size = rival.apart if rival is not None else np.zeros(len(best.hertz))
    noise = rival.rho if rival is not None else np.ones(len(best.hertz))

    def draw(figure: "Figure") -> None:
        """Two panels over one frequency axis."""
        upper, lower = figure.subplots(2, 1, sharex=True)
        _difference(upper, best, size, noise)
        _shares(lower, best)
        lower.set_xlabel("Frequency [Hz]")
        logarithmic(lower.xaxis, best.hertz[0], best.hertz[-1])
        heading(figure, title)
        figure.legend(loc="outside lower center", ncols=2 if is_narrow(figure) else 5)

    said = f"{title}; noise {100 * typical(noise):.2g} % a line"
    return drawn("plan", said, (5.2, 5.6), draw)


def _difference(panel: "Axes", best: Designed, size: Real, noise: Real) -> None:
    """Difference of the structures, noise of a line, best band."""
    panel.plot(best.hertz, 100 * size, color=Tone.FIRST, label="difference |G_B/G_A - 1|")
    panel.plot(
        best.hertz,
        100 * noise,
        color=Tone.SECOND,
        linestyle=(0, (5, 3)),
        label="noise of a line",
    )
    panel.axvspan(best.band.low, best.band.high, color=Tone.BODY, zorder=0.5, label="best band")
    panel.set_xscale("log")
    panel.set_ylabel("Difference [%]")


def _shares(panel: "Axes", best: Designed) -> None:
    """Shares of the power of the optimal spectrum and of the one to be run."""
    chosen = best.optimum.shares > 0
    panel.vlines(
        best.hertz[chosen],
        0,
        100 * best.optimum.shares[chosen],
        color=Tone.THIRD,
        linewidth=2.5,
        label="share of the power, optimal",
    )
    panel.plot(
        best.hertz,
        100 * best.run.shares,
        "o",
        ms=2.5,
        mfc="none",
        mec=Tone.INK,
        label="to be run",
    )
    panel.set_ylim(bottom=0)
    panel.set_ylabel("Share of the power [%]")
