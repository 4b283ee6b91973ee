"""Whatever is written on the command line or stands in a file: a refusal is short, printable
and comes before the work.
"""

import pytest

from tests.cli.process import called, disting

LONG = "9" * 100_000


@pytest.mark.parametrize(
    "command",
    [
        ("compare", "3:1", "3:4", "--bound", "k12=0..1e999999999"),
        ("compare", "3:1\x1b[2J\x07", "3:4"),
        ("compare", LONG, "3:4"),
        ("models", LONG),
        ("verdicts", "3", "--masses", LONG),
        ("fit", LONG),
    ],
)
def test_refusals_are_short_and_printable(command):
    done = called(*command)
    assert done.returncode == 2 and len(done.stderr) < 300, done.stderr[:500]
    assert done.stderr.rstrip("\n").isprintable()


@pytest.mark.full
def test_a_process_says_the_same():
    done = disting("compare", LONG, "3:4")
    assert (done.returncode, done.stderr) == (2, called("compare", LONG, "3:4").stderr)


@pytest.mark.full
def test_an_error_does_not_list_every_column_of_a_wide_file(tmp_path):
    (tmp_path / "wide.csv").write_text(
        ",".join(f"c{i}" for i in range(20_000)) + "\n" + 9 * (",".join(["1"] * 20_000) + "\n")
    )
    done = called("fit", tmp_path / "wide.csv", "--read", "response=G")
    assert done.returncode == 2 and len(done.stderr) < 700, done.stderr[:800]
