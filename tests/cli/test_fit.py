"""disting fit and disting simulate on real files."""

import json
import os
import re
from inspect import signature
from pathlib import Path

import numpy as np
import pytest

from disting.cli import main
from disting.cli.fit_data import notes_of
from disting.fit import predict, read_model, select
from disting.fit.search.data import check
from disting.fit.select import MOST_LINES
from disting.measurement import FrequencyResponse, read
from disting.model.chain import Chain
from tests.cli.process import called, disting
from tests.measurement.bench_data import measured_data
from tests.report.guide_blocks import transcripts

REPORTS = Path(__file__).parents[2] / "reports"
DRIVE = (
    "2:1+b2+delay",
    "--damped",
    "--set",
    "m1=0.01,m2=0.004,k12=800,d12=0.05,b2=0.05,Td=2e-4",
    "--output-noise",
    "1e-6",
)


ONE_MASS = ("1:1+b1+delay", "--set", "m1=0.01,b1=0.05,Td=2e-4", "--output-noise", "1e-6")


# names of other systems are Unicode
ODD = b"\xff.csv" if os.name == "posix" else b"odd.csv"


def simulated(drive, folder):
    """Training and test responses of a simulated drive."""
    paths = [folder / f"{seed}.csv" for seed in (0, 1)]
    for seed, path in enumerate(paths):
        done = called("simulate", *drive, "--seed", seed, "--csv", path)
        assert done.stdout == f"241 lines from 10 to 250 Hz in {path}\n"
    return paths


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    return simulated(DRIVE, tmp_path_factory.mktemp("drive"))


@pytest.fixture(scope="module")
def rigid(tmp_path_factory):
    """Of one mass: quickly fitted, and explained by it."""
    return simulated(ONE_MASS, tmp_path_factory.mktemp("rigid"))


@pytest.fixture(scope="module")
def fitted(files):
    """What is printed, and the file that is written."""
    path = files[0].with_name("fit.json")
    done = called("fit", files[0], "--test", files[1], "--masses", "2", "--json", path)
    assert done.returncode == 0 and done.stderr == ""
    return done.stdout, path


@pytest.mark.full
def test_what_is_simulated_is_selected(files, fitted):
    _, path = fitted
    found = json.loads(path.read_text(encoding="utf-8"))
    assert found["command"].startswith("disting fit ") and "--masses" not in found["command"]
    chosen = found["selected"]
    assert (chosen["n_masses"], chosen["ground_dampers"], chosen["lag"], chosen["delay"]) == (
        2,
        [2],
        False,
        True,
    )
    assert chosen["n_parameters"] == 6 and chosen["parameters"]["k12"] == pytest.approx(
        800, rel=2e-3
    )
    assert len(found["candidates"]) == 16 and all(
        c["admissible"] or c["reasons"] for c in found["candidates"]
    )
    chain, values = read_model(path)
    train = read(files[0])
    assert np.median(np.abs(predict(chain, values, train.omega) / train.G - 1)) < 1e-3


@pytest.mark.full
def test_the_printed_result_says_what_matters(fitted):
    said, _ = fitted
    assert "; 2:1+b2+delay explains this data (chi2 per line " in said
    assert "\n\ndata: 241 lines from " in said and "\nnot excluded by this data (" in said
    assert "\n16 candidates fitted to 241 frequency lines, validated on test data\n" in said
    assert "selected: 2 masses, damper b2, dead time " in said
    assert "  b2   = " in said and "antiresonance 1" in said and " Hz\n" in said
    assert (
        "no other candidate with as many masses gives the same response, special values aside"
        in said
    )


def test_a_note_names_the_file_only_where_there_are_several():
    """Literally, on responses that differ in file, in column and in their notes."""

    def note(origin, *notes):
        return FrequencyResponse(
            np.arange(1.0, 9.0), np.ones(8, complex), origin=origin, notes=notes
        )

    one, two = note("A.csv, column 2", "x", "y"), note("B.csv, column 2", "x", "z")
    assert list(notes_of([one])) == ["x", "y"]
    assert list(notes_of([one, two])) == ["x", "A.csv: y", "B.csv: z"]
    assert list(notes_of([one, note("A.csv, column 4", "z")]))[-1] == "column 4: z"


@pytest.mark.slow
def test_a_process_with_two_workers_says_the_same(files, fitted, tmp_path):
    path = tmp_path / "fit.json"
    options = ("--test", files[1], "--masses", "2", "--json", path, "--jobs", 2)
    done = disting("fit", files[0], *options)
    assert done.returncode == 0 and done.stderr == ""
    alone, workers = (json.loads(file.read_text(encoding="utf-8")) for file in (fitted[1], path))
    assert workers | {"command": ""} == alone | {"command": ""}
    assert [line for line in done.stdout.splitlines() if str(path.parent) not in line] == [
        line for line in fitted[0].splitlines() if str(fitted[1].parent) not in line
    ]


@pytest.mark.full
def test_an_interrupted_fit_finds_its_results_in_the_cache(rigid, tmp_path):
    cache = tmp_path / "cache.sqlite3"
    arguments = ("fit", rigid[0], "--test", rigid[1], "--masses", "1", "--json", "-")
    first, again, fresh = (called(*arguments, cache=c) for c in (cache, cache, "off"))
    assert cache.stat().st_size > 10_000 and first.stdout == again.stdout == fresh.stdout


@pytest.mark.full
def test_a_folder_gets_everything(rigid, tmp_path):
    """The page leads to the catalogue that is named, and names the file, whose name is no text
    and could not be encoded.
    """
    data, out = os.path.join(os.fsencode(tmp_path), ODD), tmp_path / "out"
    with open(data, "wb") as file:
        file.write(rigid[0].read_bytes())
    done = called(
        *("fit", os.fsdecode(data), "--test", rigid[1], "--masses", "1"),
        *("--out", out, "--site", REPORTS),
    )
    assert done.returncode == 0 and f"open {out / 'fit.html'}" in done.stdout
    left = json.loads((out / "fit.json").read_text(encoding="utf-8"))["not_excluded"]
    several = sum(m["contains"] is None for m in left) > 1
    assert (f"disting next {out / 'fit.json'}" in done.stdout) == several
    assert {"fit.html", "fit.json", "model.mat"} <= {p.name for p in out.iterdir()}
    page = (out / "fit.html").read_text(encoding="utf-8")
    assert 'reports/models/1-damped/1.html">1:1 in the catalogue</a>' in page
    assert os.fsdecode(ODD).replace("\udcff", "\\udcff") in page


@pytest.mark.full
def test_options_reach_the_fit(rigid, tmp_path):
    done = called(
        "fit",
        rigid[0],
        "--test",
        rigid[1],
        "--masses",
        "1",
        "--json",
        "-",
        "--fix",
        "Td=2e-4",
        "--band",
        "20..200",
    )
    with_delay = [c for c in json.loads(done.stdout)["candidates"] if c["delay"]]
    assert {c["parameters"]["Td"] for c in with_delay} == {2e-4}
    assert all("Td" not in c["standard_errors"] for c in with_delay)
    # what no candidate explains is looked at much longer
    there = simulated(("2:2+b2+delay", *DRIVE[1:]), tmp_path)
    last = called(
        "fit",
        there[0],
        "--test",
        there[1],
        "--masses",
        "2",
        "--json",
        "-",
        "--sensor",
        "last",
        "--seed",
        "other",
    )
    assert {tuple(c["sensor"]) for c in json.loads(last.stdout)["candidates"]} == {(0, 2)}
    assert len(json.loads(last.stdout)["not_fitted"]) == 4


def selected_in(text):
    """The line of the selected structure, and its parameters."""
    block = text[text.index("selected: ") :].split("\n\n")[0]
    values = re.findall(r"^  (\w+) += ([\d.e-]+) ", block, re.MULTILINE)
    return block.splitlines()[0], {name: float(value) for name, value in values}


@pytest.mark.full
def test_the_demonstration_drive_is_recognised():
    """As the README shows, whose larger candidates take a minute and are fitted by hand."""
    done = called("fit", "--demo", "--masses", "2")
    (shown,) = {output for _, command, output in transcripts() if command == "disting fit --demo"}
    (line, values), (line_shown, values_shown) = selected_in(done.stdout), selected_in(shown)
    assert (line, values) == (line_shown, pytest.approx(values_shown, rel=1e-4))
    assert len(values) == 6 and "A/(rad/s²)" in done.stdout


@pytest.mark.slow
def test_time_series_are_fitted_like_their_response():
    records = [measured_data(f"fditools_motorbench_{x}.mat") for x in "AB"]
    options = [
        f"--read={o}"
        for o in ("input=iq_adx", "output=theta_mx", "sampling_rate=2500", "to=acceleration")
    ]
    loose = ("--masses", "1", "--thresholds", "1e9,1e9,1e9", "--json", "-")
    raw = called("fit", records[0], "--test", records[1], *options, *loose)
    responses = [measured_data(f"fditools_motorbench_frf_{x}.csv") for x in "AB"]
    derived = called("fit", responses[0], "--test", responses[1], *loose)
    one, other = (json.loads(d.stdout)["selected"] for d in (raw, derived))
    # of a record the scatter between periods is known, and with it the weight of each line
    assert one["parameters"] == pytest.approx(other["parameters"], rel=0.02)
    assert "period of 2500 samples (1 s) detected" in raw.stderr


@pytest.mark.thin(8)
@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("fit",), "a file with measured data is needed, such as disting fit bench.csv; --demo"),
        (("fit", "missing.csv"), "there is no file missing.csv"),
        (("fit", "--demo", "x.csv"), "has its own data"),
        (("fit", "--demo", "--masses", "1-"), "written like 3, 1-4 or 1,3"),
        (("fit", "--demo", "--thresholds", "1,2"), "thresholds are written like 30,1000,20"),
        (("fit", "--demo", "--band", "9..8"), "a range is written like 11..250"),
        (("fit", "--demo", "--bound", "k12"), "a range is written like"),
        (("fit", "--demo", "--fix", "m1"), "a value is written like m1=0.02"),
        (("fit", "--demo", "--read", "x"), "an option is written like sampling_rate=2500"),
        (("fit", "--demo", "--band", "10..12"), "line"),
        (
            ("fit", "--demo", "--masses", "1", "--actuator", "3"),
            "no chain of 1 masses has these ports",
        ),
        (
            ("fit", "--demo", "--masses", "1", "--actuator", "x"),
            "a port is written like 2, last or 1:3",
        ),
        (("simulate", "2:1", "--undamped", "--set", "m1=1"), "the value of m2, k12 is missing"),
        (("simulate", "--set", "m1=1"), "--set needs a model"),
        (("simulate", "--friction", "x"), "friction is written like 1=0.3"),
        (("simulate", "--high", "2000"), "passes half the sampling rate"),
    ],
)
def test_bad_input_gets_one_sentence(arguments, message, capsys):
    try:
        status = main(arguments)
    except SystemExit as stop:
        status = stop.code
    out, err = capsys.readouterr()
    lines = [line for line in err.splitlines() if " detected in the input" not in line]
    assert status == 2 and out == "" and len(lines) == 1 and message in lines[0]


@pytest.mark.full
@pytest.mark.parametrize(
    ("more", "count"),
    [(("--lines", "20"), 20), pytest.param((), MOST_LINES, marks=pytest.mark.slow)],
)
def test_of_very_many_lines_some_are_fitted_and_text_and_json_say_so(tmp_path, more, count):
    frequency = np.linspace(5.0, 300.0, 20_000)
    response = 1 / (0.01 * (1 + 0.002j * frequency))
    text = [f"{f},{g.real},{g.imag}" for f, g in zip(frequency, response, strict=True)]
    (tmp_path / "a.csv").write_text("\n".join(["f [Hz],Re,Im", *text]))
    options = ("fit", tmp_path / "a.csv", "--masses", "1", "--quantity", "velocity")
    done = called(*options, *more, "--json", tmp_path / "fit.json")
    said = f"; {count} of 20000 lines, evenly spaced on a logarithmic scale"
    assert done.returncode == 0 and said in done.stdout.splitlines()[1]
    plain = json.loads((tmp_path / "fit.json").read_text())
    assert plain["data"][0]["reading"].endswith(said)
    assert plain["frequencies"]["lines"] == count


def test_no_more_lines_are_fitted_than_the_help_says():
    omega = np.linspace(5.0, 300.0, 2 * MOST_LINES)
    many = FrequencyResponse(omega, 1 / (0.01 * (1 + 0.002j * omega)))
    given = signature(select).parameters["lines"].default
    train, test, _ = check(many, many, [], [Chain(1)], given)
    assert len(train) == len(test) == 10_000 == MOST_LINES
