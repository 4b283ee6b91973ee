"""Terminals that lack characters, parents that die, disks that are full."""

import os
import signal
import subprocess
import time

import pytest

from tests.cli.process import COMMAND, disting


@pytest.mark.parametrize(
    ("encoding", "command"),
    [
        ("ascii", ("compare", "4:2", "4:6")),
        ("cp1252", ("compare", "3:1", "3:4", "--damped", "--prove")),
        ("ascii", ("models", "3", "--damped", "--identifiability")),
        ("latin-1", ("equivalents", "3:1", "--to", "3:11", "--damped", "--formulas")),
    ],
)
def test_output_that_the_terminal_cannot_encode_is_no_error(encoding, command):
    environment = os.environ | {"PYTHONIOENCODING": encoding, "DISTING_CACHE": "off", "PYTHONUTF8": "0"}
    done = subprocess.run([*COMMAND, *command], capture_output=True, env=environment, timeout=120, check=False)
    assert done.returncode == 0, done.stderr
    assert b"Traceback" not in done.stderr and done.stdout
    assert done.stdout.decode(encoding).count("?") == disting(*command).stdout.count("?")  # every sign has a substitute


@pytest.mark.skipif(os.name != "posix", reason="processes are looked up by POSIX means")
@pytest.mark.parametrize("by", [signal.SIGTERM, signal.SIGHUP, signal.SIGKILL])
def test_workers_end_with_their_parent(tmp_path, by):
    command = [*COMMAND, "verdicts", "5", "--damped", "--jobs", "2"]
    environment = os.environ | {"DISTING_CACHE": "off", "MARK": str(tmp_path)}
    parent = subprocess.Popen(
        command,
        env=environment,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_DFL),  # under nohup it is inherited as ignored
    )
    while (
        len(workers := marked(tmp_path) - {parent.pid}) < 3 and parent.poll() is None
    ):  # two workers, and what counts semaphores
        time.sleep(0.05)
    assert len(workers) >= 3
    parent.send_signal(by)
    assert parent.wait(timeout=60) == -by
    patience = 600  # tenths of a second; idle, they end within one
    while marked(tmp_path) and patience:
        time.sleep(0.1)
        patience -= 1
    assert not marked(tmp_path)


def marked(folder):
    """Processes that inherited the mark in their environment."""
    found = set()
    for name in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open(f"/proc/{name}/environ", "rb") as file:
                if f"MARK={folder}\0".encode() in file.read():
                    found.add(int(name))
        except OSError:  # it ended, or is another user's
            continue
    return found


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="this system has no disk that is always full")
def test_a_file_that_cannot_be_written_stays_as_it_was(tmp_path):
    there, partial = tmp_path / "a.csv", tmp_path / "a.csv.partial"
    there.write_text("precious")
    partial.symlink_to("/dev/full")
    done = disting("verdicts", 3, "--csv", there)
    assert done.returncode == 2 and "a.csv cannot be written (No space left on device)" in done.stderr
    assert there.read_text() == "precious" and not os.path.lexists(partial)


@pytest.mark.skipif(os.name != "posix", reason="named pipes are of POSIX")
def test_pipes_and_links_stay_what_they_are(tmp_path):
    pipe, link, there = tmp_path / "pipe", tmp_path / "link.csv", tmp_path / "there.csv"
    os.mkfifo(pipe)
    link.symlink_to(there)
    reader = subprocess.Popen(["cat", str(pipe)], stdout=subprocess.PIPE, text=True)
    assert disting("verdicts", 2, "--csv", pipe).returncode == 0
    read, _ = reader.communicate(timeout=60)
    assert disting("verdicts", 2, "--csv", link).returncode == 0
    assert pipe.is_fifo() and link.is_symlink() and there.read_text() == read != ""
