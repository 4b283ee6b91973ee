"""Explicit maps name the parameters of the searched model with primes, and older files still hold."""

import pytest
import sympy as sp

from disting import compare
from disting.general import Model
from disting.verdict.older_files import OLDER, in_older_words
from disting.verdict.verdict_file import verdict_file
from disting.verdict.verification import Status, verify

K12, K21, K10, K20 = sp.symbols("k12 k21 k10 k20")


def compartments():
    first = [[-(K12 + K10), K21], [K12, -K21]]
    second = [[-K12, K21], [K12, -(K21 + K20)]]
    return (
        Model.from_state_space(a, [1, 0], [1, 0], name=name)
        for a, name in ((first, "leak 1"), (second, "leak 2"))
    )


def test_a_map_distinguishes_the_parameters_of_both_models():
    sentence = compare(*compartments()).sentence
    assert "leak 1 is leak 2 at k12' = k10 + k12, k20' = (k10*k21)/(k10 + k12)" in sentence
    assert "leak 2 is leak 1 at k10' = (k12*k20)/(k20 + k21)" in sentence
    assert " k12 = " not in sentence


@pytest.mark.full
def test_a_map_is_true_with_its_primes():
    """By SymPy alone: the transfer functions are the same at the values that the sentence names."""
    s = sp.symbols("s")
    first, second = (
        sp.Matrix([[1, 0]]) * (s * sp.eye(2) - sp.Matrix(a)).inv() * sp.Matrix([1, 0])
        for a in ([[-(K12 + K10), K21], [K12, -K21]], [[-K12, K21], [K12, -(K21 + K20)]])
    )
    at = {K12: K10 + K12, K20: K10 * K21 / (K10 + K12), K21: K12 * K21 / (K10 + K12)}
    assert sp.simplify((first - second.subs(at, simultaneous=True))[0]) == 0


@pytest.mark.full
def test_a_file_of_the_format_without_primes_still_holds():
    data = verdict_file(*compartments())
    assert verify(data).status is Status.HOLDS
    older = in_older_words(data) | {"format": OLDER}
    assert verify(older).status is Status.HOLDS
    assert verify(data | {"sentence": older["sentence"]}).status is not Status.HOLDS
    assert (
        verify(older | {"sentence": older["sentence"].replace("k10 + k12", "k12")}).status
        is not Status.HOLDS
    )
