"""Both statements on the fibre of one random point rest on one Gröbner basis."""

import pytest

from disting.fibres.ideals.membership import GivenUp
from disting.fibres.ideals.one_value import _basis_at, _own_basis, one_value, safety_of_count
from disting.fibres.ideals.system import coefficient_map
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
