"""What a column means, from the words of its header."""

import re
from enum import StrEnum

WORD = re.compile(r"[A-Z]?[a-z]+|[A-Z]+(?![a-z])|[Ωω]")
DECIBEL = re.compile(r"(?<![a-z])db(?![a-z])")
RADIAN_PER_SECOND = re.compile(r"rad\s*/\s*s|rad_?per_?s|rads")


class Meaning(StrEnum):
    """Role and unit of one column; the values are the words of the option `columns`."""

    HERTZ = "Hz"
    KILOHERTZ = "kHz"
    RADIAN_PER_SECOND = "rad/s"
    REAL = "re"
    IMAGINARY = "im"
    MAGNITUDE = "magnitude"
    DECIBEL = "dB"
    PHASE = "phase"
    DEGREE = "deg"
    RADIAN = "rad"
    COHERENCE = "coherence"
    DEVIATION = "std"
    OTHER = "-"


FREQUENCIES = (Meaning.HERTZ, Meaning.KILOHERTZ, Meaning.RADIAN_PER_SECOND)
PHASES = (Meaning.PHASE, Meaning.DEGREE, Meaning.RADIAN)

_WORDS = (
    (Meaning.COHERENCE, {"coh", "coherence", "kohaerenz", "kohärenz"}),
    (Meaning.DEVIATION, {"std", "sd", "sigma", "stdev", "deviation", "uncertainty"}),
    (Meaning.PHASE, {"phase", "phas", "ph", "arg", "deg", "degree", "degrees"}),
    (Meaning.IMAGINARY, {"im", "imag", "imaginary"}),
    (Meaning.REAL, {"re", "real"}),
    (
        Meaning.MAGNITUDE,
        {"mag", "magnitude", "amp", "ampl", "amplitude", "abs", "gain", "modulus", "betrag"},
    ),
    (
        Meaning.HERTZ,
        {
            "f",
            "freq",
            "frequency",
            "frequencies",
            "frequenz",
            "frequenza",
            "hz",
            "khz",
            "w",
            "omega",
            "ω",
        },
    ),
)


def meaning(header: str) -> Meaning:
    """Role of a column, `OTHER` where no word is known.

    >>> [meaning(h).value for h in ("f_Hz", "ReG_mot", "MagdB", "Phase [rad]", "gamma2_coh")]
    ['Hz', 're', 'dB', 'rad', 'coherence']
    """
    spaced = header.replace("dB", " dB ")
    words, lower = {w.lower() for w in WORD.findall(spaced)}, spaced.lower()
    role = next((role for role, known in _WORDS if words & known), Meaning.OTHER)
    if role in (Meaning.MAGNITUDE, Meaning.OTHER) and DECIBEL.search(lower):
        return Meaning.DECIBEL
    if role is Meaning.PHASE:
        return _phase(words, lower)
    if role is Meaning.HERTZ:
        return _frequency(words, lower)
    return role


def _phase(words: set[str], lower: str) -> Meaning:
    if words & {"deg", "degree", "degrees", "grad"} or "°" in lower:
        return Meaning.DEGREE
    return Meaning.RADIAN if words & {"rad", "radian", "radians"} else Meaning.PHASE


def _frequency(words: set[str], lower: str) -> Meaning:
    if words & {"khz"} or "khz" in lower:
        return Meaning.KILOHERTZ
    if "hz" in lower:
        return Meaning.HERTZ
    circular = words & {"w", "omega", "ω"} or RADIAN_PER_SECOND.search(lower)
    return Meaning.RADIAN_PER_SECOND if circular else Meaning.HERTZ
