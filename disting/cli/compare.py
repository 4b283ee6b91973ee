"""disting compare: one verdict, explained.

A pair of a shipped catalogue is looked up here. Whatever else is asked for is decided in
`decision`, with all that decides: a look-up needs none of it.
"""

import argparse
from collections.abc import Sequence
from dataclasses import replace

from disting.catalogs import catalog
from disting.catalogs.files import SHIPPED_SIZES
from disting.cli.arguments import (
    MODEL,
    add_also,
    add_bounds,
    add_damped,
    add_deciding,
    add_json,
    add_no_cache,
    add_notation,
    add_quantity,
)
from disting.cli.compare_words import Known, both_ways, explained
from disting.cli.relations import query
from disting.model.chain import Chain, Sensor, text_drawing
from disting.model.names import NAME, chains_named, name_of, names_of, read
from disting.verdict.query import Query, View
from disting.verdict.result import Verdict


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
    texts = (options.left, options.right)
    more = options.json or options.bound or options.also or options.prove
    if not more and all(map(NAME.fullmatch, texts)):
        chains = chains_named(texts, damped=options.damped, sensor=options.quantity)
        verdict = shipped(chains, query(options.conditions, View.EXACT, options.domain))
        if verdict is not None:
            print("\n".join(_told(in_order(chains, verdict), verdict)))
            return 0
    from disting.cli.decision import run as decided

    return decided(options)


def _told(chains: Sequence[Chain], verdict: Verdict) -> list[str]:
    """A verdict that was looked up, in words."""
    ways = [] if verdict.proves_shares else both_ways(verdict)
    return [explained(verdict, list(map(text_drawing, chains)), shipped_ranks(chains)), *ways]


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


def in_order(chains: Sequence[Chain], verdict: Verdict) -> list[Chain]:
    """The chains in the order of their verdict: a stored one names the model of the lower number
    first.
    """
    turned = verdict.left != names_of(chains[0], chains[1])[0]
    return list(reversed(chains)) if turned else list(chains)


def shipped_ranks(chains: Sequence[Chain]) -> tuple[Known, ...] | None:
    """How much of two chains is determined, as their catalogues have it; None if none tells of
    them.
    """
    a, b = chains
    if not all(_is_shipped(chain) for chain in chains):
        return None
    records = (catalog(c.n_masses, damped=c.damped).record(read(name_of(c)).number) for c in chains)
    named = zip(names_of(a, b), records, strict=True)
    return tuple((name, r["rank"], len(r["parameters"])) for name, r in named)


def _is_shipped(chain: Chain) -> bool:
    """Whether a catalogue tells of it."""
    plain = replace(chain, ground_dampers=(), lag=False, dead_time=False) == chain
    acceleration = chain.sensor is Sensor.ACCELERATION
    return plain and acceleration and chain.n_masses in SHIPPED_SIZES
