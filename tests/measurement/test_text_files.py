"""Text files of every dialect that oscilloscopes, analysers and spreadsheets write; and damaged
ones.
"""

from contextlib import suppress

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings, strategies as st

from disting.errors import InputError
from disting.measurement import (
    FrequencyResponse,
    Signal,
    csv_text,
    from_frame,
    read,
    read_time_series,
    series_from_frame,
    write_csv,
)
from disting.measurement.tabular import frequency_response
from disting.measurement.text_table import table
from disting.model.chain import Quantity

FREQUENCY = np.arange(1.0, 13.0)
G = 2.0 * np.exp(1j * np.deg2rad(7.5 * FREQUENCY)) * FREQUENCY
ROWS = [(f, g.real, g.imag) for f, g in zip(FREQUENCY, G, strict=True)]


def written(path, lines):
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


def lines(rows, delimiter=",", decimal="."):
    return [delimiter.join(repr(float(x)).replace(".", decimal) for x in row) for row in rows]


@pytest.mark.thin(1)
@pytest.mark.parametrize(
    ("delimiter", "decimal"),
    [(",", "."), (";", "."), (";", ","), ("\t", "."), ("\t", ","), ("  ", "."), (" ", ",")],
)
@pytest.mark.parametrize(
    "head",
    [[], ["# a bench, 2026"], ["f [Hz]{d}Re{d}Im"], ["% f_Hz{d}real{d}imag"], ["f{d}Re G{d}Im G"]],
)
def test_dialects_of_three_columns(tmp_path, delimiter, decimal, head):
    if delimiter.strip() == "" and delimiter != "\t":
        head = [h.replace("f [Hz]", "f[Hz]").replace(" G", "G") for h in head]
    text = [*(h.format(d=delimiter) for h in head), *lines(ROWS, delimiter, decimal)]
    found = read(written(tmp_path / "a.csv", text), quantity="velocity")
    assert np.array_equal(found.omega, FREQUENCY * 2 * np.pi)
    assert np.array_equal(found.G, G) and found.quantity is Quantity.VELOCITY


@pytest.mark.thin(8)
@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "latin-1"])
@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_encodings_and_line_ends(tmp_path, encoding, end):
    text = end.join(
        [
            "Frequency (Hz);Magnitude;Phase (°)",
            *lines(
                [(f, abs(g), np.angle(g, deg=True)) for f, g in zip(FREQUENCY, G, strict=True)], ";"
            ),
        ]
    )
    (tmp_path / "a.txt").write_bytes(text.encode(encoding))
    np.testing.assert_allclose(read(tmp_path / "a.txt").G, G, rtol=1e-14)


@pytest.mark.parametrize(
    ("header", "columns"),
    [
        ("omega [rad/s],Re,Im", lambda f, g: (2 * np.pi * f, g.real, g.imag)),
        ("frequency / kHz,Re,Im", lambda f, g: (f / 1000, g.real, g.imag)),
        ("f,abs,phase [rad]", lambda f, g: (f, abs(g), np.angle(g))),
        (
            "f (Hz),Gain (dB),Phase (deg)",
            lambda f, g: (f, 20 * np.log10(abs(g)), np.angle(g, deg=True) - 360),
        ),
        ("Freq_Hz,mag_dB,phase_rad", lambda f, g: (f, 20 * np.log10(abs(g)), np.angle(g))),
        ("Im,Re,f", lambda f, g: (g.imag, g.real, f)),
    ],
)
def test_headers_name_columns_and_units(tmp_path, header, columns):
    text = [header, *lines([columns(f, g) for f, g in zip(FREQUENCY, G, strict=True)])]
    found = read(written(tmp_path / "a.csv", text))
    np.testing.assert_allclose(found.G, G, rtol=1e-13)
    np.testing.assert_allclose(found.frequency, FREQUENCY, rtol=1e-14)


def test_names_and_units_in_two_header_lines(tmp_path):
    text = [
        "Frequency;Magnitude;Phase",
        "Hz;dB;deg",
        *lines([(f, 20.0, 90.0 - f) for f in FREQUENCY], ";", ","),
    ]
    np.testing.assert_allclose(
        read(written(tmp_path / "a.csv", text)).G,
        10j * np.exp(-1j * np.deg2rad(FREQUENCY)),
        rtol=1e-13,
    )


def test_several_responses_with_deviation_and_coherence(tmp_path):
    rows = [
        (f, g.real, g.imag, 0.1, 0.9, -g.real, g.imag, 0.2, 0.8)
        for f, g in zip(FREQUENCY, G, strict=True)
    ]
    text = [
        "# f_Hz,ReG_a,ImG_a,std_a,coh_a,ReG_b,ImG_b,std_b,coh_b   (velocity/force, m/s per N)",
        *lines(rows),
    ]
    path = written(tmp_path / "a.csv", text)
    first, second = read(path), read(path, column="ReG_b")
    assert first == read(path, column=2) and second == read(path, column="coh_b")
    assert np.array_equal(second.G, -G.conj()) and np.array_equal(
        second.deviation, np.full(12, 0.2)
    )
    assert np.array_equal(first.coherence, np.full(12, 0.9)) and first.quantity is Quantity.VELOCITY
    assert np.array_equal(read(path, column="ReG_b", sign=-1).G, G.conj())
    assert second.origin == "a.csv, column 6 (ReG_b)"


def test_columns_named_by_the_caller(tmp_path):
    rows = [
        (i, f, 0.5, abs(g), np.angle(g)) for i, (f, g) in enumerate(zip(FREQUENCY, G, strict=True))
    ]
    path = written(tmp_path / "a.csv", lines(rows))
    with pytest.raises(
        InputError, match=r"5 columns, no header; name the columns: .*columns=-,Hz,-,re,im$"
    ):
        read(path)
    found = read(path, columns=["-", "Hz", "coherence", "magnitude", "rad"])
    np.testing.assert_allclose(found.G, G, rtol=1e-14)
    assert np.array_equal(found.coherence, np.full(12, 0.5))
    for wrong in (["Hz"], ["Hz", "re", "im", "-", "furlongs"], ["-"] * 5):
        with pytest.raises(InputError, match="column"):
            read(path, columns=wrong)


def test_phases_in_a_doubtful_unit_are_said(tmp_path):
    degrees = lines([(f, 1.0, 30 * f - 180) for f in FREQUENCY])
    radians = lines([(f, 1.0, 0.5 * f - 3) for f in FREQUENCY])
    said = read(written(tmp_path / "a.csv", ["f [Hz],abs,phase [rad]", *degrees])).suspicions
    assert any("degrees read as radians? then give --unit phase=deg" in note for note in said)
    said = read(written(tmp_path / "b.csv", ["f [Hz],abs,phase [deg]", *radians])).suspicions
    assert any("radians read as degrees? then give --unit phase=rad" in note for note in said)
    for text, unit in ((degrees, "deg"), (radians, "rad")):
        path = written(tmp_path / "c.csv", ["f [Hz],abs,phase", *text])
        assert any(f"phases taken as {unit}, by their size" in note for note in read(path).notes)
        assert read(path) == read(path, phase_unit=unit) and not any(
            "phases" in n for n in read(path, phase_unit=unit).notes
        )
    with pytest.raises(
        InputError, match="'grad' is not a known unit of phase; known units: rad, mrad, deg"
    ):
        read(path, phase_unit="grad")


def test_the_sensor_is_taken_from_words_or_said_to_be_assumed(tmp_path):
    def found(head, **options):
        return read(
            written(tmp_path / "a.csv", [f"# {head}", "f [Hz],Re,Im", *lines(ROWS)]), **options
        )

    assert found("mobility of the spindle").quantity is Quantity.VELOCITY
    assert (
        found("rad/s^2 per A").quantity is Quantity.ACCELERATION
        and not found("rad/s^2 per A").notes
    )
    assert found("displacement per force").quantity is Quantity.POSITION
    doubtful = found("velocity from position")
    assert (
        doubtful.quantity is Quantity.ACCELERATION and "taken as acceleration" in doubtful.notes[0]
    )
    assert found("mobility", quantity="position").quantity is Quantity.POSITION


@pytest.mark.thin(8)
@pytest.mark.parametrize(
    ("text", "words"),
    [
        (
            ["f,Re,Im", *lines(ROWS[:5]), "6,1", *lines(ROWS[6:])],
            "a.csv, line 7: 2 columns where the others have 3",
        ),
        (
            ["f,Re,Im", *lines(ROWS[:5]), "6,x1,2", *lines(ROWS[6:])],
            r"line 7, column 2 \(Re\): 'x1' is not a number",
        ),
        (["f,Re,Im", "1,1,?", *lines(ROWS[1:])], "line 2, column 3: '\\?' is not a number"),
        (
            ["f,Re,Im", *lines(ROWS[:5]), "6,nan,2", *lines(ROWS[6:])],
            r"line 7, column 2 \(Re\): the value is not finite",
        ),
        (
            ["f,Re,Im", "6,1e999,2", *lines(ROWS[:5]), *lines(ROWS[6:])],
            "line 2, column 2 .*not finite",
        ),
        (["f,Re,Im", *lines(ROWS[:7])], "7 frequencies are too few"),
        (["f,Re,Im", "0,1,1", *lines(ROWS)], "not positive"),
        (["f,Re,Im", *lines(ROWS), "3,1,1"], "occurs twice"),
        (
            ["a,Re,Im", *lines(ROWS)],
            "no column is a frequency; name the .* --read columns=Hz,re,im; headers: a, Re, Im",
        ),
        (
            ["f,Re,b", *lines(ROWS)],
            "columns for real parts: 1, for imaginary parts: 0; .* columns=Hz,re,im; headers: f, Re, b",
        ),
        (["f,a,b", *lines(ROWS)], "no real and imaginary part, no gain and phase are known"),
        (["f,abs,deg", "1,-1,3", *lines(ROWS[1:])], "a magnitude is negative"),
        (["f,Re,Im,coh", *(f"{line},50" for line in lines(ROWS))], "coherence lies in 0..1"),
        (["f,Re,Im,coh,coh", *(f"{line},1,1" for line in lines(ROWS))], "coherence occurs twice"),
        (["nothing", "here"], "no columns of numbers"),
        ([""], "no columns of numbers"),
    ],
)
def test_mistakes_are_named_with_line_and_column(tmp_path, text, words):
    with pytest.raises(InputError, match=words):
        read(written(tmp_path / "a.csv", text))


def test_unsorted_lines_are_sorted_and_said(tmp_path):
    found = read(written(tmp_path / "a.csv", ["f [Hz],Re,Im", *lines(ROWS[::-1])]))
    assert np.array_equal(found.G, G) and any("sorted" in note for note in found.notes)


@pytest.mark.full
def test_time_series_from_text(tmp_path):
    time = np.arange(400) * 1e-3
    rows = np.column_stack([time, np.sin(time), np.cos(time)])
    path = written(tmp_path / "a.csv", ["t [s];torque;angle", *lines(rows, ";", ",")])
    found = read_time_series(path, "torque", 3, sign=-1)
    assert np.array_equal(found.y, -np.cos(time)) and found.sampling_rate == pytest.approx(
        1000, rel=1e-12
    )
    assert read_time_series(path, "torque", "angle", sampling_rate=50).sampling_rate == 50
    with pytest.raises(InputError, match="headers: t \\[s\\], torque, angle"):
        read_time_series(path, "torque", "speed")
    with pytest.raises(InputError, match="not equidistant"):
        read_time_series(path, "torque", "angle", time="torque")
    with pytest.raises(InputError, match="sampling_rate"):
        read_time_series(written(tmp_path / "b.csv", ["u;y", *lines(rows[:, 1:], ";")]), "u", "y")


def test_options_that_a_format_does_not_know_are_refused(tmp_path):
    path = written(tmp_path / "a.csv", ["f,Re,Im", *lines(ROWS)])
    with pytest.raises(
        InputError, match="unknown option record; known for this format: column, columns"
    ):
        read(path, record=2)
    with pytest.raises(InputError, match="columns are named by"):
        read(path, columns=0.5)
    with pytest.raises(InputError, match="there is no file"):
        read(tmp_path / "absent.csv")
    with pytest.raises(InputError, match="give both"):
        read(path, input="f")
    with pytest.raises(InputError, match="sign of a sensor"):
        read(path, sign=0)


@pytest.mark.full
def test_data_frames(tmp_path):
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame({"f [Hz]": FREQUENCY, "Re": G.real, "Im": G.imag, "coherence": 0.5})
    assert np.array_equal(from_frame(frame, quantity="position").G, G)
    assert from_frame(frame.set_index("f [Hz]")) == from_frame(frame)
    assert len(series_from_frame(frame, "Re", "Im", sampling_rate=10)) == 12
    for wrong in (
        frame.assign(Re="a"),
        frame[:0],
        frame.assign(Re=np.nan),
        [1, 2],
        frame[["Re", "Im"]],
    ):
        with pytest.raises(InputError):
            from_frame(wrong)


FINITE = st.floats(-1e300, 1e300, allow_subnormal=True).filter(bool)


@pytest.mark.full
@given(
    st.lists(st.floats(1e-6, 1e6), min_size=8, max_size=20, unique=True),
    st.data(),
    st.sampled_from(list(Quantity)),
)
@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=60)
def test_what_is_written_reads_back_bit_by_bit(tmp_path, omega, data, sensor):
    size = len(omega)
    column = st.lists(FINITE, min_size=size, max_size=size)
    G = np.array(data.draw(column)) + 1j * np.array(data.draw(column))
    deviation = np.abs(data.draw(column)) if data.draw(st.booleans()) else None
    coherence = (
        data.draw(st.lists(st.floats(0, 1), min_size=size, max_size=size))
        if data.draw(st.booleans())
        else None
    )
    word = st.text(st.characters(codec="utf-8", exclude_categories=("C", "Z")), max_size=8)
    signals = [Signal(data.draw(word), data.draw(word)) for _ in range(2)]
    response = FrequencyResponse(
        omega,
        G,
        deviation,
        coherence,
        sensor,
        *signals,
        origin="here: acceleration",
        notes=("velocity",),
    )
    write_csv(response, tmp_path / "a.csv")
    assert read(tmp_path / "a.csv") == response
    assert (tmp_path / "a.csv").read_text(encoding="utf-8") == csv_text(response)


def test_a_file_that_cannot_be_written_is_named(tmp_path):
    response = FrequencyResponse(FREQUENCY, G)
    with pytest.raises(InputError, match="cannot be written"):
        write_csv(response, tmp_path / "absent" / "a.csv")


GARBLED = st.text(st.sampled_from('0123456789.,;+-eE#%\t\n" fReImHzdB[]nainf/°'), max_size=300)


@pytest.mark.full
@given(st.one_of(st.binary(max_size=300), GARBLED.map(lambda t: t.encode())))
@settings(
    suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=300, deadline=None
)
def test_garbled_text_is_refused_and_nothing_else(tmp_path, content):
    path = tmp_path / "a.csv"
    path.write_bytes(content)
    refused(lambda: read(path))
    refused(lambda: read_time_series(path, 1, 2, sampling_rate=100.0))


@pytest.mark.full
@given(st.integers(0, 700), st.integers(0, 700), st.binary(max_size=4))
@settings(
    suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=200, deadline=None
)
def test_a_damaged_file_is_refused_or_still_a_response(tmp_path, start, length, filling):
    whole = "\n".join(["f [Hz],Re,Im", *lines(ROWS)]).encode()
    path = tmp_path / "a.csv"
    path.write_bytes(whole[:start] + filling + whole[start + length :])
    refused(lambda: read(path))


def refused(call):
    """Any other error than InputError fails the test."""
    with suppress(InputError):
        call()


def test_parts_in_blocks_or_given_twice(tmp_path):
    blocks = [
        (f, g.real, 2 * g.real, g.imag, 2 * g.imag) for f, g in zip(FREQUENCY, G, strict=True)
    ]
    path = written(tmp_path / "a.csv", ["f [Hz],Re a,Re b,Im a,Im b", *lines(blocks)])
    assert np.array_equal(read(path).G, G) and np.array_equal(read(path, column="Im b").G, 2 * G)
    both = [
        (f, abs(g), 20 * np.log10(abs(g)), np.angle(g, deg=True))
        for f, g in zip(FREQUENCY, G, strict=True)
    ]
    path = written(tmp_path / "b.csv", ["f [Hz],magnitude,mag_dB,phase [deg]", *lines(both)])
    np.testing.assert_allclose(read(path).G, G, rtol=1e-14)


def test_a_comment_of_three_words_is_no_header(tmp_path):
    path = written(tmp_path / "a.txt", ["# measured on Monday", *lines(ROWS, " ")])
    assert np.array_equal(read(path).G, G) and "no header" in read(path).notes[0]


@pytest.mark.full
def test_a_cell_of_many_digits_is_refused_at_once():
    """Matching took quadratic time: over two minutes for 40,000 digits. A hundred times as many
    are read here.
    """
    with pytest.raises(InputError, match="is not a number"):
        table("f,re,im\n" + "1,2,3\n" * 20 + "1" * 4_000_000 + "x,1,2\n", "long.csv")


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (["f,Re,Im", "0.5,7", *lines(ROWS)], "line 2: 2 columns where the others have 3"),
        (["f,Re,Im", "0.5,7,8,9", *lines(ROWS)], "line 2: 4 columns where the others have 3"),
        (["f,Re,Im", "0.5", *lines(ROWS)], "line 2: 1 columns where the others have 3"),
        (["0.5,7", *lines(ROWS)], "line 1: 2 columns where the others have 3"),
        (
            ["f;Re;Im", *lines(ROWS, ";"), "13;1,234;5.5"],
            "line 14, column 2 .Re.: '1,234' is not a number",
        ),
        (
            ["f;Re;Im", *lines(ROWS, ";", ","), "13;1.234;5,5"],
            "line 14, column 2 .Re.: '1.234' is not a number",
        ),
        (
            ["f\tRe\tIm", *lines(ROWS, "\t"), "13\t\t4\t5"],
            "line 14: 4 columns where the others have 3",
        ),
        (
            ["f,Re,Im", *lines(ROWS), "13,\u0663,5"],
            "line 14, column 2 .Re.: '\u0663' is not a number",
        ),
    ],
)
def test_damage_of_the_first_line_and_foreign_decimal_signs_lose_no_number(tmp_path, text, words):
    """A first line without all its cells was passed over like a preface; 1,234 among decimal
    points was read as 1.234.
    """
    with pytest.raises(InputError, match=words):
        read(written(tmp_path / "a.csv", text))


@pytest.mark.full
def test_headers_by_the_thousand_are_not_all_listed():
    with pytest.raises(InputError, match="no column is a frequency") as refused_:
        frequency_response(
            table(",".join(["x"] * 5000) + "\n" + (",".join(["1"] * 5000) + "\n") * 9, "wide.csv")
        )
    assert len(str(refused_.value)) < 1000


def test_no_label_becomes_a_formula_of_a_spreadsheet(tmp_path):
    r"""Comments are split into cells too; a label that holds \\u003d itself comes back as it
    was.
    """
    labels = Signal("x,=cmd()", "a; @b"), Signal("\\u003d1", "\\u005c")
    response = FrequencyResponse(FREQUENCY, G, input=labels[0], output=labels[1], origin="x,-2+3")
    write_csv(response, tmp_path / "a.csv")
    text = (tmp_path / "a.csv").read_text(encoding="utf-8")
    assert not any(sign in text for sign in (",=", "; @", ",-2+"))
    assert read(tmp_path / "a.csv") == response
