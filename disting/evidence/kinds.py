"""Every kind of evidence that verdicts and inclusions rest on, by what it is evidence of; those of
findings on positive parameters are `positive.PositiveEvidence`. A kind that is not named in one of
these unions is read by nothing.

Result of fibres for two models, common to both engines, synthesis and ideals.
"""

from dataclasses import dataclass
from typing import Any, Generic, TypeVar, get_args

from disting.evidence.conditions import ByConditions, Counts
from disting.evidence.decision import DeadTime, FibreAt, FibreUnder, Theorem
from disting.evidence.general import OfGeneralModels
from disting.evidence.ideals import ByRows, FullRows, NoShares, Refutation, Solutions
from disting.evidence.kind import read
from disting.evidence.limits import (
    AcrossSizes,
    FullImage,
    LargerProjection,
    Minor,
    MissingElements,
    Outside,
    RelativeDegrees,
    RowsInside,
)
from disting.evidence.positive import BothWays, OddFibres, RealFactors, RealWitnesses
from disting.model.question import Membership

E = TypeVar("E", bound=FibreAt | Solutions | Refutation | ByRows, covariant=True)
ByDecision = (
    Theorem | DeadTime | FibreAt | FibreUnder | FullRows | Solutions | Refutation | NoShares
)
Evidence = (
    ByConditions | ByDecision | BothWays | RealFactors | RealWitnesses | OddFibres | OfGeneralModels
)
InclusionEvidence = (
    AcrossSizes
    | Counts
    | LargerProjection
    | FullImage
    | MissingElements
    | Minor
    | RelativeDegrees
    | DeadTime
    | Outside
    | RowsInside
    | ByRows
    | FibreAt
    | Solutions
    | Refutation
)


@dataclass(frozen=True, slots=True)
class Decision(Generic[E]):
    """`membership` with its evidence; the probability of error is at most 2**-safety. `reason`
    explains an incomplete result. A refutation row by row with `safety` 0 is proven.
    """

    membership: Membership
    safety: int = 0
    evidence: E | None = None
    reason: str = ""

    def __bool__(self) -> bool:
        raise TypeError("a decision is not true or false; use its membership")


def evidence_from(data: dict[str, Any]) -> Evidence:
    """Evidence of a verdict from plain data; raises KeyError, TypeError or ValueError for what
    is none.
    """
    evidence: Evidence = read(data, get_args(Evidence))
    return evidence


def inclusion_evidence_from(data: dict[str, Any]) -> InclusionEvidence:
    """Evidence of an inclusion from plain data; raises KeyError, TypeError or ValueError for
    what is none.
    """
    evidence: InclusionEvidence = read(data, get_args(InclusionEvidence))
    return evidence
