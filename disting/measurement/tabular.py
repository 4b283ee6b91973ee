"""Frequency responses from a table of columns: the numbers in SI units, and what was assumed."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from disting.errors import InputError, enumeration, short
from disting.measurement import checks
from disting.measurement.arrays import Complex, Real
from disting.measurement.column_words import (
    NAME,
    Column,
    Role,
    Why,
    is_called_impedance,
    meaning,
)
from disting.measurement.columns import (
    BESIDE,
    Group,
    choose,
    columns_of,
    frequency_column,
    groups,
    level_of,
    quantity_of,
    stated_quantities,
)
from disting.measurement.repeats import mean_of
from disting.measurement.response import (
    ASSUMED_IMPEDANCE,
    OF_IMPEDANCE,
    VOLTAGE,
    FrequencyResponse,
    Signal,
    as_sign,
)
from disting.measurement.scaling import in_omega, taken_unit
from disting.measurement.table import Table
from disting.measurement.understanding import Use, record_columns, sentence
from disting.measurement.units import (
    AMPERE,
    FREQUENCIES,
    LEVELS,
    OHM,
    PHASES,
    VOLT,
    gain,
    in_ohm,
    known_unit,
    motion,
    ratio,
)
from disting.model.chain import Quantity

ESCAPED = re.compile(r"\\u(003d|002b|0040|002d|005c)")  # = + @ - and the backslash itself
# words for what is never negative; a magnitude or gain may well be in dB
LINEAR = re.compile(r"abs|modulus|betrag")
ASSUMED_LINEAR = "says no unit: taken as linear"  # of a gain, in a note
NEGATIVE = 0.1  # share of the lines that must be negative: fewer are damage
# a linear gain above it on all lines, of one order of magnitude, may be one in dB without a sign
HIGH, NARROW = 40.0, 10.0
NO_GAIN = (Role.PHASE, *BESIDE)
LINEAR_OF = {"1": 1.0, "%": 0.01}
MINUS = re.compile(r"\s*[-−]\s*[A-Za-z]")
TRANSPOSED = "the table has a line for each quantity: it is read by its columns"
MARK = "frequency response, written by disting"


def frequency_response(
    table: Table,
    *,
    column: str | int | None = None,
    columns: Sequence[str] | None = None,
    quantity: Quantity | str | None = None,
    sign: int = 1,
    phase_unit: str | None = None,
    frequency_unit: str | None = None,
    magnitude_unit: str | None = None,
    outliers: str = "keep",
) -> FrequencyResponse:
    """The first response of a table, or that of `column` (header, or number from 1); "all": the
    mean of all.

    `columns` = what every column is ("re", "im", "magnitude", "phase", "coherence", "std", "-" for
    none, or a unit of frequency, gain or phase) instead of its header; `quantity`, `phase_unit`
    ("deg", "rad", "gon", ..), `frequency_unit` ("Hz", "rad/s", ..), `magnitude_unit` ("dB", "%",
    "Np", "1") where the file does not state them, or states them wrongly; `sign` = -1 for a
    reversed sensor; `outliers` as in `mean_of`. Raises InputError where columns are missing, with
    the table's first rows as `detail`, and for a stated unit that is not known.
    """
    notes, doubts = [TRANSPOSED] * table.transposed, list[str]()
    roles = columns_of(table, columns, notes)
    at = frequency_column(table, roles)
    ours = _read_own_fields(table.comments)
    grid = _grid(table, at, roles[at], roles[at].unit if ours else frequency_unit, notes, doubts)
    the_groups = groups(table, roles)
    whole = column == "all" and "all" not in table.headers
    used = the_groups if whole else [choose(table, roles, the_groups, column)]
    units = _units(table, roles, used[0], ours)
    impedance = _is_impedance(table, used[0], quantity, magnitude_unit, ours, notes)
    own = Quantity.POSITION if impedance else ours.get("quantity")
    shown = quantity_of(table, own if impedance else quantity or own, units[0], notes)
    units = (VOLT, AMPERE) if impedance and not ours else units
    reading = _Reading(table, roles, phase_unit, magnitude_unit, columns is None, notes, doubts)
    responses = [
        FrequencyResponse(
            grid,
            reading.numbers(group) * as_sign(sign),
            reading.beside(group, Role.DEVIATION),
            reading.beside(group, Role.COHERENCE),
            quantity=shown,
            input=_signal(ours, "input", Signal("", units[1])),
            output=_signal(ours, "output", Signal(table.headers[group.first], units[0])),
            origin=f"{table.origin}, {table.named(group.first)}",
            is_impedance=impedance,
        )
        for group in used
    ]
    unit = taken_unit(grid, table.column(at), roles[at].unit)
    is_given = frequency_unit is not None and not ours
    uses = reading.uses | {at: Use(Role.FREQUENCY, unit, _why_unit(roles[at], unit, is_given))}
    read = record_columns(table.headers, table.values, roles, uses)
    response = mean_of(responses, outliers=outliers).noted(*notes).doubted(*doubts)
    return response.read_as(sentence(read), read)


def response_columns(table: Table, columns: Sequence[str] | None = None) -> tuple[int, ...]:
    """Columns, from 1, at which the responses of a table begin; `columns` = what they are. Raises
    InputError.
    """
    return tuple(group.first + 1 for group in groups(table, columns_of(table, columns, [])))


@dataclass(slots=True)
class _Reading:
    """Conversion of numbers to a response; assumptions are added to `notes`, suspicious findings to
    `doubts`, the used columns to `uses`. `guess`: only the headers state what the columns are.
    """

    table: Table
    roles: Sequence[Column]
    phase_unit: str | None
    magnitude_unit: str | None
    guess: bool
    notes: list[str]
    doubts: list[str]
    uses: dict[int, Use] = field(default_factory=dict)

    def numbers(self, group: Group) -> Complex:
        """The response of a group of columns."""
        columns = group.columns
        if Role.REAL in columns:
            real, imaginary = columns[Role.REAL], columns[Role.IMAGINARY]
            scale = (
                self._scale(real) * self._ohms(real),
                self._scale(imaginary) * self._ohms(imaginary),
            )
            origin = Why.OPTION if self.magnitude_unit else Why.NOTHING
            for part, role in ((real, Role.REAL), (imaginary, Role.IMAGINARY)):
                self.uses[part] = Use(role, self.magnitude_unit or "", origin)
            return np.asarray(
                self._read_signed(real) * scale[0] + 1j * self._read_signed(imaginary) * scale[1]
            )
        at = columns[Role.PHASE]
        unit = self._phase_unit(at)
        size, level = self._size(columns[Role.GAIN], guess=self.guess and unit == "deg")
        size = size * self._ohms(columns[Role.GAIN])
        self.uses[columns[Role.GAIN]] = self._gain_use(columns[Role.GAIN], level)
        why = _why_unit(self.roles[at], unit, self.phase_unit is not None)
        self.uses[at] = Use(Role.PHASE, unit, why)
        return np.asarray(size * np.exp(1j * PHASES[unit] * self._read_signed(at)))

    def _gain_use(self, at: int, level: str) -> Use:
        """Use of a column of gains: as its header states, else at the level that was taken."""
        if self.magnitude_unit is not None:
            return Use(Role.GAIN, level, Why.OPTION)
        if self.roles[at].unit:
            return Use(Role.GAIN)
        if level != "1":
            return Use(Role.GAIN, level, Why.BY_NUMBERS)
        is_said = LINEAR.search(self.table.headers[at].lower()) is not None
        return Use(Role.GAIN, level, Why.WORD if is_said else Why.ASSUMED)

    def _read_signed(self, at: int) -> Real:
        """The numbers of a column, reversed where its header has a minus before its name."""
        if not MINUS.match(self.table.headers[at]):
            return self.table.column(at)
        self.notes.append(
            f"{self.table.named(at)}: read with the sign reversed, as its header says"
        )
        return np.asarray(-self.table.column(at))

    def beside(self, group: Group, role: Role) -> Real | None:
        """A column of deviations or coherences, None where there is none."""
        if role not in group.columns:
            return None
        at = group.columns[role]
        self._check_unit(at)
        if role is Role.DEVIATION and level_of(self.roles[at]) in LEVELS[2:]:
            self.doubts.append(f"{self.table.named(at)} is in dB or Np and is not used")
            return None
        self.uses[at] = Use(role)
        return self.table.column(at) * (0.01 if level_of(self.roles[at]) == "%" else 1.0)

    def _ohms(self, at: int) -> float:
        """Factor from a column's unit to ohm, where it is a unit of impedance; else 1."""
        stated = self.magnitude_unit or _unit_in(self.table.headers[at])
        unit = gain(str(stated))
        return unit.ohms if unit and unit.ohms else 1.0

    def _check_unit(self, at: int) -> None:
        """Raise InputError where the unit that a column states is not known."""
        unknown, header = self.roles[at].unknown, self.table.headers[at]
        if unknown and header.rstrip().endswith(")") and NAME.fullmatch(unknown):
            self.notes.append(f"{self.table.named(at)}: ({unknown}) is taken as part of its name")
        elif unknown:
            phase = self.roles[at].role is Role.PHASE
            units = (
                enumeration(PHASES)
                if phase
                else f"{', '.join(LEVELS)}, rad/s^2/A, mm/s/N, ohm and the like"
            )
            remedy = "phase=deg" if phase else "magnitude=1, which takes the numbers as they are"
            raise InputError(
                f"{self.table.origin}, {self.table.named(at)}: the unit {short(unknown)} is not"
                f" known; known units: {units}; else give --unit {remedy}"
            )

    def _scale(self, at: int) -> float:
        """Factor of a real or imaginary part."""
        level = self._level(at)
        if level in LEVELS[2:]:
            raise InputError(
                f"{self.table.origin}, {self.table.named(at)}: a real or imaginary part is not in"
                f" {level}"
            )
        return 0.01 if level == "%" else 1.0

    def _level(self, at: int) -> str:
        """The level that is requested or stated."""
        if self.magnitude_unit is None:
            self._check_unit(at)
            return level_of(self.roles[at])
        if in_ohm(str(self.magnitude_unit)):
            return "1"
        level = known_unit(str(self.magnitude_unit), LEVELS)
        if level is None:
            raise InputError(
                f"the unit of a magnitude is {', '.join(LEVELS)} or ohm, not"
                f" {short(self.magnitude_unit)}"
            )
        return level

    def _size(self, at: int, *, guess: bool) -> tuple[Real, str]:
        """Gains and their level; where a column without a stated level has negative numbers, they
        are dB.
        """
        size, level = self.table.column(at), self._level(at)
        holds = self.magnitude_unit is not None or self.roles[at].unit != ""
        if level == "1" and not holds:
            level = self._likely_level(size, at, guess)
        if np.any(size < 0) and level in LEVELS[:2]:
            raise InputError(
                f"{self.table.origin}: a magnitude is negative; is the column in dB? then give"
                " --unit magnitude=dB"
            )
        with np.errstate(over="ignore"):
            if level == "dB":
                return np.asarray(10.0 ** (size / 20)), level
            return np.asarray(np.exp(size) if level == "Np" else size * LINEAR_OF[level]), level

    def _likely_level(self, size: Real, at: int, guess: bool) -> str:
        """Of a gain without a unit."""
        name, linear = self.table.named(at), LINEAR.search(self.table.headers[at].lower())
        if guess and linear is None and np.mean(size < 0) >= NEGATIVE:
            self.notes.append(
                f"{name} has negative magnitudes, with phases in degrees: taken as dB"
            )
            return "dB"
        note = f"{name} {ASSUMED_LINEAR}; if dB, give --unit magnitude=dB"
        high = bool(np.all(size > HIGH) and np.ptp(size) < NARROW * HIGH)
        if linear is None and not np.any(size < 0):
            (self.doubts if guess and high else self.notes).append(note)
        return "1"

    def _phase_unit(self, at: int) -> str:
        """The unit that the caller named, or the header, or the more likely one."""
        column, phase = self.roles[at], self.table.column(at)
        if self.phase_unit is not None:
            given = known_unit(str(self.phase_unit), PHASES)
            if given is None:
                raise InputError(
                    f"{short(self.phase_unit)} is not a known unit of phase; known units:"
                    f" {enumeration(PHASES)}: give --unit phase=deg"
                )
            return given
        self._check_unit(at)
        unit = column.unit or checks.likely_phase_unit(phase)
        doubt = checks.phase_unit(phase, unit, said=bool(column.unit))
        if not column.unit:
            other = "deg" if unit == "rad" else "rad"
            self.notes.append(
                f"phases taken as {unit}, by their size; if not, give --unit phase={other}"
            )
        self.doubts += [doubt] if doubt else []
        return unit


def _grid(
    table: Table,
    at: int,
    column: Column,
    asked: str | None,
    notes: list[str],
    doubts: list[str],
) -> Real:
    """Frequencies [rad/s]; assumptions, and contradictions to the numbers, are reported."""
    if column.unknown and asked is None:
        raise InputError(
            f"{table.origin}, {table.named(at)}: {short(column.unknown)} is not a known unit of"
            f" frequency; known units: {enumeration(FREQUENCIES)}: give --unit frequency=Hz"
        )
    grid, note = in_omega(table.column(at), column.unit or None, asked, table.named(at))
    (doubts if column.unit else notes).extend([note] if note else [])
    return grid


def _why_unit(column: Column, taken: str, asked: bool) -> Why:
    """Reason for the unit `taken` of frequencies or phases."""
    if asked:
        return Why.OPTION
    if column.unit == taken:
        return Why.OPTION if column.why is Why.OPTION else Why.UNIT
    return Why.ASSUMED if taken == "Hz" and not column.unit else Why.BY_NUMBERS


def _units(
    table: Table, roles: Sequence[Column], group: Group, ours: Mapping[str, str]
) -> tuple[str, str]:
    """Units of output and input of a response, "" where they are not stated."""
    if ours:
        return "", ""
    own = gain(roles[group.columns.get(Role.GAIN, group.first)].unit)
    if own is not None and own.output:
        return own.output, own.input
    return ratio((*table.headers, *table.comments)) or ("", "")


def _is_impedance(
    table: Table,
    group: Group,
    quantity: Quantity | str | None,
    magnitude_unit: str | None,
    ours: Mapping[str, str],
    notes: list[str],
) -> bool:
    """Return True for an impedance. A unit that is called ohm is an impedance in any case; V/A and
    a name such as Re(Z) do unless caller or file states that this is a motion, such as the speed
    that a tachometer shows in V.
    """
    if ours:  # files of earlier versions call the sensor of an impedance a position
        is_voltage = (ours.get("output label"), ours.get("output unit")) == tuple(VOLTAGE)
        return ours.get("quantity") == OF_IMPEDANCE or is_voltage
    headers = [table.headers[at] for role, at in group.columns.items() if role not in NO_GAIN]
    units = {text: gain(text) for text in (str(magnitude_unit or ""), *map(_unit_in, headers))}
    if any(unit.ohms and OHM.search(text) for text, unit in units.items() if unit):
        return True
    moves = any(motion(unit.output) for unit in units.values() if unit)
    if quantity is not None or moves or stated_quantities(table):
        return False
    is_ratio = any(unit.ohms for unit in units.values() if unit)
    is_named = any(map(is_called_impedance, headers))
    notes += [ASSUMED_IMPEDANCE] * (is_ratio or is_named)
    return is_ratio or is_named


def _unit_in(header: str) -> str:
    """The unit in a header, "" without one that is known."""
    return meaning(header).unit


def _read_own_fields(comments: Sequence[str]) -> dict[str, str]:
    """Fields that `files.csv_text` wrote into comment lines; empty for a file of another origin."""
    pairs = [comment.split(": ", 1) for comment in comments if ": " in comment]
    plain = {name: ESCAPED.sub(lambda code: chr(int(code[1], 16)), text) for name, text in pairs}
    if "sensor" in plain:  # its name in files of version 0.3
        plain = {"quantity": plain["sensor"]} | plain
    return plain if MARK in comments else {}


def _signal(ours: Mapping[str, str], role: str, foreign: Signal) -> Signal:
    return Signal(ours.get(f"{role} label", ""), ours.get(f"{role} unit", "")) if ours else foreign
