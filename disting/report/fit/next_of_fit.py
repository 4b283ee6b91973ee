"""Advice after a fit: the measurement that distinguishes the structures that it left."""

import shlex
from collections.abc import Iterator, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass
from pathlib import Path

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
from disting.verdict.menu_text import BRIEF, DOMAIN, describe_menu, menu_text
from disting.verdict.next_experiments import Menu, menu_for
from disting.verdict.next_words import CSV_COLUMNS, anywhere, rows, to_dict

AGAIN = "then fit the new measurement, NEW, together with these data:"
Table = Iterator[Sequence[str]]


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
            texts.append(f"how much more of the same measurement separates these: {command}")
        if not self.groups:
            texts.append("no other candidate gives the same responses as one of them")
        return [*texts, *larger_in_words(self.larger, self.noise[0])]

    @property
    def first(self) -> str:
        """The first sentence: what separates the first group, if anything separates all of it, or
        that there is nothing to separate.
        """
        group = next(iter(self.groups), None)
        enough = anywhere(group) if group else ""
        if group is None and len(self.noise) == 1:
            return "; ".join(self.sentences)
        if group is None or not enough:
            return self.sentences[0]
        names = enumeration(group.names, BAR)
        return f"this measurement cannot distinguish {names}; what separates all of them: {enough}"

    @property
    def warnings(self) -> list[str]:
        """There are none: a fit of networks that explains nothing has no advice."""
        return []

    @property
    def text(self) -> str:
        """The answer and the menu of each group."""
        return "\n\n".join([*self.sentences, *map(menu_text, self.groups)])

    def table(self) -> Table:
        """Yield every experiment at every pair of places, the names of the columns first."""
        yield CSV_COLUMNS
        yield from (row for group in self.groups for row in rows(group))

    def to_dict(self) -> dict[str, object]:
        """Plain data, ready for JSON."""
        return {
            "format": Format.NEXT_OF_NETWORK_FIT.value,
            "sentences": self.sentences,
            "noise": list(self.noise),
            "groups": [to_dict(group) for group in self.groups],
        }


@dataclass(frozen=True, slots=True)
class AdviceOnChains:
    """All that is known of the chains that a fit left, in words, as rows and as plain data."""

    lead: ChainAdvice

    @property
    def first(self) -> str:
        """The first sentence; "" where the file does not state the lines of its data."""
        return first_sentence(self.lead)

    @property
    def warnings(self) -> list[str]:
        """Sentences on what limits the advice."""
        return list(_warnings(self.lead.source, self.lead.named))

    @property
    def text(self) -> str:
        """The recommended first measurement, the structures that remain, and the menus for those
        that cannot be distinguished.
        """
        lead = self.lead
        if len(lead.left) == 1:
            return self.first
        first = [self.first, ""] if lead.seen else []
        menus = [line for group in lead.groups for line in ("", *describe_menu(group, brief=True))]
        domain = ["", DOMAIN.format(place="mass"), BRIEF] if lead.groups else []
        again = repeat_command(lead)
        last = ["", AGAIN, f"  {again}"] if again else []
        own = [*set_in_words(lead), "", *measured_in_words(lead)]
        return "\n".join([*first, *own, *domain, *menus, *last])

    def table(self) -> Table:
        """Yield every experiment at every pair of places, with its result for the data of the fit,
        the names of the columns first.
        """
        yield (*CSV_COLUMNS, *MEASURED_COLUMNS)
        yield from left_rows(self.lead)

    def to_dict(self) -> dict[str, object]:
        """Plain data, ready for JSON."""
        return left_to_dict(self.lead) | {
            "first": self.first,
            "again": repeat_command(self.lead),
        }


def advise_fit(
    source: str, costs: Costs, engine: Engine, executor: Executor | None, progress: Progress
) -> NetworkAdvice | AdviceOnChains:
    """Recommended next measurements for the structures that the fit of a file left. Raises
    InputError.
    """
    if is_of_networks(Path(source)):
        return _advise_networks(source, costs, engine, executor, progress)
    return AdviceOnChains(_advise_chains(source, costs, engine, executor, progress))


def _advise_networks(
    source: str, costs: Costs, engine: Engine, executor: Executor | None, progress: Progress
) -> NetworkAdvice:
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


def _advise_chains(
    source: str, costs: Costs, engine: Engine, executor: Executor | None, progress: Progress
) -> ChainAdvice:
    named = named_by(Path(source))
    if len(named.left) < 2 and not named.explained:
        raise InputError(
            f"none of the structures of {source} explains its data, so the fit leaves no set:"
            " name the structures to distinguish"
        )
    standing = stood(named.left, engine, progress)
    groups = []
    for members in standing.groups:
        chosen = [(named.left[k].name, named.left[k].chain) for k in members]
        groups.append(menu_for(chosen, engine, costs=costs, executor=executor, progress=progress))
    bench = bench_of(named)
    predicted = predictions(named.left, bench, engine.settings, costs) if bench else None
    return ChainAdvice(source, named, standing, tuple(groups), predicted, costs)


def _warnings(source: str, named: FitRecord) -> Iterator[str]:
    if not named.explained:
        yield (
            f"warning: none of the structures of {source} explains its data: the true one may not"
            " be among them"
        )
    if named.responses > 1:
        yield (
            f"warning: {source} has {named.responses} responses; the menu starts from the first"
            " one only: what it calls sufficient is sufficient; the other responses may already"
            " have decided what it leaves open"
        )
