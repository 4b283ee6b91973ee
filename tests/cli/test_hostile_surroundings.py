"""Terminals that lack characters, parents that die, disks that are full."""

import os
import signal
import subprocess
import sys
import time

import pytest

from tests.cli.process import COMMAND, called, heed_signals, marked


@pytest.mark.full
@pytest.mark.parametrize(
    ("encoding", "command"),
    [
        ("ascii", ("compare", "4:2", "4:6")),
        pytest.param(
            "cp1252", ("compare", "3:1", "3:4", "--damped", "--prove"), marks=pytest.mark.slow
        ),
        pytest.param(
            "ascii", ("models", "3", "--damped", "--identifiability"), marks=pytest.mark.slow
        ),
        ("latin-1", ("equivalents", "3:1", "--to", "3:11", "--damped", "--formulas")),
    ],
)
def test_output_that_the_terminal_cannot_encode_is_no_error(encoding, command):
    environment = os.environ | {
        "PYTHONIOENCODING": encoding,
        "DISTING_CACHE": "off",
        "PYTHONUTF8": "0",
    }
    done = subprocess.run(
        [*COMMAND, *command], capture_output=True, env=environment, timeout=600, check=False
    )
    assert done.returncode == 0, done.stderr
    assert b"Traceback" not in done.stderr and done.stdout
    # every sign has a substitute
    assert done.stdout.decode(encoding).count("?") == called(*command).stdout.count("?")


@pytest.mark.full
@pytest.mark.skipif(os.name != "posix", reason="processes are looked up by POSIX means")
@pytest.mark.parametrize(
    "by", [signal.SIGTERM, pytest.param(signal.SIGHUP, marks=pytest.mark.slow), signal.SIGKILL]
)
def test_workers_end_with_their_parent(tmp_path, by):
    command = [*COMMAND, "verdicts", "5", "--damped", "--jobs", "2"]
    environment = os.environ | {"DISTING_CACHE": "off", "MARK": str(tmp_path)}
    parent = subprocess.Popen(
        command,
        env=environment,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        preexec_fn=heed_signals,
    )
    while (
        len(workers := marked(tmp_path) - {parent.pid}) < 3 and parent.poll() is None
    ):  # two workers, and what counts semaphores
        time.sleep(0.05)
    assert len(workers) >= 3
    parent.send_signal(by)
    assert parent.wait(timeout=600) == -by
    patience = 600  # tenths of a second; idle, they end within one
    while marked(tmp_path) and patience:
        time.sleep(0.1)
        patience -= 1
    assert not marked(tmp_path)


@pytest.mark.full
@pytest.mark.skipif(os.name != "posix", reason="the limit is of POSIX")
@pytest.mark.parametrize(
    ("name", "command"),
    [
        ("a.csv", ("verdicts", 3, "--csv")),
        pytest.param(
            "chains-1-undamped.html",
            ("report", 1, "--undamped", "--out"),
            marks=pytest.mark.slow,
        ),
    ],
)
def test_a_file_that_cannot_be_written_stays_as_it_was(tmp_path, name, command):
    """No file may grow beyond a kilobyte, as on a full disk."""
    (tmp_path / name).write_text("precious")
    where = tmp_path if name.endswith("html") else tmp_path / name
    done = disting_with_small_files(*command, where)
    assert done.returncode == 2 and name in done.stderr and "File too large" in done.stderr
    assert (tmp_path / name).read_text() == "precious"
    assert [p.name for p in tmp_path.rglob("*") if p.is_file()] == [name]


def disting_with_small_files(*arguments):
    """The command while no file may grow beyond a kilobyte."""
    limit = "import resource, runpy; resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))"
    limited = f"{limit}; runpy.run_module('disting', run_name='__main__')"
    environment = os.environ | {"DISTING_CACHE": "off"}
    # -B: nor may a compiled module be written, which would stay cut off
    command = [sys.executable, "-B", "-c", limited, *map(str, arguments)]
    return subprocess.run(
        command, capture_output=True, text=True, env=environment, timeout=600, check=False
    )


@pytest.mark.full
@pytest.mark.skipif(os.name != "posix", reason="named pipes are of POSIX")
def test_pipes_and_links_stay_what_they_are(tmp_path):
    pipe, link, there = tmp_path / "pipe", tmp_path / "link.csv", tmp_path / "there.csv"
    os.mkfifo(pipe)
    link.symlink_to(there)
    reader = subprocess.Popen(["cat", str(pipe)], stdout=subprocess.PIPE, text=True)
    assert called("verdicts", 2, "--csv", pipe).returncode == 0
    read, _ = reader.communicate(timeout=600)
    assert called("verdicts", 2, "--csv", link).returncode == 0
    assert pipe.is_fifo() and link.is_symlink() and there.read_text() == read != ""
