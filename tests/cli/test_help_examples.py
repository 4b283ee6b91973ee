"""The examples at the end of a command's help work as they are."""

import shlex
from pathlib import Path
from shutil import copy

import pytest

from disting.cli import main
from disting.cli.commands import SECTIONS, Command

EXAMPLES = [
    line
    for section in SECTIONS.values()
    for command in section
    if isinstance(command, Command)
    for line in command.examples
    if command.name != "app"  # serves until it is stopped: tests/app
]
BENCH = next(line for line in EXAMPLES if "bench.csv" in line and "simulate" in line)
LONG = ("disting look --demo", "disting report", "disting dampers", "disting verify")
CHEAP = [line for line in EXAMPLES if "FIT.json" not in line and not line.startswith(LONG)]


def status_of(line: str) -> int:
    return main(shlex.split(line)[1:])


def test_every_command_for_users_has_one() -> None:
    commands = [*SECTIONS["measure and fit"], *SECTIONS["models"]]
    assert [c.name for c in commands if not (isinstance(c, Command) and c.examples)] == ["fit"]


@pytest.mark.full
@pytest.mark.parametrize("line", CHEAP)
def test_an_example_works(
    line: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert status_of(BENCH) == 0
    assert status_of(line) == 0, capsys.readouterr()


@pytest.fixture(scope="module")
def fit_file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A file of a fit."""
    path = tmp_path_factory.mktemp("fitted") / "FIT.json"
    assert status_of(f"disting fit --demo --masses 1-2 --json {path}") == 0
    return path


@pytest.mark.full
@pytest.mark.parametrize(
    "line",
    [
        pytest.param(line, marks=[pytest.mark.slow] * line.startswith("disting look --demo"))
        for line in EXAMPLES
        if line not in CHEAP
    ],
)
def test_a_longer_example_works(
    line: str, fit_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    copy(fit_file, tmp_path)
    monkeypatch.chdir(tmp_path)
    assert status_of(line) in (0, 1)


@pytest.mark.parametrize("name", ["compare", "models", "equivalents"])
def test_help_ends_with_examples_and_tables(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        main([name, "--help"])
    told = capsys.readouterr().out
    assert f"\nexamples:\n  disting {name} " in told
    assert max(map(len, told.splitlines())) <= 100
