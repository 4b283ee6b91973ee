"""What fibres tell of two models: the one answer of both engines, synthesis and ideals."""

from dataclasses import dataclass
from typing import Generic, TypeVar

from disting.evidence.decision import FibreAt
from disting.evidence.ideals import ByRows, Refuted, Solved
from disting.model.question import Membership

E = TypeVar("E", bound=FibreAt | Solved | Refuted | ByRows, covariant=True)


@dataclass(frozen=True, slots=True)
class Decision(Generic[E]):
    """`membership` with its evidence; the probability of error is at most 2**-safety. `reason`
    says why not, or not more. A refutation row by row with `safety` 0 is proven.
    """

    membership: Membership
    safety: int = 0
    evidence: E | None = None
    reason: str = ""

    def __bool__(self) -> bool:
        raise TypeError("a decision is not true or false; look at its membership")
