"""Numeric witness: Levenberg-Marquardt finds an equivalent exactly where the verdict says that
there is one.

A solution found supports "indistinguishable"; that none is found for the others is statistics only.
"""

from dataclasses import replace

import numpy as np
import pytest

from disting import Chain, Family, Relation, View, catalog
from tests.witness.levenberg_marquardt import best_residual, coefficients, model

FOUND, NONE = 1e-10, 1e-4
SAMPLE = 40  # distinguishable pairs of a 4-mass class that are tried
# given models at most: an equivalent may lie far from all starts, and a distinguishable one may
# come close
POINTS = 10
SAME = {(1, 11): True, (2, 5): True, (9, 10): True, (1, 8): False, (4, 11): False}


def equal_rank(n: int, damped: bool) -> dict[tuple[int, int], Relation]:
    """Decided pairs whose degrees, symbolic forms and ranks agree, so that only a fibre or
    condition 5 to 9 decides.
    """
    c = catalog(n, damped=damped)
    pairs = (
        (i, j, v) for i, j, v in c.pairs(View.EXACT) if v.decided_by not in ("1", "2", "3", "4")
    )
    return {(i, j): v.relation for i, j, v in pairs if v.relation is not Relation.UNDECIDED}


def disagreements(
    n: int, damped: bool, pairs: dict[tuple[int, int], Relation]
) -> list[tuple[int, int]]:
    family, wrong = Family(n, damped), []
    for (i, j), relation in pairs.items():
        same = relation is Relation.INDISTINGUISHABLE
        if not agrees(family[i], family[j], same):
            wrong.append((i, j))
    return wrong


def agrees(given: Chain, searched: Chain, same: bool) -> bool:
    """Same: an equivalent of some given model. Otherwise none of any, and one is clearly apart."""
    residuals = (best_residual(given, searched, seed=seed) for seed in range(POINTS))
    for residual in residuals:
        if residual < FOUND:
            return same
        if residual > NONE and not same:
            return True
    return False


def test_coefficients_of_one_mass_on_two_others() -> None:
    """H = (m2 s^2 + d s + k)/(s^2 (m1 m2 s^2 + (m1 + m2)(d s + k))) for two masses with force
    and sensor at the first.
    """
    m1, m2, k, d = 2.0, 3.0, 5.0, 7.0
    values, _ = coefficients(model(Chain(2, damped=True)), np.array([[m1, m2, k, d]], complex))
    expected = [k, d, m2, 0, 0, 0, 0, (m1 + m2) * k, (m1 + m2) * d, m1 * m2]
    np.testing.assert_allclose(values[0], np.array(expected) / (m1 * m2), atol=1e-12)


@pytest.mark.parametrize(
    "chain",
    [
        Chain(3, damped=True),
        Chain(4, 2, 1, 3, 2, 4, damped=True),
        Chain(3, 1, 1, 2, 1, 3, damped=False),
    ],
)
def test_jacobian_is_the_derivative(chain: Chain) -> None:
    draw = np.random.default_rng(1)
    at = np.exp(draw.uniform(-0.5, 0.5, (1, len(chain.parameters)))).astype(complex)
    _, slopes = coefficients(model(chain), at)
    for column in range(at.shape[1]):
        step = np.zeros_like(at)
        step[0, column] = 1e-5
        central = (
            coefficients(model(chain), at + step)[0] - coefficients(model(chain), at - step)[0]
        ) / 2e-5
        np.testing.assert_allclose(slopes[0, :, column], central[0], atol=1e-6)


def test_chains_of_other_degrees_have_no_common_point() -> None:
    assert (
        best_residual(Chain(3, damped=True), Chain(3, meas_plus=2, damped=True), starts=4, steps=2)
        == np.inf
    )


@pytest.mark.full
@pytest.mark.sampled(2)
@pytest.mark.parametrize("pair", SAME, ids=str)
def test_three_masses_damped_sample(pair: tuple[int, int]) -> None:
    family = Family(3, damped=True)
    assert agrees(family[pair[0]], family[pair[1]], SAME[pair])


@pytest.mark.full
def test_a_chain_has_its_own_receptance() -> None:
    chain = Chain(3, 1, 1, 2, 1, 3, damped=True)
    assert best_residual(chain, chain, starts=32) < FOUND


def test_a_damped_model_is_none_of_the_undamped_ones() -> None:
    chain = Chain(3, damped=True)
    assert best_residual(chain, replace(chain, damped=False), starts=4, steps=2) == np.inf


@pytest.mark.slow
def test_all_pairs_of_three_masses_damped() -> None:
    pairs = equal_rank(3, True)
    assert len(pairs) == 22
    assert disagreements(3, True, pairs) == []


@pytest.mark.slow
@pytest.mark.parametrize(("damped", "members"), [(False, 49), (True, 9)])
def test_four_masses(damped: bool, members: int) -> None:
    """All indistinguishable pairs, and some of the others."""
    pairs = equal_rank(4, damped)
    same = {
        pair: relation for pair, relation in pairs.items() if relation is Relation.INDISTINGUISHABLE
    }
    others = {
        pair: relation for pair, relation in pairs.items() if relation is Relation.DISTINGUISHABLE
    }
    assert len(same) == members
    every = max(1, len(others) // SAMPLE)
    assert disagreements(4, damped, same | dict(list(others.items())[::every])) == []
