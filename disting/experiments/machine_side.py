"""A measured chain as one side of a comparison: what conditions and verdicts ask of it.

Conditions 1 to 7 are asked of the stacked summary word for word, and so is condition 8: where one
model is the other with elements missing and all experiments are at the same masses, missing
elements that go to zero carry one tuple of transfer functions into the other, so the closure of its
image lies in that of the other, and of equal rank they are equal. Condition 9 would be as true, but
its third model, with the elements of both, is no chain of the class: it has no gap where theirs
differ, so it cannot be measured as chains are, and what it would say the exact decision finds.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

from disting.algebra.certainty import weakest
from disting.algebra.colouring import Colouring, colouring
from disting.algebra.content import written
from disting.algebra.sampling import prime
from disting.behaviour.profile import Profile, profile
from disting.behaviour.sample import Representation
from disting.conditions.finding import Finding, Outcome
from disting.conditions.rule import ADMISSIBLE, EXACT
from disting.evidence.conditions import FreeChoice, Renaming
from disting.evidence.kinds import Evidence, InclusionEvidence
from disting.evidence.positive import PositiveFinding
from disting.experiments.exact_under import exact_finding
from disting.experiments.experiment import MeasuredChain
from disting.experiments.inclusion import inclusions_under, numbering
from disting.experiments.machine_model import MachineModel
from disting.experiments.measured_evidence import confirms, confirms_inclusion, exact_again
from disting.experiments.polynomials import is_renaming
from disting.experiments.positive import positive_finding
from disting.model.chain import Premise
from disting.model.domain import Domain
from disting.model.question import Answerer, Question, computed
from disting.model.settings import Settings
from disting.questions.inclusion import Inclusions
from disting.questions.same.exact import resting_on_ranks
from disting.questions.same.real_and_positive import positive_ways

NOT_COMPARABLE = "ranks, degrees or dead times differ (conditions 2 to 4)"
NOT_KNOWN = "whether equivalents under these experiments are {} is not known"
EXACTLY = Question(
    "exact decisions under experiments", exact_finding, Finding.to_json, Finding.from_json
)
POSITIVELY = Question(
    "positive equivalents under experiments",
    positive_finding,
    PositiveFinding.to_json,
    PositiveFinding.from_json,
)
Profiles = Callable[[MachineModel, Representation, int, Settings], Profile]
Pair = tuple["ComparedMachine", "ComparedMachine"]


@dataclass(frozen=True)
class ComparedMachine:
    """`source` yields profiles, `answerer` answers about pairs; a cache may stand in for both."""

    name: str
    measured: MeasuredChain
    settings: Settings = field(default_factory=Settings)
    source: Profiles = profile
    answerer: Answerer = computed
    _known: dict[tuple[Representation, int], Profile] = field(
        default_factory=dict, init=False, repr=False, compare=False
    )

    @property
    def premise(self) -> Premise:
        """Damping, sensor quantity, and all experiments."""
        return replace(self.measured.chain.premise, experiments=self.measured.text)

    def profile(self, representation: Representation, count: int) -> Profile:
        """What all experiments together reveal."""
        if (representation, count) not in self._known:
            found = self.source(self.profiled, representation, count, self.settings)
            self._known[representation, count] = found
        return self._known[representation, count]

    def sketch(self, representation: Representation, count: int) -> Profile:
        """What they reveal but for dependences, unless these are known: a stacked summary has many
        more rows than parameters, so their search costs more than all else.
        """
        if (representation, count) in self._known:
            return self._known[representation, count]
        return self._sketch_of(self.profiled, representation, count)

    def _sketch_of(
        self, model: MachineModel, representation: Representation, count: int
    ) -> Profile:
        return self.source(model, representation, count, replace(self.settings, subset_limit=0))

    @property
    def parameters(self) -> tuple[str, ...]:
        """Names of the parameters."""
        return self.measured.chain.parameters

    @property
    def structure(self) -> None:
        """None of which condition 9 could make a third one."""
        return

    @property
    def n_elements(self) -> int:
        """Number of masses, springs and dampers."""
        return len(self.measured.chain.structure.elements)

    def part_of(self, other: "ComparedMachine") -> dict[int, int] | None:
        """The numbering under which it is the other one with elements missing, all experiments at
        the same masses.
        """
        return numbering(self.measured, other.measured)

    @property
    def n_states(self) -> int:
        """Order of each transfer function, at most."""
        return self.measured.chain.structure.n_states

    @property
    def content(self) -> tuple[str, ...]:
        """All that verdicts on it depend on."""
        return self.name, written(self.measured)

    @property
    def profiled(self) -> MachineModel:
        """All transfer functions."""
        return MachineModel(self.measured)

    @property
    def rank(self) -> int:
        """Number of parameters that all experiments together determine."""
        return self.sketch(Representation.TF, 0).rank

    @cached_property
    def colouring(self) -> Colouring:
        """Stable colours of the parameters in all coefficients."""
        return colouring(self.columns, ("",) * len(self.parameters))

    def columns(self, point: list[int]) -> tuple[tuple[int, ...], list[tuple[int, ...]]]:
        """Values and Jacobian columns of all coefficients."""
        return self.profiled.columns(point, prime("renaming"))

    def symmetry_with(self, other: "ComparedMachine") -> Renaming | None:
        """None: symmetries of a chain may move a sensor."""
        return None

    def is_renamed(self, other: "ComparedMachine", renaming: dict[str, str]) -> bool:
        """Whether renaming the parameters turns all transfer functions into the others: exact."""
        return is_renaming(self.measured, other.measured, renaming)

    def exact(self, other: "ComparedMachine") -> Finding:
        """The exact decision, for equal ranks and degrees."""
        one, there = (side.sketch(Representation.TF, 0) for side in (self, other))
        if not comparable(self, other):
            return Finding(EXACT, Outcome.INAPPLICABLE, note=NOT_COMPARABLE)
        found = self.answerer(EXACTLY, (self.measured, other.measured), self.settings)
        return resting_on_ranks(found, one, there)

    def confirms(self, other: "ComparedMachine", evidence: Evidence, representation: str) -> bool:
        """Whether evidence of a verdict is true of both."""
        return confirms(evidence, self.measured, other.measured, representation)

    def includes(self, other: "ComparedMachine", evidence: InclusionEvidence) -> bool:
        """Whether evidence of an inclusion is true of both."""
        return confirms_inclusion(evidence, self.measured, other.measured)

    def proves(self, other: "ComparedMachine", found: PositiveFinding) -> bool:
        """No: it is not told."""
        return False

    def exact_again(self, other: "ComparedMachine", evidence: Evidence) -> Finding | None:
        """What `exact` finds with evidence of this kind."""
        if not comparable(self, other):
            return None
        found = exact_again(evidence, self.measured, other.measured, self.settings)
        sketches = (side.sketch(Representation.TF, 0) for side in (self, other))
        return None if found is None else resting_on_ranks(found, *sketches)

    def admissible(
        self, other: "ComparedMachine", domain: Domain, why: Evidence | None = None
    ) -> Finding:
        """Over real or positive parameters: a renaming is a bijection there too; positive ones are
        asked for both ways, and what is found is no surer than that the models are the same.
        """
        if isinstance(why, Renaming) or domain is not Domain.POSITIVE:
            return Finding(ADMISSIBLE, Outcome.ABANDONED, note=NOT_KNOWN.format(domain))
        found = positive_ways(self.positive(other), other.positive(self))
        if found.outcome is Outcome.ABANDONED or isinstance(why, FreeChoice):
            return found
        same = self.exact(other)
        grades = (found.certainty, found.safety), (same.certainty, same.safety)
        certainty, safety = weakest(*grades)
        return replace(found, certainty=certainty, safety=safety)

    def inclusions(self, other: "ComparedMachine") -> Inclusions:
        """For unequal ranks: limits, where missing elements or one experiment settle it."""

        def profile_of(measured: MeasuredChain) -> Profile:
            """That of the coefficients, without dependences."""
            return self._sketch_of(MachineModel(measured), Representation.TF, 0)

        return inclusions_under(self.measured, other.measured, profile_of)

    def tells_shares(self, other: "ComparedMachine") -> bool:
        """No."""
        return False

    def positive(self, other: "ComparedMachine") -> PositiveFinding:
        """Which positive models of the one have a positive equivalent in the other, where generic
        complex ones have equivalents.
        """
        return self.answerer(POSITIVELY, (self.measured, other.measured), self.settings)

    @staticmethod
    def prepare_exact(pairs: Sequence[Pair], ask: Callable[..., Any]) -> None:
        """Have the exact decisions on pairs of equal rank and degrees computed."""
        ask(EXACTLY, [(a.measured, b.measured) for a, b in pairs if comparable(a, b)])

    @staticmethod
    def prepare_positive(ways: Sequence[Pair], ask: Callable[..., Any]) -> None:
        """Nothing is needed."""

    @staticmethod
    def prepare_admissible(pairs: Sequence[Pair], domain: Domain, ask: Callable[..., Any]) -> None:
        """Nothing is needed."""

    @staticmethod
    def all_inclusions(pairs: Sequence[Pair], ask: Callable[..., Any]) -> list[Inclusions]:
        """One after the other: they cost little."""
        return [a.inclusions(b) for a, b in pairs]


def comparable(left: ComparedMachine, right: ComparedMachine) -> bool:
    """Whether the exact decision is asked: ranks, degrees and dead times are equal."""
    one, other = (side.sketch(Representation.TF, 0) for side in (left, right))
    times = (side.measured.chain.dead_time for side in (left, right))
    return one.rank == other.rank > 0 and one.degrees == other.degrees and len(set(times)) == 1
