"""Frequency responses and time series from named arrays, as MATLAB files and archives of arrays
hold them.

`NAME[2]` is the second signal of an array of several, `NAME[2,1]` the response from the first
input to the second output: numbers from 1, as in MATLAB.
"""

import re
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from disting.errors import InputError, enumeration, short
from disting.measurement.arrays import Real
from disting.measurement.column_words import Role, Why, is_called_impedance, matching
from disting.measurement.response import (
    ASSUMED_ACCELERATION,
    ASSUMED_IMPEDANCE,
    FrequencyResponse,
    Signal,
    as_sign,
)
from disting.measurement.scaling import in_omega, taken_unit
from disting.measurement.table import rate_of
from disting.measurement.time_series import TimeSeries, said
from disting.measurement.understanding import Use, record_variables, sentence
from disting.model.chain import Quantity, as_quantity

HERTZ_NAMES = ("f", "freq", "frequency", "Frequency", "f_Hz", "fHz", "freqs", "frequencies", "F")
OMEGA_NAMES = ("w", "omega", "Omega", "om", "wout")
RESPONSE_NAMES = ("G", "H", "FRF", "frf", "response", "ResponseData", "Gfrf", "Hfrf", "FRFs")
DEVIATION_NAMES = ("std", "sigma", "deviation", "stdG", "G_std", "sG", "std_G")
COHERENCE_NAMES = ("coh", "coherence", "Coh", "gamma2", "C")
RATE_NAMES = ("fs", "Fs", "fsample", "sampling_rate")
STEP_NAMES = ("Ts", "ts", "dt", "T_s")
TIME_NAMES = ("t", "time", "Time")

INDEXED = re.compile(r"(.+?)(?:\[|\((?::,)?)([0-9]{1,9}(?:,[0-9]{1,9})*)[\])]")

# by name; called where needed, so that others may be unreadable
Arrays = Mapping[str, Callable[[], NDArray[Any]]]


def from_variables(
    arrays: Arrays,
    origin: str,
    *,
    frequency: str | None = None,
    response: str | None = None,
    deviation: str | None = None,
    coherence: str | None = None,
    frequency_unit: str | None = None,
    index: int | Sequence[int] | None = None,
    quantity: Quantity | str | None = None,
    sign: int = 1,
) -> FrequencyResponse:
    """Response from variables of these names; without names, usual ones (f, freq, w, omega; G, H,
    FRF, ...) are searched.

    `frequency_unit` = "Hz", "kHz" or "rad/s" where the name does not state it; `index` = which
    response (from 0, one number for every other axis) of an array of several; `quantity`, `sign` as
    for a text file.
    """
    name = _name(arrays, frequency, (*HERTZ_NAMES, *OMEGA_NAMES), "frequency", origin)
    default = "rad/s" if name in OMEGA_NAMES else "Hz"
    grid = real_part(_numeric(arrays, name, origin), f"{origin}: {name}").ravel()
    values, taken = in_omega(grid, None, frequency_unit, short(name), default=default)
    response, chosen_index = split_index(response)
    index = index if chosen_index is None else chosen_index
    chosen = _name(arrays, response, RESPONSE_NAMES, "response", origin)
    impedance = quantity is None and (chosen == "Z" or is_called_impedance(chosen))
    scatter = _optional(arrays, deviation, DEVIATION_NAMES, len(values), index, origin)
    shared = _optional(arrays, coherence, COHERENCE_NAMES, len(values), index, origin)
    the_response = FrequencyResponse(
        values,
        row(_numeric(arrays, chosen, origin), len(values), index, chosen) * as_sign(sign),
        scatter[1],
        shared[1],
        quantity=as_quantity(
            quantity or (Quantity.POSITION if impedance else Quantity.ACCELERATION)
        ),
        output=Signal(chosen),
        origin=f"{origin}, {chosen}",
        is_impedance=impedance,
    )
    unit = taken_unit(values, grid)
    guessed = Why.BY_NAME if unit == default else Why.BY_NUMBERS
    uses = {
        name: Use(Role.FREQUENCY, unit, Why.OPTION if frequency_unit else guessed),
        chosen: Use(Role.RESPONSE),
        scatter[0]: Use(Role.DEVIATION),
        shared[0]: Use(Role.COHERENCE),
    }
    names = (frequency, response, deviation, coherence)
    read = record_variables(arrays, {n: use for n, use in uses.items() if n}, names)
    assumed = ASSUMED_IMPEDANCE if impedance else ASSUMED_ACCELERATION
    noted = the_response.noted(None if quantity else assumed, taken)
    return noted.read_as(sentence(read), read)


def holds_response(arrays: Arrays) -> bool:
    """Return True if there are variables with the usual names of frequencies and of a response."""
    return holds_frequencies(arrays) and any(name in arrays for name in RESPONSE_NAMES)


def holds_frequencies(arrays: Arrays) -> bool:
    """Return True if there is a variable with a usual name of frequencies."""
    return any(name in arrays for name in (*HERTZ_NAMES, *OMEGA_NAMES))


def series_from_variables(
    arrays: Arrays,
    origin: str,
    input: str,
    output: str,
    *,
    reference: str | None = None,
    sampling_rate: float | str | None = None,
    time: str | None = None,
    quantity: Quantity | str | None = None,
    sign: int = 1,
) -> TimeSeries:
    """Samples of the variables `input` and `output`; `sampling_rate` [Hz] = a number or a
    variable, or `time` [s] = a variable.

    Without either, fs, Fs, Ts, dt, then t, time are searched. A signal may be `NAME[2]`, one of an
    array of several.
    """
    rate, clock = _rate(arrays, sampling_rate, time, origin)
    signals = Signal(input), Signal(output)
    samples = _signal(arrays, input, origin), _signal(arrays, output, origin) * as_sign(sign)
    shown, notes = said(quantity, signals[1])
    wanted = None if reference is None else _signal(arrays, reference, origin)
    uses = {
        clock: Use(Role.CLOCK),
        split_index(input)[0]: Use(Role.INPUT),
        split_index(output)[0]: Use(Role.OUTPUT),
        (split_index(reference)[0] or ""): Use(Role.REFERENCE),
    }
    names = {split_index(n)[0] for n in (input, output, reference, time)}
    names |= {sampling_rate} if isinstance(sampling_rate, str) else set()
    read = record_variables(arrays, {n: use for n, use in uses.items() if n}, names)
    title = f"{origin}, {output} per {input}"
    return TimeSeries(*samples, rate, shown, *signals, title, notes, wanted, columns=read)


def split_index(asked: str | None) -> tuple[str | None, tuple[int, ...] | None]:
    """Name and numbers, from 0, of a text such as `NAME[2]`; None where there are none.

    >>> split_index("data[2]"), split_index("frf.Pv[2,1]"), split_index("iq")
    (('data', (1,)), ('frf.Pv', (1, 0)), ('iq', None))
    >>> split_index("data(:,2)")
    ('data', (1,))
    """
    match = INDEXED.fullmatch(asked) if asked else None
    return (match[1], tuple(int(n) - 1 for n in match[2].split(","))) if match else (asked, None)


def row(
    values: NDArray[Any], size: int, index: int | Sequence[int] | None, name: str
) -> NDArray[Any]:
    """One response of `size` lines from an array whose other axes count responses, taken at
    `index`.
    """
    array = np.squeeze(np.asarray(values))
    array = array.reshape(1) if array.ndim == 0 else array
    axes = [axis for axis, length in enumerate(array.shape) if length == size]
    if not axes:
        raise InputError(
            f"{name} of shape {np.shape(values)} has no axis of {size} values, one a frequency"
        )
    several = np.moveaxis(array, axes[-1], -1)
    if several.ndim == 1:
        return several
    at = (index,) if isinstance(index, int) else tuple(index or ())
    if len(at) != several.ndim - 1 or any(
        not 0 <= i < n for i, n in zip(at, several.shape, strict=False)
    ):
        shape = " x ".join(map(str, several.shape[:-1]))
        raise InputError(
            f"{name} holds {shape} responses; choose one, from 1, as"
            f" --read response={name}[{','.join('1' * (several.ndim - 1))}]"
        )
    return np.asarray(several[at])


def _name(arrays: Arrays, asked: str | None, usual: Sequence[str], role: str, origin: str) -> str:
    if asked is None:
        variable = next((name for name in usual if name in arrays), None)
        if variable is None:
            raise InputError(
                f"{origin}: which variable is the {role}? give --read {role}=NAME; variables:"
                f" {_list_arrays(arrays)}"
            )
        return variable
    names = list(arrays)
    found = matching(names, asked)
    if len(found) != 1:
        count = f"{len(found)} variables like" if found else "no variable"
        raise InputError(f"{origin} has {count} {short(asked)}; variables: {_list_arrays(arrays)}")
    return names[found[0]]


def _optional(
    arrays: Arrays,
    asked: str | None,
    usual: Sequence[str],
    size: int,
    index: int | Sequence[int] | None,
    origin: str,
) -> tuple[str, Real | None]:
    """The requested variable; or the first usual one, if it has one value for each line; its name
    and its numbers, "" and None for none.
    """
    if asked is not None:
        return asked, row(
            _numeric(arrays, _name(arrays, asked, (), "", origin), origin), size, index, asked
        )
    for name in (n for n in usual if n in arrays):
        try:
            return name, row(_numeric(arrays, name, origin), size, index, name)
        except InputError:
            continue  # another thing of that name
    return "", None


def _numeric(arrays: Arrays, name: str, origin: str) -> NDArray[Any]:
    array = np.asarray(arrays[name]())
    if array.dtype.kind not in "biufc" or not array.size:
        raise InputError(
            f"{origin}: {name} is not an array of numbers; variables: {_list_arrays(arrays)}"
        )
    return array.astype(np.complex128 if array.dtype.kind == "c" else np.float64)


def real_part(values: NDArray[Any], name: str) -> Real:
    """The numbers where all are real; raises InputError where some are not."""
    if np.any(values.imag):
        raise InputError(
            f"{name} is complex; frequencies and times are real: store the part that is meant alone"
        )
    return np.asarray(values.real, dtype=np.float64)


def _signal(arrays: Arrays, asked: str, origin: str) -> NDArray[Any]:
    """One signal of a variable, the longest axis of which is time."""
    name, index = (asked, None) if asked in arrays else split_index(asked)
    values = np.squeeze(_numeric(arrays, _name(arrays, name, (), "signal", origin), origin))
    if values.ndim == 2:
        several = values.T if values.shape[0] >= values.shape[1] else values
        if index is None or len(index) != 1 or not 0 <= index[0] < len(several):
            raise InputError(
                f"{name} holds {len(several)} signals; choose one, from 1, as {name}[2]"
            )
        return np.asarray(several[index[0]])
    if values.ndim != 1 or index is not None:
        raise InputError(f"{asked} is not a single signal: {name} is of shape {values.shape}")
    return np.asarray(values)


def _rate(
    arrays: Arrays, asked: float | str | None, time: str | None, origin: str
) -> tuple[float, str]:
    """Sampling rate [Hz] and the variable that gives it, "" for none."""
    if asked is not None and not isinstance(asked, str):
        return asked, ""
    if isinstance(asked, str) or (time is None and any(n in arrays for n in RATE_NAMES)):
        name = _name(arrays, asked, RATE_NAMES, "sampling_rate", origin)
        return _scalar(arrays, name, origin), name
    if time is None and any(n in arrays for n in STEP_NAMES):
        name = _name(arrays, None, STEP_NAMES, "step", origin)
        return 1.0 / _scalar(arrays, name, origin), name
    name = time if time is not None else _name(arrays, None, TIME_NAMES, "sampling_rate", origin)
    times = real_part(_signal(arrays, name, origin), f"{origin}: {name}")
    return rate_of(times, f"{origin}, {name}"), name


def _scalar(arrays: Arrays, name: str, origin: str) -> float:
    values = _numeric(arrays, name, origin)
    if values.size != 1 or np.iscomplexobj(values) or not values.item() > 0:
        raise InputError(f"{origin}: {name} is not a positive number; give --read sampling_rate=HZ")
    return float(values.item())


def _list_arrays(arrays: Arrays) -> str:
    return enumeration(sorted(arrays)) or "none"
