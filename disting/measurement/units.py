"""Units of measured signals: the unit in a header, and its factor to SI.

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
    **{name: Motion("m", 0, size) for name, size in (
        ("km", 1e3), ("m", 1.0), ("cm", 1e-2), ("mm", 1e-3), ("um", 1e-6), ("µm", 1e-6),
        ("μm", 1e-6), ("nm", 1e-9), ("in", 0.0254), ("inch", 0.0254),
    )},
    **{name: Motion("rad", 0, size) for name, size in (
        ("krad", 1e3), ("rad", 1.0), ("mrad", 1e-3), ("urad", 1e-6), ("µrad", 1e-6), ("μrad", 1e-6),
        ("deg", pi / 180), ("°", pi / 180), ("mdeg", pi / 180e3), ("gon", pi / 200),
        ("arcmin", pi / 10800), ("arcsec", pi / 648000), ("rev", 2 * pi), ("turn", 2 * pi),
        ("turns", 2 * pi),
    )},
    **dict.fromkeys(("rpm", "1/min", "min^-1", "U/min"), Motion("rad", 1, pi / 30)),
    "g": Motion("m", 2, 9.80665),
}  # fmt: skip
# a space stands where a dot or a star may stand too, or nothing
DRIVES = {
    "N": ("N", 1.0), "mN": ("N", 1e-3), "kN": ("N", 1e3), "MN": ("N", 1e6),
    "N m": ("Nm", 1.0), "mN m": ("Nm", 1e-3), "kN m": ("Nm", 1e3), "N cm": ("Nm", 1e-2),
    "A": ("A", 1.0), "mA": ("A", 1e-3), "V": ("V", 1.0), "mV": ("V", 1e-3),
}  # fmt: skip
VOLT, AMPERE = "V", "A"
# of an impedance, to ohm
OHM = re.compile(r"([mkMG]?)(?:\u2126|\u03a9|ohms?)", re.IGNORECASE)  # both signs of the ohm
OHMS = {"": 1.0, "m": 1e-3, "k": 1e3, "K": 1e3, "M": 1e6, "G": 1e9}
# of a frequency, to rad/s
FREQUENCIES = {
    "mHz": 2e-3 * pi, "Hz": 2 * pi, "kHz": 2e3 * pi, "MHz": 2e6 * pi, "GHz": 2e9 * pi,
    "mrad/s": 1e-3, "rad/s": 1.0, "krad/s": 1e3, "Mrad/s": 1e6, "deg/s": pi / 180,
    "rpm": pi / 30, "1/min": pi / 30,
}  # fmt: skip
# of a phase, to rad
PHASES = {
    "rad": 1.0, "mrad": 1e-3, "deg": pi / 180, "mdeg": pi / 180e3, "gon": pi / 200,
    "turns": 2 * pi,
}  # fmt: skip
TIMES = {"s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9, "min": 60.0, "h": 3600.0}
LEVELS = ("1", "%", "dB", "Np")  # of a gain
SPELLINGS = {
    "hertz": "Hz", "cycles/s": "Hz", "cps": "Hz", "rev/s": "Hz", "1/s": "rad/s", "s^-1": "rad/s",
    "rad/second": "rad/s", "rads": "rad/s", "rad*s^-1": "rad/s", "°/s": "deg/s", "min^-1": "1/min",
    "u/min": "rpm", "r/min": "rpm", "rev/min": "rpm", "cpm": "rpm",
    "radian": "rad", "radians": "rad", "°": "deg", "º": "deg", "*": "deg", "degree": "deg",
    "degrees": "deg", "grd": "deg", "gons": "gon", "turn": "turns", "rev": "turns",
    "revolutions": "turns", "cycles": "turns",
    "µs": "us", "μs": "us", "second": "s", "seconds": "s", "milliseconds": "ms", "minutes": "min",
    "hours": "h", "sek": "s", "sec": "s", "msec": "ms",
    "lin": "1", "linear": "1", "abs": "1", "-": "1", "a.u.": "1", "percent": "%", "pct": "%",
    "decibel": "dB", "neper": "Np",
}  # fmt: skip
POWER = re.compile(r"(?:10\s*(?:\^|\*\*)\s*|1e)([+-]?\d{1,2})\s*[*·x]?\s*(.+)")
REFERRED = re.compile(r"(dB|Np|%)(?:\s+re[fl]?\.?:?)?(?:\s+1?\s*|(?=\())(.+)", re.IGNORECASE)
BETWEEN = r"[\s.*·]"
SUFFIX = {
    n: f"{'*/'[n > 0]}s{f'^{abs(n)}' if abs(n) > 1 else ''}" if n else ""
    for n in range(1 - len(Sensor), len(Sensor))
}
PER_TIME = {text: steps for steps, text in SUFFIX.items()}
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
    return _split_unit(text)[0]


def known_unit(text: str, kind: Iterable[str]) -> str | None:
    """The name in `kind` of a unit of frequency, phase, time or level, None for what is none; in
    capitals where these leave no doubt.

    >>> [known_unit(text, FREQUENCIES) for text in ("HZ", "KHz", "rad / sec", "MHZ", "Ms")]
    ['Hz', 'kHz', 'rad/s', None, None]
    """
    plain = _plain(text)
    names = tuple(kind)
    if plain in names:
        return plain
    spelled = SPELLINGS.get(plain.lower())
    if spelled in names:
        return spelled
    alike = [name for name in names if name.lower() == plain.lower()]
    return alike[0] if len(alike) == 1 else None


def omega_per(text: str) -> float | None:
    """Factor from a unit of frequency to rad/s, with a power of ten before it; None for an unknown
    unit.

    >>> omega_per("10^3 rad/s"), omega_per("furlong")
    (1000.0, None)
    """
    power = POWER.fullmatch(text.strip())
    unit = known_unit(power[2] if power else text, FREQUENCIES)
    return None if unit is None else FREQUENCIES[unit] * 10.0 ** int(power[1] if power else 0)


class Gain(NamedTuple):
    """Unit of a column of gains, or of their parts: its level, one of `LEVELS`, and the units of
    output and input, "" where they are not stated. `signal`: that of a signal alone, as a
    generator's level has it, rather than of an output per input. `ohms`: of an impedance, what a
    number of 1 is in ohm; 0 of anything else.
    """

    level: str
    output: str = ""
    input: str = ""
    signal: bool = False
    ohms: float = 0.0


def gain(text: str) -> Gain | None:
    """The unit of a gain, None for what is none.

    >>> gain("deg/s^2/A"), gain("dB re 1 mm/s/N").level, gain("k"), gain("Vpp").signal
    (Gain(level='1', output='deg/s^2', input='A', signal=False, ohms=0.0), 'dB', None, True)
    >>> [gain(text).ohms for text in ("kOhm", "mV/A", "dB(Ohm)", "1")]
    [1000.0, 0.001, 1.0, 0.0]
    """
    level = known_unit(text, LEVELS)
    if level is not None:
        return Gain(level)
    referred = REFERRED.fullmatch(text.strip())
    rest = (referred[2] if referred else text).strip()
    if rest.startswith("(") and rest.endswith(")") and referred:
        rest = rest[1:-1]
    units = _per(_products(rest))
    name = known_unit(referred[1], LEVELS) if referred else "1"
    return None if units is None or name is None else units._replace(level=name)


def _per(text: str) -> Gain | None:
    """The unit of an output per input, of an output, or of a signal."""
    size = in_ohm(text)
    if size:
        return Gain("1", VOLT, AMPERE, ohms=size)
    before, _, behind = (part.strip(" ()") for part in text.replace(" per ", "/").rpartition("/"))
    above, below = drive(before), drive(behind)
    if above and below and (above[0], below[0]) == (VOLT, AMPERE):
        return Gain("1", VOLT, AMPERE, ohms=above[1] / below[1])
    if motion(before) is not None and drive(behind) is not None:
        return Gain("1", before, behind)
    if motion(text) is not None:
        return Gain("1", text)
    if drive(before) and drive(before) == drive(behind):
        return Gain("1")
    volts = re.sub(r"(?:pp|pk|rms|_?peak|eff)$", "", text, flags=re.IGNORECASE)
    return Gain("1", signal=True) if drive(volts) else None


def in_ohm(text: str) -> float:
    """The size in ohm of a unit that is called by this name; 0 for another unit.

    >>> in_ohm("kOhm"), in_ohm("MOHM"), in_ohm("mΩ"), in_ohm("V/A")
    (1000.0, 1000000.0, 0.001, 0.0)
    """
    match = OHM.fullmatch(text.strip())
    return OHMS.get(match[1], 0.0) if match else 0.0


def _plain(text: str) -> str:
    return re.sub(r"\s", "", text).replace("sec", "s").replace("⁻¹", "^-1").replace("−", "-")


def _products(text: str) -> str:
    """A product of powers as a quotient: rad s^-2 A^-1 is rad/s^2/A."""
    plain = text.replace("⁻", "^-").replace("−", "-").replace("²", "2").replace("¹", "1")
    plain = re.sub(r"(?<=[/ ])sec?(?=\b|\^|\d)", "s", plain)
    plain = re.sub(r"\^\(?-([12])\)?", r"^-\1", plain)
    plain = re.sub(r"[\s*·.]*\b(s)\^?-2", "/s^2", plain)
    return re.sub(r"[\s*·.]+([A-Za-z]+)\^?-1", r"/\1", plain)


def unit_as(text: str, sensor: Sensor, wanted: Sensor) -> str:
    """The unit of the same motion as another sensor shows it; "" where that is not known, or
    where it is the unit of another quantity than `sensor`.

    >>> unit_as("cm", Sensor.POSITION, Sensor.ACCELERATION)
    'cm/s^2'
    """
    the_unit, name, steps = _split_unit(text)
    if the_unit is None:
        return text if sensor is wanted else ""
    if the_unit.sensor is not sensor:
        return ""
    return name + SUFFIX[steps + wanted.order - sensor.order]


def agree(text: str, sensor: Sensor) -> None:
    """Raise InputError where a unit is that of another quantity than the output was read as."""
    the_unit = motion(text)
    if the_unit is not None and the_unit.sensor is not sensor:
        raise InputError(
            f"the output in {text} is a {the_unit.sensor.value}, the response is read as that of a"
            f" {sensor.value}: give --quantity {the_unit.sensor.value}, or another unit"
        )


def drive(text: str) -> tuple[str, float] | None:
    """SI unit and factor of a torque, force, current or voltage, None for what is none.

    >>> drive("N m"), drive("mA"), drive("rad")
    (('Nm', 1.0), ('A', 0.001), None)
    """
    return _CLOSED.get(re.sub(BETWEEN, "", text))


def ratio(texts: Iterable[str]) -> tuple[str, str] | None:
    """Units of output and input from headers and comments, where they agree; None where they state
    none.

    >>> ratio(["# acceleration/current, rad/s^2 per A"]), ratio(["f [Hz]", "Re"])
    (('rad/s^2', 'A'), None)
    """
    members = {(match[1], match[2]) for text in texts for match in RATIO.finditer(text)}
    return members.pop() if len(members) == 1 else None


def _split_unit(text: str) -> tuple[Motion | None, str, int]:
    """A unit of a motion, its name in `MOTIONS` and how often that was differentiated."""
    plain = re.sub(r"\s", "", text).replace("²", "^2").replace("**2", "^2").replace("/s2", "/s^2")
    for suffix, steps in sorted(PER_TIME.items(), key=lambda parts: -len(parts[0])):
        unit = MOTIONS.get(plain.removesuffix(suffix)) if plain.endswith(suffix) else None
        if unit is not None and 0 <= unit.order + steps < len(Sensor):
            return unit._replace(order=unit.order + steps), plain.removesuffix(suffix), steps
    return None, "", 0
