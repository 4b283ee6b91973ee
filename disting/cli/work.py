"""What a command computes with: the user's store, workers, and progress on a terminal."""

import argparse
import sys
from collections.abc import Iterator
from concurrent.futures import Executor
from contextlib import ExitStack, contextmanager

from disting.engine import Engine, Progress, Store
from disting.scheduling import executor


@contextmanager
def engine_for(options: argparse.Namespace) -> Iterator[tuple[Engine, Executor | None, Progress]]:
    """Engine with the user's store, workers as asked, and a progress bar on a terminal's standard error."""
    with ExitStack() as stack:
        store = stack.enter_context(Store.open("" if getattr(options, "no_cache", False) else None))
        pool = stack.enter_context(executor(getattr(options, "jobs", 1), getattr(options, "scheduler", "")))
        yield Engine(store=store), pool, stack.enter_context(_progress())


@contextmanager
def _progress() -> Iterator[Progress]:
    if not sys.stderr.isatty():
        yield lambda what, done, total: None
        return
    from rich.console import Console
    from rich.progress import Progress as Bar

    with Bar(console=Console(stderr=True), transient=True) as bar:
        tasks: dict[str, object] = {}

        def advance(what: str, done: int, total: int) -> None:
            """A bar for each thing that is done."""
            task = tasks.setdefault(what, bar.add_task(what) if what not in tasks else None)
            bar.update(task, completed=done, total=total)  # type: ignore[arg-type]

        yield advance
