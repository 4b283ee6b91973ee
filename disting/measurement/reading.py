"""One door for all files: the format is that of the content, where the content shows it, else
of the ending.
"""

import inspect
from collections.abc import Callable
from pathlib import Path
from typing import Any

from disting.errors import InputError, listed
from disting.measurement.column_words import FREQUENCIES, meaning
from disting.measurement.matlab import responses, variables
from disting.measurement.response import FrequencyResponse
from disting.measurement.signal_words import guessed
from disting.measurement.stored import chosen_response, from_stored
from disting.measurement.table_series import is_time, time_series
from disting.measurement.tabular import frequency_response
from disting.measurement.text_table import decoded, table
from disting.measurement.time_series import TimeSeries
from disting.measurement.uff import read_uff
from disting.measurement.variables import (
    RATE_NAMES,
    STEP_NAMES,
    TIME_NAMES,
    from_variables,
    holds_frequencies,
    holds_response,
    indexed,
    series_from_variables,
)

# options that only a time series has
SERIES = ("reference", "segment", "period", "sampling_rate", "time")
NAMED = {"frequency", "response"}  # options that only a frequency response of a MATLAB file has
CLOCKS = {*RATE_NAMES, *STEP_NAMES, *TIME_NAMES}
UNIVERSAL = (".uff", ".unv", ".unf", ".bunv")


def read(path: str | Path, **options: Any) -> FrequencyResponse:
    """Frequency response from a file; `suspicions` and `notes` of the result say what should be
    looked at.

    - text (CSV and the like): `column`, `columns`, `sensor`, `sign`, `phase_unit`
      (`tabular.frequency_response`);
    - MATLAB `.mat`: `frequency`, `response`, `deviation`, `coherence`, `frequency_unit`, `index`,
      `sensor`, `sign` (`variables.from_variables`); `response` may name an object frd or idfrd
      (`stored.from_stored`), in a struct as `frf.Pv`, with the number of output and input as
      `frf.Pv[2,1]`;
    - universal file `.uff`, `.unv`: `record`, `sensor`, `sign` (`uff.read_uff`).

    With `input` and `output` the file is read as a time series (`read_time_series`), likewise a
    file of a clock without frequencies, whose input and output are then told by their names. Its
    options and those of `TimeSeries.response` (`period`, `transient`, `lines`, `band`, `segment`,
    `least_coherence`) are then accepted; `sensor` is the quantity of the recorded output, `to` the
    quantity wanted. Raises InputError for a file or an option that cannot be understood.
    """
    file = _existing(path)
    if options.keys() & {"input", "output", *SERIES} or _is_record(file, options):
        return _through_time(file, options)
    if _is_matlab(file):
        return _from_matlab(file, options)
    if file.suffix.lower() in UNIVERSAL:
        _check(read_uff, options, file)
        return read_uff(file, **options)
    _check(frequency_response, options, file)
    return frequency_response(table(decoded(file.read_bytes(), file.name), file.name), **options)


def read_time_series(
    path: str | Path, input: str | int, output: str | int, **options: Any
) -> TimeSeries:
    """Samples of `input` and `output` (headers of a text file, names of MATLAB variables) from a
    file.

    Options: `sampling_rate` [Hz] (in a MATLAB file also a name) or `time` (column or variable
    [s]); `sensor` = quantity of the output, default position; `sign`; `reference` = the signal
    that a controller was asked for, of a record in closed loop.
    """
    file = _existing(path)
    if _is_matlab(file):
        _check(series_from_variables, options, file)
        return series_from_variables(variables(file), file.name, str(input), str(output), **options)
    if file.suffix.lower() in UNIVERSAL:
        raise InputError(f"{file.name}: time series are read from text and MATLAB files")
    _check(time_series, options, file)
    return time_series(
        table(decoded(file.read_bytes(), file.name), file.name), input, output, **options
    )


def _from_matlab(file: Path, options: dict[str, Any]) -> FrequencyResponse:
    """A response object where one is asked for, or where no variables make up a response; else
    variables.
    """
    asked, index = indexed(options.get("response"))
    arrays, stored = variables(file), responses(file)
    if asked in stored or (
        stored and (asked not in arrays if asked else not holds_response(arrays))
    ):
        name = chosen_response(stored, asked, file.name)
        rest = {key: value for key, value in options.items() if key != "response"} | (
            {"index": index} if index else {}
        )
        _check(from_stored, rest, file)
        return from_stored(stored[name], name, file.name, **rest)
    _check(from_variables, options, file)
    return from_variables(arrays, file.name, **options)


def _is_record(file: Path, options: dict[str, Any]) -> bool:
    """Whether a file holds a clock or a sampling rate, and nothing that is a frequency response."""
    if _is_matlab(file):
        arrays = variables(file)
        return bool(arrays.keys() & CLOCKS) and not (
            options.keys() & NAMED or holds_frequencies(arrays) or responses(file)
        )
    if file.suffix.lower() in UNIVERSAL or "columns" in options:
        return False
    headers = table(decoded(file.read_bytes(), file.name), file.name).headers
    return any(map(is_time, headers)) and not any(
        meaning(header) in FREQUENCIES for header in headers
    )


def _signals(file: Path, given: dict[str, Any]) -> tuple[dict[str, Any], tuple[str, ...]]:
    """Input and output, guessed by their names where neither is given, and the note that says
    so.
    """
    if {"input", "output"} <= given.keys():
        return given, ()
    names = (
        list(variables(file))
        if _is_matlab(file)
        else table(decoded(file.read_bytes(), file.name), file.name).headers
    )
    if given.keys() & {"input", "output"}:
        raise InputError(
            f"{file.name}: a time series has an input and an output, give both; there are"
            f" {listed(sorted(names))}"
        )
    input, output, note = guessed((name for name in names if name), file.name)
    return given | {"input": input, "output": output}, (note,)


def _through_time(file: Path, options: dict[str, Any]) -> FrequencyResponse:
    ours = {"to", *_keywords(TimeSeries.response)} - {"sensor"}
    estimate = {name: value for name, value in options.items() if name in ours}
    rest, notes = _signals(
        file, {name: value for name, value in options.items() if name not in ours}
    )
    wanted = estimate.pop("to", None)
    return read_time_series(file, **rest).response(wanted, **estimate).noted(*notes)


def _existing(path: str | Path) -> Path:
    file = Path(path)
    if file.is_dir():
        raise InputError(f"{file} is a folder; name a file with measured data")
    if not file.is_file():
        raise InputError(f"there is no file {file}")
    return file


def _is_matlab(file: Path) -> bool:
    with file.open("rb") as stream:
        head = stream.read(520)
    return (
        file.suffix.lower() == ".mat"
        or head.startswith(b"MATLAB ")
        or b"\x89HDF\r\n" in (head[:6], head[512:518])
    )


def _keywords(reader: Callable[..., Any]) -> set[str]:
    return {name for name in inspect.signature(reader).parameters if name != "self"}


def _check(reader: Callable[..., Any], options: dict[str, Any], file: Path) -> None:
    known = {
        p.name for p in inspect.signature(reader).parameters.values() if p.kind is p.KEYWORD_ONLY
    }
    unknown = sorted(set(options) - known)
    if unknown:
        raise InputError(
            f"{file.name}: unknown option {listed(unknown)}; known for this format:"
            f" {', '.join(sorted(known))}"
        )
