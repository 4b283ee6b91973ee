"""Outflows that tell the same: the other values by the matrices of the proof, in plain numbers, and
truth by hand.
"""

import random
from itertools import combinations, permutations

import numpy as np
import pytest

from disting import compare
from disting.network.outflows import reachable, simplest_outflows

ALL = [
    # where the only outflow of a graph is, and where all are, if input and output are one
    ("1>2, 2>1, 2>3, 3>1, 1>0; in 1; out 1", "1>2, 2>1, 2>3, 3>1, 2>0, 3>0; in 1; out 1"),
    # all flows turned round
    ("1>2, 2>3, 3>1, 2>1, 1>0; in 1; out 1", "2>1, 3>2, 1>3, 1>2, 1>0; in 1; out 1"),
    # a third outflow beside those of input and output
    (
        "1>2, 2>1, 1>3, 3>1, 3>2, 2>3, 1>0, 2>0; in 1; out 2",
        "1>2, 2>1, 1>3, 3>1, 3>2, 2>3, 1>0, 2>0, 3>0; in 1; out 2",
    ),
    # behind a compartment
    ("1>2, 2>3, 3>4, 4>2, 2>0; in 1; out 2", "1>2, 2>3, 3>4, 4>2, 4>0; in 1; out 2"),
]
OTHER = [
    ("1>2, 2>1, 1>0; in 1; out 2", "1>2, 2>1, 2>0; in 1; out 2"),
    ("1>2, 2>1, 1>3, 3>2, 2>0; in 1; out 2", "1>2, 2>1, 1>3, 3>2, 3>0; in 1; out 2"),
    ("1>2, 2>3, 3>1, 2>1, 1>0; in 1; out 2", "2>1, 3>2, 1>3, 1>2, 1>0; in 1; out 2"),
]


@pytest.mark.full
@pytest.mark.parametrize(("left", "right"), ALL)
def test_networks_that_are_the_same(left, right):
    found = compare(left, right)
    assert found.relation.value == "indistinguishable"
    assert found.certainty == ("theorem" if found.has_exceptions else "proven")


@pytest.mark.full
@pytest.mark.parametrize(("left", "right"), OTHER)
def test_networks_that_are_not(left, right):
    found = compare(left, right)
    assert found.relation.value != "indistinguishable"


def transfer(flows, leaks, enter, leave):
    """G at a few s, from values of flows and outflows."""
    n = 1 + max(i for pair in flows for i in pair)
    a = np.zeros((n, n))
    for (i, j), x in flows.items():
        a[j, i] += x
        a[i, i] -= x
    for i, x in leaks.items():
        a[i, i] -= x
    return a, [np.linalg.inv(s * np.eye(n) - a)[leave, enter] for s in (0.3, 1.0, 2.7)]


def scaled(a, other):
    """The values with the outflows `other`, as W A W^-1."""
    w = np.linalg.solve(-a.T, other)
    return w[:, None] * a / w[None, :], w


def drawn(draw):
    """A graph in which all is reached from the input and reaches the output, and outflows."""
    while True:
        n = draw.randint(2, 5)
        arrows = list(permutations(range(n), 2))
        flows = set(draw.sample(arrows, draw.randint(n - 1, len(arrows))))
        enter, leave = draw.randrange(n), draw.randrange(n)
        leaks = set(draw.sample(range(n), draw.randint(1, n)))
        back = {(j, i) for i, j in flows}
        whole = len(reachable({enter}, flows)) == len(reachable({leave}, back)) == n
        if whole and reachable({leave}, flows) & leaks:
            return n, flows, leaks, enter, leave


@pytest.mark.full
@pytest.mark.parametrize("way", ["there", "back"])
def test_values_of_the_other_outflows_by_the_matrices_of_the_proof(way):
    draw, moved = random.Random(way), 0
    for _ in range(150):
        n, flows, leaks, enter, leave = drawn(draw)
        other = simplest_outflows(flows, leaks, {enter}, {leave})
        moved += other != leaks
        if way == "back":
            leaks, other = other, leaks
        values = {pair: draw.uniform(0.2, 3) for pair in sorted(flows)}
        a, wanted = transfer(values, {i: draw.uniform(0.2, 3) for i in leaks}, enter, leave)
        found = with_outflows(a, sorted(other), enter, leave)
        assert all(found[j, i] > 0 for i, j in flows)
        out = -found.sum(axis=0)
        assert all((out[i] > 1e-12) == (i in other) for i in range(n)), (flows, leaks, other)
        assert np.allclose(
            [np.linalg.inv(s * np.eye(n) - found)[leave, enter] for s in (0.3, 1.0, 2.7)], wanted
        )
    assert moved > 50


def with_outflows(a, other, enter, leave):
    """Numbers lost > 0 at these outflows for which w is the same at input and output: one, two next
    to each other, or small ones at all others.
    """
    n = len(a)
    inverse = np.linalg.inv(-a)
    ratios = {m: inverse[m, leave] - inverse[m, enter] for m in other}
    lost, small = np.zeros(n), 1e-3
    above = [m for m in other if ratios[m] > 1e-12]
    below = [m for m in other if ratios[m] < -1e-12]
    while True:
        lost[:] = 0
        lost[other] = small
        gap = sum(lost[m] * ratios[m] for m in other)
        if abs(gap) > 1e-12:
            at = max(below if gap > 0 else above, key=lambda m: abs(ratios[m]))
            lost[at] -= gap / ratios[at]
        if all(lost[other] > 0):
            found, w = scaled(a, lost)
            assert abs(w[leave] / w[enter] - 1) < 1e-9
            return found
        small /= 2


def test_what_is_told_does_not_depend_on_numbers():
    draw = random.Random(2)
    for _ in range(100):
        n, flows, leaks, enter, leave = drawn(draw)
        to = draw.sample(range(n), n)
        found = simplest_outflows(flows, leaks, {enter}, {leave})
        there = simplest_outflows(
            {(to[i], to[j]) for i, j in flows}, {to[i] for i in leaks}, {to[enter]}, {to[leave]}
        )
        assert there == {to[i] for i in found}
        assert simplest_outflows(flows, found, {enter}, {leave}) == found


def test_no_outflow_of_the_output_changes_nothing():
    """Compartments that the output reaches have none: a pole stays at 0."""
    assert simplest_outflows({(1, 2), (1, 3), (3, 2)}, {1, 3}, {1}, {2}) == {1, 3}
    assert all(
        simplest_outflows({(1, 2)}, set(found), {1}, {2}) == set(found)
        for count in (0, 1)
        for found in combinations([1], count)
    )
