"""Measured data: frequency responses and time series, from files and objects, checked and in SI
units.

>>> import numpy as np
>>> from disting.measurement import from_arrays
>>> frequency = np.arange(1.0, 11.0)  # Hz
>>> position = from_arrays(frequency, -1 / (2 * np.pi * frequency) ** 2 / 0.01, quantity="position")
>>> bool(abs(position.to_quantity("acceleration").G - 100).max() < 1e-9)
True

The names:

    read, read_time_series           a frequency response, a record from a file
    look, Look                       what is read from a file and what is assumed
    from_arrays, from_frame, from_control   a response from numpy, pandas, python-control
    series_from_frame                a record from pandas
    FrequencyResponse, TimeSeries, Signal   response; record; name and unit of a signal
    mean_of, are_opposite            mean of repeats; whether two responses differ in sign
    in_si                            a response in SI units
    write_csv, csv_text              a response as a text file
    beginnings                       columns at which the responses of a file begin
"""

from disting.lazy import TYPE_CHECKING, offer

if TYPE_CHECKING:
    from disting.measurement.files import (
        beginnings as beginnings,
        csv_text as csv_text,
        read as read,
        read_time_series as read_time_series,
        write_csv as write_csv,
    )
    from disting.measurement.looking import Look as Look, look as look
    from disting.measurement.objects import (
        from_arrays as from_arrays,
        from_control as from_control,
        from_frame as from_frame,
        series_from_frame as series_from_frame,
    )
    from disting.measurement.repeats import are_opposite as are_opposite, mean_of as mean_of
    from disting.measurement.response import (
        FrequencyResponse as FrequencyResponse,
        Signal as Signal,
    )
    from disting.measurement.scaling import in_si as in_si
    from disting.measurement.time_series import TimeSeries as TimeSeries

offer(__name__)
