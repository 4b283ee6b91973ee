"""Parsing of the option values of disting fit; nothing here loads numerical libraries."""

import argparse
import re
from pathlib import Path
from typing import Any

from disting.cli.arguments import frequency_range
from disting.errors import short
from disting.measurement.options import UNITS

SIGNS = ("+", "-", "auto")


def site_folder(text: str) -> Path:
    """A folder that 'disting report' wrote."""
    if not (Path(text) / "models").is_dir():
        raise argparse.ArgumentTypeError(
            f"{short(text)} holds no pages that 'disting report' wrote; name their folder"
        )
    return Path(text)


def reader_option(text: str) -> tuple[str, Any]:
    """NAME=VALUE for a reader; several values by commas, a range as LOW..HIGH."""
    name, equals, value = text.partition("=")
    if not (name and equals and value):
        raise argparse.ArgumentTypeError(
            f"an option is written like sampling_rate=2500, not {short(text)}"
        )
    if ".." in value:
        return name, frequency_range(value)
    # not at the comma of frf[2,1]
    parts = tuple(_number(part) for part in re.split(r",(?![^\[(]*[\])])", value))
    return name, parts if len(parts) > 1 else parts[0]


def unit_of(text: str) -> tuple[str, str]:
    """NAME=UNIT."""
    name, equals, unit = text.partition("=")
    if not (equals and unit) or name not in UNITS:
        raise argparse.ArgumentTypeError(
            f"a unit is written like output=deg, of {', '.join(UNITS)}, not {short(text)}"
        )
    return name, unit


def signs(text: str) -> str:
    """One sign for each sensor, or auto."""
    if text != "auto" and not all(sign in ("+", "-") for sign in text.split(",")):
        raise argparse.ArgumentTypeError(
            f"a sign is {', '.join(SIGNS)}, of several sensors like +,-, not {short(text)}"
        )
    return text


def _number(text: str) -> int | float | str:
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            continue
    return text


def bound(text: str) -> tuple[str, tuple[float, float]]:
    """NAME=LOW..HIGH."""
    name, _, limits = text.partition("=")
    return name, frequency_range(limits)


def known_value(text: str) -> tuple[str, float]:
    """NAME=VALUE of a parameter."""
    name, _, value = text.partition("=")
    try:
        return name, float(value)
    except ValueError:
        raise argparse.ArgumentTypeError(
            f"a value is written like m1=0.02, not {short(text)}"
        ) from None


def masses(text: str) -> tuple[int, ...]:
    """Numbers of masses such as 3, 1-4 or 1,3."""
    match = re.fullmatch(r"([1-9])(?:-([1-9])|((?:,[1-9])*))", text)
    if not match or int(match[2] or 9) < int(match[1]):
        raise argparse.ArgumentTypeError(
            f"numbers of masses are written like 3, 1-4 or 1,3, not {short(text)}"
        )
    if match[2]:
        return tuple(range(int(match[1]), int(match[2]) + 1))
    return tuple(sorted({int(n) for n in text.split(",")}))


def thresholds(text: str) -> tuple[float, float, float]:
    """Three limits, separated by commas."""
    try:
        first, second, third = (float(part) for part in text.split(","))
    except ValueError:
        first = second = third = -1.0
    if not all(limit > 0 for limit in (first, second, third)):
        raise argparse.ArgumentTypeError(
            f"thresholds are written like 30,1000,20, all positive, not {short(text)}"
        )
    return first, second, third
