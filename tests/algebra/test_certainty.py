"""Random points and primes: fixed by their label for ever, and error bounds that are what the
formula says.

The text that keys and random points are made of tells everything, whatever `repr` shows.
"""

from collections import Counter
from fractions import Fraction
from itertools import combinations
from math import log2

import pytest
from flint import fmpz
from hypothesis import given, strategies as st

from disting import Chain, Experiment, Family, Model, Query, Settings, View
from disting.algebra.certainty import (
    LEAST_SAFETY,
    PROOF_BITS,
    SEARCH_BITS,
    Size,
    about,
    digest,
    enough,
    full_text,
    prime,
    residues,
    safety,
)
from disting.behaviour.sample import Representation
from disting.experiments.experiment import MeasuredChain
from disting.verdict.engine import profile_key

CHAIN = (
    "Chain(n_masses=2, gap=0, act_minus=0, act_plus=1, meas_minus=0, meas_plus=2,"
    " sensor=<Sensor.ACCELERATION: 'acceleration'>, damped=True, ground_dampers=(1,), lag=False,"
    " dead_time=False)"
)


def test_a_chain_is_written_as_the_shipped_catalogues_saw_it():
    """Their evidence holds at points that are drawn by labels with this text."""
    chain = Chain(2, meas_plus=2, damped=True, ground_dampers=(1,))
    assert full_text(chain) == CHAIN
    assert about("label", chain) == "label:cf4e88e3ae912a6cd8c00a4044409dbf"


def test_what_is_inside_is_written_too():
    measured = MeasuredChain(Chain(1, damped=False), (Experiment(inertias={1: "1/2"}),))
    text = full_text([{"a": (measured, 1.5)}])
    assert text.startswith("[{'a': (MeasuredChain(chain=Chain(n_masses=1, ")
    assert "inertias=((1, Fraction(1, 2)),)" in text and text.endswith(", 1.5)}]")
    assert full_text(((Fraction(1, 2),),)) == "((Fraction(1, 2),),)" and full_text(()) == "()"


def test_models_that_look_alike_have_texts_and_keys_of_their_own():
    """Short texts for a reader leave coefficients out."""
    models = [
        Model.from_transfer_function([f"{k}*a"], [1, "b"], name="same name") for k in (1, 2, 3)
    ]
    assert len({repr(m) for m in models}) == 1
    assert len({full_text(m) for m in models}) == 3
    assert len({profile_key(m, Representation.TF, 0, Settings()) for m in models}) == 3


@pytest.mark.full
def test_all_chains_of_a_size_differ_in_text():
    chains = [*Family(4, damped=False), *Family(4, damped=True)]
    assert all(full_text(a) != full_text(b) for a, b in combinations(chains, 2))
    assert full_text(Query()) != full_text(Query(View.EXACT))


sizes = st.builds(Size, st.integers(1, 10**6), st.integers(1, 10**6))


def test_residues_depend_on_the_label_alone():
    assert residues("a", 3, 1000) == residues("a", 3, 1000)
    assert residues("a", 3, 1000) != residues("b", 3, 1000)
    assert residues("a", 5, 1000)[:3] == residues("a", 3, 1000)
    assert residues("a", 0, 1000) == []


def test_residues_of_today_are_those_of_tomorrow():
    """Literal: a change would give every stored profile another point."""
    assert residues("literal", 4, 101) == [3, 88, 14, 14]
    assert prime("literal") == 2201840542103641267


@pytest.mark.parametrize("modulus", [2, 3, 7])
def test_residues_are_all_but_zero(modulus):
    assert set(residues("all", 500, modulus)) == set(range(1, modulus))


def test_residues_are_even():
    count = Counter(residues("even", 6000, 7))
    assert all(850 < count[r] < 1150 for r in range(1, 7))


@pytest.mark.parametrize("bits", [SEARCH_BITS, PROOF_BITS])
@pytest.mark.parametrize("label", ["a", "b", "disting:0"])
def test_primes_have_their_bits(label, bits):
    p = prime(label, bits)
    assert p.bit_length() == bits
    assert fmpz(p).is_prime()
    assert prime(label, bits) == p


def test_primes_of_different_labels_differ():
    assert len({prime(str(i)) for i in range(50)}) == 50


@given(sizes, st.integers(1, 5))
def test_safety_is_the_floor_of_the_formula(size, points):
    """miss = degree/2^60 + (1 + bits/60)/#primes, and b is the largest with miss^points <= 2^-b."""
    primes = 3 * 2.0**60 / (5 * 61 * 0.6932)
    miss = size.degree / 2.0**60 + (1 + size.bits / 60) / primes
    b = safety(size, points)
    assert miss**points <= 2.0**-b
    assert miss**points > 2.0 ** -(b + 1)


@given(sizes, st.integers(1, 5), st.integers(0, 10**5))
def test_safety_falls_with_the_size_and_grows_with_the_points(size, points, more):
    base = safety(size, points)
    assert safety(Size(size.degree + more, size.bits), points) <= base
    assert safety(Size(size.degree, size.bits + more), points) <= base
    assert safety(size, points + 1) > base


def test_the_number_of_primes_is_a_lower_bound():
    """At least 3x/(5 ln x) primes from x to 2x (Rosser and Schoenfeld): so counted for smaller
    x.
    """
    for bits in (8, 12, 16):
        x = 2 ** (bits - 1)
        counted = sum(fmpz(n).is_prime() for n in range(x, 2 * x))
        assert counted >= 3 * x / (5 * bits * 0.6932)


def test_vanishing_is_as_rare_as_the_bound_says():
    """x (x - 1) .. (x - 4) vanishes at 4 of the points 1..p-1: Schwartz and Zippel allow
    degree/(p - 1).
    """
    p, hits = 101, 0
    for x in residues("vanish", 10_000, p):
        hits += any((x - root) % p == 0 for root in range(5))
    assert Fraction(hits, 10_000) < Fraction(5, 100) * 11 / 10
    assert log2(10_000 / hits) == pytest.approx(log2(100 / 4), abs=0.2)


def test_labels_depend_on_all_of_the_content():
    contents = [("a",), ("b",), ("a", "b"), ("b", "a"), ("ab",), (("a",),), (1,), ("1",)]
    assert len({about("label", *c) for c in contents} | {about("other", "a")}) == 9


@given(st.integers(1, 400), st.integers(1, 10**4), st.integers(1, 9))
def test_enough_points_reach_the_least_safety(degree, bits, asked):
    size = Size(degree, bits)
    assert enough(size, asked) >= asked
    assert safety(size, enough(size, asked)) >= LEAST_SAFETY + 19


def test_numbers_of_any_length_are_told_apart():
    """Python does not write integers of more than 4300 digits in decimal."""
    long = 10**5000
    assert len({digest(("a", (x, 1))) for x in (long, long + 1, -long)}) == 3
