"""Records of a catalogue. Of a pair: which step decides in which view, and the verdict that it
holds; of a model: its row.
"""

from ast import literal_eval
from dataclasses import dataclass
from functools import cached_property, lru_cache
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


@dataclass(frozen=True)
class StoredPair:
    """A pair as its record has it: over positive parameters nothing is stored but the shares of
    both sides, from which the verdict follows.
    """

    record: Record

    def verdict(
        self, view: View, names: tuple[str, str], premises: tuple[Premise, Premise]
    ) -> Verdict:
        """The verdict of a view with all that the record says of the pair, which it names so."""
        step = self.step(view)
        looks_at_parameters = Stage.FIBRE in view.representations
        relations = self._both_ways if looks_at_parameters else {}
        if step is None:
            return Verdict(
                *names,
                Relation.UNDECIDED,
                domain=view.domain,
                notes=self._notes(view),
                premises=premises,
                **relations,
            )
        finding = step.finding
        return Verdict(
            *names,
            step.relation,
            finding.rule.name,
            step.representation,
            finding.certainty,
            finding.safety,
            finding.evidence,
            view.domain,
            premises=premises,
            **relations,
        )

    def step(self, view: View) -> Step | None:
        """The step that decides in a view: the first of its representations that does; None if
        none does.
        """
        if view is View.POSITIVE and self._positively is not None:
            return self._positively if self._positively.finding.evidence else None
        if view is View.REAL and view.value in self.record:
            return _step(Stage.PARAMETERS, repr(self.record[view.value]))
        steps = (self._steps[s] for s in view.representations if s in self._steps)
        step = next(steps, None)
        if view.domain is Domain.COMPLEX or step is None:
            return step
        # what distinguishes over complex parameters does so over all
        return step if step.relation is Relation.DISTINGUISHABLE else None

    @cached_property
    def _steps(self) -> dict[Stage, Step]:
        """What decides at each stage over complex parameters."""
        stages = (stage for stage in View.EXACT.representations if stage in self.record)
        return {stage: _step(stage, repr(self.record[stage])) for stage in stages}

    @cached_property
    def _both_ways(self) -> dict[str, Any]:
        """What is said of inclusions and shares, where the pair is decided over complex
        parameters.
        """
        settled = self.step(View.EXACT)
        if settled is None:
            return {}
        both = None
        same = settled.relation is Relation.INDISTINGUISHABLE
        image = closure = Inclusion.EQUAL if same else Inclusion.NEITHER
        if INCLUSIONS in self.record:
            both = _inclusions(repr(self.record[INCLUSIONS]))
            image, closure = both.image.inclusion, both.closure.inclusion
        own_finding, other_finding = self._shares
        return {
            "left_positive": own_finding,
            "right_positive": other_finding,
            "image": image,
            "closure": closure,
            "inclusions": both,
        }

    @cached_property
    def _shares(self) -> tuple[PositiveFinding | None, PositiveFinding | None]:
        """Positive equivalents of the left and of the right model, where they are asked for."""
        own_value, other_value = (self.record.get(name) for name in (LEFT_POSITIVE, RIGHT_POSITIVE))
        return _share(repr(own_value)) if own_value else None, _share(
            repr(other_value)
        ) if other_value else None

    @cached_property
    def _positively(self) -> Step | None:
        """What the shares of both sides give, if they are asked for: of models that are
        indistinguishable over complex parameters.
        """
        own_finding, other_finding = self._shares
        if own_finding is None or other_finding is None:
            return None
        return Step(Stage.PARAMETERS, _positive_ways(own_finding, other_finding))

    def _notes(self, view: View) -> tuple[str, ...]:
        """Why a pair is undecided."""
        if view.domain is Domain.COMPLEX:
            return ("the exact decision has no method for them",) if view is View.EXACT else ()
        if view is View.POSITIVE and self._positively is not None:
            return (open_note(self._positively.finding.note),)
        return (open_note(NOT_REAL),) if self.step(View.EXACT) else ()


@lru_cache(DIFFERENT)
def _step(stage: Stage, text: str) -> Step:
    """A step from its text as Python writes it: pairs that are decided alike share it."""
    plain = literal_eval(text)
    rule = RULES[plain["decided_by"]]
    proves = {relation: outcome for outcome, relation in PROVES[rule.role].items()}
    outcome = proves[Relation(plain.get("relation", next(iter(proves))))]
    evidence = evidence_from(plain["evidence"])
    finding = Finding(rule, outcome, Certainty(plain["certainty"]), plain["safety"], evidence)
    return Step(stage, finding)


@lru_cache(DIFFERENT)
def _inclusions(text: str) -> Inclusions:
    return inclusions_from_dict(literal_eval(text))


@lru_cache(DIFFERENT)
def _share(text: str) -> PositiveFinding:
    return PositiveFinding.from_dict(literal_eval(text))


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
        phrase = f"{self.rank} of {self.n_parameters} parameters determinable"
        return summary(
            self, f"model {self.number}, {phrase}" + (f", group {self.group}" if self.group else "")
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
