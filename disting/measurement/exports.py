"""Records in time as TwinCAT Scope and LabVIEW export them: lines with the properties of the
channels, then the samples.

TwinCAT Scope (CSV, TXT) has a line for each property, such as Name, SampleTime[ms] and Unit. A
column that repeats the name of the property in each of these lines is the time [ms] of the channels
behind it, up to the next such column. Channels of several sample times are in adjacent columns,
sample by sample for any times: those of the sample time that most of them have are read, and the
others are named.

LabVIEW (LVM) has two headers, the second one with Delta_X, the step of the time [s], and
Y_Unit_Label of each channel. Columns of times, X_Value, may be missing; comments are last.
"""

import re
from array import array
from collections import Counter
from collections.abc import Iterator

import numpy as np

from disting.errors import InputError, enumeration, short
from disting.measurement.table import Table

NAME, RATE, UNIT = "Name", "SampleTime[ms]", "Unit"
LVM, END, X, STEP = "LabVIEW Measurement", "***End_of_Header***", "X_Value", "Delta_X"
HEAD = 60  # lines within which the properties stand
NO_UNIT = "(None)"
QUANTITY = re.compile(r"\s*\([^()]*\)$")  # behind a unit: dV (Voltage)


def read_export(text: str, origin: str) -> Table | None:
    """The table of an export, its time first; None for any other text. Raises InputError for a
    sample that is no number, and for what has no sample time.
    """
    lines = re.split(r"\r\n|\n|\r", text)
    return _labview(lines, origin) if lines[0].startswith(LVM) else _scope(lines, origin)


def _scope(lines: list[str], origin: str) -> Table | None:
    if not lines[0].startswith(NAME) or not lines[0][len(NAME) :]:
        return None
    mark = lines[0][len(NAME)]  # what separates the cells
    head = [line.split(mark) for line in lines[:HEAD]]
    at = next((i for i, row in enumerate(head) if row[0] == RATE), 0)
    if not at:
        return None
    first = max((i for i in range(at) if head[i][0] == NAME), default=at)
    end = next((i for i in range(at, len(head)) if not head[i][0]), len(head))
    fields = {row[0]: row for row in head[first:end]}
    columns = _columns(fields[RATE], origin)
    headers = ("time [ms]", *(_header(fields, j) for j in columns[1:]))
    cells, numbers = array("d"), list[int]()
    for n, row in enumerate((line.split(mark) for line in lines[end:]), end + 1):
        if len(row) > columns[0] and row[columns[0]].strip() not in ("", "EOF"):
            cells.extend(_numbers(row, columns, f"{origin}, line {n}", mark))
            numbers.append(n)
    values = np.frombuffer(cells, dtype=np.float64).reshape(-1, len(columns))
    return Table(
        headers, values, tuple(numbers), (), origin, left_out=_left_out(fields, columns[1:])
    )


def _left_out(rows: dict[str, list[str]], kept: list[int]) -> str:
    """The channels of other sample times."""
    rates = rows[RATE]
    others = [
        f"{_header(rows, j)} (each {r} ms)" for j, r in _read_sampling(rates) if j not in kept
    ]
    return f"left out: {enumeration(others)}, not each {rates[kept[0]]} ms" if others else ""


def _read_sampling(rates: list[str]) -> list[tuple[int, str]]:
    """Columns of channels and their sample times [ms]."""
    return [(j, rate) for j, rate in enumerate(rates) if re.fullmatch(r"\d+([.,]\d+)?", rate)]


def _columns(rates: list[str], origin: str) -> list[int]:
    """The column of a time and those of the channels of the sample time that most have, of two the
    first one.
    """
    channels = dict(_read_sampling(rates))
    kept: list[int] = []
    for wanted, _ in Counter(channels.values()).most_common(1):
        kept = [j for j, rate in channels.items() if rate == wanted]
    if not kept:
        raise InputError(f"{origin}: no channel of this export of TwinCAT Scope has a {RATE}")
    return [max(j for j in range(kept[0]) if rates[j] == RATE), *kept]


def _header(rows: dict[str, list[str]], j: int) -> str:
    """Name of a channel with its unit."""
    unit = _cell(rows.get(UNIT, []), j)
    name = rows[NAME][j].strip()
    return name if unit in ("", NO_UNIT) else f"{name} [{QUANTITY.sub('', unit)}]"


def _labview(lines: list[str], origin: str) -> Table:
    ends = [i for i, line in enumerate(lines) if line.startswith(END)]
    if len(ends) != 2 or len(lines) < ends[1] + 2:
        raise InputError(f"{origin}: an LVM file of {max(len(ends) - 1, 0)} records; export one")
    fields = {key: rest for key, _, rest in (line.partition("\t") for line in lines[: ends[0]])}
    mark = "," if fields.get("Separator", "").strip() == "Comma" else "\t"
    rows = {row[0]: row for row in (line.split(mark) for line in lines[ends[0] + 1 : ends[1]])}
    names = lines[ends[1] + 1].split(mark)
    columns = [j for j, name in enumerate(names) if name.strip() not in ("", X, "Comment")]
    steps = list(_numbers(rows.get(STEP, []), columns, f"{origin}, {STEP}", mark))
    if not steps or min(steps) <= 0 or max(steps) > min(steps):
        raise InputError(f"{origin}: the channels have no common {STEP}")
    units = rows.get("Y_Unit_Label", [])
    headers = [f"{names[j].strip()} [{u}]" if (u := _cell(units, j)) else names[j] for j in columns]
    first, cells, numbers = ends[1] + 2, array("d"), list[int]()
    for n, row in enumerate((line.split(mark) for line in lines[first:]), first + 1):
        if any(cell.strip() for cell in row):
            cells.extend([steps[0] * len(numbers)])
            cells.extend(_numbers(row, columns, f"{origin}, line {n}", mark))
            numbers.append(n)
    values = np.frombuffer(cells, dtype=np.float64).reshape(-1, 1 + len(columns))
    return Table(("time [s]", *headers), values, tuple(numbers), (), origin)


def _cell(row: list[str], j: int) -> str:
    return row[j].strip() if j < len(row) else ""


def _numbers(row: list[str], columns: list[int], where: str, mark: str) -> Iterator[float]:
    for j in columns:
        cell = _cell(row, j)
        try:
            yield float(cell if mark == "," else cell.replace(",", "."))
        except ValueError:
            raise InputError(f"{where}, column {j + 1}: {short(cell)} is no number") from None
