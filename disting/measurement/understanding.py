"""The columns of a measured file as its reader understood them, recorded while it reads.

The sentence on a response that was read, the table of `disting look` and its list of assumptions
are all made of these records, so that none of them can contradict what was done with the numbers.
"""

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from disting.measurement.arrays import Real
from disting.measurement.column_words import Column, Role, Why
from disting.measurement.units import gain

FIRST = 3  # numbers of a column that a record keeps
OF_RESPONSE = (Role.FREQUENCY, Role.REAL, Role.IMAGINARY, Role.GAIN, Role.PHASE, Role.RESPONSE)
SPELLED = {"deg": "degrees"}


@dataclass(frozen=True, slots=True)
class ReadColumn:
    """A column, or a variable, of a file as its reader understood it.

    `number` from 1, 0 for a variable; `unit`: that in which its numbers were read, "" for none;
    `why`, `unit_why`: reasons for role and unit; `is_used`: False for a column that the response
    is not made of; `values`: its first numbers, in the unit of the file.
    """

    name: str
    number: int
    role: Role
    unit: str = ""
    why: Why = Why.NOTHING
    unit_why: Why = Why.NOTHING
    is_used: bool = True
    values: tuple[float, ...] = ()

    @property
    def place(self) -> str:
        """Number of a column, or name of a variable, for messages."""
        return f"column {self.number}" if self.number else self.name


@dataclass(frozen=True, slots=True)
class Use:
    """The role in which a reader used a column, and the unit that it took."""

    role: Role
    unit: str = ""
    unit_why: Why = Why.NOTHING


def record_columns(
    headers: Sequence[str],
    values: Real,
    roles: Sequence[Column],
    uses: Mapping[int, Use] | None = None,
) -> tuple[ReadColumn, ...]:
    """Return a record of each column of a table; `values`, shape (rows, columns).

    `uses`: the columns, from 0, that the response is made of; None where no response was read.
    """
    return tuple(
        _record(
            ReadColumn(name, at + 1, Role.OTHER, values=_first(values[:, at])),
            roles[at],
            None if uses is None else uses.get(at),
            uses is None,
        )
        for at, name in enumerate(headers)
    )


def record_variables(
    names: Iterable[str], uses: Mapping[str, Use], asked: Collection[str | None]
) -> tuple[ReadColumn, ...]:
    """Return a record of each variable that was used, then of the others; `asked`: those that the
    caller named.
    """
    used = (
        ReadColumn(name, 0, use.role, use.unit, _reason_of_name(name in asked), use.unit_why)
        for name, use in uses.items()
    )
    return (*used, *(ReadColumn(n, 0, Role.OTHER, is_used=False) for n in names if n not in uses))


def record_format(columns: Iterable[tuple[str, Role, str]]) -> tuple[ReadColumn, ...]:
    """Return records of columns that a file format fixes: name, role, unit."""
    return tuple(
        ReadColumn(name, 0, role, unit, Why.FORMAT, Why.FORMAT if unit else Why.NOTHING)
        for name, role, unit in columns
    )


def with_unit(
    columns: Sequence[ReadColumn], role: Role, unit: str, why: Why = Why.OPTION
) -> tuple[ReadColumn, ...]:
    """Return the columns with this unit for those of a role, and its reason."""
    return tuple(
        replace(column, unit=unit, unit_why=why)
        if column.role is role and column.is_used
        else column
        for column in columns
    )


def by_name(columns: Sequence[ReadColumn]) -> tuple[ReadColumn, ...]:
    """Return the columns of a record whose input and output were chosen by their names."""
    return tuple(
        replace(column, why=Why.BY_NAME) if column.role in (Role.INPUT, Role.OUTPUT) else column
        for column in columns
    )


def sentence(columns: Sequence[ReadColumn]) -> str:
    """Return the columns of the response in words.

    >>> columns = [ReadColumn("f", 1, Role.FREQUENCY, "Hz"), ReadColumn("A", 2, Role.GAIN, "dB")]
    >>> sentence(columns)
    'frequency in Hz (column 1), gain in dB (column 2)'
    """
    return ", ".join(_phrases(columns))


def _phrases(columns: Sequence[ReadColumn]) -> Iterator[str]:
    for role in OF_RESPONSE:
        chosen = [c for c in columns if c.role is role and c.is_used]
        for column in chosen[:1]:
            unit = f" in {phrase}" if (phrase := _unit_phrase(column)) else ""
            yield f"{role}{unit} ({column.place})"


def _unit_phrase(column: ReadColumn) -> str:
    """Unit of a frequency or phase, level of a gain, "" for a linear one."""
    if column.role in (Role.FREQUENCY, Role.PHASE):
        return SPELLED.get(column.unit, column.unit)
    level = gain(column.unit) if column.role is Role.GAIN else None
    return "" if level is None or level.level == "1" else level.level


def _record(plain: ReadColumn, column: Column, use: Use | None, nothing_read: bool) -> ReadColumn:
    unit = column.unit or column.unknown
    stated = (Why.OPTION if column.why is Why.OPTION else Why.UNIT) if unit else Why.NOTHING
    if use is not None:
        chosen = (use.unit, use.unit_why) if use.unit else (unit, stated)
        return replace(
            plain, role=use.role, unit=chosen[0], why=column.why, unit_why=chosen[1], is_used=True
        )
    is_other = column.role is Role.OTHER
    why = column.why if nothing_read or is_other else Why.ELSEWHERE
    is_used = nothing_read and not is_other
    return replace(plain, role=column.role, unit=unit, why=why, unit_why=stated, is_used=is_used)


def _reason_of_name(by_caller: bool) -> Why:
    return Why.OPTION if by_caller else Why.WORD


def _first(values: Real) -> tuple[float, ...]:
    return tuple(float(value) for value in np.asarray(values[:FIRST]))
