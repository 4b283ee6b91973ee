"""disting as its users start it, with its output and exit status."""

import csv
import io
import os
import signal
import subprocess
import sys
from contextlib import redirect_stderr, redirect_stdout

import pytest

from disting.cli import main

COMMAND = (sys.executable, "-m", "disting")


def disting(*arguments, cache="off", cwd=None):
    """A process of its own."""
    environment = os.environ | {"DISTING_CACHE": str(cache), "COLUMNS": "100"}
    command = [*COMMAND, *map(str, arguments)]
    return subprocess.run(
        command, capture_output=True, text=True, env=environment, timeout=600, check=False, cwd=cwd
    )


def called(*arguments: object, cache: object = "off") -> subprocess.CompletedProcess[str]:
    """The same without a process of its own, which takes a second to start: for tests of what a
    command says.
    """
    with (
        pytest.MonkeyPatch.context() as patch,
        redirect_stdout(io.StringIO()) as out,
        redirect_stderr(io.StringIO()) as error,
    ):
        patch.setenv("DISTING_CACHE", str(cache))
        patch.setenv("COLUMNS", "100")
        try:
            status = main([*map(str, arguments)])
        except SystemExit as end:  # argparse ends the process
            status = end.code or 0
    return subprocess.CompletedProcess(arguments, status, out.getvalue(), error.getvalue())


def heed_signals():
    """Background jobs and nohup leave signals ignored, which children inherit."""
    for number in (signal.SIGINT, signal.SIGHUP):
        signal.signal(number, signal.SIG_DFL)


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


def rows(text):
    return list(csv.DictReader(io.StringIO(text)))
