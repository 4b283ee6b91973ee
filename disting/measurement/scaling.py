"""A measured response in SI units, so that results are in kg m2 or kg, Nm/rad or N/m."""

from dataclasses import replace

from disting.errors import InputError, shown
from disting.measurement.response import ASSUMED_ACCELERATION, FrequencyResponse
from disting.measurement.units import SUFFIX, Motion, agree, drive, motion


def in_si(
    response: FrequencyResponse, *, output: str | None = None, input: str | None = None
) -> FrequencyResponse:
    """The response in SI units where the units of its signals are known; `output`, `input` = units
    in their place.

    The order of a unit (rad/s is a velocity) is that of the sensor where nobody said the sensor's
    quantity. Raises InputError for a unit that is given and not known, and for one that
    contradicts the quantity.

    >>> from disting.measurement import from_arrays
    >>> degrees = from_arrays(range(1, 9), [180, 360] * 4, sensor="position")
    >>> in_si(degrees, output="deg", input="Nm").G.real[:2].round(4).tolist()
    [3.1416, 6.2832]
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
            sensor=unit.sensor,
            notes=tuple(n for n in response.notes if n != ASSUMED_ACCELERATION),
        )
    elif not (asked and unit.order == 0):
        agree(said, response.sensor)
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
