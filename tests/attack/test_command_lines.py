"""Thousands of command lines, half of them damaged: one sentence and status 2, or a result and
status 0; never a traceback.
"""

import contextlib
import faulthandler
import io
import resource
import signal
import unicodedata

import numpy as np
import pytest
import scipy.io

from disting.cli import main
from tests.attack import command_lines
from tests.attack.counts import chance, times
from tests.cli.process import disting

pytestmark = pytest.mark.attack
PATIENCE = 1  # seconds of processor time until Ctrl-C; most lines need a tenth
AGAIN = 10  # seconds until the next Ctrl-C: one that comes while Python tidies up is lost
HUNG = 300  # seconds in which Ctrl-C must have been heard
LONGEST = 2_000  # characters of an error: it quotes what was given, shortened
MOST = 4_000_000  # characters of a result; that of the largest table that was asked for is a tenth
MEMORY = 8 << 30
INTERRUPTED = 130


@pytest.fixture
def place(tmp_path, monkeypatch):
    """A deep working folder with some data, a cache of its own, and a bound on memory."""
    folder = tmp_path / "a" / "b" / "c" / "d"
    (folder / "sub").mkdir(parents=True)
    f = np.linspace(10, 100, 30)
    np.savetxt(
        folder / "good.csv",
        np.c_[f, 5 / f, 1 / f],
        delimiter=",",
        header="f [Hz],Re,Im",
        comments="",
    )
    (folder / "bad.csv").write_text("f,re,im\n1,2,x\n2,3\n")
    scipy.io.savemat(folder / "good.mat", {"f": f, "G": 5 / f + 1j / f})
    monkeypatch.chdir(folder)
    monkeypatch.setenv("DISTING_CACHE", str(tmp_path / "cache.sqlite3"))
    # an import that Ctrl-C ends is not tried again
    assert main(["fit", "--demo", "--masses", "1", "--json", "a.csv"]) == 0
    before = resource.getrlimit(resource.RLIMIT_AS)
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, before[1]))
    yield folder
    resource.setrlimit(resource.RLIMIT_AS, before)


def carried_out(words):
    """Status, output and error of one line in this process, interrupted after a second."""
    out, error = io.StringIO(), io.StringIO()
    # a background job would ignore SIGINT itself
    before = signal.signal(signal.SIGPROF, signal.default_int_handler)
    faulthandler.dump_traceback_later(HUNG, exit=True)
    signal.setitimer(signal.ITIMER_PROF, PATIENCE, AGAIN)
    try:
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(error):
            status = main(words)
    except SystemExit as end:  # argparse ends the process
        status = end.code or 0
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        faulthandler.cancel_dump_traceback_later()
        signal.signal(signal.SIGPROF, before)
    return status, out.getvalue(), error.getvalue()


def wrong_with(status, out, error):
    """What is wrong with an answer, or nothing."""
    if status not in (0, 1, 2, INTERRUPTED) or "Traceback" in error:
        return f"status {status}"
    if status == 2 and (not error.startswith("disting: ") or len(error) > LONGEST):
        return "the error is no short sentence"
    if len(out) > MOST:
        return "the output is too long"
    odd = {
        c for c in out + error if unicodedata.category(c) in ("Cc", "Cf", "Cs") and c not in "\n\t"
    }
    return f"unprintable characters {odd}" if odd else ""


def test_in_this_process(place, counts):
    draw, wrong = chance("command lines"), []
    for _ in range(times(10_000)):
        words = command_lines.line(draw)
        counts["tried"] += 1
        (place / "line").write_text(repr(words))  # what hangs ends this process: here it stands
        try:
            status, out, error = carried_out(words)
            reason = wrong_with(status, out, error)
        except BaseException as escaped:
            status, reason = "escaped", repr(escaped)[:300]
        counts[
            {0: "accepted rightly", 2: "refused rightly", INTERRUPTED: "interrupted"}.get(
                status, f"status {status}"
            )
        ] += 1
        if reason:
            counts["wrong"] += 1
            wrong.append((reason, [w[:80] for w in words]))
    assert not wrong, "\n".join(map(str, wrong))


def test_in_processes(place, counts):
    draw = chance("command lines of processes")
    for _ in range(times(25)):
        words = [w for w in command_lines.line(draw) if "\0" not in w and w.isascii()]
        done = disting(*words, cache=place / "cache.sqlite3", cwd=place)
        counts["tried"] += 1
        assert done.returncode in (0, 1, 2) and "Traceback" not in done.stderr, words
