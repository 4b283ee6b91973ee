"""Frequency response from an excitation that does not repeat: Welch's method, in open loop and in
closed loop.

Half-overlapping Hann segments give the spectra S_ab of input u, output y and reference r. In open
loop r = u. With

    G = S_ry / S_ru,
    S_vv = S_yy - 2 Re(conj(G) S_uy) + |G|^2 S_uu  (v = y - G u, what u does not explain),
    deviation = sqrt(S_vv S_rr / n_e) / |S_ru|,  n_e = n_d / (1 + 2/36),

for n_d segments; 1/36 is the squared correlation of neighbouring segments (Welch 1967). A Hann
window correlates the errors of neighbouring lines by 4/9, of next ones by 1/36: every second line
is taken, which holds as much information as all. For r = u this is the H1 estimator with

    deviation = |G| sqrt((1 - gamma^2) / (gamma^2 n_e))

(Bendat and Piersol, Random Data, 4th ed. 2010, section 9.2, for the complex number). In closed loop
u holds the noise that the controller feeds back; H1 is then biased, up to -1/controller
(`feedback_in_noise` estimates by how much, which is added to the squared deviation), while r, which
knows no noise, gives G free of bias (joint input-output method: Ljung, System Identification, 2nd
ed. 1999, section 13.5). The coherence is gamma^2 = |S_uy|^2 / (S_uu S_yy) in open loop, the smaller
one of those of r with u and with y in closed loop. Without any relation, gamma^2 exceeds 1 - p^(1 /
(n_e - 1)) with probability p; lines below that carry no information and are omitted.

A segment of N samples smooths G over the squared main lobe of its window, of variance 4/3
(pi rate/N)^2, so that G is wrong by

    bias = G'' 2/3 (pi rate/N)^2 = (G_{k+1} - 2 G_k + G_{k-1}) / 6,

of which chance makes 2.5/36 deviation^2. It has a sign, a resonance looks damped more than it is,
so it is taken out, by the share w = 1 - `SURE` 2.5/36 deviation^2 / |bias|^2 of it, if positive;
the squared deviation is 1 + 0.44 w^2 times as large then. What is left of it beyond chance, and the
bias of what was taken out by the same formula, are added to the squared deviation. It is reported
where the bias is more than the deviation and than chance makes of any line (level `CHANCE`). A fit
does not need this: it compares its models through the same window (`window`), in open loop and
where the input does not repeat itself, so that its lines are not isolated.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from disting.errors import InputError, short
from disting.measurement.arrays import Complex, Real
from disting.measurement.feedback_in_noise import NoiseLoop
from disting.measurement.observation import Window
from disting.measurement.periodic import detected_period, refuse_few
from disting.measurement.response import FrequencyResponse, Method
from disting.model.presentation import plural

FEWEST_SEGMENTS = 4
CHANCE = 1e-3  # p of the module's text
# of the squared deviation, by what a correction adds: (4/3)^2 + 2/6^2 - 8/9 4/9 - 1
GROWTH = 0.44
TINY = np.finfo(float).tiny
SURE = 2.0  # times what chance makes: below that no bias is taken out
REPEATED = 20  # segments within which an input that repeats is no noise
SEEN = " (a fit of chains sees its models through the same window instead)"
CURVED = 2.5  # squared second difference of lines that chance makes, in squared deviations


def estimate(
    u: Real,
    y: Real,
    rate: float,
    segment: int,
    band: tuple[float, float] | None,
    reference: Real | None = None,
    least_coherence: float | None = None,
    order: int = 2,
    loop: NoiseLoop | None = None,
) -> FrequencyResponse:
    """Response at the even multiples of rate/segment [Hz] within `band` [Hz], without 0 Hz and half
    the sampling rate.

    Lines of a coherence below `least_coherence` are left out (default: that of chance). `order` of
    the sensor (2: acceleration); `loop`: the closed loop that the record shows.
    """
    count, (low, high) = _segments(len(u), segment), band or (0.0, np.inf)
    grid = np.fft.rfftfreq(segment, 1 / rate).astype(np.float64)
    kept = (grid > 0) & (grid < rate / 2) & (grid >= low) & (grid <= high)
    uu, yy, uy, rr, ru, ry = _spectra(u, y, reference, rate, segment, kept)
    response, effective = ry / ru, count / (1 + 2 / 36)
    unexplained = np.maximum(yy - 2 * (response.conj() * uy).real + np.abs(response) ** 2 * uu, 0.0)
    deviation = np.sqrt(unexplained * rr / effective) / np.abs(ru)
    coherence = np.minimum(np.abs(ru) ** 2 / (rr * uu), np.abs(ry) ** 2 / (rr * yy))
    level = 1 - CHANCE ** (1 / (effective - 1)) if least_coherence is None else least_coherence
    lines = grid[kept]
    even = np.rint(lines * segment / rate) % 2 == 0
    good = even & (coherence >= level)
    out = [] if good[even].all() else [_left_out(lines[even], good[even], level)]
    notes = [f"Welch's method: {count} half-overlapping Hann segments of {segment} samples", *out]
    refuse_few(lines[good], notes, band)
    bias, whole, beyond = _bias(response, deviation)
    fed_back = np.zeros_like(lines) if loop is None else loop.bias(2 * np.pi * lines / rate)
    alone = deviation / np.abs(response)
    deviation, whole = (np.hypot(d, fed_back * np.abs(response)) for d in (deviation, whole))
    smooth = reference is None and not _repeats(u, segment)
    size, made = np.abs(response)[good], (response - bias)[good]
    ratio, share = response[good] / made, (deviation / np.maximum(whole, TINY))[good]
    relative = beyond[good] / size, alone[good]
    return FrequencyResponse(
        omega=2 * np.pi * lines[good],
        G=made,
        deviation=whole[good],
        coherence=np.clip(coherence, 0.0, 1.0)[good],  # 1 + rounding where nothing is noisy
        notes=tuple(notes),
        freedom=2.0 * (effective - 1),
        doubts=_report_smoothing(lines[good], *relative, segment, SEEN * smooth),
        window=Window(segment / rate, order, ratio, share) if smooth else None,
        method=Method(segment=segment, segments=count),
        loop=None if loop is None else loop.feedback(fed_back[good], alone[good]),
    )


def _spectra(
    u: Real, y: Real, reference: Real | None, rate: float, segment: int, kept: NDArray[np.bool_]
) -> tuple[Real, Real, Complex, Real, Complex, Complex]:
    """S_uu, S_yy, S_uy, S_rr, S_ru, S_ry at the lines that are kept; without a reference r is u.
    Raises InputError where one of them is silent.
    """

    def spectrum(a: Real, b: Real) -> Complex:
        """S_ab."""
        return _cross_spectrum(a, b, rate, segment)[kept]

    uu, yy, uy = spectrum(u, u).real, spectrum(y, y).real, spectrum(u, y)
    rr, ru, ry = uu, uu.astype(np.complex128), uy
    if reference is not None:
        rr, ru, ry = spectrum(reference, reference).real, *(spectrum(reference, x) for x in (u, y))
    _refuse_silent(uu, yy, rr, ru)
    return uu, yy, uy, rr, ru, ry


def _refuse_silent(*powers: np.ndarray[Any, Any]) -> None:
    if any(np.any(np.abs(power) <= 0) for power in powers):
        raise InputError(
            "input or output has no power at a frequency of the band; give band=(low, high) [Hz] of"
            " the excitation"
        )


def _repeats(u: Real, segment: int) -> bool:
    """Return True if an input repeats within a few segments: then its lines are separate, and no
    window smooths them as it does noise.
    """
    try:
        return detected_period(u) <= REPEATED * segment
    except InputError:
        return False


def _bias(response: Complex, deviation: Real) -> tuple[Complex, Real, Real]:
    """Of each line, shape (n_f,) each: the bias that is taken out, the deviation then, and how far
    the bias is beyond chance.
    """
    curved, chance = _second_differences(response), CURVED * deviation**2
    beyond = np.sqrt(np.maximum(np.abs(curved) ** 2 - chance, 0.0)) / 6
    share = np.maximum(1 - SURE * chance / np.maximum(np.abs(curved) ** 2, TINY), 0.0)
    bias = share * curved / 6
    left = np.hypot(np.maximum(beyond - np.abs(bias), 0.0), np.abs(_second_differences(bias)) / 6)
    return bias, np.hypot(deviation * np.sqrt(1 + GROWTH * share**2), left), beyond


def _second_differences(values: Complex) -> Complex:
    """Second differences, shape (n_f,), at the ends those of the next line."""
    if len(values) < 3:
        return np.zeros_like(values)
    return np.pad(np.diff(values, 2), 1, mode="edge")


def _report_smoothing(
    grid: Real, bias: Real, deviation: Real, segment: int, but: str
) -> tuple[str, ...]:
    """Where segments are too short for the response, by relative bias and deviation of the lines,
    shape (n_f,) each; `but`: what a fit does.
    """
    wide = bias > np.sqrt(CURVED / 36 * np.log(max(len(bias), 1) / CHANCE) + 1) * deviation
    if not wide.any():
        return ()
    worst = int(np.argmax(np.where(wide, bias, 0.0)))
    lines = plural(int(np.count_nonzero(wide)), "line")
    return (
        f"segments of {segment} samples smooth the response at {lines}, by"
        f" {100 * bias[worst]:.2g} % at {grid[worst]:.4g} Hz: what neighbouring lines tell of it is"
        f" taken out, the rest counts as scatter{but}; longer segments, such as --read"
        f" segment={2 * segment}, or a periodic excitation tell more",
    )


def _cross_spectrum(a: Real, b: Real, rate: float, segment: int) -> Complex:
    """S_ab by Welch's method, shape (n_f,), at all multiples of rate/segment."""
    from scipy.signal import csd

    options = {
        "fs": rate,
        "window": "hann",
        "nperseg": segment,
        "noverlap": segment // 2,
        "detrend": "constant",
    }
    return np.asarray(csd(a, b, **options)[1])


def _left_out(grid: Real, good: np.ndarray[tuple[int], np.dtype[np.bool_]], level: float) -> str:
    """Sentence on the number of lines without information, and on the range of the others."""
    if not good.any():
        return f"all {len(grid)} lines left out: their coherence is below {level:.2g}"
    most = np.quantile(grid[good], [0.05, 0.95])
    return (
        f"{np.count_nonzero(~good)} of {len(grid)} lines left out, as their coherence is below"
        f" {level:.2g}; nine tenths of the others lie within {most[0]:.3g} to {most[1]:.3g} Hz"
    )


def _segments(length: int, segment: int) -> int:
    if isinstance(segment, bool) or not isinstance(segment, int | np.integer) or segment < 8:
        raise InputError(f"segment is a whole number of at least 8 samples, not {short(segment)}")
    count = (length - segment // 2) // (segment - segment // 2)
    if count < FEWEST_SEGMENTS:
        raise InputError(
            f"{length} samples hold {max(count, 0)} half-overlapping segments of {segment};"
            f" {FEWEST_SEGMENTS} are needed"
        )
    return count
