"""What a command computes with: the user's store, workers, and progress on standard error."""

import argparse
import os
import sys
from collections.abc import Iterator
from concurrent.futures import Executor
from contextlib import ExitStack, contextmanager
from threading import TIMEOUT_MAX, Event, Thread
from time import monotonic

from disting.cli.plain import complain
from disting.errors import InputError, shown
from disting.store import Store
from disting.store.scheduling import executor
from disting.verdict import Engine, Progress

SILENT = 4.5  # seconds at most, where standard error is no terminal
VARIABLE = "DISTING_PROGRESS"  # of the environment: other seconds, or off


def cores() -> int:
    """Processors that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


@contextmanager
def engine_for(options: argparse.Namespace) -> Iterator[tuple[Engine, Executor | None, Progress]]:
    """Engine with the user's store, workers as asked, and a progress bar on a terminal's
    standard error.
    """
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
    elif not chosen and sys.stderr.isatty():
        yield from _bars()
    else:
        yield from _lines(_seconds(chosen) if chosen else SILENT)


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


def _bars() -> Iterator[Progress]:
    from rich.console import Console
    from rich.progress import Progress as Bar

    with Bar(console=Console(stderr=True), transient=True) as bar:
        tasks: dict[str, object] = {}

        def advance(what: str, done: int, total: int) -> None:
            """A bar for each thing that is done."""
            task = tasks.setdefault(what, bar.add_task(what) if what not in tasks else None)
            bar.update(task, completed=done, total=total)  # type: ignore[arg-type]

        yield advance


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

    thread = Thread(target=tell, daemon=True)
    thread.start()
    try:
        yield advance
    finally:
        ended.set()
        thread.join()
