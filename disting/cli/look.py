"""disting look: a measured file as it is read, before anything is fitted to it."""

import argparse
import shutil
import sys
from collections.abc import Iterator
from functools import partial

from disting.cli.fit_data import in_units, reader_settings
from disting.cli.output import emit
from disting.cli.terminal_plot import bode_lines, nyquist_lines, signs_of
from disting.errors import printable
from disting.files import json_text
from disting.measurement import FrequencyResponse
from disting.measurement.look_text import WIDTH, look_lines
from disting.measurement.looking import Look, look, name_units

NARROWEST, WIDEST = 60, 160  # characters of a line


def run(options: argparse.Namespace) -> int:
    """Read, print and write."""
    seen = look(
        options.file,
        repeat=options.repeat,
        outliers=options.outliers,
        changes=list(_changes(options)),
        **reader_settings(options),
    )
    seen = name_units(seen, dict(options.unit))
    if options.json:
        emit(options.json, f"{json_text(seen.to_dict(), indent=1)}\n")
    if options.json != "-":
        columns = shutil.get_terminal_size((WIDTH, 24)).columns
        width = min(max(columns, NARROWEST), WIDEST)
        print("\n".join([*look_lines(seen, width), *_plot(seen, width)]))
    if options.out:
        from disting.report.look import write_look

        write_look(seen, options.out)
        if options.json != "-":
            print(f"\nwritten to {options.out}; open {options.out / 'look.html'}")
    return 0


def _changes(options: argparse.Namespace) -> Iterator[partial[FrequencyResponse]]:
    """What a fit does with a response before it computes with it."""
    yield partial(in_units, options=options)
    if options.band:
        yield partial(FrequencyResponse.masked, low=options.band[0], high=options.band[1])
    if options.lines:
        yield partial(FrequencyResponse.thinned, count=options.lines)
    if options.sign.split(",")[0] == "-":
        yield partial(FrequencyResponse.sign_reversed)


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
