"""Assumptions of a reader where neither the file nor the caller states something, and the options
that change them.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from disting.measurement.column_words import Role, Why
from disting.measurement.feedback import PERIODS
from disting.measurement.response import ASSUMED_ACCELERATION, FrequencyResponse
from disting.measurement.time_series import ASSUMED_POSITION
from disting.measurement.understanding import ReadColumn
from disting.quantities import Quantity, other_options

ASSUMED = {ASSUMED_ACCELERATION: Quantity.ACCELERATION, ASSUMED_POSITION: Quantity.POSITION}
OTHER_UNITS = {"Hz": "rad/s", "rad/s": "Hz", "deg": "rad", "rad": "deg", "dB": "1", "1": "dB"}
OHMS = ("ohm", "ohms", "ω", "v/a")  # Ω in small letters is ω
OF_RESPONSE = (Role.REAL, Role.IMAGINARY, Role.GAIN, Role.RESPONSE)
UNIT_OPTIONS = {Role.FREQUENCY: "frequency", Role.PHASE: "phase", Role.GAIN: "magnitude"}


@dataclass(frozen=True, slots=True)
class Assumption:
    """An assumption in words, and the option that replaces it by what is true."""

    what: str
    option: str

    def __str__(self) -> str:
        return f"{self.what}; if not, give {self.option}"


def assumed_quantity(measured: FrequencyResponse) -> Quantity | None:
    """The quantity that the sensor, or the recorded output, is assumed to show; None where it was
    given.
    """
    return next((quantity for note, quantity in ASSUMED.items() if note in measured.notes), None)


def as_shown(measured: FrequencyResponse, quantity: Quantity) -> FrequencyResponse:
    """Return the same numbers as a response of this quantity, which somebody states."""
    notes = tuple(note for note in measured.notes if note not in ASSUMED)
    return replace(measured, quantity=quantity, notes=notes)


def assumptions(columns: Sequence[ReadColumn], quantity: Quantity | None) -> tuple[Assumption, ...]:
    """Return what was assumed of the columns that are used; `quantity`: the assumed one, None where
    it is stated.
    """
    used = [column for column in columns if column.is_used]
    of_quantity = [] if quantity is None else [_of_quantity(quantity)]
    return (*of_quantity, *_of_columns(used), *_of_units(used))


def assumed_open_loop(response: FrequencyResponse) -> Assumption | None:
    """Return the assumption on a record without a reference that shows no loop; None where means
    over enough periods hold in closed loop as well.
    """
    method = response.method
    if method is None or response.loop is not None or method.periods >= PERIODS:
        return None
    return Assumption("an open loop, or an input without noise", "--read reference=NAME")


def shows_impedance(columns: Sequence[ReadColumn], response: FrequencyResponse | None) -> bool:
    """Return True for a voltage per current: according to the response or, for a refused one, the
    unit of a used column.
    """
    if response is not None:
        return response.is_impedance
    return any(
        column.is_used and column.role in OF_RESPONSE and column.unit.lower() in OHMS
        for column in columns
    )


def _of_quantity(quantity: Quantity) -> Assumption:
    return Assumption(f"quantity {quantity}", other_options(quantity))


def _of_columns(used: Sequence[ReadColumn]) -> Iterator[Assumption]:
    bare = [column for column in used if column.why is Why.ASSUMED]
    if bare:
        yield Assumption(
            f"columns {', '.join(column.role for column in bare)}, in this order",
            "--read columns=WORDS, such as columns=Hz,dB,deg",
        )
    for column in used:
        if column.why is Why.BY_NAME:
            yield Assumption(
                f"{column.role} {column.name or column.place}, by its name",
                f"--read {column.role}=NAME",
            )


def _of_units(used: Sequence[ReadColumn]) -> Iterator[Assumption]:
    roles = set[Role]()
    for column in used:
        if not column.unit_why.is_assumed or column.role in roles:
            continue
        roles.add(column.role)
        by = ", from its values" if column.unit_why is Why.BY_NUMBERS else ""
        if column.role is Role.CLOCK:
            yield Assumption(f"time in {column.unit}", "--read sampling_rate=HZ")
        elif column.role in UNIT_OPTIONS:
            unit = "linear" if column.unit == "1" else f"in {column.unit}"
            other = OTHER_UNITS.get(column.unit, "UNIT")
            option = f"--unit {UNIT_OPTIONS[column.role]}={other}"
            yield Assumption(f"{column.role} {unit}{by}", option)
