"""A pair of models seen again: whether evidence is true of them, and how sure it is.

Evidence that is true can have been chosen, and then bounds nothing. So certainty, bounds and points
are compared with those that the settings give, found again with evidence of this kind. Chains,
chains under several experiments and general models have evidence of their own.
"""

from dataclasses import dataclass, field
from typing import Protocol

from disting.behaviour.sample import Representation
from disting.conditions.finding import Finding
from disting.errors import InputError
from disting.evidence.general import Constants
from disting.evidence.kinds import Evidence, InclusionEvidence
from disting.evidence.positive import PositiveFinding
from disting.experiments import ComparedMachine, measured_evidence
from disting.experiments.machine_side import comparable as machines_comparable
from disting.general import ComparedModel, model_evidence
from disting.general.compared import comparable as models_comparable
from disting.questions.inclusion import confirms as confirms_inclusion
from disting.questions.positive import proves
from disting.questions.same.evidence_check import Witness
from disting.questions.same.exact import exact_again, mirrored, resting_on_ranks
from disting.verdict.chains import ComparedChain
from disting.verdict.compared import Compared


class Pair(Protocol):
    """Two models of a verdict."""

    def confirms(self, evidence: Evidence, representation: str) -> bool:
        """Whether the evidence is true of them; raises NotSeenError where that takes too long."""

    def includes(self, evidence: InclusionEvidence) -> bool:
        """Whether the evidence of an inclusion is true of them."""

    def exact(self, evidence: Evidence) -> Finding | None:
        """What the settings find by the exact decision with evidence of this kind."""

    def proves(self, found: PositiveFinding, left_given: bool) -> bool:
        """Whether evidence on positive equivalents is true of them."""


def pair_of(left: Compared, right: Compared) -> Pair:
    """The pair of two sides of one kind."""
    if isinstance(left, ComparedChain) and isinstance(right, ComparedChain):
        return _Chains(left, right)
    if isinstance(left, ComparedMachine) and isinstance(right, ComparedMachine):
        return _Machines(left, right)
    if isinstance(left, ComparedModel) and isinstance(right, ComparedModel):
        return _Models(left, right)
    raise InputError("a verdict is on two models of one kind")


@dataclass(frozen=True)
class _Chains:
    left: ComparedChain
    right: ComparedChain
    witness: Witness = field(default_factory=Witness)

    def confirms(self, evidence: Evidence, representation: str) -> bool:
        return self.witness.confirms(evidence, representation, self.left.chain, self.right.chain)

    def includes(self, evidence: InclusionEvidence) -> bool:
        return confirms_inclusion(evidence, self.left, self.right)

    def exact(self, evidence: Evidence) -> Finding | None:
        """See `Pair`; None where ranks or degrees differ, as the decision asks for equal ones."""
        if self.left.rank != self.right.rank:
            return None
        first, second = self.left.in_order(self.right)
        turned = first != self.left.canonical.chain
        asked = evidence.turned if turned else evidence
        found = exact_again(asked, first, second, self.left.settings)
        if found is None:
            return None
        profiles = self.left.transfer_profile, self.right.transfer_profile
        return resting_on_ranks(mirrored(found) if turned else found, *profiles)

    def proves(self, found: PositiveFinding, left_given: bool) -> bool:
        chains = self.left.canonical.chain, self.right.canonical.chain
        return proves(found, *(chains if left_given else chains[::-1]))


@dataclass(frozen=True)
class _Machines:
    left: ComparedMachine
    right: ComparedMachine

    def confirms(self, evidence: Evidence, representation: str) -> bool:
        sides = self.left.measured, self.right.measured
        return measured_evidence.confirms(evidence, *sides, representation)

    def includes(self, evidence: InclusionEvidence) -> bool:
        sides = self.left.measured, self.right.measured
        return measured_evidence.confirms_inclusion(evidence, *sides)

    def exact(self, evidence: Evidence) -> Finding | None:
        """See `Pair`; None where ranks or degrees differ, as the decision asks for equal ones."""
        if not machines_comparable(self.left, self.right):
            return None
        sides = self.left.measured, self.right.measured
        found = measured_evidence.exact_again(evidence, *sides, self.left.settings)
        sketches = (side.sketch(Representation.TF, 0) for side in (self.left, self.right))
        return None if found is None else resting_on_ranks(found, *sketches)

    def proves(self, found: PositiveFinding, left_given: bool) -> bool:
        return False  # it is not told


@dataclass(frozen=True)
class _Models:
    left: ComparedModel
    right: ComparedModel

    def confirms(self, evidence: Evidence, representation: str) -> bool:
        models = self.left.model, self.right.model
        return model_evidence.confirms_models(evidence, *models, representation)

    def includes(self, evidence: InclusionEvidence) -> bool:
        return False  # it is not asked

    def exact(self, evidence: Evidence) -> Finding | None:
        """See `Pair`; None where ranks or degrees differ, as the decision asks for equal ones."""
        if isinstance(evidence, Constants):
            return self.left.exact(self.right) if self.left.rank == 0 else None
        if not models_comparable(self.left, self.right):
            return None
        models = self.left.profiled.model, self.right.profiled.model
        found = model_evidence.exact_again(evidence, *models, self.left.settings)
        profiles = (side.profile(Representation.TF, 0) for side in (self.left, self.right))
        return None if found is None else resting_on_ranks(found, *profiles)

    def proves(self, found: PositiveFinding, left_given: bool) -> bool:
        return False  # it is not told
