"""What a stated unit is taken for, which columns make up the response of a file as instruments
write it, and what is said where one cannot tell.
"""

import numpy as np
import pytest

from disting import InputError
from disting.measurement import in_si, read, read_time_series
from disting.measurement.column_words import Role, meaning
from disting.measurement.units import FREQUENCIES, PHASES

F = np.arange(3.0, 23.0)
G = 5.0 / (1 - (F / 11.3) ** 2 + 0.1j)
DB, DEGREES = 20 * np.log10(np.abs(G)), np.degrees(np.angle(G))


def written(path, header, *columns, delimiter=",", encoding="utf-8"):
    rows = [
        delimiter.join(str(float(value)) for value in row) for row in zip(*columns, strict=True)
    ]
    path.write_text("\n".join([*([header] if header else []), *rows, ""]), encoding=encoding)
    return path


def refused(path, **options):
    with pytest.raises(InputError) as found:
        read(path, **options)
    return str(found.value), found.value.detail


@pytest.mark.thin(1)
@pytest.mark.parametrize("unit", FREQUENCIES)
@pytest.mark.parametrize(
    "form", ["f [{}]", "Frequency ({})", "f/{}", "Frequency in {}", "freq, {}"]
)
def test_every_unit_of_frequency_is_known_however_it_is_stated(tmp_path, unit, form):
    path = written(
        tmp_path / "a.csv", f"{form.format(unit)};Re;Im", F, G.real, G.imag, delimiter=";"
    )
    found = read(path, frequency_unit=unit)
    np.testing.assert_allclose(found.omega, F * FREQUENCIES[unit], rtol=1e-14)
    stated = read(path)
    assert np.array_equal(stated.omega, F) if unit == "rad/s" else stated == found
    assert f"frequency in {unit} (column 1)" in stated.reading


@pytest.mark.parametrize(
    ("unit", "known"),
    [("HZ", "Hz"), ("KHz", "kHz"), ("rad/sec", "rad/s"), ("10^3 Hz", "kHz"), ("1e-3 Hz", "mHz")],
)
def test_spellings_of_units_of_frequency(tmp_path, unit, known):
    path = written(tmp_path / "a.csv", f"f [{unit}],Re,Im", F, G.real, G.imag)
    np.testing.assert_allclose(read(path).omega, F * FREQUENCIES[known], rtol=1e-14)


@pytest.mark.parametrize(
    "header",
    ["f [ms]", "f [furlong]", "f (swept)", "log10(f)", "Frequency Log(Hz)", "f_mhz", "FREQ [MHZ]"],
)
def test_a_unit_of_frequency_that_is_not_known_is_refused_with_those_that_are(tmp_path, header):
    path = written(tmp_path / "a.csv", f"{header},Re,Im", F, G.real, G.imag)
    said, _ = refused(path)
    assert "is not a known unit of frequency; known units: mHz, Hz, kHz, MHz" in said
    assert said.endswith("give --unit frequency=Hz")
    assert np.array_equal(read(path, frequency_unit="Hz").frequency, F * 2 * np.pi / (2 * np.pi))


@pytest.mark.parametrize("unit", [*PHASES, "°", "Deg", "degrees", "rev"])
def test_every_unit_of_phase_is_known(tmp_path, unit):
    size = PHASES.get(unit, 2 * np.pi if unit == "rev" else np.pi / 180)
    path = written(
        tmp_path / "a.csv", f"f [Hz],abs,phase [{unit}]", F, np.abs(G), np.angle(G) / size
    )
    np.testing.assert_allclose(read(path).G, G, rtol=1e-12)
    assert not any("phases taken as" in note for note in read(path).notes)


@pytest.mark.parametrize(
    ("unit", "numbers", "output"),
    [
        ("dB", DB, ""),
        ("dB re 1 rad/s^2/A", DB, "rad/s^2"),
        ("Np", np.log(np.abs(G)), ""),
        ("%", 100 * np.abs(G), ""),
        ("V/V", np.abs(G), ""),
        ("deg/s^2/A", np.abs(G), "deg/s^2"),
        ("mm/s per N", np.abs(G), "mm/s"),
        ("rad s⁻² A⁻¹", np.abs(G), "rad/s^2"),
        ("krad/s^2/(N m)", np.abs(G), "krad/s^2"),
    ],
)
def test_units_of_a_gain(tmp_path, unit, numbers, output):
    path = written(
        tmp_path / "a.csv", f"f [Hz];gain [{unit}];phase [deg]", F, numbers, DEGREES, delimiter=";"
    )
    found = read(path)
    np.testing.assert_allclose(found.G, G, rtol=1e-12)
    assert found.output.unit == output


def test_parts_in_degrees_are_parts_and_no_phases(tmp_path):
    path = written(tmp_path / "a.csv", "f [Hz],Re [deg/s^2/A],Im [deg/s^2/A]", F, G.real, G.imag)
    found = in_si(read(path))
    np.testing.assert_allclose(found.G, G * np.pi / 180, rtol=1e-12)
    assert (found.output.unit, found.input.unit) == ("rad/s^2", "A")


@pytest.mark.parametrize("header", ["re [k],im [k]", "Re(Z)/dBm,-Im(Z)/dBm", "Re [dBm],Im [dBm]"])
def test_a_unit_of_parts_that_is_not_known_is_refused(tmp_path, header):
    path = written(tmp_path / "a.csv", f"f [Hz],{header}", F, G.real, G.imag)
    said, _ = refused(path)
    assert "is not known; known units: 1, %, dB, Np, rad/s^2/A" in said
    assert "give --unit magnitude=1, which takes the numbers as they are" in said
    found = read(path, magnitude_unit="1").G
    np.testing.assert_allclose(found.conj() if "-Im" in header else found, G, rtol=1e-14)


@pytest.mark.parametrize(
    "header", ["f [Hz],Re,-Im", "f/Hz,Re(Z)/-,−Im(Z)/-", "f [Hz],abs,-phase [rad]"]
)
def test_a_minus_before_a_name_turns_its_numbers_and_is_said(tmp_path, header):
    columns = (np.abs(G), np.angle(G)) if "abs" in header else (G.real, G.imag)
    found = read(written(tmp_path / "a.csv", header, F, *columns))
    np.testing.assert_allclose(found.G, G.conj(), rtol=1e-12)
    assert any("read with the sign reversed" in note for note in found.notes)


def test_a_unit_of_phase_that_is_not_known_is_refused(tmp_path):
    path = written(tmp_path / "a.csv", "f [Hz],gain [dB],phase [grad]", F, DB, DEGREES)
    assert "the unit 'grad' is not known; known units: rad, mrad, deg" in refused(path)[0]
    np.testing.assert_allclose(read(path, phase_unit="deg").G, G, rtol=1e-12)


def test_names_in_round_brackets_are_said_to_be_names(tmp_path):
    path = written(tmp_path / "a.csv", "f [Hz],abs(G) ,arg(G) ", F, np.abs(G), np.angle(G))
    found = read(path)
    np.testing.assert_allclose(found.G, G, rtol=1e-12)
    assert "column 3 (arg(G)): (G) is taken as part of its name" in found.notes


KEYSIGHT = "#, Frequency (Hz), Amplitude (Vpp), Gain (dB), Phase (°)"
LEVEL = np.full(len(F), 0.2)
INSTRUMENTS = {
    KEYSIGHT: (np.arange(1, 21), F, LEVEL, DB, DEGREES),
    "Frequency (Hz),Channel 1 Magnitude (dB),Channel 2 Magnitude (dB),Channel 2 Phase (*)": (
        F, 0 * F, DB, DEGREES,
    ),
    "Frequency(Hz),CH1 Amplitude(dB),CH1 Phase(Deg)": (F, DB, DEGREES),
    "Frequency (Hz),Trace 1: Gain: Magnitude (dB),Trace 2: Gain: Phase (°)": (F, DB, DEGREES),
    "Frequency in Hz,Gain in dB,Phase in °,Amplitude in Vpp": (F, DB, DEGREES, LEVEL),
    "w,magdb,phase": (2 * np.pi * F, DB, DEGREES),
    "f,|G|,arg": (F, np.abs(G), np.angle(G)),
    "f/Hz,A/dB,phi/°": (F, DB, DEGREES),
    "f,mag,magdb,phase": (F, np.abs(G), DB, DEGREES),
    "Frequency (Hz),Input (V),Gain (dB),Phase (deg),Coherence": (F, LEVEL, DB, DEGREES, 0.9 + 0 * F),
}  # fmt: skip


@pytest.mark.parametrize("header", INSTRUMENTS)
def test_headers_of_instruments(tmp_path, header):
    found = read(written(tmp_path / "a.csv", header, *INSTRUMENTS[header], encoding="latin-1"))
    np.testing.assert_allclose(found.G, G, rtol=1e-12)
    np.testing.assert_allclose(found.frequency, F, rtol=1e-12)
    assert (found.coherence is not None) == ("Coherence" in header)


def test_it_is_said_how_a_file_was_read(tmp_path):
    found = read(written(tmp_path / "a.csv", KEYSIGHT, *INSTRUMENTS[KEYSIGHT]))
    assert (
        found.reading
        == "frequency in Hz (column 2), gain in dB (column 4), phase in degrees (column 5)"
    )


@pytest.mark.parametrize("column", ["Gain (dB)", "4", 4, "Phase (°)"])
def test_any_column_of_the_response_names_it(tmp_path, column):
    path = written(tmp_path / "a.csv", KEYSIGHT, *INSTRUMENTS[KEYSIGHT])
    assert read(path, column=column) == read(path)


def test_a_column_of_no_response_is_taken_as_gain(tmp_path):
    path = written(
        tmp_path / "a.csv", "f [Hz],gain,X2,phase [deg]", F, 0 * F + 1, np.abs(G), DEGREES
    )
    assert np.allclose(np.abs(read(path).G), 1)
    np.testing.assert_allclose(read(path, column="X2").G, G, rtol=1e-12)


@pytest.mark.parametrize(
    ("header", "role", "unit"),
    [
        ("20 log10 |G|", Role.GAIN, "dB"),
        ("20*lg|H|", Role.GAIN, "dB"),
        ("freq [rad_per_s]", Role.FREQUENCY, "rad/s"),
        ("f [N]", Role.OTHER, ""),  # a force, no frequency
        ("w [m]", Role.OTHER, ""),
        ("Re Y)", Role.REAL, ""),  # a bracket that nothing opens
    ],
)
def test_what_a_header_means(header, role, unit):
    column = meaning(header)
    assert (column.role, column.unit) == (role, unit)


def test_columns_of_other_kinds_are_refused(tmp_path):
    path = written(tmp_path / "a.csv", "f [Hz],gain [dB],phase [deg]", F, DB, DEGREES)
    assert "not by 3" in refused(path, columns=["Hz", 3, "deg"])[0]
    said, _ = refused(path, column="f [Hz]")
    assert "is not the first column of a response; responses begin at column 2 (gain [dB])" in said
    assert (
        "the unit of a magnitude is 1, %, dB, Np or ohm, not 'bel'"
        in refused(path, magnitude_unit="bel")[0]
    )
    parts = written(tmp_path / "b.csv", "f [Hz],Re [dB],Im [dB]", F, G.real, G.imag)
    assert "a real or imaginary part is not in dB" in refused(parts)[0]


def test_a_deviation_in_decibels_is_not_used_and_said(tmp_path):
    header = "f [Hz],gain [dB],phase [deg],std [dB]"
    found = read(written(tmp_path / "a.csv", header, F, DB, DEGREES, 0.1 + 0 * F))
    assert found.deviation is None
    assert any("column 4 (std [dB]) is in dB or Np and is not used" in x for x in found.suspicions)


def test_what_is_not_understood_shows_the_table_and_the_command_that_reads_it(tmp_path):
    path = written(tmp_path / "a.csv", "Punkt,Wert 1,Wert 2", F, DB, DEGREES)
    said, detail = refused(path)
    assert "no column is a frequency" in said
    assert "disting fit a.csv --read columns=Hz,dB,deg" in said
    assert detail.splitlines()[1].split() == ["1", "Punkt", "not", "used", "3,", "4,", "5,", ".."]
    np.testing.assert_allclose(read(path, columns=["Hz", "dB", "deg"]).G, G, rtol=1e-12)


@pytest.mark.parametrize(
    ("numbers", "sure"), [(np.abs(G), False), (80 + 5 * np.sin(F), True)], ids=["linear", "high"]
)
def test_a_gain_without_a_unit_is_said_to_be_taken_as_linear(tmp_path, numbers, sure):
    path = written(tmp_path / "a.csv", "f [Hz],gain,phase [deg]", F, numbers, DEGREES)
    found, note = (
        read(path),
        "column 2 (gain) says no unit: taken as linear; if dB, give --unit magnitude=dB",
    )
    assert (note in found.suspicions, note in found.notes) == (sure, not sure)
    assert np.allclose(np.abs(read(path, magnitude_unit="dB").G), 10 ** (numbers / 20))
    assert not any("says no unit" in said for said in read(path, magnitude_unit="1").notes)


@pytest.mark.parametrize("names", [("", "", ""), ("f [Hz],", "gain [dB],", "phase [deg],")])
def test_a_table_of_a_line_for_each_quantity_is_turned_and_said(tmp_path, names):
    columns = (F, DB, DEGREES) if names[0] else (F, G.real, G.imag)
    text = [
        name + ",".join(map(str, row.tolist())) for name, row in zip(names, columns, strict=True)
    ]
    (tmp_path / "a.csv").write_text("\n".join(text))
    found = read(tmp_path / "a.csv")
    np.testing.assert_allclose(found.G, G, rtol=1e-12)
    assert "the table has a line for each quantity: it is read by its columns" in found.notes


def test_frequencies_that_contradict_their_unit_are_a_suspicion(tmp_path):
    path = written(tmp_path / "a.csv", "f [rad/s],Re,Im", F, G.real, G.imag)
    assert "if Hz, give --unit frequency=Hz" in read(path).suspicions[0]


@pytest.mark.parametrize(("unit", "size"), [("ms", 1e3), ("s", 1.0), ("µs", 1e6), ("min", 1 / 60)])
def test_times_of_a_record_have_units(tmp_path, unit, size):
    samples = np.arange(40.0)
    path = written(
        tmp_path / "a.csv",
        f"t [{unit}],u,y",
        samples / 100 * size,
        np.sin(samples),
        np.cos(samples),
    )
    assert read_time_series(path, "u", "y").sampling_rate == pytest.approx(100.0)


@pytest.mark.parametrize("header", ["time ms", "t, ms", "t/ms", "t (ms)", "Zeit in ms"])
def test_a_unit_of_time_is_known_however_it_is_stated(tmp_path, header):
    samples = np.arange(40.0)
    columns = (samples, np.sin(samples), np.cos(samples))
    path = written(tmp_path / "a.csv", f"{header};u;y", *columns, delimiter=";")
    assert read_time_series(path, "u", "y").sampling_rate == pytest.approx(1000.0)


@pytest.mark.parametrize(
    "header", ["Re s,Im s", "Re h,Im h", "Re_rad_s2_A,Im_rad_s2_A", "Re A,Im A"]
)
def test_a_letter_behind_a_name_is_no_unit(tmp_path, header):
    found = read(written(tmp_path / "a.csv", f"f [Hz],{header}", F, G.real, G.imag))
    assert np.array_equal(found.G, G.real + 1j * G.imag) and found.output.unit == ""


def test_a_unit_of_time_that_is_not_known_is_refused(tmp_path):
    samples = np.arange(40.0)
    path = written(tmp_path / "a.csv", "t [ticks],u,y", samples, np.sin(samples), np.cos(samples))
    with pytest.raises(InputError, match="'ticks' is not a known unit of time; known units: s, ms"):
        read_time_series(path, "u", "y")
    assert read_time_series(path, "u", "y", sampling_rate=5.0).sampling_rate == 5.0
