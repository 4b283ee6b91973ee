"""Units of measured signals: what a header says, and what it is in SI.

A motion is rad or m (or a multiple), with /s or /s^2; what drives it is a torque, a force, or a
current or voltage. A new unit is a row of `MOTIONS` or `DRIVES`: every way to write it follows.
"""

import re
from collections.abc import Iterable
from math import pi
from typing import NamedTuple

from disting.errors import InputError
from disting.model.chain import Sensor


class Motion(NamedTuple):
    """Unit of a motion: rad or m, number of differentiations, factor to SI."""

    base: str
    order: int
    factor: float

    @property
    def sensor(self) -> Sensor:
        """The quantity that has such a unit."""
        return tuple(Sensor)[self.order]


MOTIONS = {
    "m": Motion("m", 0, 1.0),
    "cm": Motion("m", 0, 1e-2),
    "mm": Motion("m", 0, 1e-3),
    **dict.fromkeys(("um", "µm", "μm"), Motion("m", 0, 1e-6)),
    "rad": Motion("rad", 0, 1.0),
    "mrad": Motion("rad", 0, 1e-3),
    **dict.fromkeys(("deg", "°"), Motion("rad", 0, pi / 180)),
    **dict.fromkeys(("rev", "turn"), Motion("rad", 0, 2 * pi)),
    **dict.fromkeys(("rpm", "1/min", "min^-1"), Motion("rad", 1, pi / 30)),
    "g": Motion("m", 2, 9.80665),
}
# a space stands where a dot or a star may stand too, or nothing
DRIVES = {
    "N": ("N", 1.0), "mN": ("N", 1e-3), "kN": ("N", 1e3),
    "N m": ("Nm", 1.0), "mN m": ("Nm", 1e-3), "kN m": ("Nm", 1e3), "N cm": ("Nm", 1e-2),
    "A": ("A", 1.0), "mA": ("A", 1e-3), "V": ("V", 1.0), "mV": ("V", 1e-3),
}  # fmt: skip
BETWEEN = r"[\s.*·]"
PER_TIME = {"*s^2": -2, "*s": -1, "": 0, "/s": 1, "/s^2": 2}
SUFFIX = {steps: text for text, steps in PER_TIME.items()}
_CLOSED = {name.replace(" ", ""): unit for name, unit in DRIVES.items()}


def _any(names: Iterable[str]) -> str:
    """A pattern of all names, the longest first, with the spaces as they may be written."""
    ordered = sorted(names, key=len, reverse=True)
    return "|".join(re.escape(name).replace(r"\ ", f"{BETWEEN}?") for name in ordered)


MOTION_TEXT = (
    rf"(?:{_any(n for n, unit in MOTIONS.items() if not unit.order)})"
    r"(?:/s(?:(?:\^|\*\*)?2|²)?)?"
)
RATIO = re.compile(rf"(?<![\w/])\(?({MOTION_TEXT})\)?\s*(?:/|per)\s*\(?({_any(DRIVES)})\b")


def motion(text: str) -> Motion | None:
    """The unit of a motion, None for what is none.

    >>> motion("mm/s²"), motion("Nm")
    (Motion(base='m', order=2, factor=0.001), None)
    >>> motion("rpm")
    Motion(base='rad', order=1, factor=0.10471975511965977)
    """
    return _parted(text)[0]


def differentiated(text: str, sensor: Sensor, wanted: Sensor) -> str:
    """The unit of the same motion as another sensor shows it; "" where that is not known, or
    where it is the unit of another quantity than `sensor`.

    >>> differentiated("cm", Sensor.POSITION, Sensor.ACCELERATION)
    'cm/s^2'
    """
    found, name, steps = _parted(text)
    if found is None:
        return text if sensor is wanted else ""
    if found.sensor is not sensor:
        return ""
    return name + SUFFIX[steps + wanted.order - sensor.order]


def agree(text: str, sensor: Sensor) -> None:
    """Raise InputError where a unit is that of another quantity than the output was read as."""
    found = motion(text)
    if found is not None and found.sensor is not sensor:
        raise InputError(
            f"the output in {text} is a {found.sensor.value}, the response is read as that of a"
            f" {sensor.value}: give sensor={found.sensor.value}, or another unit"
        )


def drive(text: str) -> tuple[str, float] | None:
    """SI unit and factor of a torque, force, current or voltage, None for what is none.

    >>> drive("N m"), drive("mA"), drive("rad")
    (('Nm', 1.0), ('A', 0.001), None)
    """
    return _CLOSED.get(re.sub(BETWEEN, "", text))


def ratio(texts: Iterable[str]) -> tuple[str, str] | None:
    """Units of output and input from headers and comments, where they agree; None where they say
    none.

    >>> ratio(["# acceleration/current, rad/s^2 per A"]), ratio(["f [Hz]", "Re"])
    (('rad/s^2', 'A'), None)
    """
    found = {(one[1], one[2]) for text in texts for one in RATIO.finditer(text)}
    return found.pop() if len(found) == 1 else None


def _parted(text: str) -> tuple[Motion | None, str, int]:
    """A unit of a motion, its name in `MOTIONS` and how often that was differentiated."""
    plain = re.sub(r"\s", "", text).replace("²", "^2").replace("**2", "^2").replace("/s2", "/s^2")
    for suffix, steps in sorted(PER_TIME.items(), key=lambda one: -len(one[0])):
        unit = MOTIONS.get(plain.removesuffix(suffix)) if plain.endswith(suffix) else None
        if unit is not None and 0 <= unit.order + steps < len(Sensor):
            return unit._replace(order=unit.order + steps), plain.removesuffix(suffix), steps
    return None, "", 0
