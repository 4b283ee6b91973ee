"""Options of the functions that read measured data, with their types. A file of another format
refuses those that its reader does not have.
"""

from collections.abc import Sequence
from typing import TypedDict

from disting.model.chain import Quantity

UNITS = ("frequency", "phase", "magnitude", "input", "output")
"""Numbers of a file that have a unit."""


class _Shown(TypedDict, total=False):
    """Sensor quantity, and its sign: -1 for a reversed sensor."""

    quantity: Quantity | str
    sign: int


class _Columns(TypedDict, total=False):
    """Columns of a table, and their units where the headers do not state them."""

    column: str | int
    columns: Sequence[str]
    phase_unit: str
    frequency_unit: str
    magnitude_unit: str


class _Clock(TypedDict, total=False):
    """Signals of a record, and its sampling."""

    time: str | int
    reference: str | int


class TableOptions(_Shown, _Columns, total=False):
    """Options of a table of frequency responses; `outliers` as in `mean_of`."""

    outliers: str


class SeriesOptions(_Shown, _Clock, total=False):
    """Options of a table of signals; `sampling_rate` [Hz]."""

    sampling_rate: float


class RecordOptions(_Shown, _Clock, total=False):
    """Options of a file with a record; in a MATLAB file `sampling_rate` may name a variable."""

    sampling_rate: float | str


class LookOptions(_Shown, _Columns, _Clock, total=False):
    """Options of `look`: names of MATLAB variables, the number of a record of a universal file,
    and those of tables, of records and of `TimeSeries.response`.
    """

    sampling_rate: float | str
    frequency: str
    response: str
    deviation: str
    coherence: str
    index: int | Sequence[int]
    record: int
    input: str | int
    output: str | int
    to: Quantity | str
    period: int
    transient: int | None
    lines: Sequence[float]
    band: tuple[float, float]
    segment: int
    least_coherence: float
    trend: str
    hold: float | str


class ReadOptions(LookOptions, total=False):
    """Options of `read`; `outliers` as in `mean_of`."""

    outliers: str
