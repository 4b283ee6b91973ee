"""The options of the functions that read: typed, named as on the command line, old names accepted
for one version.
"""

import inspect
from typing import get_type_hints

import numpy as np
import pytest

from disting import InputError
from disting.fit import chosen_ports, figure_1, whole_family
from disting.measurement import (
    TimeSeries,
    from_arrays,
    from_frame,
    look,
    read,
    read_time_series,
    series_from_frame,
    write_csv,
)
from disting.measurement.formats import frequency_response
from disting.measurement.matlab import from_object
from disting.measurement.options import ReadOptions, TableOptions
from disting.measurement.table import time_series
from disting.measurement.uff import read_uff
from disting.measurement.variables import from_variables, series_from_variables

READERS = (
    frequency_response, from_variables, from_object, read_uff, time_series, series_from_variables,
)  # fmt: skip
HERTZ = np.arange(1.0, 21.0)
G = 1 / (1 + 0.1j * HERTZ)


def options_of(function) -> set[str]:
    kinds = inspect.signature(function).parameters.values()
    return {p.name for p in kinds if p.kind is p.KEYWORD_ONLY}


def test_the_types_of_options_are_those_of_the_readers():
    estimate = {*inspect.signature(TimeSeries.response).parameters} - {"self"}
    own = {"to", "input", "output"}  # of records
    assert get_type_hints(ReadOptions).keys() == estimate.union(own, *map(options_of, READERS))
    assert get_type_hints(TableOptions).keys() == options_of(frequency_response)


def test_the_old_name_of_quantity_is_accepted_with_a_warning(tmp_path):
    import pandas as pd

    path, record = tmp_path / "a.csv", tmp_path / "b.csv"
    write_csv(from_arrays(HERTZ, G), path)
    record.write_text("\n".join(["t [s],u,y", *(f"{k / 100},{k % 7},{k % 5}" for k in range(60))]))
    table = pd.DataFrame({"f [Hz]": HERTZ, "re": G.real, "im": G.imag})
    signals = pd.DataFrame({"u": [k % 3 for k in range(30)], "y": [k % 5 for k in range(30)]})
    calls = (
        lambda **k: from_arrays(HERTZ, G, **k),
        lambda **k: from_arrays(HERTZ, G).to_quantity(**k),
        lambda **k: from_frame(table, **k),
        lambda **k: series_from_frame(signals, "u", "y", sampling_rate=100.0, **k),
        lambda **k: read(path, **k),
        lambda **k: read_time_series(record, "u", "y", **k),
        lambda **k: look(path, **k).response,
        lambda **k: figure_1([1], **k),
        lambda **k: whole_family([1], **k),
        lambda **k: chosen_ports([1], "1", "1", **k),
    )
    for call in calls:
        with pytest.warns(DeprecationWarning, match="the argument sensor is now called quantity"):
            old = call(sensor="velocity")
        assert old == call(quantity="velocity")
    with pytest.raises(InputError, match="give quantity alone"):
        read(path, quantity="velocity", sensor="velocity")
