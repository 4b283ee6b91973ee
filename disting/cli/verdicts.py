"""disting verdicts: all pairs of one size, of several sizes together, or of a file of models."""

import argparse
from collections.abc import Iterator, Sequence
from itertools import combinations
from pathlib import Path

from disting.catalogs.export import decisions_csv, decisions_json
from disting.catalogs.network_files import SHIPPED, recall
from disting.catalogs.sizes import combined_family
from disting.cli.arguments import (
    Listed,
    add_damped,
    add_deciding,
    add_json,
    add_quantity,
    add_work,
    is_damped,
    sizes_or_list,
    whole,
)
from disting.cli.output import emit, keep_apart, written_file
from disting.cli.relations import VIEWS, query, relations_in_words, rules_in_words
from disting.cli.workers import (
    announce,
    announce_pairs,
    engine_for,
    pairs_by_size,
    pairs_work,
    told_if_long,
)
from disting.conditions.inclusion import ONE_SIDED, Sense
from disting.conditions.side import AnySide
from disting.errors import InputError, in_row
from disting.general.any_model import of_network
from disting.general.model_files import ModelList, read_models
from disting.general.naming import has_free_name
from disting.model.chain import Sensor
from disting.model.names import damping_option
from disting.model.presentation import plural
from disting.network.denotation import FREE_NAMES
from disting.network.families import family_of
from disting.verdict.comparison import prove_all
from disting.verdict.decisions import Decisions
from disting.verdict.engine import Engine
from disting.verdict.joint import family_safety, joint_in_words
from disting.verdict.result import Relation
from disting.verdict.sides import refuse_ports

MOST_TOLD = 20  # pairs that are told one by one
LISTS = "a family of networks such as machines-3 (the end of 'disting models --help' lists them)"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of the command."""
    parser.add_argument(
        "masses",
        type=sizes_or_list,
        metavar="N|N-M|FILE.json|FAMILY",
        help=f"number of masses, or several sizes such as 1-4 in one matrix, or a file, or {LISTS}",
    )
    add_damped(parser)
    text = "write the verdicts as CSV; - is standard output"
    parser.add_argument("--csv", type=written_file, metavar="FILE", help=text)
    add_json(parser, "the verdicts with evidence")
    add_quantity(parser)
    add_deciding(parser)
    text = "which may decide (default: all)"
    parser.add_argument("--representation", choices=VIEWS, default="all", help=text)
    text = "use G_0 and G_1..G_K (default: all that are needed)"
    parser.add_argument("--markov", type=whole(1), default=0, metavar="K", help=text)
    add_work(parser)


def run(options: argparse.Namespace) -> int:
    """Decide all pairs of one size, of several, or of a file."""
    if options.csv == options.json == "-":
        raise InputError(
            "one of --csv and --json can be standard output, not both: name a file for the other"
        )
    wanted = query(
        options.conditions, VIEWS[options.representation], options.domain, options.markov
    )
    file = options.masses if isinstance(options.masses, Listed) else None
    if file:
        refuse_chain_options(options)
    models = list_of(file) if file else None
    if not file:
        announce(pairs_work(is_damped(options)), pairs_by_size(options.masses), options.jobs)
    with engine_for(options) as (engine, pool, progress):
        if isinstance(file, str):
            recall(file, engine)
        subjects: Sequence[AnySide] = (
            engine.general_subjects(models.models) if models else _of_sizes(options, engine)
        )
        if file and file not in SHIPPED:
            announce_pairs(str(file), subjects, wanted, engine, options.jobs)
        decided = engine.decisions(subjects, wanted, executor=pool, progress=progress)
        if options.prove:
            decided = prove_all(decided, progress=progress)
    if options.csv:
        emit(options.csv, decisions_csv(decided))
    if options.json:
        emit(options.json, decisions_json(decided))
    if "-" not in (options.csv, options.json):
        print("\n".join([_summary(decided), *(_groups(decided) if file else ())]))
        print(joint_in_words(family_safety(decided)))
        if models and has_free_name(models):
            print(FREE_NAMES)
    return 0


def refuse_chain_options(options: argparse.Namespace) -> None:
    """Raises InputError for options that speak of numbered chains, where models are a file's."""
    if options.damped is not None:
        raise InputError(
            f'{damping_option(options.damped)} belongs to numbered chains: write "damped": true or'
            " false at the chains of the file"
        )
    if getattr(options, "quantity", Sensor.ACCELERATION) != Sensor.ACCELERATION:
        raise InputError(
            '--quantity belongs to numbered chains: write "sensor" at the chains of the file'
        )


def listed_models(source: Listed) -> ModelList:
    """The models of a file, or of a family of networks."""
    if isinstance(source, Path):
        models = read_models(source)
    else:
        family = family_of(source)
        with told_if_long(f"listing the networks of {source}, which takes a while"):
            models = ModelList(tuple(map(of_network, family.networks)), family.title)
    keep_apart(model.name for model in models)
    return models


def list_of(source: Listed) -> ModelList:
    """The same, two models at least."""
    models = listed_models(source)
    if len(models) < 2:
        raise InputError(f"{source} has one model: there is nothing to compare; add another one")
    refuse_ports(models.models)
    return models


def _of_sizes(options: argparse.Namespace, engine: Engine) -> Sequence[AnySide]:
    """Numbered chains, N:I."""
    named = combined_family(
        options.masses, damped=is_damped(options), sensor=Sensor(options.quantity)
    )
    return [engine.subject(name, chain) for name, chain in named]


def _summary(decided: Decisions) -> str:
    """Number of pairs by relation and by rule; for several sizes, the number of smaller models
    contained in larger ones.
    """
    pairs = list(combinations(range(len(decided.subjects)), 2))
    head = (
        f"{plural(len(decided.subjects), 'model')}, {plural(len(pairs), 'pair')}, over"
        f" {decided.query.view.domain} parameters"
    )
    relations = relations_in_words(decided.relation(i, j) for i, j in pairs)
    phrase = (
        f"{head}: {relations}\ndecided:"
        f" {rules_in_words(decided.counts(), decided.query.view.domain)}"
    )
    inside = sum(_lies_in_larger(decided, i, j) for i, j in decided.inclusions)
    limits = (
        f"\nover complex parameters: {inside} smaller models are limits of larger ones"
        if inside
        else ""
    )
    return f"{phrase}{limits}"


def _groups(decided: Decisions) -> Iterator[str]:
    """Lines on the models that are equivalent, those that sometimes are, and the open pairs with
    the reason.
    """
    names, classes = [s.name for s in decided.subjects], decided.classes()
    for members in classes:
        yield f"these are the same: {in_row(names[i] for i in members)}"
    together = {pair for members in classes for pair in combinations(members, 2)}
    through = sum(decided.relation(i, j) is Relation.UNDECIDED for i, j in together)
    if through:
        what = plural(through, "undecided pair")
        yield f"{what} among these: the same, as both are the same as a third one"
    for relation in (Relation.SOMETIMES, Relation.UNDECIDED):
        pairs = [
            (i, j)
            for i, j in combinations(range(len(names)), 2)
            if decided.relation(i, j) is relation and (i, j) not in together
        ]
        yield from (decided.verdict(i, j).sentence for i, j in pairs[:MOST_TOLD])
        if len(pairs) > MOST_TOLD:
            yield f"and {len(pairs) - MOST_TOLD} more pairs that are {relation} (--csv lists them)"


def _lies_in_larger(decided: Decisions, i: int, j: int) -> bool:
    """Return True if the smaller model is contained in the one with more masses."""
    sizes = decided.sizes
    return (
        len(sizes) > 0
        and sizes[i] != sizes[j]
        and decided.inclusion(i, j, Sense.CLOSURE) in ONE_SIDED
    )
