"""A system without what only POSIX has, such as Windows: everything is imported and every
command runs there.
"""

import os
import re
import subprocess
import sys

import pytest

from tests.cli.process import disting

pytestmark = pytest.mark.full

LACKING = """
import importlib.util, os, signal, sys
import filelock, multiprocessing.popen_spawn_posix, platformdirs, subprocess  # they have a way of their own for each system

MODULES = {"resource", "fcntl", "pwd", "grp", "termios", "tty", "pty", "syslog", "posix_ipc"}


class Finder:
    def find_spec(self, name, path=None, target=None):
        if name in MODULES:
            raise ModuleNotFoundError(f"No module named {name!r}", name=name)


for name in MODULES:
    sys.modules.pop(name, None)
sys.meta_path.insert(0, Finder())
for name in ("fork", "killpg", "getuid", "geteuid", "getgid", "setsid", "getpgid", "mkfifo", "nice", "register_at_fork",
             "sched_getaffinity", "statvfs", "getloadavg", "wait4", "chown"):
    delattr(os, name) if hasattr(os, name) else None
for name in ("SIGHUP", "SIGKILL", "SIGALRM", "SIGVTALRM", "SIGPIPE", "SIGUSR1", "setitimer", "alarm", "pthread_sigmask"):
    delattr(signal, name) if hasattr(signal, name) else None
"""
COMMANDS = [
    ["models", "2", "--damped", "--identifiability"],
    ["compare", "3:1", "3:4", "--damped", "--prove"],
    ["verdicts", "2", "--csv", "pairs ü.csv", "--json", "pairs ü.json", "--jobs", "2"],
    ["dampers", "2:1", "--damped"],
    ["equivalents", "2:1", "--to", "2", "--undamped", "--set", "m1=1,m2=2,k12=3"],
    ["simulate", "--csv", "bench ß.csv"],
    ["look", "bench ß.csv"],
    ["fit", "bench ß.csv", "--masses", "1", "--json", "fit ñ.json"],
    ["verify", "3:1", "3:4"],
    ["next", "3:1", "3:11", "--damped", "--csv", "next ł.csv"],
    [
        "plan",
        "2:1+b1",
        "2:1+b2",
        "--undamped",
        "--set",
        "m1=1,m2=1,k12=9,b1=1",
        "--noise",
        "0.1",
        "--band",
        "0.1..2",
        "--lines",
        "20",
    ],
    ["draw", "R0-p(R1,C1)", "--svg", "circuit ø.svg"],
    ["report", "1", "--out", "pages å"],
    ["catalog", "build", "1", "--out", "catalogues ø"],
    ["catalog", "verify", "1", "--catalog", "catalogues ø"],
    ["schema", "models"],
    ["doctor"],
    ["cache", "info"],
    ["cache", "clear"],
]
# that need a process, a pool, a lock, a cache or a name of their own: what systems do differently
SHORT = ("models", "verdicts", "simulate", "draw", "catalog", "schema", "doctor", "cache")
SCRIPT = """
from disting.cli import main
from disting.algebra.groebner.own_process import run_limited

if __name__ == "__main__":
    for command in {!r}:
        unexplained = command[:2] == ["fit", "bench ß.csv"]  # by one mass
        assert main(command) == int(unexplained), command
    assert run_limited(divmod, (7, 2), 600).value == (3, 1)
"""


@pytest.mark.sampled(4)
@pytest.mark.parametrize("chosen", [SHORT, pytest.param((), marks=pytest.mark.slow)], ids=len)
def test_every_command_runs_where_posix_is_not_and_names_are_not_ascii(tmp_path, chosen):
    run = [command for command in COMMANDS if not chosen or command[0] in chosen]
    listed = re.findall(r"^  (\w+) {2,}", disting("--help").stdout, re.MULTILINE)
    assert set(listed) == {command[0] for command in COMMANDS} | {"app"}  # which serves on
    blocker, folder = tmp_path / "blocker", tmp_path / "a folder é"
    blocker.mkdir()
    folder.mkdir()
    (blocker / "sitecustomize.py").write_text(LACKING, encoding="utf-8")
    (folder / "script.py").write_text(SCRIPT.format(run), encoding="utf-8")
    environment = os.environ | {
        "DISTING_CACHE": str(folder / "cache å.sqlite3"),
        "PYTHONPATH": os.pathsep.join([str(blocker), os.getcwd(), *filter(None, sys.path)]),
    }
    done = subprocess.run(
        [sys.executable, "script.py"],
        cwd=folder,
        env=environment,
        capture_output=True,
        text=True,
        timeout=600,
    )
    assert done.returncode == 0 and "Traceback" not in done.stderr, done.stderr[-1000:]
    written = {"pairs ü.csv", "pairs ü.json", "bench ß.csv", "catalogues ø", "cache å.sqlite3"}
    written |= set() if chosen else {"fit ñ.json", "pages å"}
    assert written <= {path.name for path in folder.iterdir()}
