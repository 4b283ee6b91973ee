"""Structures that contain others: the relation, the limit in numbers, and what a fit makes of it."""

from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from disting.decide.inclusion.profiles import by_elements
from disting.fit.judge.candidate import observed_scatters
from disting.fit.judge.choice import _from_limit, check_left, limit_in, searched_again
from disting.fit.search.candidates import figure_1, reference
from disting.fit.search.containment import contains, embeddings
from disting.fit.search.cost import Case, Cost
from disting.fit.search.estimate import Task
from disting.fit.search.starts import scale
from disting.fit.select import select
from disting.measurement import FrequencyResponse
from disting.model.chain import Chain
from disting.model.question import Settings
from disting.network import network_of
from tests.fit.drives import OMEGA, dense_response, response, truth

FREE = figure_1()  # force and sensor at mass 1


def reached(chain):
    """All chains that a chain tends to, step by step: one damper, lag or dead time vanishes, two
    neighbouring masses become one with the dampers of both, or the last mass hangs free and
    vanishes.
    """
    start = (chain.n_masses, frozenset(chain.ground_dampers), chain.lag, chain.dead_time)
    found, new = set(), {start}
    while new:
        found |= new
        new = {other for one in new for other in steps(*one)} - found
    return found - {start}


def steps(n, dampers, lag, delay):
    yield from ((n, dampers - {i}, lag, delay) for i in dampers)
    yield from ((n - 1, frozenset(i - (i > j) for i in dampers), lag, delay) for j in range(1, n))
    if n > 1 and n not in dampers:
        yield n - 1, dampers, lag, delay
    if lag:
        yield n, dampers, False, delay
    if delay:
        yield n, dampers, lag, False


@pytest.mark.full
def test_all_pairs_of_the_candidates_are_those_that_steps_reach():
    tended = {c: reached(c) for c in FREE}
    wrong = [
        (reference(large), reference(small))
        for large, small in product(FREE, FREE)
        if contains(large, small)
        != (
            (small.n_masses, frozenset(small.ground_dampers), small.lag, small.dead_time)
            in tended[large]
        )
    ]
    assert not wrong


@pytest.mark.thin(8)
@pytest.mark.parametrize(
    ("large", "small", "said"),
    [
        (Chain(3, ground_dampers=(2,)), Chain(2, ground_dampers=(1,)), True),  # k12 is rigid
        (Chain(3, ground_dampers=(2,)), Chain(2, ground_dampers=(2,)), True),  # k23 is
        (Chain(4, ground_dampers=(3,)), Chain(2, ground_dampers=(1,)), True),  # k12 and k23 are
        (Chain(3, ground_dampers=(3,)), Chain(2, ground_dampers=(1,)), False),
        (Chain(3, ground_dampers=(3,)), Chain(1, ground_dampers=(1,)), True),
        (Chain(2, lag=True), Chain(2), True),
        (Chain(2, lag=True), Chain(2, dead_time=True), False),
        (Chain(2), Chain(2, damped=False), True),
        (Chain(2, damped=False), Chain(1), True),
        (Chain(3, meas_plus=2), Chain(2), True),  # force and sensor at the two masses joined
        (Chain(3, meas_plus=3), Chain(2), False),  # the sensor stays behind a spring
        (Chain(3, meas_plus=3), Chain(2, meas_plus=2), True),
        (Chain(2), Chain(2), False),
        (Chain(3), Chain(2, quantity="velocity"), False),
        # numbered from the other end: the force at the last mass
        (Chain(3, act_plus=3, meas_plus=3, ground_dampers=(3,)), Chain(2, ground_dampers=(1,)), True),
    ],
    ids=str,
)  # fmt: skip
def test_literal_pairs(large, small, said):
    assert contains(large, small) is said


def test_a_limit_by_exchanging_force_and_sensor_is_no_containment():
    """The response is the same by reciprocity; a sensor at the force would tell them apart."""
    large, small = (
        Chain(3, meas_plus=3, ground_dampers=(3,)),
        Chain(2, meas_plus=2, ground_dampers=(1,)),
    )
    assert by_elements(small, large, True) is not None
    assert not contains(large, small)


@pytest.mark.parametrize(
    ("large", "small", "said"),
    [
        ("R0-p(R1,C1)", "R0-C1", True),
        ("R0-p(R1,C1)", "R0-R1", True),
        ("R0-p(R1,C1)-p(R2,C2)", "p(R1,C1)-R0", True),
        ("R0-p(R1,P1)", "R0-p(R1,C1)", True),
        ("R0-p(R1,C1)", "R0-L1", False),
        ("R0-C1", "R0-p(R1,C1)", False),
        ("1=2=3, 2=4; F1; S1", "1=2=3; F1; S1", True),
    ],
)
def test_networks_by_the_same_function(large, small, said):
    assert contains(network_of(large), network_of(small)) is said
    assert not contains(network_of(small), network_of(small))


def test_the_relation_is_transitive():
    inside = {c: {s for s in FREE if contains(c, s)} for c in FREE}
    assert all(inside[s] <= inside[c] for c in FREE for s in inside[c])


PAIRS = [(large, small) for large, small in product(FREE, FREE) if contains(large, small)]


@pytest.mark.full
@settings(max_examples=40, deadline=None)
@given(st.sampled_from(PAIRS), st.integers(0, 10**6))
def test_near_the_limit_the_larger_chain_has_the_response_of_the_smaller_one(pair, seed):
    """Computed with the whole matrix, by code of its own."""
    large, small = pair
    values = truth(small, seed)
    some = 1j * OMEGA[::15]
    wanted = np.array([dense_response(small, values, s) for s in some])
    size = scale(FrequencyResponse(OMEGA, np.repeat(wanted, 15)))
    apart = []
    for near in embeddings(large, small, values, size):
        if min(near.values()) > 1e-12 * min(values.values()):  # the whole matrix rounds more
            own = [dense_response(large, near, s) for s in some]
            apart.append(np.abs(np.array(own) / wanted - 1).max())
    assert min(apart) < 1e-3


@pytest.mark.full
def test_a_search_that_failed_begins_again_at_the_limit():
    """Or ends there, with all that the contained structure shows."""
    small, large = (Chain(1, damped=True, ground_dampers=(1,), lag=lag) for lag in (False, True))
    data = response(small, {"m1": 0.01, "b1": 0.5}, noise=0.01)
    fitted = {c.chain: c for c in select(data, [small, large], case=Case.LOGARITHM).candidates}
    contained, task = fitted[small], Task(Cost(data))
    known = observed_scatters([c.estimate for c in fitted.values()], task, None)
    far = replace(fitted[large], chi2=1e6, chi2_apart=1e6, worst_apart=1e6)
    assert not far.explains(known[1]) and contained.explains(known[1])
    with pytest.raises(AssertionError, match=r"contains .*, which is left, and is not left"):
        check_left([contained], [contained, far], task, known)
    again = searched_again([contained], [contained, far], task, None, known, Settings())
    assert set(again) == {large} and again[large].explains(known[1])
    assert again[large].j_train <= contained.j_train * 1.001
    limit = limit_in(large, contained, task, known[0])
    _, there = _from_limit(far, contained, limit, task, None, known, Settings())
    assert list(there.estimate.parameters.values()) == limit.tolist()
    assert there.chi2 == contained.chi2 and there.residual is contained.residual
    held = replace(task, bounds={"T1": (0.01, 1.0)})  # away from the limit
    assert limit_in(large, contained, held, known[0]) is None
    assert limit_in(small, fitted[large], task, known[0]) is None
