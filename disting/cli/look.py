"""disting look: measured files as they are read, before anything is fitted to them."""

import argparse
import shutil
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

from disting.cli.fit_data import (
    check_source,
    experiment_of,
    reader_settings,
    sensors,
    settings_of,
)
from disting.cli.output import complain, emit
from disting.cli.terminal_plot import bode_lines, nyquist_lines, signs_of
from disting.errors import InputError, printable
from disting.files import json_text
from disting.measurement import FrequencyResponse
from disting.measurement.look_text import WIDTH, look_lines
from disting.measurement.looking import Look, look, look_at
from disting.measurement.scaling import in_units
from disting.model.chain import Quantity
from disting.model.presentation import plural

NARROWEST, WIDEST = 60, 160  # characters of a line


@dataclass(frozen=True, slots=True)
class View:
    """One response as it is read; `place` as a fit names it: its sensor, its experiment; "" where
    there is one response.
    """

    place: str
    seen: Look


def run(options: argparse.Namespace) -> int:
    """Read, print and write."""
    check_source(options, "look")
    unread = list[str]()
    views = list(_views(options, unread))
    if options.json:
        emit(options.json, f"{json_text(_plain(views), indent=1)}\n")
    if options.json != "-":
        columns = shutil.get_terminal_size((WIDTH, 24)).columns
        print("\n".join(_text(views, min(max(columns, NARROWEST), WIDEST))))
    if options.out:
        pages = list(_write(views, options.out))
        if options.json != "-":
            print(f"\nwritten to {options.out}; open {', '.join(map(str, pages))}")
    for reason in unread:
        complain(reason)
    return 2 if unread else 0


def _views(options: argparse.Namespace, unread: list[str]) -> Iterator[View]:
    """Every response that a fit with these options reads: of all sensors, then of all experiments.
    Files without a place for each are shown one by one; of those that cannot be read the reasons
    are added to `unread`, unless none can be read, which raises InputError.
    """
    if options.demo:
        from disting.simulation import demo

        in_si = partial(
            in_units,
            unit=dict(options.unit),
            scale_by=options.scale,
            torque_constant=options.torque_constant,
        )
        yield View("", look_at(demo(), Quantity.ACCELERATION, [in_si, *_changes(options)]))
        return
    places = sensors(options)
    if len(options.train) > 1 and len(places) == 1:
        for k, file in enumerate(options.train, 1):
            try:
                yield View(f"file {k}", _look_at(file, options))
            except InputError as reason:
                unread.append(str(reason))
        if len(unread) == len(options.train):
            raise InputError(unread.pop(0))
    else:
        yield from _at_sensors(options, places)
    for text in options.experiment:
        yield from _of_experiment(text, options, places)


def _at_sensors(options: argparse.Namespace, places: Sequence[str]) -> Iterator[View]:
    files, count = options.train, len(places)
    together = len(files) == 1
    if not together and len(files) != count:
        raise InputError(
            f"{len(files)} files and {plural(count, 'sensor')}: name a place for each file, as"
            " --sensor 1,2, or remove --sensor to show every file"
        )
    for k, place in enumerate(places):
        name = f"sensor {place}" if count > 1 or options.experiment else ""
        file = files[0 if together else k]
        looked = _look_at(file, options, k, count, together=together, repeat=options.repeat)
        yield View(name, looked)


def _of_experiment(text: str, options: argparse.Namespace, places: Sequence[str]) -> Iterator[View]:
    """The responses of one experiment: those of all sensors, or of the one that it names."""
    file, entries = experiment_of(text)
    own, column = entries.get("sensor"), ",".join(entries.get("column", ()))
    change = [f"{name}={x}" for name in entries if name != "column" for x in entries[name]]
    for k, place in enumerate(own or places):
        which = places.index(place) if own and place in places else k
        several = [] if own or len(places) == 1 else [f"sensor={place}"]
        looked = _look_at(file, options, which, len(places), together=not own, column=column)
        yield View(f"experiment {', '.join([*change, *several])}", looked)


def _look_at(
    file: Path,
    options: argparse.Namespace,
    which: int = 0,
    count: int = 1,
    *,
    together: bool = False,
    column: str = "",
    repeat: Sequence[Path] = (),
) -> Look:
    """One file as it is read for one of `count` sensors; if it is ambiguous which response is
    meant, the file is read without `count`, with the reason among the doubts.
    """
    reasons = list[str]()
    try:
        settings = settings_of(file, options, which, count, together=together, column=column)
    except InputError as reason:
        settings = reader_settings(options)
        reasons.append(str(reason))
    looked = look(
        file,
        repeat=repeat,
        outliers=options.outliers,
        scale=options.scale,
        torque_constant=options.torque_constant,
        unit=dict(options.unit),
        changes=list(_changes(options, which)),
        **settings,
    )
    return replace(looked, refusals=(*reasons, *looked.refusals))


def _changes(options: argparse.Namespace, which: int = 0) -> Iterator[partial[FrequencyResponse]]:
    """Preprocessing steps that a fit applies to a response in SI units before it computes with
    it.
    """
    if options.band:
        yield partial(FrequencyResponse.masked, low=options.band[0], high=options.band[1])
    if options.lines:
        yield partial(FrequencyResponse.thinned, count=options.lines)
    signs = options.sign.split(",")
    if signs[which if which < len(signs) else 0] == "-":
        yield partial(FrequencyResponse.sign_reversed)


def _text(views: Sequence[View], width: int) -> Iterator[str]:
    for view in views:
        if view is not views[0]:
            yield ""
        if view.place:
            yield printable(f"{view.place}:")
        yield from look_lines(view.seen, width)
        yield from _plot(view.seen, width)


def _plain(views: Sequence[View]) -> dict[str, Any]:
    """The first response as plain data, with the others."""
    first, *others = (
        view.seen.to_dict() | ({"place": view.place} if view.place else {}) for view in views
    )
    return first | ({"further": others} if others else {})


def _write(views: Sequence[View], folder: Path) -> Iterator[Path]:
    """Pages: the first one in the folder, each other one in a folder with its number there."""
    from disting.report.look import write_look

    for k, view in enumerate(views, 1):
        own = folder / str(k) if k > 1 else folder
        write_look(view.seen, own)
        yield own / "look.html"


def _plot(seen: Look, width: int) -> Iterator[str]:
    """Diagram of the response in plain characters."""
    response = seen.response
    if response is None:
        return
    signs = signs_of(getattr(sys.stdout, "encoding", None) or "utf-8")
    units = response.output.unit, response.input.unit
    unit = printable("/".join(units)) if all(units) else ""
    yield ""
    if seen.is_impedance:
        yield from nyquist_lines(response.G, width, signs, "ohm")
    else:
        yield from bode_lines(response.frequency, response.G, width, signs, unit)
