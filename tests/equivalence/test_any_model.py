"""`equivalents` of chains, of networks and of models with formulas, by one function."""

import pytest

from disting import Chain, Family, InputError, Model, ModelList, equivalents, network_of
from disting.equivalence import Equivalents, ModelEquivalent

CELL, OTHER = "R0-p(R1,C1)", "p(R0,R1-C1)"
VALUES = {"R0": 1, "R1": 2, "C1": "1/2"}
LAG = Model.from_transfer_function("k", "T*s + 1", name="lag")
SAME = Model.from_transfer_function("a*b", "s + b", name="same")


def test_chains_have_their_own_answer():
    given = {"m1": 1, "m2": 2, "k12": 3, "d12": 4}
    for model, to in ((Chain(2), Family(2)), ("2:1", "2"), (Chain(2), "2:1")):
        assert isinstance(equivalents(model, given, to), Equivalents)


@pytest.mark.thin(1)
@pytest.mark.parametrize("model", [CELL, network_of(CELL), Model.from_network(network_of(CELL))])
@pytest.mark.parametrize("to", [OTHER, network_of(OTHER), [OTHER, "R0-L1"]], ids=repr)
def test_networks_are_objects_texts_or_a_list(model, to):
    (found,) = equivalents(model, VALUES, to)
    assert isinstance(found, ModelEquivalent) and found.verdict.relation == "indistinguishable"
    assert str(found.values.equivalents[0]) == "C1 = 2/9, R0 = 3, R1 = 3/2"


def test_values_in_a_text_count_and_given_ones_win():
    text = "R{R=1}-p(R{R=2},C{C=0.5})"
    for given, r0 in (({}, 3), ({"R2": 1}, 2)):
        (found,) = equivalents(text, given, OTHER)
        assert found.values.equivalents[0].values["R0"] == r0


@pytest.mark.full
def test_models_with_formulas_and_lists_of_them():
    for to in (SAME, ModelList((SAME, LAG)), [LAG, SAME]):
        (found,) = equivalents(LAG, {"k": 6, "T": 2}, to)
        assert found.model.name == "same" and found.values.equivalents[0].values == {
            "a": 6,
            "b": 0.5,
        }
    (mass,) = equivalents(Chain(1), {"m1": 2}, Model.from_chain(Chain(1), name="mass"))
    assert mass.values.equivalents[0].values == {"m1": 2}


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: equivalents(CELL, VALUES, OTHER, also=["sensor=2"]), "also is for chains"),
        (lambda: equivalents(CELL, VALUES, 3), "a model is a chain.* not 3"),
        (lambda: equivalents(CELL, {"R0": 1}, OTHER), "no value for C1, R1"),
        (lambda: equivalents(CELL, None, OTHER), "values are a dict"),
        (lambda: equivalents(CELL, VALUES, "circuits-99"), "families of networks are"),
    ],
)
def test_what_cannot_be_asked_is_refused(call, words):
    with pytest.raises(InputError, match=words):
        call()
