"""Networks at points against their polynomials written out: the same degrees, constants, bounds,
values, derivatives and profiles.
"""

import pickle
import random
from dataclasses import replace

import pytest
from hypothesis import HealthCheck, assume, given, settings, strategies as st

from disting import Query, View, compare
from disting.algebra.certainty import prime
from disting.behaviour.profile import profile
from disting.behaviour.sample import Representation
from disting.errors import InputError
from disting.general.any_model import of_network, without_names
from disting.general.behaviour import GeneralModel
from disting.general.expansion import TooLargeError
from disting.general.network_model import NetworkModel, behaviour_of
from disting.model.question import Settings
from disting.network.families import family_of
from disting.network.notation import network_of
from disting.verdict.result import Relation
from tests.network.drawn import built, descriptions


def has_numbers(network):
    """Whether a ratio is a number: polynomials written out are then freed of common ones."""
    return any(e.ratio and e.known_ratio is not None for e in network.elements)


def profiles_agree(model) -> None:
    at_points, written = (
        profile(m, Representation.TF, 0, Settings())
        for m in (behaviour_of(model), GeneralModel(without_names(model)))
    )
    assert 0 <= written.safety - at_points.safety <= 4 * has_numbers(model.network)
    assert replace(at_points, safety=0) == replace(written, safety=0)


def agrees(model, draw):
    """Whether it is known at points; all that is said there is what the polynomials say."""
    at_points, written = behaviour_of(model), GeneralModel(without_names(model))
    if not isinstance(at_points, NetworkModel):
        return False
    assert at_points.parameters == written.parameters
    for entry in model.entries:
        terms = sum(map(len, (*entry.numerator_terms, *entry.denominator_terms)))
        degrees = len(entry.numerator_terms) - 1, len(entry.denominator_terms) - 1
        assert (entry.n_terms, entry.degrees) == (terms, degrees)
    assert (at_points.degrees, at_points.n_states) == (written.degrees, written.n_states)
    for markov in (None, 4):
        assert at_points.constants(markov) == written.constants(markov)
        mine, yours = at_points.minor_size(markov), written.minor_size(markov)
        assert mine.degree == yours.degree and mine.bits >= yours.bits
        assert mine.bits == yours.bits or has_numbers(model.network)
    modulus, size = prime("points"), len(model.parameters)
    point = [draw.randrange(1, modulus) for _ in range(size)]
    for values in (point, [3] * size):  # colours ask at values that are equal
        assert at_points.columns(values, modulus) == written.columns(values, modulus)
    found = (m.quotients(point, modulus) for m in (at_points, written))
    for one, other in zip(*found, strict=True):
        assert (one is None) == (other is None)
        if one is not None:
            assert (one.num, one.den) == (other.num, other.den)
            assert one.num_derivatives == other.num_derivatives
            assert one.den_derivatives == other.den_derivatives
    return True


@pytest.mark.full
@settings(max_examples=40, suppress_health_check=[HealthCheck.filter_too_much])
@given(descriptions(), st.integers(0, 1000))
def test_random_networks(description, seed) -> None:
    network = built(description)
    assume(not isinstance(network, str) and network.parameters)
    try:
        model = of_network(network)
    except InputError:
        assume(False)
    agrees(model, random.Random(seed))


@pytest.mark.full
@pytest.mark.parametrize(
    ("family", "known"), [("machines-2-damped", 13), ("circuits-4", 63), ("compartments-2", 12)]
)
def test_families(family, known) -> None:
    draw, seen = random.Random(1), 0
    for network in family_of(family).networks:
        model = of_network(network)
        seen += agrees(model, draw)
        profiles_agree(model)
    assert seen == known


@pytest.mark.thin(1)
@pytest.mark.parametrize(
    "text",
    [
        "1=2=3; F1; S3:2",
        "1=2=3=1, 3=4; F1; S3:2",  # terms of both signs
        "1=2=3=4=1, 2=5; F2:1; S4:3",
        "1~2~3~4~1, 1=3; F2:4; S3:1; S3; S2",
        "1=2*i; F1; S2",
        "1=2*i=3*j, 3=4*i; F1; S3:4",
        "1=2*3; F1; S2",
        "1=2*5/2=3*7/3, 1~3*35/6; F1; S3",  # a loop of ratios that agree
        "1=2*5/2=3*i; F1:#; S2; S3",
        "1=2*i, 2=3; F3:2; S1:2",
        "1=2=3, 2=4; F1; S3; S4",
        "1=2=3; F1; F3; S2; S1",
        "1>2, 2>1, 2>0; in 1; out 1",
        "1>2, 2>3, 3>1, 3>0; in 1; in 2; out 3; out 1",
        "1>2, 2>3, 3>2; in 1; out 3",
    ],
)
def test_all_kinds(text) -> None:
    model = of_network(network_of(text))
    known = agrees(model, random.Random(4))
    assert known == (text not in ("1=2*i=3*j, 3=4*i; F1; S3:4", "1=2*i, 2=3; F3:2; S1:2"))
    profiles_agree(model)


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("1=2*i, 2=3, 3=1; F1; S2", "ratios that do not agree in a loop"),
        ("1=2*i; F1; S2:1", "a difference of positions that a gear keeps apart"),
        ("1=2*3, 2=3, 3=1; F1; S2", "numbers that do not agree in a loop"),
        ("R0-p(R1,P1)", "a constant phase element"),
    ],
)
def test_others_are_written_out(text, why) -> None:
    assert isinstance(behaviour_of(of_network(network_of(text))), GeneralModel)


def test_what_is_not_seen_has_no_derivatives() -> None:
    model = of_network(network_of("1~2, 2~#, 3~#; F1; S1"))
    assert agrees(model, random.Random(2))
    found = profile(behaviour_of(model), Representation.TF, 0, Settings())
    assert (found.rank, found.n_parameters) == (4, 6)


@pytest.mark.parametrize("text", ["R0-p(W1,R1)", "R0-p(R1,C1)-W1"])
def test_half_powers(text) -> None:
    assert agrees(of_network(network_of(text)), random.Random(3))


def test_terms_are_written_out_when_they_are_asked_for() -> None:
    network = network_of("1=2=3, 2=4; F1; S4")
    late, soon = of_network(network), of_network(network)
    whole = late.n_terms, late.degrees, str(soon)
    assert soon == late and hash(soon) == hash(late) and str(late) == whole[2]
    assert pickle.loads(pickle.dumps(of_network(network))) == soon  # as workers get it
    with pytest.raises(AttributeError, match="no attribute 'numerators'"):
        _ = late.numerators


LARGE = "=".join(map(str, range(1, 11)))


@pytest.mark.full
@pytest.mark.parametrize(
    ("branch", "relation"),
    [("6=11, 11=12", Relation.UNDECIDED), ("5=11", Relation.DISTINGUISHABLE)],
)
def test_networks_with_too_many_terms(branch, relation) -> None:
    """Profiles may tell them apart; what needs the terms is left open, and said."""
    left, right = (network_of(f"{LARGE}, {b}; F1; S10") for b in ("5=11, 11=12", branch))
    found = compare(left, right, query=Query(View.EXACT, inclusion=False))
    assert found.relation is relation
    with pytest.raises(TooLargeError, match="grow too large"):
        _ = of_network(left).numerator
