"""General models through the package's own `compare` and `findings`, alone and against chains."""

import pytest

from disting import Chain, Family, Model, Relation, compare, findings

RIGID = Model.from_transfer_function(["1"], ["m"], name="one mass")  # acceleration of one mass


def test_a_model_and_the_chain_it_describes_are_indistinguishable():
    found = compare(RIGID, Chain(1, damped=False))
    assert (found.relation, found.left, found.right) == (
        Relation.INDISTINGUISHABLE,
        "one mass",
        "1:1",
    )


@pytest.mark.full
def test_a_chain_comes_first_or_second():
    family = Family(2, damped=True)
    spring = Model.from_transfer_function(
        ["d", "k"], ["m1*m2", "d*(m1+m2)", "k*(m1+m2)"], name="two masses"
    )
    for number in range(1, len(family) + 1):
        there, back = compare(spring, family[number]), compare(family[number], spring)
        assert there.relation is back.relation is not Relation.UNDECIDED
    assert compare(family[2], spring).relation is Relation.INDISTINGUISHABLE


def test_findings_of_models():
    names = [
        step.finding.rule.name
        for step in findings(RIGID, Chain(1, damped=False))
        if step.representation == "tf"
    ]
    assert names == list("1234567")
