"""Values of fitted networks in words: units, intervals, tables of values."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from math import inf

from disting.fit.judge.interval import Interval
from disting.fit.judge.network_intervals import NetworkTwin
from disting.fit.results.networks import FittedNetwork
from disting.model.chain import Sort
from disting.network.network import Network

UNITS = {
    "R": "ohm",
    "L": "H",
    "C": "F",
    "W": "ohm/sqrt(s)",
    "P": "s^n/ohm",
}  # of an impedance in ohm
DIGITS = 5


@dataclass(frozen=True, slots=True)
class ValueRow:
    """A value as texts: name, value, unit ("" where none is known), 95 % interval."""

    name: str
    value: str
    unit: str
    interval: str


def value_rows(
    network: Network, values: Mapping[str, float], intervals: Mapping[str, Interval]
) -> list[ValueRow]:
    """Return a row for each value; without an interval its cell is empty.

    >>> from disting.network import network_of
    >>> value_rows(network_of("R1-C1"), {"C1": 1e-6, "R1": 20.0}, {"C1": (0.0, 2e-6)})[0]
    ValueRow(name='C1', value='1e-06', unit='F', interval='below 2e-06')
    """
    is_circuit = network.sort is Sort.CIRCUIT
    return [
        ValueRow(
            name,
            f"{value:.{DIGITS}g}",
            UNITS.get(name[0], "") if is_circuit else "",
            interval_words(intervals[name]) if name in intervals else "",
        )
        for name, value in values.items()
    ]


def interval_words(interval: Interval) -> str:
    """Return an interval in words.

    >>> [interval_words(x) for x in ((1.0, 2.0), (0.0, 3.0), (4.0, float("inf")))]
    ['1 to 2', 'below 3', 'above 4']
    >>> interval_words((0.0, float("inf")))
    'not determined'
    """
    low, high = interval
    if low <= 0 and high == inf:
        return "not determined"
    if low <= 0:
        return f"below {high:.{DIGITS}g}"
    return f"above {low:.{DIGITS}g}" if high == inf else f"{low:.{DIGITS}g} to {high:.{DIGITS}g}"


def value_lines(fit: FittedNetwork) -> Iterator[str]:
    """Yield the values of a fitted network and of those that cannot be distinguished from it."""
    yield f"{fit.network.name}, values and 95 % intervals:"
    yield from _align_rows(value_rows(fit.network, fit.values, fit.intervals))
    for twin in fit.twins:
        yield f"{twin_words(twin)}:"
        yield from _align_rows(value_rows(twin.network, twin.values, twin.intervals))


def twin_words(twin: NetworkTwin) -> str:
    """Return the name of a network with the same responses, and how far its values are known."""
    if not twin.values:
        return f"{twin.network.name}, the same responses; its values were not found"
    one_of_many = ", one of infinitely many sets of values" if twin.free_choices else ""
    return f"{twin.network.name}, the same responses{one_of_many}"


def _align_rows(rows: list[ValueRow]) -> Iterator[str]:
    width = max((len(row.unit) for row in rows), default=0)
    for row in rows:
        yield f"  {row.name:6} {row.value:<12} {row.unit:{width}}  {row.interval}".rstrip()


def standing(fit: FittedNetwork) -> str:
    """Return the status of a network by the data: excluded, by which, or not."""
    if not fit.explains:
        return "does not explain the data"
    if fit.contains:
        return f"contains {fit.contains}"
    return f"excluded by {fit.excluded_by}" if fit.excluded_by else "not excluded"
