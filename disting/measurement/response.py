"""A measured frequency response: G(j omega) with its standard deviation, coherence, sensor
quantity and origin.

How a response was estimated from a record in time.
"""

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from disting.errors import InputError, short
from disting.measurement import checks
from disting.measurement.arrays import (
    Complex,
    Real,
    apply,
    complex_,
    frozen,
    optional,
    real,
    same,
    spread,
)
from disting.measurement.distortion import Distortion
from disting.measurement.feedback import Feedback
from disting.measurement.observation import Hold, Window, as_period
from disting.measurement.understanding import ReadColumn
from disting.measurement.units import AMPERE, VOLT, agree, unit_as
from disting.model.presentation import NotebookTable, plural, summary
from disting.quantities import Quantity, as_quantity, other_options
from disting.renamed import renamed, renamed_attributes

if TYPE_CHECKING:
    from matplotlib.axes import Axes


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


ASSUMED_ACCELERATION = (
    f"sensor quantity taken as acceleration; if not, give {other_options(Quantity.ACCELERATION)}"
)
OF_IMPEDANCE = "impedance"  # in place of a sensor quantity
NO_MOTION = (
    "this is an impedance, a voltage per current, not the motion of a machine: no chain of masses"
    " is fitted to it; fit circuits, as disting fit FILE --models 'R0-p(R1,C1)'"
)
ASSUMED_IMPEDANCE = (
    "taken as an impedance in ohm, by its name or unit; if it is a motion, name its quantity, such"
    " as --quantity velocity"
)
SORTED = "the frequencies were not in rising order and have been sorted"


class Signal(NamedTuple):
    """Name and unit of a measured signal.

    >>> str(Signal("motor current", "A"))
    'motor current [A]'
    """

    label: str = ""
    unit: str = ""

    def __str__(self) -> str:
        return f"{self.label} [{self.unit}]" if self.unit else self.label


ROUNDING = 1e-6  # share of a deviation
UNNAMED = Signal()
CURRENT, VOLTAGE = Signal("current", AMPERE), Signal("voltage", VOLT)  # of an impedance


@renamed_attributes(sensor="quantity")
@dataclass(frozen=True, slots=True, eq=False)
class FrequencyResponse(NotebookTable):
    """Measured response at n_f frequencies; immutable, equal if its numbers, quantity and signals
    are equal.

    `omega` [rad/s], shape (n_f,), positive, all different; `G`, shape (n_f,), sensor quantity per
    input [output unit / input unit]; `deviation` = standard deviation of the complex G, sqrt(var
    Re G + var Im G), shape (n_f,), in the unit of G, or None; `coherence` = ordinary coherence
    gamma^2 in 0..1, shape (n_f,), or None; `quantity` = what the sensor shows; `origin` = file
    and columns; `notes` = what was assumed or changed while reading; `distortion` = what the lines
    without excitation of a periodic record show, or None; `doubts` = what looked wrong while
    reading; `reading` = which columns were read as what; `freedom` = degrees of freedom of the
    squared deviation, 2 for each repeat beyond the first, or None where nobody says how many there
    are; `window` = that of Welch's method, or None; `drive` = amplitude of the input at each line,
    in any unit, shape (n_f,), or None; `is_impedance`: G is a voltage per current [ohm], whatever
    `quantity` is; `hold` = how the input is held between samples, or None: the lines show G
    through it then, and a fit compares models so; `columns` = those of the file as they were
    understood; `method` = how it was estimated from a record in time, or None; `loop` = the closed
    loop that the record shows, or None; `nonlinear` = the part of `deviation` that a nonlinear
    machine makes itself, shape (n_f,), or None where none is measured (module `nonlinear`).
    Frequencies out of order are sorted, with a note. Raises InputError for what is no frequency
    response (module `checks`).

    >>> import numpy as np
    >>> mass = FrequencyResponse(np.linspace(10.0, 100.0, 10), np.full(10, 0.5 + 0j))
    >>> len(mass.thinned(8)), complex(mass.to_quantity("velocity").G[0])
    (8, -0.05j)
    """

    omega: Real
    G: Complex
    deviation: Real | None = None
    coherence: Real | None = None
    quantity: Quantity = Quantity.ACCELERATION
    input: Signal = UNNAMED
    output: Signal = UNNAMED
    origin: str = ""
    notes: tuple[str, ...] = ()
    distortion: Distortion | None = None
    doubts: tuple[str, ...] = ()
    reading: str = ""
    freedom: float | None = None
    window: Window | None = None
    drive: Real | None = None
    is_impedance: bool = False
    hold: Hold | None = None
    columns: tuple[ReadColumn, ...] = ()
    method: Method | None = None
    loop: Feedback | None = None
    nonlinear: Real | None = None

    def __post_init__(self) -> None:
        omega, response = real(self.omega, "omega"), complex_(self.G, "G")
        columns: dict[str, Any] = {
            "omega": omega,
            "G": response,
            "deviation": optional(self.deviation, "deviation"),
            "coherence": optional(self.coherence, "coherence"),
            "drive": optional(self.drive, "drive"),
            "nonlinear": optional(self.nonlinear, "nonlinear"),
        }
        checks.lengths(**columns)
        checks.enough(omega)
        for name, column in columns.items():
            checks.finite(name, column, omega)
        checks.positive(omega)
        order = np.argsort(omega, kind="stable")
        moved = bool(np.any(np.diff(omega) < 0))
        for name, column in columns.items():
            object.__setattr__(self, name, None if column is None else frozen(column[order]))
        checks.distinct(self.omega)
        checks.nonzero(self.G)
        checks.deviations(self.deviation)
        checks.coherences(self.coherence)
        checks.drives(self.drive)
        object.__setattr__(self, "quantity", as_quantity(self.quantity))
        object.__setattr__(self, "input", Signal(*self.input))
        object.__setattr__(self, "output", Signal(*self.output))
        object.__setattr__(self, "notes", (*self.notes, *[SORTED] * moved))

    def __repr__(self) -> str:
        low, high = self.frequency[0], self.frequency[-1]
        unit = (
            f" [{self.output.unit}/{self.input.unit}]"
            if self.output.unit and self.input.unit
            else ""
        )
        return summary(
            self,
            f"{plural(len(self), 'line')}, {low:.4g} to {high:.4g} Hz, {self.quantity_word}{unit}",
        )

    def __reduce__(self) -> tuple[Any, ...]:
        # arrays stay read-only in a copy
        return FrequencyResponse, tuple(getattr(self, field.name) for field in fields(self))

    def __len__(self) -> int:
        return len(self.omega)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, FrequencyResponse):
            return NotImplemented
        words = (
            (self.quantity, self.is_impedance) == (other.quantity, other.is_impedance)
            and self.input == other.input
            and self.output == other.output
        )
        pairs = ((self.omega, other.omega), (self.G, other.G), (self.deviation, other.deviation))
        return words and all(same(a, b) for a, b in (*pairs, (self.coherence, other.coherence)))

    def __hash__(self) -> int:
        return hash((self.quantity, self.omega.tobytes(), self.G.tobytes()))

    def plot(self, ax: "Axes | Sequence[Axes] | None" = None, **style: Any) -> tuple["Axes", ...]:
        """Bode diagram with matplotlib: amplitude and phase [degree] over frequency [Hz].

        `ax`: two axes, or one for the amplitude alone, such as those that another `plot` returned;
        without them a new figure. `style` as `Axes.plot` takes it. Returns the axes. Raises
        DistingError where matplotlib is missing.
        """
        return tuple(self._presenter.plot(self, ax, style))

    @property
    def frequency(self) -> Real:
        """Frequencies [Hz], shape (n_f,)."""
        return np.asarray(self.omega / (2 * np.pi))

    @property
    def quantity_word(self) -> str:
        """The quantity that G shows, as a word; "impedance" of one."""
        return OF_IMPEDANCE if self.is_impedance else self.quantity.value

    @property
    def noise(self) -> Real | None:
        """Standard deviation of G by what does not repeat, shape (n_f,), in the unit of G:
        `deviation` without `nonlinear`.
        """
        if self.deviation is None or self.nonlinear is None:
            return self.deviation
        # sums of squares leave no smaller part
        least = (ROUNDING * self.deviation) ** 2
        return np.asarray(np.sqrt(np.maximum(self.deviation**2 - self.nonlinear**2, least)))

    @property
    def suspicions(self) -> tuple[str, ...]:
        """Sentences on what looks wrong in the numbers, each with its remedy; empty where
        nothing does.
        """
        doubts = [*self.doubts, *([self.loop_sentence] if self.is_biased_by_loop else [])]
        if not self.is_impedance:
            doubt = checks.reversed_sensor(self.omega, self.G, 2 - self.quantity.order)
            doubts += [] if doubt is None else [doubt]
        return tuple(doubts)

    @property
    def is_biased_by_loop(self) -> bool:
        """Return True if a closed loop biases lines by more than they scatter."""
        return self.loop is not None and bool(self.loop.harmed.any())

    @property
    def loop_sentence(self) -> str:
        """Sentence on the closed loop that the record shows, "" where it shows none."""
        return "" if self.loop is None else self.loop.sentence(self.frequency)

    def subset(self, lines: Any) -> "FrequencyResponse":
        """The lines of a boolean mask or of indices, shape (n,); raises InputError where fewer
        than 8 remain.
        """
        chosen = np.asarray(lines)
        if chosen.dtype != bool and not np.issubdtype(chosen.dtype, np.integer):
            raise InputError("lines are chosen by truth values or by whole numbers")
        try:
            deviation, coherence, drive, nonlinear = (
                apply(lambda a: a[chosen], a)
                for a in (self.deviation, self.coherence, self.drive, self.nonlinear)
            )
            return replace(
                self,
                omega=self.omega[chosen],
                G=self.G[chosen],
                deviation=deviation,
                coherence=coherence,
                window=None if self.window is None else self.window.of(chosen),
                drive=drive,
                loop=None if self.loop is None else self.loop.of(chosen),
                nonlinear=nonlinear,
            )
        except IndexError as error:
            raise InputError(f"no such lines: {error}") from None

    def masked(self, low: float = 0.0, high: float = np.inf) -> "FrequencyResponse":
        """The lines from `low` to `high` [Hz], both included; raises InputError where fewer
        than 8 remain.
        """
        inside = (self.frequency >= low) & (self.frequency <= high)
        if (count := int(inside.sum())) < checks.FEWEST:
            raise InputError(
                f"{count} of {len(self)} lines, which go from {self.frequency[0]:g} to"
                f" {self.frequency[-1]:g} Hz, lie in the band; {checks.FEWEST} are needed: widen it"
            )
        return self.subset(inside)

    def thinned(self, count: int) -> "FrequencyResponse":
        """`count` lines, as near as can be to frequencies spaced evenly on a logarithmic scale; all
        if there are fewer. `reading` states it.
        """
        if count < checks.FEWEST:
            raise InputError(f"at least {checks.FEWEST} lines are kept, not {count}")
        if count >= len(self):
            return self
        some = f"{count} of {len(self)} lines, evenly spaced on a logarithmic scale"
        reading = "; ".join(filter(None, [self.reading, some]))
        return self.subset(spread(np.log(self.omega), count)).read_as(reading)

    @renamed(sensor="quantity")
    def to_quantity(self, quantity: Quantity | str) -> "FrequencyResponse":
        """The same motion as measured by another sensor: G (j omega)^n and deviation omega^n, n =
        difference of the orders.

        Raises InputError where the unit of the output is that of another quantity than it was read
        as, and for an impedance.
        """
        wanted = as_quantity(quantity)
        if self.is_impedance:
            raise InputError(f"{self.origin or 'data'}: {NO_MOTION}")
        steps = wanted.order - self.quantity.order
        if not steps:
            return self
        agree(self.output.unit, self.quantity)
        return replace(
            self,
            G=self.G * (1j * self.omega) ** steps,
            deviation=apply(lambda d: d * self.omega**steps, self.deviation),
            nonlinear=apply(lambda d: d * self.omega**steps, self.nonlinear),
            quantity=wanted,
            distortion=(
                None
                if self.distortion is None
                else self.distortion.times(self.distortion.omega**steps)
            ),
            output=self.output._replace(unit=unit_as(self.output.unit, self.quantity, wanted)),
        )

    def windowed(self) -> "FrequencyResponse":
        """The H1 estimate of Welch's method, which shows the response under its window, with its
        own deviation; itself where nothing else was made of it.
        """
        window = self.window
        if window is None or window.ratio is None or window.share is None:
            return self
        share = window.share
        shown = f"shown through a window of {window.duration:g} s, and models likewise"
        return replace(
            self,
            reading="; ".join(filter(None, [self.reading, shown])),
            G=self.G * window.ratio,
            deviation=apply(lambda d: d * share, self.deviation),
            window=Window(window.duration, window.order),
        )

    def held(self, period: float | str, order: int = 0) -> "FrequencyResponse":
        """The same lines as a digital drive shows them that holds its input for `period` [s] and
        samples a motion of this `order` (0: position); `reading` states it. Raises InputError.

        >>> import numpy as np
        >>> mass = FrequencyResponse(np.linspace(10.0, 100.0, 10), np.full(10, 0.5 + 0j))
        >>> mass.held(1e-3).reading
        'input held for 0.001 s (zero-order hold), as models are compared'
        """
        hold = Hold(as_period(period), order)
        words = f"input held for {hold.period:g} s (zero-order hold), as models are compared"
        return replace(self, hold=hold, reading="; ".join(filter(None, [self.reading, words])))

    def sign_reversed(self) -> "FrequencyResponse":
        """-G: the response of a sensor that counts the other way round."""
        return replace(self, G=-self.G)

    def noted(self, *notes: str | None) -> "FrequencyResponse":
        """The same response with further notes; None and repetitions are left out."""
        return replace(self, notes=tuple(dict.fromkeys([*self.notes, *(n for n in notes if n)])))

    def doubted(self, *doubts: str) -> "FrequencyResponse":
        """The same response with further doubts; repetitions are left out."""
        return replace(self, doubts=tuple(dict.fromkeys([*self.doubts, *doubts])))

    def read_as(
        self, words: str, columns: Sequence[ReadColumn] | None = None
    ) -> "FrequencyResponse":
        """The same response with words on which columns were read as what, and their records where
        these are given.
        """
        kept = self.columns if columns is None else tuple(columns)
        return replace(self, reading=words, columns=kept)


def as_sign(value: int) -> int:
    """1 or -1; raises InputError for another number."""
    if value not in (1, -1):
        raise InputError(f"the sign of a sensor is 1 or -1, not {short(value)}")
    return value
