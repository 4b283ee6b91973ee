"""Positive values of larger networks in numbers: put in, beside the list of all values, and what is
refused.
"""

from fractions import Fraction

import pytest

from disting.general.alternatives import alternatives
from disting.general.any_model import of_network
from disting.general.balls import positive_sets
from disting.general.synthesis import NoFormulas
from disting.general.target import target
from disting.model.question import Domain
from disting.network.notation import network_of

VOIGT = "R0-p(R1,C1)-p(R2,C2)-p(R3,C3)"
LADDER = "R0-p(C1,R1-p(C2,R2-p(C3,R3)))"
PAIRS = (
    (LADDER, VOIGT, 1, True),
    (VOIGT, LADDER, 1, True),
    (VOIGT, "R1-p(C1,R0-p(C2,R2))-p(R3,C3)", 3, True),
    ("1~2~3~4; F1; S1", "1~2, 1~3, 1~4; F1; S1", 1, True),
    ("1=2~3~4~5; F1; S1", "1=2, 2~3, 2~4, 2~5; F1; S1", 1, False),
    (VOIGT, "R0-p(C1,R1-R4-p(C2,R2-p(C3,R3)))", 1, False),
)


def models(*texts):
    return [of_network(network_of(text)) for text in texts]


def numbers(model):
    return {n: Fraction(i * i + 3, i + 2) for i, n in enumerate(model.parameters)}


def coefficients(model, values):
    found = target(model, [(n, Fraction(values[n])) for n in model.parameters])
    return [float(c) for c in (*found.numerator, *found.denominator)]


@pytest.mark.parametrize(("given_text", "other_text", "count", "complete"), PAIRS)
def test_they_give_the_same(given_text, other_text, count, complete):
    one, two = models(given_text, other_text)
    values = numbers(one)
    found = positive_sets(one, values, two)
    assert (len(found.sets), found.complete) == (count, complete)
    for x in found.sets:
        assert all(value > 0 for value in x.values())
        assert coefficients(two, x) == pytest.approx(coefficients(one, values), rel=1e-9)


@pytest.mark.parametrize(
    ("given_text", "other_text"),
    [
        ("R0-p(C1,R1-p(R2,C2))", "R0-p(R1,C1)-p(R2,C2)"),
        ("R0-p(R1,C1)-p(R2,C2)", "p(R1,R2-C1,R3-C2)"),
        ("1~2~3; F1; S1", "1~2, 1~3; F1; S1"),
    ],
)
def test_beside_the_list_of_all_values(given_text, other_text):
    """Groebner bases know nothing of branches; they list an exchange of alike ones too."""
    one, two = models(given_text, other_text)
    values = numbers(one)
    listed = [
        {n: float(x) for n, x in y.values.items()}
        for y in alternatives(one, values, two).within(Domain.POSITIVE)
    ]
    (found,) = positive_sets(one, values, two).sets
    mine = {n: float(x) for n, x in found.items()}
    assert [x for x in listed if x == pytest.approx(mine)]
    assert len(listed) == 2
    swapped = [sorted(x.values()) for x in listed]
    assert swapped[0] == pytest.approx(swapped[1])


def test_equal_poles_are_refused():
    one, two = models(VOIGT, "R1-p(C1,R0-p(C2,R2))-p(R3,C3)")
    values = numbers(one) | {"R1": 1, "C1": 2, "R2": 2, "C2": 1}
    with pytest.raises(NoFormulas):
        positive_sets(one, {n: Fraction(x) for n, x in values.items()}, two)


def test_values_that_are_not_positive_are_refused():
    one, two = models(VOIGT, LADDER)
    with pytest.raises(NoFormulas, match="not all positive"):
        positive_sets(one, numbers(one) | {"R1": Fraction(-1)}, two)
