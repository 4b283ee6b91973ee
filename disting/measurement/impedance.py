"""Impedances as instruments for electrochemistry write them: Gamry (DTA), BioLogic (mpt) and ZPlot
(z), frequency [Hz], real and imaginary part [ohm].

All have a head of settings, one line that names the columns, and rows of numbers, with decimal
points or commas. BioLogic writes -Im.
"""

import re
from dataclasses import replace

import numpy as np

from disting.errors import InputError
from disting.measurement.column_words import Role
from disting.measurement.response import CURRENT, VOLTAGE, FrequencyResponse
from disting.measurement.source import Source
from disting.measurement.text_table import decode
from disting.measurement.understanding import record_format
from disting.model.chain import Quantity

HEADS = (b"ZPLOT", b"EXPLAIN", b"EC-Lab ASCII")
FREQUENCY = re.compile(r"freq", re.IGNORECASE)
REAL = re.compile(r"zreal|re\(z\)|z'\(a\)|z'(?!')", re.IGNORECASE)
IMAGINARY = re.compile(r"-?\s*(zimag|im\(z\)|z'')", re.IGNORECASE)
TURNED = "the imaginary part was mostly positive: taken as -Im, as impedances are often written"
ROLES = (Role.FREQUENCY, Role.REAL, Role.IMAGINARY)
MOSTLY = 0.5  # share of the lines


def is_impedance(_: Source, head: bytes) -> bool:
    """Return True if the first bytes are those of such an instrument."""
    return head.startswith(HEADS)


def read_impedance(file: Source) -> FrequencyResponse:
    """The impedance in a file [V/A], as the response of a circuit: the voltage is what a position
    is to a machine. Raises InputError.
    """
    lines = decode(file.content, file.name).splitlines()
    headed = ((n, at) for n, line in enumerate(lines) if (at := _columns(_cells(line))))
    start, at = next(headed, (0, ()))
    if not at:
        raise InputError(
            f"{file.name}: no line names frequency, real and imaginary part; save the table as CSV"
        )
    rows = [row for line in lines[start + 1 :] if (row := _numbers(line, at))]
    if not rows:
        raise InputError(f"{file.name}: no numbers follow the names of the columns")
    frequency, real, imaginary = np.array(rows).T
    headers = [_cells(lines[start])[i] for i in at]
    sign = -1.0 if headers[2].startswith("-") else 1.0
    return FrequencyResponse(
        2 * np.pi * frequency,
        real + sign * 1j * imaginary,
        quantity=Quantity.POSITION,
        input=CURRENT,
        output=VOLTAGE,
        origin=file.name,
        reading=f"frequency in Hz, {headers[1]}, {headers[2]}",
        columns=record_format(zip(headers, ROLES, ("Hz", "ohm", "ohm"), strict=True)),
        is_impedance=True,
    )


def as_impedance(measured: FrequencyResponse) -> FrequencyResponse:
    """A response that was read as that of a machine, as an impedance: -Im is turned where the data
    show that, and the file does not define it.
    """
    turned = measured.output != VOLTAGE and np.mean(measured.G.imag > 0) > MOSTLY
    notes = tuple(note for note in measured.notes if "sensor quantity" not in note)
    return replace(
        measured,
        G=measured.G.conj() if turned else measured.G,
        quantity=Quantity.POSITION,
        is_impedance=True,
        notes=(*notes, *([TURNED] if turned else [])),
    )


def _cells(line: str) -> list[str]:
    return [cell.strip() for cell in line.split("\t")]


def _columns(cells: list[str]) -> tuple[int, ...]:
    """Where frequency, real and imaginary part are; () where one is missing."""
    columns = [
        next((i for i, cell in enumerate(cells) if words.match(cell)), -1)
        for words in (FREQUENCY, REAL, IMAGINARY)
    ]
    return () if -1 in columns else tuple(columns)


def _numbers(line: str, at: tuple[int, ...]) -> tuple[float, ...] | None:
    """The numbers of a row; None of a row of units, or of an end."""
    cells = [cell.replace(",", ".") for cell in _cells(line)]
    try:
        return tuple(float(cells[i]) for i in at)
    except (ValueError, IndexError):
        return None
