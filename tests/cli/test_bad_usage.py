"""Bad usage and bad input: one sentence that names cause and remedy, exit status 2, nothing
half printed.
"""

from pathlib import Path

import pytest

from disting.cli import main
from tests.cli.process import disting

CHAIN = ("equivalents", "3:1", "--undamped", "--to", "3:11", "--set")
REPORTS = Path(__file__).parents[2] / "reports"
DEMO = ("fit", "--demo", "--masses", "1")
WORDS = [
    (("compare", "3:12", "3:1"), "models 1 to 11"),
    (("compare", "3", "3:1"), "masses:number"),
    (("compare", "999:1", "3:1"), "at most 40 masses"),
    (("compare", "3:1+c", "3:1"), "for instance 3:4 or 3:4+b1+lag"),
    (("compare", "3:1+b4", "3:1"), "ground dampers sit at masses 1 to 3"),
    (("dampers", "41"), "1 to 40 masses"),
    (
        ("compare", "3:1", "3:2", "--bound", "k12=1..2", "--json"),
        "--json is not supported with --bound",
    ),
    (("compare", "3:1", "3:2", "--bound", "k12=5"), "a range is written like"),
    (("compare", "3:1", "3:2", "--bound", "x9=1..2"), "no parameter"),
    (("compare", "3:1", "3:2", "--bound", "k12=3..1"), "positive and not empty"),
    (("models", "0"), "at least 1"),
    (("models", "-3"), "at least 1"),
    (("models", "3.5"), "at least 1"),
    (("models", "26"), "at most 25"),
    (("models", "9" * 5000), "a whole number"),
    (("models", "3", "--also", "sensor=3/2"), "write only sensor=3"),
    (("models", "3", "--also", "sensor=4"), "no mass 4"),
    (("models", "3", "--also", "sensor"), "an experiment is written"),
    (("models", "1", "--also", "lock=1"), "leave one that moves"),
    (("verdicts", "3-41"), "at most 40 masses"),
    (("verdicts", "4-1"), "sizes are written like"),
    (("verdicts", "3", "--conditions", "0-5"), "conditions are written like"),
    (("verdicts", "3", "--conditions", "5-3"), "conditions are written like"),
    (("verdicts", "3", "--conditions", "5-"), "conditions are written like"),
    (("verdicts", "3", "--conditions", "exact"), "conditions are written like"),
    (("verdicts", "3", "--quantity", "force"), "drives the machine; the quantity is what"),
    (("verdicts", "3", "--quantity", "jerk"), "quantity is position, velocity or acceleration"),
    (("verdicts", "3", "--csv", "-", "--json", "-"), "not both"),
    (("verdicts", "3", "--markov", "-4"), "at least 1"),
    (("verdicts", "3", "--jobs", "0"), "at least 1"),
    (
        ("verdicts", "2", "--csv", "/dev/full"),
        "/dev/full cannot be written (No space left on device); name another file",
    ),
    ((*CHAIN, "m1=1"), "the value of m2, m3, k12, k23 is missing"),
    ((*CHAIN, "m1=-1,m2=2,m3=3,k12=1,k23=1"), "are positive"),
    ((*CHAIN, "m1=nan,m2=2,m3=3,k12=1,k23=1"), "a number such as"),
    ((*CHAIN, "m1=1,m2=2,m3=3,k12=1e-300,k23=1"), "choose other units"),
    ((*CHAIN, "m1=1,m2=2,m3=3,k12=1,k23=" + "9" * 100), "choose other units"),
    (
        ("equivalents", "3:2", "--to", "3:5", "--formulas", "--also", "sensor=2"),
        "remove one of them",
    ),
    (("equivalents", "99:1", "--to", "3:1", "--set", "m1=1"), "at most 40 masses"),
    (("equivalents", "R1-C1", "--to", "R1-C1", "--also", "sensor=2"), "--also is not supported"),
    (
        ("equivalents", "R1-C1", "--to", "R1-C1", "--formulas", "--set", "R1=1,C1=1"),
        "formulas hold for any values: remove --set",
    ),
    (("equivalents", "3:1", "--family", "circuits-4"), "--family is supported for networks only"),
    (("fit", "a.csv", "b.csv", "--repeat", "c.csv"), "--repeat is for a single file"),
    (("simulate", "--seed", "-1"), "at least 0"),
    (("simulate", "--quantum", "nan"), "finite and not negative"),
    (("simulate", "--samples", "99999999999"), "not enough memory"),
    (("fit",), "--demo shows a fit"),
    ((*DEMO, "--test", "x.csv"), "--demo has its own data"),
    ((*DEMO, "--read", "to=velocity"), "--demo has its own data"),
    ((*DEMO, "--profiles"), "--out"),
    ((*DEMO, "--site", str(REPORTS)), "--out"),
    ((*DEMO, "--site", "no/such"), "holds no pages that 'disting report' wrote"),
    (
        (*DEMO, "--fix", "zz=1"),
        "no candidate has a parameter zz; their parameters are T1, Td, b1, m1",
    ),
    ((*DEMO, "--bound", "zz=1..2"), "no candidate has a parameter zz"),
    ((*DEMO, "--thresholds", "30,nan,20"), "all positive"),
    (("fit", "--demo", "--masses", "3-1"), "are written like 3, 1-4 or 1,3"),
    (("catalog", "verify", "3", "--catalog", "/no/such"), "disting catalog build"),
    (("report",), "name at least one number of masses"),
    (("report", "3", "--damped", "--undamped"), "not allowed with"),
]


def refused(capsys, *arguments):
    """What is said to bad input; nothing is printed for it."""
    try:
        status = main(arguments)
    except SystemExit as end:  # argparse ends the process
        status = end.code
    out, error = capsys.readouterr()
    # what the simulated data is like
    told = [line for line in error.splitlines() if "detected in the input" not in line]
    assert (status, out, len(told)) == (2, "", 1)
    assert told[0].startswith("disting: ")
    return told[0]


@pytest.mark.thin(8)
@pytest.mark.parametrize(
    ("arguments", "says"), WORDS, ids=[" ".join(words)[:60] for words, _ in WORDS]
)
def test_bad_usage_is_one_clear_sentence_and_status_2(capsys, arguments, says):
    assert says in refused(capsys, *arguments)


@pytest.mark.parametrize(
    "words",
    [
        ("compare", "3:1\x1b[2J", "3:1"),
        ("fit", "\x1b]0;x\x07.csv"),
        ("models", "\u202e3"),
        ("models", "1\n2"),
    ],
)
def test_control_characters_do_not_reach_the_terminal(capsys, words):
    assert refused(capsys, *words).isprintable()


@pytest.mark.full
def test_what_is_quoted_is_shortened(capsys):
    assert len(refused(capsys, "doctor", "1" * 100_000)) < 1000
    assert "for instance 3:4" in refused(capsys, "compare", "3:1" * 100_000, "3:1")


def test_processes_say_the_same():
    done = disting("compare", "3:12", "3:1")
    assert (done.returncode, done.stdout) == (2, "")
    assert (
        done.stderr
        == "disting: the 3-mass family has models 1 to 11, not 12; 'disting models 3' lists them\n"
    )


@pytest.mark.slow
def test_no_cluster_answers():
    done = disting("verdicts", 3, "--scheduler", "tcp://127.0.0.1:9")
    assert (done.returncode, done.stdout) == (2, "")
    assert "no dask scheduler" in done.stderr and "Traceback" not in done.stderr


@pytest.mark.parametrize(
    "command",
    [
        ("verdicts", "3", "--csv"),
        ("verdicts", "3", "--json"),
        ("simulate", "--csv"),
        (*DEMO, "--json"),
    ],
)
def test_a_file_that_cannot_be_written_is_named_before_the_work(capsys, tmp_path, command):
    assert f"{tmp_path} is not a file" in refused(capsys, *command, str(tmp_path))
    assert "an empty name is not a file" in refused(capsys, *command, "")
    assert f"there is no folder {tmp_path}/a; make it first" in refused(
        capsys, *command, f"{tmp_path}/a/b.csv"
    )


@pytest.mark.parametrize(
    "command", [("report", "3"), ("catalog", "build", "2"), ("catalog", "candidates"), DEMO]
)
def test_a_folder_that_cannot_be_made_is_named_before_the_work(capsys, tmp_path, command):
    file = tmp_path / "file"
    file.touch()
    for where in (file, file / "below"):
        assert f"{file} is a file, not a folder" in refused(capsys, *command, "--out", str(where))
    assert list(tmp_path.iterdir()) == [file]


@pytest.mark.parametrize(
    ("name", "content", "says"),
    [
        ("empty.csv", b"", "holds no columns of numbers"),
        ("header.csv", b"f,re,im\n", "holds no columns of numbers"),
        ("text.csv", b"f,re,im\n1,2,3\n2,3,x\n", "line 3, column 3 (im): 'x' is not a number"),
        ("nan.csv", b"f,re,im\n1,nan,3\n2,3,4\n", "line 2, column 2 (re): the value is not finite"),
        ("bytes.csv", bytes(range(256)) * 9, "is not a text file"),
        ("latin.csv", bytes(range(128, 256)) * 20, "holds no columns of numbers"),
        ("bytes.mat", bytes(range(256)) * 9, "is not a MATLAB file"),
        ("object.json", b"{ not json", "holds no columns of numbers"),
    ],
)
def test_files_that_hold_no_data(capsys, tmp_path, name, content, says):
    (tmp_path / name).write_bytes(content)
    assert says in refused(capsys, "fit", str(tmp_path / name))


def test_no_file_and_a_folder_are_told_apart(capsys, tmp_path):
    assert f"there is no file {tmp_path}/none.csv" in refused(capsys, "fit", f"{tmp_path}/none.csv")
    assert f"{tmp_path} is a folder" in refused(capsys, "fit", str(tmp_path))


def test_names_after_their_file_are_told_how_they_are_written(capsys):
    said = refused(capsys, "compare", "vessels.json", "leaks first", "leaks second")
    assert "leaks second; a model of a file is written vessels.json:NAME" in said
