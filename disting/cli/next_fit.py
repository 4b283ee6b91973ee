"""disting next with the file of a fit: what to measure next to tell apart what it left."""

import argparse
from concurrent.futures import Executor
from pathlib import Path

from disting.cli.plain import complain
from disting.errors import InputError
from disting.experiments.menu import Costs
from disting.fit.plan.fit_file import Named, named_by
from disting.fit.plan.further import bench_of, foretold
from disting.fit.plan.relations import stood
from disting.report.fit.left_words import Onward
from disting.verdict.engine import Engine, Progress
from disting.verdict.further import further


def onward(
    options: argparse.Namespace,
    costs: Costs,
    engine: Engine,
    executor: Executor | None,
    progress: Progress,
) -> Onward:
    """All that is known of the structures that the named fit left; raises InputError."""
    source = next(name for name in options.models if name.lower().endswith(".json"))
    if len(options.models) > 1 or options.damped is not None:
        raise InputError(
            f"{source} names its structures itself: leave other names and"
            " --damped or --undamped away"
        )
    named = named_by(Path(source))
    if len(named.left) < 2 and not named.explained:
        raise InputError(
            f"none of the structures of {source} explains its data, so the fit leaves no set: name"
            " the structures to tell apart"
        )
    _warn(source, named)
    known = stood(named.left, engine, progress)
    groups = []
    for members in known.groups:
        chosen = [(named.left[k].name, named.left[k].chain) for k in members]
        groups.append(further(chosen, engine, costs=costs, executor=executor, progress=progress))
    bench = bench_of(named)
    seen = foretold(named.left, bench, engine.settings, costs) if bench else None
    return Onward(source, named, known, tuple(groups), seen, costs)


def _warn(source: str, named: Named) -> None:
    if not named.explained:
        complain(
            f"warning: none of the structures of {source} explains its data: the true one may not"
            " be among them"
        )
    if named.responses > 1:
        complain(
            f"warning: {source} has {named.responses} responses; the menu starts from the first"
            " one alone: what it calls sure is sure, and what it leaves open the others may have"
            " told already"
        )
