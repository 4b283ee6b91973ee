"""Equivalents of models with dampers to the ground, lag and dead time: judged by plain
numerical mechanics.
"""

from dataclasses import replace
from fractions import Fraction

import pytest

from disting.equivalence import Origin, Signs, assignments, chains_of, equivalents
from disting.errors import InputError
from disting.fibres.synthesis.task import Status
from disting.model.chain import Chain
from disting.model.family import Family
from disting.model.names import chain_of
from tests.equivalence.mechanics import agree

VALUES = assignments(
    ["m1=1,m2=2,m3=3,k12=100,k23=50,d12=0.1,d23=0.3,b1=0.5,b2=0.2,b3=0.7,T1=1/50,Td=0.01"]
)


def values_of(chain):
    return {name: VALUES[name] for name in chain.parameters}


@pytest.mark.full
def test_every_equivalent_of_a_model_with_friction_has_its_frequency_response():
    given = chain_of("3:1+b3", Family(3, damped=True))
    found = equivalents(given, values_of(given), "3+b*")
    assert len(found.listings) == 88
    assert len(found) > 20 and all(agree(given, values_of(given), member, 1e-6) for member in found)
    (own,) = [li for li in found.listings if li.chain == given]
    assert own.complete and [m.origin for m in own.members] == [Origin.GIVEN]
    proven = [li.name for li in found.listings if li.status is Status.EMPTY and li.complete]
    assert len(proven) == 83 and "3:11+b1+b3" in proven


def test_an_equivalent_leads_back():
    """There and back, the values written with 15 digits between."""
    given = chain_of("3:8+b2", Family(3, damped=True))
    values = {name: VALUES.get(name, "2") for name in given.parameters}
    there = equivalents(given, values, "3:11+b2").listings[0]
    assert there.complete and len(there.members) == 2
    positive = [m for m in there.members if m.signs is Signs.POSITIVE]
    assert positive
    for member in positive:
        back = equivalents(member.chain, member.text, given).listings[0]
        expected = {name: pytest.approx(float(Fraction(v)), rel=1e-6) for name, v in values.items()}
        assert back.complete and sum(m.values == expected for m in back.members) == 1


@pytest.mark.parametrize(
    ("one", "other", "damped"),
    [
        ("3:2+b2+b3", "3:2+b2+b3", True),
        ("3:4+b1+b2", "3:5+b2", True),
        ("3:4+b2", "3:4+b2", False),
        ("3:8+b2", "3:11+b2", True),
    ],
)
def test_members_come_in_the_order_of_signs_and_agree(one, other, damped):
    given = chain_of(one, Family(3, damped=damped))
    values = {name: VALUES.get(name, "3/2") for name in given.parameters}
    listing = equivalents(given, values, other, damped=damped).listings[0]
    assert listing.complete
    assert all(agree(given, values, member, 1e-6) for member in listing.members)
    signs = [list(Signs).index(member.signs) for member in listing.members]
    assert signs == sorted(signs)


def test_parallel_dampers_are_told_as_infinitely_many():
    given = Chain(2, 1, 1, 2, 1, 2, damped=True, ground_dampers=(1,))
    values = {"m1": "1", "m2": "2", "k01": "30", "d01": "0.2", "b1": "0.1"}
    listing = equivalents(given, values, given).listings[0]
    assert listing.status is Status.INFINITE and "infinitely many" in listing.sentence
    sampled = [m for m in listing.members if m.origin is Origin.SYNTHESIS]
    assert [m.values["b1"] for m in sampled] == [pytest.approx(0.15)] and agree(
        given, values, sampled[0]
    )


def test_lag_and_dead_time_stay_what_they_are():
    given = chain_of("3:4+b2+lag+delay", Family(3, damped=False))
    found = equivalents(given, values_of(given), given)
    assert all((m.values["Td"], m.values["T1"]) == (0.01, pytest.approx(0.02)) for m in found)
    assert found.listings[0].complete and all(agree(given, values_of(given), m) for m in found)
    without = replace(given, lag=False, dead_time=False)
    assert equivalents(given, values_of(given), without).listings[0].status is Status.EMPTY
    without = chain_of("3:4+b2", Family(3, damped=False))
    listing = equivalents(without, values_of(without), "3:4+b2+lag").listings[0]
    assert listing.status is Status.NOT_COVERED and "lag" in listing.sentence


def test_an_element_near_zero_is_named():
    given = chain_of("3:1+b3", Family(3, damped=True))
    listing = equivalents(given, values_of(given), "3:1+b1+b3").listings[0]
    assert not listing.complete and "cannot be distinguished from zero" in listing.sentence


def test_text_for_structures():
    given = Chain(3, damped=True)
    assert chain_of("3:4+b3+b1+lag", Family(3, damped=False)) == Chain(
        3, 0, 0, 2, 0, 2, ground_dampers=(1, 3), lag=True, damped=False
    )
    assert {c.ground_dampers for c in chains_of("3+b2", given)} == {(2,)} and len(
        chains_of("3+b2", given)
    ) == 11
    assert len(set(chains_of("3+b*", given))) == 88
    assert all(c.lag and c.damped for c in chains_of("2+b*+lag", given))
    for wrong in ("3:4+b4", "3:4+b0", "3:4+x", "3:4+", "3+c1"):
        with pytest.raises(InputError):
            chains_of(wrong, given)
