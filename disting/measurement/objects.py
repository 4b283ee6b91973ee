"""Frequency responses from objects in memory: NumPy arrays, pandas data frames, frequency
response data of python-control.
"""

from typing import Any, Unpack

import numpy as np
from numpy.typing import NDArray

from disting.errors import InputError
from disting.measurement.options import SeriesOptions, TableOptions
from disting.measurement.response import FrequencyResponse, Signal, as_sign
from disting.measurement.scaling import factor
from disting.measurement.table import Table, time_series
from disting.measurement.tabular import frequency_response
from disting.measurement.time_series import TimeSeries
from disting.measurement.variables import row
from disting.model.chain import Quantity, as_quantity
from disting.renamed import renamed


@renamed(sensor="quantity")
def from_arrays(
    frequency: Any,
    response: Any,
    *,
    frequency_unit: str = "Hz",
    deviation: Any = None,
    coherence: Any = None,
    quantity: Quantity | str = Quantity.ACCELERATION,
    sign: int = 1,
) -> FrequencyResponse:
    """Response from arrays of shape (n_f,): `frequency` in a unit of `units.FREQUENCIES`, complex
    `response`, `quantity` of the sensor. Raises InputError for arrays that do not fit each other,
    an unknown unit, or fewer lines than a response has.

    >>> data = from_arrays(range(1, 9), [1 + 1j, 2 - 1j] * 4, quantity="position")
    >>> data.omega.round(2).tolist()[:2], data.quantity.value
    ([6.28, 12.57], 'position')
    """
    omega = _numbers(frequency, "frequency") * factor(frequency_unit)
    values = _numbers(response, "response") * as_sign(sign)
    return FrequencyResponse(
        omega=omega,
        G=values,
        deviation=deviation,
        coherence=coherence,
        quantity=as_quantity(quantity),
        origin="arrays",
    )


@renamed(sensor="quantity")
def from_frame(frame: Any, **options: Unpack[TableOptions]) -> FrequencyResponse:
    """Response from a pandas data frame whose columns are headed like those of a text file
    (`read`); same options.

    An index with a name is a column too. Raises InputError for another object, and as `read` does.

    >>> import pandas as pd
    >>> frame = pd.DataFrame({"frequency [Hz]": range(1, 9), "re": range(8, 0, -1), "im": range(8)})
    >>> len(from_frame(frame))
    8
    """
    return frequency_response(_table(frame), **options)


@renamed(sensor="quantity")
def series_from_frame(
    frame: Any, input: str | int, output: str | int, **options: Unpack[SeriesOptions]
) -> TimeSeries:
    """Samples from two columns of a pandas data frame; options of `read_time_series`. Raises
    InputError for another object, and as that does.

    >>> import pandas as pd
    >>> frame = pd.DataFrame({"u": [k % 3 for k in range(30)], "y": [k % 5 for k in range(30)]})
    >>> series_from_frame(frame, "u", "y", sampling_rate=100.0).quantity.value
    'position'
    """
    return time_series(_table(frame), input, output, **options)


@renamed(sensor="quantity")
def from_control(
    system: Any,
    *,
    output: int = 0,
    input: int = 0,
    quantity: Quantity | str = Quantity.ACCELERATION,
    sign: int = 1,
) -> FrequencyResponse:
    """Response from a python-control FRD object: channel from `input` to `output` (from 0). Raises
    InputError for another object or channel.

    >>> import control
    >>> system = control.frd([1j * k for k in range(1, 9)], [1.0 * k for k in range(1, 9)])
    >>> from_control(system, quantity="velocity").omega.tolist()[:3]
    [1.0, 2.0, 3.0]
    """
    data = getattr(system, "frdata", None)
    # its name before python-control 0.10.2
    data = getattr(system, "fresp", None) if data is None else data
    if data is None or not hasattr(system, "omega"):
        raise InputError(
            f"{type(system).__name__} is not frequency response data of python-control"
            " (control.frd)"
        )
    omega = _numbers(system.omega, "omega")
    values = row(
        _numbers(data, "response"),
        len(omega),
        _channel(np.shape(data), output, input),
        "the FRD object",
    )
    names = (_label(system, "input_labels", input), _label(system, "output_labels", output))
    return FrequencyResponse(
        omega,
        values * as_sign(sign),
        quantity=as_quantity(quantity),
        input=names[0],
        output=names[1],
        origin="python-control FRD",
    )


def _channel(shape: tuple[int, ...], output: int, input: int) -> tuple[int, ...]:
    """Index without the axes of length 1, which `row` leaves out."""
    if len(shape) != 3 or not (0 <= output < shape[0] and 0 <= input < shape[1]):
        raise InputError(
            f"the FRD object has {' x '.join(map(str, shape[:2]))} outputs and inputs; {output},"
            f" {input} is not one of them"
        )
    return tuple(i for i, length in zip((output, input), shape[:2], strict=True) if length > 1)


def _label(system: Any, attribute: str, number: int) -> Signal:
    labels = getattr(system, attribute, None) or []
    return Signal(str(labels[number]) if number < len(labels) else "")


def _table(frame: Any) -> Table:
    if not all(hasattr(frame, name) for name in ("columns", "index", "reset_index", "to_numpy")):
        raise InputError(f"{type(frame).__name__} is not a pandas data frame")
    whole = frame.reset_index() if frame.index.name is not None else frame
    try:
        values = whole.to_numpy(dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise InputError(
            f"the data frame holds something else than real numbers: {error}"
        ) from None
    if not len(values):
        raise InputError("the data frame has no rows")
    return Table(
        headers=tuple(map(str, whole.columns)),
        values=values,
        lines=tuple(range(1, len(values) + 1)),
        comments=(),
        origin="data frame",
    )


def _numbers(values: Any, name: str) -> NDArray[Any]:
    array = np.asarray(values)
    if array.dtype.kind not in "biufc":
        raise InputError(f"{name} must be an array of numbers")
    return array
