"""Checks of a measured frequency response: one small function per mistake.

What makes the numbers useless raises InputError with cause and remedy. What is only suspicious
gives a sentence: the data may be right, and a person has to look.
"""

import numpy as np

from disting.errors import InputError
from disting.measurement.arrays import Complex, Real

FEWEST = 8  # lines; a two-mass model has about that many unknowns
OCTAVE = 2.0  # lines up to this multiple of the lowest frequency are the low ones
SMALLEST = 1e-300  # still has a logarithm and an inverse
LARGEST_RADIAN = 4 * np.pi  # a phase beyond it is hardly given in radians
# a response whose phase stays within that many degrees would be a pure gain
LARGEST_SMALL_DEGREE = 7.0


def lengths(omega: Real, **columns: Real | Complex | None) -> None:
    """Every column has one value a frequency."""
    for name, column in columns.items():
        if column is not None and len(column) != len(omega):
            raise InputError(
                f"{name} has {len(column)} values for {len(omega)} frequencies; give one value a"
                " line"
            )


def enough(omega: Real) -> None:
    """At least `FEWEST` lines."""
    if len(omega) < FEWEST:
        raise InputError(
            f"{len(omega)} frequencies are too few; at least {FEWEST} are needed: measure or keep"
            " more lines"
        )


def finite(name: str, values: Real | Complex | None, omega: Real) -> None:
    """No infinity and no NaN."""
    if values is None or np.all(np.isfinite(values)):
        return
    at = int(np.argmin(np.isfinite(values)))
    where = f" ({omega[at] / (2 * np.pi):g} Hz)" if np.isfinite(omega[at]) else ""
    raise InputError(f"{name} is not finite at line {at + 1}{where}; remove that line")


def positive(omega: Real) -> None:
    """Frequencies above zero."""
    if np.any(omega <= 0):
        at = int(np.argmax(omega <= 0))
        raise InputError(
            f"frequency {omega[at]:g} rad/s at line {at + 1} is not positive; remove the line (0"
            " Hz is not supported)"
        )


def distinct(omega: Real) -> None:
    """No frequency twice, in rising frequencies."""
    if np.any(np.diff(omega) == 0):
        twice = omega[int(np.argmax(np.diff(omega) == 0))]
        raise InputError(
            f"frequency {twice / (2 * np.pi):g} Hz ({twice:g} rad/s) occurs twice; average or"
            " remove the repeated lines"
        )


def nonzero(response: Complex) -> None:
    """A response that is exactly zero has no phase and no logarithm."""
    if np.any(response == 0):
        raise InputError(
            f"the response is exactly zero at line {int(np.argmax(response == 0)) + 1}; remove that"
            " line"
        )


def deviations(deviation: Real | None) -> None:
    """No negative standard deviation."""
    if deviation is not None and np.any(deviation < 0):
        raise InputError(
            f"standard deviation {deviation.min():g} is negative; is another column meant?"
        )


def coherences(coherence: Real | None) -> None:
    """Coherence (ordinary, squared) lies in 0..1; rounding may exceed it by 1e-6."""
    if coherence is not None and (coherence.min() < 0 or coherence.max() > 1 + 1e-6):
        raise InputError(
            f"coherence lies in 0..1, not in {coherence.min():g}..{coherence.max():g}; per cent? or"
            " another column?"
        )


def drives(drive: Real | None) -> None:
    """Amplitudes of the input are above zero."""
    if drive is not None and not drive.min() > 0:
        raise InputError(
            f"the amplitude of the input must be positive at every line, not {drive.min():g};"
            " remove lines that are not excited"
        )


def reversed_sensor(omega: Real, response: Complex, missing: int) -> str | None:
    """Sentence if the response looks like that of a free mass measured with the wrong sign.

    `missing` = differentiations that make `response` an acceleration per force, a/F. A free mass
    has a/F = 1/m: phase 0, slope
    0. A mass on a spring has phase 180 degrees too below its resonance, but there a/F rises with
       the square of the frequency, so the slope tells both apart.
    """
    low = max(3, int(np.count_nonzero(omega <= OCTAVE * omega[0])))
    lines = response[:low] / max(np.abs(response.real).max(), np.abs(response.imag).max(), SMALLEST)
    phase = np.angle(-(1j**missing) * lines)
    slope = (
        np.polyfit(np.log(omega[:low]), np.log(np.maximum(np.abs(lines), SMALLEST)), 1)[0] + missing
    )
    if np.median(np.abs(phase)) > np.pi / 4 or abs(slope) > 1:
        return None
    return (
        "at low frequencies the acceleration is opposite to the force, as a reversed sensor"
        " shows a free mass; if the sensor is reversed, give --sign=-"
    )


def phase_unit(phase: Real, unit: str, said: bool) -> str | None:
    """Sentence if a phase column can hardly be in its unit, "deg" or "rad"; `said` = the file or
    the caller named the unit.
    """
    largest = float(np.max(np.abs(phase), initial=0.0))
    if unit == "rad" and largest > LARGEST_RADIAN:
        return (
            f"phases reach {largest:.4g} rad: degrees read as radians? then give --unit phase=deg"
        )
    if unit == "deg" and said and largest <= LARGEST_SMALL_DEGREE and np.ptp(phase) > np.pi / 2:
        return (
            f"all phases lie within {largest:.3g} degrees: radians read as degrees? then give"
            " --unit phase=rad"
        )
    return None


def likely_phase_unit(phase: Real) -> str:
    """ "rad" where all phases lie within 7, else "deg": for a column whose unit nobody named."""
    return "rad" if np.max(np.abs(phase), initial=0.0) <= LARGEST_SMALL_DEGREE else "deg"
