"""Equivalents with some parameters as small as need be: against searches by numbers, and where the
theorem must not be used.
"""

import random

import numpy as np
import pytest
from scipy.optimize import least_squares

from disting import Model, Query, Relation, View, verify
from disting.general.boundary import at_boundary, without
from disting.general.formulas import is_explicit
from disting.verdict.verdict_file import verdict_file
from tests.general.test_ways import compartments, positive

CLOSED = (
    compartments(((1, 2), (1, 3), (2, 3)), 2),
    compartments(((1, 2), (1, 3), (2, 1), (2, 3)), 2),
)
LAST = compartments(((1, 2), (2, 3), (1, 0)), 3), compartments(((1, 2), (2, 1), (2, 3), (3, 2)), 3)
BOTH = (
    compartments(((1, 2), (1, 3), (2, 1), (2, 3)), 2),
    compartments(((1, 2), (1, 3), (2, 3), (1, 0)), 2),
)
PAIRS = [CLOSED, LAST, BOTH]


def tf(num, den):
    return Model.from_transfer_function(num, den)


@pytest.mark.full
@pytest.mark.parametrize("pair", [*PAIRS[:2], pytest.param(PAIRS[2], marks=pytest.mark.slow)])
def test_all_values_have_twins(pair):
    """Decided for all values; a search that knows no theorem finds positive twins both ways."""
    verdict = positive(*pair)
    assert verdict.relation is Relation.INDISTINGUISHABLE
    assert is_explicit(verdict.evidence, *pair) and "being small" in verdict.sentence
    draw = np.random.default_rng(4)
    for given, other in (pair, pair[::-1]):
        for _ in range(5):
            goal = coefficients(given, draw.uniform(0.3, 3, len(given.parameters)))
            assert any(np.max(np.abs(search(other, goal, draw))) < 1e-7 for _ in range(40)), (
                given.name
            )


def coefficients(model, values):
    sides = (*model.denominator_terms, *model.numerator_terms)
    every = [
        sum(float(c) * np.prod(np.power(values, e)) for e, c in terms) for terms in sides if terms
    ]
    return np.array(every) / next(x for x in every[::-1] if x)


def search(other, goal, draw):
    start = draw.normal(0, 1.5, len(other.parameters))
    return least_squares(
        lambda x: coefficients(other, np.exp(x)) / goal - 1, start, xtol=1e-14, ftol=1e-14
    ).fun


@pytest.mark.full
def test_a_verdict_is_verified_and_a_lie_is_not():
    data = verdict_file(*CLOSED, query=Query(view=View.POSITIVE))
    assert verify(data).status.value == "holds"
    formulas = data["evidence"]["formulas"]
    at = next(i for i, f in enumerate(formulas) if ["k21", "0"] in f[2])
    for lie in ("k12", "k13 + k23"):
        values = [[q, lie if q == "k21" else x] for q, x in formulas[at][2]]
        changed = [
            *formulas[:at],
            [*formulas[at][:2], values, formulas[at][3]],
            *formulas[at + 1 :],
        ]
        evidence = data["evidence"] | {"formulas": changed}
        assert verify(data | {"evidence": evidence}).status.value != "holds"


def test_special_functions_are_not_carried_over():
    """(s + c)^2 is (s + a)(s + b) - z at z = 0, and for no small z > 0: a b = c^2 + z is too large
    for a + b = 2 c. The rank of the given model is too small for the theorem.
    """
    assert at_boundary(tf(["1"], "(s + c)**2"), tf(["1"], "(s + a)*(s + b) - z")) is None
    assert at_boundary(tf(["1"], "(s + c)*(s + d)"), tf(["1"], "(s + a)*(s + b) - z")) is not None


def test_what_is_left_must_have_the_rank():
    """At z = 0 only equal roots are left: no neighbour says that other roots are reached."""
    other = tf(["1"], ["1", "2*a + z", "a**2"])
    assert at_boundary(tf(["1"], "(s + c)*(s + d)"), other) is None


def test_without_parameters():
    model = tf(["b", "c"], ["1", "a + b", "a*c"])
    assert without(model, ("c",)) is None
    assert str(without(tf(["1"], ["1", "a + b"]), ("b",))) == "G(s) = 1/(a + s)"


def test_two_conditions_stay_apart():
    """What never has an equivalent has none near the boundary."""
    draw = random.Random(2)
    a, b = draw.sample(["x", "y"], 2)
    assert (
        at_boundary(tf(["1"], f"s**2 + {a}*s + {a}**2 + {b}"), tf(["1"], "(s + u)*(s + v) - w"))
        is None
    )
