"""What evidence claims is said of every kind, and follows only where it may."""

from dataclasses import replace
from typing import get_args

import pytest

from disting import Query, compare
from disting.algebra.certainty import Certainty
from disting.conditions.rule import RULES, Stage
from disting.conditions.table import CONDITIONS
from disting.evidence.conditions import FreeChoice, Renaming
from disting.evidence.decision import THEOREMS, Theorem
from disting.evidence.kinds import Evidence, InclusionEvidence
from disting.evidence.positive import BothWays, PositiveEvidence, PositiveFinding, Share
from disting.model.question import Domain, Relation
from disting.verdict.cascade import follows
from disting.verdict.result import View

COMPLEX = Query(View.EXACT)


def test_every_kind_may_be_carried_and_what_verdicts_never_rest_on_may_not():
    verdicts = set(get_args(Evidence))
    others = {*get_args(InclusionEvidence), *get_args(PositiveEvidence)} - verdicts
    assert all(kind.claim.carriers for kind in verdicts)
    assert others and not any(kind.claim.carriers for kind in others)


@pytest.mark.parametrize("domain", Domain)
def test_theorems(domain):
    told = {name for name in THEOREMS if Theorem(name).shows(domain) is Relation.INDISTINGUISHABLE}
    assert (
        told
        == {
            Domain.COMPLEX: set(THEOREMS),
            Domain.REAL: {"symmetry", "duality", "gears"},
            Domain.POSITIVE: {
                "Foster and Cauer",
                "gears",
                "interlacing",
                "replacement",
                "springs to the ground",
            },
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
    assert both.shows(Domain.POSITIVE).value == shown
    assert both.shows(Domain.REAL) is both.shows(Domain.COMPLEX) is Relation.UNDECIDED


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
