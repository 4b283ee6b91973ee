"""One door for all files: the format is that of the content, where the content shows it, else of the ending."""

import inspect
from collections.abc import Callable
from pathlib import Path
from typing import Any

from disting.errors import InputError, listed
from disting.measurement.matlab import variables
from disting.measurement.response import FrequencyResponse
from disting.measurement.table_series import time_series
from disting.measurement.tabular import frequency_response
from disting.measurement.text_table import decoded, table
from disting.measurement.time_series import TimeSeries
from disting.measurement.uff import read_uff
from disting.measurement.variables import from_variables, series_from_variables

UNIVERSAL = (".uff", ".unv", ".unf", ".bunv")


def read(path: str | Path, **options: Any) -> FrequencyResponse:
    """Frequency response from a file; `suspicions` and `notes` of the result say what should be looked at.

    - text (CSV and the like): `column`, `columns`, `sensor`, `sign`, `phase_unit` (`tabular.frequency_response`);
    - MATLAB `.mat`: `frequency`, `response`, `deviation`, `coherence`, `frequency_unit`, `index`, `sensor`, `sign`
      (`variables.from_variables`);
    - universal file `.uff`, `.unv`: `record`, `sensor`, `sign` (`uff.read_uff`).

    With `input` and `output` the file is read as a time series (`read_time_series`), whose options and those of
    `TimeSeries.response` (`period`, `transient`, `lines`, `band`, `segment`) are then accepted; `sensor` is the quantity of the
    recorded output, `to` the quantity wanted. Raises InputError for a file or an option that cannot be understood.
    """
    if "input" in options or "output" in options:
        return _through_time(path, options)
    file = _existing(path)
    if _is_matlab(file):
        _check(from_variables, options, file)
        return from_variables(variables(file), file.name, **options)
    if file.suffix.lower() in UNIVERSAL:
        _check(read_uff, options, file)
        return read_uff(file, **options)
    _check(frequency_response, options, file)
    return frequency_response(table(decoded(file.read_bytes(), file.name), file.name), **options)


def read_time_series(path: str | Path, input: str | int, output: str | int, **options: Any) -> TimeSeries:
    """Samples of `input` and `output` (headers of a text file, names of MATLAB variables) from a file.

    Options: `sampling_rate` [Hz] (in a MATLAB file also a name) or `time` (column or variable [s]); `sensor` = quantity of the
    output, default position; `sign`.
    """
    file = _existing(path)
    if _is_matlab(file):
        _check(series_from_variables, options, file)
        return series_from_variables(variables(file), file.name, str(input), str(output), **options)
    if file.suffix.lower() in UNIVERSAL:
        raise InputError(f"{file.name}: time series are read from text and MATLAB files")
    _check(time_series, options, file)
    return time_series(table(decoded(file.read_bytes(), file.name), file.name), input, output, **options)


def _through_time(path: str | Path, options: dict[str, Any]) -> FrequencyResponse:
    if not {"input", "output"} <= options.keys():
        raise InputError("a time series has an input and an output: give both")
    ours = {"to", *_keywords(TimeSeries.response)} - {"sensor"}
    estimate = {name: value for name, value in options.items() if name in ours}
    rest = {name: value for name, value in options.items() if name not in ours}
    wanted = estimate.pop("to", None)
    return read_time_series(path, **rest).response(wanted, **estimate)


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
    return file.suffix.lower() == ".mat" or head.startswith(b"MATLAB ") or b"\x89HDF\r\n" in (head[:6], head[512:518])


def _keywords(reader: Callable[..., Any]) -> set[str]:
    return {name for name in inspect.signature(reader).parameters if name != "self"}


def _check(reader: Callable[..., Any], options: dict[str, Any], file: Path) -> None:
    known = {p.name for p in inspect.signature(reader).parameters.values() if p.kind is p.KEYWORD_ONLY}
    unknown = sorted(set(options) - known)
    if unknown:
        raise InputError(f"{file.name}: unknown option {listed(unknown)}; known for this format: {', '.join(sorted(known))}")
