"""Long work says so before it begins: how much, how long about, and how there would be less."""

import io
import os
import re
import signal
import subprocess
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path
from threading import Event

import pytest

from disting import Family
from disting.cli import main
from disting.cli.decision import LESS, LONGER
from disting.cli.workers import LONG, Work, announce, pairs_by_size, told_if_long
from disting.measurement import write_csv
from disting.simulation import demo
from tests.cli.process import COMMAND, called

SAID = re.compile(
    r"disting: (\d+) (pairs|models with dampers|models|candidates), which may take (.*); less to do: (.*); Ctrl-C stops it\n"
)
LARGE = [
    ("verdicts 8", 574 * 573 // 2),
    ("report 9 --undamped --out pages", 993 * 992 // 2),
    ("models 7 --also spring=1:3 --also lock=2", 2 * 314),
    ("dampers 8 --sets all", 574 * 2**8),
    ("fit demo.csv --masses 9", 2**11),
    ("fit demo.csv --masses 9 --family", 993 * 2**11),
]


class Pressing(io.StringIO):
    """Where words are written, by someone who presses Ctrl-C as soon as they say what it does."""

    def write(self, text: str) -> int:
        written = super().write(text)
        said = self.getvalue()
        if said.endswith("\n") and said.count("Ctrl-C") == 1 and "Ctrl-C" in said.splitlines()[-1]:
            raise KeyboardInterrupt
        return written


def stopped(command: str) -> tuple[int, str, str]:
    """Status, output and words of a command that is stopped when it says how."""
    with (
        pytest.MonkeyPatch.context() as patch,
        redirect_stdout(io.StringIO()) as out,
        redirect_stderr(Pressing()) as error,
    ):
        patch.setenv("DISTING_CACHE", "off")
        return main(command.split()), out.getvalue(), error.getvalue()


@pytest.mark.parametrize(("command", "count"), LARGE)
def test_long_work_is_told_before_it_begins_and_can_be_stopped(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, command: str, count: int
) -> None:
    write_csv(demo(0).response("acceleration"), tmp_path / "demo.csv")
    monkeypatch.chdir(tmp_path)
    status, out, words = stopped(command)
    first, rest = words.split("\n", 1)
    found = SAID.fullmatch(first + "\n")
    assert found is not None and int(found[1]) == count
    assert (status, out) == (130, "") and rest.startswith("disting: interrupted")


@pytest.mark.full
@pytest.mark.skipif(os.name != "posix", reason="a signal has another number there")
def test_long_work_of_a_process_can_be_stopped() -> None:
    process = subprocess.Popen(
        [*COMMAND, *LARGE[0][0].split()],
        stdin=subprocess.DEVNULL,  # nothing is asked
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env=os.environ | {"DISTING_CACHE": "off"},
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )
    assert process.stderr is not None
    first = SAID.fullmatch(process.stderr.readline())
    process.send_signal(signal.SIGINT)
    said, rest = process.communicate(timeout=60)
    assert first is not None and int(first[1]) == LARGE[0][1]
    assert (process.returncode, said) == (130, "") and rest.startswith("disting: interrupted")


class Awaited(io.StringIO):
    """Where another thread writes; capsys empties its file as it reads, and may lose what comes
    between.
    """

    def __init__(self) -> None:
        super().__init__()
        self.line = Event()

    def write(self, text: str) -> int:
        written = super().write(text)
        if text.endswith("\n"):
            self.line.set()
        return written


def test_a_pair_that_takes_long_is_told_while_it_goes_on() -> None:
    with redirect_stderr(Awaited()) as words, told_if_long("this takes long", 0.0):
        told = words.line.wait(60)
    assert told and words.getvalue() == "disting: this takes long\n"
    with redirect_stderr(Awaited()) as words, told_if_long("this takes long"):
        pass
    assert words.getvalue() == ""


@pytest.mark.slow
@pytest.mark.skipif(os.name != "posix", reason="a signal has another number there")
def test_a_pair_of_many_unknowns_says_so_and_can_be_stopped() -> None:
    pair = ["#=1, 1=2, 1=3; F2; S3", "#=1, 1=2, 2=3; F1; S3"]
    process = subprocess.Popen(
        [*COMMAND, "compare", *pair, "--no-cache"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )
    assert process.stderr is not None
    first = process.stderr.readline()
    process.send_signal(signal.SIGINT)
    said, _ = process.communicate(timeout=60)
    assert first == f"disting: {LONGER}{LESS}\n" and (process.returncode, said) == (130, "")


@pytest.mark.full
@pytest.mark.parametrize(
    "command",
    [
        "verdicts 3",
        "models 5",
        pytest.param("models 3 --also lock=2", marks=pytest.mark.slow),
        "report 1 --undamped --out {}",
    ],
)
def test_work_that_ends_soon_is_done_without_a_word(tmp_path: Path, command: str) -> None:
    assert called(*command.format(tmp_path).split()).stderr == ""


def test_more_workers_take_less_time(capsys: pytest.CaptureFixture[str]) -> None:
    seconds = 3 * LONG
    count = round(seconds / Work.PAIRS.value.of(5))
    announce(Work.PAIRS, {5: count}, 1)
    announce(Work.PAIRS, {5: count}, 4)
    assert capsys.readouterr().err.count("\n") == 1


def test_pairs_are_counted_as_they_are_decided() -> None:
    sizes = [1, 2, 4]
    chains = sum(len(Family(n)) for n in sizes)
    assert sum(pairs_by_size(sizes).values()) == chains * (chains - 1) // 2


@pytest.mark.parametrize("work", Work)
def test_more_masses_take_longer(work: Work) -> None:
    seconds = [work.value.of(n) for n in range(1, 12)]
    assert seconds == sorted(seconds) and seconds[-1] > seconds[0] > 0


@pytest.mark.full
@pytest.mark.parametrize(
    "command",
    [
        pytest.param("report trees-4-damped --out pages", marks=pytest.mark.slow),
        "verdicts trees-4-damped",
    ],
)
def test_a_family_that_is_not_shipped_says_how_long_it_takes(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, command: str
) -> None:
    monkeypatch.chdir(tmp_path)
    _, _, words = stopped(command)
    assert re.search(
        r"disting: 14365 pairs of trees-4-damped, which may take about .*, as a sample shows; less to"
        r" do: two networks alone \(disting compare\); Ctrl-C stops it, and what is done stays in the"
        r" cache",
        words,
    )


@pytest.mark.full
def test_a_shipped_family_is_told_without_a_word(tmp_path: Path) -> None:
    done = called("verdicts", "circuits-4", cache=tmp_path / "cache.sqlite3")
    assert done.returncode == 0 and "may take" not in done.stderr
