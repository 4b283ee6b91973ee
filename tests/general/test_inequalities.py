"""Inequalities between coefficients, against values by hand, a linear program and least squares
that know nothing of how they are found.
"""

import random
from fractions import Fraction
from itertools import islice

import numpy as np
import pytest
from hypothesis import given as drawn, settings, strategies as st
from scipy.optimize import least_squares, linprog

from disting import Model
from disting.evidence.general import Inequality, Witnesses
from disting.general import inequalities as module
from disting.general.admissible import admissible_finding
from disting.general.any_model import of_network
from disting.general.inequalities import (
    contradiction,
    excludes_around,
    inequalities,
    is_contradiction,
    points_against,
)
from disting.general.model_evidence import confirms_models
from disting.general.relations import coefficients
from disting.general.target import value_at
from disting.model.question import Domain
from disting.network.notation import network_of

STAR, RING = "#=1, #=2, 1=2, 1=3; F1; S2:1", "#=1, #=2, 1=3, 2=3; F3; S3"
SMALL = ["#=1, 1=2; F1; S1", "#=1, 1=2; F1; S2", "1>2, 2>1, 2>0; in 1; out 1", "1~2, 1~3; F1; S2"]


def model_of(text):
    return of_network(network_of(text))


def some_values(model, draw):
    return {name: Fraction(draw.randint(1, 40), draw.randint(1, 40)) for name in model.parameters}


@pytest.mark.full
@pytest.mark.parametrize("text", [*SMALL, STAR, RING])
def test_all_values_of_a_model_satisfy_its_own_inequalities(text):
    model, draw = model_of(text), random.Random(text)
    forms = inequalities(model)
    assert any(number < 0 for form in forms for _, number in form)
    for _ in range(8):
        point = list(some_values(model, draw).values())
        at = [value_at(terms, point) for terms in coefficients(model) if terms]
        for form in forms:
            assert sum(number * at[i] * at[j] for (i, j), number in form) >= 0
    assert next(points_against(model, model), None) is None
    assert contradiction(model, model) is None


def test_real_roots_by_hand():
    """(s + a)(s + b) = s^2 + a1 s + a0 with a1^2 >= 2 a0; a1^2 >= 4 a0 has a coefficient of either
    sign."""
    roots = Model.from_transfer_function("1", "(s + a)*(s + b)")
    other = Model.from_transfer_function("1", "s**2 + p*s + q")
    form = {(1, 1): 1, (0, 2): -2}  # of a2, a1, a0, b0
    assert form in [dict(f) for f in inequalities(roots)]
    assert excludes_around(other, {"p": Fraction(1), "q": Fraction(1)}, roots)
    assert not excludes_around(other, {"p": Fraction(3), "q": Fraction(1)}, roots)
    assert not excludes_around(other, {"p": Fraction(2), "q": Fraction(2)}, roots)  # equality
    cancels = Model.from_transfer_function("s + c", "(s + a)*(s + b)")
    assert not excludes_around(cancels, dict.fromkeys("abc", Fraction(1)), cancels)


def test_where_a_root_cancels_nothing_is_said():
    """1/(s + 2) is (s + 1)/((s + 1)(s + 2)), with 2 b0 < a1, and (s + 4)/((s + 2)(s + 4)): the other
    one has 2 b0 >= a1, and gives it all the same.
    """
    one = Model.from_transfer_function("s + c", "(s + a)*(s + b)")
    other = Model.from_transfer_function("s + p + u + t", "(s + p)*(s + p + 2*u)")
    broken = {"a": Fraction(1), "b": Fraction(2), "c": Fraction(1)}
    assert not excludes_around(one, broken, other)
    assert excludes_around(one, broken | {"c": Fraction(1, 2)}, other)
    cancel = [v for v, _ in module._points(one) if v["c"] == v["a"] < v["b"]]
    assert cancel and all(v["c"] not in (v["a"], v["b"]) for v in points_against(one, other))


def test_a_sign_tells_two_models_apart():
    one = Model.from_transfer_function("b - c", "s + a")
    other = Model.from_transfer_function("-b", "s + a")
    positive = Model.from_transfer_function("b", "s + a")
    assert contradiction(other, positive) and contradiction(positive, other)
    assert contradiction(one, positive) is None and next(points_against(one, positive), None)
    assert not is_contradiction(((1, "a1", "b7"),), other, positive)
    assert not is_contradiction(((1, "a1", "b0"),), one, positive)


@pytest.mark.full
@settings(max_examples=40)
@drawn(st.lists(st.tuples(*[st.integers(-3, 4)] * 3), min_size=3, max_size=7))
def test_edges_are_those_of_the_cone(rows):
    """What a linear program finds least is found at an edge, for objectives in any direction."""
    rows = [row for row in rows if any(row)]
    if len(rows) < 3 or np.linalg.matrix_rank(rows) < 3:
        return
    edges = list(module._edges(rows))
    assert all(sum(map(lambda a, b: a * b, row, edge)) >= 0 for row in rows for edge in edges)
    inside = np.sum(rows, axis=0)  # positive but at 0 of what contains no line
    for objective in np.random.default_rng(3).integers(-9, 10, (5, 3)):
        least = linprog(
            objective,
            A_ub=-np.array(rows),
            b_ub=np.zeros(len(rows)),
            A_eq=[inside],
            b_eq=[1],
            bounds=(None, None),
        )
        at = [np.dot(objective, e) / np.dot(inside, e) for e in edges if np.dot(inside, e)]
        assert bool(at) is (least.status == 0)
        assert not at or abs(min(at) - least.fun) < 1e-6 * max(1, abs(least.fun))


def test_no_edge_lies_between_opposite_corners_of_a_square():
    """Both corners are zero in three rows, of which one is the sum of two: a count says nothing."""
    square = [(0, 0, 1, 0, 0), (0, 0, 0, 1, 0), (0, 0, -1, 0, 1), (0, 0, 0, -1, 1)]
    rows = [(1, 0, 0, 0, 0), (0, 1, 0, 0, 0), (1, 1, 0, 0, 0), *square, (0, 0, -2, -2, 3)]
    corners = {(0, 0, 0, 0, 1), (0, 0, 1, 0, 1), (0, 0, 0, 1, 1), (0, 0, 2, 1, 2), (0, 0, 1, 2, 2)}
    assert {*module._edges(rows)} == {(1, 0, 0, 0, 0), (0, 1, 0, 0, 0), *corners}


@pytest.mark.full
@pytest.mark.parametrize(
    ("one", "two"), [(STAR, RING), ("#=1, 1=2, 2=3; F2:1; S3:2", "#=1, 1=2, 1=3, 2=3; F1; S2:1")]
)
def test_what_is_found_of_damped_machines_is_true(one, two):
    left, right = model_of(one), model_of(two)
    found = admissible_finding(left, right, Domain.POSITIVE, "1")
    assert isinstance(found.evidence, Inequality | Witnesses)
    assert confirms_models(found.evidence, left, right)
    assert not confirms_models(found.evidence, left, left)


def least_error(given, values, other, search):
    """How near coefficients over the leading one come, by least squares from many starts."""

    def ratios(model, point):
        at = [float(value_at(terms, point)) for terms in coefficients(model) if terms]
        with np.errstate(all="ignore"):  # the search may go far
            return np.array(at[1:]) / at[0]

    wanted = ratios(given, [float(values[name]) for name in given.parameters])
    starts = search.normal(0, 2, (6, len(other.parameters)))
    tried = (least_squares(lambda x: ratios(other, np.exp(x)) / wanted - 1, x) for x in starts)
    return min(np.linalg.norm(one.fun) for one in tried)


@pytest.mark.full
def test_no_search_finds_what_is_excluded():
    left, right = map(model_of, ("1~2, 1~3; F1; S2", "1~2, 1~3, 2~3; F1; S2"))
    points = list(islice(points_against(right, left), 3))
    search = np.random.default_rng(5)
    assert points and next(points_against(left, right), None) is None
    for values in points:
        assert least_error(right, values, left, search) > 1e-3, values
    values = some_values(left, random.Random(1))
    assert least_error(left, values, left, search) < 1e-6


def test_the_form_is_read_and_turned():
    evidence = Inequality("positive", True, ((1, "a1", "a1"), (-2, "a0", "a2")))
    assert Inequality.from_dict(evidence.to_dict()) == evidence
    assert not evidence.turned.left_given
    assert evidence.sentence("A", "B").startswith(
        "a1^2 - 2*a0*a2 is negative at all positive parameters of A, and at none of B"
    )
    assert "of B, and at none of A" in evidence.turned.sentence("A", "B")
