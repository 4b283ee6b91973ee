"""Repeated measurements of one response: their mean, its standard deviation from their scatter,
and whether signs agree.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from disting.errors import InputError
from disting.measurement.arrays import nearest
from disting.measurement.outliers import left_out
from disting.measurement.response import FrequencyResponse

NEAR = 0.02  # relative distance of two frequencies at which a phase is compared
# mean cosine of the phase between responses of opposite sign: most lines are turned by more than
# 120 degrees
AGAINST = -0.5
SAME = 1e-6  # relative distance of two frequencies that count as one


def mean_of(repeats: Sequence[FrequencyResponse], *, outliers: str = "keep") -> FrequencyResponse:
    """Mean of n responses at the same frequencies, with deviation = sqrt(sum |G_i - G|^2 / (n - 1)
    / n), that of the mean. `outliers` among three or more are named; "drop" leaves them out
    (`outliers.left_out`).

    Raises InputError where frequencies or sensor quantities differ.

    >>> from disting.measurement import from_arrays
    >>> mean = mean_of([from_arrays(range(1, 9), [x, x + 1j] * 4) for x in (1.0, 3.0)])
    >>> mean.G.real[:2].tolist(), mean.deviation[:2].round(6).tolist()
    ([2.0, 2.0], [1.0, 1.0])
    """
    first, n = repeats[0], len(repeats)
    for other in repeats[1:]:
        _check_alike(first, other)
    if n == 1:
        return first
    values = np.stack([one.G for one in repeats])
    names = [one.origin or f"repeat {i}" for i, one in enumerate(repeats, 1)]
    kept, notes, outlying = left_out(values, names, first.omega, outliers)
    count = kept.sum(axis=0)
    deviation = np.std(values, axis=0, ddof=1, where=kept) / np.sqrt(count)
    mean = replace(
        first,
        G=values.mean(axis=0, where=kept),
        deviation=deviation,
        coherence=None,
        window=None,
        freedom=2.0 * (int(count.min()) - 1),
    )
    relative = float(np.median(deviation * np.sqrt(count) / np.abs(mean.G)))
    said = dict.fromkeys(note for one in repeats for note in one.notes)
    doubts = [*(doubt for one in repeats for doubt in one.doubts), *outlying]
    if len(set(repeats)) < n:
        doubts.append("some repeats are the same numbers: they scatter less than the machine does")
    return (
        replace(mean, notes=tuple(said))
        .noted(
            f"mean of {n} repeats, which scatter by {100 * relative:.2g} % (median of the lines)",
            *notes,
        )
        .doubted(*doubts)
    )


def _check_alike(first: FrequencyResponse, other: FrequencyResponse) -> None:
    if other.sensor is not first.sensor:
        raise InputError(
            f"repeats show {first.sensor.value} and {other.sensor.value}; give responses of one"
            " quantity"
        )
    if len(other) != len(first) or np.any(np.abs(other.omega - first.omega) > SAME * first.omega):
        raise InputError(
            f"{other.origin or 'a repeat'} has other frequencies than"
            f" {first.origin or 'the first'}; repeats share them"
        )


def are_opposite(one: FrequencyResponse, other: FrequencyResponse) -> bool:
    """Whether two responses of one machine have opposite signs: at most frequencies that they
    share, the phase is reversed.

    >>> from disting.measurement import from_arrays
    >>> one, other = (from_arrays(range(1, 9), [x * 1j, x] * 4) for x in (2, -2))
    >>> are_opposite(one, other)
    True
    """
    at = nearest(one.omega, other.omega)
    near = np.abs(one.omega[at] - other.omega) <= NEAR * other.omega
    turned = np.angle(other.G[near]) - np.angle(one.G[at[near]])
    return bool(len(turned) and np.mean(np.cos(turned)) < AGAINST)
