"""disting compare: one verdict, explained.

What proves, writes a file or goes through experiments is imported where it is asked for: a look-up
needs none of it.
"""

import argparse
import json
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

from disting.catalogs import catalog
from disting.catalogs.files import SHIPPED_SIZES
from disting.cli.arguments import (
    add_also,
    add_bounds,
    add_damped,
    add_deciding,
    add_json,
    add_no_cache,
    add_notation,
    add_quantity,
)
from disting.cli.compare_words import both_ways, every_way, explained, in_letters
from disting.cli.model_names import MODEL, models_named
from disting.cli.output import emitted
from disting.cli.relations import query
from disting.cli.workers import engine_for, told_if_long
from disting.errors import InputError
from disting.experiments.places import named
from disting.general.any_model import measured
from disting.general.matrix_model import AnyModel
from disting.general.special_values import SpecialValues, special_values
from disting.model.chain import Chain, Sensor
from disting.model.names import name_of, read
from disting.model.question import Domain, Settings
from disting.verdict.comparison import compare
from disting.verdict.meaning import undetermined
from disting.verdict.query import Query, View
from disting.verdict.result import Relation, Verdict
from disting.verdict.sides import determinable, names_of

LONGER = "this pair takes longer than most; Ctrl-C stops it"
LESS = "; less to do: --domain complex, which asks for complex values only"
Known = tuple[str, int, int]
"""The name of a model, how much of it is determined, how many parameters it has."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of the command."""
    parser.add_argument("left", metavar="N:I", help=MODEL)
    text = "the other model, of the same or another size"
    parser.add_argument("right", metavar="M:J", help=text)
    add_damped(parser)
    add_quantity(parser)
    add_deciding(parser)
    text = "look only at models within this range of a parameter, of both models; may be repeated"
    add_bounds(parser, text)
    add_also(parser)
    add_json(parser, "the verdict with all that 'disting verify' needs", alone=True)
    add_notation(parser)
    add_no_cache(parser)


def run(options: argparse.Namespace) -> int:
    """Explain the verdict on one pair."""
    if options.json and options.bound:
        raise InputError(
            "what holds within ranges is told in words only: leave --json or --bound away"
        )
    sides = models_named((options.left, options.right), options)
    asked = query(options.conditions, View.EXACT, options.domain)
    if options.also:
        return _under_experiments(sides, asked, options)
    found = judged(sides, asked, options)
    if options.json:
        _written(file_of(found, asked, options), options)
    if options.json != "-":
        print("\n".join(_told(found, options)))
    return 0


@dataclass(frozen=True, slots=True)
class Judged:
    """Two models in the order of their verdict, and how much of each is determined."""

    models: tuple[Chain | AnyModel, Chain | AnyModel]
    verdict: Verdict
    known: tuple[Known, ...]


def judged(sides: Sequence[Chain | AnyModel], asked: Query, options: argparse.Namespace) -> Judged:
    """The verdict on two models, proven where that is asked for."""
    less = LESS if asked.view.domain is not Domain.COMPLEX else ""
    with told_if_long(LONGER + less):
        return _judged(sides, asked, options)


def _judged(sides: Sequence[Chain | AnyModel], asked: Query, options: argparse.Namespace) -> Judged:
    chains = _chains(sides)
    if chains:
        ordered, verdict = decided(chains, asked, options)
        return Judged((ordered[0], ordered[1]), verdict, _known_of(ordered, options))
    left, right = sides
    with engine_for(options) as (engine, _, _progress):
        verdict = compare(left, right, query=asked, engine=engine)
        known = determinable(left, right, engine)
    if options.prove:
        from disting.verdict.comparison import prove

        verdict = prove(verdict, left, right)
    return Judged((left, right), verdict, known)


def file_named(texts: Sequence[str], options: argparse.Namespace) -> dict[str, Any]:
    """The verdict on two models, as they are named, with all that its check needs."""
    from disting.verdict.everywhere import everywhere_file

    sides = models_named(texts, options)
    asked = query(options.conditions, View.EXACT, options.domain)
    if not options.also:
        return file_of(judged(sides, asked, options), asked, options)
    left, right = _chains(sides)
    with engine_for(options) as (engine, _, _progress):
        return everywhere_file(left, right, options.also, query=asked, engine=engine)


def file_of(found: Judged, asked: Query, options: argparse.Namespace) -> dict[str, Any]:
    """The verdict on two models with all that its check needs."""
    from disting.verdict.verdict_file import Stored, as_file, exact, has_more

    beside = None
    if has_more(found.verdict):
        beside = judged(found.models, exact(asked), options).verdict
    return as_file(Stored(found.models, (), asked, Settings(), found.verdict, beside))


def _written(whole: dict[str, Any], options: argparse.Namespace) -> None:
    emitted(options.json, json.dumps(whole, indent=1, ensure_ascii=False) + "\n")


def _told(found: Judged, options: argparse.Namespace) -> Iterator[str]:
    """The verdict in words."""
    verdict, chains = found.verdict, _chains(found.models)
    unknown, special = _unknown(verdict, found.known), _at_special_values(found.models, verdict)
    drawn, everywhere = list(map(in_letters, found.models)), special is not None and special.is_same
    yield explained(verdict, drawn, unknown, measured(found.models), everywhere)
    said = special.sentence(verdict.left, verdict.right) if special else ""
    yield from [f"special    {said}"] * bool(said)
    if chains and _tells_ways(verdict, options):
        yield from both_ways(verdict, chains, dict(options.bound))


def _at_special_values(sides: Sequence[Chain | AnyModel], verdict: Verdict) -> SpecialValues | None:
    """The second answer, on all positive values, where the verdict leaves special ones out."""
    models = [side for side in sides if not isinstance(side, Chain)]
    asked = verdict.has_exceptions or verdict.relation is Relation.DISTINGUISHABLE
    if verdict.domain is Domain.POSITIVE and len(models) == len(sides) and asked:
        return special_values(*models)
    return None


def _chains(sides: Sequence[Chain | AnyModel]) -> list[Chain]:
    """Both, if both are chains; else none."""
    chains = [side for side in sides if isinstance(side, Chain)]
    return chains if len(chains) == len(sides) else []


def _under_experiments(
    sides: Sequence[Chain | AnyModel], asked: Query, options: argparse.Namespace
) -> int:
    """Explain what further experiments tell, the chains as they are included."""
    from disting.verdict.everywhere import compare_everywhere, everywhere_file

    left, right = chains = _chains(sides)
    with engine_for(options) as (engine, _, _progress):
        if options.json:
            whole = everywhere_file(left, right, options.also, query=asked, engine=engine)
            _written(whole, options)
        if options.json == "-":
            return 0
        found = compare_everywhere(left, right, options.also, query=asked, engine=engine)
    asked_for = [named(text).experiment for text in options.also]
    experiments = list(dict.fromkeys(experiment.text for experiment in asked_for))
    lines = [f"experiment {i}  {text}" for i, text in enumerate(["as it is", *experiments], 1)]
    print("\n".join([*every_way(found, chains, asked_for), "", *lines]))
    return 0


def decided(
    chains: Sequence[Chain], asked: Query, options: argparse.Namespace
) -> tuple[list[Chain], Verdict]:
    """The verdict, from the shipped catalogues or decided, and the chains in its order: a stored
    one names the model of the lower number first.
    """
    found = shipped(chains, asked)
    if found is None:
        with engine_for(options) as (engine, _, _progress):
            found = compare(*chains, query=asked, engine=engine)
    turned = found.left != names_of(chains[0], chains[1])[0]
    ordered = list(reversed(chains)) if turned else list(chains)
    if options.prove:
        from disting.verdict.comparison import prove

        found = prove(found, ordered[0], ordered[1])
    return ordered, found


def shipped(chains: Sequence[Chain], asked: Query) -> Verdict | None:
    """The stored verdict on two chains of a shipped catalogue, if all conditions may decide, under
    their whole names.
    """
    left, right = sorted((read(name_of(chain)) for chain in chains), key=lambda n: n.number)
    a, b = chains
    stored = (
        a.n_masses == b.n_masses in SHIPPED_SIZES
        and a.damped == b.damped
        and a.sensor is b.sensor is Sensor.ACCELERATION
        and left.is_plain
        and right.is_plain
        and left != right
        and asked == Query(asked.view)
    )
    if not stored:
        return None
    found = catalog(a.n_masses, damped=a.damped).verdict(left.number, right.number, asked.view)
    return replace(found, left=str(left), right=str(right))


def _known_of(chains: Sequence[Chain], options: argparse.Namespace) -> tuple[Known, ...]:
    """How much of two chains is determined: as their catalogue has it, or computed."""
    a, b = chains
    if all(_is_shipped(chain) for chain in chains):
        names = names_of(a, b)
        records = (
            catalog(c.n_masses, damped=c.damped).records[read(name_of(c)).number] for c in chains
        )
        return tuple(
            (n, r["rank"], len(r["parameters"])) for n, r in zip(names, records, strict=True)
        )
    with engine_for(options) as (engine, _, _progress):
        return determinable(a, b, engine)


def _is_shipped(chain: Chain) -> bool:
    """Whether a catalogue tells of it."""
    plain = replace(chain, ground_dampers=(), lag=False, dead_time=False) == chain
    acceleration = chain.sensor is Sensor.ACCELERATION
    return plain and acceleration and chain.n_masses in SHIPPED_SIZES


def _unknown(verdict: Verdict, known: Iterable[Known]) -> list[str]:
    """What cannot be determined of two models that are told apart: before they are called so."""
    if verdict.relation is not Relation.DISTINGUISHABLE:
        return []
    return list(filter(None, (undetermined(*one) for one in known)))


def _tells_ways(verdict: Verdict, options: argparse.Namespace) -> bool:
    """Whether there is something to tell of positive equivalents that the verdict's evidence
    does not say.
    """
    known = verdict.left_positive is not None or verdict.right_positive is not None
    return bool(options.bound) or (known and not verdict.proves_shares)
