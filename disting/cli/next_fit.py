"""disting next with the file of a fit: what to measure next to distinguish the structures that it
left.
"""

import argparse
import shlex
from collections.abc import Iterator, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass
from pathlib import Path

from disting.cli.output import complain
from disting.errors import InputError, enumeration
from disting.experiments.menu import Costs
from disting.files import Format
from disting.fit.results.networks import BAR
from disting.network.network import Network
from disting.planning.fit_file import FitRecord, is_of_networks, left_by, named_by
from disting.planning.next_experiment import bench_of, predictions, stood
from disting.report.fit.left_first import first_sentence, repeat_command
from disting.report.fit.left_words import (
    MEASURED_COLUMNS,
    ChainAdvice,
    left_rows,
    left_to_dict,
    measured_in_words,
    set_in_words,
)
from disting.report.fit.plan_words import larger_in_words
from disting.verdict.engine import Engine, Progress
from disting.verdict.next_experiments import Menu, menu_for
from disting.verdict.next_words import CSV_COLUMNS, to_dict

AGAIN = "then fit the new measurement, NEW, together with these data:"


@dataclass(frozen=True, slots=True)
class NetworkAdvice:
    """The networks that a fit of `source` left: `noise` names those that noise alone leaves
    together, the selected one first; `groups`: those that no data of these ports distinguish;
    `larger`: those that contain another one, and are no rivals.
    """

    source: str
    noise: tuple[str, ...]
    groups: tuple[Menu[Network], ...]
    larger: tuple[Network, ...] = ()

    @property
    def sentences(self) -> list[str]:
        """The answer."""
        texts = [f"the data of {self.source} leave {enumeration(self.noise, BAR)}"]
        if len(self.noise) > 1:
            command = f"disting plan {shlex.quote(self.source)}"
            texts.append(f"how much more of the same measurement tells these apart: {command}")
        if not self.groups:
            texts.append("no other candidate gives the same responses as one of them")
        return [*texts, *larger_in_words(self.larger, self.noise[0])]

    def to_dict(self) -> dict[str, object]:
        """Plain data, ready for JSON."""
        return {
            "format": Format.NEXT_OF_NETWORK_FIT.value,
            "sentences": self.sentences,
            "noise": list(self.noise),
            "groups": [to_dict(group) for group in self.groups],
        }


def network_advice(
    options: argparse.Namespace,
    costs: Costs,
    engine: Engine,
    executor: Executor | None,
    progress: Progress,
) -> NetworkAdvice | None:
    """Recommended next measurements for the networks that remain after the named fit; None for a
    fit of chains. Raises InputError.
    """
    source = _source(options)
    if not is_of_networks(Path(source)):
        return None
    every = left_by(Path(source))
    left = [survivor for survivor in every if not survivor.contains]
    groups = [
        menu_for(
            [(network.name, network) for network in (survivor.network, *survivor.same)],
            engine,
            costs=costs,
            executor=executor,
            progress=progress,
        )
        for survivor in left
        if survivor.same
    ]
    noise = tuple(survivor.network.name for survivor in left)
    larger = tuple(survivor.network for survivor in every if survivor.contains)
    return NetworkAdvice(source, noise, tuple(groups), larger)


def _source(options: argparse.Namespace) -> str:
    """The file; raises InputError for arguments in addition to it."""
    source = next(name for name in options.models if name.lower().endswith(".json"))
    if len(options.models) > 1 or options.damped is not None:
        raise InputError(
            f"{source} names its structures itself: leave other names and"
            " --damped or --undamped away"
        )
    return str(source)


def chain_advice(
    options: argparse.Namespace,
    costs: Costs,
    engine: Engine,
    executor: Executor | None,
    progress: Progress,
) -> ChainAdvice:
    """All that is known of the structures that the named fit left; raises InputError."""
    source = _source(options)
    named = named_by(Path(source))
    if len(named.left) < 2 and not named.explained:
        raise InputError(
            f"none of the structures of {source} explains its data, so the fit leaves no set: name"
            " the structures to tell apart"
        )
    _warn(source, named)
    standing = stood(named.left, engine, progress)
    groups = []
    for members in standing.groups:
        chosen = [(named.left[k].name, named.left[k].chain) for k in members]
        groups.append(menu_for(chosen, engine, costs=costs, executor=executor, progress=progress))
    bench = bench_of(named)
    predicted = predictions(named.left, bench, engine.settings, costs) if bench else None
    return ChainAdvice(source, named, standing, tuple(groups), predicted, costs)


def _warn(source: str, named: FitRecord) -> None:
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


def table(lead: ChainAdvice) -> Iterator[Sequence[str]]:
    """Every experiment at every pair of places, with its result for the data of the fit."""
    yield (*CSV_COLUMNS, *MEASURED_COLUMNS)
    yield from left_rows(lead)


def plain(lead: ChainAdvice) -> dict[str, object]:
    """Plain data, ready for JSON."""
    return left_to_dict(lead) | {"first": first_sentence(lead), "again": repeat_command(lead)}


def in_text(lead: ChainAdvice, menus: Sequence[str]) -> str:
    """Text of the recommended first measurement, the structures that remain, and the menus for
    those that cannot be distinguished.
    """
    if len(lead.left) == 1:
        return first_sentence(lead)
    first = [first_sentence(lead), ""] if lead.seen else []
    last = ["", AGAIN, f"  {repeat_command(lead)}"] if repeat_command(lead) else []
    return "\n".join([*first, *set_in_words(lead), "", *measured_in_words(lead), *menus, *last])
