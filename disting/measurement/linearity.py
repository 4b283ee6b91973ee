"""Sentences on a machine that is not linear, from its measured responses alone.

Distortion widens the intervals of a fit (module `nonlinear`), but friction and backlash also move
the mean of a response, by an amount that no single measurement shows: values then hold for the
amplitude that they were measured at. The reader has to know that before any structure.
"""

from collections.abc import Sequence

import numpy as np

from disting.measurement.distortion import is_even_beyond_noise
from disting.measurement.response import FrequencyResponse

CAUSES = "probably friction, backlash or the steps of an encoder"
OTHER_CAUSES = f"{CAUSES}; or a machine that changes between the repeats"
HOLD = "values hold for this amplitude, and may lie outside their intervals"
LEAST = 1e-4  # share of a response below which its size does not matter
ONLY = "for this amplitude only"  # beside a value of such data
NOT_COUNTED = "± counts scatter, not by how much friction or backlash shift a value"
APART = 1.1  # ratio of levels from which on two measurements have different amplitudes


def describe_nonlinearity(response: FrequencyResponse) -> str:
    """Sentence on the distortion that a response shows in addition to its noise, both as medians of
    the lines in parts of |G|; "" where it shows none that could move a value beyond its interval.

    >>> from dataclasses import replace
    >>> from disting.measurement import from_arrays
    >>> data = from_arrays(range(1, 9), [1] * 8, deviation=[0.05] * 8)
    >>> describe_nonlinearity(replace(data, nonlinear=[0.04] * 8)).split(" (")[0]
    'noise 3 %, distortion 4 %'
    >>> describe_nonlinearity(replace(data, nonlinear=[0.01] * 8)), describe_nonlinearity(data)
    ('', '')
    """
    size, between = np.abs(response.G), response.distortion
    if response.noise is not None and response.nonlinear is not None:
        noise, level = (float(np.median(x / size)) for x in (response.noise, response.nonlinear))
        causes = OTHER_CAUSES if between is None else CAUSES
        # a shift of all lines by so little moves values by less than their intervals
        if level * np.sqrt(len(size)) < noise:
            return ""
        return held([f"noise {_percent(noise)}, distortion {_percent(level)}"], causes)
    periods = response.method.periods if response.method else 0
    if between is None or not between.told_apart or periods < 2:
        return ""
    if not is_even_beyond_noise(between, response.omega, response.G, periods):
        return ""
    at = np.interp(between.omega, response.omega, size)
    level = float(np.median((between.level / at)[between.even]))
    return held([f"distortion of even order {_percent(level)}"], CAUSES)


def describe_jumps(jumps: float, noise: float) -> str:
    """Sentence on lines that jump by more than the periods scatter, medians as shares of |G|."""
    evidence = f"noise {_percent(noise)}, neighbouring lines jump by {_percent(jumps)}"
    return held([evidence], CAUSES)


def held(seen: Sequence[str], causes: str) -> str:
    """Sentence on what data show of a machine that is not linear, and on what that means for
    values.

    >>> held(["noise 3 %, distortion 4 %"], "friction")
    'noise 3 %, distortion 4 % (friction): values hold for this amplitude, and may lie outside \
their intervals'
    """
    return f"{'; '.join(seen)} ({causes}): {HOLD}"


def with_change(sentence: str, seen: str) -> str:
    """A sentence of `held` with what another measurement shows of the same.

    >>> with_change(held(["noise 3 %"], "friction"), "both records differ by 5 %")[:50]
    'noise 3 %; both records differ by 5 % (friction): '
    """
    first, rest = sentence.split(" (", 1)
    return f"{first}; {seen} ({rest}"


def describe_levels(one: FrequencyResponse, other: FrequencyResponse) -> tuple[str, str] | None:
    """Levels of the excitation of two measurements, None where they are unknown or alike."""
    methods = [method for method in (one.method, other.method) if method and method.level]
    if len(methods) < 2 or methods[0].unit != methods[1].unit:
        return None
    low, high = sorted(method.level for method in methods)
    if high < APART * low:
        return None
    first, second = (f"{method.level:.3g} {method.unit}".strip() for method in methods)
    return first, second


def _percent(share: float) -> str:
    return f"{100 * share:.2g} %" if share >= LEAST else f"below {100 * LEAST:.2g} %"
