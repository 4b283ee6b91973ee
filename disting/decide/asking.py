"""Questions about two sides of any kind: the same over complex parameters, the same over a domain,
inclusion, and the share of positive models with a positive equivalent. The tables of
`disting.decide` say how each is answered for a kind of models.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from disting.algebra.certainty import Certainty, joint_safety
from disting.behaviour.profile import Profile
from disting.conditions.inclusion import Inclusions
from disting.conditions.rule import ADMISSIBLE, Finding, Outcome, positive_ways
from disting.conditions.side import AnySide, Ask
from disting.decide import Asked, Table, found_at_once, function, recheck, table_of
from disting.evidence.kinds import Evidence, InclusionEvidence
from disting.evidence.positive import PositiveFinding
from disting.model.question import Domain, Models, Question

Pairs = Sequence[tuple[AnySide, AnySide]]
OVER = {Domain.REAL: Asked.REAL, Domain.POSITIVE: Asked.POSITIVE}
NOT_KNOWN = "whether equivalents under these experiments are {} is not known"


def same(left: AnySide, right: AnySide) -> Finding:
    """Return the exact decision over complex parameters, for equal ranks."""
    table = _table(Asked.SAME, left)
    told: Finding | None = found_at_once(table.at_once, left, right)
    if told is not None:
        return told
    return _ground(table, left, right, left.answerer(*_same_question(left, right), left.settings))


def same_again(left: AnySide, right: AnySide, evidence: Evidence) -> Finding | None:
    """Return the exact decision that the settings make with evidence of this kind, None if none:
    evidence that is true can have been chosen, and then bounds nothing.
    """
    table = _table(Asked.SAME, left)
    told: Finding | None = found_at_once(table.at_once, left, right)
    if told is not None:
        return told if type(told.evidence) is type(evidence) else None
    evidence = evidence.turned if _is_turned(left, right) else evidence
    again = recheck(evidence, table.rows, *left.view.pair(right.view), left.settings)
    return None if again is None else _ground(table, left, right, again)


def confirms(left: AnySide, right: AnySide, evidence: Evidence, representation: str) -> bool:
    """Return True if evidence of a verdict is true of both, found again from scratch. Raises
    NotSeenError where that takes too long.
    """
    check = function(_table(Asked.SAME, left).confirms)
    return bool(check(evidence, left, right, representation))


def over_domain(
    left: AnySide, right: AnySide, domain: Domain, why: Evidence | None = None
) -> Finding:
    """Return the decision over real or positive parameters about two models that are the same over
    complex ones, for the reason `why`.
    """
    table = table_of(OVER[domain], left.view.of)
    if table is None:
        return Finding(ADMISSIBLE, Outcome.ABANDONED, note=NOT_KNOWN.format(domain))
    if table.answer:
        finding: Finding = function(table.answer)(left, right, domain, why)
        return finding
    finding = found_at_once(table.at_once, left, right)
    return finding


def by_shares_both_ways(left: AnySide, right: AnySide) -> Finding:
    """Return the decision over positive parameters by the shares of either model that have a
    positive equivalent in the other.
    """
    return positive_ways(share(left, right), share(right, left))


def inclusions(left: AnySide, right: AnySide) -> Inclusions:
    """Return both statements on two models of unequal rank."""
    both: Inclusions = function(_table(Asked.CLOSURE, left).answer)(left, right)
    return both


def includes(left: AnySide, right: AnySide, evidence: InclusionEvidence) -> bool:
    """Return True if evidence of an inclusion is true of both, found again from scratch."""
    return bool(function(_table(Asked.CLOSURE, left).confirms)(evidence, left, right))


def all_inclusions(pairs: Pairs, ask: Ask) -> list[Inclusions]:
    """Return `inclusions` of many pairs, with what they need computed at once."""
    table = _table(Asked.CLOSURE, pairs[0][0])
    if not table.answer_all:
        return [inclusions(a, b) for a, b in pairs]
    every: list[Inclusions] = function(table.answer_all)(pairs, ask)
    return every


def has_shares(left: AnySide, right: AnySide) -> bool:
    """Return True if verdicts state the shares of positive models of these two."""
    table = table_of(Asked.SHARE, left.view.of)
    return bool(table and table.is_stated and function(table.is_stated)(left, right))


def share(left: AnySide, right: AnySide) -> PositiveFinding:
    """Return which positive models of the left one have a positive equivalent in the right one."""
    question, models = _share_question(left, right)
    return left.answerer(question, models, left.settings)


def confirms_share(left: AnySide, right: AnySide, finding: PositiveFinding) -> bool:
    """Return True if evidence on positive equivalents of the left one in the right one holds."""
    check = function(_table(Asked.SHARE, left).confirms)
    return bool(check(finding, left.view.form, right.view.form))


def prepare_same(pairs: Pairs, ask: Ask) -> None:
    """Compute all that `same` needs for these pairs, many at a time."""
    if pairs:
        rows = _table(Asked.SAME, pairs[0][0]).at_once
        open_pairs = [(a, b) for a, b in pairs if found_at_once(rows, a, b) is None]
        _ask_all([_same_question(a, b) for a, b in open_pairs], ask)


def prepare_shares(ways: Pairs, ask: Ask) -> None:
    """Compute all that `share` needs, many at a time."""
    _ask_all([_share_question(a, b) for a, b in ways], ask)


def prepare_over_domain(pairs: Pairs, domain: Domain, ask: Ask) -> None:
    """Compute all that `over_domain` needs, many at a time."""
    table = table_of(OVER[domain], pairs[0][0].view.of) if pairs else None
    if table is not None and table.prepare:
        function(table.prepare)(pairs, domain, ask)


def _table(asked: Asked, side: AnySide) -> Table:
    table = table_of(asked, side.view.of)
    if table is None:
        raise ValueError(f"no table: {asked} ({side.view.of})")
    return table


def _same_question(left: AnySide, right: AnySide) -> tuple[Question[Finding], Models]:
    return function(_table(Asked.SAME, left).question), left.view.pair(right.view)


def _share_question(left: AnySide, right: AnySide) -> tuple[Question[PositiveFinding], Models]:
    return function(_table(Asked.SHARE, left).question), (left.view.form, right.view.form)


def _ask_all(asked: Sequence[tuple[Question[Any], Models]], ask: Ask) -> None:
    if asked:
        ask(asked[0][0], [models for _, models in asked])


def _is_turned(left: AnySide, right: AnySide) -> bool:
    """Return True if the exact decision is asked with the right model first."""
    return bool(left.view.pair(right.view)[0] != left.view.form)


def _ground(table: Table, left: AnySide, right: AnySide, found: Finding) -> Finding:
    """Return the finding on the pair in its order, as sure as the ranks that are seen equal."""
    found = found.turned if _is_turned(left, right) else found
    found = resting_on_ranks(found, left.transfer_profile, right.transfer_profile)
    if table.ground:
        found = function(table.ground)(left, right, found)
    return found


def resting_on_ranks(finding: Finding, left: Profile, right: Profile) -> Finding:
    """Return the finding on two models whose ranks are seen equal: that it HOLDS is wrong also
    where a rank that is not proven is wrong.
    """
    if finding.outcome is not Outcome.HOLDS or finding.certainty is not Certainty.BOUNDED:
        return finding
    ranks = [p.safety for p in (left, right) if not p.rank_proven]
    return replace(finding, safety=joint_safety([finding.safety, *ranks]))
