"""What a verdict asks of a model beyond the conditions: the Protocol that `verdict` folds over.

Chains implement it in `chains`, chains under several experiments in
`disting.experiments.machine_side`, any other parametric models in `disting.general.compared`.
"""

from collections.abc import Callable, Sequence
from typing import Any, Protocol, Self

from disting.conditions.finding import Finding
from disting.conditions.side import Side
from disting.evidence.kinds import Evidence, InclusionEvidence
from disting.evidence.positive import PositiveFinding
from disting.model.chain import Premise
from disting.model.domain import Domain
from disting.model.protocol import Model
from disting.model.question import Models, Question
from disting.questions.inclusion import Inclusions

Ask = Callable[[Question[Any], Sequence[Models]], None]
"""Has a question answered for many models or pairs at once."""


class Compared(Side, Protocol):
    """A model that is compared with others of its kind."""

    @property
    def premise(self) -> Premise | None:
        """What its name leaves to be said; None of models whose name says all."""

    @property
    def n_states(self) -> int:
        """Order of the transfer function."""

    @property
    def rank(self) -> int:
        """Number of determinable parameters."""

    @property
    def content(self) -> tuple[str, ...]:
        """All that its verdicts depend on, as text."""

    @property
    def profiled(self) -> Model:
        """What its profiles are computed of; models that share it share their profiles."""

    def confirms(self, other: Self, evidence: Evidence, representation: str) -> bool:
        """Whether evidence of a verdict is true of both, seen anew; raises NotSeenError where that
        takes too long.
        """

    def includes(self, other: Self, evidence: InclusionEvidence) -> bool:
        """Whether evidence of an inclusion is true of both, seen anew."""

    def proves(self, other: Self, found: PositiveFinding) -> bool:
        """Whether evidence on the positive equivalents of the one in the other is true."""

    def exact_again(self, other: Self, evidence: Evidence) -> Finding | None:
        """What the settings find by the exact decision with evidence of this kind: evidence that is
        true can have been chosen, and then bounds nothing.
        """

    def exact(self, other: Self) -> Finding:
        """The exact decision, for equal ranks."""

    def admissible(self, other: Self, domain: Domain, why: Evidence | None = None) -> Finding:
        """Whether two models that are the same over complex parameters, for this reason, are so
        over this domain.
        """

    def inclusions(self, other: Self) -> Inclusions:
        """For unequal ranks: whose generic models have equivalents on the other side, or are
        limits of models there.
        """

    def tells_shares(self, other: Self) -> bool:
        """Whether it can be asked which positive models have positive equivalents there."""

    def positive(self, other: Self) -> PositiveFinding:
        """Which positive models of the one have a positive equivalent in the other."""

    @staticmethod
    def prepare_exact(pairs: Sequence[tuple[Any, Any]], ask: Ask) -> None:
        """Have all that `exact` needs for these pairs computed, many at a time."""

    @staticmethod
    def prepare_positive(ways: Sequence[tuple[Any, Any]], ask: Ask) -> None:
        """Have all that `positive` needs computed, many at a time."""

    @staticmethod
    def prepare_admissible(pairs: Sequence[tuple[Any, Any]], domain: Domain, ask: Ask) -> None:
        """Have all that `admissible` needs computed, many at a time."""

    @staticmethod
    def all_inclusions(pairs: Sequence[tuple[Any, Any]], ask: Ask) -> list[Inclusions]:
        """`inclusions` of many pairs, with what they need computed at once."""
