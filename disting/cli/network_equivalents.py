"""The command `equivalents` of a network: which others do the same, and with which values."""

import argparse
import json
from collections.abc import Iterator

from disting.cli.output import emitted
from disting.cli.plain import keep_apart
from disting.cli.workers import engine_for
from disting.equivalence import assignments
from disting.errors import InputError
from disting.general.alternatives import Alternatives
from disting.general.fibre import Extent
from disting.model.presentation import plural
from disting.model.question import Domain
from disting.network.families import family_of
from disting.network.notation import network_of
from disting.schemas import Format
from disting.verdict.network_equivalents import NetworkEquivalent, network_equivalents
from disting.verdict.result import Relation

OPEN = (Relation.UNDECIDED, Relation.SOMETIMES)


def run(options: argparse.Namespace) -> int:
    """Print the networks that are not told apart from one, with values where they are given."""
    if options.also or options.formulas or options.latex or options.sympy:
        raise InputError(
            "of networks values are listed, not formulas or experiments: leave --also, --formulas,"
            " --latex and --sympy away"
        )
    given = network_of(options.model, options.notation)
    listed = family_of(options.family).networks if options.family else ()
    named = [network_of(options.to, options.notation)] if options.to else []
    others = [network for network in (*listed, *named) if network != given]
    keep_apart(network.name for network in (given, *others))
    values = assignments(options.values) if options.values else None
    with engine_for(options) as (engine, _, _progress):
        found = network_equivalents(given, others, values, engine=engine)
    if options.json:
        whole = {
            "format": Format.NETWORK_EQUIVALENTS.value,
            "given": given.name,
            "equivalents": [x.to_dict() for x in found],
        }
        emitted(options.json, json.dumps(whole, indent=1, ensure_ascii=False) + "\n")
        return 0
    print("\n".join(_lines(given.name, len(others), found)))
    return 0


def _lines(given: str, count: int, found: list[NetworkEquivalent]) -> Iterator[str]:
    same = [x for x in found if x.verdict.relation is Relation.INDISTINGUISHABLE]
    yield (
        f"{given}: of {plural(count, 'other network')} {len(same)} can do the same for all positive"
        f" values, {sum(x.verdict.relation is OPEN[1] for x in found)} for some,"
        f" {sum(x.verdict.relation is OPEN[0] for x in found)} undecided"
    )
    for x in found:
        yield f"{x.network.name}  {x.verdict.told} ({x.verdict.rule or 'nothing settles it'})"
        if x.exponents:
            yield f"  {', '.join(f'{name} = {value}' for name, value in sorted(x.exponents))}"
        if x.values is not None:
            yield from (f"  {line}" for line in _values(x.values))


def _values(found: Alternatives) -> Iterator[str]:
    """All positive sets of values, or some with what is known of the others."""
    positive = found.within(Domain.POSITIVE)
    if not positive:
        yield found.sentence
    yield from map(str, positive)
    if positive and found.extent is Extent.FAMILY:
        yield "and infinitely many more"
    if positive and found.extent is Extent.UNKNOWN:
        yield "and perhaps more"
