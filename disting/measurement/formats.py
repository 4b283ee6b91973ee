"""The formats of files with measured data: how each is known, and who reads it.

A new format is a row of `FORMATS`; a file is of the first one that it fits. Readers of binary files
are imported when such a file is read.
"""

import inspect
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeVar

from disting.errors import InputError, enumeration
from disting.measurement.codesys import read_codesys_trace
from disting.measurement.column_words import Column, Role, matching, meaning
from disting.measurement.columns import columns_of
from disting.measurement.exports import read_export
from disting.measurement.impedance import is_impedance, read_impedance
from disting.measurement.response import FrequencyResponse
from disting.measurement.sinumerik import read_trace
from disting.measurement.source import Source
from disting.measurement.table import Table, is_time, signal_columns, time_series
from disting.measurement.tabular import frequency_response, response_columns
from disting.measurement.text_table import decode, table
from disting.measurement.time_series import TimeSeries
from disting.measurement.understanding import (
    ReadColumn,
    Use,
    record_columns,
    record_variables,
)
from disting.measurement.variables import (
    HERTZ_NAMES,
    OMEGA_NAMES,
    RATE_NAMES,
    RESPONSE_NAMES,
    STEP_NAMES,
    TIME_NAMES,
    from_variables,
    holds_frequencies,
    holds_response,
    series_from_variables,
    split_index,
)

T = TypeVar("T")
Options = dict[str, Any]
NAMED = {"frequency", "response"}  # options that only a frequency response of a MATLAB file has
CLOCKS = {*RATE_NAMES, *STEP_NAMES, *TIME_NAMES}
NAMES_OF_SIGNALS = {
    "time": Role.CLOCK,
    "input": Role.INPUT,
    "output": Role.OUTPUT,
    "reference": Role.REFERENCE,
}
USUAL = {
    Role.FREQUENCY: (*HERTZ_NAMES, *OMEGA_NAMES),
    Role.RESPONSE: RESPONSE_NAMES,
    Role.CLOCK: (*RATE_NAMES, *STEP_NAMES, *TIME_NAMES),
}
HEAD = 520  # bytes; what a MATLAB file of version 7.3 is known by stands behind 512


class UnknownOption(InputError):
    """An option that the reader of a format does not have."""


@dataclass(frozen=True, slots=True)
class Records:
    """Time series of a format: `read` those of an input and an output; `names` of the signals of
    a file; `held` = whether a file, with these options, is a record rather than a response.
    """

    read: Callable[[Source, str | int, str | int, Options], TimeSeries]
    names: Callable[[Source], Iterable[str]]
    held: Callable[[Source, Options], bool]


@dataclass(frozen=True, slots=True)
class Format:
    """One format: `fits` = whether a file is of it, by its name and first bytes; `response` reads
    a frequency response; `records` = None where no time series are read; `begin`: columns (from 1)
    at which the responses begin, of a format that has some; `columns`: those of a file whose
    response is refused, as far as they are understood.

    Readers raise InputError for what they cannot read, and for options that they do not know.
    """

    name: str
    fits: Callable[[Source, bytes], bool]
    response: Callable[[Source, Options], FrequencyResponse]
    records: Records | None = None
    begin: Callable[[Source, Sequence[str] | None], tuple[int, ...]] | None = None
    columns: Callable[[Source, Options], tuple[ReadColumn, ...]] | None = None


def format_of(file: Source) -> Format:
    """The format of a file: that of the content, where the content shows it, else of the ending."""
    head = file.content[:HEAD]
    return next(file_format for file_format in FORMATS if file_format.fits(file, head))


def _is_matlab(file: Source, head: bytes) -> bool:
    return (
        file.suffix == ".mat"
        or head.startswith(b"MATLAB ")
        or b"\x89HDF\r\n" in (head[:6], head[512:518])
    )


def _from_matlab(file: Source, options: Options) -> FrequencyResponse:
    """A response object where one is requested, or where no variables make up a response; else
    variables.
    """
    from disting.measurement.matlab import chosen_response, from_object

    wanted, index = split_index(options.get("response"))
    arrays, stored = _variables(file), _responses(file)
    of_object = wanted is not None and bool(matching(list(stored), wanted))
    of_variable = wanted is not None and bool(matching(list(arrays), wanted))
    if of_object or (stored and (not of_variable if wanted else not holds_response(arrays))):
        name = chosen_response(stored, wanted, file.name)
        rest = {key: value for key, value in options.items() if key != "response"} | (
            {"index": index} if index else {}
        )
        return check(from_object, rest, file)(stored[name], name, file.name, **rest)
    return check(from_variables, options, file)(arrays, file.name, **options)


def _matlab_series(
    file: Source, input: str | int, output: str | int, options: Options
) -> TimeSeries:
    read = check(series_from_variables, options, file)
    return read(_variables(file), file.name, str(input), str(output), **options)


def _variables(file: Source) -> Mapping[str, Any]:
    from disting.measurement.matlab import variables

    return variables(file)


def _responses(file: Source) -> Mapping[str, Any]:
    from disting.measurement.matlab import responses

    return responses(file)


def _is_matlab_record(file: Source, options: Options) -> bool:
    """Return True if there is a clock or a sampling rate, and no frequency response."""
    arrays = _variables(file)
    return bool(arrays.keys() & CLOCKS) and not (
        options.keys() & NAMED or holds_frequencies(arrays) or _responses(file)
    )


def _is_universal(file: Source, head: bytes) -> bool:
    return file.suffix in (".uff", ".unv", ".unf", ".bunv")


def _from_universal(file: Source, options: Options) -> FrequencyResponse:
    from disting.measurement.uff import read_uff

    return check(read_uff, options, file)(file, **options)


def _from_impedance(file: Source, *, quantity: str = "") -> FrequencyResponse:
    """An impedance has no other quantity."""
    return read_impedance(file)


def _table(file: Source) -> Table:
    text = decode(file.content, file.name)
    readers = (read_export, read_trace, read_codesys_trace)
    tables = (read(text, file.name) for read in readers)
    return next(filter(None, tables), None) or table(text, file.name)


def _from_text(file: Source, options: Options) -> FrequencyResponse:
    return check(frequency_response, options, file)(_table(file), **options)


def _begin(file: Source, columns: Sequence[str] | None) -> tuple[int, ...]:
    return response_columns(_table(file), columns)


def _text_series(file: Source, input: str | int, output: str | int, options: Options) -> TimeSeries:
    return check(time_series, options, file)(_table(file), input, output, **options)


def _is_text_record(file: Source, options: Options) -> bool:
    """Return True if there is a column of times and none of frequencies."""
    if "columns" in options:
        return False
    headers = _table(file).headers
    return any(map(is_time, headers)) and not any(
        meaning(header).role is Role.FREQUENCY for header in headers
    )


def _text_columns(file: Source, options: Options) -> tuple[ReadColumn, ...]:
    table = _table(file)
    if options.keys() & NAMES_OF_SIGNALS.keys() or _is_text_record(file, options):
        return signal_columns(table, dict(_signal_uses(table, options)))
    try:
        roles = columns_of(table, options.get("columns"), [])
    except InputError:
        roles = [Column(Role.OTHER)] * len(table.headers)
    return record_columns(table.headers, table.values, roles)


def _signal_uses(table: Table, options: Options) -> Iterator[tuple[int, Use]]:
    """The clock, and the signals that the options name, of a table of time series."""
    clocks = [at for at, header in enumerate(table.headers) if is_time(header)]
    yield from ((at, Use(Role.CLOCK)) for at in clocks[:1])
    for name, role in NAMES_OF_SIGNALS.items():
        if name in options:
            try:
                yield table.at(options[name]), Use(role)
            except InputError:
                continue  # the refusal names the columns


def _matlab_columns(file: Source, options: Options) -> tuple[ReadColumn, ...]:
    stored = _responses(file)
    names = [name for name in _variables(file) if not any(s.startswith(f"{name}.") for s in stored)]
    names += stored
    signals = ((role, options.get(name)) for name, role in NAMES_OF_SIGNALS.items())
    usual = ((role, next((n for n in kind if n in names), None)) for role, kind in USUAL.items())
    uses = {split_index(n)[0] or "": Use(role) for role, n in (*usual, *signals) if n}
    known = {name: use for name, use in uses.items() if name in names}
    return record_variables(names, known, tuple(options.values()))


def check(reader: Callable[..., T], options: Options, file: Source) -> Callable[..., T]:
    """The reader, if it knows all these options; else InputError, naming those that it knows."""
    names = {
        p.name for p in inspect.signature(reader).parameters.values() if p.kind is p.KEYWORD_ONLY
    }
    unknown = sorted(set(options) - names)
    if unknown:
        raise UnknownOption(
            f"{file.name}: unknown option {enumeration(unknown)}; known for this format:"
            f" {', '.join(sorted(names))}"
        )
    return reader


FORMATS = (
    Format(
        name="MATLAB",
        fits=_is_matlab,
        response=_from_matlab,
        records=Records(_matlab_series, _variables, _is_matlab_record),
        columns=_matlab_columns,
    ),
    Format(
        name="impedance",
        fits=is_impedance,
        response=lambda file, options: check(_from_impedance, options, file)(file, **options),
    ),
    Format(name="universal", fits=_is_universal, response=_from_universal),
    Format(
        name="text",
        fits=lambda *_: True,
        response=_from_text,
        records=Records(_text_series, lambda file: _table(file).headers, _is_text_record),
        begin=_begin,
        columns=_text_columns,
    ),
)
