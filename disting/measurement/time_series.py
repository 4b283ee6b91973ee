"""A record of input and output samples, and the frequency response that it shows."""

from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np

from disting.errors import InputError, short
from disting.measurement import periodic
from disting.measurement.arrays import Real, frozen, real, same
from disting.measurement.response import UNNAMED, FrequencyResponse, Method, Signal
from disting.measurement.trend import (
    Trend,
    TrendOption,
    as_trend_option,
    describe,
    undo_difference,
)
from disting.measurement.understanding import ReadColumn
from disting.measurement.units import motion
from disting.model.presentation import plural, summary
from disting.quantities import Quantity, as_quantity, other_options, quantity_in
from disting.renamed import renamed, renamed_attributes

MOVING = 0.1  # share of the scatter of the speed from which on its mean is reported
ASSUMED_POSITION = f"output taken as a position; if not, give {other_options(Quantity.POSITION)}"


@renamed_attributes(sensor="quantity")
@dataclass(frozen=True, slots=True, eq=False)
class TimeSeries:
    """Input `u` and output `y`, shape (n,) each, at `sampling_rate` [Hz]; immutable, equal by
    content.

    `quantity` = what `y` shows; `reference`, shape (n,), = what a controller was asked
    for, or None; `left_out` says what else the file has; `columns` = those of the file as they were
    understood. Raises InputError for samples that are not
    finite, constant signals and unequal lengths.

    >>> from disting.simulation import demo
    >>> record = demo()
    >>> len(record.u), record.sampling_rate, len(record.response("acceleration"))
    (50000, 2500.0, 241)
    """

    u: Real
    y: Real
    sampling_rate: float
    quantity: Quantity = Quantity.POSITION
    input: Signal = UNNAMED
    output: Signal = UNNAMED
    origin: str = ""
    notes: tuple[str, ...] = ()
    reference: Real | None = None
    left_out: str = ""
    columns: tuple[ReadColumn, ...] = ()

    def __post_init__(self) -> None:
        for name in ("u", "y", *(["reference"] if self.reference is not None else [])):
            object.__setattr__(self, name, frozen(_samples(getattr(self, name), name)))
        if len(self.u) != len(self.y):
            raise InputError(
                f"the input has {len(self.u)} samples, the output {len(self.y)}; give signals of"
                " one record"
            )
        if self.reference is not None and len(self.reference) != len(self.u):
            raise InputError(
                f"the reference has {len(self.reference)} samples, the input {len(self.u)}; give"
                " one record"
            )
        object.__setattr__(self, "sampling_rate", _rate(self.sampling_rate))
        object.__setattr__(self, "quantity", as_quantity(self.quantity))
        object.__setattr__(self, "input", Signal(*self.input))
        object.__setattr__(self, "output", Signal(*self.output))

    def __repr__(self) -> str:
        samples = f"{plural(len(self), 'sample')} at {self.sampling_rate:.6g} Hz"
        seconds = len(self) / self.sampling_rate
        return summary(self, f"{samples}, {seconds:.4g} s, {self.quantity.value}")

    def __reduce__(self) -> tuple[Any, ...]:
        # arrays stay read-only in a copy
        return TimeSeries, tuple(getattr(self, field.name) for field in fields(self))

    def __len__(self) -> int:
        return len(self.u)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, TimeSeries):
            return NotImplemented
        mine = (self.sampling_rate, self.quantity, self.input, self.output)
        theirs = (other.sampling_rate, other.quantity, other.input, other.output)
        pairs = ((self.u, other.u), (self.y, other.y), (self.reference, other.reference))
        return mine == theirs and all(same(a, b) for a, b in pairs)

    def __hash__(self) -> int:
        return hash((self.sampling_rate, self.u.tobytes(), self.y.tobytes()))

    def sign_reversed(self) -> "TimeSeries":
        """The record of a sensor that counts the other way round."""
        return replace(self, y=-self.y)

    @renamed(sensor="quantity")
    def response(
        self,
        quantity: Quantity | str | None = None,
        *,
        period: int | None = None,
        transient: int | None = None,
        lines: Any = None,
        band: tuple[float, float] | None = None,
        segment: int | None = None,
        least_coherence: float | None = None,
        outliers: str = "keep",
        trend: str = "remove",
        hold: float | str | None = None,
    ) -> FrequencyResponse:
        """Measured frequency response, converted to `quantity` by (j omega)^n (default:
        that of the record).

        Periodic excitation (module `periodic`): `period` [samples], detected where not given;
        `transient` = periods dropped at the beginning (default: the first one; of two periods only
        if it shows a transient); `lines` = excited frequencies [Hz],
        detected where not given; `outliers` among the periods as in `mean_of`. Any other
        excitation: `segment` [samples] of Welch's method (module `welch`), which is used exactly
        where `segment` is given; lines of a coherence below `least_coherence` are left out then
        (default: what chance gives). `trend`: "remove" the constant speed of a drive or the drift
        of a sensor (module `trend`), or "keep" it. `hold` = time for which a digital drive holds
        its input [s], "record" for the sampling time of the record (module `hold`). A reference
        makes both methods hold in closed loop. `band` = (low, high) [Hz]. Raises InputError where
        no period is found, periods are missing, too few lines are left, or `segment` is given with
        `period` or `outliers`.
        """
        parts = (self.u, self.y, self.sampling_rate)
        _check_method(segment, period, lines, least_coherence, outliers)
        removes = as_trend_option(trend) is TrendOption.REMOVE
        # what is not finite then is refused below
        with np.errstate(over="ignore", invalid="ignore"):
            if segment is None:
                excitation = self.u if self.reference is None else self.reference
                detrend = (self._describe_input, self._describe_output) if removes else None
                the_response = periodic.estimate(
                    *parts, period, transient, lines, band, excitation, outliers, detrend
                )
            else:
                the_response = self._by_welch(segment, band, least_coherence, removes)
        closed = "" if self.reference is None else ", with a reference, which holds in closed loop"
        response = replace(
            the_response,
            quantity=self.quantity,
            input=self.input,
            output=self.output,
            origin=self.origin,
            notes=(*self.notes, *the_response.notes),
            reading=f"record in time, input {self.input}, output {self.output}{closed}"
            + (self.left_out and f"; {self.left_out}"),
            columns=self.columns,
            loop=the_response.loop if self.reference is None else None,
            method=the_response.method and self._complete_method(the_response.method),
        )
        if hold is not None:
            held = 1 / self.sampling_rate if hold == "record" else hold
            response = response.held(held, self.quantity.order)
        return response if quantity is None else response.to_quantity(quantity)

    def _complete_method(self, method: Method) -> Method:
        return replace(
            method,
            level=float(np.std(self.u)),
            unit=self.input.unit,
            rate=self.sampling_rate,
            order=self.quantity.order,
        )

    def _by_welch(
        self,
        segment: int,
        band: tuple[float, float] | None,
        least_coherence: float | None,
        removes_trends: bool,
    ) -> FrequencyResponse:
        """Response by Welch's method; of a position by its differences where trends are removed."""
        from disting.measurement import welch  # most files are responses or periodic
        from disting.measurement.feedback_in_noise import loop_in_noise

        is_alone = self.reference is None
        loop = loop_in_noise(self.u, self.y, self.quantity.order) if is_alone else None
        options = (self.sampling_rate, segment, band, self.reference, least_coherence)

        def estimate(y: Real, order: int) -> FrequencyResponse:
            return welch.estimate(self.u, y, *options, order, loop)

        if self.quantity.order or not removes_trends:
            return estimate(self.y, self.quantity.order)
        steps = np.diff(self.y)
        speed = Trend(float(steps.mean()))
        # a Hann window gives the first sample no weight: its difference is unknown and free
        response = estimate(np.concatenate([[speed.slope], steps]), 1)
        is_moving = abs(speed.slope) > MOVING * float(steps.std())
        trends = (self._describe_output(speed),) if is_moving else ()
        method = response.method and replace(response.method, trends=trends)
        plain = undo_difference(response, self.sampling_rate).noted(*trends)
        return replace(plain, method=method)

    def _describe_input(self, trend: Trend) -> str:
        return describe(trend, self.sampling_rate, "input", self.input)

    def _describe_output(self, trend: Trend) -> str:
        return describe(trend, self.sampling_rate, "output", self.output)


def said(
    quantity: Quantity | str | None, signal: Signal = UNNAMED
) -> tuple[Quantity, tuple[str, ...]]:
    """Quantity of a recorded output: as asked for, or that of its unit or its name, else position,
    with the note that says so.
    """
    if quantity is not None:
        return as_quantity(quantity), ()
    moves = motion(signal.unit)
    own = quantity_in(signal.label) if moves is None else moves.quantity
    return (Quantity.POSITION, (ASSUMED_POSITION,)) if own is None else (own, ())


def _check_method(
    segment: int | None,
    period: int | None,
    lines: Any,
    least_coherence: float | None,
    outliers: str,
) -> None:
    """Raises InputError for an option that belongs to the other method."""
    if segment is None:
        if least_coherence is not None:
            raise InputError(
                "least_coherence is for Welch's method: give --read segment=SAMPLES too"
            )
        return
    if period is not None or lines is not None:
        raise InputError(
            "period and lines are for a periodic excitation, segment for any other: give one of"
            " them"
        )
    if outliers != "keep":
        raise InputError(
            "--outliers drop compares periods or repeats, not segments of Welch's method: remove"
            " it, or cut the record where it is disturbed"
        )


def _samples(values: Any, name: str) -> Real:
    array = real(values, name)
    if not np.all(np.isfinite(array)):
        raise InputError(
            f"sample {int(np.argmin(np.isfinite(array))) + 1} of {name} is not finite; cut the"
            " record before it"
        )
    if not len(array) or np.ptp(array) == 0:
        raise InputError(f"{name} does not move in {len(array)} samples; is another signal meant?")
    return array.copy()


def _rate(value: Any) -> float:
    try:
        rate = float(value)
    except (TypeError, ValueError):
        raise InputError(f"the sampling rate is a number [Hz], not {short(value)}") from None
    if not 0 < rate < np.inf:
        raise InputError(f"the sampling rate is positive [Hz], not {rate:g}")
    return rate
