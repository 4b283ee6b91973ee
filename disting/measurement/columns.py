"""Columns of a table that make up a frequency response."""

import re
import shlex
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from disting.errors import InputError, enumeration, short
from disting.measurement.column_words import Column, Role, Why, meaning
from disting.measurement.response import ASSUMED_ACCELERATION
from disting.measurement.table import Table
from disting.measurement.units import (
    FREQUENCIES,
    LEVELS,
    PHASES,
    gain,
    known_unit,
    motion,
    omega_per,
)
from disting.model.chain import Quantity, as_quantity

SENSOR_WORDS = {
    Quantity.POSITION: re.compile(
        r"\b(position|displacement|receptance|compliance|weg|lage)\b|\brad/(nm|a)\b|\bm/(n|a)\b"
    ),
    Quantity.VELOCITY: re.compile(r"\b(velocity|speed|mobility|geschwindigkeit|drehzahl)\b"),
    Quantity.ACCELERATION: re.compile(
        r"\b(acceleration|accelerance|inertance|beschleunigung)\b|/s(\^|\*\*)?2|/s²"
    ),
}
# words of the option `columns` besides units of frequency, phase and gain
WORDS = {
    "re": Column(Role.REAL),
    "im": Column(Role.IMAGINARY),
    "magnitude": Column(Role.GAIN, "1"),
    "phase": Column(Role.PHASE),
    "coherence": Column(Role.COHERENCE),
    "std": Column(Role.DEVIATION),
    "-": Column(Role.OTHER),
}
ROWS, MOST = 3, 20  # rows and columns that a message shows
WIDEST = 24  # signs of a header there
BESIDE = (Role.COHERENCE, Role.DEVIATION)


@dataclass(slots=True)
class Group:
    """Columns of one response, by their roles."""

    columns: dict[Role, int] = field(default_factory=dict)

    @property
    def first(self) -> int:
        """The first of its columns."""
        return min(self.columns.values())


def columns_of(table: Table, asked: Sequence[str] | None, notes: list[str]) -> list[Column]:
    """Role and unit of every column: by the words that the caller gives, else by the headers."""
    if asked is not None:
        return [replace(column, why=Why.OPTION) for column in _find_columns(table, asked)]
    if any(table.headers):
        return [meaning(header) for header in table.headers]
    if len(table.headers) != 3:
        raise misread(
            table,
            [Column(Role.OTHER)] * len(table.headers),
            f"{table.origin} has {len(table.headers)} columns, no header",
        )
    notes.append("no header: columns taken as frequency [Hz], real part, imaginary part")
    assumed = (Column(Role.FREQUENCY, "Hz"), WORDS["re"], WORDS["im"])
    return [replace(column, why=Why.ASSUMED) for column in assumed]


def frequency_column(table: Table, columns: Sequence[Column]) -> int:
    """The column of frequencies, from 0; raises InputError where there is none."""
    numbers = [i for i, column in enumerate(columns) if column.role is Role.FREQUENCY]
    if not numbers:
        raise misread(table, columns, f"{table.origin}: no column is a frequency")
    return numbers[0]


def groups(table: Table, columns: Sequence[Column]) -> list[Group]:
    """Responses in the order of their columns: the n-th real part with the n-th imaginary part,
    a gain with the phase behind it.
    """
    the_groups = sorted(
        (
            Group({columns[i].role: i for i in pair})
            for pair in (*_parts(table, columns), *_gains(columns))
        ),
        key=lambda group: group.first,
    )
    if not the_groups:
        _refuse_spectra(table, columns)
        raise misread(
            table,
            columns,
            f"{table.origin}: no real and imaginary part, no gain and phase are known together",
        )
    for i, column in enumerate(columns):
        if column.role in BESIDE:
            owner = next((g for g in reversed(the_groups) if g.first < i), the_groups[0])
            if column.role in owner.columns:
                raise misread(
                    table,
                    columns,
                    f"{table.origin}: {column.role} occurs twice for one response",
                )
            owner.columns[column.role] = i
    return the_groups


def _refuse_spectra(table: Table, columns: Sequence[Column]) -> None:
    """Raise InputError where columns are power spectra."""
    names = enumeration(table.named(i) for i in _of(columns, Role.SPECTRUM))
    if names:
        raise InputError(
            f"{table.origin}: {names}: a power spectrum is not a frequency response, it has"
            f" neither phase nor input; record the force, torque or current together with the"
            f" motion, and"
            " read both: --read input=NAME --read output=NAME"
        )


def choose(
    table: Table, columns: list[Column], the_groups: Sequence[Group], asked: str | int | None
) -> Group:
    """The first response, or that of the requested column; one that belongs to none is read as a
    gain, followed by the phase.
    """
    if asked is None:
        return the_groups[0]
    at = table.at(asked)
    if columns[at].role is Role.SPECTRUM:
        _refuse_spectra(table, columns)
    own = next((group for group in the_groups if at in group.columns.values()), None)
    phases = [i for i, column in enumerate(columns) if column.role is Role.PHASE]
    if own is None and phases and columns[at].role not in (Role.FREQUENCY, Role.PHASE, *BESIDE):
        columns[at] = Column(Role.GAIN, columns[at].unit, columns[at].unknown)
        return Group({Role.GAIN: at, Role.PHASE: next((i for i in phases if i > at), phases[-1])})
    if own is None:
        firsts = enumeration(table.named(group.first) for group in the_groups)
        raise misread(
            table,
            columns,
            f"{table.origin}: column {short(asked)} is not the first column of a response;"
            f" responses begin at"
            f" {firsts}",
        )
    return own


def misread(table: Table, columns: Sequence[Column], why: str) -> InputError:
    """An error with the table's first rows, its columns as they are understood, and the command
    that would read it.
    """
    words = _guess(table, columns)
    guessed = "Hz" in words and len(words) <= MOST
    command = f"--read columns={','.join(words)}" if guessed else "--read columns=Hz,dB,deg"
    remedy = (
        f"disting fit {shlex.quote(table.origin)} {command}" if guessed else f"such as {command}"
    )
    headers = f"; headers: {table.listed()}" if any(table.headers) else ""
    return InputError(
        f"{why}; name the columns: {remedy}{headers}",
        "\n".join(_describe_columns(table, columns)),
    )


def _describe_columns(table: Table, columns: Sequence[Column]) -> Iterator[str]:
    yield "its first rows, and its columns as they are understood:"
    for i, (header, column) in enumerate(zip(table.headers[:MOST], columns, strict=False)):
        name = header if len(header) <= WIDEST else f"{header[: WIDEST - 1]}…"
        rows = ", ".join(f"{value:.6g}" for value in table.values[:ROWS, i])
        yield f"  {i + 1:3} {name:{WIDEST}}  {column.in_words:24}  {rows}, .."


def _guess(table: Table, columns: Sequence[Column]) -> list[str]:
    """Words for `columns`: what is understood, and what the numbers look like where something is
    missing.
    """
    words = [_word(column) for column in columns]
    free = [i for i, word in enumerate(words) if word == "-"]
    if not any(column.role is Role.FREQUENCY for column in columns):
        rising = [i for i in free if _is_grid(table.values[:, i])]
        if rising:
            words[rising[0]] = "Hz"
            free = [i for i in free if i > rising[0] and np.ptp(table.values[:, i]) > 0]
    roles = {column.role for column in columns}
    if {Role.REAL, Role.IMAGINARY} <= roles or {Role.GAIN, Role.PHASE} <= roles:
        return words
    for missing, partner in (("im", Role.REAL), ("re", Role.IMAGINARY), ("dB", Role.PHASE)):
        if partner in roles and free:
            words[free[0]] = missing
            return words
    if Role.GAIN in roles and free:
        words[free[0]] = "deg"
    elif len(free) > 1:
        turning = np.ptp(table.values[:, free[1]]) > np.pi * 2
        words[free[0]], words[free[1]] = ("dB", "deg") if turning else ("re", "im")
    return words


def _is_grid(values: np.ndarray) -> bool:
    """Return True if numbers may be frequencies."""
    steps = np.diff(values)
    return bool(np.all(values > 0) and (np.all(steps > 0) or np.all(steps < 0)))


def _word(column: Column) -> str:
    """The word of `columns` for a role and unit."""
    if column.role is Role.FREQUENCY:
        return column.unit or "Hz"
    if column.role in (Role.PHASE, Role.GAIN):
        if column.role is Role.PHASE:
            return known_unit(column.unit, PHASES) or "phase"
        return level_of(column) if level_of(column) != "1" else "magnitude"
    return next((word for word, meant in WORDS.items() if meant.role is column.role), "-")


def _find_columns(table: Table, asked: Sequence[str]) -> list[Column]:
    if not isinstance(asked, Sequence):
        raise InputError(f"columns are named by words, not by {short(asked)}")
    words = [asked] if isinstance(asked, str) else list(asked)
    if len(words) != len(table.headers):
        raise InputError(
            f"{table.origin} has {len(table.headers)} columns, of which {len(words)} are named"
        )
    return [_of_word(word) for word in words]


def _of_word(word: str) -> Column:
    if not isinstance(word, str):
        raise InputError(f"columns are named by words, not by {short(word)}")
    if word in WORDS:
        return WORDS[word]
    for role, kind in ((Role.GAIN, LEVELS[1:]), (Role.PHASE, PHASES)):
        unit = known_unit(word, kind)
        if unit is not None:
            return Column(role, unit)
    if omega_per(word) is None:
        kinds = enumeration((*FREQUENCIES, *LEVELS[1:], *PHASES))
        raise InputError(
            f"columns are named by {', '.join(WORDS)}, or by the unit of a frequency, gain or"
            f" phase ({kinds}); {short(word)} is not one of them"
        )
    return Column(Role.FREQUENCY, word)


def _parts(table: Table, columns: Sequence[Column]) -> list[tuple[int, int]]:
    left, right = (_of(columns, role) for role in (Role.REAL, Role.IMAGINARY))
    if len(left) != len(right):
        raise misread(
            table,
            columns,
            f"{table.origin}: columns for real parts: {len(left)}, for imaginary parts:"
            f" {len(right)}",
        )
    return list(zip(left, right, strict=True))


def _gains(columns: Sequence[Column]) -> list[tuple[int, int]]:
    """Gains and phases: as many of one kind as there are phases, linear ones before those in dB;
    else the gain next before each phase.
    """
    phases, gains = _of(columns, Role.PHASE), _of(columns, Role.GAIN)
    gains = gains or _of(columns, Role.SIGNAL)  # of a file that calls its response by an output
    linear = [i for i in gains if level_of(columns[i]) not in LEVELS[2:]]
    for some in (gains, linear, [i for i in gains if i not in linear]):
        if some and len(some) == len(phases):
            return list(zip(some, phases, strict=True))
    before = [(max((i for i in gains if i < phase), default=None), phase) for phase in phases]
    return [(gain, phase) for gain, phase in before if gain is not None]


def level_of(column: Column) -> str:
    """The level of a gain's unit, "1" where it states none."""
    the_gain = gain(column.unit)
    return the_gain.level if the_gain else "1"


def _of(columns: Sequence[Column], role: Role) -> list[int]:
    return [i for i, column in enumerate(columns) if column.role is role]


def stated_quantities(table: Table) -> list[Quantity]:
    """The quantities of which the headers and comments of a table speak."""
    text = " ".join((*table.headers, *table.comments)).lower()
    return [sensor for sensor, words in SENSOR_WORDS.items() if words.search(text)]


def quantity_of(
    table: Table, quantity: Quantity | str | None, unit: str, notes: list[str]
) -> Quantity:
    """The requested quantity, or that of the words or the unit of the output."""
    if quantity is not None:
        return as_quantity(quantity)
    sensors = stated_quantities(table)
    if len(sensors) == 1:
        return sensors[0]
    own = motion(unit)
    if not sensors and own is not None:
        return own.quantity
    notes.append(ASSUMED_ACCELERATION)
    return Quantity.ACCELERATION
