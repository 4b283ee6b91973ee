"""Data page: a measured file as it is read, with the fields that change how it is read.

A reading is what the fields hold: {"quantity": "velocity", "units": {"output": "deg/s"}, ...}. It
becomes options of the reader and steps after it, and the words of the command that does the same.
"""

from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import cast

import numpy as np

from disting.app.interface import Json
from disting.app.project import measured
from disting.errors import InputError, short
from disting.fit.judge.members import QUANTILE
from disting.measurement import FrequencyResponse, beginnings, in_si, read
from disting.measurement.arrays import Complex, Real
from disting.measurement.look_text import fact_rows
from disting.measurement.looking import Change, Look, look, name_units
from disting.measurement.options import LookOptions
from disting.measurement.scaling import scale, with_constant
from disting.report.fit.words import response_unit
from disting.statistics.scatter import scatter

MOST_DRAWN = 1500  # lines of a diagram
OF_READER = ("frequency", "phase", "magnitude")  # units that a reader takes
OF_RECORD = ("input", "output", "reference", "time", "sampling_rate")  # options of a reader
NAMED_BY_FIELDS = ("assumed", "doubt")  # facts that the page shows on their own


def look_at_file(request: Json) -> Json:
    """The file as it is read: columns, facts, assumptions, doubts, lines of its diagram, and the
    command that shows the same.
    """
    path, reading = measured(request["file"]), request["reading"]
    seen = look(path, changes=list(changes(reading)), **options(reading))
    seen = name_units(seen, reading.get("units", {}))
    return {
        "look": seen.to_dict(),
        "facts": [[name, text] for name, text in fact_rows(seen) if name not in NAMED_BY_FIELDS],
        "responses": _responses(path, seen),
        "diagram": diagram(seen),
        "command": " ".join(["disting", "look", *command_words(path, reading)]),
    }


def response_of(file: str, reading: Json) -> FrequencyResponse:
    """The response that a fit takes, which has its own way with the sign. Raises InputError."""
    response = read(measured(file), **options(reading))
    for change in changes({name: x for name, x in reading.items() if name != "sign"}):
        response = change(response)
    return response


def options(reading: Json) -> LookOptions:
    """Options of the reader, the sign left to `changes`.

    >>> options({"quantity": "velocity", "units": {"frequency": "rad/s", "output": "deg"}})
    {'quantity': 'velocity', 'frequency_unit': 'rad/s'}
    """
    units = reading.get("units", {})
    named = ("quantity", "column", "hold", *OF_RECORD)
    taken: Json = {name: reading[name] for name in named if name in reading}
    taken |= {f"{name}_unit": units[name] for name in OF_READER if name in units}
    return cast("LookOptions", taken)


def changes(reading: Json) -> Iterator[Change]:
    """Steps after the reader, in the order of the command line."""
    units = reading.get("units", {})
    if "scale" in reading:
        yield partial(scale, factor=reading["scale"])
    yield partial(in_si, input=units.get("input"), output=units.get("output"))
    if "torque_constant" in reading:
        yield partial(with_constant, constant=reading["torque_constant"])
    if "band" in reading:
        low, high = reading["band"]
        if not low < high:
            raise InputError(f"the band begins at {low:g} Hz and ends at {high:g} Hz; swap them")
        yield partial(FrequencyResponse.masked, low=low, high=high)
    if reading.get("sign") == "-":
        yield FrequencyResponse.sign_reversed


def command_words(path: Path, reading: Json) -> list[str]:
    """Words of the command line that reads the same.

    >>> command_words(Path("data/a.csv"), {"band": [1, 20], "units": {"output": "deg"}})
    ['data/a.csv', '--unit', 'output=deg', '--band', '1..20']
    """
    words = [str(path)]
    for name in ("quantity", "column", "hold"):
        words += [f"--{name}", str(reading[name])] if name in reading else []
    for name, unit in reading.get("units", {}).items():
        words += ["--unit", f"{name}={unit}"]
    for name in OF_RECORD:
        words += ["--read", f"{name}={reading[name]}"] if name in reading else []
    for name in ("scale", "torque_constant"):
        words += [f"--{name.replace('_', '-')}", f"{reading[name]:.12g}"] if name in reading else []
    if "band" in reading:
        words += ["--band", "..".join(f"{x:.12g}" for x in reading["band"])]
    return words + ([f"--sign={reading['sign']}"] if "sign" in reading else [])


def diagram(seen: Look) -> Json | None:
    """Lines of the diagram, numbers in the units of `unit`; None where there is no response."""
    response = seen.response
    if response is None:
        return None
    known = _known_scatter(response)
    phase = np.degrees(np.unwrap(np.angle(response.G)))
    return {
        "kind": "nyquist" if seen.is_impedance else "bode",
        "unit": "Ω" if seen.is_impedance else response_unit(response),
        "lines": len(response),
        **lines_of(response, phase, known),
    }


def lines_of(response: FrequencyResponse, phase: Real, rho: Real | None) -> Json:
    """Return the lines of a diagram, at most `MOST_DRAWN`, with their phase [degree] and scatter
    `rho`, shape (n_f,) each.
    """
    at = np.unique(np.linspace(0, len(response) - 1, MOST_DRAWN).astype(int))
    if len(response) <= MOST_DRAWN:
        at = np.arange(len(response))
    return points_of(response.frequency[at], response.G[at], phase[at]) | {
        "wide": None if rho is None else numbers(QUANTILE * rho[at])
    }


def points_of(frequency: Real, response: Complex, phase: Real) -> Json:
    """Return points of a diagram as plain data."""
    columns = {"frequency": frequency, "re": response.real, "im": response.imag}
    columns |= {"gain": np.abs(response)}
    return {name: numbers(column) for name, column in (columns | {"phase": phase}).items()}


def numbers(values: Real) -> list[float]:
    """Return numbers as plain data."""
    return [float(value) for value in values]


def _known_scatter(response: FrequencyResponse) -> Real | None:
    """Scatter of the lines, shape (n_f,), None where it is unknown."""
    try:
        rho = scatter(response).rho
    except (InputError, ValueError, ArithmeticError):
        return None
    return rho if np.all(np.isfinite(rho)) else None


def _responses(path: Path, seen: Look) -> list[Json]:
    """Columns at which the responses of a table begin, with their headers."""
    try:
        begin = beginnings(path) or ()
    except InputError:
        return []
    names = {column.number: column.name for column in seen.columns}
    return [{"column": number, "name": names.get(number) or short(number)} for number in begin]
