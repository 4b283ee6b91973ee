"""Measured responses as a fit takes them: of one quantity and one sign, of numbers that can be
computed with, of not too many lines.
"""

from collections.abc import Sequence

import numpy as np

from disting.errors import InputError
from disting.fit.search.joint import Further
from disting.measurement import FrequencyResponse, are_opposite
from disting.model.chain import Chain

MOST_EXTREME = 1e30  # of a frequency or an amplitude


def checked(
    train: FrequencyResponse,
    test: FrequencyResponse | None,
    further: Sequence[Further],
    candidates: Sequence[Chain],
    most: int,
) -> tuple[FrequencyResponse, FrequencyResponse | None, Sequence[Further]]:
    """The responses with at most so many lines each; raises InputError for what no fit is made
    of.
    """
    if not candidates:
        raise InputError("a selection needs at least one candidate")
    _check_pair(train, test)
    other = {c.sensor for c in candidates} - {train.sensor}
    if other:
        raise InputError(
            f"the data shows {train.sensor.value}, a candidate {other.pop().value}; choose one"
            " sensor quantity"
        )
    for data in filter(None, (train, test)):
        _check_units(data)
    for one in further:  # each against its own test data
        if one.test is not None and test is None:
            raise InputError("test data of a further response need test data of the first one too")
        _check_pair(one.measured, one.test)
        for data in filter(None, (one.measured, one.test)):
            _check_units(data)
    thinned = None if test is None else test.thinned(most)
    return train.thinned(most), thinned, [one.thinned(most) for one in further]


def _check_pair(train: FrequencyResponse, test: FrequencyResponse | None) -> None:
    if test is not None and test.sensor is not train.sensor:
        raise InputError(
            f"training shows {train.sensor.value}, test {test.sensor.value}; convert one of them"
        )
    if test is not None and are_opposite(train, test):
        raise InputError(
            "training and test are of opposite sign; reverse one of them, as by sign_reversed()"
        )


def _check_units(data: FrequencyResponse) -> None:
    """Numbers whose squares and products floating point holds; beyond these no unit of
    measurement is sensible.
    """
    for name, values, unit in (
        ("frequencies", data.omega, "rad/s"),
        ("amplitudes", np.abs(data.G), "output per input"),
    ):
        low, high = float(values.min()), float(values.max())
        if low < 1 / MOST_EXTREME or high > MOST_EXTREME:
            limits = f"a fit computes with {1 / MOST_EXTREME:g} to {MOST_EXTREME:g}"
            raise InputError(
                f"the {name} are {low:g} to {high:g} {unit}; {limits}: choose other units or leave"
                " lines out"
            )
