"""Caches that are shared, damaged or left by a killed run; Ctrl-C; readers that go away."""

import contextlib
import os
import random
import shlex
import signal
import sqlite3
import subprocess
import sys
import time
from itertools import product

import pytest

from tests.cli.process import COMMAND, called, disting, rows


def by_hand(*cases):
    """More of the same, for which a process each is dear."""
    return [pytest.param(case, marks=pytest.mark.slow) for case in cases]


INTERRUPTED = "disting: interrupted; what was finished is kept in the cache"


@pytest.mark.full
def test_a_warm_cache_gives_the_same_verdicts_with_all_that_is_told_of_them(tmp_path):
    everything, cache = ("verdicts", 3, "--damped", "--json", "-"), tmp_path / "cache.sqlite3"
    cold, warm, alone = (
        called(*everything, cache=cache),
        disting(*everything, cache=cache),
        called(*everything),
    )
    assert cold.stdout == warm.stdout == alone.stdout
    assert entries(cache) > 9


@pytest.mark.full
def test_cache_is_filled_reported_and_cleared(tmp_path):
    cache = tmp_path / "cache.sqlite3"
    paper = ("verdicts", 3, "--undamped", "--conditions", "1-9", "--csv", "-")
    assert called(*paper, cache=cache).stdout == called(*paper, cache=cache).stdout != ""
    info = called("cache", "info", cache=cache).stdout
    assert "entries  9" in info  # nine canonical models; transfer functions settle all pairs
    assert called("verdicts", 2, "--no-cache", cache=cache).returncode == 0
    assert "entries  9" in called("cache", "info", cache=cache).stdout
    assert "9 entries removed" in called("cache", "clear", cache=cache).stdout


@pytest.mark.full
@pytest.mark.parametrize(
    "content",
    [
        random.Random(1).randbytes(3000),
        *by_hand(b"", b"\x00" * 5000, b"SQLite format 3\x00 but no more"),
    ],
)
def test_a_damaged_cache_is_set_aside_with_a_warning(tmp_path, content):
    cache = tmp_path / "cache.sqlite3"
    # so it is ours: its lock stands beside it
    assert called("verdicts", 2, cache=cache).returncode == 0
    cache.write_bytes(content)
    done = disting("verdicts", 3, "--csv", "-", cache=cache)
    assert done.returncode == 0
    assert len(rows(done.stdout)) == 55
    assert "Traceback" not in done.stderr
    assert done.stderr.startswith("disting: warning:")
    assert list(tmp_path.glob("cache.sqlite3.damaged-*"))


@pytest.mark.full
def test_many_processes_share_one_cache(tmp_path):
    cache = tmp_path / "cache.sqlite3"
    environment = os.environ | {"DISTING_CACHE": str(cache)}
    command = [*COMMAND, "verdicts", "3", "--damped", "--csv", "-"]
    running = [
        subprocess.Popen(
            command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=environment
        )
        for _ in range(2)
    ]
    outputs = [process.communicate(timeout=600) for process in running]
    assert [process.returncode for process in running] == [0] * 2
    assert {error for _, error in outputs} == {""}
    assert len({text for text, _ in outputs}) == 1


@pytest.mark.full
def test_a_run_killed_at_any_moment_resumes(tmp_path):
    """Kill the run again and again; what it had stored stays, grows, and the last run gives the
    true result.
    """
    cache = tmp_path / "cache.sqlite3"
    environment = os.environ | {"DISTING_CACHE": str(cache)}
    command = [*COMMAND, "verdicts", "4", "--damped", "--conditions", "1-9", "--csv", "-"]
    stored, delay = [], 0.5
    # a busy machine needs longer to store anything
    while len(stored) < 3 or (stored[-1] == 0 and delay < 60):
        process = subprocess.Popen(
            command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env=environment
        )
        time.sleep(delay)
        delay = delay + 0.4 if len(stored) < 3 else 2 * delay
        process.send_signal(signal.SIGKILL)
        process.wait(timeout=600)
        stored.append(entries(cache))
    assert stored == sorted(stored)
    assert stored[-1] > 0
    paper = ("verdicts", 4, "--damped", "--conditions", "1-9", "--csv", "-")
    assert disting(*paper, cache=cache).stdout == called(*paper).stdout
    assert entries(cache) == 39  # 22 canonical models, of which 17 need Markov parameters too


def entries(cache):
    if not cache.exists():
        return 0
    with sqlite3.connect(cache) as connection:
        count = connection.execute("SELECT count(*) FROM entry").fetchone()[0]
    connection.close()
    return count


def interrupted(cache, stored, *arguments):
    """Start a command, wait until it has stored so many entries, press Ctrl-C; what it said."""
    process = subprocess.Popen(
        [*COMMAND, *arguments],
        stderr=subprocess.PIPE,
        text=True,
        env=os.environ | {"DISTING_CACHE": str(cache)},
        start_new_session=True,  # a terminal tells the whole group
        # a shell's background jobs inherit SIG_IGN
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )
    end = time.monotonic() + 600
    while process.poll() is None and entries(cache) < stored and time.monotonic() < end:
        time.sleep(0.01)
    os.killpg(process.pid, signal.SIGINT)
    _, error = process.communicate(timeout=600)
    announced, last = error.strip().splitlines()
    assert announced.startswith("disting: 49141 pairs, which may take about ")
    return process.returncode, last


@pytest.mark.full
def test_interrupt_leaves_no_traceback(tmp_path):
    assert interrupted(tmp_path / "c.sqlite3", 1, "verdicts", "7", "--damped") == (130, INTERRUPTED)


PRESSED = """
import os, runpy, signal, sys

AT = sys.argv[1]

class Finder:
    def find_spec(name, path=None, target=None):
        if name == AT:
            press()

class Callback:
    def __del__(self):
        press()

def press():
    os.kill(os.getpid(), signal.SIGINT)

signal.signal(signal.SIGINT, signal.default_int_handler)
sys.meta_path.insert(0, Finder)
"""
BEGUN = (
    PRESSED
    + "sys.argv = ['disting', *sys.argv[2:]]; runpy.run_module('disting', run_name='__main__', alter_sys=True)"
)
CIRCUITS = ("compare", "R1-p(R2,C1)", "p(R1,R2-C1)")
IN_WORK = "networkx.algorithms"  # is imported by what looks at circuits, and by nothing before


def pressed(program, *arguments):
    """What a process that presses Ctrl-C itself ends with, and what it says."""
    done = subprocess.run(
        [sys.executable, "-c", program, *arguments],
        capture_output=True,
        text=True,
        check=False,
        timeout=600,
    )
    return done.returncode, done.stderr.strip()


@pytest.mark.skipif(not hasattr(os, "fork"), reason="a signal has another number there")
@pytest.mark.parametrize(
    "module",
    [
        "disting.cli",
        "disting.cli.run",
        "flint",
        *by_hand("argparse", "disting.cli.next", "numpy.linalg"),
    ],
)
def test_an_interrupt_while_modules_are_imported_ends_the_process_in_silence(module):
    """As a signal ends any program: a shell says status 130."""
    assert pressed(BEGUN, module, "next", "3:1", "3:4") == (-signal.SIGINT, "")


@pytest.mark.full
def test_an_interrupt_while_work_imports_is_told_as_any_other(tmp_path, monkeypatch):
    """A cache is spoken of where there is one."""
    told = {"off": "disting: interrupted", str(tmp_path / "c.sqlite3"): INTERRUPTED}
    for cache, said in told.items():
        monkeypatch.setenv("DISTING_CACHE", cache)
        assert pressed(BEGUN, IN_WORK, *CIRCUITS) == (130, said)


@pytest.mark.full
def test_an_interrupt_while_the_process_ends_is_silent():
    at_exit = PRESSED + "import atexit; atexit.register(press)\n"
    ending = at_exit + BEGUN.removeprefix(PRESSED)
    assert pressed(ending, "nothing", "--version") == (-signal.SIGINT, "")


@pytest.mark.full
def test_an_interrupt_in_a_callback_is_not_lost():
    """Python prints such an exception and goes on."""
    finder = PRESSED.replace("            press()", "            Callback()")
    program = finder + BEGUN.removeprefix(PRESSED)
    assert pressed(program, IN_WORK, *CIRCUITS) == (-signal.SIGINT, "")


@pytest.mark.full
def test_where_interrupts_are_ignored_they_stay_ignored():
    """As nohup and a shell's background jobs ask for."""
    ignoring = BEGUN.replace("default_int_handler", "SIG_IGN")
    assert pressed(ignoring, "argparse", "--version") == (0, "")


@pytest.mark.slow
@pytest.mark.parametrize("milliseconds", range(0, 601, 20))
def test_an_interrupt_at_any_moment_leaves_no_traceback(milliseconds):
    """From the moment on at which the command line is looked for, which the process tells: what is
    before takes a hundredth of a second, and is not this package's.
    """
    program = BEGUN.replace("os.kill(os.getpid(), signal.SIGINT)", "print(flush=True)")
    process = subprocess.Popen(
        [sys.executable, "-c", program, "disting.cli", "verdicts", "5", "--no-cache"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    assert process.stdout is not None
    process.stdout.readline()
    time.sleep(milliseconds / 1000)
    process.send_signal(signal.SIGINT)
    _, error = process.communicate(timeout=60)
    assert process.returncode in (130, -signal.SIGINT) and error.strip() in (
        "",
        "disting: interrupted",
    )


@pytest.mark.full
def test_interrupt_ends_the_workers_without_a_word(tmp_path):
    many = 12  # until all of them are at work
    assert interrupted(
        tmp_path / "c.sqlite3", many, "verdicts", "7", "--damped", "--jobs", "2"
    ) == (130, INTERRUPTED)


def shell(arguments, redirected):
    command = f"set -o pipefail; {' '.join(COMMAND)} {arguments} {redirected}"
    return subprocess.run(
        ["bash", "-c", command], capture_output=True, text=True, check=False, timeout=600
    )


@pytest.mark.full
@pytest.mark.parametrize(
    "arguments",
    ["verdicts 3 --csv -", *by_hand("models 3", "compare 3:1 3:2", "dampers 2 --csv -", "--help")],
)
def test_a_closed_pipe_is_no_error(arguments):
    done = shell(arguments, "| true")
    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.full
def test_a_reader_gets_the_lines_it_wants():
    done = shell("verdicts 3 --csv -", "| head -1")
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.startswith("left,right")


DEFAULT = {("doctor", "<&- >&- 2>&-"), ("verdicts 2 --csv -", ">&-")}  # the others by hand


@pytest.mark.full
@pytest.mark.parametrize(
    ("arguments", "closed"),
    [
        pytest.param(*case, marks=[] if case in DEFAULT else pytest.mark.slow)
        for case in product(
            ["doctor", "verdicts 2 --csv -", "verdicts 2", "models 2"],
            [">&-", "<&- >&- 2>&-", ">&- 2>&-"],
        )
    ],
)
def test_without_standard_output_nothing_is_printed(arguments, closed):
    done = shell(arguments, closed)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")


@pytest.mark.full
def test_without_standard_error_the_result_is_printed():
    command = "verdicts 2 --csv -"
    assert shell(command, "2>&-").stdout == called(*command.split()).stdout != ""


@pytest.mark.full
def test_no_file_gets_the_number_of_a_closed_stream(tmp_path):
    """A cache opened as number 2 would take what libraries say there."""
    cache = tmp_path / "c.sqlite3"
    program = (
        "import os; from disting.cli import main; from disting.store.store import Store;"
        f" main(['models', '1']);store = Store.open({str(cache)!r}); store.put_many({{'0' * 64:"
        " '1'});print(sorted(os.readlink(f'/proc/self/fd/{n}') for n in range(3)), file=open(3,"
        " 'w'))"
    )
    command = f"exec 3>&1; {sys.executable} -c {shlex.quote(program)} <&- >&- 2>&-"
    done = subprocess.run(
        ["bash", "-c", command], capture_output=True, text=True, check=True, timeout=600
    )
    assert done.stdout == "['/dev/null', '/dev/null', '/dev/null']\n"


BEGINNING = """
import multiprocessing, time
from concurrent.futures.process import BrokenProcessPool
from disting.store.scheduling import executor

def main():
    try:
        with executor(2) as pool:
            waiting = [pool.submit(time.sleep, 9) for _ in range(2)]
            print(*(worker.pid for worker in multiprocessing.active_children()), flush=True)
            waiting[0].result()
    except BrokenProcessPool:
        print("gone", flush=True)

if __name__ == "__main__":
    main()
"""


@pytest.mark.full
@pytest.mark.skipif(not hasattr(os, "killpg"), reason="a terminal of this system sends otherwise")
@pytest.mark.parametrize("pause", [*by_hand(0.1), 0.2, *by_hand(0.3)])
def test_workers_that_are_still_importing_end_by_ctrl_c_in_silence(tmp_path, pause):
    """The signal goes to them alone, so that nobody ends them before they could speak."""
    script = tmp_path / "begin.py"
    script.write_text(BEGINNING, encoding="utf-8")
    process = subprocess.Popen(
        [sys.executable, script], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    assert process.stdout is not None
    workers = list(map(int, process.stdout.readline().split()))
    time.sleep(pause)
    os.kill(workers[0], signal.SIGINT)
    with contextlib.suppress(ProcessLookupError):  # the pool may have ended it with the first
        os.kill(workers[1], signal.SIGINT)
    said, error = process.communicate(timeout=60)
    assert len(workers) == 2 and (said, error) == ("gone\n", "")
