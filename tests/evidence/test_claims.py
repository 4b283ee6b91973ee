"""What evidence claims is said of every kind, and follows only where it may."""

from dataclasses import replace
from typing import get_args

import pytest

from disting import Query, compare
from disting.algebra.certainty import Certainty
from disting.conditions.rule import Stage
from disting.conditions.table import CONDITIONS, RULES
from disting.evidence.claims import CLAIMS
from disting.evidence.conditions import FreeChoice, Renaming
from disting.evidence.decision import THEOREMS, Theorem
from disting.evidence.kinds import Evidence
from disting.evidence.positive import PositiveFinding, Share
from disting.evidence.real import BothWays
from disting.model.domain import Domain
from disting.model.relation import Relation
from disting.verdict import View
from disting.verdict.following import follows

COMPLEX = Query(View.EXACT)


def test_of_every_kind_it_is_said():
    assert set(CLAIMS) == set(get_args(Evidence))
    assert all(claim.carriers for claim in CLAIMS.values())


@pytest.mark.parametrize("domain", Domain)
def test_theorems(domain):
    claim = CLAIMS[Theorem]
    told = {
        name
        for name in THEOREMS
        if claim.shows(Theorem(name), domain) is Relation.INDISTINGUISHABLE
    }
    assert (
        told
        == {
            Domain.COMPLEX: set(THEOREMS),
            Domain.REAL: {"symmetry", "duality"},
            Domain.POSITIVE: {"Foster and Cauer"},
        }[domain]
    )


def finding(share):
    if share is Share.UNKNOWN:
        return PositiveFinding(share, reason="none")
    return PositiveFinding(share, Certainty.THEOREM, 0, Theorem("duality"))


@pytest.mark.parametrize(
    ("left", "right", "shown"),
    [
        ("always", "always", "indistinguishable"),
        ("never", "never", "distinguishable"),
        ("sometimes", "sometimes", "sometimes"),
        ("always", "sometimes", "sometimes"),
        ("unknown", "sometimes", "sometimes"),
        ("unknown", "always", "undecided"),
        ("never", "unknown", "undecided"),
        ("never", "always", "undecided"),
        ("sometimes", "never", "undecided"),
    ],
)
def test_both_ways(left, right, shown):
    both = BothWays(finding(Share(left)), finding(Share(right)))
    shows = CLAIMS[BothWays].shows
    assert shows(both, Domain.POSITIVE).value == shown
    assert shows(both, Domain.REAL) is shows(both, Domain.COMPLEX) is Relation.UNDECIDED


def test_a_verdict_follows_at_its_stage_from_its_evidence_alone():
    """A renaming decides by a condition over complex parameters, and beyond them by the question
    for their values; all other rules and stages are refused.
    """
    found = compare("3:2", "3:5", query=Query(View.EXACT, conditions=("6",)))
    assert isinstance(found.evidence, Renaming) and follows(found, found.evidence, COMPLEX)
    for rule in RULES:
        for stage in set(Stage) - {Stage.NONE}:
            other = replace(found, decided_by=rule, representation=stage)
            sufficient = rule in [c.rule.name for c in CONDITIONS if c.rule.role == "sufficient"]
            structural = rule in [c.rule.name for c in CONDITIONS if c.rule.role == "structural"]
            asked = (sufficient and stage in ("tf", "markov")) or (
                structural and stage is Stage.STRUCTURE
            )
            assert follows(other, found.evidence, COMPLEX) == (
                asked and stage in COMPLEX.view.representations
            )
    beyond = replace(found, domain=Domain.POSITIVE)
    assert not follows(beyond, found.evidence, Query())
    asked = replace(beyond, decided_by="admissible", representation=Stage.PARAMETERS)
    assert follows(asked, found.evidence, Query())
    assert not follows(asked, FreeChoice(1, ("b0",)), Query())
