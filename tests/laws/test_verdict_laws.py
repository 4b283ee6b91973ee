"""A verdict tells its relation and its proof, and survives JSON."""

import json
from dataclasses import fields
from typing import get_args

import pytest
from hypothesis import given

from disting import Chain, Engine, Family, Query, Relation, Verdict, View, compare
from disting.algebra.certainty import Certainty
from disting.evidence.conditions import Counts
from disting.evidence.kind import Carrier
from disting.evidence.kinds import Evidence, evidence_from
from tests.laws.pairs import any_pair, often, quick, verdict, with_examples


@pytest.mark.full
@often
@with_examples
@given(pair=any_pair)
def test_verdicts_survive_json(pair):
    found = verdict(*pair)
    assert Verdict.from_dict(json.loads(json.dumps(found.to_dict()))) == found
    if found.evidence:
        assert evidence_from(json.loads(json.dumps(found.evidence.to_dict()))) == found.evidence


@pytest.mark.parametrize("data", [{}, {"left": "a"}, {"kind": "counts"}])
def test_other_data_is_no_verdict(data):
    with pytest.raises((KeyError, TypeError, ValueError)):
        Verdict.from_dict(data)


@pytest.mark.parametrize(
    "data",
    [{}, {"kind": "other"}, {"kind": "counts"}, {"kind": "counts", "left": 1, "right": 2, "x": 3}],
)
def test_other_data_is_no_evidence(data):
    with pytest.raises((KeyError, TypeError)):
        evidence_from(data)


@pytest.mark.full
@quick
@with_examples
@given(pair=any_pair)
def test_a_verdict_tells_its_relation_and_its_proof(pair):
    found = verdict(*pair)
    assert found.relation.value in found.sentence
    assert (found.error_bound == "") == (found.relation is Relation.UNDECIDED)
    assert found.error_bound.startswith("2^-") == (found.certainty is Certainty.BOUNDED)
    if found.evidence:
        assert f"condition {found.decided_by}" in found.sentence
        assert found.evidence.formula


def test_a_verdict_is_neither_true_nor_false():
    with pytest.raises(TypeError, match="relation"):
        bool(verdict(Chain(1, damped=False), Chain(2, damped=False)))


DECIDED = {
    "decided_by": "1",
    "representation": "tf",
    "certainty": Certainty.PROVEN,
    "evidence": Counts((1, 1), (2, 2)),
}


@pytest.mark.parametrize("missing", DECIDED)
def test_a_decided_verdict_lacks_nothing(missing):
    assert Verdict("a", "b", Relation.DISTINGUISHABLE, **DECIDED).decided_by == "1"
    incomplete = {key: value for key, value in DECIDED.items() if key != missing}
    with pytest.raises(ValueError, match="exactly a decided verdict"):
        Verdict("a", "b", Relation.DISTINGUISHABLE, **incomplete)


def test_an_undecided_verdict_has_no_proof():
    with pytest.raises(ValueError, match="exactly a decided verdict"):
        Verdict("a", "b", Relation.UNDECIDED, **DECIDED)
    assert (
        Verdict("a", "b", Relation.UNDECIDED).sentence
        == "a and b are undecided over complex parameters: none of the available methods decides them."
    )


def test_verdicts_are_values():
    found = verdict(Chain(1, damped=False), Chain(2, damped=False))
    assert found == verdict(Chain(1, damped=False), Chain(2, damped=False), engine=Engine())
    assert len({found, verdict(Chain(1, damped=False), Chain(2, damped=False))}) == 1
    with pytest.raises(AttributeError):
        found.relation = Relation.UNDECIDED
    assert [f.name for f in fields(found)][:4] == ["left", "right", "relation", "decided_by"]


def test_every_kind_of_evidence_of_the_exact_decision_has_words_for_the_rule():
    """What decided is named: a theorem is not called a fibre."""

    by_exact = [kind for kind in get_args(Evidence) if Carrier.EXACT in kind.claim.carriers]
    assert len(by_exact) > 8 and all(kind.claim.grounds for kind in by_exact)
    dual = compare(Family(3, damped=True)[1], Family(3, damped=True)[11], query=Query(View.EXACT))
    assert (
        dual.rule == "exact decision, a theorem"
        and f"over complex parameters, special values aside ({dual.rule})" in dual.sentence
    )
