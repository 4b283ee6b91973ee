"""Checks of one verdict of a file: each yields the statements that do not hold.

Evidence that is true can have been chosen, and then bounds nothing: so certainty, bounds and points
are compared with those that the settings give, found again with evidence of this kind.
"""

import json
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

from disting.algebra.certainty import Certainty
from disting.conditions.inclusion import ONE_SIDED, Inclusion, InclusionFinding, Inclusions
from disting.conditions.rule import ADMISSIBLE, EXACT, Finding
from disting.conditions.side import AnySide, notes_of
from disting.decide import asking
from disting.evidence.decision import Theorem
from disting.evidence.general import without_digits
from disting.evidence.kinds import Evidence
from disting.evidence.positive import BothWays, PositiveFinding
from disting.verdict.cascade import decide, follows, over_domain
from disting.verdict.comparison import prove_again
from disting.verdict.result import Query, Relation, Verdict, View
from disting.verdict.sides import Sides

SECONDS = 60.0  # for a proof that took ten
LIMITS, SHARES = "which is a limit of the other", "positive equivalents"
Claimed = tuple[Certainty | None, int, Evidence | None]


@dataclass(frozen=True, slots=True)
class Claim:
    """One verdict of a file: the question, the models, the verdict over complex parameters if it is
    stored too, and its place.
    """

    verdict: Verdict
    query: Query
    sides: Sides
    equal: Verdict | None
    where: str


Check = Callable[[Claim], Iterator[str]]


def _find_unfounded(claim: Claim) -> Iterator[str]:
    v = claim.verdict
    if v.evidence is None:
        if v.relation is not Relation.UNDECIDED or v.decided_by or v.certainty or v.safety:
            yield f"{claim.where}something is decided without evidence"
        return
    if not follows(v, v.evidence, claim.query):
        yield f"{claim.where}{v.relation}, by {v.rule}, does not follow from evidence of that kind"
    if v.notes != (*notes_of(claim.sides.left, claim.sides.right), *claim.sides.notes):
        yield f"{claim.where}what is decided has notes of what is open"
    equal = claim.equal
    shown_equal = equal is None or equal.relation is Relation.INDISTINGUISHABLE
    if v.decided_by == ADMISSIBLE.name and not shown_equal:
        yield "it rests on equality over complex parameters, which the file does not show"


def _untrue(claim: Claim) -> Iterator[str]:
    v, left, right = claim.verdict, claim.sides.left, claim.sides.right
    if v.evidence is not None and not asking.confirms(left, right, v.evidence, v.representation):
        yield f"{claim.where}the evidence is not true of these models"


def _check_grade(claim: Claim) -> Iterator[str]:
    """Check that the settings find evidence of this kind with this certainty. A theorem whose
    premises hold is not searched for: the settings may give a stronger map today.
    """
    v = claim.verdict
    if v.evidence is None or _is_by_theorem(v):
        return
    again = _again(claim, v.evidence)
    if again is None or again[:2] != (v.certainty, v.safety):
        yield f"{claim.where}the certainty is not that of the evidence"
    elif again[2] is None or _text(again[2]) != _text(v.evidence):
        yield f"{claim.where}the evidence is not the one that the settings give"


def _is_by_theorem(source: Verdict | PositiveFinding) -> bool:
    """Return True if a theorem is the evidence, with its certainty, which leaves no choice."""
    grade = (source.certainty, source.safety)
    return isinstance(source.evidence, Theorem) and grade == (Certainty.THEOREM, 0)


def _again(claim: Claim, evidence: Evidence) -> Claimed | None:
    """Finding with evidence of this kind; None for nothing, or by a condition that was not part of
    the query.
    """
    v = claim.verdict
    if v.decided_by not in (EXACT.name, ADMISSIBLE.name):
        return _condition_again(claim) if v.decided_by in claim.query.conditions else None
    finding = (
        asking.same_again(claim.sides.left, claim.sides.right, evidence)
        if v.decided_by == EXACT.name
        else over_domain(claim.sides.left, claim.sides.right, v.domain, claim.equal)
    )
    return None if finding is None else _claim_of(finding)


def _text(evidence: Evidence) -> str:
    """All of it but what differs from processor to processor and is checked separately."""
    return without_digits(json.dumps(evidence.to_dict()))


def _condition_again(claim: Claim) -> Claimed:
    """Finding of the condition alone; statements that `prove` proved are proven again."""
    v, left, right = claim.verdict, claim.sides.left, claim.sides.right
    view = claim.query.view if claim.query.view in (View.TF, View.MARKOV) else View.COMBINED
    again = decide(left, right, Query(view, (v.decided_by,), claim.query.markov))
    proven = v.certainty is Certainty.PROVEN and again.certainty is Certainty.BOUNDED
    if proven:
        again = prove_again(again, left, right, SECONDS)
    return _claim_of(again) if again.representation is v.representation else (None, 0, None)


def _claim_of(source: Verdict | Finding) -> Claimed:
    return source.certainty, source.safety, source.evidence


def _false_inclusions(claim: Claim) -> Iterator[str]:
    """Yield what is false of limits and of finite elements."""
    v, left, right, where = claim.verdict, claim.sides.left, claim.sides.right, claim.where
    both = v.inclusions
    if both is None:
        yield from (f"{where}{fault}" for fault in _without_evidence(v, left.rank == right.rank))
        return
    if (v.image, v.closure) != (both.image.inclusion, both.closure.inclusion):
        yield f"{where}the inclusion is not that of its evidence"
    if left.rank == right.rank:
        yield f"{where}an inclusion is stated for models of equal rank"
        return
    for what in false_of_inclusions(both, left, right):
        yield f"{where}{what} is not true of these models"
    if _plain(both) != _plain(asking.inclusions(left, right)):
        yield f"{where}the inclusion, or its certainty, is not what the settings give"


def false_of_inclusions(both: Inclusions | None, left: AnySide, right: AnySide) -> Iterator[str]:
    """Yield what evidence of an inclusion is not true of both models; what is no limit has no
    equivalent either, by the same evidence, which is checked once.
    """
    statements = (
        {}
        if both is None
        else {both.image.evidence: "finite elements", both.closure.evidence: "limits"}
    )
    for evidence, what in statements.items():
        if evidence is not None and not asking.includes(left, right, evidence):
            yield f"the evidence of the inclusion ({what})"


def _without_evidence(v: Verdict, equal_rank: bool) -> Iterator[str]:
    if v.image is not v.closure:
        yield "limits and finite elements do not agree"
    if v.closure in ONE_SIDED:
        yield "an inclusion has no evidence"
    apart = v.relation is Relation.DISTINGUISHABLE and v.decided_by != ADMISSIBLE.name
    if v.closure is Inclusion.NEITHER and not (apart and equal_rank):
        yield "an inclusion that is denied has no evidence"


def _plain(both: Inclusions) -> list[InclusionFinding]:
    """Both statements, without words on what is not known."""
    return [replace(finding, reason="") for finding in (both.image, both.closure)]


def _false_shares(claim: Claim) -> Iterator[str]:
    """Yield what is false of positive equivalents: a point is the one that the settings draw."""
    v, left, right, where = claim.verdict, claim.sides.left, claim.sides.right, claim.where
    if isinstance(v.evidence, BothWays):
        shares = (v.left_positive, v.right_positive)
        if shares != (v.evidence.left, v.evidence.right) and shares != (None, None):
            yield f"{where}positive equivalents are stated in two ways"
    for share, side, other in ((v.left_positive, left, right), (v.right_positive, right, left)):
        if share is None:
            continue
        if not asking.has_shares(left, right):
            yield (
                f"{where}positive equivalents are stated for models for which they are not examined"
            )
        elif share.evidence is not None and not asking.confirms_share(side, other, share):
            yield f"{where}the evidence on positive equivalents is not true of these models"
        elif not _is_the_share(share, asking.share(side, other)):
            yield f"{where}the statement on positive equivalents is not what the settings give"


def _is_the_share(share: PositiveFinding, again: PositiveFinding) -> bool:
    """Return True if a statement is what the settings give, by this theorem or another."""
    if _is_by_theorem(share) and _is_by_theorem(again):
        return replace(share, evidence=again.evidence) == again
    return share == again


CHECKS: dict[str, Check] = {
    "that the relation follows from the evidence": _find_unfounded,
    "the evidence": _untrue,
    "certainty and points": _check_grade,
    LIMITS: _false_inclusions,
    SHARES: _false_shares,
}
"""Checks of a claim, by name."""
