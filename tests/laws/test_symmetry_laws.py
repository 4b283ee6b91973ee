"""Mirrored pairs and symmetric models have mirrored and equal verdicts."""

import pytest
from hypothesis import given

from disting import Relation
from disting.algebra.certainty import Certainty
from disting.evidence.conditions import Renaming
from disting.model.symmetry import forms
from tests.laws.pairs import (
    WITNESS,
    any_pair,
    often,
    quick,
    similar_pairs,
    verdict,
    with_examples,
)
from tests.laws.strategies import chains

pytestmark = pytest.mark.full


@often
@with_examples
@given(pair=any_pair)
def test_the_mirrored_pair_has_the_mirrored_verdict(pair):
    there, back = verdict(*pair), verdict(*reversed(pair))
    for field in ("relation", "decided_by", "representation", "certainty", "safety", "notes"):
        assert getattr(there, field) == getattr(back, field)
    if isinstance(there.evidence, Renaming):
        assert {b for _, b in there.evidence.pairs} == {a for a, _ in back.evidence.pairs}
        assert there.evidence.symmetries == back.evidence.symmetries
    else:
        assert there.evidence is back.evidence is None or there.evidence.turned == back.evidence


@quick
@given(chains(dead_time=True))
def test_reciprocity_and_reflection_give_indistinguishable_models(chain):
    for form in forms(chain):
        found = verdict(chain, form.chain)
        assert (found.relation, found.decided_by, found.certainty) == (
            Relation.INDISTINGUISHABLE,
            "6",
            Certainty.THEOREM,
        )
        assert WITNESS.confirms(found.evidence, found.representation, chain, form.chain)


@quick
@with_examples
@given(pair=similar_pairs())
def test_an_equivalent_form_never_has_the_opposite_relation(pair):
    left, right = pair
    relations = {verdict(form.chain, right).relation for form in forms(left)}
    assert not relations >= {Relation.DISTINGUISHABLE, Relation.INDISTINGUISHABLE}
