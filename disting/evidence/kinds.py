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
from disting.evidence.conditions import ByConditions, Counts, Renaming
from disting.evidence.decision import DeadTime, FibreAt, FibreUnder, Theorem
from disting.evidence.general import Explicit, OfGeneralModels
from disting.evidence.ideals import ByRows, FullRows, Refuted, Shared, Solved
from disting.evidence.limits import (
    FullImage,
    LargerProjection,
    MissingElements,
    Outside,
    RelativeDegrees,
    RowsInside,
)
from disting.evidence.positive import Excluded, Interlacing, PositiveEvidence
from disting.evidence.real import BothWays, OddFibres, RealFactors, RealWitnesses
from disting.model.domain import Domain

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


def without_exception(evidence: Evidence | PositiveEvidence, domain: Domain) -> bool:
    """Whether evidence that two models are indistinguishable speaks of all their parameters in this
    domain; else special values, a set of measure zero, are left out.

    A renaming, and the symmetries of a chain, carry all parameters over. So does duality where they
    are positive: its formulas divide by sums of masses alone. Foster's and Cauer's theorems, and
    all that rests on ranks or on one fibre, speak of generic ones: of a chain with the force on its
    middle mass and both sides alike a pole is cancelled, and a chain with the force at its end has
    always all of them.
    """
    match evidence:
        case Renaming():
            return True
        case Theorem(name="symmetry"):
            return True
        case Theorem(name="duality"):
            return domain is Domain.POSITIVE
        case Explicit():
            return evidence.without_exception
        case BothWays():
            ways = (evidence.left.evidence, evidence.right.evidence)
            return all(way is not None and without_exception(way, domain) for way in ways)
        case _:
            return False


def theorem_named(evidence: Evidence | PositiveEvidence | None) -> str:
    """What the theorem is called by which evidence speaks; "" where it has no name of its own."""
    match evidence:
        case Theorem():
            return evidence.title
        case Excluded():
            return evidence.name
        case Interlacing():
            return "order of poles and zeros"
        case DeadTime() | RealFactors() | OddFibres():
            return evidence.kind
        case BothWays():
            ways = (theorem_named(way.evidence) for way in (evidence.left, evidence.right))
            return " and ".join(dict.fromkeys(filter(None, ways)))
        case _:
            return ""


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
