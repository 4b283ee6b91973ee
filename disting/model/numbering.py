"""Numbers of chains under (36), (37) and (38), by counting: nothing is listed.

The indices that are admissible are, gap by gap: n_act- and n_meas- each any low index (0 where the
gap is 0, else 1..gap), n_act+ one of the nearer half of the free row, n_meas+ one from n_act+ to
N_B. Models stand in the order of (n_gap, n_act-, n_act+, n_meas-, n_meas+), so how many stand
before one is a sum of products.
"""

from disting.model.constraints import Indices


def count(n: int) -> int:
    """How many models have n masses.

    >>> [count(n) for n in range(1, 9)]
    [1, 3, 11, 29, 73, 157, 314, 574]
    """
    return sum(_with_gap(n, gap) for gap in range(n))


def before(indices: Indices) -> int:
    """How many models of as many masses stand before this one, which is admissible.

    >>> before(Indices(3, 0, 0, 2, 0, 2))
    3
    """
    n, gap, act_minus, act_plus, meas_minus, meas_plus = indices
    low = _low(gap)
    return (
        sum(_with_gap(n, smaller) for smaller in range(gap))
        + low.index(act_minus) * len(low) * _free_ends(n, gap)
        + len(low) * sum(n - end + 1 for end in range(gap + 1, act_plus))
        + low.index(meas_minus) * (n - act_plus + 1)
        + meas_plus
        - act_plus
    )


def after(n: int, place: int) -> Indices:
    """The model that so many stand before: the inverse of `before`, for 0 <= place < count(n)."""
    gap = 0
    while place >= _with_gap(n, gap):
        place -= _with_gap(n, gap)
        gap += 1
    low, act_plus = _low(gap), gap + 1
    act_minus, place = divmod(place, len(low) * _free_ends(n, gap))
    while place >= len(low) * (n - act_plus + 1):
        place -= len(low) * (n - act_plus + 1)
        act_plus += 1
    meas_minus, place = divmod(place, n - act_plus + 1)
    return Indices(n, gap, low[act_minus], act_plus, low[meas_minus], act_plus + place)


def _low(gap: int) -> range:
    """Where n_act- and n_meas- may be: (36) and (37)."""
    return range(min(gap, 1), gap + 1)


def _free_ends(n: int, gap: int) -> int:
    """Pairs of n_act+ and n_meas+: (36) and (38)."""
    return sum(n - act_plus + 1 for act_plus in range(gap + 1, gap + (n - gap + 1) // 2 + 1))


def _with_gap(n: int, gap: int) -> int:
    return len(_low(gap)) ** 2 * _free_ends(n, gap)
