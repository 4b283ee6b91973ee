"""Fibres modulo primes longer than a machine word: the same answers, and bounds for models so large
that words give none.
"""

from dataclasses import replace

import pytest

from disting.algebra.certainty import prime
from disting.algebra.groebner.elimination import Basis, basis_steps
from disting.fibres.ideals import Limits, normalise
from disting.fibres.ideals.bounds import LEAST, bits_of, safety_of_empty
from disting.fibres.ideals.confirm import reaches_one
from disting.fibres.ideals.fibre_ideal import BITS, LONG_BITS, fibre_ideal
from disting.fibres.ideals.membership import NO_BOUND, decide_matched
from disting.general.any_model import LIMITS, maps_of, of_network
from disting.model.family import Family
from disting.model.question import Membership
from disting.network.notation import network_of

TREES = ("1=2, 1=3, 1=4, 2=5, 5=6; F1; S1", "1=2, 1=3, 1=4, 2=5, 2=6; F1; S1")


def basis_of(ideal):
    steps = basis_steps(ideal.generators, len(ideal.unknowns), ideal.modulus)
    return next(step for step in steps if isinstance(step, Basis))


@pytest.mark.parametrize(("number", "is_empty"), [(6, True), (11, False)])
def test_they_answer_as_words_do(number, is_empty):
    family = Family(3, damped=True)
    pair = normalise(family[1].structure), normalise(family[number].structure)
    short, long = (fibre_ideal(*pair, "long", True, bits) for bits in (BITS, LONG_BITS))
    assert (short.modulus.bit_length(), long.modulus.bit_length()) == (BITS, LONG_BITS)
    assert [basis_of(ideal).is_one for ideal in (short, long)] == [is_empty] * 2


def test_plain_elimination_takes_them_too():
    modulus = prime("plain", LONG_BITS)
    assert reaches_one([{(1, 1): 1, (0, 0): -1}, {(1, 0): 1}], 2, modulus, 2)
    assert not reaches_one([{(1, 1): 1, (0, 0): -1}, {(2, 0): 1, (0, 0): -4}], 2, modulus, 4)


def trees():
    return maps_of(*(of_network(network_of(text)) for text in TREES))


@pytest.mark.full
def test_large_trees_need_them():
    left, right = trees()
    assert safety_of_empty(left, right, True) < LEAST
    assert bits_of(left, right, True) == LONG_BITS
    assert safety_of_empty(left, right, True, LONG_BITS) > 101


@pytest.mark.full
def test_words_alone_say_that_they_give_no_bound():
    told = decide_matched(*trees(), equal_rank=True, limits=Limits(seconds=1.0))
    assert (told.membership, told.reason) == (Membership.UNKNOWN, NO_BOUND)


@pytest.mark.slow
def test_large_trees_are_told_apart():
    patient = replace(LIMITS, seconds=3600.0)  # the usual minute is too short for a slow machine
    told = decide_matched(*trees(), equal_rank=True, limits=patient)
    assert told.membership is Membership.EXCLUDED and told.safety > 101
