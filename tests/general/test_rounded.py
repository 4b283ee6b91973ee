"""Rounded equivalents put into Kirchhoff's laws as they are written."""

from fractions import Fraction
from math import isqrt

import numpy as np
import pytest
from flint import fmpq_poly

from disting import Relation, compare
from disting.algebra.groebner.rational import Shape
from disting.general import newton
from disting.general.any_model import of_network
from disting.general.equivalent import equivalents
from disting.general.matrix_model import Model
from disting.general.orthant import THOROUGH
from disting.general.rounded import AGREE, agree, is_plain, written
from disting.general.signs_on_boxes import narrowed
from disting.general.which_models import way
from disting.general.witnesses import common_point
from disting.model.question import Domain
from disting.network.notation import network_of
from tests.oracles.plain_network import equations

# where an interval was all that was known of a root, the values written were off by 4e-3 and 9e-3
PAIRS = [
    ("1>0, 1>2, 2>0; in 1; out 2", "1>0, 1>2, 2>1; in 1; out 2"),
    ("R1-p(R2-L1,R3-C1)", "C1 1 2; R1 1 3; R2 2 3; L1 2 0; R3 3 0"),
]
POINTS = [
    {"a10": Fraction(3), "a12": Fraction(1, 8), "a20": Fraction(7, 29)},
    {n: Fraction(x) for n, x in {"C1": 1.5, "L1": 3, "R1": 2, "R2": 2, "R3": 0.5}.items()},
]
CURVE = ("1=2, 1=3; F1; S2", "1=2, 1=3, 2=3; F1; S2")


def models(pair):
    return [of_network(network_of(text)) for text in pair]


def response(network, values, s):
    """At a real s."""
    a, b, c = (np.array(x, float) for x in equations(network, values.__getitem__, s, s**0.5))
    return (c @ np.linalg.solve(a, b.T))[0, 0]


def misfit(given, values, other, text):
    """The largest relative error of the response at some places on the positive axis."""
    mine = {name: float(x) for name, x in values.items()}
    theirs = {name: float(x) for name, x in text}
    sides = [
        [response(m.network, at, s) for s in (0.2, 0.7, 1.9, 6.0)]
        for m, at in ((given, mine), (other, theirs))
    ]
    return max(abs(y / x - 1) for x, y in zip(*sides, strict=True))


@pytest.mark.full
@pytest.mark.parametrize(("pair", "values"), [*zip(PAIRS, POINTS, strict=True)])
def test_equivalents_of_an_interval_are_written_to_the_digits_that_they_need(pair, values):
    left, right = models(pair)
    found = way(left, right, Domain.POSITIVE, THOROUGH).having(values)
    text = written(left, values, right, found)
    assert text and misfit(left, values, right, text) < 5e-9


@pytest.mark.full
def test_the_equivalent_that_a_verdict_names_gives_the_response():
    verdict, sides = compare(*PAIRS[0]), models(PAIRS[0])
    assert verdict.relation is Relation.SOMETIMES
    evidence = verdict.evidence
    evidence = getattr(evidence, "inner", evidence)
    given, other = sides if evidence.with_left_given else sides[::-1]
    values = {name: Fraction(x) for name, x in evidence.point_with}
    assert misfit(given, values, other, evidence.equivalent) < 5e-9


@pytest.mark.full
def test_values_that_may_be_chosen_have_few_digits_and_all_others_follow():
    left, right = models(CURVE)
    left_given, point, text = common_point(left, right)
    given, other = (left, right) if left_given else (right, left)
    values = {name: Fraction(x) for name, x in point}
    assert misfit(given, values, other, text) < 5e-9
    moved = [float(x) * (1 + 1e-8 * (-1) ** i) for i, (_, x) in enumerate(text)]
    again = newton.find_equivalent(given, values, other, moved)
    assert written(given, values, other, again) == text  # whatever last digits a search leaves
    assert newton.equivalent_at(given, values, other, moved) != again


def test_no_digits_are_enough_for_values_that_are_off():
    left, right = models(PAIRS[0])
    values = POINTS[0]
    assert written(left, values, right, (2.98781, 0.125, 0.253571)) is None
    root = narrowed([[175], [-752], [232]], Fraction(0), Fraction(1))  # (a10 + a12) a20 = a10 a21
    text = written(left, values, right, (float(3 + Fraction(7, 29) - root), 0.125, float(root)))
    assert text == (("a10", "2.98901879"), ("a12", "0.125"), ("a21", "0.252360523"))


def test_few_digits_stay_few():
    one = Model.from_transfer_function("k", "s + k")
    assert written(one, {"k": Fraction(1, 4)}, one, (0.25,)) == (("k", "0.25"),)
    assert not agree(one, {"k": Fraction(1)}, one, {"k": 1 + 2 * AGREE})
    assert [is_plain(x) for x in ("0.25", "0.250", "1/4", "1e400", "")] == [True] + [False] * 4


@pytest.mark.parametrize("k", [34, 36, 37, 38])
def test_values_at_a_root_are_known_to_double_precision(k):
    """Bits that show the sign of 10^k sqrt(2) less its whole part leave few of its value."""
    whole = isqrt(2 * 10 ** (2 * k))
    shape = Shape(fmpq_poly([-2, 0, 1]), (fmpq_poly([]), fmpq_poly([-whole, 10**k])))
    found = [e for e in equivalents(shape, ("a",)) if e.domain is Domain.POSITIVE]
    exact = Fraction(isqrt(2 * 10 ** (2 * k + 60)), 10**30) - whole
    assert [e.values["a"] for e in found] == [pytest.approx(float(exact), rel=1e-14, abs=0)]
