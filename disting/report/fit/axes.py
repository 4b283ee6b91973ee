"""Axes that read like those drawn by hand: plain numbers, few ticks, labels that keep their
distance.
"""

from collections.abc import Sequence
from math import ceil, log10
from typing import TYPE_CHECKING

import numpy as np

from disting.measurement.arrays import Real
from disting.report.fit.words import readable

if TYPE_CHECKING:
    from matplotlib.axis import Axis


def logarithmic(axis: "Axis", low: float, high: float) -> None:
    """Ticks of a logarithmic axis: every digit, 1-2-5, every or every n-th decade, what has
    room between `low` and `high`.
    """
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter, NullLocator

    decades = log10(high / low)
    digits = tuple(range(1, 10)) if decades < 0.7 else (1, 2, 5) if decades < 2.5 else (1,)
    axis.set_major_locator(LogLocator(subs=digits, numticks=12))
    axis.set_minor_locator(
        LogLocator(subs=range(1, 10), numticks=60) if decades < 3.2 else NullLocator()
    )
    axis.set_major_formatter(FuncFormatter(lambda value, _: readable(value)))
    axis.set_minor_formatter(NullFormatter())


def degrees(axis: "Axis", span: float) -> None:
    """At most six steps of 15, 30, 45, 90 degrees or whole half turns over a span of so many
    degrees.
    """
    from matplotlib.ticker import FuncFormatter, MultipleLocator

    fitting = [step for step in (15, 30, 45, 90) if span <= 6 * step]
    axis.set_major_locator(MultipleLocator(fitting[0] if fitting else 180 * ceil(span / (6 * 180))))
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:.0f}°".replace("-", "−")))


def spread(places: Sequence[float], distance: float) -> Real:
    """Rising places moved apart until neighbours keep `distance`, groups staying where they were
    on the whole.

    Pushing everything to the right and pushing everything to the left both keep the distance, and
    so does their mean.

    >>> spread([0.0, 0.5, 0.5, 1.0], 0.2).round(2).tolist()
    [0.0, 0.4, 0.6, 1.0]
    """
    right, left = np.array(places, dtype=float), np.array(places, dtype=float)
    for i in range(1, len(places)):
        right[i] = max(right[i], right[i - 1] + distance)
        left[-1 - i] = min(left[-1 - i], left[-i] - distance)
    return np.asarray((right + left) / 2)
