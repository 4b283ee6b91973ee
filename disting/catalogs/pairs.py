"""Records of a catalogue. Of a pair: which step decides in which view, and the verdict that it
holds; of a model: its row.

Over positive parameters nothing is stored but the shares of both sides, from which the verdict
follows.
"""

import json
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

from disting.algebra.certainty import Certainty
from disting.catalogs.files import INCLUSIONS, LEFT_POSITIVE, RIGHT_POSITIVE, Record
from disting.conditions.finding import NOT_REAL, Finding, positive_ways
from disting.conditions.inclusion import Inclusion, Inclusions, inclusions_from_dict
from disting.conditions.rule import RULES, Stage
from disting.evidence.kinds import evidence_from
from disting.evidence.positive import PositiveFinding
from disting.model.chain import Chain, Premise
from disting.model.family import Family
from disting.model.presentation import summary
from disting.model.question import Domain
from disting.questions.identifiability.answer import Identifiability
from disting.verdict.query import View
from disting.verdict.result import PROVES, Relation, Step, Verdict, open_note

DIFFERENT = 4096  # pieces of evidence that are kept: a catalogue has far fewer than pairs
INDEX_NAMES = ("gap", "act_minus", "act_plus", "meas_minus", "meas_plus")


def stored_verdict(
    record: Record, view: View, names: tuple[str, str], premises: tuple[Premise, Premise]
) -> Verdict:
    """The verdict of a view with all that the record says of the pair, which it names so."""
    step, relations = deciding(record, view), _both_ways(record, view)
    if step is None:
        return Verdict(
            *names,
            Relation.UNDECIDED,
            domain=view.domain,
            notes=_notes(record, view),
            premises=premises,
            **relations,
        )
    found = step.finding
    return Verdict(
        *names,
        step.relation,
        found.rule.name,
        step.representation,
        found.certainty,
        found.safety,
        found.evidence,
        view.domain,
        premises=premises,
        **relations,
    )


def _both_ways(record: Record, view: View) -> dict[str, Any]:
    """What a verdict says of inclusions and shares, where its view looks at the parameters."""
    settled = relation_of(deciding(record, View.EXACT))
    if Stage.FIBRE not in view.representations or settled is Relation.UNDECIDED:
        return {}
    here, there = _shares(record)
    if INCLUSIONS in record:
        both = _inclusions(json.dumps(record[INCLUSIONS]))
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


def deciding(record: Record, view: View) -> Step | None:
    """The step that decides in a view: the first of its representations that does; None if none
    does.
    """
    if view is View.POSITIVE:
        return _positively(record)
    if view is View.REAL:
        if view.value in record:
            return _step(Stage.PARAMETERS, json.dumps(record[view.value]))
        return _distinguishing(record)
    stage = next((stage for stage in view.representations if stage in record), None)
    return None if stage is None else _step(stage, json.dumps(record[stage]))


def relation_of(step: Step | None) -> Relation:
    """Relation that a step decides."""
    return Relation.UNDECIDED if step is None else step.relation


def _positively(record: Record) -> Step | None:
    """What the shares of both sides give, if they are indistinguishable over complex parameters."""
    here, there = _shares(record)
    if here is None or there is None:
        return _distinguishing(record)
    step = Step(Stage.PARAMETERS, _positive_ways(here, there))
    return None if step.finding.evidence is None else step


def _distinguishing(record: Record) -> Step | None:
    """What distinguishes over complex parameters does so over all."""
    step = deciding(record, View.EXACT)
    return step if relation_of(step) is Relation.DISTINGUISHABLE else None


def _notes(record: Record, view: View) -> tuple[str, ...]:
    """Why a pair is undecided."""
    if view.domain is Domain.COMPLEX:
        return ("the exact decision has no method for them",) if view is View.EXACT else ()
    here, there = _shares(record)
    if view is View.POSITIVE and here is not None and there is not None:
        return (open_note(_positive_ways(here, there).note),)
    return (open_note(NOT_REAL),) if deciding(record, View.EXACT) else ()


def _shares(record: Record) -> tuple[PositiveFinding | None, PositiveFinding | None]:
    """Positive equivalents of the left and of the right model, where they are asked for."""
    here, there = (record.get(name) for name in (LEFT_POSITIVE, RIGHT_POSITIVE))
    return _share(json.dumps(here)) if here else None, (
        _share(json.dumps(there)) if there else None
    )


@lru_cache(DIFFERENT)
def _step(stage: Stage, text: str) -> Step:
    """A step from its text; pairs that are decided alike share it."""
    plain = json.loads(text)
    rule = RULES[plain["decided_by"]]
    proves = {relation: outcome for outcome, relation in PROVES[rule.role].items()}
    outcome = proves[Relation(plain.get("relation", next(iter(proves))))]
    evidence = evidence_from(plain["evidence"])
    found = Finding(rule, outcome, Certainty(plain["certainty"]), plain["safety"], evidence)
    return Step(stage, found)


@lru_cache(DIFFERENT)
def _inclusions(text: str) -> Inclusions:
    return inclusions_from_dict(json.loads(text))


@lru_cache(DIFFERENT)
def _share(text: str) -> PositiveFinding:
    return PositiveFinding.from_dict(json.loads(text))


_positive_ways = lru_cache(DIFFERENT)(positive_ways)


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
