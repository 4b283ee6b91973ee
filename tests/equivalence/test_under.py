"""Equivalents that keep the responses of several experiments, judged by plain numerical mechanics,
and by what is known of pairs under further experiments.
"""

from fractions import Fraction
from itertools import product

import numpy as np
import pytest

from disting import Chain, Experiment, Family, InputError, equivalents
from disting.equivalence import Origin, Signs
from tests.experiments.test_truth import KINDS, SAME

A = Family(3, damped=True)
PLACES = (0.3 + 1.1j, 2.5 - 0.7j, 7.0 + 3.0j, -1.2 + 5.0j)


def values_of(chain):
    numbers = (1, 2, 3, 100, 70, "0.1", "0.3")
    return dict(zip(chain.parameters, numbers, strict=True))


def response(chain, values, s, *, sensor=None, force=None, locked=(), inertias=(), brakes=()):
    """By a linear solve of the masses that move."""
    n = chain.n_masses
    a = np.zeros((n, n), dtype=complex)
    for name, value in values.items():
        if name[0] == "m":
            a[int(name[1:]) - 1, int(name[1:]) - 1] += value * s**2
        else:
            i, j = (int(digit) for digit in name[1:3])
            v = np.array([(node == j) - float(node == i) for node in range(1, n + 1)])
            a += value * (s if name[0] == "d" else 1) * np.outer(v, v)
    for i, size in dict(inertias).items():
        a[i - 1, i - 1] += float(Fraction(size)) * s**2
    for i, size in dict(brakes).items():
        a[i - 1, i - 1] += float(Fraction(size)) * s
    ends = []
    for plus, minus in (
        (force, 0) if force else (chain.act_plus, chain.act_minus),
        (sensor, 0) if sensor else (chain.meas_plus, chain.meas_minus),
    ):
        v = np.zeros(n + 1)
        v[plus] += 1
        v[minus] -= 1
        ends.append(v[1:])
    moving = [i for i in range(n) if i + 1 not in locked]
    part = np.linalg.solve(a[np.ix_(moving, moving)], ends[0][moving])
    return ends[1][moving] @ part


def agrees(given, values, other, member, experiments):
    """Whether a member has the responses of the given model in all experiments."""
    exact = {name: float(Fraction(str(v))) for name, v in values.items()}
    for here, there in experiments:
        for s in PLACES:
            one = response(given, exact, s, **here)
            two = response(other, member.values, s, **there)
            if abs(one - two) > 1e-8 * max(abs(one), 1e-12):
                return False
    return True


PLAIN = {
    "sensor": lambda i: {"sensor": i},
    "locked": lambda i: {"locked": (i,)},
    "inertia": lambda i: {"inertias": {i: "1"}},
}
CASES = [
    (pair, kind, i, j, f"{i}/{j}" in same.split())
    for pair, sames in SAME.items()
    for kind, same in zip(KINDS, sames, strict=True)
    for i, j in product((1, 2, 3), repeat=2)
]


def check(pair, kind, i, j, same):
    given, other = (A[n] for n in pair)
    values = values_of(given)
    text = {"sensor": f"sensor={i}/{j}", "locked": f"lock={i}/{j}", "inertia": f"inertia={i}/{j}:1"}
    found = equivalents(given, values, other, also=[text[kind]])
    (listing,) = found.listings
    assert listing.places == ((i, j),) and listing.complete
    assert bool(listing.members) is same
    further = [({}, {}), (PLAIN[kind](i), PLAIN[kind](j))]
    assert all(agrees(given, values, other, m, further) for m in listing.members)
    alone = equivalents(given, values, other)
    kept = [m.text for m in listing.members]
    for member in alone:
        assert agrees(given, values, other, member, further) is (member.text in kept)


@pytest.mark.parametrize(
    ("pair", "i", "j", "same"),
    [((2, 5), 1, 3, True), ((2, 5), 2, 2, True), ((2, 5), 1, 1, False), ((9, 10), 3, 3, True)],
)
def test_a_brake_keeps_what_has_all_responses(pair, i, j, same):
    """The pair 2, 5 is one machine numbered from its other end."""
    given, other = (A[n] for n in pair)
    values, further = values_of(given), [({}, {}), ({"brakes": {i: 2}}, {"brakes": {j: 2}})]
    (listing,) = equivalents(given, values, other, also=[f"brake={i}/{j}:2"]).listings
    kept = [m.text for m in listing.members]
    assert bool(kept) is same
    for member in equivalents(given, values, other):
        assert agrees(given, values, other, member, further) is (member.text in kept)


@pytest.mark.thin(1)
@pytest.mark.parametrize(("pair", "kind", "i", "j", "same"), CASES[::5])
def test_what_is_kept_has_all_responses_and_what_is_not_has_not(pair, kind, i, j, same):
    check(pair, kind, i, j, same)


@pytest.mark.slow
@pytest.mark.parametrize(("pair", "kind", "i", "j", "same"), CASES)
def test_all_cases(pair, kind, i, j, same):
    check(pair, kind, i, j, same)


def test_in_its_own_structure_places_are_known():
    """Exchanging the ends keeps what is seen in the middle, and not what is seen at an end."""
    chain = A[4]
    values = values_of(chain)
    middle, end = (equivalents(chain, values, chain, also=[f"sensor={i}"]) for i in (2, 1))
    assert {m.origin for m in middle} == {Origin.GIVEN, Origin.RENAMING}
    assert [m.origin for m in end] == [Origin.GIVEN]
    assert [listing.places for listing in end.listings] == [((1, 1),)]


def test_another_experiment_lists_what_the_first_leaves_open():
    chain = Chain(2, meas_plus=2, damped=False)
    values = {"m1": 1, "m2": 2, "k12": 3}
    alone = equivalents(chain, values, chain)
    assert not alone.listings[0].complete
    both = equivalents(chain, values, chain, also=["sensor=1"])
    assert both.listings[0].complete and [m.origin for m in both] == [Origin.GIVEN]


def test_where_every_experiment_leaves_a_family_that_is_said():
    found = equivalents(
        Chain(2, meas_plus=2, damped=False), {"m1": 1, "m2": 2, "k12": 3}, "2:2", also=["lock=2"]
    )
    (listing,) = found.listings
    assert not listing.complete and listing.sentence.startswith("infinitely many fit each")
    assert Origin.GIVEN in {m.origin for m in listing.members}


def test_every_place_is_tried_where_none_is_named():
    found = equivalents(A[2], values_of(A[2]), A[5], also=[Experiment(sensor=2)])
    assert [listing.places for listing in found.listings] == [((2, j),) for j in (1, 2, 3)]
    assert [bool(listing.members) for listing in found.listings] == [False, False, True]
    assert found.experiments == ("as it is", "sensor 2")
    data = found.to_dict()
    assert data["experiments"] == ["as it is", "sensor 2"]
    assert [one["places"] for one in data["listings"]] == [{"2": j} for j in (1, 2, 3)]


def test_a_dead_time_and_a_lag_stay():
    chain = Chain(2, act_plus=1, meas_plus=1, lag=True, dead_time=True, damped=False)
    values = {"m1": 1, "m2": 2, "k12": 3, "T1": "0.1", "Td": "0.2"}
    found = equivalents(chain, values, chain, also=["sensor=2"])
    (member,) = found
    assert member.signs is Signs.POSITIVE and member.exact["Td"] == Fraction(1, 5)


@pytest.mark.parametrize(
    ("also", "said"),
    [
        ("sensor=4", "no mass 4"),
        ("sensor", "an experiment is written"),
        ("sensor=1/9", "no mass 9 in the right model"),
    ],
)
def test_bad_input(also, said):
    with pytest.raises(InputError, match=said):
        equivalents(A[2], values_of(A[2]), A[5], also=[also])
