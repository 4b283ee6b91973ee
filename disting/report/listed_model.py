"""The page of one model of a list: its drawing, which others are the same, with their values as
formulas, its transfer function, what can be determined.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace

from markupsafe import Markup

from disting.equivalence.duplicates import duplicate
from disting.general import AnyModel, Model
from disting.general.any_model import measurand
from disting.model.structure import Sort
from disting.network.network import Network
from disting.report.environment import render
from disting.report.formulas import (
    Conditions,
    TransferFunction,
    Values,
    typeset,
    written_conditions,
    written_model,
    written_values,
)
from disting.report.listing import Card, Listing
from disting.report.model import reasons_apart
from disting.report.page_drawing import share
from disting.report.words import plural
from disting.verdict.meaning import meaning_sentence as shows
from disting.verdict.query import View
from disting.verdict.result import Relation, Verdict

MOST_TWINS = 12  # of which formulas are written
FEW = 24  # of which are seen at once
RANKS = (Relation.INDISTINGUISHABLE, Relation.SOMETIMES, Relation.UNDECIDED)
FUNCTIONS, LETTERS = {Sort.CIRCUIT: "impedance"}, {Sort.CIRCUIT: "Z"}
SEEN = {
    Sort.MACHINE: "experiment with this force and sensor",
    Sort.CIRCUIT: "measurement at this port",
    Sort.COMPARTMENTS: "experiment with this input and output",
}


@dataclass(frozen=True, slots=True)
class Twin:
    """A model that is not told from this one for all positive parameters: `said` in a sentence, its
    `values` in those of this one where formulas are known, and the `command` that gives numbers.
    `parts`: of the two models, this one first, where they have equivalents in the other one.
    `special`: what is told of special values, and the equations of these.
    """

    card: Card
    relation: Relation
    pair: str
    said: str
    values: tuple[Values, ...]
    command: str
    parts: tuple["Part", ...]
    special: str
    equations: tuple[Markup, ...]


@dataclass(frozen=True, slots=True)
class Part:
    """Which values of a model, called by its `label`, have equivalents in the `other` one: all, or
    those where any of the `conditions` hold.
    """

    label: str
    other: str
    everything: bool
    conditions: tuple[Conditions, ...]


def listed_model_page(shown: Listing, number: int, *, site: bool = False) -> str:
    """HTML of one model; beside it the style sheet that `write_model_list` writes is expected.
    `site`: whether the pages of the site stand around it.
    """
    listing, card = shown.found, shown.cards[number - 1]
    verdicts = {
        other: listing.verdict(min(number, other), max(number, other), View.POSITIVE)
        for other in range(1, len(shown.cards) + 1)
        if other != number
    }
    twins = [
        _twin(shown, number, other, v)
        for other, v in verdicts.items()
        if v.relation is not Relation.DISTINGUISHABLE
    ]
    twins.sort(key=lambda twin: RANKS.index(twin.relation))
    complex_same = [
        shown.cards[o - 1]
        for o in verdicts
        if listing.relation(number, o, View.EXACT) is Relation.INDISTINGUISHABLE
        and verdicts[o].relation is not Relation.INDISTINGUISHABLE
    ]
    network = card.model.network
    sort = _sort(network)
    return render(
        "listed-model.html",
        shown=shown,
        card=card,
        twins=twins,
        few=FEW,
        aside=any(v.has_exceptions for v in verdicts.values()),
        complex_same=complex_same,
        told_apart=reasons_apart(verdicts),
        held=share(c.drawing for c in (card, *(t.card for t in twins)) if c.drawing),
        transfers=_transfers(card.model, LETTERS.get(sort, "G")),
        unseen=network.unseen if network else (),
        function=FUNCTIONS.get(sort, "transfer function"),
        seen=SEEN[sort],
        last=len(shown.cards),
        site=site,
        plural=plural,
    )


def _sort(network: Network | None) -> Sort:
    """Which words are used of it; those of compartments suit any model."""
    if network is None:
        return Sort.COMPARTMENTS
    is_filter = network.sort is Sort.CIRCUIT and network.inputs != network.outputs
    return Sort.COMPARTMENTS if is_filter else network.sort


def _twin(shown: Listing, number: int, other: int, verdict: Verdict) -> Twin:
    low, high = sorted((number, other))
    named = replace(verdict, left=shown.label(low), right=shown.label(high))
    both = [shown.found.family[n - 1] for n in (low, high)]
    said = shows(named, measurand(both))
    names = shown.cards[number - 1].model.name, shown.cards[other - 1].model.name
    command = ""
    if shown.numbered:
        values = ",".join(f"{p}=.." for p in shown.cards[number - 1].model.parameters)
        command = f'disting equivalents "{names[0]}" --to "{names[1]}" --set {values}'
    special, equations = _special(shown, number, other)
    return Twin(
        shown.cards[other - 1],
        verdict.relation,
        f"{low}-{high}",
        said,
        _values(shown, number, other) if verdict.relation is Relation.INDISTINGUISHABLE else (),
        command,
        tuple(_parts(shown, number, other)),
        special,
        equations,
    )


def _special(shown: Listing, number: int, other: int) -> tuple[str, tuple[Markup, ...]]:
    special_values = shown.found.at_special_values(number, other)
    if special_values is None:
        return "", ()
    names = shown.label(number), shown.label(other)
    equations = tuple(typeset(s.polynomial) for s in special_values.lower)
    outer = names[1] if special_values.left_in_right else names[0]
    few = f" {outer} has fewer poles where" if equations else ""
    return f"{special_values.in_short(*names)}{few}", equations


def _parts(shown: Listing, number: int, other: int) -> Iterator[Part]:
    for pair in ((number, other), (other, number)):
        reach = shown.found.reached(*pair)
        if reach and reach.pieces:
            pieces = () if reach.is_everything else reach.pieces
            conditions = tuple(map(written_conditions, pieces))
            names = shown.label(pair[0]), shown.label(pair[1])
            yield Part(*names, reach.is_everything, conditions)


def _values(shown: Listing, number: int, other: int) -> tuple[Values, ...]:
    """Formulas for the values of another model, where it has finitely many."""
    listing, card = shown.found, shown.cards[other - 1]
    size = len(card.model.parameters)
    group = shown.cards[number - 1].groups[0]
    members = shown.domains[0].groups[group - 1] if group else ()
    if card.known.local.rank < size or len(members) > MOST_TWINS:
        return ()
    own_duplicate = duplicate(
        listing.decisions[View.POSITIVE], listing.family, number - 1, other - 1
    )
    return tuple(map(written_values, own_duplicate.formulas))


def _transfers(model: AnyModel, letter: str) -> list[tuple[str, TransferFunction]]:
    """The transfer functions that are not zero, each with what it leads from and to."""
    if isinstance(model, Model):
        return [("", written_model(model, letter))]
    return [
        (f"from input {k} to output {i}", written_model(entry, letter))
        for i, row in enumerate(model.rows, 1)
        for k, entry in enumerate(row, 1)
        if entry is not None
    ]
