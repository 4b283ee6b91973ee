"""Frequency response from a periodic excitation (Pintelon and Schoukens, System Identification,
2nd ed. 2012, chapter 2).

The record is cut into P whole periods of N samples, which have no leakage. With U_p, Y_p the
discrete Fourier transforms of period p, at every excited line

    G         = mean_p(Y_p) / mean_p(U_p)
    deviation = sqrt( sum_p |Y_p/U_p - mean(Y_p/U_p)|^2 / (P - 1) / P )
    coherence = |sum_p Y_p conj(U_p)|^2 / (sum_p |U_p|^2 sum_p |Y_p|^2).

Noise that does not repeat averages out; the deviation is that of the mean of P periods. Trends of
input and output are removed before (`trend`).

An output that wanders, as the position of a free drive does under random torque, ends a period
elsewhere than it began, and that jump leaks into all lines. The differences z(t) = x(t) - x(t - 1)
hardly jump, and X = Z / (1 - exp(-j omega / rate)) exactly for a periodic x. But they add the noise
of single samples to low lines. So the spectra of the differences are taken where they scatter less.

Whether the first of two periods holds a transient.

What repeats is not in the difference of two periods: noise of both is, and a transient, which
decays. The difference is cut into parts, each under a Hann window, as it may jump at its ends, and
the power of each octave in the first part is compared with that in the second half. Noise has the
same power everywhere, a transient most at first. One that is too small to be detected is covered by
the scatter: it shifts the mean of both periods by half of its spectrum, which is the standard
deviation that two periods show at that line.

The ratio of both powers of noise has the F distribution with nu and PARTS / 2 nu degrees of
freedom. Noise of the spectrum P has nu = 2 / 1.5 (sum P)^2 / sum P^2 in a part (Welch and
Satterthwaite; 1.5 is the noise bandwidth of the window in lines).
"""

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from disting.errors import InputError, short
from disting.measurement.arrays import Complex, Real, real
from disting.measurement.checks import FEWEST
from disting.measurement.distortion import Distortion, distortion, from_unexcited
from disting.measurement.feedback import Feedback, feedback_in_periods
from disting.measurement.repeats import leave_out
from disting.measurement.response import FrequencyResponse, Method
from disting.measurement.trend import Trend, trend_between_periods, trend_of_one_period
from disting.model.presentation import plural

PARTS = 8
LEVEL = 0.01  # of a false alarm, over all octaves: it drops a period that could be kept
BANDWIDTH = 1.5  # of noise, of a Hann window [lines]
FEWEST_OF_A_PART = 4  # lines of a part, below which it has no octaves


def holds_transient(first: Real, second: Real) -> bool:
    """Return True if the first of two periods, shape (N,), differs from the second one by what
    decays; also for periods too short to show it.

    >>> time = np.arange(1000)
    >>> noise = np.random.default_rng(0).normal(size=(2, 1000))
    >>> holds_transient(*noise), holds_transient(noise[0] + 5 * np.exp(-time / 100), noise[1])
    (False, True)
    """
    from scipy.special import fdtri

    d = _level(first - second)
    size = len(d) // PARTS
    window = np.hanning(size + 1)[:-1]
    power = np.abs(np.fft.rfft(d[: PARTS * size].reshape(PARTS, size) * window, axis=1)) ** 2
    octaves = _octaves(power.shape[1])
    if not octaves:
        return True
    tests = [_test(power[:, low:high]) for low, high in octaves]
    return any(r > fdtri(nu, PARTS / 2 * nu, 1 - LEVEL / len(tests)) for r, nu in tests)


def _level(d: Real) -> Real:
    """The difference without its constant part and slope, which are a trend's."""
    time = np.linspace(-1.0, 1.0, len(d))
    return np.asarray(d - d.mean() - time * (time @ d) / (time @ time))


def _octaves(count: int) -> list[tuple[int, int]]:
    """First line and the one after the last of octaves, from the highest one downwards."""
    edges = [count] if count > FEWEST_OF_A_PART else []
    while edges and edges[-1] > 1:
        edges.append(edges[-1] // 2)
    return list(zip(edges[1:], edges, strict=False))


def _test(power: Real) -> tuple[float, float]:
    """Power of the first part over the mean of the second half, shape (PARTS, lines), and the
    degrees of freedom of one part; 0 where there is no power.
    """
    rest = power[PARTS // 2 :].mean(axis=0)
    if not np.any(rest):
        return 0.0, 1.0
    nu = 2 / BANDWIDTH * rest.sum() ** 2 / (rest**2).sum()
    return float(power[0].sum() / rest.sum()), max(float(nu), 1.0)


WEAKEST = 0.01  # share of the largest amplitude below which no line counts as excited
# correlation of the input with itself, one period later, from which on it counts as periodic
LIKENESS = 0.9
FALLEN = 0.5  # a correlation has to fall below this before it can rise again to a period
# a shorter period may raise the share of noise, 1 - correlation, by this much of itself
EXCESS = 0.5
SURE = 5.0  # standard errors from which on one spectrum scatters less than another by no chance
ROUNDING = 1e-9  # of a correlation computed by fast Fourier transforms
Detrend = tuple[Callable[[Trend], str], Callable[[Trend], str]]
"""Sentences on a trend that was removed from the input and from the output."""
WANDERING = (
    "the output drifts irregularly: the response is computed from its differences from sample to"
    " sample; with --read trend=keep from the output itself"
)
PAIR = 2  # periods of which the first one is kept where it shows no transient
DECAYS = (
    "the first of two periods is dropped: its difference from the second one decays, so it"
    " contains a transient; --read transient=0 keeps it"
)
SETTLED = "both periods are used: the first one shows no transient; --read transient=1 drops it"
OFF_GRID = 1e-3  # of the line spacing, by which a given frequency may miss its line


def estimate(
    u: Real,
    y: Real,
    rate: float,
    period: int | None,
    transient: int | None,
    lines: Any,
    band: tuple[float, float] | None,
    excitation: Real,
    outliers: str = "keep",
    detrend: Detrend | None = None,
) -> FrequencyResponse:
    """Response at the excited lines; `rate` [Hz], `period` [samples], `lines` and `band` [Hz];
    `excitation` = u or a reference; `transient` = periods dropped at the beginning (None: the
    first one, of two periods only if it shows a transient); `outliers` among the periods as in
    `repeats.mean_of`; `detrend`: describes a trend of input or output, None to keep trends.

    Means over periods forget the noise that a controller feeds back, so G holds in closed loop as
    well, but where noise is as strong as the excitation: `feedback`.
    """
    length = detected_period(excitation) if period is None else _whole(period, "period", 2)
    detected = f"period of {length} samples ({length / rate:g} s) detected in the input"
    notes = [detected] if period is None else []
    transient, note = _drop_transient(transient, y, length)
    notes += [note] if note else []
    start, whole = transient * length, y
    u, y, excitation = (_whole_periods(x, length, transient) for x in (u, y, excitation))
    before = float(whole[start - 1]) if start else None
    exciting = _spectra(excitation, length)
    spacing = rate / length
    if lines is None:
        chosen = _detect_lines(exciting, length)
        notes.append(f"{len(chosen)} excited lines detected in the input")
    else:
        chosen = _check_lines(lines, spacing, exciting.shape[1])
    removed = list[str]()
    if detrend:
        u, y, before, removed = _without_trends(u, y, before, length, chosen, detrend)
    inputs, outputs = _spectra(u, length), _spectra(y, length)
    changes = _spectra_of_changes(y, length, before)
    if detrend and changes is not None and _scatters_less(changes, outputs, inputs, chosen):
        outputs, removed = changes, [*removed, WANDERING]
    notes += removed
    between, note = distortion(inputs, outputs, chosen, 2 * np.pi * spacing)
    notes += [note] if note else []
    if band is not None:
        chosen = chosen[(chosen * spacing >= band[0]) & (chosen * spacing <= band[1])]
    if len(inputs) == 1:
        notes.append("one period alone: no standard deviation and no coherence")
    omega = np.multiply(chosen, 2 * np.pi * spacing, dtype=np.float64)
    refuse_few(omega, notes, band)
    response = _mean(inputs[:, chosen], outputs[:, chosen], omega, outliers)
    method = Method(length, len(inputs), transient, trends=tuple(removed))
    loop = _loop(inputs[:, chosen], (outputs if changes is None else changes)[:, chosen], response)
    response = replace(response, notes=(*notes, *response.notes), method=method, loop=loop)
    return _with_distortion(response, between, len(inputs))


def _spectra_of_changes(y: Real, period: int, before: float | None) -> Complex | None:
    """Spectra of whole periods from the differences of their samples, shape (P, period // 2 + 1),
    without their constant part; `before`: the sample before the first one. None for a single period
    before which nothing is known.
    """
    if before is None and len(y) < 2 * period:
        return None
    if before is None:
        before = float(y[0] - (y[period] - y[period - 1]))
    changes = _spectra(np.diff(y, prepend=before), period)
    factor = 1 - np.exp(-2j * np.pi * np.arange(changes.shape[1]) / period)
    factor[0] = np.inf
    return np.asarray(changes / factor)


def _scatters_less(
    one: Complex, other: Complex, inputs: Complex, excited: NDArray[np.intp]
) -> bool:
    """Return True if the spectra of an output scatter less than others of it, and not by chance: at
    the excited lines from period to period, of a single period at the lines between them.
    """
    if len(one) > 1:
        of = [x[:, excited] / inputs[:, excited] for x in (one, other)]
        each = [np.var(x, axis=0) for x in of]
        size = np.abs(of[1]).max(axis=0)
    else:
        quiet = np.setdiff1d(np.arange(excited[0], excited[-1]), excited)
        each = [np.abs(x[0, quiet]) ** 2 for x in (one, other)]
        size = np.abs(other[0]).max()
    known = (each[0] > 0) & (each[1] > (ROUNDING * size) ** 2)
    if known.sum() < FEWEST:
        return False
    gain = np.log(each[1][known] / each[0][known])
    return bool(gain.mean() > SURE * gain.std(ddof=1) / np.sqrt(len(gain)))


def _loop(inputs: Complex, outputs: Complex, response: FrequencyResponse) -> Feedback | None:
    if response.deviation is None:
        return None
    return feedback_in_periods(inputs, outputs, response.deviation / np.abs(response.G))


def _with_distortion(
    response: FrequencyResponse, between: Distortion | None, periods: int
) -> FrequencyResponse:
    """The same with what lines without excitation show, in its deviation too."""
    response = replace(response, distortion=between)
    nonlinear = from_unexcited(between, response.omega, response.G, periods)
    if nonlinear is None or response.deviation is None:
        return response
    return replace(response, deviation=np.hypot(response.deviation, nonlinear), nonlinear=nonlinear)


def refuse_few(omega: Real, notes: Sequence[str], band: tuple[float, float] | None) -> None:
    """Raise InputError where a method and a band leave too few lines; `notes`: how they came."""
    if len(omega) < FEWEST:
        within = [f"band {band[0]:g}..{band[1]:g} Hz"] if band else []
        raise InputError(
            f"{len(omega)} frequencies are too few, at least {FEWEST} are needed:"
            f" {'; '.join((*notes, *within))}"
        )


def detected_period(u: Real) -> int:
    """Shortest period [samples] after which the signal repeats: peak of its autocorrelation.
    Raises InputError for none.
    """
    likeness = _autocorrelation(u - u.mean())
    below = np.flatnonzero(likeness < FALLEN)
    first = int(below[0]) if below.size else len(likeness)
    best = first + int(np.argmax(likeness[first:])) if first < len(likeness) else 0
    if not best or likeness[best] < LIKENESS:
        raise InputError(
            "the input does not repeat itself, so no period was found; give --read period=SAMPLES,"
            " or, where the excitation is not periodic, --read segment=SAMPLES for Welch's method"
        )
    enough = likeness[best] - EXCESS * (1 - likeness[best]) - ROUNDING
    shorter = (round(best / parts) for parts in range(best // max(first, 1), 1, -1))
    return next((lag for lag in shorter if lag > first and likeness[lag] >= enough), best)


def excited_lines(amplitude: Real) -> np.ndarray[tuple[int], np.dtype[np.intp]]:
    """Indices of the excited lines of an amplitude spectrum, shape (n,): those above its widest
    gap.

    The amplitudes within 40 dB of the largest one are sorted; the largest ratio of two neighbours
    separates the lines of the excitation from noise and distortion. The constant part (0 Hz) and
    the last line, half the sampling rate, never count.
    """
    inner = amplitude[1:-1]
    ordered = np.sort(inner)[::-1]
    ordered = np.append(ordered[ordered > WEAKEST * ordered[0]], WEAKEST * ordered[0])
    cut = int(np.argmax(ordered[:-1] / ordered[1:]))
    return np.flatnonzero(inner >= ordered[cut]) + 1


def _autocorrelation(u: Real) -> Real:
    """Correlation coefficient of u[:-lag] and u[lag:] for lag = 0 .. n/2, by fast Fourier
    transform.
    """
    n = len(u)
    lags = np.arange(n // 2 + 1)
    products = np.fft.irfft(np.abs(np.fft.rfft(u, 2 * n)) ** 2, 2 * n)[lags]
    energy = np.concatenate([[0.0], np.cumsum(u**2)])
    power = energy[n - lags] * (energy[n] - energy[lags])
    return np.asarray(products / np.sqrt(np.where(power > 0, power, np.inf)))


def _without_trends(
    u: Real,
    y: Real,
    before: float | None,
    period: int,
    excited: NDArray[np.intp],
    detrend: Detrend,
) -> tuple[Real, Real, float | None, list[str]]:
    """Input, output and the sample before its first one without their trends, and a note on each
    trend.
    """
    several = len(y) >= 2 * period
    of_input, of_output = (
        trend_between_periods(x, period) if several else trend_of_one_period(x, excited)
        for x in (u, y)
    )
    notes = [
        describe(trend)
        for trend, describe in zip((of_input, of_output), detrend, strict=True)
        if trend
    ]
    ahead, *trend = of_output.samples(len(y), 1)
    before = None if before is None else before - ahead
    return u - of_input.samples(len(u)), y - np.array(trend), before, notes


def _drop_transient(transient: int | None, y: Real, period: int) -> tuple[int, str]:
    """Number of periods to drop at the beginning, and a note where two periods decide it."""
    if transient is not None:
        return _whole(transient, "transient", 0), ""
    if len(y) // period != PAIR:
        return 1, ""
    if holds_transient(y[:period], y[period : 2 * period]):
        return 1, DECAYS
    return 0, SETTLED


def _whole_periods(x: Real, period: int, transient: int) -> Real:
    """Samples of the whole periods after the transient."""
    count = len(x) // period - transient
    if count < 1:
        raise InputError(
            f"{len(x)} samples hold {len(x) // period} whole periods of {period} samples,"
            f" {transient} {'is' if transient == 1 else 'are'} dropped as transient: none"
            f" remains; --read transient=0 keeps all, if the first one has no transient"
        )
    start = transient * period
    return x[start : start + count * period]


def _spectra(x: Real, period: int) -> Complex:
    """Fourier transforms of the periods, shape (P, period // 2 + 1)."""
    return np.asarray(np.fft.rfft(x.reshape(-1, period), axis=1))


def _detect_lines(exciting: Complex, length: int) -> np.ndarray[tuple[int], np.dtype[np.intp]]:
    """Indices of the excited lines of the spectra of all periods; raises InputError for too few."""
    chosen = excited_lines(np.abs(exciting.mean(axis=0)))
    if len(chosen) < FEWEST:
        raise InputError(
            f"{plural(len(chosen), 'excited line')} in a period of {length} samples: too few,"
            f" at least {FEWEST} are needed; where the excitation is not a sum of sines, give"
            " --read segment=SAMPLES for Welch's method"
        )
    return chosen


def _check_lines(
    lines: Any, spacing: float, count: int
) -> np.ndarray[tuple[int], np.dtype[np.intp]]:
    wanted = real(lines, "lines") / spacing
    numbers = np.rint(wanted)
    if not np.all(np.abs(wanted - numbers) <= OFF_GRID) or not np.all(
        (numbers >= 1) & (numbers < count)
    ):
        raise InputError(
            f"excited lines are multiples of {spacing:g} Hz (one per period) up to"
            f" {(count - 1) * spacing:g} Hz"
        )
    return np.unique(numbers.astype(np.intp))


def _mean(inputs: Complex, outputs: Complex, omega: Real, outliers: str) -> FrequencyResponse:
    periods = len(inputs)
    if np.any(inputs.mean(axis=0) == 0):
        raise InputError(
            "the input is exactly zero at a chosen line; choose lines that are excited"
        )
    if periods == 1:
        alone = outputs[0] / inputs[0]
        return FrequencyResponse(omega, alone, drive=np.abs(inputs[0]))
    with np.errstate(divide="ignore", invalid="ignore"):
        each = outputs / inputs
    names = [f"period {i}" for i in range(1, periods + 1)]
    kept, notes, doubts = leave_out(each, names, omega, outliers)
    count = kept.sum(axis=0)
    mean = outputs.mean(axis=0, where=kept) / inputs.mean(axis=0, where=kept)
    deviation = np.std(each, axis=0, ddof=1, where=kept) / np.sqrt(count)
    power = np.sum(np.abs(inputs) ** 2, axis=0) * np.sum(np.abs(outputs) ** 2, axis=0)
    crossed = np.abs(np.sum(outputs * inputs.conj(), axis=0)) ** 2
    # 1 + rounding where nothing is noisy
    coherence = np.clip(crossed / np.where(power > 0, power, 1.0), 0.0, 1.0)
    return FrequencyResponse(
        omega=omega,
        G=mean,
        deviation=deviation,
        coherence=coherence,
        notes=tuple(notes),
        freedom=2.0 * (int(count.min(initial=periods)) - 1),
        drive=np.abs(inputs.mean(axis=0)),
        doubts=doubts,
    )


def _whole(value: int, name: str, least: int) -> int:
    if isinstance(value, bool) or not isinstance(value, int | np.integer) or value < least:
        raise InputError(f"{name} is a whole number of at least {least}, not {short(value)}")
    return int(value)
