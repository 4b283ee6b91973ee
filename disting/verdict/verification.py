"""Checks a verdict from its file alone: the evidence anew at fresh random points, and that all
that the file says follows from it.

Nothing is looked up. What would take more work to see again than is done for it is said, and all
else is checked. Evidence that is true can have been chosen, and then bounds nothing: so certainty,
bounds and points are compared with those that the settings give, found again with evidence of this
kind.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import partial
from pathlib import Path
from typing import Any

from disting.algebra.certainty import Certainty
from disting.conditions.finding import Finding
from disting.conditions.rule import ADMISSIBLE, EXACT
from disting.conditions.side import notes_of
from disting.errors import DistingError, InputError, NotSeenError, shown
from disting.evidence.kinds import Evidence
from disting.evidence.real import BothWays
from disting.files import as_path, read_json
from disting.model.chain import Chain
from disting.model.presentation import summary
from disting.model.question import Domain
from disting.questions.inclusion import ONE_SIDED, Inclusion, InclusionFinding, Inclusions
from disting.verdict.cascade import decide, follows, over_domain
from disting.verdict.comparison import Sides
from disting.verdict.engine import Engine
from disting.verdict.everywhere import FORMAT as EVERYWHERE
from disting.verdict.everywhere import differing_everywhere, read_everywhere
from disting.verdict.proof import proven_again
from disting.verdict.query import Query, View
from disting.verdict.result import Relation, Verdict
from disting.verdict.verdict_file import (
    DAMAGED,
    Stored,
    as_file,
    differing,
    exact,
    has_more,
    read_file,
)

SECONDS = 60.0  # for a proof that took ten
WANTED = "a file of a verdict, as 'disting compare N:I M:J --json' writes it"
LIMITS, SHARES = "which is a limit of the other", "positive equivalents"
Told = tuple[Certainty | None, int, Evidence | None]


class Standing(StrEnum):
    """Whether a verdict holds, as far as its file shows."""

    HOLDS = "holds"
    FAILS = "does not hold"
    OPEN = "cannot be checked alone"


@dataclass(frozen=True, slots=True)
class Verification:
    """What was found, and why it is not "holds".

    `verdicts`: the sentences of the verdicts, none where one does not hold; `models`: whose models
    they are on; `found_again`: what was checked; `as_written`: what the file says and no check can
    show.

    >>> from disting import verdict_file, verify
    >>> verify(verdict_file("2:1", "2:2")).standing.value
    'holds'
    """

    standing: Standing
    reason: str = ""
    verdicts: tuple[str, ...] = ()
    models: str = ""
    found_again: tuple[str, ...] = ()
    as_written: tuple[str, ...] = ()

    def __repr__(self) -> str:
        return summary(self, self.sentence)

    def __bool__(self) -> bool:
        raise TypeError("a verification is not true or false; look at its standing")

    @property
    def sentence(self) -> str:
        """In one sentence, without a subject."""
        because = {Standing.HOLDS: "", Standing.FAILS: ": ", Standing.OPEN: " because "}
        return f"{self.standing.value}{because[self.standing]}{self.reason}"

    @property
    def text(self) -> str:
        """All of it, a thing a line."""
        lines = [self.sentence, *self.verdicts]
        for name, said in (
            ("models", self.models),
            ("found again", "; ".join(self.found_again)),
            ("as written", "; ".join(self.as_written)),
        ):
            lines += [f"{name:<12}{said}"] if said else []
        return "\n".join(lines)


def verify(given: dict[str, Any] | str | Path) -> Verification:
    """Whether a verdict holds: plain data of `verdict_file` or of `everywhere_file`, or the file
    with it as JSON.

    Raises InputError for what is no file of a verdict, or is damaged.

    >>> from disting.verdict.verdict_file import verdict_file
    >>> data = verdict_file("3:1", "3:4", damped=True)
    >>> verify(data).sentence
    'holds'
    >>> verify(data | {"relation": "indistinguishable"}).standing.value
    'does not hold'
    """
    data = given if isinstance(given, dict) else read_json(as_path(given), WANTED)
    if not isinstance(data, dict) or data.get("format") != EVERYWHERE:
        return _verified(data, read_file(data))
    stored = read_everywhere(data)
    other = differing_everywhere(data, stored)
    if other:
        return Verification(Standing.FAILS, _not_agreeing(other))
    found = [_verified(one, read) for one, read in zip(data["verdicts"], stored, strict=True)]
    whole = Verification(
        Standing.HOLDS,
        verdicts=tuple(sentence for one in found for sentence in one.verdicts),
        models=found[0].models,
        found_again=tuple(dict.fromkeys(what for one in found for what in one.found_again)),
        as_written=tuple(dict.fromkeys(what for one in found for what in one.as_written)),
    )
    for standing in (Standing.FAILS, Standing.OPEN):
        where = next((i for i, one in enumerate(found) if one.standing is standing), None)
        if where is not None:
            base = whole if standing is Standing.OPEN else Verification(standing)
            reason = f"{found[where].reason} (way {where + 1})"
            return replace(base, standing=standing, reason=reason)
    return whole


def _verified(data: dict[str, Any], stored: Stored) -> Verification:
    """What all checks find; those that take too long leave it open, if nothing is wrong."""
    unseen, seen = list[str](), list[str]()
    written = [
        f"the settings that choose the random points (seed {shown(stored.settings.seed)})",
        f"the version that wrote it ({data['program']})",
    ]
    try:
        sides = stored.sides(Engine(settings=stored.settings))
        for what, check in _checks(data, stored, sides):
            try:
                wrong = next(check(), "")
            except NotSeenError as reason:
                unseen.append(str(reason))
                written.append(what)
                continue
            if wrong:
                return Verification(Standing.FAILS, wrong)
            seen.append(what)
    except InputError as reason:
        raise InputError(f"the file of the verdict is damaged ({reason})") from None
    except (*DAMAGED, DistingError, RecursionError, AssertionError) as reason:
        return Verification(Standing.FAILS, f"it is damaged ({type(reason).__name__}: {reason})")
    if stored.verdict.evidence is None:
        unseen.append("it is undecided: it says nothing that evidence could show")
    told = Verification(
        Standing.OPEN if unseen else Standing.HOLDS,
        unseen[0] if unseen else "",
        (as_file(stored)["sentence"],),
        _whose(stored, sides),
        tuple(filter(None, dict.fromkeys(seen))),
        tuple(filter(None, dict.fromkeys(written))),
    )
    return told


def _whose(stored: Stored, sides: Sides) -> str:
    """Whose models they are: a model of one's own may have a name that reads like a chain's."""
    names = (sides.left.name, sides.right.name)
    own = [n for n, m in zip(names, stored.models, strict=True) if not isinstance(m, Chain)]
    if not own:
        if any(name.startswith("(") for name in names):
            return "; ".join(dict.fromkeys(f"{name}: {_kind_of(name)}" for name in names))
        return f"{' and '.join(dict.fromkeys(names))}: numbered chains, the catalogue's numbers"
    rest = [name for name in names if name not in own]
    beside = f"; {rest[0]}: {_kind_of(rest[0])}" if rest else ""
    return f"{' and '.join(own)}: of your file, not of the catalogue{beside}"


def _kind_of(name: str) -> str:
    """What a chain of this name is; one without a number is named by its indices, in brackets."""
    return "a chain without a number" if name.startswith("(") else "a numbered chain"


@dataclass(frozen=True, slots=True)
class _Claim:
    """One verdict of a file: what was asked, of what, that over complex parameters if it is told
    beside it, and where it stands.
    """

    verdict: Verdict
    query: Query
    sides: Sides
    equal: Verdict | None
    where: str


Check = Callable[[_Claim], Iterator[str]]


def _checks(
    data: dict[str, Any], stored: Stored, sides: Sides
) -> Iterator[tuple[str, Callable[[], Iterator[str]]]]:
    """Yield what is looked at, "" where there is nothing of it, with what yields what does not
    hold, cheap things first.
    """
    yield "models, sentence and all that is derived", partial(_disagreeing, data, stored, sides)
    beside = stored.over_complex
    claims = [_Claim(stored.verdict, stored.query, sides, beside, "")]
    if beside is not None:
        query, where = exact(stored.query), "over complex parameters "
        claims.append(_Claim(beside, query, sides, None, where))
    for what, check in CHECKS.items():
        yield from (_named(what, claim, check) for claim in claims)
    yield "", partial(_false_equality, stored)


def _named(what: str, claim: _Claim, check: Check) -> tuple[str, Callable[[], Iterator[str]]]:
    """The check of a claim, and what it is called if there is anything to check."""
    v = claim.verdict
    shares = v.right_positive if v.left_positive is None else v.left_positive
    there = {LIMITS: v.inclusions, SHARES: shares}.get(what, v.evidence) is not None
    where = f", {claim.where.strip()}" * bool(claim.where)
    return f"{what}{where}" * there, partial(check, claim)


def _disagreeing(data: dict[str, Any], stored: Stored, sides: Sides) -> Iterator[str]:
    other = differing(data, stored, sides)
    if other:
        yield _not_agreeing(other)
    if stored.verdict.domain is not stored.query.view.domain:
        yield "the domain is not the one that was asked for"
    if (stored.over_complex is not None) != has_more(stored.verdict):
        yield "the verdict over complex parameters is missing, or there for nothing"


def _not_agreeing(what: str) -> str:
    return f"what it says does not agree with its evidence and models ({what})"


def _unfounded(claim: _Claim) -> Iterator[str]:
    v = claim.verdict
    if v.evidence is None:
        return
    if not follows(v, v.evidence, claim.query):
        yield f"{claim.where}{v.relation}, by {v.rule}, does not follow from evidence of that kind"
    if v.notes != (*notes_of(claim.sides.left, claim.sides.right), *claim.sides.notes):
        yield f"{claim.where}what is decided has notes of what is open"
    equal = claim.equal
    known = equal is None or equal.relation is Relation.INDISTINGUISHABLE
    if v.decided_by == ADMISSIBLE.name and not known:
        yield "it rests on equality over complex parameters, which the file does not show"


def _untrue(claim: _Claim) -> Iterator[str]:
    v, left, right = claim.verdict, claim.sides.left, claim.sides.right
    if v.evidence is not None and not left.confirms(right, v.evidence, v.representation):
        yield f"{claim.where}the evidence is not true of these models"


def _ungraded(claim: _Claim) -> Iterator[str]:
    """Whether the settings find evidence of this kind with this certainty."""
    v = claim.verdict
    if v.evidence is None:
        return
    again = _again(claim, v.evidence)
    if again is None or again[:2] != (v.certainty, v.safety):
        yield f"{claim.where}the certainty is not that of the evidence"
    elif again[2] != v.evidence:
        yield f"{claim.where}the evidence is not the one that the settings give"


def _again(claim: _Claim, evidence: Evidence) -> Told | None:
    """What is found with evidence of this kind; None for nothing, or by a condition that was not
    asked.
    """
    v = claim.verdict
    if v.decided_by not in (EXACT.name, ADMISSIBLE.name):
        return _condition_again(claim) if v.decided_by in claim.query.conditions else None
    found = (
        claim.sides.left.exact_again(claim.sides.right, evidence)
        if v.decided_by == EXACT.name
        else over_domain(claim.sides.left, claim.sides.right, v.domain, claim.equal)
    )
    return None if found is None else _told(found)


def _condition_again(claim: _Claim) -> Told:
    """What the condition alone finds; what `prove` proved of it is proven again."""
    v, left, right = claim.verdict, claim.sides.left, claim.sides.right
    view = claim.query.view if claim.query.view in (View.TF, View.MARKOV) else View.COMBINED
    again = decide(left, right, Query(view, (v.decided_by,), claim.query.markov))
    proven = v.certainty is Certainty.PROVEN and again.certainty is Certainty.BOUNDED
    if proven:
        again = proven_again(again, left, right, SECONDS)
    return _told(again) if again.representation is v.representation else (None, 0, None)


def _told(found: Verdict | Finding) -> Told:
    return found.certainty, found.safety, found.evidence


def _false_inclusions(claim: _Claim) -> Iterator[str]:
    """Yield what is false of limits and of finite elements."""
    v, left, right, where = claim.verdict, claim.sides.left, claim.sides.right, claim.where
    both = v.inclusions
    if both is None:
        yield from (f"{where}{said}" for said in _without_evidence(v, left.rank == right.rank))
        return
    if (v.image, v.closure) != (both.image.inclusion, both.closure.inclusion):
        yield f"{where}the inclusion is not that of its evidence"
    if left.rank == right.rank:
        yield f"{where}an inclusion is told of models of equal rank"
        return
    for found, what in ((both.image, "finite elements"), (both.closure, "limits")):
        if found.evidence is not None and not left.includes(right, found.evidence):
            yield f"{where}the evidence of the inclusion ({what}) is not true of these models"
    if _plain(both) != _plain(left.inclusions(right)):
        yield f"{where}the inclusion, or its certainty, is not what the settings give"


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
    return [replace(found, reason="") for found in (both.image, both.closure)]


def _false_shares(claim: _Claim) -> Iterator[str]:
    """Yield what is false of positive equivalents: a point is the one that the settings draw."""
    v, left, right, where = claim.verdict, claim.sides.left, claim.sides.right, claim.where
    if isinstance(v.evidence, BothWays):
        told = (v.left_positive, v.right_positive)
        if told != (v.evidence.left, v.evidence.right) and told != (None, None):
            yield f"{where}positive equivalents are told in two ways"
    for found, given, other in ((v.left_positive, left, right), (v.right_positive, right, left)):
        if found is None:
            continue
        if not left.tells_shares(right):
            yield f"{where}positive equivalents are told of models of which they are not asked"
        elif found.evidence is not None and not given.proves(other, found):
            yield f"{where}the evidence on positive equivalents is not true of these models"
        elif found != given.positive(other):
            yield f"{where}what is told of positive equivalents is not what the settings give"


def _false_equality(stored: Stored) -> Iterator[str]:
    """Yield what is told of complex parameters and not found there."""
    v, beside = stored.verdict, stored.over_complex
    there = v if beside is None else beside
    same = there.relation is Relation.INDISTINGUISHABLE and there.domain is Domain.COMPLEX
    if v.closure is Inclusion.EQUAL and not same:
        yield "equality over complex parameters is told without evidence"
    if beside is None:
        return
    if beside.domain is not Domain.COMPLEX:
        yield "the verdict over complex parameters is over others"
    if (v.image, v.closure) != (beside.image, beside.closure):
        yield "what is told of complex parameters is not what the verdict over them says"
    if same and beside.closure not in (Inclusion.EQUAL, Inclusion.UNKNOWN):
        yield "equality over complex parameters is denied"
    if v.relation is not Relation.UNDECIDED and beside.relation is Relation.DISTINGUISHABLE:
        yield "models that differ over complex parameters differ over others too"


CHECKS: dict[str, Check] = {
    "that the relation follows from the evidence": _unfounded,
    "the evidence": _untrue,
    "certainty and points": _ungraded,
    LIMITS: _false_inclusions,
    SHARES: _false_shares,
}
"""What is looked at of a claim, and how."""
