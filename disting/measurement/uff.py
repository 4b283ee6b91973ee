"""Universal file format (UFF, UNV), data set 58, by pyuff: function type 4 is a frequency
response, 6 a coherence.

The quantity of the sensor is the data type of the ordinate's numerator: 8 displacement, 11
velocity, 12 acceleration.
"""

import contextlib
import io
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from disting.errors import InputError, enumeration
from disting.measurement.column_words import Role
from disting.measurement.response import (
    ASSUMED_ACCELERATION,
    FrequencyResponse,
    Signal,
    as_sign,
)
from disting.measurement.source import Source
from disting.measurement.understanding import record_format
from disting.model.chain import Quantity, as_quantity

RESPONSE, COHERENCE = 4, 6
QUANTITIES = {8: Quantity.POSITION, 11: Quantity.VELOCITY, 12: Quantity.ACCELERATION}
DIRECTIONS = {0: "", 1: "+x", 2: "+y", 3: "+z", 4: "+rx", 5: "+ry", 6: "+rz"}
# Columns of numbers in a line that belong together, and the longest line, by type of the ordinate
# and of the abscissa
COLUMNS = {
    (2, 0): (13, 78), (2, 1): (13, 78), (5, 0): (13, 78), (5, 1): (13, 78),
    (4, 0): (33, 66), (4, 1): (20, 80), (6, 0): (53, 53), (6, 1): (20, 80),
}  # fmt: skip
COLUMNS_READ = record_format((("abscissa", Role.FREQUENCY, "Hz"), ("ordinate", Role.RESPONSE, "")))
PLACE = ("rsp_node", "rsp_dir", "ref_node", "ref_dir")

Record = Mapping[str, Any]


def read_uff(
    file: Source,
    *,
    record: int | None = None,
    quantity: Quantity | str | None = None,
    sign: int = 1,
) -> FrequencyResponse:
    """Frequency response number `record` (from 1, default 1) of a file; its coherence is taken
    from the file where it is there.

    `quantity` where the file does not state it; `sign` = -1 for a reversed sensor. Raises
    InputError, listing the responses.
    """
    records = _records(file)
    responses = [r for r in records if r.get("type") == 58 and r.get("func_type") == RESPONSE]
    number = 1 if record is None else record
    if not 1 <= number <= len(responses):
        offered = (
            enumeration((f"{i}: {_place(r)}" for i, r in enumerate(responses, 1)), "; ") or "none"
        )
        raise InputError(
            f"{file.name} has no frequency response number {number}; its responses are: {offered}"
        )
    chosen = responses[number - 1]
    shown, note = _quantity(chosen, quantity)
    try:
        data = np.asarray(chosen["data"], dtype=complex)
        if len(data) != chosen["num_pts"]:
            raise ValueError(f"{len(data)} values, but the header states {chosen['num_pts']}")
        return (
            FrequencyResponse(
                2 * np.pi * np.asarray(chosen["x"], dtype=float),
                data if as_sign(sign) > 0 else -data,
                coherence=_coherence(records, chosen),
                quantity=shown,
                input=Signal(_node(chosen, "ref"), _unit(chosen, "orddenom_axis_units_lab")),
                output=Signal(_node(chosen, "rsp"), _unit(chosen, "ordinate_axis_units_lab")),
                origin=f"{file.name}, {_place(chosen)}",
            )
            .noted(note)
            .read_as("frequency in Hz, complex response of a data set 58", COLUMNS_READ)
        )
    except (KeyError, TypeError, ValueError) as error:
        raise InputError(f"{file.name}, {_place(chosen)}: damaged data set ({error})") from None


def _records(file: Source) -> Sequence[Record]:
    try:
        import pyuff
    except ImportError:
        raise InputError(f'{file.name} is a universal file: pip install "disting[uff]"') from None
    try:
        _check_columns(file.content.decode("latin-1"))
        with (
            TemporaryDirectory() as folder,  # pyuff reads files only
            contextlib.redirect_stdout(io.StringIO()),  # and prints what it cannot read
        ):
            path = Path(folder, "data.uff")
            path.write_bytes(file.content)
            sets = pyuff.UFF(str(path))
            numbers = [i for i, kind in enumerate(sets.get_set_types()) if kind == 58]
            return [sets.read_sets(i) for i in numbers]
    except Exception as error:  # damaged files raise whatever the library meets first
        raise InputError(
            f"{file.name} is not a universal file that can be read: {type(error).__name__}: {error}"
        ) from None


def _check_columns(text: str) -> None:
    """Raise ValueError for a line of numbers that is not of whole columns: those behind its
    damage would be shifted.
    """
    for block in re.split(r"(?m)^ {4}-1[ \r]*\n?", text):
        lines = block.splitlines()
        if not lines or lines[0].strip() != "58":
            continue
        width, most = COLUMNS[int(lines[7][:10]), int(lines[7][20:30])]
        for number, line in enumerate(lines[12:], 1):
            if len(line.rstrip()) % width or len(line.rstrip()) > most:
                raise ValueError(f"line {number} of the numbers is not of whole columns")


def _quantity(record: Record, asked: Quantity | str | None) -> tuple[Quantity, str | None]:
    if asked is not None:
        return as_quantity(asked), None
    sensor = QUANTITIES.get(record.get("ordinate_spec_data_type", 0))
    if sensor is not None:
        return sensor, None
    return Quantity.ACCELERATION, ASSUMED_ACCELERATION


def _coherence(records: Sequence[Record], response: Record) -> Any:
    """That of the same output and frequencies, if there is exactly one (a coherence may name no
    input).
    """
    coherences = [
        r["data"] for r in records if r.get("func_type") == COHERENCE and _belongs(r, response)
    ]
    return np.real(coherences[0]) if len(coherences) == 1 else None


def _belongs(coherence: Record, response: Record) -> bool:
    return all(coherence.get(key) == response.get(key) for key in PLACE[:2]) and np.array_equal(
        coherence.get("x", ()), response.get("x", ())
    )


def _node(record: Record, side: str) -> str:
    direction = record.get(f"{side}_dir", 0)
    sign = DIRECTIONS.get(abs(direction), str(direction))
    signed = sign.replace("+", "-") if direction < 0 else sign
    return " ".join(filter(None, (f"node {record.get(f'{side}_node', '?')}", signed)))


def _place(record: Record) -> str:
    return f"{_node(record, 'rsp')} per {_node(record, 'ref')}"


def _unit(record: Record, key: str) -> str:
    unit = str(record.get(key, "")).strip()
    return "" if unit.upper() == "NONE" else unit
