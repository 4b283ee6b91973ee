"""Both statements on the fibre of one random point rest on one Gröbner basis."""

import sys
from dataclasses import replace

import pytest

from disting.algebra.symbols import symbols
from disting.fibres.ideals.membership import NO_BOUND, GivenUp
from disting.fibres.ideals.one_value import (
    LIMITS,
    _basis_at,
    _own_basis,
    one_value,
    safety_of_count,
)
from disting.fibres.ideals.system import CoefficientMap, coefficient_map
from disting.model.chain import Chain


def test_a_count_after_the_values_computes_no_basis_anew():
    chain = Chain(3, act_plus=2, meas_plus=2, damped=False)
    model = coefficient_map(chain.structure)
    one_value(model, chain.parameters, seed="shared")
    before = _own_basis.cache_info()
    assert safety_of_count(model, 2, seed="shared") > 100
    after = _own_basis.cache_info()
    assert after.misses == before.misses
    assert after.hits > before.hits


def test_a_basis_that_comes_too_late_is_given_up():
    chain = Chain(2, damped=False)
    with pytest.raises(GivenUp, match="20 s"):
        _basis_at(coefficient_map(chain.structure), "late", deadline=0.0)


def test_what_is_too_large_is_given_up_with_the_reason(monkeypatch):
    few = replace(LIMITS, entries=1)
    monkeypatch.setattr(sys.modules[one_value.__module__], "LIMITS", few)
    chain = Chain(3, act_plus=2, meas_plus=2, damped=False)
    model = coefficient_map(chain.structure)
    found = one_value(model, chain.parameters, seed="few")
    assert (found.unique, found.several, found.safety) == ((), (), 0)
    assert found.reason.startswith("too large: a matrix of ")
    assert safety_of_count(model, 2, seed="few") == 0
    x = symbols(["x"])["x"]
    high = CoefficientMap(("x",), (x**70,), (x**0,))
    assert one_value(high, ["x"], seed="high").reason == "too large: degree 70"


def test_primes_of_a_word_give_no_bound_for_high_degrees():
    x, y = symbols(["x", "y"]).values()
    model = CoefficientMap(("x", "y"), (x ** (2**40), x + y), (y ** (2**40), x**0))
    assert one_value(model, ["x", "y"], seed="high").reason == NO_BOUND
    assert safety_of_count(model, 1, seed="high") == 0


def test_nothing_counts_the_values_of_what_is_not_determined():
    """Of two masses and a spring, the sensor at the other mass, some are free."""
    chain = Chain(2, meas_plus=2, damped=True)
    assert safety_of_count(coefficient_map(chain.structure), 1, seed="free") == 0
