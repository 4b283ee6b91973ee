"""Columns of numbers with headers, from a text file or a data frame.

Time series from a table of columns.
"""

import re
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from disting.errors import InputError, enumeration, short
from disting.measurement.arrays import Real
from disting.measurement.column_words import Column, Role, Why, matching, split_unit
from disting.measurement.response import Signal, as_sign
from disting.measurement.time_series import TimeSeries, said
from disting.measurement.understanding import ReadColumn, Use, record_columns
from disting.measurement.units import TIMES, drive, known_unit, motion
from disting.model.chain import Quantity


@dataclass(frozen=True, slots=True, eq=False)
class Table:
    """Columns of numbers, shape (rows, columns), their headers ("" without one), the line number of
    each row, the comments; `transposed`: the file has a line for each column; `left_out` lists
    which other columns the file has, "" for none.
    """

    headers: tuple[str, ...]
    values: Real
    lines: tuple[int, ...]
    comments: tuple[str, ...]
    origin: str
    transposed: bool = False
    left_out: str = ""

    def column(self, at: int) -> Real:
        """Numbers of column `at` (from 0); raises InputError naming the line of one that is not
        finite.
        """
        values = self.values[:, at]
        if not np.all(np.isfinite(values)):
            line = self.lines[int(np.argmin(np.isfinite(values)))]
            raise InputError(
                f"{self.origin}, line {line}, {self.named(at)}: the value is not finite; remove the"
                " line"
            )
        return np.asarray(values)

    def at(self, column: str | int) -> int:
        """Number, from 0, of a column named by its header, with or without its unit
        (`matching`), or by its number from 1; raises InputError listing the headers.
        """
        if (
            isinstance(column, int)
            and not isinstance(column, bool)
            and 1 <= column <= len(self.headers)
        ):
            return column - 1
        places = matching(self.headers, column) if isinstance(column, str) else []
        if not places and isinstance(column, str) and column.isdecimal():
            return self.at(int(column))
        if len(places) != 1:
            raise InputError(
                f"{self.origin}: {len(places) or 'no'} columns are called {short(column)}; headers:"
                f" {self.listed()}"
            )
        return places[0]

    def named(self, at: int) -> str:
        """Number from 1 and header of a column, for messages."""
        return f"column {at + 1} ({self.headers[at]})" if self.headers[at] else f"column {at + 1}"

    def listed(self) -> str:
        """All headers, for messages."""
        text = enumeration(h or f"(column {i})" for i, h in enumerate(self.headers, 1))
        return f"{text}; {self.left_out}" if self.left_out else text


BRACKETED = re.compile(r"^(.*?)\s*[\[(]\s*([^\])]+?)\s*[\])]\s*$")


def time_series(
    table: Table,
    input: str | int,
    output: str | int,
    *,
    reference: str | int | None = None,
    sampling_rate: float | None = None,
    time: str | int | None = None,
    quantity: Quantity | str | None = None,
    sign: int = 1,
) -> TimeSeries:
    """Samples of the columns `input` and `output` (header, or number from 1) at `sampling_rate`
    [Hz] or column `time` [s].

    `reference` = the column of the command of a controller, where the record is of a closed loop.
    """
    uses: dict[int, Use] = {}
    if sampling_rate is None:
        at = (
            table.at(time)
            if time is not None
            else next((i for i, h in enumerate(table.headers) if is_time(h)), None)
        )
        if at is None:
            raise InputError(
                f"{table.origin}: give --read sampling_rate=HZ or --read time=COLUMN; headers:"
                f" {table.listed()}"
            )
        sampling_rate = rate_of(table.column(at) * _seconds(table, at), table.origin)
        stated = _time_unit(table.headers[at])
        uses[at] = Use(Role.CLOCK, stated or "s", Why.UNIT if stated else Why.ASSUMED)
    u, y = table.at(input), table.at(output)
    labels = split_header(table.headers[u]), split_header(table.headers[y])
    origin = f"{table.origin}, {table.named(y)} per {table.named(u)}"
    shown, notes = said(quantity, labels[1])
    wanted = None if reference is None else table.column(table.at(reference))
    samples = table.column(u), table.column(y) * as_sign(sign)
    uses |= {u: Use(Role.INPUT), y: Use(Role.OUTPUT)}
    uses |= {} if reference is None else {table.at(reference): Use(Role.REFERENCE)}
    columns = signal_columns(table, uses, is_clock_given=time is not None)
    return TimeSeries(
        *samples,
        sampling_rate,
        shown,
        *labels,
        origin,
        notes,
        wanted,
        table.left_out,
        columns,
    )


def signal_columns(
    table: Table, uses: Mapping[int, Use], *, is_clock_given: bool = False
) -> tuple[ReadColumn, ...]:
    """Return a record of each column of a table of signals, such as time series; `uses`: those that
    were read, by their numbers from 0.
    """
    roles = []
    for at, header in enumerate(table.headers):
        use = uses.get(at, Use(Role.OTHER))
        by_header = use.role is Role.CLOCK and not is_clock_given
        why = Why.WORD if by_header else Why.OPTION if at in uses else Why.NOTHING
        roles.append(Column(use.role, split_header(header).unit, why=why))
    return record_columns(table.headers, table.values, roles, uses)


def split_header(header: str) -> Signal:
    """Name and unit of a signal headed like `iq [A]`; no unit where the brackets hold another word.

    >>> split_header("angle (deg)"), split_header("out (filtered)")
    (Signal(label='angle', unit='deg'), Signal(label='out (filtered)', unit=''))
    """
    parts = BRACKETED.match(header)
    return (
        Signal(parts[1], parts[2])
        if parts and (motion(parts[2]) or drive(parts[2]))
        else Signal(header)
    )


def rate_of(time: Real, origin: str) -> float:
    """Sampling rate [Hz] of equidistant times [s]; raises InputError for others."""
    steps = np.diff(time)
    if not len(steps) or np.any(steps <= 0) or np.ptp(steps) > 1e-3 * np.mean(steps):
        raise InputError(
            f"{origin}: the times are not equidistant and rising; resample, or give --read"
            " sampling_rate=HZ"
        )
    return float(len(steps) / (time[-1] - time[0]))


def _seconds(table: Table, at: int) -> float:
    """Factor from the unit of a time column to seconds; raises InputError for a stated unit that is
    unknown.
    """
    unit = _time_unit(table.headers[at]) or "s"
    name = known_unit(unit, TIMES)
    if name is None:
        raise InputError(
            f"{table.origin}, {table.named(at)}: {short(unit)} is not a known unit of time;"
            f" known units: {', '.join(TIMES)}: give --read sampling_rate=HZ"
        )
    return TIMES[name]


def _time_unit(header: str) -> str:
    """Unit that the header of a clock states, "" for none."""
    last = header.split()[-1] if header.split() else ""
    return split_unit(header)[1] or (last if known_unit(last, TIMES) else "")


def is_time(header: str) -> bool:
    """Return True if a column is the time."""
    return re.match(r"(t|time|zeit|timestamp|zeitstempel)\b", header.lower()) is not None
