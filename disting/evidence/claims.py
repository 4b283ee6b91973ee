"""What evidence claims: who may carry it, and which relation it shows over which parameters.

A condition is any row of the table of conditions: which one it was is seen by asking that row
again. What shows that models are the same over complex parameters says nothing of others, unless
it gives their values.
"""

from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from typing import Any

from disting.evidence.conditions import (
    Counts,
    Embedding,
    Forms,
    FreeChoice,
    Ranks,
    Renaming,
    Supermodel,
)
from disting.evidence.decision import RATIONAL, DeadTime, FibreAt, FibreUnder, Theorem
from disting.evidence.general import Constants, Explicit, NoEquivalent, Witnesses
from disting.evidence.ideals import FullRows, Refuted, Shared, Solved
from disting.evidence.kinds import Evidence
from disting.evidence.positive import Share
from disting.evidence.real import BothWays, OddFibres, RealFactors, RealWitnesses
from disting.model.domain import Domain
from disting.model.relation import Relation

APART, SAME, SOMETIMES, NOTHING = (
    Relation.DISTINGUISHABLE,
    Relation.INDISTINGUISHABLE,
    Relation.SOMETIMES,
    Relation.UNDECIDED,
)


class Carrier(StrEnum):
    """Who decides by it: a condition, the exact decision, or the one on real and positive
    parameters.
    """

    CONDITION = "condition"
    EXACT = "exact"
    ADMISSIBLE = "admissible"


@dataclass(frozen=True, slots=True)
class Claim:
    """`carriers` of evidence of a kind, and what it `shows` over a domain, UNDECIDED: nothing."""

    carriers: tuple[Carrier, ...]
    shows: Callable[[Any, Domain], Relation]


def _apart(evidence: Evidence, domain: Domain) -> Relation:
    """Over complex parameters, so over real and positive ones, which are dense among them."""
    return APART


def _same(evidence: Evidence, domain: Domain) -> Relation:
    """It takes real values to real ones and positive ones to positive ones."""
    return SAME


def _same_over_complex(evidence: Evidence, domain: Domain) -> Relation:
    return SAME if domain is Domain.COMPLEX else NOTHING


def _over(domain: Domain, relation: Relation) -> Callable[[Any, Domain], Relation]:
    """That relation over that domain alone."""
    return lambda evidence, asked: relation if asked is domain else NOTHING


def _of_its_domain(relation: Relation) -> Callable[[Any, Domain], Relation]:
    """That relation over the domain that the evidence names."""
    return lambda evidence, asked: relation if evidence.domain == asked else NOTHING


def _fibre(evidence: FibreAt, domain: Domain) -> Relation:
    return APART if evidence.grounds == "refuted" else _same_over_complex(evidence, domain)


def _theorem(evidence: Theorem, domain: Domain) -> Relation:
    known = {
        Domain.COMPLEX: True,
        Domain.REAL: evidence.name in RATIONAL,
        # of positive models of chains it is told which way they have equivalents: `BothWays`
        Domain.POSITIVE: evidence.name == "Foster and Cauer",
    }
    return SAME if known[domain] else NOTHING


def _both_ways(evidence: BothWays, domain: Domain) -> Relation:
    shares = {Share.ALWAYS: SAME, Share.NEVER: APART, Share.SOMETIMES: SOMETIMES}
    return shares.get(evidence.share, NOTHING) if domain is Domain.POSITIVE else NOTHING


_CONDITION, _EXACT, _ADMISSIBLE = ((carrier,) for carrier in Carrier)
CLAIMS: dict[type[Any], Claim] = {
    Counts: Claim(_CONDITION, _apart),
    Forms: Claim(_CONDITION, _apart),
    Ranks: Claim(_CONDITION, _apart),
    Renaming: Claim(_CONDITION + _ADMISSIBLE, _same),
    FreeChoice: Claim(_CONDITION, _same_over_complex),
    Embedding: Claim(_CONDITION, _same_over_complex),
    Supermodel: Claim(_CONDITION, _same_over_complex),
    Theorem: Claim(tuple(Carrier), _theorem),
    DeadTime: Claim(_EXACT, _apart),
    FibreAt: Claim(_EXACT, _fibre),
    FibreUnder: Claim(_EXACT, _apart),
    FullRows: Claim(_EXACT, _same_over_complex),
    Solved: Claim(_EXACT, _same_over_complex),
    Refuted: Claim(_EXACT, _apart),
    Shared: Claim(_EXACT, _apart),
    Constants: Claim(_EXACT, _apart),
    BothWays: Claim(_ADMISSIBLE, _both_ways),
    RealFactors: Claim(_ADMISSIBLE, _over(Domain.REAL, SAME)),
    RealWitnesses: Claim(_ADMISSIBLE, _over(Domain.REAL, SOMETIMES)),
    OddFibres: Claim(_ADMISSIBLE, _over(Domain.REAL, SAME)),
    Explicit: Claim(_ADMISSIBLE, _of_its_domain(SAME)),
    NoEquivalent: Claim(_ADMISSIBLE, _of_its_domain(APART)),
    Witnesses: Claim(_ADMISSIBLE, _of_its_domain(SOMETIMES)),
}
"""Of every kind of evidence."""
