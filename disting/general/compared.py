"""A general model as one side of a comparison: what conditions and verdicts ask of it.

It has no masses, springs and dampers: conditions 8 and 9 do not apply, and which of its models lie
in another one of larger rank is not asked. Verdicts are over complex parameters first; over real
or positive ones a pair that is distinguishable stays so, one that a renaming makes identical stays
identical, and points with and without an admissible equivalent are looked for otherwise (see
`admissible`).
"""

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from typing import Any

from disting.algebra.colouring import Colouring, colouring
from disting.algebra.content import written
from disting.algebra.sampling import prime
from disting.behaviour.profile import Profile, profile
from disting.behaviour.sample import Representation
from disting.conditions.finding import Finding, Outcome
from disting.conditions.rule import ADMISSIBLE, EXACT
from disting.evidence.conditions import Renaming
from disting.evidence.general import Constants
from disting.evidence.kinds import Evidence, InclusionEvidence
from disting.evidence.positive import PositiveFinding, Share
from disting.general import model_evidence
from disting.general.admissible import admissible_finding
from disting.general.any_model import as_chain, is_renamed, same, unnamed
from disting.general.behaviour import GeneralModel
from disting.general.matrix_model import AnyModel
from disting.model.chain import Chain, Premise
from disting.model.domain import Domain
from disting.model.question import Answerer, Question, computed
from disting.model.settings import Settings
from disting.questions.inclusion import Inclusion, InclusionFinding, Inclusions
from disting.questions.same.exact import resting_on_ranks

NO_SHARES = "of general models it is not asked which positive ones have positive equivalents"
NOT_ASKED = "of general models only equality is asked for"
LEFT, RIGHT = "{left}", "{right}"  # stand for the names of both while an answer is kept


def _over_real(left: AnyModel, right: AnyModel, settings: Settings) -> Finding:
    return admissible_finding(left, right, Domain.REAL, settings.seed)


def _over_positive(left: AnyModel, right: AnyModel, settings: Settings) -> Finding:
    return admissible_finding(left, right, Domain.POSITIVE, settings.seed)


EXACTLY = Question("exact decisions on general models", same, Finding.to_json, Finding.from_json)
_admissible_from_json = partial(Finding.from_json, rule=ADMISSIBLE)
ADMISSIBLY = {
    Domain.REAL: Question(
        "real equivalents of general models", _over_real, Finding.to_json, _admissible_from_json
    ),
    Domain.POSITIVE: Question(
        "positive equivalents of general models",
        _over_positive,
        Finding.to_json,
        _admissible_from_json,
    ),
}
Profiles = Callable[[GeneralModel, Representation, int, Settings], Profile]
Pair = tuple["ComparedModel", "ComparedModel"]


@dataclass(frozen=True)
class ComparedModel:
    """`source` yields profiles, `answerer` answers about pairs; a cache may stand in for both."""

    name: str
    model: AnyModel
    settings: Settings = field(default_factory=Settings)
    source: Profiles = profile
    answerer: Answerer = computed
    _known: dict[tuple[Representation, int], Profile] = field(
        default_factory=dict, init=False, repr=False, compare=False
    )

    def profile(self, representation: Representation, count: int) -> Profile:
        """What the transfer function reveals."""
        if (representation, count) not in self._known:
            found = self.source(self.profiled, representation, count, self.settings)
            self._known[representation, count] = found
        return self._known[representation, count]

    def sketch(self, representation: Representation, count: int) -> Profile:
        """The profile: it costs little."""
        return self.profile(representation, count)

    @property
    def parameters(self) -> tuple[str, ...]:
        """Names of the parameters."""
        return self.model.parameters

    @property
    def structure(self) -> None:
        """It has no elements."""
        return

    @property
    def n_elements(self) -> None:
        """It has none."""
        return

    def part_of(self, other: "ComparedModel") -> None:
        """No elements can be missing."""
        return

    @property
    def n_states(self) -> int:
        """Order of the transfer function."""
        return self.model.n_states

    @property
    def content(self) -> tuple[str, ...]:
        """All that verdicts on this model depend on."""
        return self.name, written(self.profiled), written(self.premise)

    @property
    def chain(self) -> Chain | None:
        """The chain that it is, if it is one."""
        return as_chain(self.model)

    @property
    def premise(self) -> Premise | None:
        """That of the chain that it is, if it is one."""
        return None if self.chain is None else self.chain.premise

    @property
    def profiled(self) -> GeneralModel:
        """The model without its name."""
        return GeneralModel(unnamed(self.model))

    @property
    def rank(self) -> int:
        """Number of determinable parameters."""
        return self.profile(Representation.TF, 0).rank

    @cached_property
    def colouring(self) -> Colouring:
        """Stable colours of the parameters in the functions of `columns`."""
        return colouring(self.columns, ("",) * len(self.parameters))

    def columns(self, point: list[int]) -> tuple[tuple[int, ...], list[tuple[int, ...]]]:
        """Values and Jacobian columns of functions that a renaming carries over."""
        return self.profiled.columns(point, prime("renaming"))

    def symmetry_with(self, other: "ComparedModel") -> Renaming | None:
        """None: its class has no symmetries that are known beforehand."""
        return None

    def is_renamed(self, other: "ComparedModel", renaming: dict[str, str]) -> bool:
        """Whether renaming the parameters turns this transfer function into the other: exact."""
        return is_renamed(self.model, other.model, renaming)

    def exact(self, other: "ComparedModel") -> Finding:
        """The exact decision, for equal ranks and degrees."""
        one, there = (side.profile(Representation.TF, 0) for side in (self, other))
        if one.rank != there.rank or one.degrees != there.degrees:
            return Finding(
                EXACT,
                Outcome.INAPPLICABLE,
                note="the ranks or degrees differ (conditions 2 and 4)",
            )
        if one.rank == 0:
            return _constants(self.model, other.model)
        found = self.answerer(EXACTLY, _models(self, other), self.settings)
        return resting_on_ranks(found, one, there)

    def confirms(self, other: "ComparedModel", evidence: Evidence, representation: str) -> bool:
        """Whether evidence of a verdict is true of both."""
        return model_evidence.confirms_models(evidence, self.model, other.model, representation)

    def includes(self, other: "ComparedModel", evidence: InclusionEvidence) -> bool:
        """No: it is not asked."""
        return False

    def proves(self, other: "ComparedModel", found: PositiveFinding) -> bool:
        """No: it is not told."""
        return False

    def exact_again(self, other: "ComparedModel", evidence: Evidence) -> Finding | None:
        """What `exact` finds with evidence of this kind."""
        if isinstance(evidence, Constants):
            return self.exact(other) if self.rank == 0 else None
        if not comparable(self, other):
            return None
        models = self.profiled.model, other.profiled.model
        found = model_evidence.exact_again(evidence, *models, self.settings)
        profiles = (side.profile(Representation.TF, 0) for side in (self, other))
        return None if found is None else resting_on_ranks(found, *profiles)

    def admissible(
        self, other: "ComparedModel", domain: Domain, why: Evidence | None = None
    ) -> Finding:
        """Over real or positive parameters: a renaming is a bijection there too; points with and
        without equivalents come next.
        """
        if isinstance(why, Renaming):
            return Finding(ADMISSIBLE, Outcome.ABANDONED, note="the renaming tells it")
        found = self.answerer(ADMISSIBLY[domain], _unnamed(self, other), self.settings)
        names = {LEFT: self.name, RIGHT: other.name}
        note = re.sub(f"{LEFT}|{RIGHT}", lambda seen: names[seen[0]], found.note)
        return replace(found, note=note)

    def inclusions(self, other: "ComparedModel") -> Inclusions:
        """Not asked."""
        return Inclusions(*(InclusionFinding(Inclusion.UNKNOWN, reason=NOT_ASKED),) * 2)

    def tells_shares(self, other: "ComparedModel") -> bool:
        """No."""
        return False

    def positive(self, other: "ComparedModel") -> PositiveFinding:
        """Not asked."""
        return PositiveFinding(Share.UNKNOWN, reason=NO_SHARES)

    @staticmethod
    def prepare_exact(pairs: Sequence[Pair], ask: Callable[..., Any]) -> None:
        """Have the exact decisions on pairs of equal rank and degrees computed."""
        ask(EXACTLY, [_models(a, b) for a, b in pairs if comparable(a, b)])

    @staticmethod
    def prepare_positive(ways: Sequence[Pair], ask: Callable[..., Any]) -> None:
        """Nothing is needed."""

    @staticmethod
    def prepare_admissible(pairs: Sequence[Pair], domain: Domain, ask: Callable[..., Any]) -> None:
        """Have equivalents looked for; those that a renaming gives cost little."""
        ask(ADMISSIBLY[domain], [_unnamed(a, b) for a, b in pairs if not _renamed(a, b)])

    @staticmethod
    def all_inclusions(pairs: Sequence[Pair], ask: Callable[..., Any]) -> list[Inclusions]:
        """Not asked."""
        return [a.inclusions(b) for a, b in pairs]


def _models(left: ComparedModel, right: ComparedModel) -> tuple[AnyModel, AnyModel]:
    return unnamed(left.model), unnamed(right.model)


def _unnamed(left: ComparedModel, right: ComparedModel) -> tuple[AnyModel, AnyModel]:
    return unnamed(left.model, LEFT), unnamed(right.model, RIGHT)


def comparable(left: ComparedModel, right: ComparedModel) -> bool:
    """Whether the exact decision is asked: ranks and degrees are equal, and something varies."""
    one, other = (side.profile(Representation.TF, 0) for side in (left, right))
    return one.rank == other.rank > 0 and one.degrees == other.degrees


def _renamed(left: ComparedModel, right: ComparedModel) -> bool:
    return left.colouring.fingerprint == right.colouring.fingerprint


def _constants(left: AnyModel, right: AnyModel) -> Finding:
    """Transfer functions without parameters: unequal numbers, known exactly, tell the models
    apart.
    """
    values = [GeneralModel(model).constants(None) for model in (left, right)]
    differing = tuple(
        label for label, x in values[0].items() if label in values[1] and x != values[1][label]
    )
    if not differing:
        return Finding(
            EXACT,
            Outcome.INAPPLICABLE,
            note="equal constant transfer functions are found by condition 7",
        )
    evidence = Constants(differing, *(tuple(v[x] for x in differing) for v in values))
    return Finding(EXACT, Outcome.FAILS, evidence=evidence)
