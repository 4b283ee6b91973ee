"""disting verdicts: all pairs of one size, of several sizes together, or of a file of models."""

import argparse
from collections.abc import Iterator
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
from disting.cli.relations import relations_in_words, rules_in_words
from disting.cli.workers import (
    announce,
    announce_pairs,
    engine_for,
    pairs_by_size,
    pairs_work,
    told_if_long,
)
from disting.conditions.inclusion import ONE_SIDED, Sense
from disting.errors import InputError, in_row
from disting.general.any_model import of_network
from disting.general.model_files import ModelList, read_models
from disting.general.naming import has_free_name
from disting.model.chain import Chain, Quantity
from disting.model.names import damping_option
from disting.model.presentation import plural
from disting.network.denotation import FREE_NAMES
from disting.network.families import family_of
from disting.verdict.decisions import Decisions
from disting.verdict.joint import family_safety, joint_in_words
from disting.verdict.result import REPRESENTATIONS, Relation, query_of
from disting.verdict.sides import refuse_ports
from disting.verdict.verdict_list import decide_all, subjects_of

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
    text = "representation that may decide (default: all)"
    parser.add_argument("--representation", choices=REPRESENTATIONS, default="all", help=text)
    text = "Markov parameters G_0 and G_1..G_K to use (default: all that are needed)"
    parser.add_argument("--markov", type=whole(1), default=0, metavar="K", help=text)
    add_work(parser)


def run(options: argparse.Namespace) -> int:
    """Decide all pairs of one size, of several, or of a file."""
    if options.csv == options.json == "-":
        raise InputError(
            "one of --csv and --json can be standard output, not both: name a file for the other"
        )
    wanted = query_of(options.conditions, options.domain, options.representation, options.markov)
    file = options.masses if isinstance(options.masses, Listed) else None
    if file:
        refuse_chain_options(options)
    models = list_of(file) if file else None
    if not file:
        announce(pairs_work(is_damped(options)), pairs_by_size(options.masses), options.jobs)
    with engine_for(options) as (engine, pool, progress):
        if isinstance(file, str):
            recall(file, engine)
        subjects = subjects_of(models.models if models else _chains(options), engine)
        if file and file not in SHIPPED:
            announce_pairs(str(file), subjects, wanted, engine, options.jobs)
        decided = decide_all(
            subjects, wanted, engine, prove=options.prove, executor=pool, progress=progress
        )
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
            f"{damping_option(options.damped)} is supported for numbered chains only: write"
            ' "damped": true or'
            " false at the chains of the file"
        )
    if getattr(options, "quantity", Quantity.ACCELERATION) != Quantity.ACCELERATION:
        raise InputError(
            '--quantity is supported for numbered chains only: write "quantity" at the chains of'
            " the file"
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


def _chains(options: argparse.Namespace) -> list[Chain]:
    """Numbered chains, N:I."""
    quantity = Quantity(options.quantity)
    named = combined_family(options.masses, damped=is_damped(options), quantity=quantity)
    return [chain for _, chain in named]


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
