"""Measured data of disting fit: files, repeats, units; several responses of one machine."""

import argparse
import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from disting.cli.output import complain, keep_apart
from disting.errors import InputError, enumeration, short
from disting.experiments.changes import GENERIC, read_changes
from disting.fit.search.joint import FurtherResponse
from disting.fit.search.setup import Setup
from disting.fit.select import MOST_LINES
from disting.measurement import FrequencyResponse, beginnings, mean_of, read
from disting.measurement.scaling import in_units, reader_units
from disting.model.kinds import CHANGES
from disting.model.presentation import plural

# options of the readers that tell which response of a file is meant: one for all, or one for each
OF_EACH = ("column", "output", "response", "record", "quantity", "sign", "to")
EXPERIMENT = re.compile(r"(.+?):((?:[a-z]+)=.*)")
CHANGED = {kind.name: kind for kind in CHANGES}
FORM = (
    f"an experiment is written {', '.join(f'FILE:{kind.example}' for kind in CHANGES)} or"
    " FILE:sensor=2,lock=1"
)


@dataclass(frozen=True, slots=True)
class Data:
    """The first response with its test data, and what is fitted together with it."""

    train: FrequencyResponse
    test: FrequencyResponse | None
    further: tuple[FurtherResponse, ...]

    @property
    def every(self) -> list[FrequencyResponse]:
        """All responses, each with its test data behind it."""
        pairs = [(self.train, self.test), *((f.measured, f.test) for f in self.further)]
        return [response for pair in pairs for response in pair if response is not None]


def data(options: argparse.Namespace) -> Data:
    """All responses, masked; what the readers noticed goes to standard error."""
    _check(options)
    if options.demo:
        from disting.simulation import demo

        train, test = (demo(i).response("acceleration") for i in (0, 1))
        the_data = Data(train, test, ())
    else:
        the_data = _from_files(options)
    the_data = (
        _each(the_data, lambda this_response: this_response.masked(*options.band))
        if options.band
        else the_data
    )
    the_data = _each(
        the_data, lambda this_response: this_response.thinned(options.lines or MOST_LINES)
    )
    for note in notes_of(the_data.every):
        complain(note)
    return the_data


def notes_of(responses: Sequence[FrequencyResponse]) -> Iterator[str]:
    """Yield what the readers noticed, each sentence once; of several responses it names the
    file, or the column, unless it holds for all.
    """
    names = short_names([response.origin for response in responses])
    origins = dict[str, list[str]]()
    for response, name in zip(responses, names, strict=True):
        for note in dict.fromkeys((*response.notes, *response.suspicions)):
            origins.setdefault(note, []).append(name)
    for note, named in origins.items():
        yield note if len(named) == len(responses) else f"{enumeration(named)}: {note}"


def short_names(origins: Sequence[str]) -> list[str]:
    """Return origins without the file or the column that all of them share.

    >>> short_names(["A.csv, column 2", "B.csv, column 2"])
    ['A.csv', 'B.csv']
    >>> short_names(["A.csv, column 2", "A.csv, column 4"])
    ['column 2', 'column 4']
    """
    parts = [origin.partition(", ")[::2] for origin in origins]
    files, columns = ({part[i] for part in parts} for i in (0, 1))
    if len(files) == 1 < len(columns) and all(columns):
        return [column for _, column in parts]
    return [file or "data" for file, _ in parts] if len(columns) == 1 else list(origins)


def sensors(options: argparse.Namespace) -> list[str]:
    """The ports that the sensors show, the first one that of the candidates."""
    text: str = options.sensor
    return text.split(",")


def check_source(options: argparse.Namespace, command: str = "fit") -> None:
    """Raise InputError where files and --demo are both given, or neither."""
    if options.demo and options.train:
        raise InputError("--demo has its own data: remove it, or the files")
    if not options.demo and not options.train:
        raise InputError(
            f"a file with measured data is needed, such as disting {command} bench.csv; --demo"
            f" shows a {command} of simulated data"
        )
    own = options.test or options.read or options.column or options.quantity or options.hold
    if options.demo and (own or options.experiment or len(sensors(options)) > 1):
        raise InputError(
            "--demo has its own data: remove --test, --read, --column, --quantity, --hold,"
            " --experiment and further sensors"
        )
    if options.repeat and len(options.train) > 1:
        raise InputError("--repeat is for a single file: give the mean of each, or remove it")


def _check(options: argparse.Namespace) -> None:
    check_source(options)
    several = len(sensors(options)) > 1 or options.experiment
    moved = options.family or options.gap or ":" in options.actuator + options.sensor
    if options.base and (several or moved):
        raise InputError(
            "--base needs one response, force and sensor at one mass each: remove --experiment,"
            " --family, --gap, further sensors and ports such as 1:2"
        )
    if options.family and several:
        raise InputError(
            "--family moves the sensor and is not supported with several sensors; remove it"
        )
    if options.profiles and not options.out:
        raise InputError("--profiles draws into the page: name its folder with --out")
    if options.site and not options.out:
        raise InputError(
            "--site links the page to the catalogues: name the page's folder with --out"
        )


def _from_files(options: argparse.Namespace) -> Data:
    places = sensors(options)
    keep_apart(map(str, (*options.train, *options.test, *options.repeat)))
    train = list(_responses(options.train, options, "TRAIN"))
    tests = list(_responses(options.test, options, "--test")) if options.test else []
    signs = _signs(options, len(places))
    setups = [Setup(sensor=place, sign=sign) for place, sign in zip(places, signs, strict=True)]
    whole = [
        FurtherResponse(measured, setup, tests[k] if tests else None)
        for k, (measured, setup) in enumerate(zip(train, setups, strict=True))
    ][1:]
    for text in options.experiment:
        whole += _experiment(text, options, dict(zip(places, signs, strict=True)))
    return Data(train[0], tests[0] if tests else None, tuple(whole))


def _responses(
    files: Sequence[Path], options: argparse.Namespace, what: str
) -> Iterator[FrequencyResponse]:
    """One for each sensor: the responses of one file in their order, or one file for each."""
    count = len(sensors(options))
    if len(files) not in (1, count):
        raise InputError(
            f"{len(files)} files of {what} and {plural(count, 'sensor')}: name a place"
            " for each file, as --sensor 1,2"
        )
    for k in range(count):
        repeats = options.repeat if what == "TRAIN" else []
        of_sensor = [files[0], *repeats] if len(files) == 1 else [files[k]]
        yield read_mean(of_sensor, options, k, count, together=len(files) == 1)


def read_mean(
    files: list[Path],
    options: argparse.Namespace,
    which: int = 0,
    count: int = 1,
    *,
    together: bool = False,
    column: str = "",
) -> FrequencyResponse:
    """The response in `files`, the mean of several, with the units and factors of the command
    line; `which` of `count` sensors, in one file `together`.
    """
    own = {"outliers": "drop"} if options.outliers == "drop" and len(files) == 1 else {}
    each = [
        settings_of(f, options, which, count, together=together, column=column) | own for f in files
    ]
    response = mean_of(
        [read(file, **settings) for file, settings in zip(files, each, strict=True)],
        outliers=options.outliers,
    )
    return in_units(response, dict(options.unit), options.scale, options.torque_constant)


def settings_of(
    file: Path,
    options: argparse.Namespace,
    which: int = 0,
    count: int = 1,
    *,
    together: bool = False,
    column: str = "",
) -> dict[str, Any]:
    """Return the options of `read` for one of `count` sensors, in one file `together`. Raises
    InputError.
    """
    settings = reader_settings(options)
    settings = _of_one(settings, which, count) if count > 1 else settings
    settings |= {"column": column} if column else {}
    return _name_response(file, settings, which) if together and count > 1 else settings


def reader_settings(options: argparse.Namespace) -> dict[str, Any]:
    """Return the options of `disting.measurement.read` that a command line names."""
    settings = dict(options.read) | ({"column": options.column} if options.column else {})
    settings |= reader_units(dict(options.unit))
    settings |= {"hold": options.hold} if options.hold else {}
    return settings | ({"quantity": options.quantity} if options.quantity else {})


def _of_one(settings: dict[str, Any], which: int, count: int) -> dict[str, Any]:
    """The settings of one response, where some are given for each."""
    split = {
        name: tuple(value.split(",")) if name == "column" and "," in value else value
        for name, value in settings.items()
    }
    for name, value in split.items():
        if name in OF_EACH and isinstance(value, tuple) and len(value) != count:
            raise InputError(f"{name} is given for {len(value)} responses, but there are {count}")
    return {
        name: value[which] if name in OF_EACH and isinstance(value, tuple) else value
        for name, value in split.items()
    }


def _name_response(file: Path, settings: dict[str, Any], which: int) -> dict[str, Any]:
    """Settings that name a response of a text file by its number, where nothing else names it."""
    if settings.keys() & {"column", "output", "input", "response", "record"}:
        return settings
    begin = beginnings(file, settings.get("columns"))
    if begin is None:
        raise InputError(f"{file.name}: name the response of each sensor, as --read output=a,b")
    if which >= len(begin):
        raise InputError(
            f"{file.name} holds {plural(len(begin), 'response')}, for"
            f" {which + 1} sensors: give a file or a column for each"
        )
    return settings | {"column": begin[which]}


def _signs(options: argparse.Namespace, count: int) -> list[int]:
    """The sign of each sensor against the first one; 1 where they are found by the fit."""
    value = options.sign.split(",")
    if len(value) not in (1, count):
        raise InputError(f"{len(value)} signs, {count} sensors: give one for each, as --sign=+,-")
    numbers = [{"+": 1, "-": -1, "auto": 1}[sign] for sign in value]
    return [sign * numbers[0] for sign in numbers * (count if len(numbers) == 1 else 1)]


def experiment_of(text: str) -> tuple[Path, dict[str, list[str]]]:
    """Return the file of an experiment and its entries by name. Raises InputError."""
    match = EXPERIMENT.fullmatch(text)
    if not match:
        raise InputError(f"{FORM}, not {short(text)}")
    entries = dict[str, list[str]]()
    for part in match[2].split(","):
        name, equals, value = part.partition("=")
        if name not in ("sensor", "force", "column", *CHANGED) or not (equals and value):
            raise InputError(f"{FORM}, not {short(text)}")
        entries.setdefault(name, []).append(value)
    return Path(match[1]), entries


def _experiment(
    text: str, options: argparse.Namespace, signs: dict[str, int]
) -> Iterator[FurtherResponse]:
    """The responses of one experiment: those of all sensors, or of the one that it names."""
    file, entries = experiment_of(text)
    changes = [
        change
        for name, kind in CHANGED.items()
        for value in entries.get(name, ())
        for change in read_changes(kind, _check_size(name, value), str)
    ]
    force = entries.get("force", [""])[-1]
    setup = Setup(force=force, changes=changes)
    places = entries.get("sensor", list(signs))
    if not (changes or force or "sensor" in entries):
        raise InputError(f"{FORM}, not {short(text)}")
    for k, place in enumerate(places):
        alone = "sensor" in entries
        response = read_mean(
            [file],
            options,
            list(signs).index(place) if alone and place in signs else k,
            len(signs),
            together=not alone,
            column=",".join(entries.get("column", ())),
        )
        own = not alone and k == 0  # the sensor of the first response, wherever a candidate has it
        sensor = "" if own else place
        yield FurtherResponse(response, replace(setup, sensor=sensor, sign=signs.get(place, 1)))


def _check_size(name: str, value: str) -> str:
    """Check that the size of a change to the machine is a number."""
    if value.endswith(GENERIC):
        raise InputError(f"a known {name} that was measured with has a number, not {GENERIC}")
    return value


def _each(the_data: Data, change: Callable[[FrequencyResponse], FrequencyResponse]) -> Data:
    """The same change of all responses."""
    further = tuple(
        replace(f, measured=change(f.measured), test=change(f.test) if f.test else None)
        for f in the_data.further
    )
    return Data(change(the_data.train), change(the_data.test) if the_data.test else None, further)
