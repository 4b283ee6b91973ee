"""Frequency responses from a table of columns: which column is what."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from disting.errors import InputError, listed, shown
from disting.measurement import checks
from disting.measurement.arrays import Complex, Real
from disting.measurement.column_words import FREQUENCIES, PHASES, Meaning, meaning
from disting.measurement.grid import in_omega
from disting.measurement.repeats import mean_of
from disting.measurement.response import (
    ASSUMED_ACCELERATION,
    FrequencyResponse,
    Signal,
    as_sign,
)
from disting.measurement.table import Table
from disting.measurement.units import ratio
from disting.model.chain import Sensor, as_sensor

SENSOR_WORDS = {
    Sensor.POSITION: re.compile(
        r"\b(position|displacement|receptance|compliance|weg|lage)\b|\brad/(nm|a)\b|\bm/(n|a)\b"
    ),
    Sensor.VELOCITY: re.compile(r"\b(velocity|speed|mobility|geschwindigkeit|drehzahl)\b"),
    Sensor.ACCELERATION: re.compile(
        r"\b(acceleration|accelerance|inertance|beschleunigung)\b|/s(\^|\*\*)?2|/s²"
    ),
}
ESCAPED = re.compile(r"\\u(003d|002b|0040|002d|005c)")  # = + @ - and the backslash itself
# words for what is never negative; a magnitude or gain may well be in dB
LINEAR = re.compile(r"abs|modulus|betrag")
NEGATIVE = 0.1  # share of the lines that must be negative: fewer are damage
MARK = "frequency response, written by disting"


@dataclass(slots=True)
class _Group:
    """Columns of one response, by their roles."""

    columns: dict[Meaning, int] = field(default_factory=dict)

    @property
    def first(self) -> int:
        """The first of its columns."""
        return min(self.columns.values())


def frequency_response(
    table: Table,
    *,
    column: str | int | None = None,
    columns: Sequence[str] | None = None,
    sensor: Sensor | str | None = None,
    sign: int = 1,
    phase_unit: str | None = None,
    frequency_unit: str | None = None,
) -> FrequencyResponse:
    """The first response of a table, or the one that begins at `column` (header, or number from
    1); "all": the mean of all.

    `columns` = the role of every column (values of `Meaning`, "-" for none) instead of the words
    in the headers; `sensor` and `phase_unit` ("deg", "rad"), `frequency_unit` ("Hz", "kHz",
    "rad/s", "rpm") where the file does not say them, or says them wrongly; `sign` = -1 for a
    reversed sensor. Raises InputError where columns are missing; the message lists the headers.
    """
    notes: list[str] = []
    roles = _roles(table, columns, notes)
    at = _frequency_column(table, roles)
    ours = _written(table.comments)
    said = (
        None
        if roles[at] is Meaning.HERTZ and not any("hz" in h.lower() for h in table.headers)
        else roles[at].value
    )
    grid, doubt = in_omega(
        table.column(at), said, (said if ours else None) or frequency_unit, table.named(at)
    )
    notes += [doubt] if doubt else []
    quantity = _quantity(table, sensor or ours.get("sensor"), notes)
    units = ("", "") if ours else ratio((*table.headers, *table.comments)) or ("", "")
    groups = _groups(table, roles)
    chosen = (
        groups
        if column == "all" and "all" not in table.headers
        else [_chosen(table, groups, column)]
    )
    responses = [
        FrequencyResponse(
            grid,
            _complex(table, group, phase_unit, notes, guess=columns is None) * as_sign(sign),
            _beside(table, group, Meaning.DEVIATION),
            _beside(table, group, Meaning.COHERENCE),
            sensor=quantity,
            input=_signal(ours, "input", Signal("", units[1])),
            output=_signal(ours, "output", Signal(table.headers[group.first], units[0])),
            origin=f"{table.origin}, {table.named(group.first)}",
        )
        for group in chosen
    ]
    return mean_of(responses).noted(*notes)


def _written(comments: Sequence[str]) -> dict[str, str]:
    """What `writing.csv_text` wrote into comment lines; empty for a file of another origin."""
    pairs = [comment.split(": ", 1) for comment in comments if ": " in comment]
    plain = {name: ESCAPED.sub(lambda code: chr(int(code[1], 16)), text) for name, text in pairs}
    return plain if MARK in comments else {}


def _signal(ours: Mapping[str, str], role: str, foreign: Signal) -> Signal:
    return Signal(ours.get(f"{role} label", ""), ours.get(f"{role} unit", "")) if ours else foreign


def _beside(table: Table, group: _Group, role: Meaning) -> Real | None:
    return table.column(group.columns[role]) if role in group.columns else None


def _roles(table: Table, columns: Sequence[str] | None, notes: list[str]) -> list[Meaning]:
    if columns is not None:
        return _given(table, columns)
    if any(table.headers):
        roles = [meaning(header) for header in table.headers]
        return roles
    if len(table.headers) != 3:
        raise InputError(
            f"{table.origin} has {len(table.headers)} columns, no header; say what they are, as"
            ' columns=["Hz", "re", "im"]'
        )
    notes.append("no header: columns taken as frequency [Hz], real part, imaginary part")
    return [Meaning.HERTZ, Meaning.REAL, Meaning.IMAGINARY]


def _given(table: Table, columns: Sequence[str]) -> list[Meaning]:
    try:
        roles = [Meaning(word) for word in columns]
    except (ValueError, TypeError) as error:
        raise InputError(f"columns are named by {', '.join(Meaning)}; {error}") from None
    if len(roles) != len(table.headers):
        raise InputError(
            f"{table.origin} has {len(table.headers)} columns, of which {len(roles)} are named"
        )
    return roles


def _frequency_column(table: Table, roles: list[Meaning]) -> int:
    found = [i for i, role in enumerate(roles) if role in FREQUENCIES]
    if not found:
        raise InputError(
            f"{table.origin}: no column is a frequency; give columns=; headers: {table.listed()}"
        )
    return found[0]


def _groups(table: Table, roles: list[Meaning]) -> list[_Group]:
    """Responses in the order of their columns: the n-th real part with the n-th imaginary part,
    and so on.
    """
    pairs = [*_pairs(table, roles, (Meaning.REAL,), (Meaning.IMAGINARY,)), *_sizes(table, roles)]
    if not pairs:
        raise InputError(
            f"{table.origin}: no real and imaginary part, no magnitude and phase; give columns=;"
            f" headers: {table.listed()}"
        )
    groups = sorted(
        (_Group({roles[i]: i for i in pair}) for pair in pairs), key=lambda group: group.first
    )
    for i, role in enumerate(roles):
        if role in (Meaning.COHERENCE, Meaning.DEVIATION):
            owner = next((g for g in reversed(groups) if g.first < i), groups[0])
            if role in owner.columns:
                raise InputError(
                    f"{table.origin}: {role} occurs twice for one response; give columns=; headers:"
                    f" {table.listed()}"
                )
            owner.columns[role] = i
    return groups


def _sizes(table: Table, roles: list[Meaning]) -> list[tuple[int, int]]:
    """Magnitudes and phases; where a file gives every magnitude in dB too, the one that is not."""
    phases = sum(role in PHASES for role in roles)
    firsts = (
        (Meaning.MAGNITUDE,)
        if phases == roles.count(Meaning.MAGNITUDE)
        else (Meaning.MAGNITUDE, Meaning.DECIBEL)
    )
    return _pairs(table, roles, firsts, PHASES) if phases else []


def _pairs(
    table: Table, roles: list[Meaning], first: tuple[Meaning, ...], second: tuple[Meaning, ...]
) -> list[tuple[int, int]]:
    left, right = ([i for i, role in enumerate(roles) if role in kind] for kind in (first, second))
    if len(left) != len(right):
        raise InputError(
            f"{table.origin}: columns for {' or '.join(first)}: {len(left)}, for"
            f" {' or '.join(second)}: {len(right)}; give columns=; headers: {table.listed()}"
        )
    return list(zip(left, right, strict=True))


def _chosen(table: Table, groups: list[_Group], column: str | int | None) -> _Group:
    if column is None:
        return groups[0]
    at = table.at(column)
    found = next((g for g in groups if at in g.columns.values()), None)
    if found is None:
        firsts = listed(table.named(g.first) for g in groups)
        raise InputError(
            f"{table.origin}: column {shown(column)} belongs to no response; responses begin at"
            f" {firsts}"
        )
    return found


def _complex(
    table: Table, group: _Group, phase_unit: str | None, notes: list[str], *, guess: bool
) -> Complex:
    columns = group.columns
    if Meaning.REAL in columns:
        return np.asarray(
            table.column(columns[Meaning.REAL]) + 1j * table.column(columns[Meaning.IMAGINARY])
        )
    role = next(p for p in PHASES if p in columns)
    phase = table.column(columns[role])
    unit = _phase_unit(phase, role, phase_unit, notes)
    size = _size(table, columns, notes, guess=guess and unit == "deg")
    return np.asarray(size * np.exp(1j * (np.deg2rad(phase) if unit == "deg" else phase)))


def _size(table: Table, columns: Mapping[Meaning, int], notes: list[str], *, guess: bool) -> Real:
    """Magnitudes; where a column of them has negative numbers, and may be guessed about, they
    are dB.
    """
    if Meaning.DECIBEL in columns:
        at, decibel = columns[Meaning.DECIBEL], True
    else:
        at = columns[Meaning.MAGNITUDE]
        negative = (
            np.mean(table.column(at) < 0) >= NEGATIVE
            and LINEAR.search(table.headers[at].lower()) is None
        )
        decibel = bool(guess and negative)
        notes += [
            f"{table.named(at)} has negative magnitudes, with phases in degrees: taken as dB"
        ] * decibel
    size = table.column(at)
    if np.any(size < 0) and not decibel:
        raise InputError(f"{table.origin}: a magnitude is negative; is the column in dB?")
    with np.errstate(over="ignore"):
        return np.asarray(10.0 ** (size / 20) if decibel else size)


def _phase_unit(phase: Real, role: Meaning, asked: str | None, notes: list[str]) -> str:
    """The unit that the caller named, or the header, or the more likely one; what is doubtful
    goes to `notes`.
    """
    if asked is not None:
        if asked not in ("deg", "rad"):
            raise InputError(f'phase_unit is "deg" or "rad", not {shown(asked)}')
        return asked
    unit = checks.likely_phase_unit(phase) if role is Meaning.PHASE else role.value
    doubt = checks.phase_unit(phase, unit, said=role is not Meaning.PHASE)
    if role is Meaning.PHASE:
        notes.append(
            f"phases taken as {unit}, by their size; if not, give"
            f' phase_unit="{"deg" if unit == "rad" else "rad"}"'
        )
    notes += [doubt] if doubt else []
    return unit


def _quantity(table: Table, sensor: Sensor | str | None, notes: list[str]) -> Sensor:
    if sensor is not None:
        return as_sensor(sensor)
    text = " ".join((*table.headers, *table.comments)).lower()
    found = [quantity for quantity, words in SENSOR_WORDS.items() if words.search(text)]
    if len(found) == 1:
        return found[0]
    notes.append(ASSUMED_ACCELERATION)
    return Sensor.ACCELERATION
