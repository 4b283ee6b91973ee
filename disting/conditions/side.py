"""One side of a comparison: a model by its name, with its profiles, and what its family knows of
such models beyond what all models offer.
"""

from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, ClassVar, Generic, Self, TypeVar

from disting.algebra.certainty import full_text, prime
from disting.algebra.colouring import Colouring, colouring
from disting.behaviour.profile import Profile, profile
from disting.behaviour.sample import Representation
from disting.conditions.inclusion import Inclusions
from disting.conditions.rule import Finding, positive_ways
from disting.evidence.conditions import Renaming
from disting.evidence.kinds import Evidence, InclusionEvidence
from disting.evidence.positive import PositiveFinding
from disting.model.chain import Chain, Premise, Structure
from disting.model.protocol import Columns, Model
from disting.model.question import Answerer, Domain, Models, Question, Settings, compute

Ask = Callable[[Question[Any], Sequence[Models]], None]
"""Has a question answered for many models or pairs at once."""
S = TypeVar("S")


@dataclass(frozen=True)
class Side(ABC, Generic[S]):
    """Both sides of a comparison are of one family: chains, chains under several experiments, or
    general models.

    `source` yields profiles, `answerer` answers about pairs; a cache may stand in for both.
    Defaults for families that do not override them: not known, or not decided.
    """

    exactly: ClassVar[Question[Finding]]  # the exact decision

    name: str
    subject: S
    settings: Settings = field(default_factory=Settings)
    source: Callable[[Model, Representation, int, Settings], Profile] = profile
    answerer: Answerer = compute
    _known: dict[tuple[Representation, int], Profile] = field(
        default_factory=dict, init=False, repr=False, compare=False
    )

    @property
    @abstractmethod
    def model(self) -> Model:
        """Model with the behaviour of this side."""

    @property
    def profiled(self) -> Model:
        """Model from which the profiles are computed; sides that share it share their profiles."""
        return self.model

    @property
    def content(self) -> tuple[str, ...]:
        """All that its verdicts depend on, as text."""
        return self.name, full_text(self.subject)

    @property
    def premise(self) -> Premise | None:
        """Premise that its name does not state; None if the name states all."""
        return None

    @property
    def notes(self) -> tuple[str, ...]:
        """Notes that apply to every statement on this side."""
        return ()

    @property
    def in_s(self) -> bool:
        """True if the behaviour is a function of s and so has Markov parameters."""
        return True

    @property
    def chain(self) -> Chain | None:
        """The chain that it is, if it is one and is measured in one way."""
        return None

    @property
    def chain_note(self) -> str:
        """Note on the names of the chain's parameters in this model, where they differ."""
        return ""

    @property
    def structure(self) -> Structure | None:
        """Its masses, springs and dampers, if it is made of such and measured in one way."""
        return None

    @property
    def n_elements(self) -> int | None:
        """Number of its masses, springs and dampers, if it is made of such elements."""
        return None

    @property
    def parameters(self) -> tuple[str, ...]:
        """Names of the parameters."""
        return self.model.parameters

    @property
    def n_states(self) -> int:
        """Order of the transfer functions, at most."""
        return self.model.n_states

    def profile(self, representation: Representation, count: int) -> Profile:
        """Profile in a representation, with this number of Markov parameters."""
        if (representation, count) not in self._known:
            answer = self.source(self.profiled, representation, count, self.settings)
            self._known[representation, count] = answer
        return self._known[representation, count]

    def sketch(self, representation: Representation, count: int) -> Profile:
        """The same, without its dependences where those are the dear part of it and not known."""
        if not self.has_dear_dependences or (representation, count) in self._known:
            return self.profile(representation, count)
        settings = replace(self.settings, subset_limit=0)
        return self.source(self.profiled, representation, count, settings)

    @property
    def has_dear_dependences(self) -> bool:
        """True if the search for their dependences dominates the cost."""
        return False

    @property
    def transfer_profile(self) -> Profile:
        """That of the transfer functions, perhaps without its dependences."""
        return self.sketch(Representation.TF, 0)

    @property
    def rank(self) -> int:
        """Number of determinable parameters."""
        return self.transfer_profile.rank

    @cached_property
    def colouring(self) -> Colouring:
        """Stable colours of the parameters in the functions of `columns`."""
        return colouring(self.columns, ("",) * len(self.parameters))

    def columns(self, point: list[int]) -> Columns:
        """Values and Jacobian columns, at a point, of functions that a renaming carries into those
        of the other side, modulo one prime for all models.

        Colours of many models are compared, so they share it. Nothing rests on it: colours that
        differ prove that no renaming exists, modulo any prime, and a renaming that is found is
        proven exactly.
        """
        return self.model.columns(point, prime("renaming"))

    @abstractmethod
    def is_renamed(self, other: Self, renaming: dict[str, str]) -> bool:
        """Return True if renaming the parameters turns the transfer functions into those of the
        other side: exact.
        """

    def symmetry_with(self, other: Self) -> Renaming | None:
        """The renaming by which a symmetry of the class connects both sides, if there is one."""
        return None

    def part_of(self, other: Self) -> dict[int, int] | None:
        """A numbering of its masses under which it is the other side with elements missing, with
        the same measurement; None if there is none.
        """
        return None

    @abstractmethod
    def pair(self, other: Self) -> Models:
        """Both, in the order in which `exactly` is called."""

    @abstractmethod
    def foreseen(self, other: Self) -> Finding | None:
        """The exact decision where ranks, degrees or theorems give it; None where it must be
        computed.
        """

    @abstractmethod
    def grounded(self, other: Self, found: Finding) -> Finding:
        """Finding of `pair` applied to these two sides: as certain as the equality of the ranks."""

    @abstractmethod
    def found_again(self, other: Self, evidence: Evidence) -> Finding | None:
        """Finding that the rules of `pair` give with evidence of this kind, where they apply."""

    def exact(self, other: Self) -> Finding:
        """The exact decision, for equal ranks."""
        foreseen = self.foreseen(other)
        if foreseen is not None:
            return foreseen
        return self.grounded(other, self.answerer(self.exactly, self.pair(other), self.settings))

    def recheck(self, other: Self, evidence: Evidence) -> Finding | None:
        """Finding that the exact decision of `pair` gives with evidence of this kind: true evidence
        can have been selected, and then bounds no error.
        """
        foreseen = self.foreseen(other)
        if foreseen is not None:
            return foreseen if type(foreseen.evidence) is type(evidence) else None
        again = self.found_again(other, evidence)
        return None if again is None else self.grounded(other, again)

    @abstractmethod
    def confirms(self, other: Self, evidence: Evidence, representation: str) -> bool:
        """Return True if the evidence of a verdict holds for both sides (recomputed from scratch);
        raises NotSeenError where that takes too long.
        """

    def includes(self, other: Self, evidence: InclusionEvidence) -> bool:
        """Return True if the evidence of an inclusion holds for both sides (recomputed from
        scratch).
        """
        return False

    def proves(self, other: Self, finding: PositiveFinding) -> bool:
        """Return True if the evidence on positive equivalents of the one side in the other is
        correct.
        """
        return False

    @abstractmethod
    def admissible(self, other: Self, domain: Domain, why: Evidence | None = None) -> Finding:
        """Decide whether two models that are equivalent over complex parameters, for this reason,
        are so over this domain.
        """

    @abstractmethod
    def inclusions(self, other: Self) -> Inclusions:
        """For unequal ranks: whose generic models have equivalents on the other side, or are
        limits of models there.
        """

    def tells_shares(self, other: Self) -> bool:
        """Return True if the share of positive models with positive equivalents on the other side
        is part of the question.
        """
        return False

    @abstractmethod
    def positive(self, other: Self) -> PositiveFinding:
        """Positive models of this side that have a positive equivalent on the other side."""

    @classmethod
    def prepare_exact(cls, pairs: Sequence[tuple[Self, Self]], ask: Ask) -> None:
        """Have all that `exact` needs for these pairs computed, many at a time."""
        ask(cls.exactly, [a.pair(b) for a, b in pairs if a.foreseen(b) is None])

    @classmethod
    def prepare_positive(cls, ways: Sequence[tuple[Self, Self]], ask: Ask) -> None:
        """Have all that `positive` needs computed, many at a time."""

    @classmethod
    def prepare_admissible(
        cls, pairs: Sequence[tuple[Self, Self]], domain: Domain, ask: Ask
    ) -> None:
        """Have all that `admissible` needs computed, many at a time."""

    @classmethod
    def all_inclusions(cls, pairs: Sequence[tuple[Self, Self]], ask: Ask) -> list[Inclusions]:
        """`inclusions` of many pairs, with what they need computed at once."""
        return [a.inclusions(b) for a, b in pairs]


AnySide = Side[Any]
"""One of whatever family."""


def by_shares_both_ways(left: AnySide, right: AnySide) -> Finding:
    """Over positive parameters, of models that are the same over complex ones: from the shares of
    either that have a positive equivalent in the other.
    """
    return positive_ways(left.positive(right), right.positive(left))


def notes_of(left: AnySide, right: AnySide) -> tuple[str, ...]:
    """Notes that apply to every statement on both sides."""
    return tuple(dict.fromkeys((*left.notes, *right.notes)))
