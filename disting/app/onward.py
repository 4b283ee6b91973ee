"""Advice and plan after a fit, as jobs of the Data page: the next measurement, more of the same.

Each is what the command gives that it names, for the file of the fit.
"""

import shlex
from collections.abc import Iterator, Sequence
from concurrent.futures import Executor
from contextlib import contextmanager
from pathlib import Path

from disting.app.interface import Json, Progress
from disting.app.project import add_to_fit, fit_file
from disting.app.workers import Setting
from disting.experiments.menu import Costs
from disting.planning.fit_file import record_of
from disting.report.fit.left_first import advised_setup
from disting.report.fit.next_of_fit import AdviceOnChains, advise_fit
from disting.report.fit.plans_of_fit import doubts_of, effort_like, plan_rivals
from disting.store import Store
from disting.store.scheduling import executor
from disting.verdict.engine import Engine


def advise(request: Json, progress: Progress, setting: Setting) -> Json:
    """Return the fit with `next`: what to measure next, as `disting next` says it."""
    path = fit_file(request["fit"])
    with _working(setting) as (engine, pool):
        advice = advise_fit(str(path), Costs.read(""), engine, pool, progress)
    setup = advised_setup(advice.lead) if isinstance(advice, AdviceOnChains) else ""
    words = _words("next", path, advice.first, advice.text, advice.warnings)
    return add_to_fit(request["fit"], "next", words | {"setup": setup})


def plan(request: Json, progress: Progress, setting: Setting) -> Json:
    """Return the fit with `plan`, as `disting plan` says it; its pages are written beside those of
    the fit.
    """
    path = fit_file(request["fit"])
    named = record_of(path)
    effort = effort_like(named)
    with _working(setting) as (engine, pool):
        plans = plan_rivals(path, named, effort, engine=engine, executor=pool, progress=progress)
    progress("pages of the plan", 0, 1)
    plans.write(path.parent)
    words = _words(
        "plan", path, plans.title, "\n".join(plans.in_words()), doubts_of(path, named, effort)
    )
    return add_to_fit(request["fit"], "plan", words)


def _words(command: str, path: Path, first: str, text: str, warnings: Sequence[str]) -> Json:
    """An answer in words with its command."""
    return {
        "first": first or text.partition("\n")[0],
        "text": text,
        "warnings": list(warnings),
        "command": shlex.join(["disting", command, path.as_posix()]),
    }


@contextmanager
def _working(setting: Setting) -> Iterator[tuple[Engine, Executor | None]]:
    """Engine with the user's cache, and processes."""
    with Store.open(None) as store, executor(setting.jobs, setting.scheduler) as pool:
        yield Engine(store=store), pool
