"""No test touches the user's cache, none is told of progress, examples are the same in every run.

HYPOTHESIS_PROFILE=fresh draws new ones."""

import gc
import os
import re
import shutil
import sys
from collections import defaultdict
from pathlib import Path

import pytest
from hypothesis import is_hypothesis_test, settings

DEARER = "slow", "bench", "attack"
MARKS_OF_FILE = re.compile(r"^pytestmark = (?:\[[^]]*\]|.*)", re.MULTILINE)
# examples in documents and docstrings that take more than half a second
DEAR_DOCUMENTS = {
    "fit-details.md",
    "gallery.md",
    "machines.md",
    "own-family.md",
    "spectrum.md",
    "disting.fit",
    "disting.fit.networks.fit_networks",
    "disting.report.write.write_report",
    "disting.verdict.decisions.Decisions",
    "disting.verdict.next_experiments.next_experiments",
}
# examples of a law: a fifth of all by default, half of them as `full`, but not less than five
FEWER, FEWEST, HALF = 5, 5, 2
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
    unnamed = [f"not {kind}" for kind in DEARER if kind not in chosen]
    if "full" in chosen and unnamed:
        config.option.markexpr = " and ".join([f"({chosen})", *unnamed])


def left_out(config):
    """Kinds of which -m chooses no test: `not` with each is a term of it, outside parentheses."""
    outside = re.sub(r"\(.*\)", "()", config.option.markexpr)
    terms = [] if " or " in outside else outside.split(" and ")
    return {term.removeprefix("not ") for term in terms if term.startswith("not ")}


def left_out_unseen(config):
    """The same for whole folders; a file or a test that is named is read, whatever its marks."""
    named = any("::" in name or name.endswith(".py") for name in config.args)
    return set() if named else left_out(config)


def pytest_ignore_collect(collection_path, config):
    """What is left out as a whole, a room or a file, is not read: imports and cases cost time."""
    out = left_out_unseen(config)
    if collection_path.name in ("attack", "bench"):
        return True if collection_path.name in out else None
    if collection_path.suffix != ".py" or not out:
        return None
    of_file = MARKS_OF_FILE.findall(collection_path.read_text(encoding="utf-8"))
    return True if out & set(re.findall(r"pytest\.mark\.(\w+)", "".join(of_file))) else None


def pytest_pycollect_makeitem(collector, name, obj):
    """Nor are the cases of a test made that is left out with all of them."""
    marks = {mark.name for mark in getattr(obj, "pytestmark", ())} if name[:4] == "test" else set()
    return [] if marks & left_out_unseen(collector.config) else None


@pytest.hookimpl(wrapper=True)
def pytest_collect_file(file_path):
    """Modules without an example are not searched for one: it looks at each of their names."""
    collectors = yield
    if file_path.suffix != ".py" or ">>> " in file_path.read_text(encoding="utf-8"):
        return collectors
    return [c for c in collectors if "Doctest" not in type(c).__name__]


@pytest.hookimpl(tryfirst=True)  # before -m chooses
def pytest_collection_modifyitems(items, config):
    """Split tests between the default ones, the `full` ones and the `slow` ones.

    `thin(n)`: n cases of a test, spread over all of them, are default tests, the others `full`.
    `sampled(n)`: n of its `full` cases stay `full`, the others are `slow`. Cases with a mark of
    their own do not count. A law is both: a default test with few examples, a `full` one with
    half of them, or with all where `slow` tests run too.
    """
    for item in items:
        if item.name in DEAR_DOCUMENTS:
            item.add_marker("full")
    put_off(items, "thin", "full", {"full", *DEARER})
    put_off(
        [item for item in items if item.get_closest_marker("full")], "sampled", "slow", {*DEARER}
    )
    out = left_out(config)
    laws = [item for item in items if is_hypothesis_test(getattr(item, "obj", None))]
    for item in [] if "full" in out else laws:
        item.add_marker("full")
    share = FEWER if "full" in out else HALF if "slow" in out else 1
    for law in {item.obj for item in laws}:
        all_of_them = law._hypothesis_internal_use_settings
        count = min(all_of_them.max_examples, max(FEWEST, all_of_them.max_examples // share))
        law._hypothesis_internal_use_settings = settings(all_of_them, max_examples=count)


def put_off(items, marked, later, without):
    """Mark those cases of a test `later` that its mark `marked(n)` does not keep."""
    cases = defaultdict(list)
    for item in items:
        if item.get_closest_marker(marked) and not without & {m.name for m in item.iter_markers()}:
            cases[item.path, item.cls, item.originalname].append(item)
    for of_one in cases.values():
        (count,) = of_one[0].get_closest_marker(marked).args
        kept = {k * len(of_one) // count for k in range(count)}
        for k, item in enumerate(of_one):
            if k not in kept:
                item.add_marker(later)


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


@pytest.fixture(scope="session", autouse=True)
def one_core():
    """One processor for what is called in this process: pytest's workers use the others, and a
    process imports for seconds before it works. A test of several processes names their number.
    """
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(os, "sched_getaffinity", lambda _: {0}, raising=False)
        yield


@pytest.fixture(scope="session")
def browser():
    """The one browser of a process: a second Playwright beside it would not start."""
    playwright = pytest.importorskip("playwright.sync_api", reason="Playwright is not installed")
    with playwright.sync_playwright() as p:
        if not CHROMIUM and not Path(p.chromium.executable_path).exists():
            pytest.skip("no Chromium found, neither the system's nor Playwright's own")
        # without site isolation: a tenth less work
        options = ["--no-sandbox", "--disable-gpu", "--disable-site-isolation-trials"]
        chromium = p.chromium.launch(executable_path=CHROMIUM, args=options)
        yield chromium
        chromium.close()
