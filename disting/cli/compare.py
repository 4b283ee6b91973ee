"""disting compare: one verdict, explained.

What proves, writes a file or goes through experiments is imported where it is asked for: a look-up
needs none of it.
"""

import argparse
import json
from collections.abc import Sequence
from dataclasses import replace
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
from disting.cli.output import emitted
from disting.cli.plain import keep_apart
from disting.cli.relations import query
from disting.cli.structures import is_network
from disting.cli.workers import engine_for
from disting.errors import InputError
from disting.experiments import named
from disting.general.any_model import of_network
from disting.general.matrix_model import AnyModel
from disting.general.model_files import read_models
from disting.model.chain import Chain, Sensor
from disting.model.drawing import text_drawing
from disting.model.names import chains_named, damping_option, name_of, read
from disting.model.question import Settings
from disting.network.notation import network_of
from disting.verdict.comparison import compare, names_of
from disting.verdict.query import Query, View
from disting.verdict.result import Verdict

FILE = ".json:"  # between a file and the name of a model in it
MODEL = (
    "a model: masses:number, as 'disting models' lists it; +b2: with a damper from mass 2 to the"
    " ground; +lag; +delay; a network such as 'R0-p(R1,C1)' or '1=2, 2=3, 2=4; F1; S4'; or"
    " file.json:name, a model of your own"
)


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
    texts = (options.left, options.right)
    if options.json:
        emitted(
            options.json, json.dumps(file_of(texts, options), indent=1, ensure_ascii=False) + "\n"
        )
        return 0
    sides = _sides(texts, options)
    asked = query(options.conditions, View.EXACT, options.domain)
    chains = _chains(sides)
    if options.also:
        return _under_experiments(chains, asked, options)
    if not chains:
        with engine_for(options) as (engine, _, _progress):
            found = compare(*sides, query=asked, engine=engine)
        print(explained(found, list(map(in_letters, sides))))
        return 0
    chains, verdict = decided(chains, asked, options)
    ways = both_ways(verdict, chains, dict(options.bound)) if _tells_ways(verdict, options) else ()
    print("\n".join([explained(verdict, list(map(text_drawing, chains))), *ways]))
    return 0


def file_of(texts: Sequence[str], options: argparse.Namespace) -> dict[str, Any]:
    """The verdict on two models, as they are named, with all that its check needs."""
    from disting.verdict.everywhere import everywhere_file
    from disting.verdict.verdict_file import Stored, as_file, exact, has_more, verdict_file

    sides = _sides(texts, options)
    asked = query(options.conditions, View.EXACT, options.domain)
    chains = _chains(sides)
    if options.also:
        with engine_for(options) as (engine, _, _progress):
            a, b = chains
            return everywhere_file(a, b, options.also, query=asked, engine=engine)
    if not chains:
        with engine_for(options) as (engine, _, _progress):
            return verdict_file(*sides, query=asked, engine=engine)
    ordered, verdict = decided(chains, asked, options)
    beside = decided(ordered, exact(asked), options)[1] if has_more(verdict) else None
    return as_file(Stored((ordered[0], ordered[1]), (), asked, Settings(), verdict, beside))


def _sides(texts: Sequence[str], options: argparse.Namespace) -> list[Chain | AnyModel]:
    """Two of what can be named: a chain, a network in a notation, a model file.json:name."""
    networks = {text: _network(text, options) for text in texts if FILE not in text}
    named = [text for text, network in networks.items() if network is None]
    if len(set(texts)) == len(set(named)):
        if options.also and (options.prove or getattr(options, "bound", ())):
            raise InputError(
                "with --also the verdict is on several experiments: leave --prove and --bound away"
            )
        return [*chains_named(texts, damped=options.damped, sensor=options.quantity)]
    if options.also:
        raise InputError("--also belongs to numbered chains: leave it away")
    for name in ("bound", "prove"):
        if getattr(options, name, ()):
            raise InputError(f"--{name} belongs to numbered chains: leave it away")
    if all(FILE in text for text in texts):
        from disting.cli.verdicts import refuse_chain_options

        refuse_chain_options(options)
    if not named and options.damped is not None:
        raise InputError(
            f"{damping_option(options.damped)} belongs to numbered chains: a network says its"
            " dampers itself"
        )
    chains = dict(
        zip(
            named,
            chains_named(named, damped=options.damped, sensor=options.quantity),
            strict=True,
        )
    )
    lists = {path: read_models(path) for path, _ in map(_parted, texts) if path}
    keep_apart(model.name for found in lists.values() for model in found)
    return [
        lists[path][name] if path else networks[text] or chains[text]
        for text, (path, name) in zip(texts, map(_parted, texts), strict=True)
    ]


def _network(text: str, options: argparse.Namespace) -> AnyModel | None:
    """The model of a network; None of the name of a chain."""
    if not is_network(text, options.notation):
        return None
    quantity = Sensor(options.quantity)
    return of_network(network_of(text, options.notation, quantity=quantity))


def _chains(sides: Sequence[Chain | AnyModel]) -> list[Chain]:
    """Both, if both are chains; else none."""
    chains = [side for side in sides if isinstance(side, Chain)]
    return chains if len(chains) == len(sides) else []


def _parted(text: str) -> tuple[str, str]:
    """A file and the name of a model in it; "" and the text where it names a chain."""
    path, mark, name = text.partition(FILE)
    return (f"{path}{FILE[:-1]}", name) if mark else ("", text)


def _under_experiments(chains: Sequence[Chain], asked: Query, options: argparse.Namespace) -> int:
    """Explain what further experiments tell, the chains as they are included."""
    from disting.verdict.everywhere import compare_everywhere

    left, right = chains
    with engine_for(options) as (engine, _, _progress):
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
        from disting.verdict.proof import prove

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


def _tells_ways(verdict: Verdict, options: argparse.Namespace) -> bool:
    """Whether there is something to tell of positive equivalents that the verdict's evidence
    does not say.
    """
    known = verdict.left_positive is not None or verdict.right_positive is not None
    return bool(options.bound) or (known and not verdict.proves_shares)
