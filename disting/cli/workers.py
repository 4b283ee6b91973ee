"""What a command computes with: the user's store, workers, and progress on standard error."""

import argparse
import os
import sys
from collections.abc import Callable, Iterator
from concurrent.futures import Executor
from contextlib import ExitStack, contextmanager
from threading import TIMEOUT_MAX, Event, Thread
from time import monotonic

from disting.cli.plain import complain
from disting.errors import InputError, shown
from disting.store import Store
from disting.verdict.engine import Engine, Progress

BARS_AFTER = 2.0  # seconds of silence on a terminal
SILENT = 30.0  # seconds at most, where standard error is no terminal
REDRAWN = 0.2  # seconds between two looks at what is done
VARIABLE = "DISTING_PROGRESS"  # of the environment: other seconds of silence, or off


def cores() -> int:
    """Processors that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


@contextmanager
def engine_for(options: argparse.Namespace) -> Iterator[tuple[Engine, Executor | None, Progress]]:
    """Engine with the user's store, workers as asked, and progress on standard error."""
    from disting.store.scheduling import executor  # and with it the processes of the library

    with ExitStack() as stack:
        store = stack.enter_context(Store.open("" if getattr(options, "no_cache", False) else None))
        pool = stack.enter_context(
            executor(getattr(options, "jobs", 1), getattr(options, "scheduler", ""))
        )
        yield Engine(store=store), pool, stack.enter_context(_progress())


@contextmanager
def _progress() -> Iterator[Progress]:
    """Bars on a terminal, elsewhere a line now and then."""
    chosen = os.environ.get(VARIABLE, "")
    if chosen == "off":
        yield lambda what, done, total: None
        return
    told = _bars if sys.stderr.isatty() else _lines
    pause = BARS_AFTER if told is _bars else SILENT
    yield from told(_seconds(chosen) if chosen else pause)


def _seconds(text: str) -> float:
    try:
        seconds = float(text)
    except ValueError:
        seconds = 0.0
    if not 0 < seconds <= TIMEOUT_MAX:
        raise InputError(
            f"{VARIABLE} is off, or the seconds between two lines such as 60, not {shown(text)}"
        )
    return seconds


def _bars(pause: float) -> Iterator[Progress]:
    """Work that ends soon shows nothing; drawn by a thread of its own, since one step may take
    long.
    """
    ended, latest = Event(), dict[str, tuple[int, int]]()

    def advance(what: str, done: int, total: int) -> None:
        """What the next look shows."""
        latest[what] = (done, total)

    def draw() -> None:
        """Until the work has ended; standard output is left alone."""
        if not ended.wait(pause):
            _drawn(ended, latest)

    yield from _beside(draw, ended, advance)


def _drawn(ended: Event, latest: dict[str, tuple[int, int]]) -> None:
    """A bar for each thing that is done, a moving one where nothing is counted yet."""
    from rich.console import Console
    from rich.progress import BarColumn, TextColumn, TimeElapsedColumn
    from rich.progress import Progress as Bar

    columns = (TextColumn("{task.description}"), BarColumn(), TimeElapsedColumn())
    console = Console(stderr=True)
    with Bar(
        *columns, console=console, transient=True, redirect_stdout=False, redirect_stderr=False
    ) as bar:
        tasks = {"": bar.add_task("working", total=None)}
        while not ended.wait(REDRAWN):
            for what, (done, total) in list(latest.items()):
                if what not in tasks:
                    tasks[what] = bar.add_task(what)
                bar.update(tasks[what], completed=done, total=total)
                bar.update(tasks[""], visible=False)


def _lines(pause: float) -> Iterator[Progress]:
    """For logs and pipes: what is done is told by a thread of its own, since one step may take
    long.
    """
    begun, ended, last = monotonic(), Event(), ["working"]

    def advance(what: str, done: int, total: int) -> None:
        """What the next line tells."""
        last[0] = f"{what}: {done} of {total}"

    def tell() -> None:
        """Until the work has ended."""
        while not ended.wait(pause):
            try:
                complain(f"{last[0]}, {monotonic() - begun:.0f} s")
            except (OSError, ValueError):  # nobody reads any more
                return

    yield from _beside(tell, ended, advance)


def _beside(told: Callable[[], None], ended: Event, advance: Progress) -> Iterator[Progress]:
    """The progress, told by a thread until the work has ended."""
    thread = Thread(target=told, daemon=True)
    thread.start()
    try:
        yield advance
    finally:
        ended.set()
        thread.join()
