"""Limits against explicit one-parameter families of an independent program: what a family shows is
told, with evidence that holds, and no refutation speaks against it.
"""

from dataclasses import replace
from fractions import Fraction
from itertools import combinations, product
from random import Random

import pytest

from disting import Chain, Engine, Experiment, Family, Query, Relation, View
from disting.behaviour.profile import profile
from disting.behaviour.sample import Representation
from disting.conditions.inclusion import Inclusion
from disting.decide.inclusion.across_sizes import refute
from disting.decide.inclusion.closures import of_closure
from disting.decide.inclusion.confirmation import confirms
from disting.decide.inclusion.decide import quick_closure
from disting.decide.inclusion.pole_sharing import excluding_points
from disting.decide.inclusion.profiles import by_profiles
from disting.evidence.limits import Outside
from disting.experiments.experiment import MeasuredChain
from disting.experiments.inclusion import inclusions_under
from disting.experiments.machine_model import MachineModel
from disting.experiments.measured_evidence import confirms_inclusion
from disting.model.question import Settings
from tests.oracles.one_parameter_families import (
    elements_of,
    families,
    key_of,
    ports_of,
    tends,
)

ENGINE = Engine()
SIZES = {"inertias": "3/2", "brakes": "7/4", "springs": "5/3"}
CHANGES = {"sensor": None, "force": None, "locked": None, **SIZES}


def machines(most, dead_times=(False,)):
    """All chains up to a size, with and without dampers, dampers to the ground, lag."""
    for n, damped, lag, delay in product(
        range(1, most + 1), (False, True), (False, True), dead_times
    ):
        for plain in Family(n, damped) if n > 1 or not damped else ():
            for b in (c for k in range(n + 1) for c in combinations(range(1, n + 1), k)):
                yield replace(plain, ground_dampers=b, lag=lag, dead_time=delay)


def limits(chains):
    """Small chain, large chain and the families that lead from the one to the other."""
    known = {key_of(c): c for c in chains}
    for large in chains:
        for family in families(large):
            if known.get(family.key, large) != large:
                yield known[family.key], large, family


def values_of(chain, draw):
    return {e: Fraction(draw.randint(1, 99), draw.randint(1, 20)) for e in elements_of(chain)}


def agree(chains, share):
    """Every pair that a family joins; a share of the families put in with numbers."""
    draw, seen, told = Random(1), set(), {"numbers": 0, "limits": 0, "equal": 0}
    for small, large, family in limits(chains):
        if draw.random() < share:
            assert tends(family, large, small, values_of(small, draw), {}, {}), (small, large)
            told["numbers"] += 1
        if (small, large) in seen:
            continue
        seen.add((small, large))
        one, other = (ENGINE.subject("", chain) for chain in (small, large))
        assert one.rank <= other.rank, (small, large)
        if one.rank == other.rank:
            found = ENGINE.verdict(one, other, Query(View.EXACT, inclusion=False))
            assert found.relation is not Relation.DISTINGUISHABLE, (small, large)
            told["equal"] += 1
            continue
        closure = quick_closure(one, other)
        assert closure is not None and closure.inclusion is Inclusion.LEFT_IN_RIGHT, (small, large)
        assert quick_closure(other, one).inclusion is Inclusion.RIGHT_IN_LEFT
        assert confirms(closure.evidence, one, other) and not refutes(one, other)
        told["limits"] += 1
    return told


def refutes(one, other):
    """Whether anything that can deny a limit does, asked by itself."""
    small, large = one.view.form, other.view.form
    if small.n_masses < large.n_masses:
        return refute(one, other, False) is not None or excluding_points(small, large, "families")
    profiles = (side.profile(Representation.TF, 0) for side in (one, other))
    by_profile = by_profiles(*profiles, left_is_smaller=True)
    by_rows = of_closure(small, large, "families")
    return (by_profile is not None and by_profile.inclusion is Inclusion.NEITHER) or (
        by_rows is not None and isinstance(by_rows[0], Outside)
    )


@pytest.mark.full
def test_limits_of_one_and_two_masses(record_property):
    told = agree(list(machines(2)), share=0.2)
    record_property("oracle", f"limits of 1 and 2 masses, families: {told}, 0 denied")
    assert told["limits"] > 250


@pytest.mark.full
def test_a_dead_time_that_vanishes():
    told = agree([c for c in machines(2, (False, True)) if not c.damped], share=0.2)
    assert told["limits"] > 100


@pytest.mark.slow
def test_limits_of_up_to_three_masses(record_property):
    told = agree(list(machines(3)), share=0.5)
    record_property("oracle", f"limits of 1 to 3 masses, families: {told}, 0 denied")
    assert told["limits"] > 6000


def experiment(kind, mass):
    size = CHANGES[kind]
    return Experiment(**{kind: {mass: size} if size else mass})


def setup(chain, kind, mass):
    """The same in the words of the independent program."""
    plus, minus, sees, from_ = ports_of(chain)
    if kind == "sensor":
        return {"ports": (plus, minus, mass, 0)}
    if kind == "force":
        return {"ports": (mass, 0, sees, from_)}
    size = CHANGES[kind]
    return {kind: {mass: Fraction(size)} if size else (mass,)}


def profile_of(measured):
    return profile(MachineModel(measured), Representation.TF, 0, Settings(subset_limit=0))


def agree_under(chains, share):
    """A share of all pairs with one further experiment at a mass that both have."""
    draw, seen, told = Random(2), set(), 0
    for small, large, family in limits(chains):
        places = [(i, at) for i, at in family.nodes if i and at]
        for kind, (i, at) in product(CHANGES, places):
            key = (small, large, kind, i, at)
            if key in seen or (kind == "locked" and small.n_masses == 1) or draw.random() > share:
                continue
            seen.add(key)
            sides = [
                MeasuredChain(chain, (Experiment(), experiment(kind, mass)))
                for chain, mass in ((small, at), (large, i))
            ]
            setups = setup(large, kind, i), setup(small, kind, at)
            assert tends(family, large, small, values_of(small, draw), *setups), key
            ranks = [profile_of(m).rank for m in sides]
            assert ranks[0] <= ranks[1], key
            if ranks[0] < ranks[1]:
                closure = inclusions_under(*sides, profile_of).closure
                assert closure.inclusion is Inclusion.LEFT_IN_RIGHT, key
                assert confirms_inclusion(closure.evidence, *sides)
                told += 1
    return told


@pytest.mark.full
def test_limits_under_one_experiment(record_property):
    told = agree_under(list(machines(2)), share=0.08)
    record_property("oracle", f"limits under one experiment, families: {told}, 0 denied")
    assert told > 120


@pytest.mark.slow
def test_limits_of_up_to_three_masses_under_one_experiment(record_property):
    told = agree_under(list(machines(3)), share=0.05)
    record_property("oracle", f"limits of 1 to 3 masses under one experiment: {told}, 0 denied")
    assert told > 3000


def test_the_oracle_sees_what_is_no_limit():
    """A family of numbers that leads elsewhere does not tend."""
    small, large = Chain(1), Chain(2)
    first = next(family for one, two, family in limits([small, large]) if two == large)
    values = values_of(small, Random(3))
    assert tends(first, large, small, values, {}, {})
    assert not tends(replace(first, small=(), large=()), large, small, values, {}, {})
