"""Commands killed at every moment of their run, on one cache: no result differs, no file is
half written, no worker stays.
"""

import contextlib
import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from tests.attack.counts import chance, times
from tests.cli.process import COMMAND, disting, heed_signals, marked

pytestmark = [
    pytest.mark.attack,
    pytest.mark.skipif(os.name != "posix", reason="signals are of POSIX"),
]
ROUND = 10  # kills on one cache, then a run to the end; then a new cache
ORPHANED = 5.0  # seconds after which no worker may be alive
HUNG = 300  # seconds
FOLDER = "{folder}"
VERDICTS = ("verdicts", "3", "--damped", "--json", f"{FOLDER}/v.json", "--csv", f"{FOLDER}/v.csv")
FIT = ("fit", "{data}", "--masses", "1", "--json", f"{FOLDER}/f.json")
KILLS = [
    (VERDICTS, 130, 0.0),
    ((*VERDICTS, "--jobs", "2"), 30, 0.0),
    (("catalog", "build", "2", "--out", FOLDER), 50, 0.0),
    (("catalog", "dampers", "2", "--out", FOLDER), 30, 0.0),
    (("report", "1", "2", "--out", FOLDER), 40, 0.0),
    (FIT, 40, 0.0),
    ((*FIT, "--out", f"{FOLDER}/out"), 10, 0.6),  # late, while its page is written
]
GROUP = [signal.SIGINT, signal.SIGTERM, signal.SIGHUP]


@pytest.fixture(scope="module")
def data(tmp_path_factory):
    path = tmp_path_factory.mktemp("data") / "drive.csv"
    assert (
        disting(
            "simulate", "--samples", 500, "--sampling-rate", 500, "--high", 100, "--csv", path
        ).returncode
        == 0
    )
    return path


def started(command, cache, folder, **options):
    """The command as a leader of its own group, with a mark that its workers inherit."""
    environment = os.environ | {"DISTING_CACHE": str(cache), "MARK": str(folder)}
    options = {
        "stdout": subprocess.DEVNULL,
        "stderr": subprocess.PIPE,
        "start_new_session": True,
        "preexec_fn": heed_signals,
    } | options
    return subprocess.Popen([*COMMAND, *command], env=environment, **options)


def written(folder):
    """The files that a command made, but those that a kill left unfinished and named so."""
    files = {
        p.relative_to(folder): p.read_bytes() for p in sorted(folder.rglob("*")) if p.is_file()
    }
    return {str(name): content for name, content in files.items() if name.suffix != ".partial"}


def is_whole(name, content, reference):
    """Whether a file is as in the end; that of provenance grows with the files it tells of."""
    if name != "provenance.json":
        return content == reference.get(name)
    told, end = (json.loads(text)["files"].items() for text in (content, reference[name]))
    return told <= end


def orphans(folder):
    """How many processes of a run are alive some seconds after its end."""
    end = time.monotonic() + ORPHANED
    while (alive := marked(folder)) and time.monotonic() < end:
        time.sleep(0.05)
    return len(alive)


def run(command, data, cache, folder):
    """A run to the end: what it wrote, and the seconds it took."""
    folder.mkdir(exist_ok=True)
    before = time.monotonic()
    process = started([w.format(folder=folder, data=data) for w in command], cache, folder)
    _, error = process.communicate(timeout=HUNG)
    assert process.returncode == 0 and b"Traceback" not in error, error
    return written(folder), time.monotonic() - before


def stopped(command, data, cache, folder, delay, by):
    """A run that gets a signal after some seconds: its status and what it said; None where it
    had ended before.
    """
    process = started([w.format(folder=folder, data=data) for w in command], cache, folder)
    with contextlib.suppress(subprocess.TimeoutExpired):
        process.wait(delay)
        process.communicate()
        return None
    if by == signal.SIGKILL:
        process.send_signal(by)
    else:
        os.killpg(process.pid, by)
    _, error = process.communicate(timeout=600)
    return process.returncode, error.decode()


@pytest.mark.parametrize(
    ("command", "number", "start"), KILLS, ids=[f"{' '.join(c[:2])}-{n}" for c, n, _ in KILLS]
)
def test_killed(tmp_path, data, counts, command, number, start):
    reference, seconds = run(command, data, "off", tmp_path / "reference")
    counts["kills"] = counts["orphans"] = counts["half-written"] = counts["lost"] = 0
    for first in range(0, times(number), ROUND):
        folder, cache = tmp_path / f"at{first}", tmp_path / f"{first}.sqlite3"
        folder.mkdir()
        for i in range(first, min(first + ROUND, times(number))):
            moment = start + (1 - start) * ((i % ROUND + 0.5) / ROUND)
            killed = stopped(command, data, cache, folder, moment * seconds, signal.SIGKILL)
            counts["kills" if killed else "ended before"] += 1
            counts["half-written"] += sum(
                not is_whole(name, content, reference) for name, content in written(folder).items()
            )
        counts["orphans"] += orphans(folder)
        counts["lost"] += run(command, data, cache, folder)[0] != reference
    assert counts["kills"] and not counts["orphans"] + counts["half-written"] + counts["lost"]


@pytest.mark.parametrize("by", GROUP)
def test_signals_to_the_group(tmp_path, data, counts, by):
    """As a terminal sends them: to the command and its workers at once, when the modules are
    loaded. Before, Python itself tells of Ctrl-C, at length.
    """
    draw = chance(by.name)
    loaded = run(["--version"], data, "off", tmp_path / "version")[1]
    for command in ((*VERDICTS, "--jobs", "2"), FIT):
        reference, seconds = run(command, data, "off", tmp_path / f"reference-{command[0]}")
        folder, cache = tmp_path / command[0], tmp_path / f"{command[0]}.sqlite3"
        folder.mkdir()
        for _ in range(times(5)):
            ended = stopped(
                command, data, cache, folder, loaded + draw.random() * (seconds - loaded), by
            )
            counts[f"{by.name}s" if ended else "ended before"] += 1
            counts["tracebacks"] += bool(ended) and "Traceback" in ended[1]
            counts["orphans"] += orphans(folder)
        counts["lost"] += run(command, data, cache, folder)[0] != reference
    assert not counts["orphans"] + counts["lost"] + counts["tracebacks"]


def test_writers_of_one_file_and_one_cache(tmp_path, data, counts):
    """Processes that write the same files at once, on one cache: whole files, all of them."""
    reference, _ = run(VERDICTS, data, "off", tmp_path / "reference")
    for turn in range(times(5)):
        folder, cache = tmp_path / str(turn), tmp_path / f"{turn}.sqlite3"
        folder.mkdir()
        words = [w.format(folder=folder) for w in VERDICTS]
        writers = [started(words, cache, folder) for _ in range(4)]
        ends = [(w.communicate(timeout=HUNG)[1], w.returncode) for w in writers]
        counts["writers"] += len(writers)
        counts["wrong"] += sum(end != (b"", 0) for end in ends) + (written(folder) != reference)
        assert not list(Path(folder).glob("*.partial"))
    assert not counts["wrong"], sys.stderr.write(str(ends))
