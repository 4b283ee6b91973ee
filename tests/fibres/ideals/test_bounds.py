"""Error bounds: their growth, and a prime so small that errors must happen."""

from disting.fibres.ideals import normalise
from disting.fibres.ideals.bounds import safety_of_empty, safety_of_member
from disting.model.family import Family


def ends(n):
    family = Family(n, damped=True)
    return normalise(family[1].structure), normalise(family[len(family)].structure)


def test_bounds_shrink_with_size_and_grow_with_the_prime():
    empties = [safety_of_empty(*ends(n), True) for n in (2, 3, 4, 5)]
    members = [safety_of_member(*ends(n)) for n in (2, 3, 4, 5)]
    assert empties == sorted(empties, reverse=True) and empties[-1] > 0
    assert members == sorted(members, reverse=True) and members[-1] > 0
    assert (
        safety_of_empty(*ends(3), True, 31)
        < safety_of_empty(*ends(3), True, 61)
        < safety_of_empty(*ends(3), True)
    )


def test_small_primes_give_no_bound_for_large_models():
    assert safety_of_empty(*ends(5), True, 31) == 0


def test_without_equal_rank_more_is_allowed_for():
    assert safety_of_empty(*ends(4), False) <= safety_of_empty(*ends(4), True)
