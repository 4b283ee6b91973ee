"""disting as its users start it: a process with its output and exit status."""

import csv
import io
import os
import signal
import subprocess
import sys

COMMAND = (sys.executable, "-m", "disting")


def disting(*arguments, cache="off", cwd=None):
    environment = os.environ | {"DISTING_CACHE": str(cache), "COLUMNS": "100"}
    command = [*COMMAND, *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, env=environment, timeout=120, check=False, cwd=cwd)


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
