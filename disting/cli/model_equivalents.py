"""The command `equivalents` of a network or of a model in a file: which others are equivalent, and
with which values.
"""

import argparse
from collections.abc import Iterator
from pathlib import Path

from disting.catalogs.network_files import recall_of
from disting.cli.arguments import split_reference
from disting.cli.model_names import stated_values
from disting.cli.output import emit, keep_apart
from disting.cli.workers import engine_for
from disting.conditions.rule import Outcome
from disting.equivalence.closed_forms import closed_forms
from disting.errors import InputError
from disting.files import Format, json_text
from disting.general import Alternatives, AnyModel, Extent, read_models
from disting.general.any_model import as_model, of_network
from disting.general.balls import POSITIVE, Synthesis
from disting.general.equivalent import spell
from disting.general.synthesis import NoFormulas
from disting.model.names import read_together
from disting.model.presentation import plural
from disting.model.question import Domain
from disting.network.families import family_of
from disting.network.notation import network_of, notations_of
from disting.verdict.engine import Progress
from disting.verdict.model_equivalents import ModelEquivalent, model_equivalents
from disting.verdict.result import Relation

OPEN = (Relation.UNDECIDED, Relation.SOMETIMES)


def run(options: argparse.Namespace) -> int:
    """Print the networks that are not distinguishable from one, with values where they are
    given.
    """
    if options.also:
        raise InputError(
            "of networks and models of a file values and formulas are listed, not experiments:"
            " leave --also away"
        )
    (given,) = _models_of(options.model, options)
    listed = map(of_network, family_of(options.family).networks) if options.family else ()
    named = _models_of(options.to, options) if options.to else []
    others = [model for model in (*listed, *named) if model.name != given.name]
    keep_apart(model.name for model in (given, *others))
    if [model.name for model in named] == [given.name]:  # which other values does it have
        others = named
    formulas = options.formulas or options.latex or options.sympy
    if formulas and options.values:
        raise InputError("formulas are for any values: leave --set away, or ask for values alone")
    values = None if formulas else stated_values(options.model, options) or None
    with engine_for(options) as (engine, _, progress):
        if options.family:
            recall_of(given, options.family, engine)
        equivalents = model_equivalents(given, others, values, engine=engine)
        written = list(_formulas(given, equivalents, options, progress)) if formulas else []
    if options.json:
        whole = {
            "format": Format.NETWORK_EQUIVALENTS.value,
            "given": given.name,
            "equivalents": [x.to_dict() for x in equivalents],
        }
        emit(options.json, json_text(whole, indent=1) + "\n")
        return 0
    other = "network" if given.network else "model"
    other = other if others == [given] else f"other {other}"
    head = _count_equivalents(given.name, plural(len(others), other), equivalents)
    print("\n".join([_mark(options) + head, *(written if formulas else _lines(equivalents))]))
    return 0


def _models_of(text: str, options: argparse.Namespace) -> list[AnyModel]:
    """Models that a text names: a network, a chain, file.json:name, or all models of file.json."""
    if text.endswith(".json"):
        return list(read_models(Path(text)))
    path, name = split_reference(text)
    if path:
        return [read_models(Path(path))[name]]
    if options.notation or notations_of(text):
        return [of_network(network_of(text, options.notation))]
    (chain,) = read_together([text], damped=options.damped)
    return [as_model(chain)]


def _count_equivalents(text: str, others: str, equivalents: list[ModelEquivalent]) -> str:
    """Sentence with the number of the others that are equivalent."""
    same = [x for x in equivalents if x.verdict.relation is Relation.INDISTINGUISHABLE]
    return (
        f"{text}: of {others} {len(same)} can do the same for all positive values,"
        f" {sum(x.verdict.relation is OPEN[1] for x in equivalents)} for some,"
        f" {sum(x.verdict.relation is OPEN[0] for x in equivalents)} undecided"
    )


def _lines(equivalents: list[ModelEquivalent]) -> Iterator[str]:
    """Each with its verdict and, where values are given, its own."""
    for x in equivalents:
        yield f"{x.model.name}  {x.verdict.in_words} ({x.verdict.rule or 'nothing settles it'})"
        if x.exponents:
            yield f"  {', '.join(f'{name} = {value}' for name, value in sorted(x.exponents))}"
        if x.values is not None:
            yield from (f"  {line}" for line in _values(x.values))
            if x.verdict.relation is Relation.INDISTINGUISHABLE:
                yield from (f"  {line}" for line in _exception(x.values))
        if x.synthesis is not None:
            yield from (f"  {line}" for line in _synthesis(x.synthesis))


def _exception(alternatives: Alternatives) -> Iterator[str]:
    """Why there is no positive set although both are equivalent for all positive values."""
    if alternatives.exist(Domain.POSITIVE) is Outcome.FAILS:
        yield (
            "these values are special, for almost all others there is one"
            if all(x > 0 for _, x in alternatives.values)
            else "given values are not all positive, which is what the verdict is about"
        )


def _mark(options: argparse.Namespace) -> str:
    """Prefix of a text line in output whose formulas are source."""
    return "% " if options.latex else "# " if options.sympy else ""


LONGEST = 16  # signs of a fraction; longer ones are rounded, and exact with --json
EXTENTS = {
    POSITIVE: "all positive ones, but for exchanges of branches that are alike",
    Extent.FAMILY: "and infinitely many more",
    Extent.UNKNOWN: "and perhaps more",
}


def _synthesis(synthesis: Synthesis) -> Iterator[str]:
    """Positive sets of values, and whether there are more."""
    for values in synthesis.sets:
        exact = {n: x for n, x in values.items() if len(str(x)) <= LONGEST}
        yield ", ".join(f"{n} = {spell(exact.get(n, float(x)))}" for n, x in values.items())
    yield EXTENTS[synthesis.extent]


def _formulas(
    model: AnyModel,
    equivalents: list[ModelEquivalent],
    options: argparse.Namespace,
    progress: Progress,
) -> Iterator[str]:
    """For each model that is equivalent for all positive values its values as formulas, or why none
    are known.
    """
    mark = _mark(options)
    for done, x in enumerate(equivalents):
        progress("formulas", done, len(equivalents))
        yield ""
        if x.verdict.relation is not Relation.INDISTINGUISHABLE:
            yield f"{mark}{x.model.name}: {x.verdict.in_words} (no formulas; --set gives values)"
            continue
        yield f"{mark}{x.model.name}   (primed)"
        try:
            forms = closed_forms(model, x.model, x.verdict)
        except NoFormulas as none:
            yield f"{mark}no formulas: {none} (--set gives values)"
            continue
        for number, form in enumerate(forms, 1):
            ways = f"{number} of {len(forms)}: " if len(forms) > 1 else ""
            yield f"{mark}{ways}{form.checked}"
            yield from (f"{mark}{name}' = {same}" for name, same in sorted(x.exponents))
            yield from (f"{mark}where {g} > 0" for g in form.where)
            if form.seen:
                yield f"{mark}{form.seen}; for your values see --set"
            if form.chosen:
                yield f"{mark}chosen, other numbers may do the same: {', '.join(form.chosen)}"
            yield from (
                f"{mark}{', '.join(names)}: one choice of infinitely many, what can be shared in"
                " any proportion is shared equally"
                for names in form.choices
            )
            yield form.latex if options.latex else form.python if options.sympy else form.text


def _values(alternatives: Alternatives) -> Iterator[str]:
    """All positive sets of values, or some with what is known of the others."""
    positive = alternatives.within(Domain.POSITIVE)
    if not positive:
        yield alternatives.sentence
    yield from map(str, positive)
    if positive and alternatives.extent is Extent.FAMILY:
        yield "and infinitely many more"
    if positive and alternatives.extent is Extent.UNKNOWN:
        yield "and perhaps more"
