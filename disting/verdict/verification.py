"""Checks a verdict from its file alone: the evidence anew at fresh random points, and that all
that the file says follows from it.

Nothing is looked up, and nothing is searched that the evidence names: see
`disting.questions.same.evidence_check`.
"""

import json
from collections.abc import Iterator
from dataclasses import dataclass, replace
from enum import StrEnum
from pathlib import Path
from typing import Any

from disting.algebra.certainty import LEAST_SAFETY, Certainty
from disting.conditions.rule import ADMISSIBLE, EXACT, Role, Stage
from disting.conditions.table import CONDITIONS, RULES
from disting.errors import DistingError, InputError
from disting.evidence.conditions import (
    Counts,
    Embedding,
    Forms,
    FreeChoice,
    Ranks,
    Renaming,
    Supermodel,
)
from disting.evidence.decision import DeadTime, FibreAt, Theorem
from disting.evidence.ideals import ByRow, FullRows, Refuted, Shared, Solved
from disting.evidence.kinds import Evidence
from disting.evidence.limits import FullImage, LargerProjection
from disting.evidence.real import BothWays, OddFibres, RealFactors, RealWitnesses
from disting.fibres.synthesis.decide import safety_of_point
from disting.model.domain import Domain
from disting.model.shown import summary
from disting.model.symmetry import canonical
from disting.questions.inclusion import ONE_SIDED, Inclusion, InclusionFinding
from disting.questions.inclusion import confirms as confirms_inclusion
from disting.questions.positive import proves
from disting.questions.same.evidence_check import Witness
from disting.questions.same.exact import by_synthesis, mirrored
from disting.questions.same.real_and_positive import RATIONAL, positive_share, positive_ways
from disting.verdict.cascade import PROVES, decide
from disting.verdict.chains import ComparedChain
from disting.verdict.proof import prove
from disting.verdict.query import Query, View
from disting.verdict.result import Relation, Verdict
from disting.verdict.verdict_file import Stored, differing, has_more, read_file

APART = (DeadTime, Refuted, Shared, ByRow)  # of the exact decision
SAME = (Theorem, FullRows, Solved)
BY_CONDITION: dict[type[Any], tuple[str, ...]] = {
    Counts: ("1", "2"),
    Forms: ("3",),
    Ranks: ("4", "5"),
    Renaming: ("6",),
    FreeChoice: ("7",),
    Embedding: ("8",),
    Supermodel: ("9",),
}  # the conditions that have evidence of a kind
STAGES = {
    Role.NECESSARY: (Stage.TF, Stage.MARKOV),
    Role.SUFFICIENT: (Stage.TF, Stage.MARKOV),
    Role.STRUCTURAL: (Stage.STRUCTURE,),
}
BY_CHANCE = (FullImage, LargerProjection, FibreAt, Refuted, Solved)  # never more than bounded
SECONDS = 60.0  # for a proof that took ten
DAMAGED = (KeyError, TypeError, ValueError, AttributeError, LookupError, ArithmeticError)


class Standing(StrEnum):
    """Whether a verdict holds, as far as its file shows."""

    HOLDS = "holds"
    FAILS = "does not hold"
    OPEN = "cannot be checked alone"


@dataclass(frozen=True, slots=True)
class Verification:
    """What was found, and why it is not "holds"."""

    standing: Standing
    reason: str = ""

    def __repr__(self) -> str:
        return summary(self, self.sentence)

    def __bool__(self) -> bool:
        raise TypeError("a verification is not true or false; look at its standing")

    @property
    def sentence(self) -> str:
        """In one sentence, without a subject."""
        because = {Standing.HOLDS: "", Standing.FAILS: ": ", Standing.OPEN: " because "}
        return f"{self.standing.value}{because[self.standing]}{self.reason}"


def verify(given: dict[str, Any] | str | Path) -> Verification:
    """Whether a verdict holds: plain data of `verdict_file`, or the file with it as JSON.

    Raises InputError for what is no file of a verdict.

    >>> from disting.verdict.verdict_file import verdict_file
    >>> data = verdict_file("3:1", "3:4", damped=True)
    >>> verify(data).sentence
    'holds'
    >>> verify(data | {"relation": "indistinguishable"}).standing.value
    'does not hold'
    """
    data = given if isinstance(given, dict) else _read(Path(given))
    try:
        stored = read_file(data)
        wrong = next(_wrong(data, stored), "")
        why_open = "" if wrong else next(_open(stored), "")
    except InputError:
        raise
    except (*DAMAGED, DistingError) as reason:
        return Verification(Standing.FAILS, f"it is damaged ({type(reason).__name__}: {reason})")
    if wrong:
        return Verification(Standing.FAILS, wrong)
    return Verification(Standing.OPEN, why_open) if why_open else Verification(Standing.HOLDS)


def _read(path: Path) -> Any:
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except OSError as reason:
        raise InputError(f"{path} cannot be read ({reason.strerror})") from None
    except (ValueError, RecursionError):
        raise InputError(
            f"{path} holds no JSON; 'disting compare N:I M:J --json' writes a verdict"
        ) from None


def _wrong(data: dict[str, Any], stored: Stored) -> Iterator[str]:
    """Yield what does not hold, cheap things first."""
    other = differing(data, stored)
    if other:
        yield f"what it says does not agree with its evidence and models ({other})"
    if stored.verdict.domain is not stored.query.view.domain:
        yield "the domain is not the one that was asked for"
    if (stored.over_complex is not None) != has_more(stored.verdict):
        yield "the verdict over complex parameters is missing, or there for nothing"
    sides = _Sides.of(stored)
    if stored.over_complex is not None:
        query = replace(stored.query, view=View.EXACT)
        yield from _false(stored.over_complex, query, sides, "over complex parameters ")
    yield from _false(stored.verdict, stored.query, sides, "")
    yield from _false_equality(stored)


def _open(stored: Stored) -> Iterator[str]:
    """Yield why what holds is not all that would have to be seen."""
    if stored.verdict.evidence is None:
        yield "it is undecided: it says nothing that evidence could show"
    beside = stored.over_complex
    rests = isinstance(stored.verdict.evidence, OddFibres | RealFactors)
    if rests and (beside is None or beside.evidence is None):
        yield "it rests on equality over complex parameters, which the file does not show"


@dataclass(frozen=True, slots=True)
class _Sides:
    """Both chains as sides of a comparison, with the settings of the file, and who sees evidence
    anew.
    """

    left: ComparedChain
    right: ComparedChain
    witness: Witness

    @staticmethod
    def of(stored: Stored) -> "_Sides":
        """Those of a file."""
        names = (stored.verdict.left, stored.verdict.right)
        left, right = (
            ComparedChain(name, chain, stored.settings)
            for name, chain in zip(names, stored.chains, strict=True)
        )
        return _Sides(left, right, Witness())


def _false(v: Verdict, query: Query, sides: _Sides, where: str) -> Iterator[str]:
    """Yield what is false of one verdict."""
    if v.evidence is not None:
        if not _follows(v, v.evidence):
            yield f"{where}{v.relation}, by {v.rule}, does not follow from evidence of that kind"
        chains = sides.left.chain, sides.right.chain
        if not sides.witness.confirms(v.evidence, v.representation, *chains):
            yield f"{where}the evidence is not true of these models"
        if isinstance(v.evidence, FibreAt) and not _drawn(v.evidence, sides):
            yield f"{where}the point of the fibre is not the one that the seed draws"
        if not _graded(v, query, sides):
            yield f"{where}the certainty is not that of the evidence"
        if v.notes:
            yield f"{where}what is decided has notes of what is open"
    yield from (f"{where}{said}" for said in _false_inclusions(v, query, sides))
    yield from (f"{where}{said}" for said in _false_shares(v, sides))


def _follows(v: Verdict, evidence: Evidence) -> bool:
    """Whether evidence of this kind shows this relation, by this rule, over this domain."""
    rule, kind = RULES[v.decided_by], type(evidence)
    if rule.role in STAGES:
        told = v.decided_by in BY_CONDITION.get(kind, ()) and v.representation in STAGES[rule.role]
        (relation,) = PROVES[rule.role].values()
        over = v.domain is Domain.COMPLEX or relation is Relation.DISTINGUISHABLE
        all_rows = not isinstance(evidence, Ranks) or evidence.all_rows == (v.decided_by == "4")
        return told and over and all_rows and v.relation is relation
    if rule is EXACT:
        return v.representation is Stage.FIBRE and v.relation is _exactly(evidence, v.domain)
    if rule is not ADMISSIBLE or v.representation is not Stage.PARAMETERS:
        return False
    match evidence:
        case BothWays():
            outcome = positive_ways(evidence.left, evidence.right).outcome
            shown = PROVES[rule.role].get(outcome, Relation.UNDECIDED)
            return v.domain is Domain.POSITIVE and v.relation is shown
        case Theorem():
            real = v.domain is Domain.REAL and evidence.name in RATIONAL
            return real and v.relation is Relation.INDISTINGUISHABLE
        case RealFactors() | OddFibres():
            return v.domain is Domain.REAL and v.relation is Relation.INDISTINGUISHABLE
        case RealWitnesses():
            return v.domain is Domain.REAL and v.relation is Relation.SOMETIMES
    renamed = isinstance(evidence, Renaming) and v.domain is not Domain.COMPLEX
    return renamed and v.relation is Relation.INDISTINGUISHABLE


def _exactly(evidence: Evidence, domain: Domain) -> Relation:
    """What evidence of the exact decision shows; equality over complex parameters alone."""
    if isinstance(evidence, APART) or (
        isinstance(evidence, FibreAt) and evidence.grounds == "refuted"
    ):
        return Relation.DISTINGUISHABLE
    same = isinstance(evidence, (*SAME, FibreAt))
    known = same and domain is Domain.COMPLEX
    return Relation.INDISTINGUISHABLE if known else Relation.UNDECIDED


def _graded(v: Verdict, query: Query, sides: _Sides) -> bool:
    """Whether the evidence is as sure as the verdict says: conditions are asked once more, each
    alone; a fibre bounds its own error.
    """
    if v.certainty is Certainty.BOUNDED and v.safety < LEAST_SAFETY:
        return False
    if v.certainty is not Certainty.BOUNDED and v.safety:
        return False
    if v.decided_by in [c.rule.name for c in CONDITIONS]:
        return v.decided_by in query.conditions and _condition_again(v, query, sides)
    match v.evidence:
        case BothWays():
            again = positive_ways(v.evidence.left, v.evidence.right)
            return (v.certainty, v.safety) == (again.certainty, again.safety)
        case Theorem() | DeadTime() | RealFactors():
            return v.certainty is Certainty.THEOREM
        case FibreAt() if v.certainty is Certainty.BOUNDED:
            searched = sides.right if v.evidence.left_given else sides.left
            plain = replace(searched.canonical.chain, dead_time=False)
            return v.safety <= safety_of_point(plain)
        case Renaming():
            return True  # as sure as equality over complex parameters
        case FullRows():
            return v.certainty is Certainty.PROVEN
        case RealWitnesses():
            return v.certainty is not Certainty.THEOREM
    return v.certainty is Certainty.BOUNDED


def _drawn(evidence: FibreAt, sides: _Sides) -> bool:
    """Whether the fibre is over the point that the settings draw: one that somebody chose could be
    special.
    """
    first, second = sides.left.in_order(sides.right)
    again = by_synthesis(first, second, sides.left.settings)
    if again is None:
        return False
    found = again if first == sides.left.canonical.chain else mirrored(again)
    return found.evidence == evidence


def _condition_again(v: Verdict, query: Query, sides: _Sides) -> bool:
    """Whether the condition finds the same; what `prove` proved of it is proven again."""
    view = query.view if query.view in (View.TF, View.MARKOV) else View.COMBINED
    alone = Query(view, (v.decided_by,), query.markov)
    again = replace(decide(sides.left, sides.right, alone), domain=v.domain)
    if v.certainty is Certainty.PROVEN and again.certainty is Certainty.BOUNDED:
        again = prove(again, sides.left.chain, sides.right.chain, SECONDS)
    grades = [(x.representation, x.certainty, x.safety, x.evidence) for x in (v, again)]
    return grades[0] == grades[1]


def _false_inclusions(v: Verdict, query: Query, sides: _Sides) -> Iterator[str]:
    """Yield what is false of limits and of finite elements."""
    both = v.inclusions
    if both is None:
        if v.image is not v.closure:
            yield "limits and finite elements do not agree"
        if v.closure in ONE_SIDED:
            yield "an inclusion has no evidence"
        apart = v.relation is Relation.DISTINGUISHABLE and v.decided_by != ADMISSIBLE.name
        if v.closure is Inclusion.NEITHER and (not apart or sides.left.rank != sides.right.rank):
            yield "an inclusion that is denied has no evidence"
        return
    if (v.image, v.closure) != (both.image.inclusion, both.closure.inclusion):
        yield "the inclusion is not that of its evidence"
    for found, what in ((both.image, "finite elements"), (both.closure, "limits")):
        if found.evidence is not None and not _included(found, sides):
            yield f"the evidence of the inclusion ({what}) is not true of these models"


def _included(found: InclusionFinding, sides: _Sides) -> bool:
    """Whether the evidence is true, and speaks of the model of the smaller rank."""
    smaller = (
        Inclusion.LEFT_IN_RIGHT if sides.left.rank < sides.right.rank else Inclusion.RIGHT_IN_LEFT
    )
    turned = found.inclusion in ONE_SIDED and found.inclusion is not smaller
    evidence, bounded = found.evidence, found.certainty is Certainty.BOUNDED
    surely = found.certainty is Certainty.PROVEN and not isinstance(evidence, BY_CHANCE)
    graded = found.safety >= LEAST_SAFETY if bounded else surely and not found.safety
    return (
        evidence is not None
        and not turned
        and found.inclusion is not Inclusion.EQUAL
        and graded
        and confirms_inclusion(evidence, sides.left, sides.right)
    )


def _false_shares(v: Verdict, sides: _Sides) -> Iterator[str]:
    """Yield what is false of positive equivalents."""
    if isinstance(v.evidence, BothWays):
        told = (v.left_positive, v.right_positive)
        if told != (v.evidence.left, v.evidence.right) and told != (None, None):
            yield "positive equivalents are told in two ways"
    a, b = (canonical(side.chain).chain for side in (sides.left, sides.right))
    for found, given, other in ((v.left_positive, a, b), (v.right_positive, b, a)):
        if found is None or found.evidence is None:
            continue
        if not proves(found, given, other):
            yield "the evidence on positive equivalents is not true of these models"
        random = found.empirical or found.certainty is Certainty.BOUNDED
        if random and found != positive_share(given, other, sides.left.settings):
            yield "what random points show of positive equivalents is not what the seed draws"


def _false_equality(stored: Stored) -> Iterator[str]:
    """Yield what is told of complex parameters and not found there."""
    beside, v = stored.over_complex, stored.verdict
    if beside is None:
        same = v.relation is Relation.INDISTINGUISHABLE
        if v.closure is Inclusion.EQUAL and not (same and v.domain is Domain.COMPLEX):
            yield "equality over complex parameters is told without evidence"
        return
    if (v.image, v.closure) != (beside.image, beside.closure):
        yield "what is told of complex parameters is not what the verdict over them says"
    wants = {Relation.INDISTINGUISHABLE: Inclusion.EQUAL}.get(beside.relation)
    if wants and beside.closure not in (wants, Inclusion.UNKNOWN):
        yield "equality over complex parameters is denied"
    if v.relation is not Relation.UNDECIDED and beside.relation is Relation.DISTINGUISHABLE:
        yield "models that differ over complex parameters differ over others too"
