"""Real parameters of undamped chains: literal findings, real factors against Newton's method
from random complex starts.
"""

from dataclasses import replace

import pytest

from disting import Chain, Family, Query, Relation, View, compare
from disting.decide.identifiability.solutions import foster_count
from disting.decide.positive import always_real, confirms_real, real_witness
from disting.decide.positive.points import random_point, read
from disting.decide.positive.real import lacks_real
from disting.decide.same.evidence_check import Witness
from disting.evidence.kinds import evidence_from
from disting.evidence.positive import RealFactors
from disting.fibres.synthesis.fibre import fibre
from disting.fibres.synthesis.task import Status, target
from disting.model.question import Answer
from disting.model.symmetry import canonical
from tests.oracles.real_equivalents import is_real, solutions

OPEN_OF_3 = [(1, 4), (1, 6), (4, 6), (4, 8), (4, 11), (6, 8), (6, 11)]
# Newton's method reaches all solutions at the witness of one way at least
FOUND_WHOLLY = [(1, 4), (1, 6), (4, 6)]
TOWARDS_END = [(14, 20), (22, 26), (22, 28), (24, 26), (24, 28)]  # 4 masses, families of solutions


def pair(n, i, j):
    return tuple(canonical(Family(n, damped=False)[k]).chain for k in (i, j))


def mixed(chain, label, pattern):
    """A point whose signs are the bits of the pattern."""
    point = random_point(chain, label)
    return {name: -v if (pattern >> at) & 1 else v for at, (name, v) in enumerate(point.items())}


def seen(given, point, other):
    """All equivalents that Newton's method finds."""
    return solutions(
        given,
        {name: float(v.p) / float(v.q) for name, v in point.items()},
        other,
        foster_count(other),
    )


@pytest.mark.slow
@pytest.mark.parametrize(("i", "j"), OPEN_OF_3)
def test_a_witness_has_complex_equivalents_alone(i, j):
    found = 0
    for given, other in (pair(3, i, j), pair(3, j, i)):
        values = () if always_real(given, other) else real_witness(given, other, "disting")
        if values:
            assert confirms_real(values, given, other)
            listed = seen(given, read(values), other)
            assert not any(map(is_real, listed))
            found += len(listed) == foster_count(other)
    assert found or (i, j) not in FOUND_WHOLLY


@pytest.mark.slow
@pytest.mark.parametrize(("i", "j"), OPEN_OF_3)
def test_points_of_mixed_signs_against_newtons_method(i, j):
    given, other = pair(3, i, j)
    for k in range(3):
        point = mixed(given, f"newton:{k}", 0b10110 >> k)
        listed = seen(given, point, other)
        if len(listed) == foster_count(other):
            assert lacks_real(given, point, other) is not any(map(is_real, listed))


@pytest.mark.parametrize(("i", "j"), TOWARDS_END)
def test_real_factors_of_an_odd_degree_always_exist(i, j):
    """Grounded or free row of three masses with the ports apart: its numerator is linear, or
    both models have its factor.
    """
    here, there = pair(4, i, j)
    assert always_real(here, there) and always_real(there, here)
    for k in range(8):
        assert not lacks_real(here, mixed(here, f"end:{k}", 0b1011010 >> k), there)


def test_a_numerator_without_real_zeros_cannot_be_shared_out():
    """Ports 1, 2 and 2, 3 of 4 masses: N has degree 2, and in the second chain it is a product
    of two linear factors.
    """
    first, second = pair(4, 2, 6)
    assert always_real(second, first) and not always_real(first, second)
    values = real_witness(first, second, "disting")
    assert confirms_real(values, first, second) and not confirms_real(values, second, first)
    positive = tuple((name, value.removeprefix("-")) for name, value in values)
    assert not confirms_real(positive, second, first) and not confirms_real(
        (("m1", "0"), *values[1:]), first, second
    )


@pytest.mark.parametrize(("i", "j"), OPEN_OF_3)
def test_a_witness_has_no_real_solution_in_the_list_of_the_synthesis(i, j):
    """By another way: all solutions, each with an imaginary part that its ball leaves no doubt
    of.
    """
    ways = [
        (a, b, real_witness(a, b, "disting"))
        for a, b in (pair(3, i, j), pair(3, j, i))
        if not always_real(a, b)
    ]
    found = [(fibre(b, target(a.structure, read(values))), b) for a, b, values in ways if values]
    assert found and all(
        f.status is Status.COMPLETE and len(f.solutions) == foster_count(b) for f, b in found
    )
    assert all(s.real is Answer.NO for f, _ in found for s in f.solutions)


def test_no_factor_is_claimed_where_nothing_is_covered():
    damped = Chain(3, damped=True), Chain(3, 0, 0, 2, 0, 2, damped=True)
    assert not always_real(*damped) and not lacks_real(
        damped[0], random_point(damped[0], "x"), damped[1]
    )
    assert not always_real(Chain(3, damped=False), Chain(4, damped=False))
    far = (
        Chain(6, act_plus=1, meas_plus=4, damped=False),
        Chain(6, act_plus=2, meas_plus=5, damped=False),
    )
    assert not always_real(*far)  # three springs between inner ports: no construction


@pytest.mark.full
def test_altered_real_evidence_is_refused():
    a, b = (Family(4, damped=False)[k] for k in (2, 6))
    found = compare(a, b, query=Query(View.REAL))
    assert (found.relation, found.certainty) == (Relation.SOMETIMES, "proven")
    assert compare(b, a, query=Query(View.REAL)).relation is Relation.SOMETIMES
    evidence, witness = found.evidence, Witness()
    assert (
        witness.confirms(evidence, "parameters", a, b)
        and evidence_from(evidence.to_dict()) == evidence
    )
    for lie in (
        replace(evidence, without_left_given=not evidence.without_left_given),
        replace(evidence, with_left_given=not evidence.with_left_given),
        replace(evidence, without=tuple((name, "1") for name, _ in evidence.without)),
        RealFactors(),
    ):
        assert not witness.confirms(lie, "parameters", a, b)
