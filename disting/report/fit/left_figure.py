"""The structures that a fit leaves, side by side: what they show at the sensor and at the load,
their poles and zeros with their uncertainty, and the loop of a controller.
"""

from collections.abc import Sequence
from math import pi
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.special import chdtri

from disting.fit.judge.members import Member
from disting.fit.judge.modes import oscillations, poles, zeros
from disting.fit.results.loop import loop_gain
from disting.fit.results.reliance import draws, nearest, position_of_load
from disting.fit.results.selection import Selection, response_of
from disting.measurement import FrequencyResponse
from disting.measurement.arrays import Real
from disting.report.fit.style import FigureFiles, Tone, draw_figure, heading, is_narrow, logarithmic
from disting.report.fit.words import response_unit

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

LINES = 600  # frequencies of a curve
FEWEST = 10  # draws of a root that tell its ellipse
BESIDE = 1.3  # ratio of frequencies that is left free beside resonances
CORNERS = 73  # of the polygon that is an ellipse
TONES = (Tone.FIRST, Tone.SECOND, Tone.THIRD, Tone.FOURTH, Tone.MUTED)
DASHES = ("-", "--", "-.", ":")
NYQUIST = 3.0  # half width of the Nyquist diagram
TWINS = 6  # equivalents that are drawn


def left_figure(selection: Selection, measured: FrequencyResponse) -> FigureFiles | None:
    """None where nothing is left to compare: one structure without equivalents, no controller."""
    left = selection.members
    if not left or (len(left) == 1 and not left[0].twins and selection.controller is None):
        return None
    omega = np.geomspace(measured.omega[0], measured.omega[-1], LINES)

    def draw(figure: "Figure") -> None:
        """Panels in two columns, on a phone one below the other."""
        count = 3 + (selection.controller is not None)
        rows = count if is_narrow(figure) else 2
        panels = list(np.ravel(figure.subplots(rows, count // rows + (count % rows > 0))))
        _sensor(panels[0], selection, measured, omega)
        _load(panels[1], left, omega)
        _roots(panels[2], selection, (float(omega[0]), float(omega[-1])))
        if selection.controller is not None:
            _nyquist(panels[3], selection)
        for empty in panels[count:]:
            empty.set_axis_off()
        heading(figure, "The structures that are left")
        figure.legend(
            *panels[1].get_legend_handles_labels(),
            loc="outside lower center",
            ncols=1 if is_narrow(figure) else 4,
            fontsize=8,
        )

    names = ", ".join(m.name for m in left)
    title = f"Responses at the sensor and at the load, poles and zeros of {names}"
    rows = 3 + (selection.controller is not None)
    return draw_figure("structures", title, (7.4, 3.0 * rows), draw)


def _style(k: int) -> dict[str, Any]:
    return {"color": TONES[k % len(TONES)], "linestyle": DASHES[k // len(TONES) % len(DASHES)]}


def _sensor(panel: "Axes", selection: Selection, measured: FrequencyResponse, omega: Real) -> None:
    """Amplitudes of what was fitted."""
    for k, m in enumerate(selection.members):
        level = np.abs(response_of(m.candidate, selection.task, omega))
        panel.loglog(omega / (2 * pi), level, linewidth=1.4, **_style(k))
    _amplitudes(panel, omega)
    panel.set_title("At the sensor")
    unit = response_unit(measured)
    panel.set_ylabel(f"Amplitude [{unit}]" if unit else "Amplitude")


def _load(panel: "Axes", left: Sequence[Member], omega: Real) -> None:
    """Amplitudes at the load, of equivalents too."""
    models = [(m.name, m.candidate.chain, m.candidate.estimate.parameters) for m in left]
    twins = [(t.name, t.chain, t.parameters) for m in left for t in m.twins][:TWINS]
    for k, (name, chain, values) in enumerate([*models, *twins]):
        p = np.array([values[n] for n in chain.parameters])
        level = np.abs(position_of_load(chain, p, omega))
        label = name if k < len(models) else f"{name} (equivalent)"
        panel.loglog(omega / (2 * pi), level, linewidth=1.4, label=label, **_style(k))
    _amplitudes(panel, omega)
    panel.set_title("Position of the load per force")


def _amplitudes(panel: "Axes", omega: Real) -> None:
    logarithmic(panel.xaxis, omega[0] / (2 * pi), omega[-1] / (2 * pi))
    logarithmic(panel.yaxis, *panel.get_ylim())
    panel.set_xlabel("Frequency [Hz]")


def _roots(panel: "Axes", selection: Selection, band: tuple[float, float]) -> None:
    """Frequency and damping ratio of what oscillates in the band, with ellipses of 95 %."""
    whole = band[0] / (2 * pi), band[1] / (2 * pi)
    shown = list[float]()
    for k, m in enumerate(selection.members):
        structure = m.candidate.chain.structure
        sets = draws(m.candidate, selection.task)[:, : len(structure.parameters)]
        for roots_of, marker in ((poles, "x"), (zeros, "o")):
            own, *others = ([*oscillations(roots_of(structure, p))] for p in sets)
            own = [r for r in own if band[0] <= abs(r) <= band[1]]
            tone = TONES[k % len(TONES)]
            shown += [_place(r)[0] for r in own]
            for r in own:
                panel.plot(*_place(r), marker, ms=7.0, mfc="none", color=tone)
                near = [n for roots in others if (n := nearest(roots, r)) is not None]
                panel.plot(*ellipse(r, near), linewidth=1.0, color=tone)
    panel.set_xscale("log")
    low, high = (min(shown) / BESIDE, max(shown) * BESIDE) if shown else whole
    panel.set_xlim(low, high)
    logarithmic(panel.xaxis, *panel.get_xlim())
    panel.set_ylim(bottom=0.0)
    panel.set_title("Resonances × and antiresonances ○")
    panel.set_xlabel("Frequency [Hz]")
    panel.set_ylabel("Damping ratio [%]")


def _place(root: complex) -> tuple[float, float]:
    """Frequency [Hz] and damping ratio [%]."""
    return abs(root) / (2 * pi), -100 * root.real / abs(root)


def ellipse(root: complex, near: Sequence[complex]) -> Real:
    """Frequencies and damping ratios of the ellipse of 95 % around a root with such draws, shape
    (2, n); the logarithm of the frequency is normal, as are those of the parameters.
    """
    if len(near) < FEWEST:
        return np.empty((2, 0))
    hertz, damping = np.array([_place(r) for r in near]).T
    sizes, axes = np.linalg.eigh(np.cov(np.log(hertz), damping))
    angle = np.linspace(0.0, 2 * pi, CORNERS)
    circle = np.sqrt(chdtri(2, 0.05)) * np.stack([np.cos(angle), np.sin(angle)])
    moved = axes @ (np.sqrt(np.maximum(sizes, 0.0))[:, None] * circle)
    centre = _place(root)
    return np.stack([centre[0] * np.exp(moved[0]), centre[1] + moved[1]])


def _nyquist(panel: "Axes", selection: Selection) -> None:
    """L of every fitted structure near the critical point."""
    assert selection.controller is not None
    omega = np.geomspace(selection.test.omega[0] / 10, selection.test.omega[-1] * 3, 10 * LINES)
    for k, m in enumerate(selection.members):
        p = np.array([m.candidate.estimate.parameters[n] for n in m.candidate.chain.parameters])
        gain = loop_gain(m.candidate.chain, p, selection.controller, omega)
        panel.plot(gain.real, gain.imag, linewidth=1.2, **_style(k))
    panel.plot([-1], [0], "+", ms=10, color=Tone.INK)
    panel.set(xlim=(-NYQUIST, NYQUIST), ylim=(-NYQUIST, NYQUIST), aspect="equal")
    panel.set_title("Loop gain (Nyquist)")
    panel.set_xlabel("Real part")
    panel.set_ylabel("Imaginary part")
