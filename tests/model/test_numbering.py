"""Numbers of chains of any size; the oracle lists all of them, constraint by constraint."""

from itertools import pairwise, product

import pytest
from hypothesis import given, strategies as st

from disting import Family, InputError, Quantity, compare, verify
from disting.model.chain import Chain, Indices, violations
from disting.model.family import MOST_MASSES, after, before, count
from disting.model.names import name_of, read
from disting.verdict.verdict_file import verdict_file
from disting.verdict.verification import Status
from tests.cli.process import called


def listed(n):
    """All admissible indices in lexicographic order."""
    for gap in range(n):
        low, high = range(gap + 1), range(gap + 1, n + 1)
        for ports in product(low, high, low, high):
            indices = Indices(n, gap, *ports)
            if not any(violations(indices, (36, 37, 38))):
                yield indices


@pytest.mark.thin(1)
@pytest.mark.parametrize("n", range(1, 13))
def test_counting_is_listing(n):
    every = list(listed(n))
    assert count(n) == len(every) == len(Family(n))
    assert [after(n, place) for place in range(len(every))] == every
    assert list(map(before, every)) == list(range(len(every)))


@pytest.mark.full
@pytest.mark.parametrize("n", [1, 2, 8, 9, 12])
def test_the_family_of_a_size_numbers_these(n):
    family = Family(n, damped=True, quantity=Quantity.VELOCITY)
    assert [chain.indices for chain in family] == list(listed(n))
    for number in {1, len(family) // 2 + 1, len(family)}:
        chain = family[number]
        assert (family.number(chain), name_of(chain)) == (number, f"{n}:{number}")
        assert chain in family and chain not in Family(n)
        assert (chain.damped, chain.quantity) == (True, Quantity.VELOCITY)


@pytest.mark.full
@given(st.integers(13, MOST_MASSES), st.randoms(use_true_random=False))
def test_numbers_of_large_chains_are_in_order_and_read_back(n, random):
    places = sorted(random.sample(range(count(n)), 9))
    indices = [after(n, place) for place in places]
    assert list(map(before, indices)) == places
    assert all(a < b for a, b in pairwise(indices))
    name = name_of(Chain(*indices[0], ground_dampers=(n,), lag=True, damped=False))
    assert name == f"{n}:{places[0] + 1}+b{n}+lag"
    assert read(name).chain(Family(1)).indices == indices[0]


def test_what_is_not_listed_has_no_number():
    turned = Chain(9, act_plus=9, meas_plus=9, damped=False)
    assert turned not in Family(9) and Chain(8) not in Family(9) and "9:1" not in Family(9)
    assert name_of(turned) == "(9 masses, gap 0, force 9-0, sensor 9-0)"
    with pytest.raises(InputError, match="is not in the 9-mass family"):
        Family(9).number(turned)
    with pytest.raises(InputError, match="models 1 to 993, not 994"):
        Family(9)[994]


@pytest.mark.full
@pytest.mark.parametrize("pair", [("9:1", "9:2"), ("8:1", "9:1"), ("12:1+b12", "12:3851")])
def test_sentences_of_large_chains_have_their_names(pair):
    sentence = compare(*pair, damped=False).sentence
    assert all(name in sentence for name in pair) and "gap" not in sentence
    data = verdict_file(*pair, damped=False)
    assert (data["left"], data["right"]) == pair
    assert verify(data).status is Status.HOLDS


@pytest.mark.full
@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("compare", "9:1", "9:2"), "9:1 and 9:2, damped, acceleration, are distinguishable"),
        (("compare", "8:1", "9:1", "--undamped"), "8:1 is a limit of 9:1"),
        (("next", "9:1", "9:2"), "9:1 and 9:2 are distinguishable by the present"),
        (("simulate", "9:1"), "the parameters of 9:1 are m1, m2"),
        (("equivalents", "9:1", "--to", "9:1", "--set", "k9=1"), "no parameter of 9:1; its"),
    ],
)
def test_commands_call_large_chains_by_their_names(words, said):
    done = called(*words)
    assert said in done.stdout + done.stderr
    assert "masses, gap" not in done.stdout + done.stderr


@pytest.mark.full
def test_one_number_of_two_machines_is_told_apart_by_damping_and_quantity():
    found = compare(Chain(9), Chain(9, damped=False, quantity=Quantity.VELOCITY)).sentence
    assert found.startswith("9:1 (damped, acceleration) and 9:1 (undamped, velocity) are dist")
    assert "masses, gap" not in found
