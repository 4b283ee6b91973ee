"""Units of measured signals: what a header says, taken to SI, so that results are in kg m2 or kg,
Nm/rad or N/m.

A motion is rad or m (or a multiple), with /s or /s^2; what drives it is a torque, a force, or a
current or voltage, which a torque constant turns into one.
"""

import re
from collections.abc import Iterable
from dataclasses import replace
from math import pi
from typing import NamedTuple

from disting.errors import InputError, shown
from disting.measurement.response import ASSUMED_ACCELERATION, FrequencyResponse, Signal
from disting.model.chain import Sensor

LENGTHS = {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "um": 1e-6, "µm": 1e-6, "μm": 1e-6}
ANGLES = {"rad": 1.0, "mrad": 1e-3, "deg": pi / 180, "°": pi / 180, "rev": 2 * pi, "turn": 2 * pi}
DRIVES = {
    "N": ("N", 1.0), "mN": ("N", 1e-3), "kN": ("N", 1e3),
    "Nm": ("Nm", 1.0), "mNm": ("Nm", 1e-3), "kNm": ("Nm", 1e3), "Ncm": ("Nm", 1e-2),
    "A": ("A", 1.0), "mA": ("A", 1e-3), "V": ("V", 1.0), "mV": ("V", 1e-3),
}  # fmt: skip
PER_TIME = {"": 0, "/s": 1, "/s^2": 2}
SPECIAL = {
    "rpm": ("rad", 1, pi / 30),
    "1/min": ("rad", 1, pi / 30),
    "min^-1": ("rad", 1, pi / 30),
    "g": ("m", 2, 9.80665),
}
SUFFIX = ("", "/s", "/s^2")
BY_ORDER = {s.order: s for s in Sensor}
MOTION_TEXT = r"(?:m?rad|deg|°|rev|turn|[cmuµμ]?m)(?:/s(?:(?:\^|\*\*)?2|²)?)?"
DRIVE_TEXT = r"(?:[mk]?N[ .*·]?c?m|[mk]?N|m?A|m?V)"
RATIO = re.compile(rf"(?<![\w/])\(?({MOTION_TEXT})\)?\s*(?:/|per)\s*\(?({DRIVE_TEXT})\b")
BRACKETED = re.compile(r"^(.*?)\s*[\[(]\s*([^\])]+?)\s*[\])]\s*$")


class Motion(NamedTuple):
    """Unit of a motion: rad or m, number of differentiations, factor to SI."""

    base: str
    order: int
    factor: float


def motion(text: str) -> Motion | None:
    """The unit of a motion, None for what is none.

    >>> motion("mm/s²"), motion("Nm")
    (Motion(base='m', order=2, factor=0.001), None)
    >>> motion("rpm")
    Motion(base='rad', order=1, factor=0.10471975511965977)
    """
    plain = re.sub(r"\s", "", text).replace("²", "^2").replace("**2", "^2").replace("/s2", "/s^2")
    if plain in SPECIAL:
        return Motion(*SPECIAL[plain])
    base, slash, rest = plain.partition("/")
    if slash + rest not in PER_TIME or base not in LENGTHS | ANGLES:
        return None
    return Motion(
        "m" if base in LENGTHS else "rad", PER_TIME[slash + rest], (LENGTHS | ANGLES)[base]
    )


def drive(text: str) -> tuple[str, float] | None:
    """SI unit and factor of a torque, force, current or voltage, None for what is none.

    >>> drive("N m"), drive("mA"), drive("rad")
    (('Nm', 1.0), ('A', 0.001), None)
    """
    return DRIVES.get(re.sub(r"[\s.*·]", "", text))


def ratio(texts: Iterable[str]) -> tuple[str, str] | None:
    """Units of output and input from headers and comments, where they agree; None where they say
    none.

    >>> ratio(["# acceleration/current, rad/s^2 per A"]), ratio(["f [Hz]", "Re"])
    (('rad/s^2', 'A'), None)
    """
    found = {(one[1], one[2]) for text in texts for one in RATIO.finditer(text)}
    return found.pop() if len(found) == 1 else None


def named(header: str) -> Signal:
    """Name and unit of a signal headed like `iq [A]`; no unit where the brackets hold another word.

    >>> named("angle (deg)"), named("out (filtered)")
    (Signal(label='angle', unit='deg'), Signal(label='out (filtered)', unit=''))
    """
    parts = BRACKETED.match(header)
    return (
        Signal(parts[1], parts[2])
        if parts and (motion(parts[2]) or drive(parts[2]))
        else Signal(header)
    )


def in_si(
    response: FrequencyResponse, *, output: str | None = None, input: str | None = None
) -> FrequencyResponse:
    """The response in SI units where the units of its signals are known; `output`, `input` = units
    in their place.

    The order of a unit (rad/s is a velocity) is that of the sensor where nobody said the sensor's
    quantity. Raises InputError for a unit that is given and not known, and for one that
    contradicts the quantity.
    """
    there, here = motion(output or response.output.unit), drive(input or response.input.unit)
    for given, unit, example in ((output, there, "rad, mm/s, rpm"), (input, here, "A, Nm, N")):
        if given and unit is None:
            raise InputError(
                f"{shown(given)} is no unit that is known here; known are such as {example}"
            )
    if there is not None:
        response = _moved(
            response, there, said=output or response.output.unit, asked=output is not None
        )
    if here is None:
        return response
    return _scaled(replace(response, input=response.input._replace(unit=here[0])), 1 / here[1])


def with_constant(response: FrequencyResponse, constant: float) -> FrequencyResponse:
    """The response per torque or force where the input is a current: divided by `constant`
    [Nm/A, or N/A for a motion in m].
    """
    if not 0 < constant < float("inf"):
        raise InputError(f"a torque constant is positive [Nm/A or N/A], not {constant:g}")
    if response.input.unit in ("N", "Nm"):
        raise InputError(
            f"the input is in {response.input.unit} already; leave --torque-constant away"
        )
    found = motion(response.output.unit)
    note = (
        None
        if found
        else (
            "the output is taken to be in rad, the results are rotational; if not, give --unit"
            " output=m"
        )
    )
    base = found.base if found else "rad"
    units = (
        response.output._replace(unit=base + SUFFIX[response.sensor.order]),
        response.input._replace(unit="N" if base == "m" else "Nm"),
    )
    return _scaled(replace(response, output=units[0], input=units[1]), 1 / constant).noted(note)


def scaled(response: FrequencyResponse, factor: float) -> FrequencyResponse:
    """The response times a positive factor; raises InputError for another one."""
    if not 0 < factor < float("inf"):
        raise InputError(
            f"a scale is a positive number, not {factor:g}; a reversed sensor is --sign=-"
        )
    return _scaled(response, factor)


def _moved(response: FrequencyResponse, unit: Motion, said: str, asked: bool) -> FrequencyResponse:
    assumed = ASSUMED_ACCELERATION in response.notes
    if assumed:
        response = replace(
            response,
            sensor=BY_ORDER[unit.order],
            notes=tuple(n for n in response.notes if n != ASSUMED_ACCELERATION),
        )
    elif unit.order != response.sensor.order and not (asked and unit.order == 0):
        raise InputError(
            f"the output in {said} is a {BY_ORDER[unit.order].value}, the response is read as that"
            f" of a {response.sensor.value}: give sensor={BY_ORDER[unit.order].value}, or another"
            " unit"
        )
    note = (
        f"output taken from {said} to {unit.base}{SUFFIX[unit.order]}" if unit.factor != 1 else None
    )
    signal = response.output._replace(unit=unit.base + SUFFIX[response.sensor.order])
    return _scaled(replace(response, output=signal), unit.factor).noted(note)


def _scaled(response: FrequencyResponse, factor: float) -> FrequencyResponse:
    if factor == 1:
        return response
    deviation = None if response.deviation is None else response.deviation * factor
    distortion = None if response.distortion is None else response.distortion.times(factor)
    return replace(response, G=response.G * factor, deviation=deviation, distortion=distortion)
