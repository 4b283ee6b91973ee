"""Points with positive equivalents by Newton's method on intervals, and relations of coefficients,
against searches by numbers and Kirchhoff's and Newton's laws as they stand.
"""

import random
from fractions import Fraction
from itertools import islice

import pytest

from disting import MatrixModel, Model, Relation, compare, local_identifiability, verify
from disting.general.any_model import of_network
from disting.general.newton import equivalent_at, find_equivalent
from disting.general.relations import (
    coefficients,
    dimension_at_least,
    dimension_at_most,
    relations,
)
from disting.general.search import common_points
from disting.general.witnesses import by_inequalities, common_point, points
from disting.model.question import Domain
from disting.network.notation import network_of
from disting.verdict.verdict_file import verdict_file
from tests.oracles.twins import respond_alike, twin

PAIRS = [
    ("1=2, 1=3; F1; S2", "1=2, 1=3, 2=3; F1; S2"),  # coefficients that depend on each other
    ("#=1, 1=2, 1=3; F1; S2:1", "#=1, 1=2, 2=3; F1; S3:1"),
    ("#~1, 1~2, 1~3; F1; S3:2", "#~1, 1~2, 2~3; F1; S3:2"),
    ("1>0, 1>2, 2>1, 2>3, 3>1; in 3; out 1", "1>0, 1>2, 2>1, 2>3, 3>2; in 1; out 2"),
]


def models(pair):
    return [of_network(network_of(text)) for text in pair]


def tf(num, den):
    return Model.from_transfer_function(num, den)


def test_of_models_that_cannot_agree_no_equivalent_is_looked_for():
    lag, fast, slow = tf("1", "s + a"), tf("1", "(s + a)*(s + b)"), tf("1", "s + a - b")
    one = {"a": Fraction(1)}
    both = one | {"b": Fraction(1)}
    assert find_equivalent(lag, one, lag) == pytest.approx([1.0])
    assert find_equivalent(lag, one, fast) is None  # other degrees
    assert find_equivalent(slow, both, lag) is None  # a coefficient is zero there
    assert find_equivalent(tf("1", "(a - b)*s + a"), both, tf("1", "c*s + d")) is None
    matrix = MatrixModel.from_transfer_functions([["1/(s + a)"], ["1/(s + b)"]])
    assert find_equivalent(matrix, both, matrix) is None
    assert equivalent_at(matrix, both, matrix, [1.0, 1.0]) is None
    assert common_point(matrix, matrix) is None and by_inequalities(matrix, matrix) is None


@pytest.mark.sampled(2)
@pytest.mark.full
@pytest.mark.parametrize(
    "pair", [PAIRS[0], pytest.param(PAIRS[1], marks=pytest.mark.slow), *PAIRS[2:]]
)
def test_an_equivalent_responds_alike_and_others_are_near(pair):
    left, right = models(pair)
    draw, met = random.Random(3), 0
    for left_given, values, near in common_points(left, right):
        given, other = (left, right) if left_given else (right, left)
        found = find_equivalent(given, values, other, near)
        if not found:
            continue
        mine = [float(values[p]) for p in given.parameters]
        assert min(found) > 0 and respond_alike(given.network, mine, other.network, list(found))
        moved = {p: x * Fraction(1 + draw.uniform(-1e-3, 1e-3)) for p, x in values.items()}
        again = find_equivalent(given, moved, other, found)
        assert again and max(abs(a / b - 1) for a, b in zip(again, found, strict=True)) < 1
        met += 1
    assert met


@pytest.mark.full
@pytest.mark.parametrize("pair", PAIRS[1:3])
def test_it_depends_on_the_values(pair):
    assert compare(*pair).relation is Relation.SOMETIMES
    data = verdict_file(*pair)
    assert verify(data).status.value == "holds"
    evidence = data["evidence"]
    points_ = evidence.get("inner", evidence)
    swapped = points_ | {
        "with_left_given": points_["without_left_given"],
        "point_with": points_["point_without"],
    }
    lie = evidence | {"inner": swapped} if "inner" in evidence else swapped
    assert verify(data | {"evidence": lie}).status.value != "holds"


@pytest.mark.full
def test_what_is_excluded_has_none():
    """Points without a twin: none is found, and a search by numbers agrees both ways."""
    left, right = models(PAIRS[2])
    draw, counts = random.Random(1), {True: 0, False: 0}
    for given, other in ((left, right), (right, left)):
        for _ in range(4):
            mine, theirs = twin(given.network, other.network, draw, 20)
            values = {p: Fraction(x) for p, x in zip(given.parameters, mine, strict=True)}
            found = find_equivalent(given, values, other)
            assert not found or theirs
            counts[bool(found)] += 1
    assert all(counts.values())


@pytest.mark.full
def test_a_double_root_says_nothing_of_those_near_by():
    """(s + 1)^2 is (s + a)(s + b) at a = b = 1; of s^2 + 2 s + q with q > 1 none is."""
    given, other = tf(["1"], ["1", "p", "q"]), tf(["1"], "(s + a)*(s + b)")
    at = {"p": Fraction(2), "q": Fraction(1)}
    assert find_equivalent(given, at, other, (1.0, 1.0)) is None
    assert find_equivalent(given, at | {"q": Fraction(3, 4)}, other) is not None
    assert find_equivalent(given, at | {"q": Fraction(5, 4)}, other) is None


@pytest.mark.full
def test_a_negative_zero_is_no_equivalent():
    given, other = tf(["1"], ["1", "p"]), tf(["1"], ["1", "a - 1"])
    assert find_equivalent(given, {"p": Fraction(1, 2)}, other) == pytest.approx((1.5,))
    assert find_equivalent(given, {"p": Fraction(1, 2)}, tf(["1"], ["1", "a + 1"]), (0.5,)) is None


def test_relations_hold_for_both_models_or_are_left_out():
    free = of_network(network_of("1=2, 1=3; F1; S2"))
    held = tf(["b1", "b0"], ["1", "a1", "a0"])
    linked = tf(["b1", "b0"], ["1", "b1", "b0"])
    assert relations(held, linked) == () and len(relations(linked, linked)) > 1
    (relation,) = relations(free, free)
    for values in islice(points(free, Domain.POSITIVE, "test"), 3):
        at = [values[p] for p in free.parameters]
        numbers = [value(terms, at) for terms in coefficients(free) if terms]
        assert sum(x * numbers[i] * numbers[j] for (i, j), x in relation) == 0


def value(terms, at):
    total = Fraction(0)
    for exponents, number in terms:
        term = Fraction(int(number))
        for x, e in zip(at, exponents, strict=True):
            term *= x ** int(e)
        total += term
    return total


def test_dimensions_against_ranks():
    for text in ("1=2, 1=3; F1; S2", "1~2, 1~3, 2~3; F1; S2", "R1-p(R2,C1)"):
        model = of_network(network_of(text))
        assert (
            dimension_at_least(model)
            == local_identifiability(model).rank
            <= dimension_at_most(model)
        )
