"""What people try first."""

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
        "expected one argument" if text[0] == "-" else "a range is written like 11..250"
    ) in told


def test_a_fit_in_which_nothing_explains_ends_with_status_1(tmp_path):
    f = np.geomspace(1, 100, 60)
    rng = np.random.default_rng(1)
    values = np.exp(1j * np.cumsum(rng.normal(0, 0.8, 60))) * (1 + f / 10)
    path = tmp_path / "wild.csv"
    write_csv(from_arrays(f, values), path)
    done = called("fit", path, "--masses", "1")
    assert done.returncode == 1 and "Traceback" not in done.stderr
    assert "explains" in done.stdout or "noise" in done.stdout
    assert called("fit", path, "--models", "p(R1,C1)", "--quantity", "position").returncode == 1
