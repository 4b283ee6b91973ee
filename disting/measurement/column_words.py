"""Meaning of a column: its role from the words of its header, its unit from the same header.

A unit is in brackets after the name, after a stroke, a comma or "in", or is the last word: `f
[Hz]`, `Gain (dB)`, `phi/°`, `Frequency in Hz`, `Freq_Hz`, `MagdB`.
"""

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from enum import StrEnum

from disting.measurement.units import (
    FREQUENCIES,
    LEVELS,
    PHASES,
    drive,
    gain,
    in_ohm,
    known_unit,
    motion,
    omega_per as omega_per,
)


class Role(StrEnum):
    """Content of a column."""

    FREQUENCY = "frequency"
    REAL = "real part"
    IMAGINARY = "imaginary part"
    GAIN = "gain"
    PHASE = "phase"
    COHERENCE = "coherence"
    DEVIATION = "standard deviation"
    SIGNAL = "level of a signal"
    SPECTRUM = "power spectrum"
    RESPONSE = "complex response"
    INPUT = "input"
    OUTPUT = "output"
    REFERENCE = "reference"
    CLOCK = "clock"
    OTHER = "not used"


class Why(StrEnum):
    """Reason for the role or the unit of a column."""

    WORD = "header word"
    UNIT = "unit"
    OPTION = "option"
    FORMAT = "file format"
    ASSUMED = "assumed"
    BY_NAME = "assumed by its name"
    BY_NUMBERS = "assumed from its values"
    ELSEWHERE = "another response"
    NOTHING = ""

    @property
    def is_assumed(self) -> bool:
        """Return True if neither the file nor the caller states it."""
        return self in (Why.ASSUMED, Why.BY_NAME, Why.BY_NUMBERS)


@dataclass(frozen=True, slots=True)
class Column:
    """Role and unit of a column: "" where none is stated; `unknown` = a stated unit that is not
    known; `why`: reason for the role.
    """

    role: Role
    unit: str = ""
    unknown: str = ""
    why: Why = field(default=Why.NOTHING, compare=False)

    @property
    def in_words(self) -> str:
        """Such as: gain in dB."""
        unit = self.unit or self.unknown
        return f"{self.role} in {unit}" if unit not in ("", "1") else self.role.value


WORDS = {
    Role.COHERENCE: ("coh", "coherence", "kohaerenz", "kohärenz"),
    Role.DEVIATION: ("std", "sd", "sigma", "stdev", "deviation", "uncertainty"),
    Role.PHASE: ("phase", "phas", "ph", "arg", "phi", "φ", "ϕ", "angle", "winkel",
                 "zphase", "zphz", "zphi", "zarg"),
    Role.IMAGINARY: ("im", "imag", "imaginary", "zim", "zimag"),
    Role.REAL: ("re", "real", "zre", "zreal"),
    Role.GAIN: (
        "mag", "magnitude", "amp", "ampl", "amplitude", "abs", "gain", "modulus", "betrag",
        "impedance", "impedanz", "zmod", "zmag", "zabs",
    ),
    Role.FREQUENCY: (
        "f", "freq", "frequency", "frequencies", "frequenz", "frequenza", "w", "omega", "ω",
    ),
}  # fmt: skip
CIRCULAR = {"w", "omega", "ω"}
# of a file without units in its names: what stands for role and unit
SHORT = {"hz": Role.FREQUENCY, "khz": Role.FREQUENCY, "db": Role.GAIN, "deg": Role.PHASE}
WORD = re.compile(r"[A-Z]?[a-z]+|[A-Z]+(?![a-z])|[Ωωφϕ]")
# a power spectrum or the root of one, by its name or its unit
SPECTRAL = re.compile(
    r"(?<![a-z])(?:psd|asd)(?![a-z])|power[ _-]?spectr|auto[ _-]?spectr|spectral[ _-]density|"
    r"leistungsdichte|leistungsspektr|(?:\^2|\*\*2|²)\)?\s*/\s*hz|/\s*(?:√|sqrt|rt)\s*\(?\s*hz",
    re.IGNORECASE,
)
# Z' and Z'' with the signs that keyboards and instruments have for them
PRIMED = re.compile(r"(?<!\w)Z\s*(''|\"+|″|’’|′′|'|’|′)(?!['\"’′″])")
# what is called an impedance: Re(Z), |Z|, Z', Zreal, Z_im, Re Z, impedance; a small z is an axis
IMPEDANCE = re.compile(
    r"\(Z\)|\|Z\||(?<!\w)Z\s*['\"’′″]|(?<![A-Za-z])Z_?(?i:re|im|mod|abs|mag|ph|arg)|"
    r"\b(?i:re|im|real|imag|abs|mod|mag|phase|arg)[ _]Z\b|\b(?i:impedan[cz])"
)
MODULUS = re.compile(r"\|[^|]+\|")
LOGARITHM = re.compile(r"\b(?:log|log10|ln|lg)\b", re.IGNORECASE)
TWENTY = re.compile(r"20\s*\*?\s*(?:log|lg)", re.IGNORECASE)
SQUARE = re.compile(r"(.*?)\s*\[([^\[\]]*)\]\s*$")
SAID_IN = re.compile(r"(.+?)\s+in\s+(.+)$")
# units within names, such as f_Hz, MagdB, omega_rad_per_s
INSIDE = re.compile(
    r"([GMkmµ]?[Hh][Zz]|[Mkm]?rad\s*/\s*s(?:ec)?|rad_?(?:per_?)?s(?![a-z])|rpm|dB|"
    r"(?<![a-z])db(?![a-z])|(?<=mag)db|(?<=gain)db|[Dd]eg(?:rees?)?(?![a-z])|"
    r"(?<![a-z])m?rad(?![a-z])|gon|(?<![A-Za-z])[mkMG]?[Oo]hms?(?![a-z])|°|(?<=phase)deg|(?<=phase)rad)"
)
# in round brackets, or behind a stroke: a name rather than a unit
NAME = re.compile(
    r"[A-Za-z]\w{3,}[\w ]*|[A-Z]\w?\d*(?:\(.*\))?|[a-z]+\d+(?:/[a-z]+\d+)?|[A-Z]\w*/[A-Z]\w*"
)  # no unit
STROKE = re.compile(r"(.+?)\s*/\s*([^/\s()|]+)$")
# a part of a response and what it is of: a unit alone follows its stroke
PART = re.compile(
    r"[-−]?\s*(?:(?:re|im|real|imag|abs|mag|magnitude|gain|amplitude)\s*(?:\(\w+\))?|\|\w+\||"
    r"Z['’′″\"]*)",
    re.IGNORECASE,
)
UNITS_OF = {Role.FREQUENCY: FREQUENCIES, Role.PHASE: PHASES, Role.COHERENCE: LEVELS}


def meaning(header: str) -> Column:
    """Role and unit of a column, `OTHER` where no word is known.

    >>> [meaning(h).in_words for h in ("f_Hz", "ReG_mot", "MagdB", "Phase [mrad]", "A/dB")]
    ['frequency in Hz', 'real part', 'gain in dB', 'phase in mrad', 'gain in dB']
    >>> meaning("f [Furlong]").unknown, meaning("Amplitude (Vpp)").role.value
    ('Furlong', 'level of a signal')
    """
    if SPECTRAL.search(header):
        return Column(Role.SPECTRUM)
    name, stated = split_unit(header)
    word = _role(name)
    column = _meaning(header, name, stated, word or _role_of_unit(stated or header))
    reason = Why.WORD if word else Why.UNIT
    return replace(column, why=Why.NOTHING if column.role is Role.OTHER else reason)


def _meaning(header: str, name: str, stated: str | None, role: Role) -> Column:
    """Role and unit of a column of this name, stated unit and first role."""
    if LOGARITHM.search(header) and Role.FREQUENCY in (role, _role(stated or "")):
        return Column(Role.FREQUENCY, unknown=header.strip())
    if stated is None:
        inside = INSIDE.findall(header.replace("_per_", "/"))
        hertz = [text for text in inside if text.lower().endswith("hz")]
        units = [text for text in inside if _unit_for(role, text) is not None]
        if role in (Role.REAL, Role.IMAGINARY, Role.GAIN):
            # rad is none of a gain
            units = [text for text in units if known_unit(text, LEVELS) or in_ohm(text)]
        stated = (units or (hertz if role is Role.FREQUENCY else []) or [None])[-1]
    if role is Role.FREQUENCY and stated is None and CIRCULAR & set(_words(name)):
        return Column(role, "rad/s")
    if TWENTY.search(header) and role in (Role.GAIN, Role.OTHER):
        return Column(Role.GAIN, "dB")
    if not stated or role is Role.OTHER:
        return Column(role)
    return _with_unit(role, stated, name)


def split_unit(header: str) -> tuple[str, str | None]:
    """Name of a column and the unit that is stated behind it, None where there is none.

    >>> split_unit("Gain (rad/s^2/(Nm))"), split_unit("f/Hz"), split_unit("Re G_mot")
    (('Gain', 'rad/s^2/(Nm)'), ('f', 'Hz'), ('Re G_mot', None))
    """
    text = header.strip()
    square = SQUARE.match(text)
    if square:
        return square[1], square[2].strip()
    if text.endswith(")") and _opening(text) >= 0:
        at = _opening(text)
        return text[:at].strip(), text[at + 1 : -1].strip()
    if _is_unit(text):
        return "", text
    match = SAID_IN.match(text)
    if match:
        return match[1], match[2]
    for mark in (",", " ", "/"):
        for at in (i for i, c in enumerate(text) if c == mark):
            if _is_unit(text[at + 1 :].strip()):
                return text[:at].strip(), text[at + 1 :].strip()
    stroke = STROKE.match(text)
    is_name = stroke and NAME.fullmatch(stroke[2]) and not PART.fullmatch(stroke[1])
    if stroke and not is_name and len(stroke[2]) > 1:
        return stroke[1], stroke[2]
    return text, None


def matching(names: Sequence[str], asked: str) -> list[int]:
    """Places of the names that are meant by a text: those that are the same; else those that are
    the same where one of both has no unit; else these two with capitals alike. Several: the text
    is ambiguous.

    >>> matching(["t [s]", "excitation [Nm]", "Speed"], "excitation")
    [1]
    >>> matching(["t [s]", "excitation [Nm]", "Speed"], "speed [rpm]"), matching(["a", "A"], "A")
    ([2], [1])
    """
    wanted = asked.strip()
    for fold in (str, str.casefold):
        same = [i for i, name in enumerate(names) if name and fold(name) == fold(wanted)]
        alike = [i for i, name in enumerate(names) if name and _is_same(name, wanted, fold)]
        if same or alike:
            return same or alike
    return []


def _is_same(name: str, asked: str, fold: Callable[[str], str]) -> bool:
    """Return True for names that are the same but for a unit that one of them lacks."""
    (own, unit), (other, wanted) = split_unit(name), split_unit(asked)
    return bool(own) and fold(own) == fold(other) and not (unit and wanted)


def is_called_impedance(header: str) -> bool:
    """Return True if a header names an impedance, whatever its unit.

    >>> [is_called_impedance(h) for h in ("Re(Z)/Ohm", "Re Z", "Z''", "Zreal", "Re G_z", "Re z")]
    [True, True, True, True, False, False]
    """
    return IMPEDANCE.search(header) is not None


def _opening(text: str) -> int:
    """Where the last bracket of a text opens; -1 where it does not."""
    depth = 0
    for at in range(len(text) - 1, -1, -1):
        depth += {")": 1, "(": -1}.get(text[at], 0)
        if not depth:
            return at
    return -1


def _is_unit(text: str) -> bool:
    """Return True if a text is a unit that is recognised without brackets."""
    is_known = omega_per(text) is not None or known_unit(text, (*PHASES, *LEVELS[1:])) is not None
    the_gain = gain(text) if "/" in text or "-1" in text or "⁻" in text else None
    return (is_known or the_gain is not None or in_ohm(text) > 0) and text != "*"


def _words(name: str) -> list[str]:
    return [word.lower() for word in WORD.findall(name.replace("dB", " dB "))]


def _role(name: str) -> Role | None:
    primes = PRIMED.search(name)
    if primes:
        return Role.REAL if primes[1] in "'’′" else Role.IMAGINARY
    words = set(_words(name))
    whole = {word.removesuffix(unit) for word in words for unit in ("", "db", "deg", "rad", "hz")}
    the_role = next((role for role, names in WORDS.items() if whole & set(names)), None)
    if the_role in (None, Role.FREQUENCY) and MODULUS.search(name):
        return Role.GAIN
    return the_role


def _role_of_unit(text: str) -> Role:
    """Role by the unit, of a column without a name or with a name that gives no role."""
    level = gain(text)
    if omega_per(text) is not None and motion(text) is None:
        return Role.FREQUENCY
    if known_unit(text, ("deg",)):
        return Role.PHASE
    if level is not None and (level.level in ("dB", "Np") or in_ohm(text)):
        return Role.GAIN
    words = set(_words(text))
    return next((role for word, role in SHORT.items() if word in words), Role.OTHER)


def _unit_for(role: Role, text: str) -> str | None:
    """The name of a unit for a role; None where it is none for it."""
    if role is Role.FREQUENCY:
        if re.fullmatch(r"rad_?(?:per_?)?s|rad\s+s", text):
            return "rad/s"
        return text if omega_per(text) is not None else None
    if role in UNITS_OF:
        return known_unit(text, UNITS_OF[role])
    return text if gain(text) is not None else None


def _with_unit(role: Role, stated: str, name: str) -> Column:
    """The column with its unit, or with one that is not known."""
    if role is Role.FREQUENCY:
        if omega_per(stated) is None and (motion(stated) or drive(stated)):
            return Column(Role.OTHER)  # F [N], w [m]
        if known_unit(stated, FREQUENCIES) == "rad/s" and "rad" not in stated.lower():
            return Column(role, "rad/s" if CIRCULAR & set(_words(name)) else "Hz")  # in 1/s
    unit_text = _unit_for(role, stated)
    if unit_text is None:
        return replace(Column(role), unknown=stated)
    unit = gain(unit_text) if role in (Role.GAIN, Role.REAL, Role.IMAGINARY) else None
    return Column(Role.SIGNAL if unit and unit.signal else role, unit_text)
