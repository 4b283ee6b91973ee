"""Measured data: frequency responses and time series, from files and objects, checked and in SI
units.

>>> import numpy as np
>>> from disting.measurement import from_arrays
>>> frequency = np.arange(1.0, 11.0)  # Hz
>>> position = from_arrays(frequency, -1 / (2 * np.pi * frequency) ** 2 / 0.01, sensor="position")
>>> bool(abs(position.to_quantity("acceleration").G - 100).max() < 1e-9)
True
"""

from disting.measurement.files import beginnings as beginnings
from disting.measurement.files import csv_text as csv_text
from disting.measurement.files import read as read
from disting.measurement.files import read_time_series as read_time_series
from disting.measurement.files import write_csv as write_csv
from disting.measurement.objects import from_arrays as from_arrays
from disting.measurement.objects import from_control as from_control
from disting.measurement.objects import from_frame as from_frame
from disting.measurement.objects import series_from_frame as series_from_frame
from disting.measurement.repeats import are_opposite as are_opposite
from disting.measurement.repeats import mean_of as mean_of
from disting.measurement.response import FrequencyResponse as FrequencyResponse
from disting.measurement.response import Signal as Signal
from disting.measurement.scaling import in_si as in_si
from disting.measurement.time_series import TimeSeries as TimeSeries
from disting.model.presentation import offered as _offered


def __dir__() -> list[str]:
    """What the Tab key offers."""
    return _offered(globals())
