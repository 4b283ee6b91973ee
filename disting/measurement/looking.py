"""Show a measured file as it is read, before anything is fitted to it.

What a fit refuses for its content can still be shown: the columns as far as they are understood,
and the reason of the refusal among the doubts.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, Unpack, cast

import numpy as np

from disting.errors import InputError, printable
from disting.files import Format
from disting.measurement.assumptions import (
    OF_RESPONSE,
    Assumption,
    assumed_open_loop,
    assumed_quantity,
    assumptions,
    shows_impedance,
)
from disting.measurement.column_words import Role, Why
from disting.measurement.distortion import shares
from disting.measurement.excitation import InputBand, excitation
from disting.measurement.files import open_record, read_response
from disting.measurement.formats import Options, UnknownOption, format_of
from disting.measurement.impedance import as_impedance
from disting.measurement.linearity import describe_nonlinearity
from disting.measurement.look_text import look_lines
from disting.measurement.options import LookOptions
from disting.measurement.repeats import mean_of
from disting.measurement.response import FrequencyResponse
from disting.measurement.scaling import in_units, reader_units
from disting.measurement.source import Source, source
from disting.measurement.tabular import ASSUMED_LINEAR
from disting.measurement.time_series import TimeSeries
from disting.measurement.understanding import ReadColumn, with_unit
from disting.measurement.units import drive
from disting.model.chain import Quantity
from disting.model.presentation import NotebookTable
from disting.renamed import renamed

INPUTS = {"Nm": "torque", "N": "force", "A": "current", "V": "voltage"}
IMPEDANCE = (
    "this is an impedance, not the motion of a drive: fit circuits to it, such as disting fit"
    " FILE --models circuits-4"
)
# marks of notes that the list of assumptions or the facts of a record state as well
REPEATED = (
    "; if not, give --", ASSUMED_LINEAR, "no header: columns taken as", "frequencies of ",
    "Welch's method: ", "lines without excitation show",
)  # fmt: skip
Change = Callable[[FrequencyResponse], FrequencyResponse]


@dataclass(frozen=True, slots=True, eq=False)
class LineScatter:
    """Median over the lines of rho = sigma / (|G| sqrt 2), 0.01 for 1 % in amplitude and 0.01 rad
    in phase, and the source that it is known from.
    """

    median: float
    source: str


@dataclass(frozen=True, slots=True, eq=False)
class Look(NotebookTable):
    """A measured file as it was read.

    `columns` as they are understood; `response`, None where it was refused; `record` and
    `excitation` of a file of time series, else None; `scatter` of the lines; `refusals`: sentences
    on what a fit would refuse, each with its remedy.

    >>> column = ReadColumn("f", 1, Role.FREQUENCY, "Hz", Why.WORD, Why.ASSUMED, values=(1.0, 2.0))
    >>> print(Look("a.csv", (column,), refusals=("a.csv: no column is a gain",)))
    a.csv
    #  name  unit  role       begins with  why
    1  f     Hz    frequency  1, 2         header word; unit assumed
    <BLANKLINE>
    assumed: frequency in Hz; if not, give --unit frequency=rad/s
    doubt: a.csv: no column is a gain
    """

    file: str
    columns: tuple[ReadColumn, ...]
    response: FrequencyResponse | None = None
    record: TimeSeries | None = None
    excitation: InputBand | None = None
    scatter: LineScatter | None = None
    refusals: tuple[str, ...] = field(default=())

    def __repr__(self) -> str:
        return "\n".join(look_lines(self))

    @property
    def is_impedance(self) -> bool:
        """Return True if the response is a voltage per current."""
        return shows_impedance(self.columns, self.response)

    @property
    def quantity(self) -> Quantity | None:
        """Quantity that the response shows, None where it is an impedance or is unknown."""
        known = self.response or self.record
        return None if known is None or self.is_impedance else known.quantity

    @property
    def assumed(self) -> tuple[Assumption, ...]:
        """Assumptions where neither the file nor an option states a value."""
        quantity = None
        if self.response is not None and not self.is_impedance:
            quantity = assumed_quantity(self.response)
        return (*assumptions(self.columns, quantity), *self._assumed_of_loop())

    def _assumed_of_loop(self) -> Iterator[Assumption]:
        if self.response is None or self.record is None or self.record.reference is not None:
            return
        assumption = assumed_open_loop(self.response)
        if assumption is not None:
            yield assumption

    @property
    def trends(self) -> tuple[str, ...]:
        """Sentences on trends that were removed from a record."""
        method = self.response.method if self.response is not None else None
        return method.trends if method else ()

    @property
    def notes(self) -> tuple[str, ...]:
        """Sentences on what was changed while reading, but for trends and assumptions."""
        notes = self.response.notes if self.response is not None else ()
        return tuple(note for note in notes if note not in self.trends and not _assumes(note))

    @property
    def doubts(self) -> tuple[str, ...]:
        """Sentences on what a fit refuses and on what looks wrong, each with its remedy."""
        if self.response is None:
            return self.refusals
        own = self.response.doubts if self.is_impedance else self.response.suspicions
        distorted = describe_nonlinearity(self.response)
        return (*self.refusals, *([distorted] if distorted else []), *own)

    @property
    def distortion(self) -> dict[str, float]:
        """Median distortion by its kind, and noise, as shares of |G|; empty where none was
        measured.
        """
        between = self.response.distortion if self.response is not None else None
        if self.response is None or between is None:
            return {}
        size = np.interp(between.omega, self.response.omega, np.abs(self.response.G))
        return shares(between, size)

    def quantity_of(self, column: ReadColumn) -> str:
        """Quantity that a column shows, "" where it has none or none is known."""
        if not column.is_used:
            return ""
        if column.role is Role.OUTPUT:
            return self.record.quantity.value if self.record is not None else ""
        if column.role is Role.INPUT:
            unit = drive(column.unit)
            return INPUTS.get(unit[0], "") if unit else ""
        if column.role not in OF_RESPONSE:
            return ""
        return "impedance" if self.is_impedance else (self.quantity or "")

    def reason(self, column: ReadColumn) -> str:
        """Reason for the role of a column, and for its unit and quantity where these are not
        stated in the file.
        """
        unit = f"unit {column.unit_why}" if column.unit_why.is_assumed else ""
        if column.unit_why is Why.OPTION and column.why is not Why.OPTION:
            unit = "unit by option"
        shows = column.role in (*OF_RESPONSE, Role.OUTPUT) and column.is_used
        shown = self.response
        is_assumed = shown is not None and assumed_quantity(shown) and not self.is_impedance
        quantity = "quantity assumed" if shows and is_assumed else ""
        return "; ".join(filter(None, (column.why.value, unit, quantity)))

    def to_dict(self) -> dict[str, Any]:
        """Return the same as plain data, as `disting look --json` writes it."""
        response, excited = self.response, self.excitation
        return {
            "format": Format.LOOK.value,
            "file": self.file,
            "origin": response.origin if response is not None else self.file,
            "columns": [self._column(column) for column in self.columns],
            "quantity": self.quantity and self.quantity.value,
            "impedance": self.is_impedance,
            "assumed": [{"what": a.what, "option": a.option} for a in self.assumed],
            "record": None if self.record is None else _record(self.record, response),
            "excitation": excited
            and {
                "kind": excited.kind.value,
                "lines": excited.lines,
                "band": [excited.low, excited.high],
                "period": excited.period,
            },
            "lines": None
            if response is None
            else {
                "count": len(response),
                "band": [float(response.frequency[0]), float(response.frequency[-1])],
            },
            "scatter": self.scatter
            and {"median": self.scatter.median, "source": self.scatter.source},
            "distortion": self.distortion,
            "loop": response.loop_sentence if response is not None else "",
            "trends": list(self.trends),
            "notes": list(self.notes),
            "doubts": list(self.doubts),
            "refused": bool(self.refusals),
        }

    def _column(self, column: ReadColumn) -> dict[str, Any]:
        return {
            "name": column.name,
            "number": column.number or None,
            "role": column.role.value,
            "used": column.is_used,
            "unit": column.unit,
            "quantity": self.quantity_of(column),
            "why": self.reason(column),
            "first": [value if np.isfinite(value) else None for value in column.values],
        }


@renamed(sensor="quantity")
def look(
    path: str | Path,
    *,
    repeat: Sequence[str | Path] = (),
    outliers: str = "keep",
    unit: Mapping[str, str] | None = None,
    scale: float | None = None,
    torque_constant: float | None = None,
    changes: Sequence[Change] = (),
    **options: Unpack[LookOptions],
) -> Look:
    """Return a measured file as it is read, with what is assumed and what is in doubt.

    `repeat`, `unit`, `scale`, `torque_constant` and `options` as for `read`, `outliers` as in
    `mean_of`; `changes`: applied then to the response one after the other, such as a band. What a
    fit refuses is shown as far as it is understood, the reason among the doubts. Raises InputError
    for a file that is absent or cannot be parsed, and for an unknown option.

    >>> from tempfile import TemporaryDirectory
    >>> rows = ["f [Hz],Re,Im", *(f"{f},1,{f}" for f in range(1, 20))]
    >>> with TemporaryDirectory() as folder:
    ...     file = Path(folder, "frf.csv")
    ...     _ = file.write_text("\\n".join(rows))
    ...     seen = look(file)
    >>> [(column.role.value, column.unit) for column in seen.columns]
    [('frequency', 'Hz'), ('real part', ''), ('imaginary part', '')]
    >>> str(seen.assumed[0])
    'quantity acceleration; if not, give --quantity position or --quantity velocity'
    """
    file, refusals = source(path), list[str]()
    named = cast("Options", options) | reader_units(unit or {})
    named |= {"outliers": outliers} if outliers != "keep" and not repeat else {}
    record, response = _attempt(file, named, refusals)
    if response is not None and repeat:
        response = _mean([response, *_others(repeat, named, refusals)], outliers, refusals)
    columns = response.columns if response is not None else _columns(file, named, record)
    if response is not None and shows_impedance(columns, response):
        refusals.append(IMPEDANCE)
        response = as_impedance(response)
    if response is not None:
        if any(x is not None for x in (unit, scale, torque_constant)):
            changes = [lambda own: in_units(own, unit or {}, scale, torque_constant), *changes]
        response = _apply_changes(response, changes, refusals)
    looked = Look(file.name, columns, response, record, refusals=tuple(refusals))
    return name_units(_with_statistics(looked, named, bool(repeat)), unit or {})


def look_at(
    record: TimeSeries, quantity: Quantity | None = None, changes: Sequence[Change] = ()
) -> Look:
    """Return a record that is in no file as it is understood; `sensor`: the quantity of its
    response (default: as recorded); `changes` as of `look`.

    >>> from disting.simulation import demo
    >>> look_at(demo(), Quantity.ACCELERATION).response.quantity.value
    'acceleration'
    """
    refusals, response = list[str](), None
    try:
        response = _apply_changes(record.response(quantity), changes, refusals)
    except InputError as reason:
        refusals.append(str(reason))
    file = record.origin or "record"
    looked = Look(file, record.columns, response, record, refusals=tuple(refusals))
    return _with_statistics(looked, {}, is_mean=False)


def name_units(seen: Look, units: Mapping[str, str]) -> Look:
    """Return the same with units of input and output that the caller gives."""
    columns = seen.columns
    for name, role in (("input", Role.INPUT), ("output", Role.OUTPUT)):
        columns = with_unit(columns, role, units[name]) if name in units else columns
    return replace(seen, columns=columns)


def _attempt(
    file: Source, options: Options, refusals: list[str]
) -> tuple[TimeSeries | None, FrequencyResponse | None]:
    """Record and response of a file, None each where reading refuses it."""
    record = None
    try:
        opened = open_record(file, options)
        if opened is None:
            return None, read_response(file, options)
        record, respond = opened
        return record, respond()
    except UnknownOption:
        raise
    except InputError as reason:
        refusals.append(str(reason))
        return record, None


def _others(
    paths: Sequence[str | Path], options: Options, refusals: list[str]
) -> Iterator[FrequencyResponse]:
    for path in paths:
        response = _attempt(source(path), options, refusals)[1]
        if response is not None:
            yield response


def _mean(
    responses: list[FrequencyResponse], outliers: str, refusals: list[str]
) -> FrequencyResponse:
    try:
        return mean_of(responses, outliers=outliers)
    except InputError as reason:
        refusals.append(str(reason))
        return responses[0]


def _apply_changes(
    response: FrequencyResponse, changes: Sequence[Change], refusals: list[str]
) -> FrequencyResponse:
    """The response after all changes but those that are refused."""
    for change in changes:
        try:
            response = change(response)
        except InputError as reason:
            refusals.append(str(reason))
    return response


def _columns(file: Source, options: Options, record: TimeSeries | None) -> tuple[ReadColumn, ...]:
    """Columns of a file whose response is refused; raises InputError where it cannot be parsed."""
    if record is not None:
        return record.columns
    columns = format_of(file).columns
    if columns is not None:
        return columns(file, options)
    read_response(file, options)  # raises: nothing of it can be shown
    return ()


def _with_statistics(seen: Look, options: Options, is_mean: bool) -> Look:
    """The same with excitation and scatter."""
    record, response, excited = seen.record, seen.response, None
    if record is not None:
        moved = record.u if record.reference is None else record.reference
        method = response.method if response is not None else None
        period = (method.period if method else 0) or options.get("period")
        excited = excitation(moved, record.sampling_rate, period)
    seen = replace(seen, excitation=excited)
    if response is None:
        return seen
    try:
        median, known_from = seen._presenter.scatter(response)
    except InputError as reason:
        return replace(seen, refusals=(*seen.refusals, str(reason)))
    words = _source(response, known_from, is_mean or options.get("column") == "all")
    return replace(seen, scatter=LineScatter(median, words))


def _source(response: FrequencyResponse, known_from: str, is_mean: bool) -> str:
    """Source of the scatter, with where the standard deviations of the data come from."""
    if response.deviation is None:
        return known_from
    method = response.method
    if is_mean:
        origin = "repeats"
    elif method is not None:
        origin = f"{method.segments} segments" if method.segment else f"{method.periods} periods"
    else:
        origin = "a column of the file"
    return f"{known_from} ({origin})"


def _assumes(note: str) -> bool:
    """Return True for a note that the list of assumptions repeats."""
    return any(mark in note for mark in REPEATED)


def _record(record: TimeSeries, response: FrequencyResponse | None) -> dict[str, Any]:
    method = response.method if response is not None else None
    return {
        "sampling_rate": record.sampling_rate,
        "samples": len(record),
        "seconds": len(record) / record.sampling_rate,
        "input": printable(str(record.input)),
        "output": printable(str(record.output)),
        "reference": record.reference is not None,
        "period": method.period if method else 0,
        "periods": method.periods if method else 0,
        "dropped": method.dropped if method else 0,
        "segment": method.segment if method else 0,
        "segments": method.segments if method else 0,
    }
