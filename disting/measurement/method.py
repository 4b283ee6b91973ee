"""How a response was estimated from a record in time."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Method:
    """Periods or segments of which a response was estimated.

    `period` [samples] and number of whole `periods` that were averaged, those of a transient
    `dropped` before; or `segment` [samples] and number of half-overlapping `segments` of Welch's
    method. `trends`: sentences on what was removed from input and output before. `level`: standard
    deviation of the input over the record, in its `unit` there; 0 where it is unknown. `rate` =
    sampling rate [Hz], 0 where it is unknown, and `order` of the sensor that was sampled (0:
    position).
    """

    period: int = 0
    periods: int = 0
    dropped: int = 0
    segment: int = 0
    segments: int = 0
    trends: tuple[str, ...] = ()
    level: float = 0.0
    unit: str = ""
    rate: float = 0.0
    order: int = 0
