"""Files and objects of other programs, written by their own libraries; and damaged ones."""

from contextlib import suppress

import numpy as np
import pytest
import scipy.io
from hypothesis import HealthCheck, given, settings, strategies as st

from disting.errors import InputError
from disting.measurement import Signal, from_arrays, from_control, read, read_time_series
from disting.measurement.matlab import variables
from disting.measurement.source import source
from disting.model.chain import Quantity

FREQUENCY = np.arange(2.0, 14.0)
G = np.exp(0.1j * FREQUENCY) * FREQUENCY
COHERENCE = 1 / FREQUENCY
TIME = np.arange(100) * 0.01


def universal(pyuff, kind, data, node, quantity):
    """A data set 58: function type, values, node and data type of the output."""
    return pyuff.prepare_58(
        func_type=kind, rsp_node=node, rsp_dir=3, ref_node=1, ref_dir=-3, data=data, x=FREQUENCY, binary=0,
        id1="a", id2="b", id3="c", id4="d", id5="e", ver_num=1, load_case_id=0, rsp_ent_name="r", ref_ent_name="f",
        abscissa_spacing=1, abscissa_spec_data_type=18, ordinate_spec_data_type=quantity, orddenom_spec_data_type=13,
        ordinate_axis_units_lab="m/s", orddenom_axis_units_lab="N", z_axis_axis_units_lab="NONE",
        abscissa_len_unit_exp=0, abscissa_force_unit_exp=0, abscissa_temp_unit_exp=0, abscissa_axis_units_lab="Hz",
        ordinate_len_unit_exp=0, ordinate_force_unit_exp=0, ordinate_temp_unit_exp=0,
        orddenom_len_unit_exp=0, orddenom_force_unit_exp=0, orddenom_temp_unit_exp=0,
        z_axis_spec_data_type=0, z_axis_len_unit_exp=0, z_axis_force_unit_exp=0, z_axis_temp_unit_exp=0,
    )  # fmt: skip


def test_arrays():
    found = from_arrays(FREQUENCY, G, deviation=COHERENCE, quantity="velocity", sign=-1)
    assert (
        np.array_equal(found.G, -G)
        and np.array_equal(found.deviation, COHERENCE)
        and found.quantity is Quantity.VELOCITY
    )
    assert np.array_equal(from_arrays(FREQUENCY, G, frequency_unit="rad/s").omega, FREQUENCY)
    for wrong in ({"frequency_unit": "furlong"}, {"sign": 2}, {"coherence": "a"}):
        with pytest.raises(InputError):
            from_arrays(FREQUENCY, G, **wrong)
    with pytest.raises(InputError, match="array of numbers"):
        from_arrays(list("abcdefghijkl"), G)


@pytest.mark.parametrize("format", ["4", "5"])
@pytest.mark.parametrize("compressed", [False, True])
def test_matlab_files_of_scipy(tmp_path, format, compressed):
    path = tmp_path / "a.mat"
    scipy.io.savemat(
        path,
        {"f": FREQUENCY, "G": G, "coh": COHERENCE, "C": 1.0},
        format=format,
        do_compression=compressed,
    )
    found = read(path)
    assert (
        np.array_equal(found.G, G)
        and np.array_equal(found.coherence, COHERENCE)
        and found.deviation is None
    )
    assert np.allclose(found.frequency, FREQUENCY, rtol=1e-15) and found.output.label == "G"
    assert found.notes == (
        "sensor quantity taken as acceleration; if not, give --quantity position or --quantity velocity",
        "frequencies of 'f' taken as Hz",
    )
    assert read(path, quantity="position", frequency_unit="Hz").notes == ()
    assert np.array_equal(read(path, frequency_unit="rad/s").omega, FREQUENCY)
    with pytest.raises(InputError, match="no variable 'H'; variables: C, G, coh, f"):
        read(path, response="H")


def test_several_responses_in_one_matlab_array(tmp_path):
    path = tmp_path / "a.mat"
    several = np.stack([[G, 2 * G, 3 * G], [4 * G, 5 * G, 6 * G]])
    scipy.io.savemat(
        path,
        {
            "w": FREQUENCY,
            "several": several,
            "sd": np.abs(several),
            "name": "bench",
            "parts": {"x": 1},
        },
    )
    found = read(path, response="several", deviation="sd", index=(1, 2))
    assert np.array_equal(found.G, 6 * G) and np.array_equal(found.omega, FREQUENCY)
    assert np.array_equal(found.deviation, np.abs(6 * G))
    for index in (None, 1, (2, 0), (0, 0, 0)):
        with pytest.raises(
            InputError, match=r"2 x 3 responses; choose one, .* --read response=several\[1,1\]"
        ):
            read(path, response="several", index=index)
    for name in ("name", "parts"):
        with pytest.raises(InputError, match=f"{name} .*no array of numbers"):
            read(path, response=name)
    with pytest.raises(
        InputError,
        match=r"which variable is the response.*variables: name, parts, parts.x, sd, several, w",
    ):
        read(path)


def test_a_variable_of_another_length_is_no_coherence_and_no_response(tmp_path):
    """One that nobody named is left out, one that is named is refused."""
    path = tmp_path / "a.mat"
    scipy.io.savemat(path, {"f": FREQUENCY, "G": G, "coh": np.ones((7, 2))})
    assert read(path).coherence is None
    with pytest.raises(InputError, match=r"coh of shape \(7, 2\) has no axis of \d+ values"):
        read(path, coherence="coh")


def test_time_series_of_a_matlab_file(tmp_path):
    path = tmp_path / "a.mat"
    signals = {"u": np.sin(TIME)[:, None], "y": np.cos(TIME)[None, :], "two": np.ones((100, 2))}
    for rate in ({"fs": 100}, {"Ts": 0.01}, {"t": TIME}):
        scipy.io.savemat(path, signals | rate)
        found = read_time_series(path, "u", "y", quantity="velocity")
        assert found.sampling_rate == pytest.approx(100) and np.array_equal(found.y, np.cos(TIME))
        assert (found.input, found.output, found.quantity) == (
            Signal("u"),
            Signal("y"),
            Quantity.VELOCITY,
        )
    assert (
        found.notes == ()
        and "output taken as a position" in read_time_series(path, "u", "y").notes[0]
    )
    assert read_time_series(path, "u", "y", sampling_rate=7).sampling_rate == 7
    with pytest.raises(InputError, match=r"two holds 2 signals; choose one, from 1, as two\[2\]"):
        read_time_series(path, "u", "two")
    with pytest.raises(InputError, match="not a positive number"):
        read_time_series(path, "u", "y", sampling_rate="u")
    scipy.io.savemat(path, signals)
    with pytest.raises(InputError, match="give --read sampling_rate="):
        read_time_series(path, "u", "y")


@pytest.mark.full
def test_matlab_7_3_files_of_h5py(tmp_path):
    h5py = pytest.importorskip("h5py")
    path = tmp_path / "a.mat"
    # MATLAB's 2 x 12, axes reversed
    pairs = np.zeros((12, 2), dtype=[("real", "f8"), ("imag", "f8")])
    pairs["real"], pairs["imag"] = (
        np.stack([G.real, 2 * G.real], axis=1),
        np.stack([G.imag, 2 * G.imag], axis=1),
    )
    with h5py.File(path, "w", userblock_size=512) as file:
        file["f"], file["G"], file["u"], file["y"], file["fs"] = (
            FREQUENCY[:, None],
            pairs,
            np.sin(TIME),
            np.cos(TIME),
            100.0,
        )
        file.create_group("settings")["x"] = 1.0
        file.create_group("#refs#")
    with path.open("r+b") as stream:
        stream.write(b"MATLAB 7.3 MAT-file, Platform: GLNXA64")
    assert np.array_equal(read(path, index=1, quantity="position").G, 2 * G)
    assert read_time_series(path, "u", "y").sampling_rate == 100.0
    with pytest.raises(InputError, match="variables: G, f, fs, u, y"):
        read(path, response="settings")


def test_matlab_7_3_files_that_lead_out_of_themselves_are_not_followed(tmp_path):
    """A stranger's file could have had any file of the machine read as its numbers."""
    h5py = pytest.importorskip("h5py")
    path, secret = tmp_path / "a.mat", tmp_path / "secret"
    secret.write_bytes(np.arange(12.0).tobytes())
    with h5py.File(tmp_path / "other.h5", "w") as file:
        file["G"] = np.arange(12.0)
    with h5py.File(path, "w", userblock_size=512) as file:
        file["f"] = FREQUENCY
        file.create_dataset("G", (12,), "f8", external=[(str(secret), 0, 96)])
        file["H"] = h5py.ExternalLink(str(tmp_path / "other.h5"), "G")
        layout = h5py.VirtualLayout((12,), "f8")
        layout[:] = h5py.VirtualSource(str(tmp_path / "other.h5"), "G", (12,))
        file.create_virtual_dataset("FRF", layout)
    with path.open("r+b") as stream:
        stream.write(b"MATLAB 7.3 MAT-file, Platform: GLNXA64")
    with pytest.raises(InputError, match="values of G are kept in another file"):
        read(path, response="G")
    with pytest.raises(InputError, match="values of FRF are kept in another file"):
        read(path, response="FRF")
    with pytest.raises(InputError, match="has no variable 'H'; variables: FRF, G, f"):
        read(path, response="H")


def test_universal_files_of_pyuff(tmp_path):
    pyuff = pytest.importorskip("pyuff")
    path = tmp_path / "a.uff"
    file = pyuff.UFF(str(path))
    for kind, data, node, quantity in ((4, G, 3, 11), (6, COHERENCE + 0j, 3, 0), (4, -G, 5, 0)):
        file.write_sets(universal(pyuff, kind, data, node, quantity), "add")
    first, second = read(path), read(path, record=2)
    np.testing.assert_allclose(first.G, G, rtol=1e-6)  # the format keeps single precision
    np.testing.assert_allclose(first.coherence, COHERENCE, rtol=1e-6)
    np.testing.assert_allclose(first.frequency, FREQUENCY, rtol=1e-6)
    assert (first.quantity, first.notes) == (Quantity.VELOCITY, ())
    assert (first.output, first.input) == (Signal("node 3 +z", "m/s"), Signal("node 1 -z", "N"))
    assert second.coherence is None and "taken as acceleration" in second.notes[0]
    with pytest.raises(
        InputError, match=r"number 3; its responses are: 1: node 3 .z per node 1 -z; 2: node 5"
    ):
        read(path, record=3)


@pytest.mark.parametrize(
    ("good", "bad", "words"),
    [
        ("      12", "      13", "12 values, but the header states 13"),
        ("\n  ", "\n   ", "line 1 of the numbers is not of whole columns"),
        ("e+00\n", "e+00", "of the numbers is not of whole columns"),
    ],
)
def test_universal_files_whose_columns_are_shifted_or_missing(tmp_path, good, bad, words):
    """One blank more at the beginning of a line moved the exponents out of their columns: 1e+01
    was read as 1e+0.
    """
    pyuff = pytest.importorskip("pyuff")
    path = tmp_path / "a.uff"
    pyuff.UFF(str(path)).write_sets(universal(pyuff, 4, G, 3, 11), "add")
    text = path.read_text()
    at = text.index(good, 0 if "12" in good else text.index("NONE                 NONE"))
    path.write_text(text[:at] + bad + text[at + len(good) :])
    with pytest.raises(InputError, match=words):
        read(path)


@pytest.mark.full
def test_frequency_response_data_of_python_control():
    control = pytest.importorskip("control")
    data = np.stack([[G, 2 * G]])
    system = control.frd(data, FREQUENCY, inputs=["torque", "force"], outputs=["angle"])
    found = from_control(system, input=1, quantity="position")
    assert np.array_equal(found.G, 2 * G) and np.array_equal(found.omega, FREQUENCY)
    assert (found.input.label, found.output.label) == ("force", "angle")
    assert np.array_equal(from_control(control.frd(G, FREQUENCY)).G, G)
    for wrong in (
        lambda: from_control(system, output=1),
        lambda: from_control(G),
        lambda: from_control(control.tf([1], [1, 1])),
    ):
        with pytest.raises(InputError):
            wrong()


@pytest.mark.parametrize(
    ("module", "name", "extra"), [("h5py", "a.mat", "hdf5"), ("pyuff", "a.uff", "uff")]
)
def test_a_missing_library_is_named_with_its_extra(tmp_path, monkeypatch, module, name, extra):
    monkeypatch.setitem(__import__("sys").modules, module, None)
    path = tmp_path / name
    path.write_bytes({"a.mat": b"\x89HDF\r\n\x1a\n", "a.uff": b"    -1\n"}[name] + bytes(600))
    with pytest.raises(InputError, match=rf'pip install "disting\[{extra}\]"'):
        read(path)


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    folder = tmp_path_factory.mktemp("whole")
    scipy.io.savemat(folder / "a.mat", {"f": FREQUENCY, "G": G, "text": "abc", "parts": {"x": 1.0}})
    scipy.io.savemat(folder / "b.mat", {"f": FREQUENCY, "G": G}, do_compression=True)
    h5py, pyuff = pytest.importorskip("h5py"), pytest.importorskip("pyuff")
    with h5py.File(folder / "c.mat", "w") as file:
        file["f"], file["G"] = FREQUENCY, G.real
    pyuff.UFF(str(folder / "d.uff")).write_sets(universal(pyuff, 4, G, 3, 12), "add")
    return [(path.name, path.read_bytes()) for path in sorted(folder.iterdir())]


@pytest.mark.full
@given(st.integers(0, 3), st.floats(0, 1), st.integers(0, 40), st.binary(max_size=8))
@settings(
    suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=150, deadline=None
)
def test_a_damaged_file_is_refused_or_still_a_response(
    tmp_path, whole, which, share, length, filling
):
    name, content = whole[which]
    start = int(share * len(content))
    refused(tmp_path / name, content[:start] + filling + content[start + length :])


@given(st.integers(0, 3), st.floats(0, 1))
@settings(
    suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=50, deadline=None
)
def test_a_cut_file_is_refused_or_still_a_response(tmp_path, whole, which, share):
    name, content = whole[which]
    refused(tmp_path / name, content[: int(share * len(content))])


@pytest.mark.full
@given(
    st.sampled_from(["a.mat", "a.uff", "a.unv"]),
    st.sampled_from([b"", b"\x89HDF\r\n\x1a\n", b"    -1\n    58\n"]),
    st.binary(max_size=200),
)
@settings(
    suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=150, deadline=None
)
def test_random_bytes_are_refused(tmp_path, name, head, content):
    refused(tmp_path / name, head + content)


def refused(path, content):
    """Any other error than InputError fails the test."""
    path.write_bytes(content)
    with suppress(InputError):
        read(path)


NUMERIC = ["f8", "f4", "i1", "u1", "i2", "u2", "i4", "u4", "i8", "u8", "c16", "c8"]


@pytest.mark.full
@given(
    st.sampled_from(NUMERIC),
    st.lists(st.integers(1, 5), min_size=2, max_size=4),
    st.booleans(),
    st.integers(0, 2**32),
    st.data(),
)
@settings(
    suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=100, deadline=None
)
def test_version_5_arrays_are_those_that_scipy_wrote(tmp_path, kind, shape, compressed, seed, data):
    random = np.random.default_rng(seed)
    values = (
        random.normal(size=shape) * 100 + 1j * random.normal(size=shape)
        if kind[0] == "c"
        else random.normal(size=shape) * 100
    )
    values = np.abs(values).astype(kind) if kind[0] == "u" else values.astype(kind)
    name = data.draw(st.from_regex(r"[a-zA-Z][a-zA-Z0-9_]{0,30}", fullmatch=True))
    others = {
        "text": "abc",
        "cells": np.array([1, "a"], dtype=object),
        "parts": {"x": 1.0},
        "none": np.zeros((0, 0)),
    }
    scipy.io.savemat(tmp_path / "a.mat", others | {name: values}, do_compression=compressed)
    arrays = variables(source(tmp_path / "a.mat"))
    assert set(arrays) == {*others, name, "parts.x"}
    found = arrays[name]()
    assert np.array_equal(found, values) and found.shape == values.shape
    with pytest.raises(InputError, match="no array of numbers"):
        arrays["cells"]() if name != "cells" else arrays["text"]()
