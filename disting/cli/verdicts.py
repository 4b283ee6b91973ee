"""disting verdicts: all pairs of one size, or of several sizes together."""

import argparse
from itertools import combinations

from disting.catalogs.combined import combined_family
from disting.catalogs.export import decisions_csv, decisions_json
from disting.cli.common import (
    VIEWS,
    emitted,
    joint_in_words,
    query,
    relations_in_words,
    rules_in_words,
)
from disting.cli.workers import engine_for
from disting.errors import InputError
from disting.model.chain import Sensor
from disting.questions.inclusion import ONE_SIDED, Sense
from disting.verdict import Decisions, family_safety
from disting.verdict.proof import prove_all


def run(options: argparse.Namespace) -> int:
    """Decide all pairs of one size, or of several."""
    if options.csv == options.json == "-":
        raise InputError(
            "one of --csv and --json can be standard output, not both: name a file for the other"
        )
    asked = query(options.conditions, VIEWS[options.representation], options.domain, options.markov)
    named = combined_family(options.masses, damped=options.damped, sensor=Sensor(options.sensor))
    if len(options.masses) == 1:
        named = tuple((f"A{number}", chain) for number, (_, chain) in enumerate(named, 1))
    with engine_for(options) as (engine, pool, progress):
        subjects = [engine.subject(name, chain) for name, chain in named]
        decided = engine.decisions(subjects, asked, executor=pool, progress=progress)
        if options.prove:
            decided = prove_all(decided, progress=progress)
    if options.csv:
        emitted(options.csv, decisions_csv(decided))
    if options.json:
        emitted(options.json, decisions_json(decided))
    if "-" not in (options.csv, options.json):
        print(_summary(decided))
    return 0


def _summary(decided: Decisions) -> str:
    """How many pairs are what, and by which rule; of several sizes, how many smaller models lie
    in larger ones.
    """
    pairs = list(combinations(range(len(decided.subjects)), 2))
    head = (
        f"{len(decided.subjects)} models, {len(pairs)} pairs, over {decided.query.view.domain}"
        " parameters"
    )
    relations = relations_in_words(decided.relation(i, j) for i, j in pairs)
    told = (
        f"{head}: {relations}\ndecided:"
        f" {rules_in_words(decided.counts(), decided.query.view.domain)}"
    )
    inside = sum(_lies_in_larger(decided, i, j) for i, j in decided.inclusions)
    limits = (
        f"\nover complex parameters: {inside} smaller models are limits of larger ones"
        if inside
        else ""
    )
    return f"{told}{limits}\n{joint_in_words(family_safety(decided))}"


def _lies_in_larger(decided: Decisions, i: int, j: int) -> bool:
    """Whether the smaller model lies in the one with more masses."""
    sizes = decided.sizes
    return (
        len(sizes) > 0
        and sizes[i] != sizes[j]
        and decided.inclusion(i, j, Sense.CLOSURE) in ONE_SIDED
    )
