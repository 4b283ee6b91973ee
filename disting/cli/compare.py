"""disting compare: one verdict, explained."""

import argparse
import json
from collections.abc import Iterator, Sequence
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
    add_quantity,
)
from disting.cli.colour import in_colour
from disting.cli.common import query
from disting.cli.output import emitted
from disting.cli.plain import keep_apart
from disting.cli.verdicts import refuse_chain_options
from disting.cli.workers import engine_for
from disting.errors import InputError, listed
from disting.experiments import Experiment, MeasuredChain, Places, moved, named
from disting.general import AnyModel, MatrixModel, as_chain, read_models
from disting.model.chain import Chain, Sensor
from disting.model.domain import Domain
from disting.model.drawing import text_drawing
from disting.model.names import chains_named, name_of, read
from disting.model.settings import Settings
from disting.questions.inclusion import Inclusion, InclusionFinding
from disting.verdict import Query, Relation, Verdict, View
from disting.verdict.comparison import compare, names_of
from disting.verdict.everywhere import Answer, Everywhere, compare_everywhere
from disting.verdict.everywhere_file import everywhere_file
from disting.verdict.proof import prove
from disting.verdict.shown import shown
from disting.verdict.verdict_file import Stored, as_file, exact, has_more, verdict_file

FILE = ".json:"  # between a file and the name of a model in it
MOST_TERMS = 30  # of a transfer function that is written out
MODEL = (
    "a model: masses:number, as 'disting models' lists it; +b2: with a damper from mass 2 to the"
    " ground; +lag; +delay; or file.json:name, a model of your own"
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
        print(_explained(found, list(map(_in_letters, sides))))
        return 0
    chains, verdict = decided(chains, asked, options)
    ways = _both_ways(verdict, chains, dict(options.bound)) if _tells_ways(verdict, options) else ()
    print("\n".join([_explained(verdict, list(map(text_drawing, chains))), *ways]))
    return 0


def file_of(texts: Sequence[str], options: argparse.Namespace) -> dict[str, Any]:
    """The verdict on two models, as they are named, with all that its check needs."""
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
    """Two chains, or models of files, named file.json:name, or one and a chain."""
    if not any(FILE in text for text in texts):
        if options.also and (options.prove or getattr(options, "bound", ())):
            raise InputError(
                "with --also the verdict is on several experiments: leave --prove and --bound away"
            )
        return [*chains_named(texts, damped=options.damped, sensor=options.quantity)]
    if options.also:
        raise InputError("--also belongs to chains: a model of a file has no masses to name")
    for name in ("bound", "prove"):
        if getattr(options, name, ()):
            raise InputError(f"--{name} belongs to numbered chains: leave it away")
    if all(FILE in text for text in texts):
        refuse_chain_options(options)
    rest = [text for text in texts if FILE not in text]
    named = iter(chains_named(rest, damped=options.damped, sensor=options.quantity))
    lists = {path: read_models(path) for path, _ in map(_parted, texts) if path}
    keep_apart(model.name for found in lists.values() for model in found)
    return [lists[path][name] if path else next(named) for path, name in map(_parted, texts)]


def _chains(sides: Sequence[Chain | AnyModel]) -> list[Chain]:
    """Both, if both are chains; else none."""
    chains = [side for side in sides if isinstance(side, Chain)]
    return chains if len(chains) == len(sides) else []


def _parted(text: str) -> tuple[str, str]:
    """A file and the name of a model in it; "" and the text where it names a chain."""
    path, mark, name = text.partition(FILE)
    return (f"{path}{FILE[:-1]}", name) if mark else ("", text)


def _in_letters(side: Chain | AnyModel) -> str:
    """A chain's drawing, or a transfer function that fits a few lines."""
    if isinstance(side, Chain):
        return text_drawing(side)
    chain = as_chain(side)
    if chain is not None:
        return text_drawing(chain)
    entries = side.entries if isinstance(side, MatrixModel) else (side,)
    parts = [terms for e in entries for terms in (*e.numerator_terms, *e.denominator_terms)]
    if sum(map(len, parts)) <= MOST_TERMS:
        return str(side)
    if isinstance(side, MatrixModel):
        return "G(s) with {} outputs and {} inputs".format(*side.shape)
    return "G(s) of degree {} over {}".format(*side.degrees)


def _under_experiments(chains: Sequence[Chain], asked: Query, options: argparse.Namespace) -> int:
    """Explain what further experiments tell, the chains as they are included."""
    left, right = chains
    with engine_for(options) as (engine, _, _progress):
        found = compare_everywhere(left, right, options.also, query=asked, engine=engine)
    asked_for = [named(text).experiment for text in options.also]
    experiments = list(dict.fromkeys(experiment.text for experiment in asked_for))
    lines = [f"experiment {i}  {text}" for i, text in enumerate(["as it is", *experiments], 1)]
    print("\n".join([*_every_way(found, chains, asked_for), "", *lines]))
    return 0


def _every_way(
    found: Everywhere, chains: Sequence[Chain], experiments: Sequence[Experiment]
) -> Iterator[str]:
    """One way in full, several with what is common to them; one and the same chain is drawn with
    the experiments of each side.
    """
    left, right = names_of(*chains)
    if len(found.verdicts) == 1:
        places, verdict = found.verdicts[0]
        drawings = list(map(text_drawing, chains))
        if left == right:
            sides = experiments, [moved(e, places) for e in experiments]
            drawings = [_drawn(chains[0], side) for side in sides]
        yield _explained(verdict, drawings)
        yield from (f"note       {note}" for note in verdict.notes if verdict.evidence)
        yield f"places     {_placed(places, left, right)}"
        return
    other = f"the other {right}" if left == right else right
    told = {
        Answer.SURELY: "told apart, wherever the places are in {}",
        Answer.NEVER: "not told apart, wherever the places are in {}",
        Answer.DEPENDS: "told apart or not, depending on where the places are in {}",
        Answer.UNKNOWN: "not known for all places in {}",
    }[found.answer]
    yield f"{found.answer.upper()}: {left} and {other} are {told.format(other)}"
    yield ""
    for places, verdict in found.verdicts:
        yield f"  {_placed(places, left, other)}: {verdict.sentence}"
        yield from (f"    {note}" for note in verdict.notes if verdict.evidence)


def _drawn(chain: Chain, experiments: Sequence[Experiment]) -> str:
    """A chain as it is, and where force and sensor are in each of the experiments."""
    ports = (entry.attached for entry in MeasuredChain(chain, tuple(experiments)).entries)
    drawings = (text_drawing(chain), *(text_drawing(chain, each) for each in ports))
    return " | ".join(dict.fromkeys(drawings))


def _placed(places: Places, left: str, right: str) -> str:
    """Which mass is which."""
    pairs = ", ".join(f"{a}/{b}" for a, b in places)
    return f"masses {pairs} of {left}/{right}"


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
    return ordered, prove(found, ordered[0], ordered[1]) if options.prove else found


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


def _both_ways(
    verdict: Verdict, chains: list[Chain], limits: dict[str, tuple[str, str]]
) -> Iterator[str]:
    """Which positive models of each side, within ranges if there are any, have an equivalent on
    the other side.

    Without ranges that is told where the verdict tells it.
    """
    from disting.questions.positive import ranges, within_ranges

    unknown = set(limits) - {name for chain in chains for name in chain.parameters}
    if unknown:
        raise InputError(f"no parameter of the two models is called {listed(sorted(unknown))}")
    sides = list(
        zip(
            (verdict.left, verdict.right),
            chains,
            (verdict.left_positive, verdict.right_positive),
            strict=True,
        )
    )
    for (name, given, known), (other_name, other, _) in (sides, sides[::-1]):
        boxes = (
            {n: limits[n] for n in chain.parameters if n in limits} for chain in (given, other)
        )
        found = within_ranges(given, other, ranges(*boxes)) if limits else known
        if found is None:
            continue
        where = "within the ranges" if limits else "positive"
        why = found.evidence.sentence(name, other_name) if found.evidence else found.reason
        seen = f" ({found.empirical.sentence})" if found.empirical else ""
        yield f"{where}: {name} in {other_name} {found.share}{seen}. {why}"


def _explained(verdict: Verdict, drawn: list[str]) -> str:
    """Relation, drawings, sentence, evidence, certainty, domain, inclusion."""
    names = (verdict.left, verdict.right)
    width = max(map(len, names))
    drawings = [f"  {name:{width}}  {text}" for name, text in zip(names, drawn, strict=True)]
    heading = in_colour(verdict.relation.upper(), verdict.relation)
    lines = [heading, "", *drawings, ""]
    if verdict.evidence:
        lines += [shown(verdict), ""]
    lines.append(verdict.sentence)
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
    """What is said of models of unequal rank."""
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


def _why(found: InclusionFinding, verdict: Verdict) -> str:
    """Grade and evidence of one statement, or why it is not known."""
    if found.evidence is None:
        return f"not known: {found.reason}"
    sure = f", {found.certainty.in_words(found.safety)}" if found.certainty else ""
    return f"{found.inclusion}{sure}: {found.evidence.sentence(verdict.left, verdict.right)}"
