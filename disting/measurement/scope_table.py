"""Exports of TwinCAT Scope (CSV and TXT): a line for each property of the channels, such as Name,
SampleTime[ms] and Unit, then the samples.

A column that repeats the name of the property in each of these lines is the time [ms] of the
channels behind it, up to the next such column. Channels of several sample times stand beside each
other, sample by sample and whatever their times: those of the sample time that most of them have
are read.
"""

import re
from array import array
from collections import Counter
from collections.abc import Iterator

import numpy as np

from disting.errors import InputError, shown
from disting.measurement.table import Table

NAME, RATE, UNIT = "Name", "SampleTime[ms]", "Unit"
HEAD = 60  # lines within which the properties stand
NO_UNIT = "(None)"
QUANTITY = re.compile(r"\s*\([^()]*\)$")  # behind a unit: dV (Voltage)


def scope_table(text: str, origin: str) -> Table | None:
    """The table of an export, time [ms] first; None for any other text. Raises InputError for a
    sample that is no number.
    """
    lines = re.split(r"\r\n|\n|\r", text)
    if not lines[0].startswith(NAME) or not lines[0][len(NAME) :]:
        return None
    mark = lines[0][len(NAME)]  # what separates the cells
    head = [line.split(mark) for line in lines[:HEAD]]
    at = next((i for i, row in enumerate(head) if row[0] == RATE), 0)
    if not at:
        return None
    first = max((i for i in range(at) if head[i][0] == NAME), default=at)
    end = next((i for i in range(at, len(head)) if not head[i][0]), len(head))
    told = {row[0]: row for row in head[first:end]}
    columns = _columns(told[RATE], origin)
    headers = ("time [ms]", *(_header(told, j) for j in columns[1:]))
    cells, numbers = array("d"), list[int]()
    for n, row in enumerate((line.split(mark) for line in lines[end:]), end + 1):
        if len(row) > columns[0] and row[columns[0]].strip() not in ("", "EOF"):
            cells.extend(_numbers(row, columns, f"{origin}, line {n}", mark))
            numbers.append(n)
    values = np.frombuffer(cells, dtype=np.float64).reshape(-1, len(columns))
    return Table(headers, values, tuple(numbers), (), origin)


def _columns(rates: list[str], origin: str) -> list[int]:
    """The column of a time and those of the channels of the sample time that most have, of two the
    first one.
    """
    channels = {j: rate for j, rate in enumerate(rates) if re.fullmatch(r"\d+([.,]\d+)?", rate)}
    kept: list[int] = []
    for wanted, _ in Counter(channels.values()).most_common(1):
        kept = [j for j, rate in channels.items() if rate == wanted]
    if not kept:
        raise InputError(f"{origin}: no channel of this export of TwinCAT Scope has a {RATE}")
    return [max(j for j in range(kept[0]) if rates[j] == RATE), *kept]


def _header(told: dict[str, list[str]], j: int) -> str:
    """Name of a channel with its unit."""
    units = told.get(UNIT, [])
    unit = units[j].strip() if j < len(units) else NO_UNIT
    name = told[NAME][j].strip()
    return name if unit in ("", NO_UNIT) else f"{name} [{QUANTITY.sub('', unit)}]"


def _numbers(row: list[str], columns: list[int], where: str, mark: str) -> Iterator[float]:
    for j in columns:
        cell = row[j].strip() if j < len(row) else ""
        try:
            yield float(cell if mark == "," else cell.replace(",", "."))
        except ValueError:
            raise InputError(f"{where}, column {j + 1}: {shown(cell)} is no number") from None
