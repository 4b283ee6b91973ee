"""One door for all files with measured data.

Which signals of a record are input and output, from their names.
"""

import inspect
import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, Unpack, cast

from disting.errors import InputError, enumeration
from disting.files import write_whole
from disting.measurement.formats import FORMATS, Format, Options, Records, format_of
from disting.measurement.options import ReadOptions, RecordOptions
from disting.measurement.repeats import mean_of
from disting.measurement.response import FrequencyResponse, Signal
from disting.measurement.scaling import in_units, reader_units
from disting.measurement.source import Source, source
from disting.measurement.tabular import ESCAPED, MARK
from disting.measurement.time_series import TimeSeries
from disting.measurement.understanding import by_name
from disting.renamed import renamed

FORMULA = re.compile(
    rf"(?<=[,;])[=+@-]|(?<=[,;] )[=+@-]|{ESCAPED.pattern[:2]}(?={ESCAPED.pattern[2:]})"
)
# options that only a time series has
SERIES = ("input", "output", "reference", "segment", "period", "sampling_rate", "time")


def csv_text(response: FrequencyResponse) -> str:
    """Comment lines with quantity, signals and origin; a header; one line a frequency.

    >>> from disting.measurement import from_arrays
    >>> csv_text(from_arrays(range(1, 9), [1j, 2j] * 4, quantity="velocity")).splitlines()[1]
    '# quantity: velocity'
    """
    return "\n".join([*_head(response), *_rows(response), ""])


def write_csv(response: FrequencyResponse, path: str | Path) -> None:
    """Write `csv_text` to a file; `read` gives an equal response. Raises InputError where the
    file cannot be written.

    >>> from tempfile import TemporaryDirectory
    >>> from disting.measurement import from_arrays, read
    >>> data = from_arrays(range(1, 9), [1j, 2j] * 4)
    >>> with TemporaryDirectory() as folder:
    ...     write_csv(data, Path(folder, "a.csv"))
    ...     bool((read(Path(folder, "a.csv")).G == data.G).all())
    True
    """
    try:
        write_whole(Path(path), [csv_text(response)])
    except OSError as error:
        raise InputError(f"{path} cannot be written: {error.strerror}") from None


def _head(response: FrequencyResponse) -> Iterator[str]:
    yield f"# {MARK}"
    yield f"# quantity: {response.quantity_word}"
    for role, signal in (("input", response.input), ("output", response.output)):
        yield from (
            f"# {role} {part}: {_line(text)}"
            for part, text in zip(Signal._fields, signal, strict=True)
            if text
        )
    if response.origin:
        yield f"# origin: {_line(response.origin)}"
    yield from (f"# note: {_line(note)}" for note in response.notes)


def _rows(response: FrequencyResponse) -> Iterator[str]:
    extra = [
        (name, c)
        for name, c in (("std", response.deviation), ("coherence", response.coherence))
        if c is not None
    ]
    yield ",".join(["omega [rad/s]", "Re G", "Im G", *(name for name, _ in extra)])
    columns = (response.omega, response.G.real, response.G.imag, *(column for _, column in extra))
    for numbers in zip(*(column.tolist() for column in columns), strict=True):
        yield ",".join(map(repr, numbers))


def _line(text: str) -> str:
    r"""A text of one line. Spreadsheets split comments too: what they would compute is written
    as \\u003d and the like.
    """
    return FORMULA.sub(lambda sign: f"\\u{ord(sign[0]):04x}", " ".join(text.split()))


@renamed(sensor="quantity")
def read(
    path: str | Path,
    *,
    repeat: Sequence[str | Path] = (),
    unit: Mapping[str, str] | None = None,
    scale: float | None = None,
    torque_constant: float | None = None,
    **options: Unpack[ReadOptions],
) -> FrequencyResponse:
    """Frequency response from a file; `suspicions` and `notes` of the result state what should be
    checked.

    - text (CSV and the like): `column`, `columns`, `quantity`, `sign`, `phase_unit`,
      `frequency_unit`, `magnitude_unit` (`tabular.frequency_response`);
    - MATLAB `.mat`: `frequency`, `response`, `deviation`, `coherence`, `frequency_unit`, `index`,
      `quantity`, `sign` (`variables.from_variables`); `response` may name an object frd or idfrd
      (`matlab_models.from_object`), in a struct as `frf.Pv`, with the number of output and input as
      `frf.Pv[2,1]`;
    - universal file `.uff`, `.unv`: `record`, `quantity`, `sign` (`uff.read_uff`).

    With `input` and `output` the file is read as a time series (`read_time_series`), likewise a
    file of a clock without frequencies, whose input and output are then found by their names. Its
    options and those of `TimeSeries.response` (`period`, `transient`, `lines`, `band`, `segment`,
    `least_coherence`, `trend`) are then accepted; `quantity` is that of the recorded output, `to`
    the one wanted. `hold`, of every file: the time for which a digital drive holds its input [s]
    (`FrequencyResponse.held`), of a time series also "record".

    `repeat`: further files with the same response, of which the mean is taken, `outliers` as of
    `mean_of`;
    `unit`: units by name ("frequency", "phase", "magnitude", "input", "output") that the file does
    not state, such as {"output": "deg"}; `scale`: a factor, such as the gain of the sensor;
    `torque_constant` [Nm/A or N/A], where the input is a current. With any of the last three the
    response is in SI units, as `disting fit` reads it; without them it is as in the file. Raises
    InputError for a file or an option that cannot be understood.

    >>> from tempfile import TemporaryDirectory
    >>> lines = ["frequency [Hz],re,im", *(f"{f},1,{f}" for f in range(1, 20))]
    >>> with TemporaryDirectory() as folder:
    ...     file = Path(folder, "frf.csv")
    ...     _ = file.write_text("\\n".join(lines))
    ...     len(read(file)), read(file, quantity="velocity", sign=-1).G[0]
    (19, np.complex128(-1-1j))
    """
    named = cast("Options", options) | reader_units(unit or {})
    if repeat:
        outliers = str(named.pop("outliers", "keep"))
        response = mean_of([_read_one(file, named) for file in (path, *repeat)], outliers=outliers)
    else:
        response = _read_one(path, named)
    if unit is None and scale is None and torque_constant is None:
        return response
    return in_units(response, unit or {}, scale, torque_constant)


def _read_one(path: str | Path, options: Options) -> FrequencyResponse:
    """The response of one file; raises InputError."""
    file = source(path)
    record = open_record(file, options)
    return record[1]() if record else read_response(file, options)


def beginnings(path: str | Path, columns: Sequence[str] | None = None) -> tuple[int, ...] | None:
    """Columns, from 1, at which the responses of a text file begin; None for another file, or
    where it is a record of time series.

    `columns` as for `read`. Raises InputError where columns are missing.

    >>> from tempfile import TemporaryDirectory
    >>> lines = ["f [Hz],re1,im1,re2,im2", *(f"{f},1,2,3,4" for f in range(1, 20))]
    >>> with TemporaryDirectory() as folder:
    ...     file = Path(folder, "two.csv")
    ...     _ = file.write_text("\\n".join(lines))
    ...     beginnings(file)
    (2, 4)
    """
    file = source(path)
    file_format = format_of(file)
    if file_format.begin is None or (file_format.records and file_format.records.held(file, {})):
        return None
    return file_format.begin(file, columns)


@renamed(sensor="quantity")
def read_time_series(
    path: str | Path, input: str | int, output: str | int, **options: Unpack[RecordOptions]
) -> TimeSeries:
    """Samples of `input` and `output` (headers of a text file, names of MATLAB variables) from a
    file.

    Options: `sampling_rate` [Hz] (in a MATLAB file also a name) or `time` (column or variable [s]);
    `quantity` of the output, default position; `sign`; `reference` = the signal that was the
    command of a controller, of a record in closed loop. Raises InputError, with the remedy, for a
    file that is not there or not read, and for signals that it does not hold.

    >>> from tempfile import TemporaryDirectory
    >>> lines = ["t [s],iq [A],angle [rad]", *(f"{k / 100},{k % 7},{k % 5}" for k in range(60))]
    >>> with TemporaryDirectory() as folder:
    ...     file = Path(folder, "record.csv")
    ...     _ = file.write_text("\\n".join(lines))
    ...     read_time_series(file, "iq [A]", "angle [rad]", time="t [s]").sampling_rate
    100.0
    """
    file = source(path)
    return _records(file, format_of(file)).read(file, input, output, cast("Options", options))


def _records(file: Source, file_format: Format) -> Records:
    if file_format.records is None:
        able = " and ".join(other.name for other in FORMATS if other.records)
        raise InputError(f"{file.name}: time series are read from {able} files")
    return file_format.records


def _signals(file: Source, records: Records, entry: Options) -> tuple[Options, tuple[str, ...]]:
    """Input and output, guessed by their names where neither is given, and the note that states
    it.
    """
    if {"input", "output"} <= entry.keys():
        return entry, ()
    names = list(records.names(file))
    if entry.keys() & {"input", "output"}:
        raise InputError(
            f"{file.name}: a time series has an input and an output, give both; the signals are"
            f" {enumeration(sorted(names))}"
        )
    input, output, note = guess((name for name in names if name), file.name)
    return entry | {"input": input, "output": output}, (note,)


def read_response(file: Source, options: Options) -> FrequencyResponse:
    """Return the response of a file that holds no record in time. Raises InputError."""
    rest = {name: value for name, value in options.items() if name != "hold"}
    response = format_of(file).response(file, rest)
    return response.held(options["hold"]) if "hold" in options else response


def open_record(
    file: Source, options: Options
) -> tuple[TimeSeries, Callable[[], FrequencyResponse]] | None:
    """Return the record in time of a file and what makes a response of it; None for a file that
    holds a frequency response. Raises InputError.
    """
    file_format = format_of(file)
    is_record = options.keys() & set(SERIES) or (
        file_format.records and file_format.records.held(file, options)
    )
    return _through_time(file, _records(file, file_format), options) if is_record else None


def _through_time(
    file: Source, records: Records, options: Options
) -> tuple[TimeSeries, Callable[[], FrequencyResponse]]:
    ours = {"to", *_keywords(TimeSeries.response)} - {"quantity"}
    estimate = {name: value for name, value in options.items() if name in ours}
    rest, notes = _signals(
        file, records, {name: value for name, value in options.items() if name not in ours}
    )
    wanted = estimate.pop("to", None)
    input, output = rest.pop("input"), rest.pop("output")
    series = records.read(file, input, output, rest)
    series = replace(series, columns=by_name(series.columns)) if notes else series
    return series, lambda: series.response(wanted, **estimate).noted(*notes)


def _keywords(reader: Callable[..., Any]) -> set[str]:
    return {name for name in inspect.signature(reader).parameters if name != "self"}


WORD = re.compile(r"[A-Z]?[a-z]+|[A-Z]+(?![a-z])")
INPUTS = {
    "u",
    "input",
    "torque",
    "force",
    "current",
    "iq",
    "i",
    "tau",
    "trq",
    "moment",
    "strom",
    "kraft",
    "drehmoment",
    "eingang",
}
OUTPUTS = {
    "y", "output", "position", "pos", "theta", "phi", "angle", "q", "x", "speed", "velocity", "vel",
    "omega", "acceleration", "acc", "weg", "lage", "winkel", "drehzahl", "geschwindigkeit",
    "beschleunigung", "ausgang",
}  # fmt: skip
# not what was measured
ASKED_FOR = {"ref", "reference", "set", "setpoint", "cmd", "command", "desired", "soll", "target"}
CLOCKS = {"t", "time", "zeit", "timestamp"}


def guess(names: Iterable[str], origin: str) -> tuple[str, str, str]:
    """Names of input and output, and a note that states it; raises InputError listing the names
    where more or fewer fit.

    >>> guess(["t", "iq [A]", "iq_ref", "theta"], "a.csv")[:2]
    ('iq [A]', 'theta')
    """
    own_names = list(names)
    words = {
        name: {word.lower() for word in WORD.findall(name.partition("[")[0])} for name in own_names
    }
    measured = [name for name in own_names if not words[name] & (ASKED_FOR | CLOCKS)]
    inputs, outputs = (
        [name for name in measured if words[name] & kind] for kind in (INPUTS, OUTPUTS)
    )
    if len(inputs) != 1 or len(outputs) != 1 or inputs == outputs:
        raise InputError(
            f"{origin}: which signal is the input, which the output? give --read"
            f" input=NAME --read output=NAME; the signals are {enumeration(sorted(own_names))}"
        )
    return (
        inputs[0],
        outputs[0],
        (
            f"input taken as {inputs[0]}, output as {outputs[0]}, by their names; if not, give"
            " --read input=NAME --read output=NAME"
        ),
    )
