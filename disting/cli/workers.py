"""Workers of a command, and the amount of work that it starts.

A rate is measured: seconds of one core for one thing of so many masses, on the machine of the
guide's page on speed. Sizes beyond the last that was measured take as many times more as that took
more than the one before it. So it is an order of size, and is reported as one.
"""

import argparse
import os
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import Executor
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from enum import Enum
from random import Random
from threading import TIMEOUT_MAX, Event, Thread
from time import monotonic, process_time

from disting.cli.output import complain
from disting.conditions.side import AnySide
from disting.errors import InputError, short
from disting.model.family import Family
from disting.store import Store
from disting.verdict.engine import Engine, Progress
from disting.verdict.result import Query

LONG = 60.0  # seconds that nobody needs to be told of
PATIENCE = 5.0  # seconds that one pair may take without a word
LOOK = 0.1  # seconds between two looks at the time
UNITS = (("day", 86400.0), ("hour", 3600.0), ("minute", 60.0))
BARS_AFTER = 2.0  # seconds of silence on a terminal
SILENT = 30.0  # seconds at most, where standard error is no terminal
REDRAWN = 0.2  # seconds between two looks at what is done
VARIABLE = "DISTING_PROGRESS"  # of the environment: other seconds of silence, or off


@dataclass(frozen=True, slots=True)
class Rate:
    """Seconds for one of these `things`, by number of masses from `first` on; `smaller`: what makes
    the work smaller.
    """

    things: str
    first: int
    seconds: tuple[float, ...]
    smaller: str

    def of(self, masses: int) -> float:
        """Seconds for one thing of this size.

        >>> Rate("pairs", 3, (1.0, 10.0), "").of(2), Rate("pairs", 3, (1.0, 10.0), "").of(6)
        (1.0, 1000.0)
        """
        place, last = max(0, masses - self.first), len(self.seconds) - 1
        beyond = max(0, place - last)
        growth = self.seconds[last] / self.seconds[last - 1]
        return self.seconds[min(place, last)] * growth**beyond


class Work(Enum):
    """Kinds of long computations, each with its rate."""

    PAIRS = Rate(
        "pairs", 4, (0.0023, 0.0036, 0.0069), "fewer masses, or two models alone (disting compare)"
    )
    UNDAMPED_PAIRS = Rate("pairs", 4, (0.0027, 0.003), PAIRS.smaller)
    IDENTIFIABILITY = Rate("models", 6, (0.085, 0.09), "leave --identifiability away")
    UNDER_EXPERIMENTS = Rate("models", 3, (0.03, 0.32), "fewer masses, or fewer --also")
    DAMPERS = Rate("models with dampers", 3, (0.009, 0.027), "one model alone, or --sets single")
    FITS = Rate("candidates", 1, (0.1, 0.15, 0.3), "fewer masses, such as --masses 1-3")


SAMPLE = 3.0  # seconds of one core for a sample of the work
SMALL = 200  # pairs or models of which nobody needs an estimate


def announce_pairs(
    name: str, sides: Sequence[AnySide], query: Query, engine: Engine, jobs: int
) -> None:
    """Announce all pairs of a family of networks or of a file, where a sample shows that they take
    long. Chance picks the sample: another one each time, since what was decided once is quick.
    """
    count, chance = len(sides) * (len(sides) - 1) // 2, Random()

    def decide_one() -> None:
        """One pair."""
        engine.decisions(chance.sample(sides, 2), query)

    text = f"pairs of {name}", "two networks alone (disting compare)"
    announce_by_sample(count, *text, decide_one, jobs)


def announce_by_sample(
    count: int, things: str, smaller: str, try_one: Callable[[], object], jobs: int
) -> None:
    """Announce this number of tasks, where trying a few of them shows that all take long."""
    if count <= SMALL:
        return
    begun, tried = process_time(), 0
    while process_time() - begun < SAMPLE and tried < SMALL:
        try_one()
        tried += 1
    seconds = (process_time() - begun) / tried * count / max(jobs, 1)
    if seconds > LONG:
        complain(
            f"{count} {things}, which may take {in_words(seconds)}, as a sample shows; less to do:"
            f" {smaller}; Ctrl-C stops it, and what is done stays in the cache"
        )


def announce(work: Work, counts: Mapping[int, int], jobs: int = 1) -> None:
    """Announce this number of tasks by number of masses, where they take long; the user is not
    prompted.
    """
    seconds = sum(count * work.value.of(n) for n, count in counts.items()) / max(jobs, 1)
    if seconds > LONG:
        complain(
            f"{sum(counts.values())} {work.value.things}, which may take {in_words(seconds)};"
            f" less to do: {work.value.smaller}; Ctrl-C stops it"
        )


@contextmanager
def told_if_long(message: str, seconds: float = PATIENCE) -> Iterator[None]:
    """Tell of work that is not done after so many seconds of one core, while it goes on."""
    done = Event()
    Thread(target=_watch, args=(done, message, process_time() + seconds), daemon=True).start()
    try:
        yield
    finally:
        done.set()


def _watch(done: Event, message: str, until: float) -> None:
    while not done.wait(max(until - process_time(), LOOK)):
        if process_time() >= until:
            complain(message)
            return


def pairs_work(damped: bool) -> Work:
    """Verdicts on pairs of chains."""
    return Work.PAIRS if damped else Work.UNDAMPED_PAIRS


def pairs_by_size(sizes: Iterable[int], *, across: bool = True) -> dict[int, int]:
    """Pairs of the chains of these sizes, by the larger number of masses; `across`: of different
    sizes too.

    >>> pairs_by_size([2, 3]), pairs_by_size([2, 3], across=False)
    ({2: 3, 3: 88}, {2: 3, 3: 55})
    """
    pairs, smaller = {}, 0
    for n in sorted(set(sizes)):
        count = len(Family(n))
        pairs[n] = count * (count - 1) // 2 + count * smaller
        smaller += count if across else 0
    return pairs


def in_words(seconds: float) -> str:
    """An order of size.

    >>> in_words(100), in_words(5000), in_words(1e6), in_words(1e9)
    ('about 2 minutes', 'about an hour', 'about 12 days', 'more than a year')
    """
    if seconds > 365 * UNITS[0][1]:
        return "more than a year"
    name, size = next((unit for unit in UNITS if seconds >= unit[1]), UNITS[-1])
    count = round(seconds / size)
    article = "an" if name == "hour" else "a"
    return f"about {article} {name}" if count <= 1 else f"about {count} {name}s"


def cores() -> int:
    """Processors that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


@contextmanager
def engine_for(options: argparse.Namespace) -> Iterator[tuple[Engine, Executor | None, Progress]]:
    """Engine with the user's store, workers as requested, and progress on standard error."""
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
    announce = _bars if sys.stderr.isatty() else _lines
    pause = BARS_AFTER if announce is _bars else SILENT
    yield from announce(_seconds(chosen) if chosen else pause)


def _seconds(text: str) -> float:
    try:
        seconds = float(text)
    except ValueError:
        seconds = 0.0
    if not 0 < seconds <= TIMEOUT_MAX:
        raise InputError(
            f"{VARIABLE} is off, or the seconds between two lines such as 60, not {short(text)}"
        )
    return seconds


def _bars(pause: float) -> Iterator[Progress]:
    """Work that ends soon shows nothing; drawn by a thread of its own, since one step may take
    long.
    """
    ended, latest = Event(), dict[str, tuple[int, int]]()

    def advance(what: str, done: int, total: int) -> None:
        """Set the values that the next refresh shows."""
        latest[what] = (done, total)

    def draw() -> None:
        """Until the work has ended; standard output is left alone."""
        if not ended.wait(pause):
            _draw_bars(ended, latest)

    yield from _beside(draw, ended, advance)


def _draw_bars(ended: Event, latest: dict[str, tuple[int, int]]) -> None:
    """A bar for each thing that is done, a moving one where nothing is counted yet."""
    from rich.console import Console
    from rich.progress import BarColumn, Progress as Bar, TextColumn, TimeElapsedColumn

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
    """For logs and pipes: progress is reported by a thread of its own, since one step may take
    long.
    """
    begun, ended, last = monotonic(), Event(), ["working"]

    def advance(what: str, done: int, total: int) -> None:
        """Set the values that the next line reports."""
        last[0] = f"{what}: {done} of {total}"

    def tell() -> None:
        """Until the work has ended."""
        while not ended.wait(pause):
            try:
                complain(f"{last[0]}, {monotonic() - begun:.0f} s")
            except (OSError, ValueError):  # nobody reads any more
                return

    yield from _beside(tell, ended, advance)


def _beside(announce: Callable[[], None], ended: Event, advance: Progress) -> Iterator[Progress]:
    """The progress, reported by a thread until the work has ended."""
    thread = Thread(target=announce, daemon=True)
    thread.start()
    try:
        yield advance
    finally:
        ended.set()
        thread.join()
