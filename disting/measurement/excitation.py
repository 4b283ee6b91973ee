"""The excitation of a record, and how a response was estimated from it.

A sweep visits one frequency after the other, a multisine and noise excite all of them all the time.
The input is cut into `PIECES` pieces; with P_i(f) the power of piece i at the frequency f, mean and
variance of ln f weighted by P_i are m_i and v_i. Of the whole variance

    V = mean_i v_i + var_i m_i        (means over pieces, weighted by their power)

a sweep has nearly all in var_i m_i, since each piece is narrow; a multisine or noise has hardly
anything there. Above the share `MOVING` the input counts as a sweep. A multisine may have phases
that make it move like a sweep (M. Schroeder, Synthesis of low-peak-factor signals, 1970). Its lines
have clear edges: the weakest of them is `CLEAR` times as large as the strongest line next to them,
whereas the spectrum of a sweep fades out.

"random" is the rest: neither periodic nor a sweep.
"""

from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

from disting.errors import InputError
from disting.measurement.arrays import Real
from disting.measurement.checks import FEWEST
from disting.measurement.periodic import detected_period, excited_lines

PIECES = 16
MOVING = 0.5  # share of the variance of ln f
CLEAR = 3.0  # ratio of amplitudes
SHORTEST = 32  # samples of a piece
OUTSIDE = 0.01  # share of the power below and above the band of a random input


class Excitation(StrEnum):
    """Kind of an input."""

    MULTISINE = "multisine"
    SWEEP = "sweep"
    PERIODIC = "periodic"
    RANDOM = "random"


@dataclass(frozen=True, slots=True)
class InputBand:
    """The excitation of a record: its kind, the number of its lines (0 where it has none) and its
    band [Hz]; `period` [samples], 0 for none.
    """

    kind: Excitation
    lines: int
    low: float
    high: float
    period: int


def excitation(u: Real, rate: float, period: int | None = None) -> InputBand:
    """Return what the input of a record, shape (n,) at `rate` [Hz], excites; `period` [samples]
    where it is known, else it is searched.

    >>> t = np.arange(4000) / 1000
    >>> found = excitation(sum(np.sin(2 * np.pi * f * t + f * f) for f in range(5, 50)), 1000.0)
    >>> found.kind.value, found.lines, round(found.low, 6), round(found.high, 6), found.period
    ('multisine', 45, 5.0, 49.0, 1000)
    """
    length = _period(u) if period is None else period
    is_sweep = moving_share(u[: length or len(u)]) > MOVING
    if not length or len(u) < length:
        kind = Excitation.SWEEP if is_sweep else Excitation.RANDOM
        return InputBand(kind, 0, *_band(u, rate), 0)
    whole = u[len(u) % length :].reshape(-1, length)
    amplitude = np.abs(np.fft.rfft(whole, axis=1).mean(axis=0))
    lines = excited_lines(amplitude)
    kind = Excitation.SWEEP if is_sweep else Excitation.MULTISINE
    if len(lines) < FEWEST:
        kind = Excitation.PERIODIC
    elif is_sweep and _edge(amplitude, lines) >= CLEAR:
        kind = Excitation.MULTISINE
    hertz = lines * rate / length
    return InputBand(kind, len(lines), float(hertz[0]), float(hertz[-1]), length)


def _edge(amplitude: Real, lines: NDArray[np.intp]) -> float:
    """Weakest of the excited lines divided by the strongest of the others."""
    others = np.delete(amplitude[:-1], np.concatenate([[0], lines]))
    return float(amplitude[lines].min() / max(others.max(initial=0.0), np.finfo(float).tiny))


def moving_share(u: Real) -> float:
    """Return the share of the variance of ln f that lies between pieces of the input, 0..1; 0 for
    an input that is too short.
    """
    size = len(u) // PIECES
    if size < SHORTEST:
        return 0.0
    pieces = (u - u.mean())[: PIECES * size].reshape(PIECES, size) * np.hanning(size)
    power = np.abs(np.fft.rfft(pieces, axis=1)[:, 1:]) ** 2
    logarithm = np.log(np.arange(1, power.shape[1] + 1))
    weights = power.sum(axis=1)
    if not weights.sum() > 0:
        return 0.0
    shares = power / np.where(weights > 0, weights, 1.0)[:, None]
    means = shares @ logarithm
    inside = float(np.average(shares @ logarithm**2 - means**2, weights=weights))
    between = float(np.average((means - np.average(means, weights=weights)) ** 2, weights=weights))
    return between / (inside + between) if inside + between > 0 else 0.0


def _period(u: Real) -> int:
    """Period [samples], 0 for an input that does not repeat itself."""
    try:
        return detected_period(u)
    except InputError:
        return 0


def _band(u: Real, rate: float) -> tuple[float, float]:
    """Frequencies [Hz] between which all power of the input lies but `OUTSIDE` on either side."""
    power = np.cumsum(np.abs(np.fft.rfft(u - u.mean())[1:]) ** 2)
    places = np.searchsorted(power / power[-1], (OUTSIDE, 1 - OUTSIDE))
    low, high = (places + 1) * rate / len(u)
    return float(low), float(high)
