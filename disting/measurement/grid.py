"""The unit of a grid of frequencies: what a file or a caller says, held against the numbers
themselves.

Who measures a response chooses round frequencies in the unit in which he thinks: 0.1, 0.2, .. 1000
Hz. In a file of the other unit these are 0.628, 1.257, ... So a grid that is round after division
by 2 pi, and is not round itself, is in rad/s.
"""

import numpy as np

from disting.errors import InputError, listed, shown
from disting.measurement.arrays import Real
from disting.measurement.units import FREQUENCIES, known_unit, omega_per

DIGITS = 5  # of a round number
SLOWEST = 1e-100  # frequency, and the inverse of the fastest one; damaged numbers lie beyond
EXACT = 1e-7  # relative error of a number in a file


def in_omega(
    values: Real, said: str | None, asked: str | None, who: str, *, default: str = "Hz"
) -> tuple[Real, str | None]:
    """Frequencies [rad/s], and a note where the unit was assumed or the numbers speak against it.

    `asked` = the unit that the caller gives, which always holds; `said` = the unit that the file
    names, None where it names none and `default` is taken; `who` = whose unit it is, for the note.
    Raises InputError for a unit that is none.
    """
    if asked is not None:
        return values * factor(asked), None
    unit = said or default
    plain = known_unit(unit, FREQUENCIES)
    round_, round_in_hertz = is_round(values), is_round(values / (2 * np.pi))
    if plain == "Hz" and round_in_hertz and not round_:
        return values, (
            f"{who}: frequencies taken as rad/s{' although Hz is said' if said else ''}, in which"
            " they are the round numbers"
            f" {_first(values / (2 * np.pi))} Hz; if not, give --unit frequency=Hz"
        )
    if said and plain == "rad/s" and round_ and not round_in_hertz:
        return (
            values,
            (
                f"{who}: frequencies taken as rad/s, but {_first(values)} are round; if Hz, give"
                " --unit frequency=Hz"
            ),
        )
    return values * factor(unit), None if said else f"frequencies of {who} taken as {unit}"


def factor(unit: str) -> float:
    """What a frequency of 1 in a unit is in rad/s; raises InputError for another unit."""
    found = omega_per(unit)
    if found is None:
        raise InputError(
            f"{shown(unit)} is no unit of frequency that is known; known are {listed(FREQUENCIES)}:"
            " give --unit frequency=Hz"
        )
    return found


def taken_unit(omega: Real, values: Real, said: str = "") -> str:
    """The unit in which frequencies were read: the one that was `said`, where it is that."""
    one = float(omega[0] / values[0]) if values[0] else 0.0
    alike = [name for name, own in FREQUENCIES.items() if np.isclose(own, one, rtol=1e-9)]
    return said if known_unit(said, alike) or not alike else alike[0]


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
