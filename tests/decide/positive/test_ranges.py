"""Positive equivalents within ranges."""

from fractions import Fraction

import pytest

from disting import Certainty, Chain, Family, InputError
from disting.decide.positive import confirms_within, ranges, within_ranges
from disting.decide.positive.points import random_point, read
from disting.decide.positive.ranges import equivalent_within
from disting.decide.same.real_and_positive import POSITIVELY
from disting.evidence.positive import BoxMap, Points, Share
from disting.model.question import Answer

D3 = Family(3, damped=True)


def test_a_renaming_maps_boxes():
    """A2 and A5 mirror each other: m1 becomes m3."""
    box = ranges({"m1": (1, 2)}, {"m3": ("1/2", 2)})
    found = within_ranges(D3[2], D3[5], box)
    assert (
        found.share is Share.ALWAYS
        and isinstance(found.evidence, BoxMap)
        and ("m1", "m3") in found.evidence.pairs
    )
    assert confirms_within(found.evidence, D3[2], D3[5], box)
    for given in ((1, 3), ("1/3", 2)):  # beyond either end
        assert not confirms_within(
            found.evidence, D3[2], D3[5], ranges({"m1": given}, {"m3": ("1/2", 2)})
        )
    assert not confirms_within(BoxMap((("m1", "m1"),)), D3[2], D3[5], box)


@pytest.mark.full
def test_an_unbounded_parameter_does_not_fit_into_a_range():
    found = within_ranges(D3[1], D3[1], ranges({}, {"m1": (1, 2)}))
    assert found.share is Share.SOMETIMES and found.empirical.open == 0


@pytest.mark.full
def test_duality_within_ranges():
    box = ranges({}, {"m1": ("0.5", 5)})
    found = within_ranges(D3[1], D3[11], box)
    assert found.share is Share.SOMETIMES and isinstance(found.evidence, Points)
    assert confirms_within(found.evidence, D3[1], D3[11], box)
    assert not confirms_within(
        Points(found.evidence.without, found.evidence.with_one), D3[1], D3[11], box
    )
    assert POSITIVELY.decode(POSITIVELY.encode(found)) == found


def test_collocated_equivalents_are_all_listed():
    """Two masses, force and sensor at 1: of the dual with the gap there is one model, mass M
    m1/m2, spring (M/m2)^2 k12.
    """
    given, other = Chain(2, damped=False), Chain(2, 1, 1, 2, 1, 2, damped=False)
    point = random_point(given, "two")
    m1, m2, k = (point[name] for name in ("m1", "m2", "k12"))
    total = m1 + m2
    mass = total * m1 / m2
    exact = Fraction(int(mass.p), int(mass.q))
    near = {"m1": (exact * Fraction(999, 1000), exact * Fraction(1001, 1000))}
    assert equivalent_within(given, point, other, near) is Answer.YES
    assert equivalent_within(given, point, other, {"m1": (exact * 2, exact * 3)}) is Answer.NO
    spring = k * (total / m2) ** 2
    exact = Fraction(int(spring.p), int(spring.q))
    assert equivalent_within(given, point, other, {"k01": (exact, exact)}) is Answer.YES


def test_an_element_at_the_end_of_its_range_is_not_guessed():
    """The mass with force and sensor is 1/lim s^2 G, the same in both; a ball around it reaches
    over the end of the range.
    """
    given, other = Chain(3, damped=False), Chain(3, act_plus=2, meas_plus=2, damped=False)
    point = random_point(given, "end")
    mass = Fraction(int(point["m1"].p), int(point["m1"].q))
    for ends in ((mass / 2, mass), (mass, 2 * mass)):
        assert equivalent_within(given, point, other, {"m2": ends}) is Answer.UNKNOWN
    for ends in ((mass / 3, mass / 2), (2 * mass, 3 * mass)):
        assert equivalent_within(given, point, other, {"m2": ends}) is Answer.NO
    assert equivalent_within(given, point, other, {"m2": (mass / 2, 2 * mass)}) is Answer.YES


@pytest.mark.full
def test_without_a_positive_equivalent_there_is_none_in_a_box():
    from disting.decide.positive import positive_finding

    six, two = Family(4, damped=False)[6], Family(4, damped=False)[2]
    point = read(positive_finding(six, two).evidence.without)
    assert (
        equivalent_within(six, point, two, {"m1": (Fraction(1, 10**6), Fraction(10**6))})
        is Answer.NO
    )


@pytest.mark.full
def test_families_stay_open_rather_than_guessed():
    found = within_ranges(
        Family(4, damped=False)[2], Family(4, damped=False)[6], ranges({}, {"m1": ("1e-6", "1e-5")})
    )
    assert found.share is Share.UNKNOWN and found.empirical.open > 0


def test_never_without_ranges_is_never_within():
    found = within_ranges(D3[7], D3[6], ranges({"m1": (1, 2)}, {}))
    assert found.share is Share.NEVER


@pytest.mark.full
def test_a_fixed_value_may_be_special():
    """NEVER speaks of generic parameters; a box without width asks for special ones."""
    assert within_ranges(D3[7], D3[6], ranges({"m1": (1, 1)}, {})).share is Share.UNKNOWN
    assert (
        within_ranges(
            Family(3, damped=False)[1], Family(3, damped=False)[2], ranges({"m1": (1, 1)}, {})
        ).share
        is Share.NEVER
    )


def test_points_lie_in_their_ranges():
    box = ranges({"m1": ("1e-9", "2e-9"), "k12": (3, 3)}, {})
    point = random_point(Chain(2, damped=False), "box", box.chain)
    assert (
        Fraction(1, 10**9) <= Fraction(int(point["m1"].p), int(point["m1"].q)) <= Fraction(2, 10**9)
    )
    assert point["k12"] == 3 and point == random_point(Chain(2, damped=False), "box", box.chain)


@pytest.mark.parametrize(
    "bounds",
    [
        (-1, 1),
        (2, 1),
        ("x", 1),
        (1, float("inf")),
        (float("nan"), 1),
        (None, 1),
        ("1/0", 1),
        ("", ""),
    ],
)
def test_bad_ranges(bounds):
    with pytest.raises(InputError):
        ranges({"m1": bounds}, {})


def test_unknown_names():
    with pytest.raises(InputError, match="k99"):
        within_ranges(Chain(2, damped=False), Chain(2, damped=False), ranges({"k99": (1, 2)}, {}))


@pytest.mark.full
def test_a_short_point_is_no_witness():
    """24 bits cannot tell m1 from 1 in this range: one point of twenty has m1 = 1, all other
    models have another m1.
    """
    chain, narrow = Chain(2, damped=True), ranges({"m1": (1, "4194305/4194304")}, {"m1": (1, 1)})
    found = within_ranges(chain, chain, narrow)
    assert found.share is Share.UNKNOWN and found.empirical.hits == 1
    at_one = tuple((name, "1") for name in chain.parameters)
    other = (("m1", "4194305/4194304"), *at_one[1:])
    assert not confirms_within(Points(at_one, other), chain, chain, narrow)


@pytest.mark.full
def test_what_is_found_rests_on_long_points_and_says_how_surely():
    """Listed solutions are bounded, words are exact; each free coordinate of a witness has 100
    bits at least.
    """
    damped, box = (D3[1], D3[11]), ranges({}, {"m1": ("0.5", 5)})
    found = within_ranges(*damped, box)
    assert (found.share, found.certainty) == (
        Share.SOMETIMES,
        Certainty.BOUNDED,
    ) and found.safety >= 100
    for values in (found.evidence.with_one, found.evidence.without):
        assert all(
            max(int(part).bit_length() for part in text.split("/")) >= 100 for _, text in values
        )
    six, two = Family(4, damped=False)[6], Family(4, damped=False)[2]
    exact = within_ranges(six, two, ranges({"m1": (1, 2)}, {"m1": ("1e-9", "1e9")}))
    assert (exact.share, exact.certainty) == (Share.SOMETIMES, Certainty.PROVEN)


@pytest.mark.full
def test_a_witness_on_the_edge_of_a_range_proves_nothing_near_by():
    """m1 of the equivalent is m1 itself: at the end of the other range half of the models near
    by have none.
    """
    chain, box = D3[1], ranges({"m1": (1, 2)}, {"m1": (1, "3/2")})
    found = within_ranges(chain, chain, box)
    assert found.share is Share.SOMETIMES and confirms_within(found.evidence, chain, chain, box)
    edge = tuple((name, "3/2" if name == "m1" else text) for name, text in found.evidence.with_one)
    assert not confirms_within(Points(edge, found.evidence.without), chain, chain, box)


@pytest.mark.full
def test_a_parameter_that_both_ranges_fix_may_sit_on_the_edge():
    box = ranges({"m1": (1, 1)}, {"m1": (1, 1), "k12": (1, 2)})
    found = within_ranges(D3[1], D3[1], box)
    assert found.share is Share.SOMETIMES and confirms_within(found.evidence, D3[1], D3[1], box)
