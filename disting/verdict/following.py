"""What follows from evidence of a kind: which relation, by which rule, over which domain."""

from typing import Any

from disting.conditions.rule import ADMISSIBLE, EXACT, Role, Stage
from disting.conditions.table import RULES
from disting.evidence.conditions import (
    Counts,
    Embedding,
    Forms,
    FreeChoice,
    Ranks,
    Renaming,
    Supermodel,
)
from disting.evidence.decision import DeadTime, FibreAt, FibreUnder, Theorem
from disting.evidence.general import Constants, Explicit, NoEquivalent, Witnesses
from disting.evidence.ideals import FullRows, Refuted, Shared, Solved
from disting.evidence.kinds import Evidence
from disting.evidence.real import BothWays, OddFibres, RealFactors, RealWitnesses
from disting.model.domain import Domain
from disting.questions.same.real_and_positive import RATIONAL, positive_ways
from disting.verdict.cascade import PROVES
from disting.verdict.query import Query
from disting.verdict.result import Relation, Verdict

APART = (DeadTime, FibreUnder, Refuted, Shared, Constants)  # of the exact decision
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
OF_GENERAL_MODELS = {
    Explicit: Relation.INDISTINGUISHABLE,
    NoEquivalent: Relation.DISTINGUISHABLE,
    Witnesses: Relation.SOMETIMES,
}
POSITIVE_THEOREM = "Foster and Cauer"  # of general models


def follows(v: Verdict, evidence: Evidence, query: Query) -> bool:
    """Whether evidence of this kind shows this relation, by this rule, over this domain, where the
    query lets it decide.
    """
    rule, kind = RULES[v.decided_by], type(evidence)
    if rule is ADMISSIBLE:
        return v.representation is Stage.PARAMETERS and v.relation is _admissibly(
            evidence, v.domain
        )
    if v.representation not in query.view.representations:
        return False
    if rule is EXACT:
        return v.representation is Stage.FIBRE and v.relation is _exactly(evidence, v.domain)
    told = v.decided_by in BY_CONDITION.get(kind, ()) and v.representation in STAGES[rule.role]
    (relation,) = PROVES[rule.role].values()
    over = v.domain is Domain.COMPLEX or relation is Relation.DISTINGUISHABLE
    all_rows = not isinstance(evidence, Ranks) or evidence.all_rows == (v.decided_by == "4")
    return told and over and all_rows and v.relation is relation


def _exactly(evidence: Evidence, domain: Domain) -> Relation:
    """What evidence of the exact decision shows; equality over complex parameters alone."""
    if isinstance(evidence, APART) or (
        isinstance(evidence, FibreAt) and evidence.grounds == "refuted"
    ):
        return Relation.DISTINGUISHABLE
    same = isinstance(evidence, (*SAME, FibreAt))
    known = same and domain is Domain.COMPLEX
    return Relation.INDISTINGUISHABLE if known else Relation.UNDECIDED


def _admissibly(evidence: Evidence, domain: Domain) -> Relation:
    """What evidence on real or positive parameters shows over this domain."""
    match evidence:
        case BothWays() if domain is Domain.POSITIVE:
            outcome = positive_ways(evidence.left, evidence.right).outcome
            return PROVES[ADMISSIBLE.role].get(outcome, Relation.UNDECIDED)
        case Theorem():
            names = {Domain.REAL: RATIONAL, Domain.POSITIVE: (POSITIVE_THEOREM,)}
            known = evidence.name in names.get(domain, ())
            return Relation.INDISTINGUISHABLE if known else Relation.UNDECIDED
        case RealFactors() | OddFibres() if domain is Domain.REAL:
            return Relation.INDISTINGUISHABLE
        case RealWitnesses() if domain is Domain.REAL:
            return Relation.SOMETIMES
        case Explicit() | NoEquivalent() | Witnesses() if evidence.domain == domain:
            return OF_GENERAL_MODELS[type(evidence)]
        case Renaming() if domain is not Domain.COMPLEX:
            return Relation.INDISTINGUISHABLE
    return Relation.UNDECIDED
