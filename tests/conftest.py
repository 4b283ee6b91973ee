"""No test touches the user's cache, none is told of progress, examples are the same in every run.

HYPOTHESIS_PROFILE=fresh draws new ones."""

import gc
import os
import shutil
import sys
from collections import defaultdict
from pathlib import Path

import pytest
from hypothesis import settings

DEARER = "slow", "bench", "attack"
# without windows, where it is there: the same engine at four fifths of the work
PROGRAMS = "chromium-headless-shell", "chromium", "chromium-browser", "google-chrome"
CHROMIUM = next(filter(None, map(shutil.which, PROGRAMS)), None)
os.environ["DISTING_CACHE"] = "off"
os.environ["DISTING_PROGRESS"] = "off"
# workers, the processes that tests start, and the next run share compiled modules; else each
# compiles the whole package
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
sys.dont_write_bytecode = False
# a deadline is a time that a busy machine breaks
settings.register_profile("repeatable", derandomize=True, deadline=None)
settings.register_profile("fresh", deadline=None)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "repeatable"))


@pytest.hookimpl(wrapper=True)
def pytest_collection():
    """What is collected stays: to look through it for garbage takes a third of the time, and is
    not done later either.
    """
    gc.disable()
    try:
        return (yield)
    finally:
        gc.freeze()
        gc.set_threshold(100_000, 20, 100)  # a test makes much, and little of it in circles
        gc.enable()


def pytest_configure(config):
    """-m with `full` in it means no test of the dearer kinds unless it names them, so that -m full
    alone is what the default tests leave out.
    """
    chosen = config.option.markexpr
    if "full" in chosen:
        left_out = [f" and not {kind}" for kind in DEARER if kind not in chosen]
        config.option.markexpr = f"({chosen}){''.join(left_out)}"


@pytest.hookimpl(tryfirst=True)  # before -m chooses
def pytest_collection_modifyitems(items):
    """`thin(n)`: n cases of a test, spread over all of them, are default tests, the others `full`.
    Cases with a mark of their own do not count.
    """
    cases = defaultdict(list)
    for item in items:
        marks = {mark.name for mark in item.iter_markers()}
        if "thin" in marks and not marks & {"full", *DEARER}:
            cases[item.path, item.cls, item.originalname].append(item)
    for of_one in cases.values():
        (count,) = of_one[0].get_closest_marker("thin").args
        kept = {k * len(of_one) // count for k in range(count)}
        for k, item in enumerate(of_one):
            if k not in kept:
                item.add_marker("full")


def pytest_ignore_collect(collection_path, config):
    """Rooms of which nothing runs unless it is asked for are not read before."""
    room = collection_path.name
    return True if room in ("attack", "bench") and f"not {room}" in config.option.markexpr else None


SECTIONS = {"oracle": "compared with independent programs", "attack": "attacked"}


def pytest_terminal_summary(terminalreporter):
    """What was compared with independent programs, and what was attacked, is said whether the
    tests pass or fail.
    """
    reports = [
        report for kind in ("passed", "failed") for report in terminalreporter.stats.get(kind, [])
    ]
    told = [
        (r.nodeid, name, text)
        for r in reports
        if r.when == "call"
        for name, text in r.user_properties
    ]
    for section, title in SECTIONS.items():
        lines = [f"{nodeid}: {text}" for nodeid, name, text in told if name == section]
        if lines:
            terminalreporter.section(title)
        for line in lines:
            terminalreporter.write_line(line)


@pytest.fixture(scope="session")
def browser():
    """The one browser of a process: a second Playwright beside it would not start."""
    playwright = pytest.importorskip("playwright.sync_api", reason="Playwright is not installed")
    with playwright.sync_playwright() as p:
        if not CHROMIUM and not Path(p.chromium.executable_path).exists():
            pytest.skip("no Chromium found, neither the system's nor Playwright's own")
        chromium = p.chromium.launch(
            executable_path=CHROMIUM, args=["--no-sandbox", "--disable-gpu"]
        )
        yield chromium
        chromium.close()
