"""Chains that are one model under two descriptions, and dead times: the answer is the same over
positive parameters.
"""

import pytest

from disting import Chain, Quantity, Query, Relation, View, compare

VIEWS = [View.EXACT, View.REAL, View.POSITIVE]


@pytest.mark.thin(8)
@pytest.mark.parametrize("view", VIEWS)
@pytest.mark.parametrize(
    "extras", [{}, {"lag": True}, {"ground_dampers": (1,)}, {"dead_time": True}]
)
def test_one_mass_without_springs_is_the_same_damped_and_undamped(extras, view):
    """There is nothing to put a damper beside: the two chains have the same elements."""
    verdict = compare(
        Chain(1, damped=True, **extras), Chain(1, damped=False, **extras), query=Query(view)
    )
    assert verdict.relation is Relation.INDISTINGUISHABLE


def test_a_lag_and_a_damper_to_the_ground():
    """1/(m s + b) from a velocity is (1/m)/(1 + T1 s), with b for m and m/b for T1: the same over
    complex parameters.

    Over positive and real ones chains of two kinds are left open, where no renaming decides.
    """
    lagging, braked = (
        Chain(1, lag=True, damped=False),
        Chain(1, ground_dampers=(1,), quantity=Quantity.VELOCITY, damped=False),
    )
    for pair in ((lagging, braked), (braked, lagging)):
        assert compare(*pair, query=Query(View.EXACT)).relation is Relation.INDISTINGUISHABLE
        for view in (View.POSITIVE, View.REAL):
            assert compare(*pair, query=Query(view)).relation in (
                Relation.INDISTINGUISHABLE,
                Relation.UNDECIDED,
            )


@pytest.mark.parametrize("view", VIEWS)
def test_a_dead_time_that_both_have_changes_nothing(view):
    """Duals without a dead time stay the same with one: it is a factor of its own, equal where
    the rational parts are.
    """
    plain, dual = (
        Chain(2, damped=True, dead_time=True),
        Chain(2, 1, 1, 2, 1, 2, damped=True, dead_time=True),
    )
    assert compare(plain, dual, query=Query(view)).relation is Relation.INDISTINGUISHABLE
