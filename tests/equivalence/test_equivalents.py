"""Equivalent parameter vectors: literal ones, planted ones, and laws; judged by plain numerical
mechanics.
"""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from disting.equivalence import Origin, Signs, equivalents, explicit_map
from disting.equivalence.inputs import point_of
from disting.errors import InputError
from disting.fibres.synthesis.task import Status
from disting.model.chain import Chain, Quantity
from disting.model.family import Family
from tests.equivalence.mechanics import agree

DAMPED = {"m1": 1, "m2": 2, "m3": 3, "k12": 100, "k23": 70, "d12": "0.1", "d23": 0.3}
PROPORTIONAL = DAMPED | {"d23": "0.07"}


def test_motor_with_two_loads_and_machine_on_an_elastic_base():
    found = equivalents("3:1", DAMPED, "3:11", damped=True)
    (member,) = found
    assert member.exact == {
        "m1": Fraction(24, 5),
        "m2": Fraction(6, 5),
        "m3": 6,
        "k01": 280,
        "k12": 144,
        "d01": Fraction(6, 5),
        "d12": Fraction(18, 125),
    }
    assert (member.signs, member.origin, member.bound) == (Signs.POSITIVE, Origin.DUALITY, 0.0)
    assert member.text["d12"] == "0.144" and member.residual == 0.0
    assert found.listings[0].complete and found.listings[0].sentence == "all there are"
    assert agree(Family(3, True)[1], DAMPED, member)


@pytest.mark.parametrize(
    ("damped", "number", "values"),
    [
        (True, 1, DAMPED),
        (True, 1, PROPORTIONAL),
        (False, 4, {"m1": 1, "m2": 2, "m3": 3, "k12": 100, "k23": 70}),
        (False, 6, {"m1": "1e-3", "m2": "2e-3", "m3": 0.5, "k01": "1e5", "k23": "3/7"}),
        (True, 6, {"m1": 1, "m2": 2, "m3": 3, "k01": 100, "k23": 70, "d01": 1, "d23": 3}),
        (False, 3, {"m1": 1, "m2": 2, "m3": 3, "k12": 100, "k23": 70}),
    ],
)
def test_every_member_has_the_same_frequency_response(damped, number, values):
    chain = Family(3, damped)[number]
    found = equivalents(chain, values, Family(3, damped))
    assert len(found.listings) == 11
    assert [m.origin for m in found.listings[number - 1].members].count(Origin.GIVEN) == 1
    for member in found:
        assert agree(chain, values, member)
        assert member.residual < 1e-9 and member.bound < 1e-20
        assert set(member.values) == set(member.chain.parameters)
    order = [list(Signs).index(member.signs) for member in found]
    assert order == sorted(order)


@pytest.mark.full
def test_proportional_damping_makes_more_structures_equivalent():
    assert [
        li.name for li in equivalents("3:1", DAMPED, "3", damped=True).listings if li.members
    ] == ["3:1", "3:11"]
    found = equivalents("3:1", PROPORTIONAL, "3", damped=True)
    assert [li.name for li in found.listings if li.members] == ["3:1", "3:4", "3:6", "3:8", "3:11"]
    assert found.proportional


@pytest.mark.full
def test_planted_equivalent_with_split_roots_is_found_again():
    """Model 6, undamped, is one of two that model 1 has for these values; a third structure
    leads there.
    """
    planted = {"m1": 1, "m2": 2, "m3": 3, "k01": 5, "k23": 7}
    six, one = Family(3, damped=False)[6], Family(3, damped=False)[1]
    image = explicit_map(six, one).at(planted)
    found = list(equivalents(one, image, six))
    assert len(found) == 2 and all(m.signs is Signs.POSITIVE for m in found)
    assert any(
        all(abs(m.values[name] - v) < 1e-12 * v for name, v in planted.items()) for m in found
    )


def test_members_that_are_not_positive_and_families():
    found = equivalents(
        "3:3", {"m1": 1, "m2": 2, "m3": 3, "k12": 100, "k23": 70}, "3", damped=False
    )
    third, sixth = found.listings[2], found.listings[5]
    assert third.status is Status.INFINITE and not third.complete
    assert {m.free_choices for m in third.members} == {0, 2}
    assert sixth.complete and [m.signs for m in sixth.members] == [Signs.REAL, Signs.REAL]


def test_complex_members():
    """A damped chain with force and sensor beside each other: two of three parameter vectors
    are complex conjugates.
    """
    values = {"m1": 3, "m2": 10, "m3": 6, "k12": 650, "k23": 450, "d12": 5, "d23": 12}
    found = list(equivalents("3:2", values, "3:2", damped=True))
    assert [m.signs for m in found] == [Signs.POSITIVE, Signs.COMPLEX, Signs.COMPLEX]
    assert all(agree(Family(3, True)[2], values, m) for m in found)
    assert abs(found[1].values["m1"] - found[2].values["m1"].conjugate()) < 1e-12


def test_text_follows_the_chain():
    chain = Chain(3, damped=True, quantity=Quantity.VELOCITY)
    (listing,) = equivalents(chain, DAMPED, "3:11").listings
    assert (listing.chain.damped, listing.chain.quantity, len(listing.members)) == (
        True,
        Quantity.VELOCITY,
        1,
    )


def test_symmetric_chain_says_why_nothing_is_known_but_the_theorems():
    values = {"m1": 1, "m2": 2, "m3": 1, "k12": 100, "k23": 100}
    listing = equivalents("3:4", values, "3:4", damped=False).listings[0]
    assert [m.origin for m in listing.members] == [Origin.GIVEN] and not listing.complete
    assert "vibration mode" in listing.sentence and "may be incomplete" in listing.sentence
    other = equivalents("3:4", values, "3:1", damped=False).listings[0]
    assert not other.members and "nothing is known" in other.sentence and not other.complete


@pytest.mark.full
def test_equal_ratios_are_named_and_proportional_members_given():
    values = {
        "m1": 1,
        "m2": 2,
        "m3": 3,
        "m4": 5,
        "k12": 100,
        "k23": 70,
        "k34": 40,
        "d12": 0.1,
        "d23": 0.07,
        "d34": 0.04,
    }
    listing = equivalents("4:2", values, "4:6", damped=True).listings[0]
    assert listing.status is Status.DEGENERATE and "k12/d12 = k23/d23 = k34/d34" in listing.sentence
    assert listing.members and {m.origin for m in listing.members} == {Origin.PROPORTIONAL}
    assert all(agree(Family(4, True)[2], values, m) for m in listing.members)


def test_other_sizes_dampers_and_extras():
    undamped = {"m1": 1, "m2": 2, "m3": 3, "k12": 100, "k23": 70}
    smaller = equivalents("3:1", undamped, Family(2, damped=False)).listings
    assert all(li.status is Status.EMPTY and li.complete for li in smaller)
    larger = equivalents("3:1", undamped, "4:1", damped=False).listings[0]
    assert larger.status is Status.NOT_COVERED and "more masses" in larger.sentence
    without = equivalents(Family(3, True)[1], DAMPED, Family(3, damped=False)[1]).listings[0]
    assert without.status is Status.EMPTY
    friction = Chain(3, 0, 0, 1, 0, 2, ground_dampers=(1,), damped=False)
    mirrored = Chain(3, 0, 0, 3, 0, 2, ground_dampers=(3,), damped=False)
    listing = equivalents(friction, undamped | {"b1": 2}, mirrored).listings[0]
    assert [m.origin for m in listing.members] == [Origin.RENAMING] and not listing.complete
    assert agree(friction, undamped | {"b1": 2}, listing.members[0])
    late = Chain(3, dead_time=True, damped=False)
    assert (
        equivalents(late, undamped | {"Td": "1e-3"}, Chain(3, damped=False)).listings[0].status
        is Status.EMPTY
    )
    assert len(equivalents(late, undamped | {"Td": "1e-3"}, late)) == 1


@pytest.mark.thin(8)
@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"m2": None}, "the value of m2 is missing"),
        ({"k01": 1}, "k01: no parameter"),
        ({"m1": 0}, "positive"),
        ({"m1": -1}, "positive"),
        ({"m1": "abc"}, "a number such as"),
        ({"m1": "nan"}, "a number such as"),
        ({"m1": float("inf")}, "a number such as"),
        ({"m1": True}, "a number such as"),
        ({"m1": 1 + 2j}, "a number such as"),
        ({"m1": "1/0"}, "a number such as"),
        ({"m1": "1e999999999"}, "choose other units"),
    ],
)
def test_bad_values(change, words):
    values = {name: v for name, v in (DAMPED | change).items() if v is not None}
    with pytest.raises(InputError, match=words):
        equivalents("3:1", values, "3:11", damped=True)


@pytest.mark.parametrize(
    ("model", "to"), [("3", "3:1"), ("3:12", "3:1"), ("3:1", "3:0"), ("x", "3"), ("3:1", "")]
)
def test_bad_references(model, to):
    with pytest.raises(InputError):
        equivalents(model, DAMPED, to, damped=True)


def test_sensors_have_to_agree():
    with pytest.raises(InputError, match="quantities differ"):
        equivalents(
            Chain(2, damped=False),
            {"m1": 1, "m2": 1, "k12": 1},
            Chain(2, quantity=Quantity.VELOCITY, damped=False),
        )


def test_values_are_taken_exactly():
    exact = point_of(
        Chain(3, damped=False),
        {"m1": 0.1, "m2": np.float32(0.1), "m3": np.int64(3), "k12": "3/4", "k23": "1e-3"},
    )
    assert [str(v) for v in exact.values()] == ["1/10", "1/10", "3", "3/4", "1/1000"]


def test_to_dict_is_json_of_everything():
    said = equivalents("3:1", DAMPED, "3:11", damped=True).to_dict()
    assert (
        said["values"]["d12"] == "1/10"
        and said["listings"][0]["equivalents"][0]["exact"]["m1"] == "24/5"
    )


numbers = st.integers(1, 12).map(lambda i: Fraction(i, 3))


@st.composite
def models(draw):
    n, damped = draw(st.sampled_from([(2, True), (2, False), (3, True), (3, False), (4, False)]))
    chain = draw(st.sampled_from(Family(n, damped).models))
    return chain, {name: draw(numbers) for name in chain.parameters}


@pytest.mark.full
@settings(max_examples=40, deadline=None)
@given(models())
def test_the_original_is_always_among_its_own_equivalents(model):
    chain, values = model
    (listing,) = equivalents(chain, values, chain).listings
    assert listing.status is not Status.EMPTY
    assert [m.exact for m in listing.members if m.origin is Origin.GIVEN] == [values]
    for member in listing.members:
        if member.origin is Origin.RENAMING:
            assert sorted(member.exact.values()) == sorted(values.values())


@pytest.mark.full
@settings(max_examples=40, deadline=None)
@given(models(), st.data())
def test_an_exact_equivalent_leads_back(model, data):
    chain, values = model
    other = data.draw(st.sampled_from(Family(chain.n_masses, chain.damped).models))
    for member in equivalents(chain, values, other):
        if member.exact:
            back = equivalents(other, member.exact, chain)
            assert any(m.exact == values for m in back)


def test_a_list_that_lacks_what_is_at_the_boundary_is_not_called_complete():
    """All ones: a branch of the synthesis ends at an element near zero, so the one set found
    need not be the only one.
    """
    ones = dict.fromkeys(("m1", "m2", "m3", "k01", "k23"), 1)
    found = equivalents("3:7", ones, "3:6", damped=False)
    (listing,) = found.listings
    assert (listing.status, len(listing.members), listing.complete) == (Status.COMPLETE, 1, False)
    assert "near zero" in listing.sentence
    assert agree(found.chain, ones, listing.members[0])


@pytest.mark.parametrize(("extra", "name"), [("lag", "T1"), ("delay", "Td")])
def test_lag_and_dead_time_are_inherited(extra, name):
    """They belong to the bench: all structures of a size have them too, and the one found by
    its name is found there.
    """
    values = {"m1": 1, "m2": 2, "k12": 100, name: "0.01"}
    found = equivalents(f"2:1+{extra}", values, "2", damped=False)
    assert [listing.name for listing in found.listings] == [f"2:{i}+{extra}" for i in (1, 2, 3)]
    (named,) = equivalents(f"2:1+{extra}", values, f"2:3+{extra}", damped=False).listings
    (short,) = equivalents(f"2:1+{extra}", values, "2:3", damped=False).listings
    assert short == named == found.listings[2]
    (member,) = named.members
    assert (member.signs, member.text["m1"], member.text["k01"]) == (Signs.POSITIVE, "1.5", "225")
    assert [
        c.name
        for c in equivalents(f"2:1+{extra}", values, Family(2, damped=False), damped=False).listings
    ] == [f"2:{i}+{extra}" for i in (1, 2, 3)]


def test_a_chain_is_taken_as_it_is():
    """Asked of a chain without a dead time, the answer is about that chain."""
    (listing,) = equivalents(
        "2:1+delay", {"m1": 1, "m2": 2, "k12": 100, "Td": "0.01"}, Family(2, damped=False)[3]
    ).listings
    assert (
        listing.members == ()
        and listing.complete
        and "only one of them has a dead time" in listing.sentence
    )


def test_none_exists_says_over_which_parameters():
    (listing,) = equivalents("2:2", {"m1": 1, "m2": 2, "k12": 100}, "2:1", damped=False).listings
    assert listing.sentence.startswith(
        "none exists, with positive parameters or any others: proven ("
    )
