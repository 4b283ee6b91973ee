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

    `source` yields profiles, `answerer` answers about pairs; a cache may stand in for both. What a
    family does not say of its models stays as it is here: not known, or not asked.
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
        """What it reveals."""

    @property
    def profiled(self) -> Model:
        """What its profiles are computed of; models that share it share their profiles."""
        return self.model

    @property
    def content(self) -> tuple[str, ...]:
        """All that its verdicts depend on, as text."""
        return self.name, full_text(self.subject)

    @property
    def premise(self) -> Premise | None:
        """What its name leaves to be said; None of models whose name says all."""
        return None

    @property
    def notes(self) -> tuple[str, ...]:
        """What is to be known of all that is told of it."""
        return ()

    @property
    def in_s(self) -> bool:
        """Whether it is a function of s, so that it has Markov parameters."""
        return True

    @property
    def chain(self) -> Chain | None:
        """The chain that it is, if it is one and is measured in one way."""
        return None

    @property
    def chain_note(self) -> str:
        """What the chain's parameters are called in it, where they have other names."""
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
        """What it reveals in a representation, with so many Markov parameters."""
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
        """Whether their search costs more than all else."""
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
        """Whether renaming the parameters turns its transfer functions into the others: exact."""

    def symmetry_with(self, other: Self) -> Renaming | None:
        """The renaming by which a symmetry of the class connects both sides, if there is one."""
        return None

    def part_of(self, other: Self) -> dict[int, int] | None:
        """A numbering of its masses under which it is the other side with elements missing, what is
        measured being the same; None if there is none.
        """
        return None

    @abstractmethod
    def pair(self, other: Self) -> Models:
        """Both, as `exactly` is asked of them."""

    @abstractmethod
    def foreseen(self, other: Self) -> Finding | None:
        """The exact decision where ranks, degrees or theorems tell it; None where it is asked."""

    @abstractmethod
    def grounded(self, other: Self, found: Finding) -> Finding:
        """What is found of `pair`, of these two: as sure as the ranks that are seen equal."""

    @abstractmethod
    def found_again(self, other: Self, evidence: Evidence) -> Finding | None:
        """What the settings find of `pair` with evidence of this kind, where it is asked."""

    def exact(self, other: Self) -> Finding:
        """The exact decision, for equal ranks."""
        told = self.foreseen(other)
        if told is not None:
            return told
        return self.grounded(other, self.answerer(self.exactly, self.pair(other), self.settings))

    def recheck(self, other: Self, evidence: Evidence) -> Finding | None:
        """What the settings find by the exact decision with evidence of this kind: evidence that is
        true can have been chosen, and then bounds nothing.
        """
        told = self.foreseen(other)
        if told is not None:
            return told if type(told.evidence) is type(evidence) else None
        again = self.found_again(other, evidence)
        return None if again is None else self.grounded(other, again)

    @abstractmethod
    def confirms(self, other: Self, evidence: Evidence, representation: str) -> bool:
        """Whether evidence of a verdict is true of both, seen anew; raises NotSeenError where that
        takes too long.
        """

    def includes(self, other: Self, evidence: InclusionEvidence) -> bool:
        """Whether evidence of an inclusion is true of both, seen anew."""
        return False

    def proves(self, other: Self, finding: PositiveFinding) -> bool:
        """Whether evidence on the positive equivalents of the one in the other is true."""
        return False

    @abstractmethod
    def admissible(self, other: Self, domain: Domain, why: Evidence | None = None) -> Finding:
        """Whether two models that are the same over complex parameters, for this reason, are so
        over this domain.
        """

    @abstractmethod
    def inclusions(self, other: Self) -> Inclusions:
        """For unequal ranks: whose generic models have equivalents on the other side, or are
        limits of models there.
        """

    def tells_shares(self, other: Self) -> bool:
        """Whether it is asked which positive models have positive equivalents there."""
        return False

    @abstractmethod
    def positive(self, other: Self) -> PositiveFinding:
        """Which positive models of the one have a positive equivalent in the other."""

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
    """What is to be known of all that is told of both."""
    return tuple(dict.fromkeys((*left.notes, *right.notes)))
