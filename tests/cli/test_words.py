"""What the command line says to who types: what was meant, what a word means now, colour, progress
and completion on a real terminal.
"""

import os
import pty
import select
import subprocess
import sys
import time
from pathlib import Path

import pytest

from tests.cli.process import COMMAND, called

MEANT = [
    (("comapre", "3:1", "3:4"), "did you mean compare?", "disting"),
    (("catalog", "biuld", "3"), "did you mean build?", "disting catalog"),
    (("compare", "3:1", "3:4", "--dampd"), "did you mean --damped?", "disting compare"),
    (("verdicts", "3", "--domain=postive"), "did you mean positive?", "disting verdicts"),
    (("catalog", "build", "3", "--ouz", "x"), "did you mean --out?", "disting catalog build"),
    (("cache", "info", "x"), "unrecognized arguments: x", "disting cache info"),
    (("models", "3", "--range"), "unrecognized arguments: --range", "disting models"),
    (("compare", "3:1"), "M:J is missing: the other model", "disting compare"),
]
WITH_A_REMEDY = [
    (("catalog",), "ACTION is missing: one of build, "),
    (("compare",), "N:I is missing: a model: masses:number, as 'disting models' lists it"),
    (("draw", "3:1", "--svg"), "--svg needs a value: FILE: write the drawing as SVG"),
    (
        ("plan", "2:1", "2:2", "--noise"),
        "--noise needs a value: X|FRF.csv: relative noise of a line",
    ),
    (("fit", "x.csv", "--torque-constant", "zero"), "a number is needed, not 'zero'"),
    (("simulate", "--samples", "many"), "a whole number is needed, not 'many'"),
    (("fit", "x.csv", "--bound", "k12=5..1"), "the lower end first, not '5..1'"),
    (("fit", "missing.csv"), "there is no file missing.csv; check its name and folder"),
    (
        ("fit", "good.csv", "--band", "200-300"),
        "0 of 60 lines, which go from 1 to 60 Hz, lie in the band",
    ),
    (
        ("fit", "good.csv", "--masses", "2", "--sensor", "3"),
        "the sensor is at a mass from 1 to 2, not 3",
    ),
    (("compare", "3:1", "3:99"), "'disting models 3' lists them"),
    (("compare", "3:1+b7", "3:2"), "sit at masses 1 to 3, not at 7"),
    (
        ("compare", "3:1", "3:2", "--bound", "k9=0..1"),
        "k9; their parameters are m1, m2, m3, k12, k23",
    ),
    (("plan", "1:1", "1:1+b1", "--set", "m1=1", "--noise", "2%"), "--noise 0.02 for 2 %"),
    (("simulate", "1:1", "--set", "m1=1", "--low", "900"), "not low = 900.0, high = 250.0"),
    (("next", "3:1", "--cost", "sensor=-1"), "is a positive number, not -1"),
]
MOVED = [
    (("compare", "3:1", "3:4", "--sensor", "velocity"), "is --quantity"),
    (("verdicts", "3", "--sensor=velocity"), "is --quantity"),
    (("simulate", "--sensor", "position"), "is --quantity"),
    (("simulate", "--to", "position"), "is --response"),
    (("compare", "3:1", "3:4", "--range", "k12=1..2"), "is --bound"),
    (("plan", "2:1", "2:2", "--range", "5..300"), "is --band"),
]


@pytest.mark.parametrize(("words", "says", "command"), MEANT)
def test_what_was_meant_is_named_with_the_help_of_the_command(
    words: tuple[str, ...], says: str, command: str
) -> None:
    done = called(*words)
    assert (done.returncode, done.stdout, done.stderr.count("\n")) == (2, "", 1)
    assert says in done.stderr and done.stderr.endswith(f"(see '{command} --help')\n")


@pytest.mark.thin(8)
@pytest.mark.parametrize(("words", "says"), WITH_A_REMEDY)
def test_a_mistake_is_answered_with_cause_and_remedy(
    words: tuple[str, ...], says: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    lines = [f"{f},1,0" for f in range(1, 61)]
    Path("good.csv").write_text("\n".join(["f [Hz],re [rad/s^2],im [rad/s^2]", *lines]))
    done = called(*words)
    assert (done.returncode, done.stdout) == (2, "")
    assert says in done.stderr.splitlines()[-1] and "Traceback" not in done.stderr


@pytest.mark.parametrize(("words", "says"), MOVED)
def test_a_word_of_another_meaning_is_refused_with_the_remedy(
    words: tuple[str, ...], says: str
) -> None:
    done = called(*words)
    assert done.returncode == 2 and says in done.stderr and done.stderr.count("\n") == 1
    hidden = called(words[0], "--help").stdout
    assert "--quantity" not in says or "--sensor" not in hidden


@pytest.mark.full
@pytest.mark.parametrize("n", [1, 3, 5])
def test_lists_of_models_fit_eighty_columns(n: int) -> None:
    for kind in ("--damped", "--undamped"):
        assert max(map(len, called("models", n, kind).stdout.splitlines())) <= 80


@pytest.mark.full
def test_a_long_list_is_told_at_once_and_says_what_it_leaves_away() -> None:
    told = called("models", 8).stdout
    assert told.count("[1") >= 574 and "· not computed (--ranks)" in told


@pytest.mark.full
def test_names_of_a_size_that_is_known_are_arguments() -> None:
    short, whole = called("compare", "3:1", "A4"), called("compare", "3:1", "3:4")
    assert short.stdout == whole.stdout and short.returncode == 0
    dampers = called("dampers", "2:A2", "--sets", "single").stdout
    assert dampers.startswith("2:2  ")
    refused = called("compare", "A1", "A4")
    assert (
        refused.returncode == 2 and "write it before the number, for instance 3:1" in refused.stderr
    )
    refused = called("dampers", "2:1+b1")
    assert refused.returncode == 2 and "without +b1" in refused.stderr


def on_terminal(*words: str, stdout: bool, stderr: bool, **said: str) -> tuple[bytes, bytes]:
    """What a terminal shows of a process that has it as these streams, and what a pipe gets."""
    above, below = pty.openpty()
    kept = {k: v for k, v in os.environ.items() if k not in ("NO_COLOR", "DISTING_PROGRESS")}
    done = subprocess.Popen(
        [*COMMAND, *words],
        stdin=subprocess.DEVNULL,
        stdout=below if stdout else subprocess.PIPE,
        stderr=below if stderr else subprocess.PIPE,
        env=kept | {"TERM": "xterm", "DISTING_CACHE": "off", "COLUMNS": "100"} | said,
    )
    os.close(below)
    seen, end = b"", time.monotonic() + 300
    while time.monotonic() < end:
        if select.select([above], [], [], 0.1)[0]:
            try:
                part = os.read(above, 65536)
            except OSError:  # the last one has closed it
                break
            if not part:
                break
            seen += part
    out, error = done.communicate(timeout=300)
    os.close(above)
    assert done.returncode == 0
    return seen, (out or b"") + (error or b"")


@pytest.mark.full
@pytest.mark.skipif(sys.platform == "win32", reason="needs a terminal of Unix")
def test_relations_have_a_colour_on_a_terminal_alone() -> None:
    words = ("compare", "3:1", "3:4")
    shown, _ = on_terminal(*words, stdout=True, stderr=False)
    assert shown.startswith(b"\x1b[1;34mDISTINGUISHABLE\x1b[0m\r\n") and shown.count(b"\x1b") == 2
    for said in ({"NO_COLOR": "1"}, {"TERM": "dumb"}):
        shown, _ = on_terminal(*words, stdout=True, stderr=False, **said)
        assert shown.startswith(b"DISTINGUISHABLE\r\n") and b"\x1b" not in shown
    assert "\x1b" not in called(*words).stdout


@pytest.mark.full
@pytest.mark.skipif(sys.platform == "win32", reason="needs a terminal of Unix")
def test_a_terminal_is_shown_progress_where_output_is_piped() -> None:
    words = ("verdicts", "3", "--no-cache")
    shown, piped = on_terminal(*words, stdout=False, stderr=True, DISTING_PROGRESS="0.01")
    assert b"working" in shown or b"profiles" in shown
    assert piped.decode() == called(*words).stdout


@pytest.mark.full
@pytest.mark.parametrize(
    ("line", "offered"),
    [
        ("disting comp", {"compare"}),
        pytest.param("disting compare --do", {"--domain"}, marks=pytest.mark.slow),
        ("disting compare --domain ", {"complex", "real", "positive"}),
        ("disting verify 2:1 2:", {"2:1", "2:2", "2:3"}),
    ],
)
def test_a_shell_is_told_how_a_line_may_go_on(tmp_path: Path, line: str, offered: set[str]) -> None:
    pytest.importorskip("argcomplete", reason="argcomplete is not installed")
    path = tmp_path / "offered"
    asked = {"_ARGCOMPLETE": "1", "_ARGCOMPLETE_IFS": "\n", "COMP_LINE": line, "COMP_TYPE": "9"}
    asked |= {"COMP_POINT": str(len(line)), "_ARGCOMPLETE_STDOUT_FILENAME": str(path)}
    asked["_ARGCOMPLETE_COMP_WORDBREAKS"] = " \t\n"
    done = subprocess.run(
        [*COMMAND], env=os.environ | asked, capture_output=True, check=False, timeout=600
    )
    assert (done.returncode, done.stdout) == (0, b"")
    assert set(path.read_text(encoding="utf-8").split()) == offered
