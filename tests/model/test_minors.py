"""Minors of structures: places that make a part of a whole, and what is none."""

from dataclasses import replace

import pytest

from disting import Chain, Family
from disting.model.minors import is_minor, minors


def found(part, whole, ports):
    return list(minors(part.structure, whole.structure, ports))


def test_a_missing_element_leaves_masses_where_they_are():
    for n, damped in ((2, False), (3, True)):
        same = {i: i for i in range(n + 1)}
        for chain in Family(n, damped):
            for more in ({"lag": True}, {"dead_time": True}, {"ground_dampers": (n,)}):
                whole = replace(chain, **more)
                assert next(minors(chain.structure, whole.structure, {})) == same
                assert is_minor(chain.structure, whole.structure, same)
                assert not is_minor(whole.structure, chain.structure, same)
                assert found(whole, chain, {}) == []


def test_a_spring_without_bound_and_a_mass_at_rest():
    assert found(Chain(1), Chain(2, meas_plus=2), {1: 1, 2: 1}) == [{0: 0, 1: 1, 2: 1}]
    fixed, free = Chain(2, 1, 1, 2, 1, 2), Chain(3, 1, 1, 2, 1, 2)
    assert {0: 0, 1: 1, 2: 2, 3: 2} in found(fixed, free, {1: 1, 2: 2})
    # a mass of the free row at rest is a wall for the one before it
    assert is_minor(fixed.structure, Chain(4, 1, 1, 2, 1, 2).structure, {0: 0, 1: 2, 2: 1, 3: 0})


@pytest.mark.parametrize(
    ("part", "whole", "places"),
    [
        (Chain(1), Chain(2), {0: 0, 1: 2}),  # no such node
        (Chain(1), Chain(2), {0: 0, 3: 1}),  # no such mass
        (Chain(1), Chain(2), {1: 1}),  # the ground has no place
        (Chain(1), Chain(2), {0: 1, 1: 1}),
        (Chain(2), Chain(3), {0: 0, 1: 1}),  # a node without a mass
        (Chain(2), Chain(3), {0: 0, 1: 1, 3: 2}),  # nothing joins them
        (Chain(1), Chain(3), {0: 0, 1: 1, 3: 1}),  # nor these
        (Chain(1), Chain(2, 1, 1, 2, 1, 2), {0: 0, 1: 1, 2: 1}),  # a gap is no spring
        (Chain(2, damped=True), Chain(3, damped=False), {0: 0, 1: 1, 2: 2}),
        (Chain(2, ground_dampers=(2,)), Chain(3, ground_dampers=(1,)), {0: 0, 1: 1, 2: 2}),
        (Chain(1, lag=True), Chain(2), {0: 0, 1: 1}),
        (Chain(1, dead_time=True), Chain(2), {0: 0, 1: 1}),
    ],
)
def test_what_is_no_minor(part, whole, places):
    assert not is_minor(part.structure, whole.structure, places)
    assert places not in found(part, whole, {})


def test_elements_that_come_together_add_up():
    """Dampers of two masses that are one body, one of them wanted."""
    part, whole = Chain(1, ground_dampers=(1,)), Chain(2, ground_dampers=(2,))
    assert found(part, whole, {1: 1}) == [{0: 0, 1: 1, 2: 1}]
