"""What long work tells where nobody sees a bar: logs and pipes."""

import os
import re
import subprocess

import pytest

from tests.cli.process import COMMAND, called

WORK = ("verdicts", "3", "--damped", "--no-cache")


def told(*arguments: str, progress: str | None) -> subprocess.CompletedProcess[str]:
    environment = {name: value for name, value in os.environ.items() if name != "DISTING_PROGRESS"}
    environment |= {} if progress is None else {"DISTING_PROGRESS": progress}
    return subprocess.run(
        [*COMMAND, *arguments],
        capture_output=True,
        text=True,
        env=environment,
        timeout=600,
        check=False,
    )


@pytest.mark.full
def test_a_pipe_is_told_what_is_done_and_the_result_stays_as_it_is() -> None:
    done, silent = told(*WORK, progress="0.02"), called(*WORK)  # which is told of no progress
    lines = done.stderr.splitlines()
    assert any(re.fullmatch(r"disting: [a-z ]+: \d+ of \d+, \d+ s", line) for line in lines)
    assert all(line.startswith("disting: ") for line in lines)
    assert (
        done.stdout == silent.stdout
        and silent.stderr == ""
        and done.returncode == silent.returncode == 0
    )


@pytest.mark.parametrize("value", ["never", "0", "-1", "nan", "inf"])
def test_what_is_no_pause_is_refused(value: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("DISTING_PROGRESS", value)
    done = called("verdicts", "1")
    assert done.returncode == 2 and "such as 60" in done.stderr
