"""The duality theorem, tried exactly on rational points."""

import pytest

from disting.fibres.synthesis.decide import rational_point
from disting.fibres.synthesis.fibre import fibre
from disting.fibres.synthesis.task import target
from disting.fibres.synthesis.theorems import are_dual, dual
from disting.model.chain import Chain
from disting.model.family import Family
from disting.model.question import Answer


def at_gap(n: int, g: int, damped: bool = True) -> Chain:
    return Chain(n, g, g, g + 1, g, g + 1, damped=damped)


@pytest.mark.thin(8)
@pytest.mark.parametrize("damped", [False, True])
@pytest.mark.parametrize(("n", "g"), [(n, g) for n in range(2, 7) for g in range(n)])
def test_dual_parameters_are_positive_and_have_the_same_transfer_function(
    n: int, g: int, damped: bool
) -> None:
    left, right = at_gap(n, g, damped), at_gap(n, n - 1 - g, damped)
    point = rational_point(left, "dual")
    image = dual(left, point)
    assert are_dual(left, right)
    assert all(value > 0 for value in image.values())
    assert target(left.structure, point) == target(right.structure, image)
    assert dual(right, image) == point


def test_number_of_dual_pairs_of_a_family() -> None:
    models = Family(5, damped=True).models
    pairs = [
        (i, j)
        for i, a in enumerate(models, 1)
        for j, b in enumerate(models, 1)
        if i <= j and are_dual(a, b)
    ]
    assert pairs == [(1, 73), (13, 56), (33, 33)]


@pytest.mark.parametrize(("n", "g"), [(3, 1), (5, 2)])
def test_self_dual_chains_have_exactly_two_positive_parameter_vectors(n: int, g: int) -> None:
    chain = at_gap(n, g)
    found = fibre(chain, target(chain.structure, rational_point(chain, "test")))
    assert [s.positive for s in found.solutions].count(Answer.YES) == 2


def test_others_are_not_dual() -> None:
    assert not are_dual(at_gap(3, 0), at_gap(3, 1))
    assert not are_dual(at_gap(3, 0), at_gap(3, 2, damped=False))
    assert not are_dual(Chain(3, act_plus=2, meas_plus=2, damped=True), at_gap(3, 2))
