"""Every kind of evidence that verdicts and inclusions rest on, and which statement each of them
proves.

Those of findings on positive parameters are `positive.PositiveEvidence`.
"""

from typing import Any, get_args

from disting.evidence import plain
from disting.evidence.across_sizes import (
    AcrossSizes,
    Limit,
    LimitFibre,
    Meeting,
    PoleSharing,
    TooLarge,
)
from disting.evidence.conditions import ByConditions, Counts
from disting.evidence.decision import DeadTime, FibreAt, FibreUnder, Theorem
from disting.evidence.general import OfGeneralModels
from disting.evidence.ideals import ByRows, FullRows, Refuted, Shared, Solved
from disting.evidence.limits import (
    FullImage,
    LargerProjection,
    MissingElements,
    Outside,
    RelativeDegrees,
    RowsInside,
)
from disting.evidence.real import BothWays, OddFibres, RealFactors, RealWitnesses

ByDecision = Theorem | DeadTime | FibreAt | FibreUnder | FullRows | Solved | Refuted | Shared
Evidence = (
    ByConditions | ByDecision | BothWays | RealFactors | RealWitnesses | OddFibres | OfGeneralModels
)
RowByRow = Outside | RowsInside | ByRows
InclusionEvidence = (
    AcrossSizes
    | Counts
    | LargerProjection
    | FullImage
    | MissingElements
    | RelativeDegrees
    | DeadTime
    | RowByRow
    | FibreAt
    | Solved
    | Refuted
)
TELLING_LIMITS = (
    Limit | Meeting | LimitFibre | FullImage | MissingElements | RowsInside | Solved
)  # those of `Solved` may have elements that are zero, as those of `ByRows`
GROUNDS = {
    "theorem": "a theorem",
    "dead time": "dead time",
    "fibre": "one fibre",
    "fibre under experiments": "one fibre",
    "solved": "the ideal of one fibre",
    "refuted": "the ideal of one fibre",
    "shared": "all ways to share out the zeros of a row",
    "full-parts": "rows that can have any receptance",
    "constants": "constants",
}  # on which the exact decision rests, by the kind of its evidence


def evidence_from(data: dict[str, Any]) -> Evidence:
    """Evidence of a verdict from plain data; raises KeyError, TypeError or ValueError for what
    is none.
    """
    found: Evidence = plain.from_dict(data, get_args(Evidence))
    return found


def inclusion_evidence_from(data: dict[str, Any]) -> InclusionEvidence:
    """Evidence of an inclusion from plain data; raises KeyError, TypeError or ValueError for
    what is none.
    """
    found: InclusionEvidence = plain.from_dict(data, get_args(InclusionEvidence))
    return found


def tells_equivalents(evidence: InclusionEvidence) -> bool:
    """Whether it shows finite elements other than zero: they are limits too."""
    return isinstance(evidence, FibreAt) and evidence.solutions > 0


def tells_limits(evidence: InclusionEvidence) -> bool:
    """Whether it shows limits; those of `Solved` and `ByRows` may have elements that are zero."""
    by_rows = isinstance(evidence, ByRows) and evidence.is_member
    return by_rows or isinstance(evidence, TELLING_LIMITS) or tells_equivalents(evidence)


def excludes_limits(evidence: InclusionEvidence) -> bool:
    """Whether it says that generic models are no limits, so that they have no equivalents
    either.
    """
    return isinstance(evidence, Counts | LargerProjection | TooLarge | PoleSharing | Outside)


def excludes_equivalents(evidence: InclusionEvidence) -> bool:
    """Whether it says that generic models have no equivalent with finite elements other than
    zero.
    """
    return excludes_limits(evidence) or not tells_limits(evidence)
