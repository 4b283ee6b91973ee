"""A real two-mass bench: its frequency responses from its records, as they were derived
independently.
"""

import numpy as np
import pytest

from disting.errors import InputError
from disting.measurement import read, read_time_series, write_csv
from disting.model.chain import Quantity
from tests.measurement.bench_data import measured_data

PRINTED = 6e-9  # the derived files carry nine digits
SIDES = [("theta_mx", 1, "ReG_mot"), ("theta_my", -1, "ReG_load")]


@pytest.mark.full
@pytest.mark.parametrize(("experiment", "lines"), [("A", np.arange(11, 251)), ("B", None)])
@pytest.mark.parametrize(("angle", "sign", "header"), SIDES)
def test_the_records_give_the_published_responses(experiment, lines, angle, sign, header):
    record = measured_data(f"fditools_motorbench_{experiment}.mat")
    derived = read(measured_data(f"fditools_motorbench_frf_{experiment}.csv"), column=header)
    signals = {"input": "iq_adx", "output": angle, "sign": sign, "quantity": "position"}
    found = read(record, **signals, to="acceleration", trend="keep")
    # the angle creeps by 1 mrad in 20 s, and wanders, which a mean of 19 periods hardly sees
    still = read(record, **signals, to="acceleration")
    assert np.max(np.abs(still.G - found.G) / found.noise) < 1
    assert np.median(still.noise / found.noise) < 1
    assert found.quantity == derived.quantity == Quantity.ACCELERATION and found.suspicions == ()
    assert len(found) == {"A": 240, "B": 60}[experiment] and (
        lines is None or np.allclose(found.frequency, lines)
    )
    np.testing.assert_allclose(found.omega, derived.omega, rtol=1e-14)
    np.testing.assert_allclose(found.G, derived.G, rtol=PRINTED)
    np.testing.assert_allclose(found.noise, derived.deviation, rtol=PRINTED)
    # experiment B leaves odd lines without excitation, and its friction shows there
    assert (found.nonlinear is not None) == (experiment == "B")
    np.testing.assert_allclose(found.coherence, derived.coherence, atol=PRINTED)
    assert found.notes[0] == "period of 2500 samples (1 s) detected in the input"


def test_the_load_angle_of_the_bench_is_seen_to_be_reversed():
    found = read(
        measured_data("fditools_motorbench_A.mat"),
        input="iq_adx",
        output="theta_my",
        to="acceleration",
    )
    assert any("reversed sensor" in suspicion for suspicion in found.suspicions)


def test_an_object_that_cannot_be_read_does_not_hide_the_rest():
    path = measured_data("fditools_motorbench_A.mat")
    series = read_time_series(path, "iq_adx", "omega_may", quantity="velocity")
    assert (len(series), series.sampling_rate, series.quantity) == (
        50000,
        2500.0,
        Quantity.VELOCITY,
    )
    with pytest.raises(InputError, match=r"ms .*no array of numbers"):
        read_time_series(path, "iq_adx", "ms")
    with pytest.raises(
        InputError, match=r"no variable 'theta'; variables: .*omega_may, .*theta_mx"
    ):
        read_time_series(path, "iq_adx", "theta")


@pytest.mark.full
def test_welch_agrees_with_the_periods_within_the_deviations():
    path = measured_data("fditools_motorbench_A.mat")
    series = read_time_series(path, "iq_adx", "theta_mx")
    periodic = series.response("acceleration").masked(20, 240)
    welch = series.response("acceleration", segment=2500, band=(20, 240))
    assert np.allclose(welch.omega, periodic.omega[::2])
    assert np.median(np.abs(welch.G / periodic.G[::2] - 1)) < 0.02


def test_a_real_response_is_written_and_read_bit_by_bit(tmp_path):
    found = read(measured_data("fditools_motorbench_B.mat"), input="iq_adx", output="theta_mx")
    write_csv(found, tmp_path / "b.csv")
    assert read(tmp_path / "b.csv") == found


def test_a_wrong_column_lists_the_headers():
    with pytest.raises(
        InputError, match=r"no columns are called 'G'; headers: f_Hz, ReG_mot, .*, coh_load"
    ):
        read(measured_data("fditools_motorbench_frf_A.csv"), column="G")
