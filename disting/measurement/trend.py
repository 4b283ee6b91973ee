"""Trends of a record: the constant speed of a drive under test, a drifting sensor.

A trend is no response to the excitation, but its spectrum covers all lines: a ramp of slope b adds
about b N^2 / (2 pi k) to line k of a period of N samples, the same in each period, so that neither
averaging nor the scatter of the periods shows it.

The difference of two periods, D(t) = x(t + N) - x(t), holds no periodic part. A trend

    T(t) = b t + c t^2    gives    D(t) = b N + c N^2 + 2 c N t,

so a straight line through D by least squares yields b and c, unbiased by the excitation. A single
period has no D. There the lines without excitation show the ramp: its spectrum is known, and b is
their least-squares estimate. In both cases a coefficient counts if it is `SURE` times its standard
error, else it is 0, and the record stays as it is.

Welch's segments are shorter than what an oscillating drive needs to repeat, and a line fitted to a
segment would remove low frequencies of the response with the trend. A position is therefore
differenced, z(t) = x(t) - x(t - 1): that turns a ramp into a constant, which each segment loses,
and is a linear filter, so the response is that of z divided by 1 - exp(-j omega / rate), exactly.
"""

from dataclasses import dataclass, replace
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

from disting.errors import InputError, short
from disting.measurement.arrays import Real, apply
from disting.measurement.response import FrequencyResponse, Signal

SURE = 5.0  # standard errors from which on a trend is no chance
FEWEST = 8  # lines without excitation that show the ramp of a single period


class TrendOption(StrEnum):
    """Treatment of trends: removed, or kept in the record."""

    REMOVE = "remove"
    KEEP = "keep"


@dataclass(frozen=True, slots=True)
class Trend:
    """`slope` in the middle of a record [unit per sample], `change` of the slope from its beginning
    to its end [unit per sample].
    """

    slope: float = 0.0
    change: float = 0.0

    def __bool__(self) -> bool:
        return bool(self.slope or self.change)

    def samples(self, n: int, before: int = 0) -> Real:
        """Return the trend at n samples, zero in their middle, and `before` them; shape
        (before + n,).
        """
        t = np.arange(-before, n) - (n - 1) / 2
        return np.asarray(self.slope * t + self.change / (2 * n) * t**2)


def as_trend_option(value: object) -> TrendOption:
    """Return the option of this name. Raises InputError for another one."""
    try:
        return TrendOption(str(value))
    except ValueError:
        raise InputError(f"trend is remove or keep, not {short(value)}") from None


def trend_between_periods(x: Real, period: int) -> Trend:
    """Estimate the trend of at least two periods of a periodic signal, shape (n,).

    >>> t = np.arange(300)
    >>> round(trend_between_periods(np.sin(2 * np.pi * t / 100) + 0.25 * t, 100).slope, 9)
    0.25
    """
    n = len(x)
    difference = x[period:] - x[:-period]
    # a line about its own middle: mean and slope are then uncorrelated
    t = np.arange(len(difference)) - (len(difference) - 1) / 2
    moment = float(t @ t)
    mean = float(difference.mean())
    slope = float(t @ difference) / moment
    rest = difference - mean - slope * t
    size = max(float(rest.std()), float(np.spacing(np.abs(x).max())))
    if abs(slope) <= SURE * size / np.sqrt(moment):
        slope = 0.0
    if abs(mean) <= SURE * size / np.sqrt(len(difference)) and not slope:
        return Trend()
    return Trend(slope=mean / period, change=slope / period * n)


def trend_of_one_period(x: Real, excited: NDArray[np.intp]) -> Trend:
    """Estimate the ramp of a single period, shape (N,), from the lines between the excited ones;
    `excited`: their numbers, rising.

    Lines below the first excited one are left out: a sweep leaks into them, where a drive moves
    most.
    """
    n = len(x)
    quiet = np.setdiff1d(np.arange(excited[0], excited[-1]), excited)
    if len(quiet) < FEWEST:
        return Trend()
    # the sum of t exp(-2 pi j k t / n) over t = 0 .. n - 1
    ramp = n / (np.exp(-2j * np.pi * quiet / n) - 1)
    power = np.vdot(ramp, ramp).real
    lines = np.fft.rfft(x)[quiet]
    slope = float(np.vdot(ramp, lines).real / power)
    rest = lines - slope * ramp
    # the quiet lines with a large ramp weigh most, and their scatter counts
    error = np.sqrt(np.sum(np.abs(ramp) ** 2 * np.abs(rest) ** 2) / 2) / power
    return Trend(slope) if abs(slope) > SURE * error else Trend()


def undo_difference(response: FrequencyResponse, rate: float) -> FrequencyResponse:
    """Return the response of a signal from that of its differences; `rate` [Hz]."""
    factor = 1 - np.exp(-1j * response.omega / rate)
    deviation = apply(lambda d: d / np.abs(factor), response.deviation)
    return replace(response, G=response.G / factor, deviation=deviation)


def describe(trend: Trend, rate: float, role: str, signal: Signal) -> str:
    """Sentence on a trend that was removed; `rate` [Hz], `role`: input or output.

    >>> describe(Trend(0.005), 1000.0, "output", Signal("angle", "rad"))
    'output angle [rad] drifts by 5 rad/s; the drift is subtracted (--read trend=keep keeps it)'
    """
    middle, half = trend.slope * rate, trend.change * rate / 2
    value = f"{middle:.3g}" if not trend.change else f"{middle - half:.3g} to {middle + half:.3g}"
    return (
        f"{f'{role} {signal}'.strip()} drifts by {value} {_per_second(signal.unit)}; the drift is"
        " subtracted (--read trend=keep keeps it)"
    )


def _per_second(unit: str) -> str:
    """A unit per second.

    >>> [_per_second(unit) for unit in ("rad", "rad/s", "rpm", "")]
    ['rad/s', 'rad/s^2', 'rpm per s', 'per second']
    """
    if unit.endswith("/s"):
        return f"{unit}^2"
    if "/" in unit or unit == "rpm":
        return f"{unit} per s"
    return f"{unit}/s" if unit else "per second"
