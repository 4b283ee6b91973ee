"""What people try first."""

import json
import re

import numpy as np
import pytest

from disting.cli.arguments import frequency_range
from disting.cli.run import main
from disting.measurement import from_arrays, write_csv
from tests.cli.process import called


@pytest.mark.parametrize("words", [(), ("help",), ("help", "compare"), ("help", "catalog")])
def test_help_is_there_however_it_is_asked_for(words):
    asked = called(*words)
    wanted = called(*words[1:], "--help")
    assert asked.returncode == 0 and asked.stdout == wanted.stdout and asked.stdout


@pytest.mark.parametrize(
    ("text", "limits"),
    [("10-100", (10.0, 100.0)), ("1e-3-5", (0.001, 5.0)), ("0.5..2.5e2", (0.5, 250.0))],
)
def test_a_band_is_written_with_dots_or_a_dash(text, limits):
    assert frequency_range(text) == limits


@pytest.mark.parametrize("text", ["100-10", "10", "-10-100", "10-", "a-b", "nan..3"])
def test_what_is_no_band(text, capsys):
    with pytest.raises(SystemExit):
        main(["fit", "--demo", "--band", text])
    told = capsys.readouterr().err
    assert (
        "--band needs a value: LOW..HIGH" if text[0] == "-" else "a range is written like 11..250"
    ) in told


@pytest.mark.full
def test_a_fit_in_which_nothing_explains_ends_with_status_1(tmp_path):
    f = np.geomspace(1, 100, 60)
    rng = np.random.default_rng(1)
    values = np.exp(1j * np.cumsum(rng.normal(0, 0.8, 60))) * (1 + f / 10)
    path = tmp_path / "wild.csv"
    write_csv(from_arrays(f, values), path)
    done = called("fit", path, "--masses", "1")
    assert done.returncode == 1 and "Traceback" not in done.stderr
    assert "explains" in done.stdout or "noise" in done.stdout
    assert "the best one, which does not explain the data: 1 mass" in done.stdout
    assert "selected" not in done.stdout and "\nnext:\n" not in done.stdout
    assert called("fit", path, "--models", "p(R1,C1)", "--quantity", "position").returncode == 1


BRANCHED, ROW = "1=2, 2=3, 2=4; F1; S1", "1=2, 2=3, 3=4; F1; S1"


def test_a_file_of_the_verdict_and_the_verdict_are_one_answer(tmp_path):
    file = tmp_path / "verdict.json"
    alone = called("compare", "2:1", "2:2")
    both = called("compare", "2:1", "2:2", "--json", file)
    assert both.returncode == 0 and both.stdout == alone.stdout
    assert both.stdout.startswith("DISTINGUISHABLE") and "3 combinations of its 4" in both.stdout
    whole = json.loads(file.read_text())
    assert whole["relation"] == "distinguishable"
    assert json.loads(called("compare", "2:1", "2:2", "--json").stdout) == whole


@pytest.mark.full
def test_what_cannot_be_determined_is_said_before_the_reason():
    """Of a shipped pair, of one that is computed, of a network; of none where all is determined."""
    said = "Not all of {} can be determined: what is measured fixes {} combinations of its {} parameters."
    for left, right, name, rank, count in (
        ("2:1", "2:2", "2:2", 3, 4),
        ("2:1+b1", "2:2+lag", "2:2+lag", 4, 5),
        ("R0-p(R1,C1)-R2", "R0-C1", "R0-p(R1,C1)-R2", 3, 4),
        ("R0-p(R1,P1)-R2", "R0-p(R1,C1)", "R0-p(R1,P1)-R2", 4, 5),
    ):
        lines = called("compare", left, right).stdout.split("\n")
        place = lines.index(said.format(name, rank, count))
        assert place < next(i for i, line in enumerate(lines) if "are distinguishable over" in line)
    assert "can be determined" not in called("compare", "3:1", "3:4").stdout


def test_a_chain_has_a_mass():
    done = called("compare", "0:1", "0:2")
    assert (done.returncode, done.stdout) == (2, "")
    assert "'0:1': a chain has one mass or more, for instance 3:1" in done.stderr


@pytest.mark.full
def test_networks_and_models_of_a_file_are_proven_apart(tmp_path):
    """By ranks that were counted at random points: the branched machine and the one in a row."""
    asked = ("compare", BRANCHED, ROW, "--conditions", "1-5")
    assert "certainty  probability of error" in called(*asked).stdout
    file = tmp_path / "verdict.json"
    proven = called(*asked, "--prove", "--json", file)
    assert "certainty  proven" in proven.stdout
    checked = called("verify", file)
    assert checked.returncode == 0 and "Proven." in checked.stdout


def test_the_help_of_a_fit_is_short_and_names_options_that_there_are():
    short, whole = called("fit", "--help").stdout, called("fit", "--help-all").stdout
    assert len(short.splitlines()) < 40 and max(map(len, short.splitlines())) <= 80
    named = set(re.findall(r"--[a-z-]+", short))
    assert named <= set(re.findall(r"--[a-z-]+", whole)) and len(named) > 12
    heads = ("what was measured", "candidates", "results")
    assert [line for line in short.splitlines() if line in heads] == list(heads)
    assert len(whole.splitlines()) > 100
