"""disting look: what it prints, writes and refuses."""

import json
import os
import re
import subprocess

import numpy as np
import pytest
from jsonschema import Draft202012Validator

from disting.cli.terminal_plot import ASCII, UNICODE, bode_lines, curve, nyquist_lines
from disting.files import Format, schema
from disting.measurement import TimeSeries, look
from disting.report.look import look_figures, spectra
from tests.cli.process import COMMAND, called


@pytest.fixture
def bode(tmp_path):
    rows = [f"{f},{20 - f},{-9 * f}" for f in range(1, 20)]
    path = tmp_path / "bode.csv"
    path.write_text("\n".join(["f [Hz],Gain (dB),Phase (deg)", *rows, ""]))
    return path


def test_it_shows_columns_facts_and_a_diagram(bode):
    done = called("look", bode)
    assert done.returncode == 0 and done.stderr == ""
    lines = done.stdout.splitlines()
    assert lines[0] == "bode.csv, column 2 (Gain (dB))"
    assert lines[1].split() == ["#", "name", "unit", "role", "quantity", "begins", "with", "why"]
    assert re.fullmatch(
        r"2  Gain \(dB\) +dB +gain +acceleration +19, 18, 17 +header word; .*", lines[3]
    )
    assert "response: acceleration (assumed); 19 lines from 1 to 19 Hz" in lines
    assert any(line.startswith("amplitude") for line in lines) and "⠉" in done.stdout


@pytest.mark.full
@pytest.mark.parametrize("encoding", ["ascii", pytest.param("utf-8", marks=pytest.mark.slow)])
def test_a_pipe_gets_80_columns_of_what_it_can_hold(bode, encoding):
    environment = {name: value for name, value in os.environ.items() if name != "COLUMNS"}
    environment |= {"PYTHONIOENCODING": encoding, "DISTING_CACHE": "off"}
    done = subprocess.run(
        [*COMMAND, "look", str(bode)], capture_output=True, env=environment, check=True, timeout=600
    )
    text = done.stdout.decode(encoding)
    assert max(map(len, text.splitlines())) == 80 and "\\u" not in text
    assert ("⠉" in text) == (encoding == "utf-8")


def test_options_are_those_of_a_fit(bode):
    options = (
        "--quantity velocity --sign=- --unit input=A --unit output=deg/s --band 5..15 --scale 2"
    )
    done = called("look", bode, *options.split(), "--json", "-")
    plain = json.loads(done.stdout)
    assert plain["quantity"] == "velocity" and plain["assumed"] == []
    assert plain["lines"] == {"count": 11, "band": pytest.approx([5.0, 15.0])}
    few = json.loads(called("look", bode, "--band", "1..2", "--json", "-").stdout)
    assert few["lines"]["count"] == 19 and "lie in the band" in few["doubts"][0]


def test_json_is_what_python_says(bode):
    plain = json.loads(called("look", bode, "--json", "-").stdout)
    assert plain == json.loads(json.dumps(look(bode).to_dict()))


@pytest.mark.full
def test_a_page_lies_in_the_folder_and_is_the_same_again(bode, tmp_path):
    out = tmp_path / "out"
    done = called("look", bode, "--out", out)
    assert done.stdout.splitlines()[-1] == f"written to {out}; open {out / 'look.html'}"
    names = {"look.html", "look.json", "bode.svg", "bode.png", "bode.pdf"}
    assert {path.name for path in out.iterdir()} == names
    before = {path.name: path.read_bytes() for path in out.iterdir()}
    called("look", bode, "--out", out)
    assert {path.name: path.read_bytes() for path in out.iterdir()} == before
    page = before["look.html"].decode()
    assert "quantity acceleration; if not, give" in page and page.count("<svg class") == 2


@pytest.mark.full
def test_what_is_refused_is_shown_with_status_0_and_what_is_no_table_is_not(bode, tmp_path):
    few = tmp_path / "few.csv"
    few.write_text("\n".join(bode.read_text().splitlines()[:5]))
    assert called("fit", few).returncode == 2
    done = called("look", few, "--out", tmp_path / "out")
    assert done.returncode == 0 and "4 frequencies are too few" in done.stdout
    assert "4 frequencies are too few" in (tmp_path / "out" / "look.html").read_text()
    (tmp_path / "words.csv").write_text("only words\n")
    for name in ("words.csv", "absent.csv"):
        done = called("look", tmp_path / name)
        assert done.returncode == 2 and done.stdout == "" and len(done.stderr.splitlines()) == 1
    assert called("look", bode, "--read", "wrong=1").returncode == 2


@pytest.fixture
def two(tmp_path):
    """A file with the responses of two sensors."""
    rows = [f"{f},{20 - f},{-9 * f},{f},{-f}" for f in range(1, 20)]
    path = tmp_path / "two.csv"
    path.write_text("\n".join(["f [Hz],Re motor,Im motor,Re load,Im load", *rows, ""]))
    return path


@pytest.mark.full
def test_several_sensors_and_experiments_are_shown_one_after_the_other(two):
    """As a fit reads them."""
    words = (two, "--sensor", "1,2", "--sign=+,-", "--experiment", f"{two}:lock=2")
    plain = json.loads(called("look", *words, "--json", "-").stdout)
    Draft202012Validator(schema(Format.LOOK)).validate(plain)
    every = [plain, *plain["further"]]
    locked = "experiment lock=2, sensor="
    assert [x["place"] for x in every] == ["sensor 1", "sensor 2", f"{locked}1", f"{locked}2"]
    origins = ["two.csv, column 2 (Re motor)", "two.csv, column 4 (Re load)"]
    assert [x["origin"] for x in every] == origins * 2


@pytest.mark.full
def test_each_sensor_has_its_page(two, tmp_path):
    out = tmp_path / "out"
    lines = called("look", two, "--sensor", "1,2", "--out", out).stdout.splitlines()
    assert [line for line in lines if line.startswith("sensor")] == ["sensor 1:", "sensor 2:"]
    pages = [out / "look.html", out / "2" / "look.html"]
    assert lines[-1] == f"written to {out}; open {pages[0]}, {pages[1]}"
    assert all(page.exists() for page in pages)


def test_files_without_places_are_shown_one_by_one(bode, two):
    """A fit refuses these: it cannot know what they are to each other."""
    assert called("fit", bode, two).returncode == 2
    plain = json.loads(called("look", bode, two, "--json", "-").stdout)
    assert plain["place"] == "file 1" and plain["file"] == "bode.csv"
    assert [(x["place"], x["file"]) for x in plain["further"]] == [("file 2", "two.csv")]


def test_a_file_that_is_not_read_hides_no_other(bode, tmp_path):
    other = tmp_path / "other.csv"
    other.write_text("no table\n")
    done = called("look", other, bode)
    assert done.returncode == 2 and "file 2:" in done.stdout and "19 lines" in done.stdout
    assert done.stderr.startswith("disting: ") and "other.csv" in done.stderr
    alone = called("look", other, other)
    assert alone.returncode == 2 and alone.stdout == "" and "other.csv" in alone.stderr


@pytest.mark.full
def test_a_sensor_without_a_response_is_shown_with_the_reason(two):
    plain = json.loads(called("look", two, "--sensor", "1,2,3", "--json", "-").stdout)
    first, last = plain, plain["further"][-1]
    assert not first["refused"] and last["refused"] and len(last["columns"]) == 5
    assert last["doubts"][0].startswith("two.csv holds 2 responses, for 3 sensors")


@pytest.mark.full
def test_the_demonstration_is_shown_as_a_fit_reads_it(bode):
    done = called("look", "--demo")
    assert done.returncode == 0 and "response: acceleration" in done.stdout
    assert "excitation: multisine" in done.stdout
    for words, reason in (
        ((), "such as disting look bench.csv"),
        (("--demo", bode), "its own data"),
    ):
        refused = called("look", *words)
        assert refused.returncode == 2 and reason in refused.stderr


def test_names_of_a_file_are_escaped_on_the_page(tmp_path):
    rows = [f"{f},1,{f}" for f in range(1, 20)]
    path = tmp_path / "a.csv"
    path.write_text("\n".join(["f [Hz],Re <b>x</b>,Im", *rows, ""]))
    called("look", path, "--out", tmp_path / "out")
    page = (tmp_path / "out" / "look.html").read_text()
    assert "<b>x" not in page and "Re &lt;b&gt;x" in page


@pytest.mark.full
def test_an_impedance_is_drawn_in_the_complex_plane(tmp_path):
    path = tmp_path / "cell.csv"
    rows = [f"{f},{5 + 1 / f},{-1 / f}" for f in range(1, 21)]
    path.write_text("\n".join(["freq/Hz,Re(Z)/Ohm,Im(Z)/Ohm", *rows, ""]))
    (figure,) = look_figures(look(path))
    assert (figure.name, figure.title) == ("nyquist", "Nyquist diagram of 20 measured lines")
    assert {"Re Z [ohm]", "−Im Z [ohm]", "measured, 95 % bars"} <= set(texts(figure))


@pytest.mark.full
@pytest.mark.parametrize(
    ("periods", "said"),
    [(0, {"whole record"}), (3, {"mean of 3 periods", "scatter of that mean"})],
)
def test_spectra_of_a_record_are_those_of_its_periods(periods, said):
    source = np.random.default_rng(0)
    u = np.tile(source.normal(size=200), 3)
    record = TimeSeries(u, u + 0.01 * source.normal(size=600), 1000.0)
    shown = set(texts(spectra(record, 200 if periods else 0, periods)))
    labels = {"whole record", "mean of 3 periods", "scatter of that mean"}
    assert {"Input", "Output", "Frequency [Hz]"} <= shown and shown & labels == said


def texts(figure):
    """Letters are outlines; beside them each text stands as a comment."""
    return re.findall("<!-- (.*?) -->", figure.svg.decode())


def dots(rows):
    """Places of the dots of rows of braille signs, from the left and from above."""
    table = {0: (0, 0), 1: (0, 1), 2: (0, 2), 3: (1, 0), 4: (1, 1), 5: (1, 2), 6: (0, 3), 7: (1, 3)}
    return {
        (2 * x + table[bit][0], 4 * y + table[bit][1])
        for y, row in enumerate(rows)
        for x, sign in enumerate(row)
        for bit in range(8)
        if sign != " " and (ord(sign) - 0x2800) >> bit & 1
    }


def test_a_curve_passes_through_its_points():
    source = np.random.default_rng(0)
    x, y = np.sort(source.uniform(size=9)), source.uniform(size=9)
    found = dots(curve(x, y, 30, 6))
    across = np.rint((x - x.min()) / np.ptp(x) * 59).astype(int)
    down = 23 - np.rint((y - y.min()) / np.ptp(y) * 23).astype(int)
    assert set(zip(across.tolist(), down.tolist(), strict=True)) <= found
    assert {place for place, _ in found} == set(range(60))  # no gap


def test_a_curve_without_range_lies_in_the_middle():
    assert dots(curve(np.arange(4.0), np.ones(4), 3, 1)) == {(i, 1) for i in range(6)}
    assert curve(np.arange(4.0), np.arange(4.0), 2, 1, ASCII) == [".'"]


@pytest.mark.full
def test_diagrams_keep_to_their_width():
    hertz = np.geomspace(1, 1000, 50)
    response = 1 / (1 + 1j * hertz / 30)
    for signs in (UNICODE, ASCII):
        for width in (60, 80, 133):
            lines = [
                *bode_lines(hertz, response, width, signs, "rad/A"),
                *nyquist_lines(response, width, signs, "ohm"),
            ]
            assert max(map(len, lines)) == width
    assert bode_lines(hertz, response, 80, UNICODE, "").__next__() == "amplitude"


def test_a_semicircle_is_as_wide_as_two_of_its_heights():
    """One scale for both axes: a character is twice as high as it is wide."""
    turn = np.linspace(0, np.pi, 200)
    lines = list(nyquist_lines(3 + np.exp(-1j * turn), 80, UNICODE, ""))[1:-2]
    found = dots([line[11:].ljust(69) for line in lines])
    across, down = (np.ptp([place[i] for place in found]) for i in (0, 1))
    assert across == pytest.approx(2 * down, abs=2)
