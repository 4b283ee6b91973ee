"""Frequency response from an excitation that does not repeat: Welch's method with the H1 estimator.

Half-overlapping Hann segments: G = S_uy / S_uu, coherence gamma^2 = |S_uy|^2 / (S_uu S_yy), and, with n_d segments,

    deviation = |G| sqrt((1 - gamma^2) / (gamma^2 n_e)),      n_e = n_d / (1 + 2/36)

(Bendat and Piersol, Random Data, 4th ed. 2010, section 9.2: sqrt((1 - gamma^2) / (2 gamma^2 n_e)) for each of the real and the
imaginary part, so sqrt 2 times that for the complex number). 1/36 is the squared correlation of neighbouring segments (Welch
1967). H1 is free of bias from noise on the output; noise on the input makes |G| too small by the factor 1 - noise share.
"""

import numpy as np

from disting.errors import InputError, shown
from disting.measurement.arrays import Real
from disting.measurement.periodic import Estimated

FEWEST_SEGMENTS = 4


def estimate(u: Real, y: Real, rate: float, segment: int, band: tuple[float, float] | None) -> Estimated:
    """Estimate at the multiples of rate/segment [Hz] within `band` [Hz], without 0 Hz and half the sampling rate."""
    from scipy.signal import csd, welch

    count = _segments(len(u), segment)
    options = {"fs": rate, "window": "hann", "nperseg": segment, "noverlap": segment // 2, "detrend": "constant"}
    frequency, crossed = csd(u, y, **options)
    power, outputs = welch(u, **options)[1], welch(y, **options)[1]
    low, high = band or (0.0, np.inf)
    kept = (frequency > 0) & (frequency < rate / 2) & (frequency >= low) & (frequency <= high)
    crossed, power, outputs = crossed[kept], power[kept], outputs[kept]
    if np.any(power <= 0) or np.any(outputs <= 0):
        raise InputError(
            "input or output has no power at a frequency of the band; give band=(low, high) [Hz] of the excitation"
        )
    response = crossed / power
    coherence = np.clip(np.abs(crossed) ** 2 / (power * outputs), 0.0, 1.0)
    with np.errstate(divide="ignore"):
        deviation = np.abs(response) * np.sqrt((1 - coherence) / coherence * (1 + 2 / 36) / count)
    note = f"Welch's method: {count} half-overlapping Hann segments of {segment} samples"
    return Estimated(2 * np.pi * frequency[kept], response, deviation, coherence, (note,))


def _segments(length: int, segment: int) -> int:
    if isinstance(segment, bool) or not isinstance(segment, int | np.integer) or segment < 8:
        raise InputError(f"segment is a whole number of at least 8 samples, not {shown(segment)}")
    count = (length - segment // 2) // (segment - segment // 2)
    if count < FEWEST_SEGMENTS:
        raise InputError(
            f"{length} samples hold {max(count, 0)} half-overlapping segments of {segment}; {FEWEST_SEGMENTS} are needed"
        )
    return count
