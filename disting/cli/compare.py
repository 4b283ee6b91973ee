"""disting compare: one verdict, explained.

A pair of a shipped catalogue is looked up here. All other requests are handled in `decision`, with
the deciders: a look-up needs none of them.

Verdicts and both directions are reported in the same way by both.
"""

import argparse
from collections.abc import Iterable, Iterator, Sequence
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
from disting.cli.relations import in_colour
from disting.conditions.inclusion import Inclusion, InclusionFinding
from disting.evidence.positive import PositiveFinding
from disting.model.chain import Chain, Quantity, text_drawing
from disting.model.names import NAME, name_of, names_of, read, read_together
from disting.model.question import Domain
from disting.verdict.meaning import RESPONSE, meaning_sentence, undetermined_sentence
from disting.verdict.result import Query, Relation, Verdict, query_of

Known = tuple[str, int, int]
"""The name of a model, how much of it is determined, how many parameters it has."""


def explain(
    verdict: Verdict,
    drawn: list[str],
    items: Iterable[Known] | None = None,
    what: str = RESPONSE,
    everywhere: bool = False,
) -> str:
    """Relation, drawings, what cannot be determined of models that are distinguishable, what a
    measurement (of `what`) shows (`everywhere`: at special values too), sentence, evidence,
    certainty, domain, inclusion.
    """
    names = (verdict.left, verdict.right)
    width = max(map(len, names))
    drawings = [f"  {name:{width}}  {text}" for name, text in zip(names, drawn, strict=True)]
    heading = in_colour(verdict.relation.upper(), verdict.relation)
    lines = [heading, "", *drawings, ""]
    apart = verdict.relation is Relation.DISTINGUISHABLE
    unknown = list(
        filter(None, (undetermined_sentence(*parts) for parts in (apart and items) or ()))
    )
    lines += [*unknown, *([""] if unknown else [])]
    lines += [meaning_sentence(verdict, what, everywhere), "", verdict.sentence]
    if verdict.evidence:
        lines += [f"evidence   {verdict.evidence.formula}", f"certainty  {verdict.sure}"]
    lines.append(f"domain     {verdict.domain} parameters{_over_complex(verdict)}")
    return "\n".join([*lines, *_inclusion(verdict)])


def _over_complex(verdict: Verdict) -> str:
    """Beside a verdict over real or positive parameters, that over complex ones, where it is
    known.
    """
    if verdict.domain is Domain.COMPLEX or (
        verdict.closure is Inclusion.UNKNOWN and verdict.inclusions is None
    ):
        return ""
    complex_relation = (
        Relation.INDISTINGUISHABLE
        if verdict.closure is Inclusion.EQUAL
        else Relation.DISTINGUISHABLE
    )
    also = (
        "too"
        if verdict.relation is complex_relation
        else f"they are {complex_relation} (--domain complex)"
    )
    return f"; over complex ones {also}"


def _inclusion(verdict: Verdict) -> list[str]:
    """Lines on inclusion of models of unequal rank."""
    both = verdict.inclusions
    if both is None:
        return []
    lines = [f"inclusion  over complex parameters: {both.sentence(verdict.left, verdict.right)}"]
    if both.image == both.closure:
        return [*lines, f"why        {_why(both.closure, verdict)}"]
    return [
        *lines,
        f"image      {_why(both.image, verdict)}",
        f"closure    {_why(both.closure, verdict)}",
    ]


def _why(finding: InclusionFinding, verdict: Verdict) -> str:
    """Grade and evidence of one statement, or why it is not known."""
    if finding.evidence is None:
        return f"not known: {finding.reason}"
    sure = f", {finding.certainty.in_words(finding.safety)}" if finding.certainty else ""
    return f"{finding.inclusion}{sure}: {finding.evidence.sentence(verdict.left, verdict.right)}"


def both_ways(
    verdict: Verdict,
    where: str = "positive",
    shares: Sequence[PositiveFinding | None] = (),
) -> Iterator[str]:
    """Lines on the positive models of each side that have an equivalent on the other side, as far
    as known: from the verdict, or from the given shares of both sides, counted `where`.
    """
    names = (verdict.left, verdict.right)
    shares = shares or (verdict.left_positive, verdict.right_positive)
    for name, other, finding in zip(names, reversed(names), shares, strict=True):
        if finding is not None:
            why = finding.evidence.sentence(name, other) if finding.evidence else finding.reason
            sampled = f" ({finding.empirical.sentence})" if finding.empirical else ""
            yield f"{where}: {name} in {other} {finding.share}{sampled}. {why}"


def look_up(chains: Sequence[Chain], asked: Query) -> Verdict | None:
    """The stored verdict on two chains of a shipped catalogue, if all conditions may decide, under
    their whole names.
    """
    left, right = sorted((read(name_of(chain)) for chain in chains), key=lambda n: n.number)
    a, b = chains
    stored = (
        a.n_masses == b.n_masses in SHIPPED_SIZES
        and a.damped == b.damped
        and a.quantity is b.quantity is Quantity.ACCELERATION
        and left.is_plain
        and right.is_plain
        and left != right
        and asked == Query(asked.view)
    )
    if not stored:
        return None
    verdict = catalog(a.n_masses, damped=a.damped).verdict(left.number, right.number, asked.view)
    return replace(verdict, left=str(left), right=str(right))


def in_order(chains: Sequence[Chain], verdict: Verdict) -> list[Chain]:
    """The chains in the order of their verdict: a stored one names the model of the lower number
    first.
    """
    turned = verdict.left != names_of(chains[0], chains[1])[0]
    return list(reversed(chains)) if turned else list(chains)


def shipped_ranks(chains: Sequence[Chain]) -> tuple[Known, ...] | None:
    """Known ranks of two chains from their catalogues; None if no catalogue has them."""
    a, b = chains
    if not all(_is_shipped(chain) for chain in chains):
        return None
    records = (catalog(c.n_masses, damped=c.damped).record(read(name_of(c)).number) for c in chains)
    named = zip(names_of(a, b), records, strict=True)
    return tuple((name, r["rank"], len(r["parameters"])) for name, r in named)


def _is_shipped(chain: Chain) -> bool:
    """Return True if a catalogue contains the chain."""
    plain = replace(chain, ground_dampers=(), lag=False, dead_time=False) == chain
    acceleration = chain.quantity is Quantity.ACCELERATION
    return plain and acceleration and chain.n_masses in SHIPPED_SIZES


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
    text = "range of a parameter of both models to examine; may be repeated"
    add_bounds(parser, text)
    add_notation(parser)
    add_no_cache(parser)


def run(options: argparse.Namespace) -> int:
    """Explain the verdict on one pair."""
    texts = (options.left, options.right)
    more = options.json or options.bound or options.also or options.prove
    if not more and all(map(NAME.fullmatch, texts)):
        chains = read_together(texts, damped=options.damped, quantity=options.quantity)
        verdict = look_up(chains, query_of(options.conditions, options.domain))
        if verdict is not None:
            print("\n".join(_describe_stored(in_order(chains, verdict), verdict)))
            return 0
    from disting.cli.decision import run as decided

    return decided(options)


def _describe_stored(chains: Sequence[Chain], verdict: Verdict) -> list[str]:
    """A verdict that was looked up, in words."""
    ways = [] if verdict.proves_shares else both_ways(verdict)
    return [explain(verdict, list(map(text_drawing, chains)), shipped_ranks(chains)), *ways]
