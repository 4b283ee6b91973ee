"""Models written for the very points and primes that they are looked at with: all of them are
public, none helps.
"""

from math import prod

import pytest

from disting import Relation, compare
from disting.algebra.certainty import prime
from disting.behaviour.profile import profile
from disting.behaviour.sample import Representation, draw_point, samples
from disting.fibres.ideals import decide
from disting.general.any_model import coefficient_map
from disting.general.behaviour import GeneralModel
from disting.general.identifiability import local_identifiability
from disting.general.matrix_model import Model
from disting.model.question import Settings

OTHER = Model.from_transfer_function(["c"], ["1", "0"], name="integrator")
ATTACKS = 4


def first_order(factor):
    """a/(s + factor b): rank 2, though modulo the divisors of the factor it looks like a/s."""
    return Model.from_transfer_function(["a"], ["1", f"{factor}*b"], name="low pass")


def moduli(model):
    """Every prime that the model is looked at with."""
    kept = [s.modulus for s in samples(GeneralModel(model), Representation.TF, 0, 3, "disting")]
    return {*kept, draw_point(GeneralModel(model), "disting:search", 31).modulus}


def test_a_model_of_the_primes_of_the_seed_alone():
    model = first_order(prod(prime(f"disting:{k}") for k in range(3)))
    assert profile(GeneralModel(model), Representation.TF, 0, Settings()).rank == 2
    assert local_identifiability(model).rank == 2
    assert (
        compare(model, OTHER).relation is compare(OTHER, model).relation is Relation.DISTINGUISHABLE
    )


def test_a_model_of_the_primes_of_its_own_predecessor():
    """Whoever multiplies by the primes of a model gets another model, with others; so it goes
    on for ever.
    """
    model, known = first_order(1), set()
    for _ in range(ATTACKS):
        fresh = moduli(model)
        assert not fresh & known
        known |= fresh
        model = first_order(prod(known))
        assert compare(model, OTHER).relation is Relation.DISTINGUISHABLE


def test_primes_of_the_ideals_belong_to_both_models():
    """The same left model, two right ones: no label twice; the same question: the same labels."""
    left = coefficient_map(Model.from_transfer_function(["a*b"], ["1", "a + b", "a*b"]))
    rights = [
        coefficient_map(Model.from_transfer_function([f"{n}*k*m"], ["1", "k + m", "k*m"]))
        for n in (1, 3)
    ]
    found = [decide(left, right, equal_rank=True).evidence for right in (*rights, *rights)]
    labels = [set(e.labels) for e in found if e is not None]
    assert len(labels) == 4 and labels[:2] == labels[2:] and not labels[0] & labels[1]


@pytest.mark.parametrize("seed", ["disting", "another"])
def test_points_are_reproducible(seed):
    model = Model.from_transfer_function(["a"], ["1", "b"], name="one")
    same = Model.from_transfer_function(["a"], ["1", "b"], name="two")
    assert list(samples(GeneralModel(model), Representation.TF, 0, 3, seed)) == list(
        samples(GeneralModel(same), Representation.TF, 0, 3, seed)
    )
