"""Diagrams of a fit's answer as numbers: measured lines, curves of the structures that are left.

They are written with the fit, in the format of the diagram of what was read, so that the page draws
and zooms both alike.
"""

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from disting.app.interface import Json
from disting.app.reading import lines_of, numbers, points_of
from disting.fit.judge.members import QUANTILE
from disting.fit.results.networks import NetworkSelection
from disting.fit.results.selection import Selection
from disting.fit.search.candidates import reference
from disting.measurement import FrequencyResponse
from disting.measurement.arrays import Real
from disting.model.chain import Sort
from disting.report.fit.bode import Line, model_line
from disting.report.fit.network_curves import NetworkLine, network_line, scatters_of
from disting.report.fit.responses import responses
from disting.report.fit.series import Series, corners, series_of
from disting.report.fit.style import Tone
from disting.report.fit.words import response_unit

POINTS = 10_000  # of a curve, before those on straight lines are left out
FINE = 1e-4  # of the range of a curve: less is not seen, zoomed in either
OTHERS = 3  # curves beside that of the selected structure
WIDEST = 10.0  # standard error from which on a band fills the panel


def figures_of(
    selection: Selection, train: FrequencyResponse, test: FrequencyResponse | None
) -> list[Json]:
    """Return a Bode diagram of each response of a fit of chains; none if the fit asks for the
    quantity.
    """
    return [] if selection.question else [*_bode_diagrams(selection, train, test)]


def _bode_diagrams(
    selection: Selection, train: FrequencyResponse, test: FrequencyResponse | None
) -> Iterator[Json]:
    described, task = selection.described, selection.task
    others = [m.candidate for m in selection.members if m.candidate is not described]
    candidates = [described, *others[:OTHERS]]
    for r in responses(selection, train, test):
        series = series_of(described, task, r.train, r.test, r.at)
        lines = [
            model_line(c, task, [s.measured for s in series], r.at, POINTS) for c in candidates
        ]
        yield {
            "kind": "bode",
            "title": r.setup.text if len(task.cost.setups) > 1 else "",
            "unit": response_unit(r.train),
            "measured": [_lines(s, lines[0].phase_of(s.measured)) for s in series],
            "curves": _curves([reference(c.chain) for c in candidates], lines),
        }


def figures_of_networks(selection: NetworkSelection) -> list[Json]:
    """Return a Nyquist diagram of each impedance of a fit of networks, else a Bode diagram."""
    described, scatters = selection.fits[0], scatters_of(selection)
    is_circuit = described.network.sort is Sort.CIRCUIT
    fits = [described, *[f for f in selection.left if f is not described][:OTHERS]]
    figures = list[Json]()
    for at, measured in enumerate(selection.measured):
        lines = [network_line(fit, selection, at, POINTS) for fit in fits]
        series = Series("data", measured, Tone.FIRST, "o", scatters[at])
        figure = {
            "kind": "nyquist" if is_circuit else "bode",
            "title": f"response {at + 1}" if len(selection.measured) > 1 else "",
            "unit": "Ω" if is_circuit else response_unit(measured),
            "measured": [_lines(series, lines[0].phase_of(measured))],
            "curves": _curves([fit.network.name for fit in fits], lines),
        }
        figures.append(figure)
    return figures


def _lines(series: Series, phase: Real) -> Json:
    """Measured lines with their phase [degree]; intervals only where the data give them."""
    rho = series.scatter.rho if series.has_bars else None
    return {"name": series.label, **lines_of(series.measured, phase, rho)}


def _curves(names: Sequence[str], lines: Sequence[Line | NetworkLine]) -> list[Json]:
    """Curves whose phases are in one turn; the first one, of the selected structure, has a band."""
    first, *others = lines
    turns = [360 * np.round(np.median(first.phase - line.phase) / 360) for line in others]
    phases = [first.phase, *(o.phase + turn for o, turn in zip(others, turns, strict=True))]
    found = [_curve(*parts) for parts in zip(names, lines, phases, strict=True)]
    return [found[0] | _band(first), *found[1:]]


def _curve(name: str, line: Line | NetworkLine, phase: Real) -> Json:
    at = _corners(line)
    return {"name": name, **points_of(line.omega[at] / (2 * np.pi), line.G[at], phase[at])}


def _corners(line: Line | NetworkLine) -> NDArray[np.intp]:
    """Indices of the points of a curve that do not lie on a straight line between others."""
    size = np.log(np.maximum(np.abs(line.G), np.finfo(float).tiny))
    plane = (line.G.real, line.G.imag) if isinstance(line, NetworkLine) else ()
    return corners(np.log(line.omega), size, line.phase, *plane, *_halves(line), fine=FINE)


def _halves(line: Line | NetworkLine) -> list[Real]:
    """Half of the 95 % bands of ln |G| and arg G [rad], shape (n_f,) each."""
    errors = (line.sure.amplitude, line.sure.phase)
    return [QUANTILE * np.minimum(error, WIDEST) for error in errors]


def _band(line: Line | NetworkLine) -> Json:
    """The 95 % band of a curve at its points: of ln |G|, of arg G [rad], and of an impedance the
    half across the curve in the complex plane.
    """
    at = _corners(line)
    found = dict(zip(("wide", "wide_phase"), (numbers(h[at]) for h in _halves(line)), strict=True))
    if not isinstance(line, NetworkLine):
        return found
    most = WIDEST * float(np.abs(line.G).max())
    half = (QUANTILE * np.minimum(line.across, most) * line.normal)[at]
    return found | {"across_re": numbers(half.real), "across_im": numbers(half.imag)}
