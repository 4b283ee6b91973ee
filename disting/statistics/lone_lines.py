"""Gains of fit that rest on single lines.

A mass that is small compared with the others, on a spring that resonates with hardly any damping,
changes the response at its resonance alone. Narrower than the distance of two lines, it has the
parameters (frequency, size, damping) to fit one line exactly, or two neighbouring ones in part,
whatever they are. By Gaussian noise the largest gain at one of n lines is that of the largest
|r_k|^2, which is above 2 ln(n / alpha) with probability alpha, and the test of exclusion allows for
that. It does not allow for what benches do besides: a disturbance of one line, the foot of a
resonance that the model of the actuator misses by a little. Such a gain has no bound, and no other
line confirms it.

A gain must therefore be supported by more lines than the element can fit by itself. With r_A, r_B
the residuals of a structure and of one that contains it, and g_k = |r_A,k|^2 - |r_B,k|^2 of line k,
the two neighbouring lines with the largest g_k + g_k+1 are left out. Without their rows T of the
test of exclusion must still exceed what as many parameters as B has beyond A yield by chance, and
the costs must still differ by the share of it that the test requires. A lag, a damper, a resonance
supported by several lines lose little by that; an element that fits one line has nothing left.
Where several responses are fitted, the lines at these two frequencies are left out of all.

If B rests on single lines it is not selected and excludes nothing: these data do not show what it
adds.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import pi

import numpy as np
from numpy.typing import NDArray

from disting.measurement.arrays import Real


@dataclass(frozen=True, slots=True)
class LoneLines:
    """Frequencies [Hz] of the one or two neighbouring lines on which a gain rests."""

    low: float
    high: float

    @property
    def sentence(self) -> str:
        """Where the gain comes from.

        >>> LoneLines(37.14, 38.0).sentence, LoneLines(5.0, 5.0).sentence
        ('rests on the lines at 37.1 and 38 Hz alone', 'rests on the line at 5 Hz alone')
        """
        if self.low == self.high:
            return f"rests on the line at {self.low:.3g} Hz alone"
        return f"rests on the lines at {self.low:.3g} and {self.high:.3g} Hz alone"


def lone_lines(
    residual: Real,
    other: Real,
    omega: Real,
    is_shown: Callable[[NDArray[np.bool_]], bool],
) -> LoneLines | None:
    """Return the lines on which the gain of one structure over another rests, None if other lines
    show it too.

    `residual`, `other`: whitened residuals of the structure that is excluded and of the one that
    excludes, shape (n_y,); `omega`: frequency of each of them [rad/s], shape (n_y,). `is_shown`:
    decides if the residuals that are kept, shape (n_y,), still exclude.

    >>> omega = np.tile(np.arange(1.0, 9.0), 2)
    >>> one, spread = np.ones(16), np.ones(16)
    >>> one[3], shown = 5.0, lambda kept: float(np.sum(one[kept] ** 2)) > 15.0
    >>> lone_lines(one, np.zeros(16), omega, shown).low * 2 * np.pi
    3.0
    """
    lines, at = np.unique(omega, return_inverse=True)
    gain = np.bincount(at, residual**2 - other**2, len(lines))
    pairs = gain[:-1] + gain[1:]
    first = int(np.argmax(pairs))
    kept = (omega < lines[first]) | (omega > lines[first + 1])
    if is_shown(kept):
        return None
    return LoneLines(float(lines[first]) / (2 * pi), float(lines[first + 1]) / (2 * pi))
