"""A measured response in SI units, so that results are in kg m2 or kg, Nm/rad or N/m.

The unit of a grid of frequencies: the unit stated by a file or a caller, compared with the numbers
themselves.

Who measures a response chooses round frequencies in the unit in which he thinks: 0.1, 0.2, .. 1000
Hz. In a file of the other unit these are 0.628, 1.257, ... So a grid that is round after division
by 2 pi, and is not round itself, is in rad/s.
"""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from disting.errors import InputError, enumeration, short
from disting.measurement.arrays import Real, apply
from disting.measurement.options import UNITS
from disting.measurement.response import ASSUMED_ACCELERATION, FrequencyResponse
from disting.measurement.units import (
    FREQUENCIES,
    SUFFIX,
    Motion,
    agree,
    drive,
    known_unit,
    motion,
    omega_per,
)

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
            f"{who}: frequencies taken as rad/s{' although Hz is stated' if said else ''}, in which"
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
    """Factor from a unit of frequency to rad/s; raises InputError for another unit."""
    value = omega_per(unit)
    if value is None:
        raise InputError(
            f"{short(unit)} is not a known unit of frequency; known units:"
            f" {enumeration(FREQUENCIES)}: give --unit frequency=Hz"
        )
    return value


def taken_unit(omega: Real, values: Real, said: str = "") -> str:
    """The unit in which frequencies were read: the one that was `said`, where it is known."""
    value = float(omega[0] / values[0]) if values[0] else 0.0
    alike = [name for name, own in FREQUENCIES.items() if np.isclose(own, value, rtol=1e-9)]
    return said if known_unit(said, alike) or not alike else alike[0]


def is_round(values: Real) -> bool:
    """Return True if all numbers have `DIGITS` digits at most.

    >>> is_round(np.arange(1, 251) * 0.1), is_round(np.arange(1, 251) * 0.2 * np.pi)
    (True, False)
    """
    if not len(values) or not np.all((values > SLOWEST) & (values < 1 / SLOWEST)):
        return False
    power = 10.0 ** (np.floor(np.log10(values)) - (DIGITS - 1))
    return bool(np.all(np.abs(values - np.rint(values / power) * power) <= EXACT * values))


def _first(values: Real) -> str:
    return f"{', '.join(f'{value:.5g}' for value in values[:3])}, .."


def in_si(
    response: FrequencyResponse, *, output: str | None = None, input: str | None = None
) -> FrequencyResponse:
    """The response in SI units where the units of its signals are known; `output`, `input` = units
    in their place.

    The order of a unit (rad/s is a velocity) is that of the sensor where the sensor's quantity is
    not given. Raises InputError for a unit that is given and not known, and for one that
    contradicts the quantity.

    >>> from disting.measurement import from_arrays
    >>> degrees = from_arrays(range(1, 9), [180, 360] * 4, quantity="position")
    >>> in_si(degrees, output="deg", input="Nm").G.real[:2].round(4).tolist()
    [3.1416, 6.2832]
    """
    output_unit, input_unit = (
        motion(output or response.output.unit),
        drive(input or response.input.unit),
    )
    for text, unit, example in (
        (output, output_unit, "rad, mm/s, rpm"),
        (input, input_unit, "A, Nm, N"),
    ):
        if text and unit is None:
            raise InputError(f"{short(text)} is not a known unit; examples: {example}")
    if output_unit is not None:
        response = _to_unit(
            response, output_unit, said=output or response.output.unit, asked=output is not None
        )
    if input_unit is None:
        return response
    return _scale_response(
        replace(response, input=response.input._replace(unit=input_unit[0])), 1 / input_unit[1]
    )


def with_constant(response: FrequencyResponse, constant: float) -> FrequencyResponse:
    """The response per torque or force where the input is a current: divided by `constant`
    [Nm/A, or N/A for a motion in m].
    """
    if not 0 < constant < float("inf"):
        raise InputError(f"a torque constant is positive [Nm/A or N/A], not {constant:g}")
    if response.input.unit in ("N", "Nm"):
        raise InputError(f"the input is in {response.input.unit} already; remove --torque-constant")
    unit = motion(response.output.unit)
    note = (
        None
        if unit
        else (
            "the output is taken to be in rad, the results are rotational; if not, give --unit"
            " output=m"
        )
    )
    base = unit.base if unit else "rad"
    units = (
        response.output._replace(unit=base + SUFFIX[response.quantity.order]),
        response.input._replace(unit="N" if base == "m" else "Nm"),
    )
    return _scale_response(replace(response, output=units[0], input=units[1]), 1 / constant).noted(
        note
    )


def scale(response: FrequencyResponse, factor: float) -> FrequencyResponse:
    """The response times a positive factor; raises InputError for another one."""
    if not 0 < factor < float("inf"):
        raise InputError(
            f"a scale is a positive number, not {factor:g}; a reversed sensor is --sign=-"
        )
    return _scale_response(response, factor)


def in_units(
    response: FrequencyResponse,
    unit: Mapping[str, str],
    scale_by: float | None,
    torque_constant: float | None,
) -> FrequencyResponse:
    """The response times a factor, in SI units, `unit` naming those of "input" and "output" that
    the file does not; per torque where the input is a current. Raises InputError.
    """
    response = response if scale_by is None else scale(response, scale_by)
    response = in_si(response, input=unit.get("input"), output=unit.get("output"))
    return response if torque_constant is None else with_constant(response, torque_constant)


def reader_units(unit: Mapping[str, str]) -> dict[str, str]:
    """The options of a reader that name units; raises InputError for a unit of something else.

    >>> reader_units({"phase": "rad", "output": "deg"})
    {'phase_unit': 'rad'}
    """
    unknown = [name for name in unit if name not in UNITS]
    if unknown:
        raise InputError(f"a unit is one of {', '.join(UNITS)}, not of {short(unknown[0])}")
    return {f"{name}_unit": unit[name] for name in UNITS[:3] if name in unit}


def _to_unit(
    response: FrequencyResponse, unit: Motion, said: str, asked: bool
) -> FrequencyResponse:
    assumed = ASSUMED_ACCELERATION in response.notes
    if assumed:
        response = replace(
            response,
            quantity=unit.quantity,
            notes=tuple(n for n in response.notes if n != ASSUMED_ACCELERATION),
        )
    elif not (asked and unit.order == 0):
        agree(said, response.quantity)
    note = (
        f"output taken from {said} to {unit.base}{SUFFIX[unit.order]}" if unit.factor != 1 else None
    )
    signal = response.output._replace(unit=unit.base + SUFFIX[response.quantity.order])
    return _scale_response(replace(response, output=signal), unit.factor).noted(note)


def _scale_response(response: FrequencyResponse, factor: float) -> FrequencyResponse:
    if factor == 1:
        return response
    return replace(
        response,
        G=response.G * factor,
        deviation=apply(lambda d: d * factor, response.deviation),
        nonlinear=apply(lambda d: d * factor, response.nonlinear),
        distortion=response.distortion and response.distortion.times(factor),
    )
