"""The unit of a grid of frequencies: what a file or a caller says, held against the numbers
themselves.

Who measures a response chooses round frequencies in the unit in which he thinks: 0.1, 0.2, .. 1000
Hz. In a file of the other unit these are 0.628, 1.257, ... So a grid that is round after division
by 2 pi, and is not round itself, is in rad/s.
"""

import numpy as np

from disting.errors import InputError, shown
from disting.measurement.arrays import Real

UNIT = {"Hz": 2 * np.pi, "kHz": 2e3 * np.pi, "rad/s": 1.0, "rpm": 2 * np.pi / 60}
DIGITS = 5  # of a round number
SLOWEST = 1e-100  # frequency, and the inverse of the fastest one; damaged numbers lie beyond
EXACT = 1e-7  # relative error of a number in a file
SPELLINGS = {
    "hertz": "Hz",
    "hz": "Hz",
    "khz": "kHz",
    "rad/sec": "rad/s",
    "rad/second": "rad/s",
    "1/s": "rad/s",
}


def in_omega(
    values: Real, said: str | None, asked: str | None, who: str, *, default: str = "Hz"
) -> tuple[Real, str | None]:
    """Frequencies [rad/s], and a note where the unit was assumed or the numbers speak against it.

    `asked` = the unit that the caller gives, which always holds; `said` = the unit that the file
    names, None where it names none and `default` is taken; `who` = whose unit it is, for the note.
    Raises InputError for a unit that is none.
    """
    if asked is not None:
        return values * UNIT[known(asked)], None
    unit = known(said or default)
    round_, round_in_hertz = is_round(values), is_round(values / (2 * np.pi))
    if unit == "Hz" and round_in_hertz and not round_:
        return values, (
            f"{who}: frequencies taken as rad/s{' although Hz is said' if said else ''}, in which"
            " they are the round numbers"
            f' {_first(values / (2 * np.pi))} Hz; if not, give frequency_unit="Hz"'
        )
    if said and unit == "rad/s" and round_ and not round_in_hertz:
        return (
            values,
            (
                f"{who}: frequencies taken as rad/s, but {_first(values)} are round; if Hz, give"
                ' frequency_unit="Hz"'
            ),
        )
    return values * UNIT[unit], None if said else f"frequencies of {who} taken as {unit}"


def known(unit: str) -> str:
    """The name of a unit in `UNIT`; raises InputError for another."""
    name = SPELLINGS.get(unit.lower(), unit)
    if name not in UNIT:
        raise InputError(f'frequency_unit is "Hz", "kHz", "rad/s" or "rpm", not {shown(unit)}')
    return name


def is_round(values: Real) -> bool:
    """Whether all numbers have `DIGITS` digits at most.

    >>> is_round(np.arange(1, 251) * 0.1), is_round(np.arange(1, 251) * 0.2 * np.pi)
    (True, False)
    """
    if not len(values) or not np.all((values > SLOWEST) & (values < 1 / SLOWEST)):
        return False
    power = 10.0 ** (np.floor(np.log10(values)) - (DIGITS - 1))
    return bool(np.all(np.abs(values - np.rint(values / power) * power) <= EXACT * values))


def _first(values: Real) -> str:
    return f"{', '.join(f'{value:.5g}' for value in values[:3])}, .."
