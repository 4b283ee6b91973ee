"""The bound of a whole family, against a plain sum over everything that rests on chance."""

import json
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

from disting import Certainty, Chain, Engine, Family, Query, View
from disting.catalogs.export import decisions_json
from disting.verdict.classes import Classes
from disting.verdict.joint import classes_safety, family_safety


def decided(chains, view=View.EXACT):
    engine = Engine()
    subjects = [engine.subject(str(i), chain) for i, chain in enumerate(chains, 1)]
    return engine.decisions(subjects, Query(view))


@pytest.mark.full
@pytest.mark.parametrize("view", [View.EXACT, View.POSITIVE])
@pytest.mark.parametrize("damped", [False, True])
def test_a_family_lies_between_its_worst_pair_and_the_sum_of_all(damped, view):
    found = decided(Family(3, damped=damped), view)
    bits = [safety for *_, certainty, safety in found.grades() if certainty == Certainty.BOUNDED]
    bits += [
        f.safety
        for both in found.inclusions.values()
        for f in (both.image, both.closure)
        if f.safety
    ]
    bits += [f.safety for f in (*found.shares.values(), *found.equal.values()) if f.safety]
    safety = family_safety(found)
    assert bits and safety <= min(bits)
    assert Fraction(1, 1 << safety + 1) < sum(2 * Fraction(1, 1 << b) for b in bits)
    assert safety >= 90
    assert json.loads(decisions_json(found))["joint_error_bound"] == f"2^-{safety}"


@pytest.mark.full
def test_a_profile_counts_once_for_all_its_pairs():
    """Model 1 against many others by the same profile: its error is one event, not as many as
    there are pairs.
    """
    found = decided(Family(4, damped=True), View.TF)
    bits = [safety for *_, certainty, safety in found.grades() if certainty == Certainty.BOUNDED]
    models = len(found.subjects)
    assert len(bits) > 2 * models
    assert family_safety(found) >= min(bits) - models.bit_length()


def test_what_is_proven_costs_nothing():
    assert family_safety(decided([Chain(1, damped=False), Chain(2, damped=False)])) == 0


def test_classes_count_their_statements():
    """Two models of one class and one apart from both by the first column: nine profiles and a
    link.
    """
    chains = tuple(Chain(3, meas_plus=m, damped=False) for m in (1, 2, 3))
    numbers = np.zeros(3, np.int32)
    same = Classes(
        chains,
        (1,),
        np.array([[0], [0], [1]], np.int32),
        np.array([0, 0, 1], np.int32),
        *[numbers] * 3,
        frozenset(),
    )
    assert classes_safety(same) == 96  # ten statements of 2^-100
    open_pair = replace(same, columns=np.array([[0], [0], [0]], np.int32))
    assert classes_safety(open_pair) == 96  # an exact decision more
    many = replace(
        same,
        chains=chains * 700,
        columns=np.zeros((2100, 1), np.int32),
        group=np.zeros(2100, np.int32),
    )
    assert classes_safety(many) == 86
