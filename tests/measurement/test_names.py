"""Columns and signals are named with or without their unit; power spectra are no responses."""

import numpy as np
import pytest
from scipy.io import savemat

from disting import InputError
from disting.measurement import read, read_time_series
from tests.cli.process import called

F = np.geomspace(5, 200, 20)


def table(path, header, *columns):
    rows = (",".join(f"{x:.12g}" for x in row) for row in zip(*columns, strict=True))
    path.write_text("\n".join([header, *rows]), encoding="utf-8")
    return path


@pytest.fixture
def record(tmp_path):
    source = np.random.default_rng(0)
    t, r = np.arange(4000) / 1000, source.normal(size=4000)
    u = r + 0.01 * source.normal(size=4000)
    header = "t [s],torque [Nm],Speed [rad/s],excitation [Nm],speed (raw)"
    return table(tmp_path / "a.csv", header, t, u, np.cumsum(u), r, np.cumsum(r))


@pytest.mark.full
@pytest.mark.parametrize(
    "reference", ["excitation [Nm]", "excitation", "Excitation", " EXCITATION "]
)
@pytest.mark.parametrize("input", ["torque", "Torque [Nm]", 2])
def test_signals_are_named_with_or_without_their_unit(record, reference, input):
    found = read_time_series(record, input, "Speed", reference=reference, time="t")
    assert found.input == ("torque", "Nm") and found.output == ("Speed", "rad/s")
    assert found.reference is not None and len(found.reference) == 4000


@pytest.mark.full
@pytest.mark.parametrize("wrong", ["SPEED", "torque [A]", "reference"])
def test_what_is_ambiguous_or_of_another_unit_is_refused(record, wrong):
    with pytest.raises(InputError, match="columns are called"):
        read_time_series(record, "torque", wrong)


@pytest.mark.full
def test_the_command_takes_them_too(record):
    words = ("input=torque", "output=speed [rad/s]", "reference=excitation", "segment=512")
    reads = [word for each in words for word in ("--read", each)]
    done = called("fit", record, *reads, "--masses", "1")
    assert "input torque [Nm], output Speed [rad/s], with a reference" in done.stdout


@pytest.mark.parametrize("column", ["Re", "re [rad/s^2/A]", "RE"])
def test_columns_of_a_response(tmp_path, column):
    path = table(tmp_path / "a.csv", "f [Hz],Re [rad/s^2/A],Im [rad/s^2/A]", F, F, F)
    assert read(path, column=column).output.unit == "rad/s^2"


def test_variables_of_matlab_files(tmp_path):
    savemat(tmp_path / "a.mat", {"Hertz": F, "Plant": F + 1j})
    assert len(read(tmp_path / "a.mat", frequency="hertz", response="plant")) == 20


SPECTRA = [
    "freq,psd_x,psd_y,psd_z,psd_xyz",  # as Klipper writes it
    "f [Hz],Sxx [V^2/Hz]",
    "f [Hz],acc [(m/s^2)^2/Hz]",
    "f [Hz],noise [V/sqrt(Hz)]",
    "Frequency (Hz),Power Spectral Density",
]


@pytest.mark.parametrize("header", SPECTRA)
def test_a_power_spectrum_is_no_response(tmp_path, header):
    path = table(tmp_path / "a.csv", header, F, *[F] * header.count(","))
    with pytest.raises(InputError, match="is not a frequency response, it has neither phase"):
        read(path)
    done = called("fit", path)
    assert done.returncode == 2 and "neither phase nor input" in done.stderr


def test_a_response_beside_spectra_is_read(tmp_path):
    path = table(tmp_path / "a.csv", "f [Hz],PSD in [V^2/Hz],Re H,Im H,PSD out", F, F, F, -F, F)
    np.testing.assert_allclose(read(path).G, F * (1 - 1j), rtol=1e-10)
    with pytest.raises(InputError, match="power spectrum"):
        read(path, column="PSD out")
