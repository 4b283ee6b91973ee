"""Frequency responses in MATLAB objects: a real file of them, and files written by the layout."""

from contextlib import suppress

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings, strategies as st

from disting.cli import main
from disting.errors import InputError
from disting.measurement import Signal, read, read_time_series
from disting.model.chain import Quantity
from tests.measurement.bench_data import measured_data
from tests.measurement.matlab_objects import file_of

HERTZ = np.arange(1.0, 13.0)
G = (1 + np.arange(24.0).reshape(2, 12)) * np.exp(0.1j * HERTZ)
ROUND = "in which they are the round numbers"


def frd(grid=HERTZ, response=G[:, None, :], **properties):
    """Objects 1 and 2: an frd and its data."""
    data = {"Frequency": grid[:, None], "Response": response, "Ts": np.zeros((1, 1))}
    moved = {
        name: properties.pop(name)
        for name in ("Delay", "Ts", "CovarianceData")
        if name in properties
    }
    return [
        {
            "InputName_": [],
            "Data_": np.array([[0xDD000000], [2], [1], [1], [2], [2]], "u4"),
            **properties,
        },
        data | moved,
    ]


def stored(tmp_path, objects, **variables):
    path = tmp_path / "objects.mat"
    path.write_bytes(file_of(variables or {"frf": (1, 1)}, objects))
    return path


@pytest.mark.full
def test_the_real_stage_is_read_in_the_unit_that_its_numbers_show():
    path = measured_data("fditools_stage_frd.mat")
    found = read(path, response="frf.Pp[1]", quantity="position")
    assert len(found) == 423 and np.allclose(found.frequency[[0, -1]], [0.1, 1000])
    peak = found.masked(20, 60)
    assert peak.omega[np.argmax(np.abs(peak.to_quantity("velocity").G))] == pytest.approx(
        193.5, abs=0.1
    )  # pole of its model: 191
    assert any("taken as rad/s although Hz is stated" in said for said in found.suspicions)
    assert (
        read(path, response="frf.Pp[1,1]", quantity="position")
        == found
        != read(path, response="frf.Pp[2]", quantity="position")
    )
    told = read(path, response="frf.Pv[1]", frequency_unit="Hz", quantity="velocity")
    assert told.notes == () and told.frequency[0] == pytest.approx(0.2 * np.pi)
    with pytest.raises(
        InputError,
        match=r"several frequency responses; choose one by --read response=NAME: frf\.Pp, frf\.Pv",
    ):
        read(path)
    with pytest.raises(InputError, match=r"2 x 1 responses \(outputs x inputs\); choose one"):
        read(path, response="frf.Pv")
    with pytest.raises(InputError, match=r"no frequency response 'mdl\.Pv'"):
        read(path, response="mdl.Pv")


@pytest.mark.parametrize(
    ("unit", "omega"),
    [("Hz", 2 * np.pi), ("kHz", 2e3 * np.pi), ("rad/s", 1.0), ("rad/TimeUnit", 1.0)],
)
def test_units_of_the_grid_are_those_of_the_object(tmp_path, unit, omega):
    path = stored(tmp_path, frd(HERTZ / 7, FrequencyUnit_=unit))
    found = read(path, response="frf[2]", quantity="velocity")
    assert (
        np.allclose(found.omega, HERTZ / 7 * omega)
        and np.array_equal(found.G, G[1])
        and found.notes == ()
    )


def test_round_numbers_are_held_against_the_unit(tmp_path):
    circular = read(
        stored(tmp_path, frd(2 * np.pi * HERTZ, FrequencyUnit_="Hz")), response="frf[1]"
    )
    assert np.allclose(circular.frequency, HERTZ) and any(
        ROUND in said for said in circular.suspicions
    )
    doubtful = read(stored(tmp_path, frd(HERTZ)), response="frf[1]")
    assert np.array_equal(doubtful.omega, HERTZ) and any(
        "if Hz, give --unit frequency=Hz" in said for said in doubtful.suspicions
    )
    assert np.allclose(
        read(stored(tmp_path, frd(HERTZ)), response="frf[1]", frequency_unit="Hz").frequency, HERTZ
    )
    for wrong in ("furlong", "rpm with time in minutes"):
        with pytest.raises(InputError, match="is not a known unit of frequency"):
            read(stored(tmp_path, frd(FrequencyUnit_=wrong)), response="frf[1]")


def test_names_units_delays_and_covariances(tmp_path):
    covariance = np.zeros((2, 1, 12, 2, 2))
    covariance[..., 0, 0], covariance[..., 1, 1] = 9.0, 16.0
    delay = {"Input": np.array([[2.0]]), "Output": np.array([[0.0], [3.0]]), "IO": np.zeros((2, 1))}
    words = {
        "InputName_": ["torque"],
        "InputUnit_": ["Nm"],
        "OutputName_": ["a", "b"],
        "OutputUnit_": ["rad", "rad"],
    }
    objects = frd(
        FrequencyUnit_="rad/s",
        Delay=delay,
        Ts=np.array([[0.01]]),
        CovarianceData=covariance,
        **words,
    )
    found = read(stored(tmp_path, objects), response="frf[2]", quantity="position", sign=-1)
    np.testing.assert_allclose(found.G, -G[1] * np.exp(-0.05j * HERTZ), rtol=1e-14)
    assert np.array_equal(found.deviation, np.full(12, 5.0)) and found.quantity is Quantity.POSITION
    assert (found.input, found.output) == (Signal("torque", "Nm"), Signal("b", "rad"))


def test_the_only_response_needs_no_name_and_structs_have_fields(tmp_path):
    objects = frd(response=G[:1, None, :], FrequencyUnit_="rad/s")
    record = {
        "u": np.sin(np.arange(50.0))[:, None],
        "both": np.random.default_rng(0).normal(size=(50, 2)),
        "fs": np.eye(1),
    }
    path = stored(tmp_path, objects, bench={"x": {"response": (1, 1)}}, record=record)
    found = read(path)
    assert np.array_equal(found.G, G[0]) and found.origin == "objects.mat, bench.x.response"
    series = read_time_series(path, "record.u", "record.both[2]", sampling_rate="record.fs")
    assert np.array_equal(series.y, record["both"][:, 1]) and np.array_equal(
        series.u, record["u"][:, 0]
    )
    for wrong in ("record.both", "record.both[3]", "record.both[0]", "record.both[1,2]"):
        with pytest.raises(
            InputError, match=r"holds 2 signals; choose one, from 1, as record\.both\[2\]"
        ):
            read_time_series(path, "record.u", wrong, sampling_rate=10)
    with pytest.raises(InputError, match=r"record\.u\[2\] is not a single signal"):
        read_time_series(path, "record.u[2]", "record.u", sampling_rate=10)


def test_an_object_that_holds_itself_comes_to_an_end(tmp_path):
    itself = np.array([[0xDD000000], [2], [1], [1], [1], [1]], "u4")
    path = stored(tmp_path, [{"Data_": itself, "UserData": {"again": (1, 1)}}])
    with pytest.raises(InputError, match="which variable"):
        read(path)


@pytest.mark.full
@given(st.floats(0, 1), st.integers(0, 12), st.binary(max_size=8))
@settings(
    suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=150, deadline=None
)
def test_a_damaged_object_is_refused_or_still_a_response(tmp_path, share, length, filling):
    content = file_of({"frf": (1, 1)}, frd(FrequencyUnit_="Hz"))
    start = int(share * len(content))
    (tmp_path / "a.mat").write_bytes(content[:start] + filling + content[start + length :])
    with suppress(InputError):
        read(tmp_path / "a.mat", response="frf[1]")


def test_the_command_line_names_outputs_and_inputs(tmp_path, capsys):
    path = stored(tmp_path, frd(FrequencyUnit_="rad/s"))
    assert main(["fit", str(path), "--read", "response=frf[1,2]", "--masses", "1"]) == 2
    assert main(["fit", str(path), "--read", "response=frf[3,1]", "--masses", "1"]) == 2
    assert capsys.readouterr().err.count("2 x 1 responses") == 2
