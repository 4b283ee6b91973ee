"""Networks at points against their polynomials written out: the same degrees, constants, bounds,
values, derivatives and profiles.
"""

import pickle
import random

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from disting import Query, View, compare
from disting.algebra.sampling import prime
from disting.behaviour.profile import profile
from disting.behaviour.sample import Representation
from disting.errors import InputError
from disting.general.any_model import of_network, unnamed
from disting.general.behaviour import GeneralModel
from disting.general.expansion import TooLargeError
from disting.general.network_model import NetworkModel, behaviour_of
from disting.model.question import Settings
from disting.network.families import family_of
from disting.network.notation import network_of
from disting.verdict.result import Relation
from tests.network.drawn import built, descriptions


def agrees(model, draw):
    """Whether it is known at points; all that is said there is what the polynomials say."""
    at_points, written = behaviour_of(model), GeneralModel(unnamed(model))
    if not isinstance(at_points, NetworkModel):
        return False
    assert at_points.parameters == written.parameters
    terms = sum(map(len, (*model.numerator_terms, *model.denominator_terms)))
    assert (model.n_terms, model.degrees) == (terms, written.degrees[0])
    assert (at_points.degrees, at_points.n_states) == (written.degrees, written.n_states)
    for markov in (None, 4):
        assert at_points.constants(markov) == written.constants(markov)
        assert at_points.minor_size(markov) == written.minor_size(markov)
    modulus, size = prime("points"), len(model.parameters)
    point = [draw.randrange(1, modulus) for _ in range(size)]
    for values in (point, [3] * size):  # colours ask at values that are equal
        assert at_points.columns(values, modulus) == written.columns(values, modulus)
    (one,), (other,) = (m.quotients(point, modulus) for m in (at_points, written))
    assert (one.num, one.den) == (other.num, other.den)
    assert one.num_derivatives == other.num_derivatives
    assert one.den_derivatives == other.den_derivatives
    return True


@given(descriptions(most_ports=1), st.integers(0, 1000))
def test_random_networks(description, seed) -> None:
    network = built(description)
    assume(not isinstance(network, str) and network.parameters)
    try:
        model = of_network(network)
    except InputError:
        assume(False)
    agrees(model, random.Random(seed))


@pytest.mark.parametrize(
    ("family", "known"), [("machines-2-damped", 10), ("circuits-4", 63), ("compartments-2", 0)]
)
def test_families(family, known) -> None:
    draw, seen = random.Random(1), 0
    for network in family_of(family).networks:
        model = of_network(network)
        seen += agrees(model, draw)
        found = profile(behaviour_of(model), Representation.TF, 0, Settings())
        assert found == profile(GeneralModel(unnamed(model)), Representation.TF, 0, Settings())
    assert seen == known


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("1=2=3; F1; S3:2", "a difference of two positions: terms of both signs"),
        ("1=2*i; F1; S2", "a gear"),
        ("R0-p(R1,P1)", "a constant phase element"),
        ("1>2, 2>1, 2>0; in 1; out 1", "flows"),
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
