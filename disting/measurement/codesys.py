"""Traces of CODESYS, and of the controls that are built on it (ctrlX PLC and others), as text:

    [key]; [value]
    Flags; 32
    ..
    0.Variable; PLC_PRG.lrTorque
    0.Data;
    ; 291; 1.5
    ; 1291; 1.25
    1.Variable; PLC_PRG.lrSpeed
    ..

Each variable has its own times. `Flags` gives their unit: bit 5 for microseconds, bit 4 for
milliseconds; where none or both are set, the sampling rate has to be given. A sample is taken in
each cycle of a task, so that the times vary by the jitter of the control: they are equidistant as
cycles are, and a cycle without a sample is a gap. A buffer may begin or end a few samples earlier
for one variable than for another: what all of them have is read. Nothing is resampled.
"""

import re
from array import array
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np

from disting.errors import InputError, enumeration, short
from disting.measurement.arrays import Real
from disting.measurement.table import Table

HEAD = re.compile(r"\s*\[key\]\s*;\s*\[value\]", re.IGNORECASE)
VARIABLE = re.compile(r"\d+\.Variable", re.IGNORECASE)
FLAGS = "flags"
UNITS = {32: "us", 16: "ms"}  # by the bit of `Flags`
TRUTH = {"true": 1.0, "false": 0.0}
GAP = 1.5  # periods from one sample to the next, from which on a cycle is missing
LEAST = 0.5  # periods, below which two samples are of one cycle


@dataclass(slots=True)
class Channel:
    """A variable: times in the unit of the file, values, the line of each sample; `text`: the
    first value that is no number, "" without one.
    """

    name: str
    times: "array[float]" = field(default_factory=lambda: array("d"))
    values: "array[float]" = field(default_factory=lambda: array("d"))
    lines: list[int] = field(default_factory=list)
    text: str = ""


def read_codesys_trace(text: str, origin: str) -> Table | None:
    """The table of a trace, its time first; None for any other text. Raises InputError for samples
    that are no numbers, gaps, and variables that were not sampled together.
    """
    if not HEAD.match(text):
        return None
    flags, channels = _read(text, origin)
    numeric = [c for c in channels if c.times and not c.text]
    if not numeric:
        raise InputError(f"{origin}: this trace of CODESYS has no variable with numbers")
    first, values, lines = _together(numeric, origin)
    times, jitter = _cycles(first, numeric[0].name, origin)
    rest = [f"{c.name} ({short(c.text or 'empty')})" for c in channels if c.text or not c.times]
    notes = [
        f"left out: {enumeration(rest)}, no numbers" if rest else "",
        f"times of the cycles vary by {100 * jitter:.2g} % of a period" if jitter else "",
    ]
    return Table(
        (f"time [{_unit(flags)}]", *(c.name for c in numeric)),
        np.column_stack([times, *values]),
        tuple(lines),
        (),
        origin,
        left_out="; ".join(filter(None, notes)),
    )


def _read(text: str, origin: str) -> tuple[str, list[Channel]]:
    """`Flags`, and the variables with their samples."""
    flags, channels = "", list[Channel]()
    for n, line in enumerate(re.split(r"\r\n|\n|\r", text), 1):
        key, mark, rest = (part.strip() for part in line.partition(";"))
        if not mark:
            continue
        if key.lower() == FLAGS and not channels:
            flags = rest
        elif VARIABLE.fullmatch(key):
            channels.append(Channel(rest))
        elif not key and channels:
            _add(channels[-1], rest, n, origin)
    return flags, channels


def _add(channel: Channel, sample: str, n: int, origin: str) -> None:
    """One sample, its time before the semicolon."""
    time, _, value = (part.strip() for part in sample.partition(";"))
    try:
        channel.times.append(float(time))
    except ValueError:
        raise InputError(f"{origin}, line {n}: {short(time)} is no time of a sample") from None
    try:
        number = TRUTH.get(value.lower())
        channel.values.append(float(value.replace(",", ".")) if number is None else number)
    except ValueError:
        channel.text = channel.text or value or "no value"
        channel.values.append(np.nan)
    channel.lines.append(n)


def _together(channels: Sequence[Channel], origin: str) -> tuple[Real, list[Real], list[int]]:
    """The times that all variables have, their values there, and the lines of the first one; raises
    InputError where some were sampled at other times.
    """
    low = max(c.times[0] for c in channels)
    high = min(c.times[-1] for c in channels)
    parts = list(_between(channels, low, high))
    first = parts[0][0]
    apart = [
        c.name
        for c, (times, _) in zip(channels, parts, strict=True)
        if not np.array_equal(times, first)
    ]
    if apart or not len(first):
        raise InputError(
            f"{origin}: {enumeration(apart or [channels[-1].name])} was sampled at other times than"
            f" {channels[0].name}: trace all variables in one task, with one trigger, and export"
            " again; nothing is resampled"
        )
    lines = zip(channels[0].lines, channels[0].times, strict=True)
    inside = [n for n, time in lines if low <= time <= high]
    return first, [values for _, values in parts], inside


def _between(channels: Sequence[Channel], low: float, high: float) -> Iterator[tuple[Real, Real]]:
    for channel in channels:
        times, values = np.array(channel.times), np.array(channel.values)
        inside = (times >= low) & (times <= high)
        yield times[inside], values[inside]


def _cycles(times: Real, name: str, origin: str) -> tuple[Real, float]:
    """Equidistant times of the cycles in which samples were taken, and by how many periods the
    times vary about them; raises InputError for a gap.
    """
    steps = np.diff(times)
    if not len(steps):
        raise InputError(f"{origin}: this trace has one sample of {name}")
    period = float(np.median(steps))
    wrong = np.flatnonzero((steps >= GAP * period) | (steps <= LEAST * period))
    if period <= 0 or len(wrong):
        at = times[wrong[0]] if len(wrong) else times[0]
        raise InputError(
            f"{origin}: samples of {name} are missing or doubled behind the time {at:g}, the usual"
            f" step is {period:g}: record every cycle, with a longer buffer and a resolution of"
            " microseconds, or cut the file there"
        )
    cycles = np.linspace(times[0], times[-1], len(times))
    return cycles, float(np.max(np.abs(times - cycles)) / period)


def _unit(flags: str) -> str:
    """The unit of the times, from `Flags`; a word that is not a unit where it is missing."""
    number = int(flags) if flags.isdecimal() else 0
    units = [unit for bit, unit in UNITS.items() if number & bit]
    return units[0] if len(units) == 1 else "unit not in Flags"
