"""Repeated measurements of one response: their mean, its standard deviation from their scatter,
and whether signs agree.

Which of several measurements of one response do not belong to the others.

With n measurements G_i of a line, noise of one variance and the others' mean and variance,

    F = |G_i - mean_{j != i} G_j|^2 (n - 1)/n / s_i^2,
    s_i^2 = sum_{j != i} |G_j - mean_{j != i} G_j|^2 / (n - 2)

has 2 and 2 (n - 2) degrees of freedom, so that -ln p = (n - 2) ln (1 + F/(n - 2)) is exponential
with mean 1. Few measurements know their variance badly: s_i^2 is not taken below its mean over the
`BESIDE` lines on each side, and n - 2 not below half of their number. A line of a measurement is
named where p times the number of all of them is below `LEVEL`, which is far out, since machines
repeat themselves less well than noise does; a whole measurement where its lines are that unlikely
on average and `ALONE` times as unlikely as those of any other. Two measurements do not show which
of them is the outlier.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import uniform_filter1d

from disting.errors import InputError, enumeration, short
from disting.measurement.arrays import Complex, Real, nearest
from disting.measurement.distortion import from_realisations
from disting.measurement.feedback import Feedback
from disting.measurement.response import FrequencyResponse

CHOICES = ("keep", "drop")
LEVEL = 1e-6  # chance of naming one where there is none, if noise is all
LEAST = 3  # measurements: fewer do not tell which one is wrong
BESIDE = 5  # lines on each side
UNLIKELY = (
    3.0  # mean of -ln p over the lines of a measurement that is named as a whole, 1 by chance
)
ALONE = 3.0
NAMED = 3  # frequencies of a measurement in a sentence
Mask = NDArray[np.bool_]
NEAR = 0.02  # relative distance of two frequencies at which a phase is compared
# mean cosine of the phase between responses of opposite sign: most lines are turned by more than
# 120 degrees
AGAINST = -0.5
SAME = 1e-6  # relative distance of two frequencies that count as one


def find_outliers(values: Complex) -> Mask:
    """Flag the outliers among n measurements at each line, shape (n, n_f) as `values`."""
    n, lines = values.shape
    if n < LEAST or not lines:
        return np.zeros((n, lines), dtype=np.bool_)
    surprise = np.stack([_surprise(values, i) for i in range(n)])
    single = surprise > np.log(n * lines / LEVEL)
    rest = np.ma.masked_array(surprise, single).mean(axis=1).filled(0.0)
    second = np.sort(rest)[-2]
    whole = (rest > UNLIKELY) & (rest > ALONE * second)
    return np.asarray(single | whole[:, None])


def leave_out(
    values: Complex, names: Sequence[str], omega: Real, outliers: str
) -> tuple[Mask, tuple[str, ...], tuple[str, ...]]:
    """Select what is averaged of n measurements, shape (n, n_f), with notes and doubts about
    outliers among them. `outliers`: "keep" names them, "drop" leaves them out where at least two
    others are left. Raises InputError for another choice.
    """
    if outliers not in CHOICES:
        raise InputError(f"--outliers is {' or '.join(CHOICES)}, not {short(outliers)}")
    the_values = find_outliers(values)
    kept, places = np.ones_like(the_values), [_where(row, omega) for row in the_values]
    named = [f"{name} at {at}" for name, at in zip(names, places, strict=True) if at]
    if not named:
        return kept, (), ()
    if outliers == "drop":
        enough = len(values) - the_values.sum(axis=0) >= LEAST - 1
        note = f"left out, as no other measurement is like it: {enumeration(named)}"
        return ~(the_values & enough), (note,), ()
    return (
        kept,
        (),
        (
            f"{enumeration(named)}: not like the other measurements, by more than they scatter; it"
            " is in the mean: look at it, or leave it out with --outliers drop",
        ),
    )


def _surprise(values: Complex, i: int) -> Real:
    """-ln p of each line of a measurement, shape (n_f,)."""
    n, rest = len(values), np.delete(values, i, axis=0)
    apart = np.abs(values[i] - rest.mean(axis=0)) ** 2 * (n - 1) / n
    own = np.sum(np.abs(rest - rest.mean(axis=0)) ** 2, axis=0) / (n - 2)
    near = uniform_filter1d(own, 2 * BESIDE + 1, mode="nearest")
    scatter, freedom = np.maximum(own, near), max(n - 2, BESIDE + 1)
    alone = np.where(apart > 0, np.inf, 0.0)  # among equal numbers, which scatter by nothing
    ratio = np.divide(apart, scatter, out=alone, where=scatter > 0)
    return np.asarray(freedom * np.log1p(ratio / freedom))


def _where(row: Mask, omega: Real) -> str:
    """The frequencies of the lines that are named."""
    hertz = omega[row] / (2 * np.pi)
    if not len(hertz):
        return ""
    if len(hertz) == len(row):
        return "all lines"
    more = f" and {len(hertz) - NAMED} more lines" if len(hertz) > NAMED else ""
    return f"{', '.join(f'{f:.4g}' for f in hertz[:NAMED])} Hz{more}"


def mean_of(repeats: Sequence[FrequencyResponse], *, outliers: str = "keep") -> FrequencyResponse:
    """Mean of n responses at the same frequencies, with deviation = sqrt(sum |G_i - G|^2 / (n - 1)
    / n), that of the mean. `outliers` among three or more are named; "drop" leaves them out
    (`outliers.leave_out`).

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
    values = np.stack([response.G for response in repeats])
    names = [response.origin or f"repeat {i}" for i, response in enumerate(repeats, 1)]
    kept, notes, outlying = leave_out(values, names, first.omega, outliers)
    count = kept.sum(axis=0)
    deviation = np.std(values, axis=0, ddof=1, where=kept) / np.sqrt(count)
    mean = replace(
        first,
        G=values.mean(axis=0, where=kept),
        deviation=deviation,
        coherence=None,
        window=None,
        freedom=2.0 * (int(count.min()) - 1),
        loop=_loop_of(repeats, deviation),
        nonlinear=None,
    )
    mean = _with_distortion(mean, repeats, kept)
    relative = float(np.median(deviation * np.sqrt(count) / np.abs(mean.G)))
    own_notes = dict.fromkeys(note for response in repeats for note in response.notes)
    doubts = [*(doubt for response in repeats for doubt in response.doubts), *outlying]
    if len(set(repeats)) < n:
        doubts.append("some repeats are the same numbers: they scatter less than the machine does")
    return (
        replace(mean, notes=tuple(own_notes))
        .noted(
            f"mean of {n} repeats, which scatter by {100 * relative:.2g} % (median of the lines)",
            *notes,
        )
        .doubted(*doubts)
    )


def _loop_of(repeats: Sequence[FrequencyResponse], deviation: Real) -> Feedback | None:
    """Return the loop of the first repeat that shows one, with the scatter of the mean."""
    for response in repeats:
        if response.loop is not None:
            return replace(response.loop, scatter=deviation / np.abs(response.G))
    return None


def _with_distortion(
    mean: FrequencyResponse, repeats: Sequence[FrequencyResponse], kept: Mask
) -> FrequencyResponse:
    """The mean with the distortion that realisations of the phases show by their scatter, else
    with that which all repeats of one excitation have in common.
    """
    known = [(r.noise, r.freedom) for r in repeats if r.noise is not None and r.freedom]
    total = mean.deviation
    if total is None or len(known) < len(repeats):
        return mean
    squares = np.stack([noise**2 for noise, _ in known])
    noise = np.sqrt(np.sum(squares, axis=0, where=kept)) / kept.sum(axis=0)
    freedom = sum(nu for _, nu in known if nu)
    nonlinear = from_realisations(total, noise, mean.omega, mean.G, (mean.freedom or 0.0, freedom))
    if nonlinear is not None:
        deviation = np.hypot(noise, nonlinear)
        return replace(mean, deviation=deviation, nonlinear=nonlinear, freedom=freedom)
    common = [response.nonlinear for response in repeats]
    parts = [np.zeros(len(mean)) if x is None else x for x in common]
    if not np.any(parts):
        return mean
    nonlinear = np.sqrt(np.mean(np.square(parts), axis=0))
    return replace(mean, deviation=np.hypot(total, nonlinear), nonlinear=nonlinear)


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


def are_opposite(response: FrequencyResponse, other: FrequencyResponse) -> bool:
    """Return True if two responses of one machine have opposite signs: at most frequencies that
    they share, the phase is reversed.

    >>> from disting.measurement import from_arrays
    >>> one, other = (from_arrays(range(1, 9), [x * 1j, x] * 4) for x in (2, -2))
    >>> are_opposite(one, other)
    True
    """
    at = nearest(response.omega, other.omega)
    near = np.abs(response.omega[at] - other.omega) <= NEAR * other.omega
    turned = np.angle(other.G[near]) - np.angle(response.G[at[near]])
    return bool(len(turned) and np.mean(np.cos(turned)) < AGAINST)
