"""Measured data of disting fit: files, repeats, units."""

import argparse
from pathlib import Path

from disting.measurement import FrequencyResponse, in_si, mean_of, read
from disting.measurement.scaling import scaled, with_constant


def measured(files: list[Path], options: argparse.Namespace) -> FrequencyResponse:
    """The response in `files`, the mean of several, with the units and factors of the command
    line.
    """
    units = dict(options.unit)
    settings = dict(options.read) | ({"column": options.column} if options.column else {})
    settings |= {f"{name}_unit": units[name] for name in ("frequency", "phase") if name in units}
    found = mean_of([read(file, **settings) for file in files])
    found = scaled(found, options.scale) if options.scale is not None else found
    found = in_si(found, input=units.get("input"), output=units.get("output"))
    return (
        with_constant(found, options.torque_constant)
        if options.torque_constant is not None
        else found
    )
