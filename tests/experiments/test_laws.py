"""Laws of verdicts under experiments, on random chains and experiments."""

from dataclasses import replace
from itertools import pairwise

import pytest
from hypothesis import HealthCheck, assume, given, settings, strategies as st

from disting import Chain, Engine, Experiment, Family, Model, Query, View, compare
from disting.behaviour.chain_model import ChainModel
from disting.behaviour.profile import profile
from disting.behaviour.sample import Representation
from disting.experiments.experiment import MeasuredChain
from disting.experiments.machine_model import MachineModel
from disting.model.question import Settings
from tests.experiments.plain_stack import S, has_equivalent, keywords, transfer
from tests.laws.strategies import chains

ENGINE = Engine()
COMPLEX = Query(View.EXACT, inclusion=False)
few = settings(max_examples=15, deadline=None, suppress_health_check=[HealthCheck.filter_too_much])
SIZED = ("inertias", "springs", "brakes")
SMALL = [c for n in (2, 3) for damped in (False, True) for c in Family(n, damped)]


def relation(left, right, experiments):
    found = compare(left, right, experiments=experiments, query=COMPLEX, engine=ENGINE)
    return found.relation.value


@st.composite
def experiments(draw, n):
    """One that leaves the ports of the chain alone or moves one of them, on n masses."""
    at = st.integers(1, n)
    kind = draw(st.sampled_from(["sensor", "force", "locked", *SIZED]))
    number = st.sampled_from([1, "1/3"])
    return Experiment(**{kind: {draw(at): draw(number)} if kind in SIZED else draw(at)})


@st.composite
def pairs(draw, max_masses=3):
    """Two chains of one family, and three pairs of experiments, the first as they are."""
    n, damped = draw(st.integers(2, max_masses)), draw(st.booleans())
    family = list(Family(n, damped))
    left, right = draw(st.sampled_from(family)), draw(st.sampled_from(family))
    further = [(draw(experiments(n)), draw(experiments(n))) for _ in range(2)]
    return left, right, [(Experiment(), Experiment()), *further]


@pytest.mark.full
@few
@given(pairs())
def test_more_experiments_never_make_a_pair_indistinguishable(case):
    left, right, asked = case
    seen = [relation(left, right, asked[:k]) for k in (1, 2, 3)]
    for before, after in pairwise(seen):
        assert not (before == "distinguishable" and after == "indistinguishable")


@pytest.mark.full
@few
@given(pairs())
def test_the_order_of_experiments_and_of_sides_does_not_matter(case):
    left, right, asked = case
    wanted = relation(left, right, asked)
    assert relation(left, right, asked[::-1]) == wanted
    assert relation(right, left, [(b, a) for a, b in asked]) == wanted
    assert relation(left, right, [*asked, asked[-1]]) == wanted


@pytest.mark.full
@few
@given(pairs(max_masses=2))
def test_conditions_and_exact_decision_never_contradict_each_other(case):
    left, right, asked = case
    for some in (asked, asked[1:], asked[:2]):
        compare(left, right, experiments=some, query=COMPLEX, audit=True, engine=ENGINE)


@pytest.mark.full
@few
@given(st.data())
def test_a_single_experiment_is_the_verdict_of_today(data):
    left, right = data.draw(st.sampled_from(SMALL)), data.draw(st.sampled_from(SMALL))
    today = compare(left, right, query=COMPLEX, engine=ENGINE)
    measured = [MeasuredChain(c, (Experiment(),)) for c in (left, right)]
    sides = [ENGINE.measured_subject(f"{i}", m) for i, m in enumerate(measured)]
    assume(left.n_masses == right.n_masses)
    stacked = ENGINE.verdict(*sides, COMPLEX)
    assert stacked.relation == today.relation
    assert relation(left, right, [Experiment()]) == today.relation.value


@pytest.mark.full
@few
@given(chains(2, 4))
def test_a_single_experiment_has_the_profile_of_the_chain(chain):
    for r, count in ((Representation.TF, 0), (Representation.MARKOV, 6)):
        plain = profile(ChainModel(chain.structure), r, count, Settings())
        numbered = profile(
            MachineModel(MeasuredChain(chain, (Experiment(),))), r, count, Settings()
        )
        labels = tuple(x.removesuffix("[1]") for x in numbered.labels)
        zeros = frozenset(x.removesuffix("[1]") for x in numbered.proven_zeros)
        stacked = replace(numbered, labels=labels, proven_zeros=zeros)
        kept = {"safety": 0, "matroid": None}
        if plain.matroid != stacked.matroid:
            assert "subsets" in stacked.matroid.reason
        assert replace(stacked, **kept) == replace(plain, **kept)


@pytest.mark.full
@few
@given(chains(2, 4), st.data())
def test_force_and_sensor_can_be_exchanged(chain, data):
    chain = replace(chain, quantity="position")
    places = st.tuples(st.integers(1, chain.n_masses), st.integers(0, chain.n_masses))
    force, sensor = (data.draw(places.filter(lambda p: p[0] != p[1])) for _ in range(2))
    there, back = Experiment(force=force, sensor=sensor), Experiment(force=sensor, sensor=force)
    assert relation(chain, chain, [(there, back), Experiment()]) == "indistinguishable"


@pytest.mark.full
@few
@given(st.integers(2, 4), st.booleans(), st.data())
def test_a_locked_mass_cuts_the_chain(n, damped, data):
    """Mass 1 of a free row locked leaves a row that hangs on the ground by its first joint."""
    force, sensor = (data.draw(st.integers(2, n)) for _ in range(2))
    chain = Chain(n, damped=damped, quantity="position")
    locked = MeasuredChain(chain, (Experiment(force=force, sensor=sensor, locked=1),))
    found = profile(MachineModel(locked), Representation.TF, 0, Settings())
    hung = Chain(n, n - 1, n - 1, n, n - 1, n, damped=damped, quantity="position")
    ports = Experiment(force=force - 1, sensor=sensor - 1)
    plain = profile(MachineModel(MeasuredChain(hung, (ports,))), Representation.TF, 0, Settings())
    assert (found.degrees, found.form, found.rank) == (plain.degrees, plain.form, plain.rank)


@pytest.mark.full
@pytest.mark.parametrize("damped", [False, True])
def test_two_sensors_at_once_are_one_transfer_function(damped):
    """N1/D and N2/D as (N1 + s^K N2)/(D (s + 1)^(K + 2)): it hides nothing and loses nothing."""
    from sympy import Symbol

    family = Family(2, damped)

    def trick(chain, sensor):
        names = {name: Symbol(name) for name in chain.parameters}
        n1, den = transfer(chain, names)
        n2, other = transfer(chain, names, sensor=(sensor, 0))
        assert (den - other).expand() == 0
        return Model.from_transfer_function(
            (n1 + S**6 * n2).expand(), den * (S + 1) ** 8, name=f"{chain} with {sensor}"
        )

    for a, b, i, j in [(1, 3, 1, 2), (1, 3, 2, 2), (2, 3, 1, 1), (1, 2, 2, 1)]:
        trial = compare(trick(family[a], i), trick(family[b], j), query=COMPLEX)
        assert trial.relation.value != "undecided"
        ours = relation(
            family[a], family[b], [Experiment(), (Experiment(sensor=i), Experiment(sensor=j))]
        )
        assert ours == trial.relation.value


@pytest.mark.full
@settings(max_examples=8, deadline=None)
@given(st.data())
def test_fibres_by_groebner_bases_of_other_code(data):
    """At one random point modulo a prime, by SymPy; two masses."""
    agrees_with_groebner_bases(False, data)


@pytest.mark.slow
@settings(max_examples=20, deadline=None)
@given(st.data())
def test_damped_fibres_by_groebner_bases_of_other_code(data):
    agrees_with_groebner_bases(True, data)


def agrees_with_groebner_bases(damped, data):
    family = list(Family(2, damped))
    left, right = data.draw(st.sampled_from(family)), data.draw(st.sampled_from(family))
    further = data.draw(experiments(2)), data.draw(experiments(2))
    wanted = relation(left, right, [Experiment(), further])

    ways = []
    for one, other, pair in ((left, right, further), (right, left, further[::-1])):
        point = {name: 1009 * (i + 2) + 7**i for i, name in enumerate(one.parameters)}
        asked = [[{}, keywords(e)] for e in pair]
        ways.append(has_equivalent((one, asked[0]), point, (other, asked[1])))
    assert wanted == ("indistinguishable" if all(ways) else "distinguishable")
