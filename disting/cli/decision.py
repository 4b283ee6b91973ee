"""A pair that no shipped catalogue holds, or for which more is requested than a catalogue holds:
decided, proven, under experiments, within ranges, as a file.
"""

import argparse
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from disting.cli.compare import Known, both_ways, explain, in_order, look_up, shipped_ranks
from disting.cli.model_names import in_letters, models_of
from disting.cli.output import emit
from disting.cli.workers import engine_for, told_if_long
from disting.errors import InputError
from disting.experiments import Experiment, MeasuredChain, Places, move, parse_experiment
from disting.files import json_text
from disting.general.any_model import measurand
from disting.general.matrix_model import AnyModel
from disting.general.naming import has_free_name
from disting.general.special_values import SpecialValues, special_values
from disting.model.chain import Chain, text_drawing
from disting.model.question import Domain, Settings
from disting.network.denotation import FREE_NAMES
from disting.verdict.comparison import compare, positive_shares, prove
from disting.verdict.placement_verdicts import (
    AllPlacements,
    Answer,
    compare_everywhere,
    everywhere_file,
)
from disting.verdict.result import Query, Relation, Verdict, query_of
from disting.verdict.sides import determinable, names_beside
from disting.verdict.verdict_file import StoredVerdict, as_file, exact, has_more

LONGER = "this pair takes longer than most; Ctrl-C stops it"
LESS = "; faster: --domain complex, which considers complex values only"


def run(options: argparse.Namespace) -> int:
    """Explain the verdict on one pair."""
    if options.json and options.bound:
        raise InputError("--json is not supported with --bound; remove one of them")
    sides = models_of((options.left, options.right), options)
    wanted = query_of(options.conditions, options.domain)
    if options.also:
        return _under_experiments(sides, wanted, options)
    judgement = judge(sides, wanted, options)
    if options.json:
        _write_file(file_of(judgement, wanted, options), options)
    if options.json != "-":
        print("\n".join(_describe(judgement, dict(options.bound))))
    return 0


@dataclass(frozen=True, slots=True)
class Judgement:
    """Two models in the order of their verdict, and how much of each is determined."""

    models: tuple[Chain | AnyModel, Chain | AnyModel]
    verdict: Verdict
    known: tuple[Known, ...]


def judge(
    sides: Sequence[Chain | AnyModel], asked: Query, options: argparse.Namespace
) -> Judgement:
    """The verdict on two models, from the shipped catalogues or decided, and proven where that is
    requested.
    """
    less = LESS if asked.view.domain is not Domain.COMPLEX else ""
    with told_if_long(LONGER + less):
        chains = _chains(sides)
        verdict = look_up(chains, asked) if chains else None
        ranks = shipped_ranks(chains) if chains else None
        if verdict is None or ranks is None:
            with engine_for(options) as (engine, _, _progress):
                verdict = verdict or compare(*sides, query=asked, engine=engine)
                ranks = ranks or determinable(sides[0], sides[1], engine)
        left, right = in_order(chains, verdict) if chains else sides
        verdict = prove(verdict, left, right) if options.prove else verdict
        return Judgement((left, right), verdict, ranks)


def verdict_file(texts: Sequence[str], options: argparse.Namespace) -> dict[str, Any]:
    """The verdict on two models, as they are named, with all that its check needs."""
    sides = models_of(texts, options)
    wanted = query_of(options.conditions, options.domain)
    if not options.also:
        return file_of(judge(sides, wanted, options), wanted, options)
    left, right = sides
    with engine_for(options) as (engine, _, _progress):
        return everywhere_file(left, right, options.also, query=wanted, engine=engine)


def file_of(judgement: Judgement, asked: Query, options: argparse.Namespace) -> dict[str, Any]:
    """The verdict on two models with all that its check needs."""
    beside = None
    if has_more(judgement.verdict):
        beside = judge(judgement.models, exact(asked), options).verdict
    return as_file(
        StoredVerdict(judgement.models, (), asked, Settings(), judgement.verdict, beside)
    )


def _write_file(whole: dict[str, Any], options: argparse.Namespace) -> None:
    emit(options.json, json_text(whole, indent=1) + "\n")


def _describe(judgement: Judgement, limits: Mapping[str, tuple[str, str]]) -> Iterator[str]:
    """The verdict in words, within ranges if there are any."""
    verdict, chains = judgement.verdict, _chains(judgement.models)
    special = _at_special_values(judgement.models, verdict)
    drawn, everywhere = (
        list(map(in_letters, judgement.models)),
        special is not None and special.is_same,
    )
    yield explain(verdict, drawn, judgement.known, measurand(judgement.models), everywhere)
    sentence = special.sentence(verdict.left, verdict.right) if special else ""
    yield from [f"special    {sentence}"] if sentence else []
    if chains and limits:
        shares = positive_shares(*chains, bound=limits)
        yield from both_ways(verdict, "within the ranges", shares)
    elif chains and not verdict.proves_shares:
        yield from both_ways(verdict)
    if has_free_name(model for model in judgement.models if not isinstance(model, Chain)):
        yield f"names      {FREE_NAMES}"


def _at_special_values(sides: Sequence[Chain | AnyModel], verdict: Verdict) -> SpecialValues | None:
    """The second answer, on all positive values, where the verdict leaves special ones out."""
    models = [side for side in sides if not isinstance(side, Chain)]
    matters = verdict.has_exceptions or verdict.relation is Relation.DISTINGUISHABLE
    if verdict.domain is Domain.POSITIVE and len(models) == len(sides) and matters:
        return special_values(*models)
    return None


def _chains(sides: Sequence[Chain | AnyModel]) -> list[Chain]:
    """Both, if both are chains; else none."""
    chains = [side for side in sides if isinstance(side, Chain)]
    return chains if len(chains) == len(sides) else []


def _under_experiments(
    sides: Sequence[Chain | AnyModel], asked: Query, options: argparse.Namespace
) -> int:
    """Explain the results of further experiments, those of the unmodified models included."""
    left, right = sides
    with engine_for(options) as (engine, _, _progress):
        if options.json:
            whole = everywhere_file(left, right, options.also, query=asked, engine=engine)
            _write_file(whole, options)
        if options.json == "-":
            return 0
        placements = compare_everywhere(left, right, options.also, query=asked, engine=engine)
    asked_for = [parse_experiment(text).experiment for text in options.also]
    experiments = list(dict.fromkeys(experiment.text for experiment in asked_for))
    lines = [f"experiment {i}  {text}" for i, text in enumerate(["as it is", *experiments], 1)]
    print("\n".join([*_every_way(placements, sides, asked_for), "", *lines]))
    return 0


def _every_way(
    placements: AllPlacements,
    models: Sequence[Chain | AnyModel],
    experiments: Sequence[Experiment],
) -> Iterator[str]:
    """One way in full, several with what is common to them; the same chain is drawn with the
    experiments of each side.
    """
    left, right = names_beside(*models)
    chains = _chains(models)
    if len(placements.verdicts) == 1:
        places, verdict = placements.verdicts[0]
        drawings = list(map(in_letters, models))
        if left == right and chains:
            sides = experiments, [move(e, places) for e in experiments]
            drawings = [_draw_experiments(chains[0], side) for side in sides]
        yield explain(verdict, drawings)
        yield from (f"note       {note}" for note in verdict.notes if verdict.evidence)
        yield f"places     {_map_masses(places, left, right)}"
        return
    other = f"the other {right}" if left == right else right
    phrase = {
        Answer.SURELY: "distinguishable, wherever the places are in {}",
        Answer.NEVER: "indistinguishable, wherever the places are in {}",
        Answer.DEPENDS: "distinguishable or not, depending on where the places are in {}",
        Answer.UNKNOWN: "not known for all places in {}",
    }[placements.answer]
    yield f"{placements.answer.upper()}: {left} and {other} are {phrase.format(other)}"
    yield ""
    for places, verdict in placements.verdicts:
        yield f"  {_map_masses(places, left, other)}: {verdict.sentence}"
        yield from (f"    {note}" for note in verdict.notes if verdict.evidence)


def _draw_experiments(chain: Chain, experiments: Sequence[Experiment]) -> str:
    """A chain as it is, and where force and sensor are in each of the experiments."""
    ports = (entry.attached for entry in MeasuredChain(chain, tuple(experiments)).entries)
    drawings = (text_drawing(chain), *(text_drawing(chain, each) for each in ports))
    return " | ".join(dict.fromkeys(drawings))


def _map_masses(places: Places, left: str, right: str) -> str:
    """Sentence that maps the masses of one chain to those of the other."""
    pairs = ", ".join(f"{a}/{b}" for a, b in places)
    return f"masses {pairs} of {left}/{right}"
