"""What every command does with a file that never ends, is too large, or of which nothing comes."""

import os
import signal
import subprocess

import pytest

from tests.cli.process import COMMAND, called, heed_signals

READERS = {
    "verify": ("verify", "{}"),
    "next": ("next", "{}"),
    "plan": ("plan", "{}"),
    "models": ("verdicts", "{}"),
    "spectrum": ("simulate", "--spectrum", "{}"),
    "fit": ("fit", "{}"),
}


def command(reader, path):
    return [part.format(path) for part in READERS[reader]]


@pytest.mark.thin(1)
@pytest.mark.parametrize("reader", sorted(READERS.keys() - {"fit"}))
def test_a_device_without_an_end_is_read_to_the_bound(tmp_path, reader):
    (tmp_path / "a.json").symlink_to("/dev/zero")
    done = called(*command(reader, tmp_path / "a.json"))
    assert done.returncode == 2, done.stderr
    assert "MB, too large; name a" in done.stderr and done.stderr.count("\n") == 1


@pytest.mark.parametrize("reader", READERS)
def test_a_file_of_gigabytes_is_refused(tmp_path, reader):
    path = tmp_path / ("a.csv" if reader == "fit" else "a.json")
    with path.open("wb") as file:
        file.truncate(3 * 2**30)
    done = called(*command(reader, path))
    assert done.returncode == 2 and "MB, too large; name a" in done.stderr, done.stderr


@pytest.mark.parametrize("reader", ["next", "plan"])
def test_brackets_by_the_thousand_are_no_json(tmp_path, reader):
    (tmp_path / "deep.json").write_text("[" * 100_000)
    done = called(*command(reader, tmp_path / "deep.json"))
    assert done.returncode == 2
    assert "deep.json holds no JSON; name a file of 'disting fit --json'" in done.stderr


@pytest.mark.full
@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="this system has no pipes with names")
@pytest.mark.parametrize("reader", ["verify", "fit"])
def test_a_pipe_without_a_writer_is_spoken_of_and_can_be_stopped(tmp_path, reader):
    os.mkfifo(tmp_path / "pipe")
    running = subprocess.Popen(
        [*COMMAND, *command(reader, tmp_path / "pipe")],
        stderr=subprocess.PIPE,
        text=True,
        env=os.environ | {"DISTING_CACHE": "off"},
        preexec_fn=heed_signals,
    )
    said = running.stderr.readline()
    assert "pipe is open, but nothing is written to it yet; still waiting, Ctrl-C" in said
    assert running.poll() is None
    running.send_signal(signal.SIGINT)
    rest = running.communicate(timeout=60)[1]
    assert running.returncode == 130 and "Traceback" not in rest
