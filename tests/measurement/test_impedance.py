"""An impedance is known by header, unit or format, and no machine is fitted to it."""

import shlex
from itertools import product

import numpy as np
import pytest

from disting import Chain, InputError
from disting.fit import select
from disting.fit.networks import fit_networks
from disting.measurement import FrequencyResponse, csv_text, from_frame, read
from disting.measurement.impedance import as_impedance
from disting.network import network_of
from tests.cli.process import called
from tests.measurement.bench_data import measured_data

HERTZ = np.geomspace(0.1, 1e4, 40)
Z = 10 + 100 / (1 + 2j * np.pi * HERTZ * 1e-3)
DEGREES = np.rad2deg(np.angle(Z))
PARTS, TURNED, POLAR = (HERTZ, Z.real, Z.imag), (HERTZ, Z.real, -Z.imag), (HERTZ, abs(Z), DEGREES)


def written(path, header, columns):
    rows = (",".join(f"{x:.17g}" for x in row) for row in zip(*columns, strict=True))
    path.write_text("\n".join([header, *rows]), encoding="utf-8")
    return path


@pytest.mark.thin(8)
@pytest.mark.parametrize(
    ("header", "columns", "ohms"),
    [
        ("freq/Hz,Re(Z)/Ohm,-Im(Z)/Ohm", TURNED, 1),
        ("f [Hz],Re Z [ohm],Im Z [ohm]", PARTS, 1),
        ("f [Hz],Re [ohm],Im [ohm]", PARTS, 1),
        ("Frequency (Hz),Z' (k\u2126),-Z'' (k\u2126)", TURNED, 1e3),
        ("f [Hz],|Z| [MOhm],phase [deg]", POLAR, 1e6),
        ("f [Hz],Z [mohm],phase [deg]", POLAR, 1e-3),
        ("f [Hz],|Z|,phase [deg]", POLAR, 1),
        ("f [Hz],Impedance,phase [deg]", POLAR, 1),
        ("f [Hz],Zreal,Zimag", PARTS, 1),
        ("f [Hz],Re Z,Im Z", PARTS, 1),
        ("f [Hz],Mag_Z,Phase Z [deg]", POLAR, 1),
        ("f [Hz],Z_Re,Z_Im", PARTS, 1),
        ("f [Hz],IMPEDANCE,phase [deg]", POLAR, 1),
        ("f [Hz],Zreal_kOhm,Zimag_kOhm", PARTS, 1e3),
        ("f [Hz],Re [mV/A],Im [mV/A]", PARTS, 1e-3),
        ("f,Re,Im\nHz,kOhm,kOhm", PARTS, 1e3),
        ("# freq(Hz) Zre(Ohm) Zim(Ohm)", PARTS, 1),
        ("Freq/Hz,Z'/ohm,Z\"/ohm,Z/ohm,Phase/deg", (*PARTS, abs(Z), DEGREES), 1),
    ],
)
def test_headers_and_units_of_impedances(tmp_path, header, columns, ohms):
    found = read(written(tmp_path / "a.csv", header, columns))
    assert found.is_impedance and "impedance" in repr(found)
    assert (found.output.unit, found.input.unit) == ("V", "A")
    assert not any("quantity taken" in note for note in found.notes)
    np.testing.assert_allclose(found.G, ohms * Z, rtol=1e-12)


@pytest.mark.parametrize(
    "header",
    [
        "f [Hz],Re G_z [m/s^2/N],Im G_z [m/s^2/N]",
        "f [Hz],Z_re [rad/s^2/Nm],Z_im [rad/s^2/Nm]",
        "f [Hz],Re Z speed,Im Z speed",
        "f [Hz],Re z,Im z",
        "f [Hz],Re,Im",
    ],
)
def test_machines_with_an_axis_z_are_none(tmp_path, header):
    assert not read(written(tmp_path / "a.csv", header, PARTS)).is_impedance


UNKNOWN = ("Furlong", "Volt")
FORMS = ("f,Re(Z)/{0},Im(Z)/{0}", "f,Re/{0},Im/{0}")  # a unit behind a stroke has no blank
ANY_FORMS = ("f,Re Z [{0}],Im Z [{0}]", "f,Re,Im\nHz,{0},{0}")


@pytest.mark.parametrize(
    ("header", "unit"),
    [*product((*FORMS, *ANY_FORMS), UNKNOWN), *product(ANY_FORMS, ["Ohm cm2"])],
)
def test_a_stated_unit_that_is_not_known_is_refused(tmp_path, header, unit):
    path = written(tmp_path / "a.csv", header.format(unit), PARTS)
    with pytest.raises(InputError, match=f"unit '{unit}' is not known"):
        read(path)
    assert len(read(path, magnitude_unit="1")) == len(HERTZ)


def test_a_quantity_that_the_user_names_makes_a_tachometer_of_volts_per_ampere(tmp_path):
    path = written(tmp_path / "a.csv", "f [Hz],Re [V/A],Im [V/A]", PARTS)
    assert read(path).is_impedance and not read(path, quantity="velocity").is_impedance
    ohm = written(tmp_path / "b.csv", "f [Hz],Re [ohm],Im [ohm]", PARTS)
    assert read(ohm, quantity="velocity").is_impedance


def test_ohm_may_be_said_by_the_user(tmp_path):
    path = written(tmp_path / "a.csv", "f [Hz],abs,phase [deg]", POLAR)
    found = read(path, magnitude_unit="kohm")
    assert found.is_impedance
    np.testing.assert_allclose(found.G, 1e3 * Z, rtol=1e-12)


def test_a_written_impedance_is_one_when_it_is_read_back(tmp_path):
    found = read(written(tmp_path / "a.csv", "f [Hz],Zreal,Zimag", PARTS))
    copy = tmp_path / "copy.csv"
    copy.write_text(csv_text(found), encoding="utf-8")
    assert read(copy) == found and read(copy).is_impedance


@pytest.mark.full
def test_data_frames(tmp_path):
    pd = pytest.importorskip("pandas")
    frame = pd.DataFrame({"f [Hz]": HERTZ, "Re(Z)/Ohm": Z.real, "Im(Z)/Ohm": Z.imag})
    assert from_frame(frame).is_impedance


def test_no_chain_is_fitted_in_python():
    impedance = FrequencyResponse(2 * np.pi * HERTZ, Z, is_impedance=True)
    motion = FrequencyResponse(2 * np.pi * HERTZ, Z)
    with pytest.raises(InputError, match="impedance, a voltage per current, not the motion"):
        select(impedance, [Chain(1)])
    with pytest.raises(InputError, match="not the motion"):
        select(motion, [Chain(1)], test=impedance)
    with pytest.raises(InputError, match="not the motion"):
        impedance.to_quantity("position")
    with pytest.raises(InputError, match="not the motion"):
        fit_networks(impedance, [network_of("1=2; F1; S1")])
    assert as_impedance(motion).is_impedance


@pytest.mark.full
@pytest.mark.parametrize("header", ["freq/Hz,Re(Z)/Ohm,-Im(Z)/Ohm", "f [Hz],Zreal,Zimag"])
def test_the_command_shows_what_was_read_and_how_to_fit_it(tmp_path, header):
    rng = np.random.default_rng(1)
    noisy = Z * (1 + 1e-3 * rng.normal(size=(len(Z), 2)) @ [1, 1j])
    sign = -1 if "-Im" in header else 1
    path = written(tmp_path / "eis.csv", header, (HERTZ, noisy.real, sign * noisy.imag))
    page = tmp_path / "out"
    done = called("fit", path, "--out", page)
    assert done.returncode == 1 and "Traceback" not in done.stderr and not page.exists()
    assert "40 lines, 0.1 to 1e+04 Hz" in done.stdout and "column 2" in done.stdout
    assert "explains" not in done.stdout
    command = done.stdout.splitlines()[-1].split("disting ")[1]
    fitted = called(*shlex.split(command))
    assert fitted.returncode == 0 and "R0-p(R1,C1) is the simplest" in fitted.stdout


@pytest.mark.parametrize(
    "file", ["exampleDataGamry.DTA", "exampleDataBioLogic.mpt", "exampleDataZPlot.z"]
)
def test_files_of_instruments_are_no_drives(file):
    path = measured_data(f"eis/{file}")
    assert read(path).is_impedance
    done = called("fit", path)
    assert done.returncode == 1 and "--models 'R0-p(R1,C1)'" in done.stdout


@pytest.mark.full
def test_a_simulated_circuit_is_no_drive(tmp_path):
    path = tmp_path / "cell.csv"
    called("simulate", "R0-p(R1,C1)", "--set", "R0=1,R1=2,C1=0.01", "--csv", path)
    assert called("fit", path).returncode == 1
