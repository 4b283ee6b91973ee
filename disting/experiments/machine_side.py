"""A measured chain as one side of a comparison: the properties that conditions and verdicts need.

Conditions 1 to 7 apply to the stacked summary without change, and so is condition 8: where one
model is the other with elements missing and all experiments are at the same masses, missing
elements that go to zero carry one tuple of transfer functions into the other, so the closure of its
image lies in that of the other, and of equal rank they are equal. Condition 9 would be as true, but
its third model, with the elements of both, is no chain of the class: it has no gap where theirs
differ, so it cannot be measured as chains are, and the exact decision finds its result.
"""

from dataclasses import dataclass, replace

from disting.algebra.certainty import weakest
from disting.behaviour.profile import Profile
from disting.behaviour.sample import Representation
from disting.conditions.inclusion import Inclusions
from disting.conditions.rule import ADMISSIBLE, EXACT, Finding, Outcome
from disting.conditions.side import Side
from disting.decide import POSITIVE_MEASURED, SAME_MEASURED, found_at_once, recheck
from disting.evidence.conditions import FreeChoice, Renaming
from disting.evidence.kinds import Evidence, InclusionEvidence
from disting.evidence.positive import PositiveFinding
from disting.experiments.exact import exact_finding, positive_finding
from disting.experiments.experiment import MeasuredChain
from disting.experiments.inclusion import inclusions_under, numbering
from disting.experiments.machine_model import MachineModel, is_renaming
from disting.experiments.measured_evidence import confirms, confirms_inclusion
from disting.model.chain import Premise
from disting.model.question import Domain, Question
from disting.questions.same.exact import resting_on_ranks

NOT_COMPARABLE = "ranks, degrees or dead times differ (conditions 2 to 4)"
NOT_KNOWN = "whether equivalents under these experiments are {} is not known"
EXACTLY = Question(
    "exact decisions under experiments", exact_finding, Finding.to_json, Finding.from_json
)
POSITIVELY = Question.plain(
    "positive equivalents under experiments",
    positive_finding,
    PositiveFinding.to_dict,
    PositiveFinding.from_dict,
)
MachinePair = tuple["ComparedMachine", "ComparedMachine"]


@dataclass(frozen=True)
class ComparedMachine(Side[MeasuredChain]):
    """A chain under several experiments."""

    exactly = EXACTLY

    @property
    def model(self) -> MachineModel:
        """All transfer functions."""
        return MachineModel(self.measured)

    @property
    def measured(self) -> MeasuredChain:
        """The chain and its experiments."""
        return self.subject

    @property
    def has_dear_dependences(self) -> bool:
        """Yes: a stacked summary has many more rows than parameters."""
        return True

    @property
    def premise(self) -> Premise:
        """Damping, sensor quantity, and all experiments."""
        return replace(self.measured.chain.premise, experiments=self.measured.text)

    @property
    def n_elements(self) -> int:
        """Number of masses, springs and dampers."""
        return len(self.measured.chain.structure.elements)

    def part_of(self, other: "ComparedMachine") -> dict[int, int] | None:
        """The numbering under which it is the other one with elements missing, all experiments at
        the same masses.
        """
        return numbering(self.measured, other.measured)

    def is_renamed(self, other: "ComparedMachine", renaming: dict[str, str]) -> bool:
        """Return True if renaming the parameters turns all transfer functions into the others:
        exact.
        """
        return is_renaming(self.measured, other.measured, renaming)

    def pair(self, other: "ComparedMachine") -> tuple[MeasuredChain, MeasuredChain]:
        """Both as they are."""
        return self.measured, other.measured

    def foreseen(self, other: "ComparedMachine") -> Finding | None:
        """Not computed for unequal ranks, degrees or dead times."""
        finding: Finding | None = found_at_once(SAME_MEASURED.at_once, self, other)
        return finding

    def grounded(self, other: "ComparedMachine", found: Finding) -> Finding:
        """As sure as the ranks."""
        return resting_on_ranks(found, self.transfer_profile, other.transfer_profile)

    def found_again(self, other: "ComparedMachine", evidence: Evidence) -> Finding | None:
        """Finding with evidence of this kind."""
        again: Finding | None = recheck(
            evidence, SAME_MEASURED.rows, *self.pair(other), self.settings
        )
        return again

    def confirms(self, other: "ComparedMachine", evidence: Evidence, representation: str) -> bool:
        """Return True if the evidence of a verdict holds for both sides."""
        return confirms(evidence, self.measured, other.measured, representation)

    def includes(self, other: "ComparedMachine", evidence: InclusionEvidence) -> bool:
        """Return True if the evidence of an inclusion holds for both sides."""
        return confirms_inclusion(evidence, self.measured, other.measured)

    def admissible(
        self, other: "ComparedMachine", domain: Domain, why: Evidence | None = None
    ) -> Finding:
        """Over real or positive parameters: a renaming is a bijection there too; positive ones are
        decided in both directions, and the finding is at most as certain as the equivalence of the
        models.
        """
        if isinstance(why, Renaming) or domain is not Domain.POSITIVE:
            return Finding(ADMISSIBLE, Outcome.ABANDONED, note=NOT_KNOWN.format(domain))
        finding: Finding = found_at_once(POSITIVE_MEASURED.at_once, self, other)
        if finding.outcome is Outcome.ABANDONED or isinstance(why, FreeChoice):
            return finding
        same = self.exact(other)
        grades = (finding.certainty, finding.safety), (same.certainty, same.safety)
        certainty, safety = weakest(*grades)
        return replace(finding, certainty=certainty, safety=safety)

    def inclusions(self, other: "ComparedMachine") -> Inclusions:
        """For unequal ranks: limits, where missing elements or one experiment settle it."""

        def profile_of(measured: MeasuredChain) -> Profile:
            """That of the coefficients, without dependences."""
            settings = replace(self.settings, subset_limit=0)
            return self.source(MachineModel(measured), Representation.TF, 0, settings)

        return inclusions_under(self.measured, other.measured, profile_of)

    def positive(self, other: "ComparedMachine") -> PositiveFinding:
        """Positive models of this side that have a positive equivalent on the other side, where
        generic complex ones have equivalents.
        """
        return self.answerer(POSITIVELY, (self.measured, other.measured), self.settings)


def refuse_unequal(left: ComparedMachine, right: ComparedMachine) -> Finding | None:
    """Not computed for unequal ranks, degrees or dead times."""
    mine, theirs = left.transfer_profile, right.transfer_profile
    alike = mine.rank == theirs.rank > 0 and mine.degrees == theirs.degrees
    if alike and left.measured.chain.dead_time == right.measured.chain.dead_time:
        return None
    return Finding(EXACT, Outcome.INAPPLICABLE, note=NOT_COMPARABLE)
