"""Records of a catalogue. Of a pair: which step decides in which view, and the verdict that it
holds; of a model: its row.

Over positive parameters nothing is stored but the shares of both sides, from which the verdict
follows.
"""

from dataclasses import dataclass
from typing import Any

from disting.algebra.certainty import Certainty
from disting.catalogs.files import INCLUSIONS, LEFT_POSITIVE, RIGHT_POSITIVE, Record
from disting.conditions.finding import NOT_REAL, positive_ways
from disting.conditions.inclusion import Inclusion, inclusions_from_dict
from disting.conditions.rule import RULES, Role, Stage
from disting.evidence.kinds import evidence_from
from disting.evidence.positive import PositiveFinding
from disting.model.chain import Chain, Premise
from disting.model.family import Family
from disting.model.presentation import summary
from disting.model.question import Domain
from disting.questions.identifiability.answer import Identifiability
from disting.verdict.query import View
from disting.verdict.result import Relation, Step, Verdict, open_note

INDEX_NAMES = ("gap", "act_minus", "act_plus", "meas_minus", "meas_plus")


def stored_verdict(
    record: Record, view: View, names: tuple[str, str], premises: tuple[Premise, Premise]
) -> Verdict:
    """The verdict of a view with all that the record says of the pair, which it names so."""
    (where, step), relations = deciding(record, view), _both_ways(record, view)
    if not step:
        return Verdict(
            *names,
            Relation.UNDECIDED,
            domain=view.domain,
            notes=_notes(record, view),
            premises=premises,
            **relations,
        )
    return Verdict(
        *names,
        relation_of(step),
        step["decided_by"],
        where,
        Certainty(step["certainty"]),
        step["safety"],
        evidence_from(step["evidence"]),
        view.domain,
        premises=premises,
        **relations,
    )


def _both_ways(record: Record, view: View) -> dict[str, Any]:
    """What a verdict says of inclusions and shares, where its view looks at the parameters."""
    settled = relation_of(deciding(record, View.EXACT)[1])
    if Stage.FIBRE not in view.representations or settled is Relation.UNDECIDED:
        return {}
    here, there = _shares(record)
    if INCLUSIONS in record:
        both = inclusions_from_dict(record[INCLUSIONS])
        image, closure = both.image.inclusion, both.closure.inclusion
    else:
        both = None
        image = closure = (
            Inclusion.EQUAL if settled is Relation.INDISTINGUISHABLE else Inclusion.NEITHER
        )
    return {
        "left_positive": here,
        "right_positive": there,
        "image": image,
        "closure": closure,
        "inclusions": both,
    }


def deciding(record: Record, view: View) -> tuple[Stage, dict[str, Any]]:
    """The first representation of the view that decides, and its step; NONE and {} if none does."""
    if view is View.POSITIVE:
        return _positively(record)
    if view is View.REAL:
        return (
            (Stage.PARAMETERS, record[view.value])
            if view.value in record
            else _distinguishing(record)
        )
    return next(((r, record[r]) for r in view.representations if r in record), (Stage.NONE, {}))


def relation_of(step: dict[str, Any]) -> Relation:
    """Relation that a step decides."""
    if not step:
        return Relation.UNDECIDED
    if "relation" in step:
        return Relation(step["relation"])
    return (
        Relation.DISTINGUISHABLE
        if RULES[step["decided_by"]].role is Role.NECESSARY
        else Relation.INDISTINGUISHABLE
    )


def _positively(record: Record) -> tuple[Stage, dict[str, Any]]:
    """What the shares of both sides give, if they are indistinguishable over complex parameters."""
    here, there = _shares(record)
    if here is None or there is None:
        return _distinguishing(record)
    f = positive_ways(here, there)
    if f.evidence is None:
        return Stage.NONE, {}
    relation = Step(Stage.PARAMETERS, f).relation.value
    plain = {
        "relation": relation,
        "decided_by": f.rule.name,
        "certainty": f.certainty.value,
        "safety": f.safety,
    }
    return Stage.PARAMETERS, plain | {"evidence": f.evidence.to_dict()}


def _distinguishing(record: Record) -> tuple[Stage, dict[str, Any]]:
    """What distinguishes over complex parameters does so over all."""
    where, step = deciding(record, View.EXACT)
    return (where, step) if relation_of(step) is Relation.DISTINGUISHABLE else (Stage.NONE, {})


def _notes(record: Record, view: View) -> tuple[str, ...]:
    """Why a pair is undecided."""
    if view.domain is Domain.COMPLEX:
        return ("the exact decision has no method for them",) if view is View.EXACT else ()
    here, there = _shares(record)
    if view is View.POSITIVE and here is not None and there is not None:
        return (open_note(positive_ways(here, there).note),)
    return (open_note(NOT_REAL),) if deciding(record, View.EXACT)[1] else ()


def _shares(record: Record) -> tuple[PositiveFinding | None, PositiveFinding | None]:
    """Positive equivalents of the left and of the right model, where they are asked for."""
    here, there = (record.get(name) for name in (LEFT_POSITIVE, RIGHT_POSITIVE))
    return PositiveFinding.from_dict(here) if here else None, (
        PositiveFinding.from_dict(there) if there else None
    )


@dataclass(frozen=True, slots=True)
class ModelRow:
    """A model as Table 3 lists it; `rank` = determinable parameters, `group` = its group in
    `classes()` or 0.

    >>> from disting.catalogs import catalog
    >>> row = catalog(2, damped=True).rows[1]
    >>> row.number, row.rank, row.n_parameters
    (2, 3, 4)
    """

    number: int
    chain: Chain
    numerator_degree: int
    denominator_degree: int
    n_parameters: int
    rank: int
    group: int
    identifiability: Identifiability

    def __repr__(self) -> str:
        known = f"{self.rank} of {self.n_parameters} parameters determinable"
        return summary(
            self, f"model {self.number}, {known}" + f", group {self.group}" * bool(self.group)
        )


def model_row(record: Record, family: Family, group: int) -> ModelRow:
    """The row of a model from its record, in this group."""
    number, (numerator, denominator) = record["model"], record["degrees"]
    return ModelRow(
        number=number,
        chain=family[number],
        numerator_degree=numerator,
        denominator_degree=denominator,
        n_parameters=len(record["parameters"]),
        rank=record["rank"],
        group=group,
        identifiability=Identifiability.from_dict(record["identifiability"]),
    )
