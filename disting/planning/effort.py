"""Data to plan for: frequencies of the lines and their scatter."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from disting.errors import InputError
from disting.measurement import FrequencyResponse
from disting.measurement.arrays import Real
from disting.measurement.impedance import as_impedance
from disting.model.chain import Sort
from disting.planning.rival import AnyStructure, responses_of, sensor_of
from disting.statistics.scatter import scatter

LINES = 120
FEWEST = 8  # lines of a response
MOST_REPEATS = 1000  # beyond, a scatter is known


@dataclass(frozen=True, eq=False)
class Effort:
    """Lines [rad/s] and their scatter, shape (n_f,) each, where it is known from, and of how many
    repeats a fit will find it (None: it is known).
    """

    omega: Real
    rho: Real
    source: str
    repeats: int | None = 1
    notes: tuple[str, ...] = ()  # of the response that they are taken from


def effort_of(
    model: AnyStructure,
    values: Mapping[str, float],
    noise: float | FrequencyResponse,
    *,
    band: tuple[float, float] | None = None,
    lines: int | None = None,
    repeats: int | None = None,
) -> Effort:
    """Lines from `band` [Hz], evenly spaced on a logarithmic scale, all with relative noise
    `noise`; or those of a measured response, within the band, with the scatter that it shows of
    `model` with these values, and its own number of repeats if none is given. Raises InputError.
    """
    if lines is not None and lines < FEWEST:
        raise InputError(f"at least {FEWEST} lines are needed, not {lines}")
    if isinstance(noise, FrequencyResponse):
        return _as_measured(model, values, noise, band, lines, repeats)
    low, high = band or (0.0, 0.0)
    if not 0 < low < high:
        raise InputError("give the frequencies of the lines [Hz]: --band 5..300")
    count = lines or LINES
    omega, rho = 2 * np.pi * np.geomspace(low, high, count), np.full(count, float(noise))
    return Effort(omega, rho, "given", repeats)


def _as_measured(
    model: AnyStructure,
    values: Mapping[str, float],
    response: FrequencyResponse,
    band: tuple[float, float] | None,
    lines: int | None,
    repeats: int | None,
) -> Effort:
    """Lines and scatter of a measured response."""
    if lines is not None:
        raise InputError("the lines are those of the measured response: remove --lines")
    is_machine = model.sort is Sort.MACHINE
    response = response.to_quantity(sensor_of(model)) if is_machine else as_impedance(response)
    notes = (*response.notes, *response.suspicions)
    response = response.masked(*band) if band else response
    responses = responses_of(model, values, response.omega)
    if len(responses) > 1:
        raise InputError(
            f"the measured response is one, {len(responses)} are planned: give the scatter of a"
            " line, such as --noise 0.02 --band 5..300"
        )
    known = scatter(response, list(responses))
    own = min(1 + round((response.freedom or 0.0) / 2), MOST_REPEATS)
    source = f"known from {known.source}"
    return Effort(response.omega, known.rho, source, repeats or own, notes)
