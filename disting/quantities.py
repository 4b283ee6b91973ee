"""The quantities that a sensor of a machine shows: one table, a row each, in the order of how often
the position is differentiated.
"""

import re
from collections.abc import Iterable
from enum import StrEnum
from typing import Self

from disting.errors import InputError, short

PROPER = 2  # derivative up to which a mass has a proper transfer function whatever the ports
# what drives a machine, and what is said of a response as a whole
DRIVE = re.compile(
    r"(torque|force|current|voltage|moment|iq|drehmoment|kraft|strom|spannung)\b", re.IGNORECASE
)


class Quantity(StrEnum):
    """Measured quantity; its transfer function is s**order times the receptance.

    A row has the word, the unit of a translation, and other words that are understood.

    >>> Quantity.VELOCITY.order, Quantity.VELOCITY.unit, Quantity.VELOCITY.is_proper
    (1, 'm/s', True)
    >>> [Quantity(word).value for word in ("speed", "Angle", "accel")]
    ['velocity', 'position', 'acceleration']
    """

    unit: str
    other_words: tuple[str, ...]

    POSITION = (
        "position",
        "m",
        "pos angle displacement travel receptance compliance lage weg winkel",
    )
    VELOCITY = ("velocity", "m/s", "vel speed omega mobility geschwindigkeit drehzahl")
    ACCELERATION = (
        "acceleration",
        "m/s^2",
        "acc accel accelerance inertance beschleunigung",
    )

    def __new__(cls, word: str, unit: str = "", other_words: str = "") -> Self:
        """The quantity of a row."""
        made = str.__new__(cls, word)
        made._value_ = word
        made.unit, made.other_words = unit, tuple(other_words.split())
        return made

    @property
    def written_text(self) -> str:
        """Its text in keys and seeds, with the first name of this class: results stay the same."""
        return f"<Sensor.{self.name}: {self.value!r}>"

    @property
    def order(self) -> int:
        """Number of differentiations of the position: 0, 1 or 2."""
        return list(Quantity).index(self)

    @property
    def is_proper(self) -> bool:
        """Return True if every machine can have such a sensor: its response to a force is finite
        towards high frequencies, and it has a state space.
        """
        return self.order <= PROPER

    @classmethod
    def _missing_(cls, value: object) -> "Quantity | None":
        """The quantity of another word; None for a word that is none."""
        word = value.strip().lower() if isinstance(value, str) else ""
        return next((own for own in cls if word in (own.value, *own.other_words)), None)


MODELLED = tuple(s for s in Quantity if s.is_proper)  # what sensors of models can show


def as_quantity(value: Quantity | str) -> Quantity:
    """The quantity of that name; raises InputError for another word."""
    try:
        return Quantity(value)
    except ValueError:
        if isinstance(value, str) and DRIVE.match(value.strip()):
            raise InputError(
                f"{short(value)} drives the machine; the quantity is what the sensor shows:"
                f" {in_words(Quantity)}"
            ) from None
        raise InputError(f"quantity is {in_words(Quantity)}, not {short(value)}") from None


def quantity_in(name: str) -> Quantity | None:
    """The quantity of which the name of a signal has a word, None where it has none or several.

    >>> quantity_in("motor_speed"), quantity_in("ActPos1"), quantity_in("y")
    (<Quantity.VELOCITY: 'velocity'>, None, None)
    """
    words = set(re.findall(r"[^\W\d_]+", name.lower()))
    found = [own for own in Quantity if words & {own.value, *own.other_words}]
    return found[0] if len(found) == 1 else None


def quantity_of_model(value: Quantity | str) -> Quantity:
    """The same for a model; raises InputError for one that no model can have."""
    quantity = as_quantity(value)
    refuse_improper(quantity.order)
    return quantity


def refuse_improper(order: int) -> None:
    """Raise InputError for a derivative of the position that no sensor of a model can show."""
    if not 0 <= order <= PROPER:
        quantity = list(Quantity)[order] if 0 <= order < len(Quantity) else f"derivative {order}"
        raise InputError(
            f"a sensor of a machine shows {in_words(MODELLED)}, not {quantity}: beyond the"
            f" {MODELLED[-1]} the transfer function of a mass is not proper"
        )


def in_words(quantities: Iterable[Quantity]) -> str:
    """Quantities as alternatives.

    >>> in_words(MODELLED)
    'position, velocity or acceleration'
    """
    *others, last = quantities
    return f"{', '.join(others)} or {last}"


def other_options(taken: Quantity) -> str:
    """The options that name another quantity.

    >>> other_options(Quantity.ACCELERATION)
    '--quantity position or --quantity velocity'
    """
    return " or ".join(f"--quantity {other}" for other in Quantity if other is not taken)
