"""disting compare: one verdict, explained.

A pair of a shipped catalogue is looked up here. Whatever else is asked for is decided in
`decision`, with all that decides: a look-up needs none of it.
"""

import argparse
from collections.abc import Sequence

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
from disting.cli.compare_words import both_ways, explain
from disting.cli.look_up import in_order, look_up, shipped_ranks
from disting.cli.relations import query
from disting.model.chain import Chain, text_drawing
from disting.model.names import NAME, read_together
from disting.verdict.query import View
from disting.verdict.result import Verdict


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of the command."""
    parser.add_argument("left", metavar="N:I", help=MODEL)
    text = "the other model, of the same or another size"
    parser.add_argument("right", metavar="M:J", help=text)
    add_damped(parser)
    add_also(parser)
    add_json(parser, "the verdict with all that 'disting verify' needs", alone=True)
    add_quantity(parser)
    add_deciding(parser)
    text = "look only at models within this range of a parameter, of both models; may be repeated"
    add_bounds(parser, text)
    add_notation(parser)
    add_no_cache(parser)


def run(options: argparse.Namespace) -> int:
    """Explain the verdict on one pair."""
    texts = (options.left, options.right)
    more = options.json or options.bound or options.also or options.prove
    if not more and all(map(NAME.fullmatch, texts)):
        chains = read_together(texts, damped=options.damped, sensor=options.quantity)
        verdict = look_up(chains, query(options.conditions, View.EXACT, options.domain))
        if verdict is not None:
            print("\n".join(_told(in_order(chains, verdict), verdict)))
            return 0
    from disting.cli.decision import run as decided

    return decided(options)


def _told(chains: Sequence[Chain], verdict: Verdict) -> list[str]:
    """A verdict that was looked up, in words."""
    ways = [] if verdict.proves_shares else both_ways(verdict)
    return [explain(verdict, list(map(text_drawing, chains)), shipped_ranks(chains)), *ways]
