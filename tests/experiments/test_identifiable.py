"""Identifiability under several experiments, beside plain SymPy: ranks of exact derivatives of all
responses at random rational points, and fibres by a Gröbner basis.
"""

from random import Random

import pytest
from sympy import Rational

from disting import Chain, Engine, Experiment, Family, InputError, Level, Store, identifiability
from disting.behaviour.profile import profile
from disting.behaviour.sample import Representation
from disting.experiments.experiment import MeasuredChain
from disting.experiments.identifiable import IDENTIFIABLE, identifiability_under
from disting.experiments.machine_model import MachineModel
from disting.model.kinds import KINDS
from disting.model.question import Settings
from tests.experiments.plain_stack import determined, has_other

SIZE = "3/2"  # of an added inertia
AS_IT_IS = {}


def cases(*sizes):
    return [
        (chain, kind, i)
        for n, damped in sizes
        for chain in Family(n, damped)
        for kind in KINDS
        if n > 1 or not kind.holds
        for i in range(1, n + 1)
    ]


def further(kind, i):
    """The same experiment for the package and for the twin."""
    at = {i: SIZE} if kind.takes_size else i
    plain = at if kind.takes_size else (i, 0) if kind.is_port else (i,)
    return Experiment(**{kind.argument: at}), {kind.argument: plain}


def point_of(chain, seed):
    draw = Random(seed)
    return {n: Rational(draw.randint(2, 99), draw.randint(2, 99)) for n in chain.parameters}


def check_ranks(chain, kind, i):
    given, plain = further(kind, i)
    found = identifiability(chain, experiments=[Experiment(), given])
    rank, seen = determined(chain, point_of(chain, f"{chain}{kind.name}{i}"), [AS_IT_IS, plain])
    assert found.rank == rank and found.freedom == len(chain.parameters) - rank
    assert [n for n, level in found.levels.items() if level is not Level.NOT] == seen
    assert Level.UNKNOWN not in found.levels.values()


def check_values(chain, kind, i):
    given, plain = further(kind, i)
    found = identifiability(chain, experiments=[Experiment(), given])
    draw = Random(f"values {chain}{kind.name}{i}")
    point = {name: draw.randint(2, 10**8) for name in chain.parameters}
    for name, level in found.levels.items():
        if level is not Level.NOT:
            other = has_other(chain, point, [AS_IT_IS, plain], name)
            assert level is (Level.LOCAL if other else Level.GLOBAL), name


TWO, THREE = cases((2, False), (2, True)), cases((3, False), (3, True))


def test_there_are_468_cases():
    assert (len(TWO), len(THREE)) == (72, 396)


@pytest.mark.full
@pytest.mark.sampled(13)
@pytest.mark.parametrize(("chain", "kind", "i"), [*TWO[::3], *THREE[::24]])
def test_ranks(chain, kind, i):
    check_ranks(chain, kind, i)


@pytest.mark.slow
@pytest.mark.parametrize(("chain", "kind", "i"), [*TWO, *THREE])
def test_all_ranks(chain, kind, i):
    check_ranks(chain, kind, i)


@pytest.mark.sampled(6)
@pytest.mark.full
@pytest.mark.parametrize(("chain", "kind", "i"), TWO[::6])
def test_whether_other_values_fit(chain, kind, i):
    check_values(chain, kind, i)


@pytest.mark.slow
@pytest.mark.parametrize(("chain", "kind", "i"), [*TWO, *THREE[:198:4]])
def test_whether_other_values_fit_for_more(chain, kind, i):
    check_values(chain, kind, i)


@pytest.mark.full
def test_one_experiment_is_what_is_known_of_the_chain_alone():
    for chain in [*Family(3, damped=False), *list(Family(3, damped=True))[2::4]]:
        alone, under = (identifiability(chain, experiments=e) for e in ((), [Experiment()]))
        assert (alone.rank, alone.freedom, alone.levels) == (
            under.rank,
            under.freedom,
            under.levels,
        )


@pytest.mark.full
def test_a_mirror_image_that_all_experiments_show_keeps_two_sets():
    """Force at one end, sensor at the other: exchanging the ends is seen by no second response of
    the mass between them, and by one of an end.
    """
    chain = Chain(3, act_plus=1, meas_plus=3, damped=False)
    middle = identifiability(chain, experiments=[Experiment(), Experiment(inertias={2: SIZE})])
    assert middle.named(Level.GLOBAL) == ("m2",)
    assert middle.named(Level.EXCHANGES) == ("m1", "m3", "k12", "k23")
    assert (middle.least, middle.most) == (2, 2)
    end = identifiability(chain, experiments=[Experiment(), Experiment(inertias={1: SIZE})])
    assert end.level is Level.GLOBAL and (end.least, end.most) == (1, 1)


@pytest.mark.full
def test_more_experiments_never_determine_less():
    chain = Family(3, damped=True)[7]
    one, two = Experiment(), Experiment(sensor=2)
    ranks = [identifiability(chain, experiments=e).rank for e in ([one], [one, two])]
    assert ranks == [6, 7]


def test_dead_time_and_lag():
    chain = Chain(2, meas_plus=2, lag=True, dead_time=True, damped=False)
    found = identifiability(chain, experiments=[Experiment(), Experiment(sensor=1)])
    assert set(found.levels.values()) == {Level.GLOBAL}
    alone = identifiability(chain, experiments=[Experiment()])
    assert alone.named(Level.GLOBAL) == ("T1", "Td") and alone.freedom == 1


def test_where_no_sensor_moves_nothing_is_determined():
    chain = Family(3, damped=False)[1]
    found = identifiability(chain, experiments=[Experiment(locked=1)])
    assert (found.rank, found.freedom, found.most) == (0, 5, None)
    assert set(found.levels.values()) == {Level.NOT} and "no sensor moves" in found.sentence


@pytest.mark.full
def test_the_order_of_experiments_says_nothing():
    chain = Family(3, damped=False)[5]
    several = [Experiment(), Experiment(sensor=1), Experiment(locked=1)]
    found = [identifiability(chain, experiments=e).levels for e in (several, several[::-1])]
    assert found[0] == found[1]


@pytest.mark.full
def test_it_agrees_with_the_profile_that_verdicts_rest_on():
    for chain in list(Family(3, damped=False))[:4]:
        measured = MeasuredChain(chain, (Experiment(), Experiment(locked=3)))
        found = identifiability_under(measured, Settings())
        assert found.rank == profile(MachineModel(measured), Representation.TF, 0, Settings()).rank


def test_it_is_kept_and_read_back(tmp_path):
    chain, experiments = Family(3, damped=False)[3], [Experiment(), Experiment(sensor=2)]
    with Store.open(tmp_path / "a.sqlite3") as store:
        found = identifiability(chain, experiments=experiments, engine=Engine(store=store))
        again = identifiability(chain, experiments=experiments, engine=Engine(store=store))
    assert found == again == IDENTIFIABLE.decode(IDENTIFIABLE.encode(found))
    with pytest.raises(TypeError, match="levels"):
        bool(found)


@pytest.mark.parametrize(
    ("model", "experiments", "said"),
    [
        (3, [], "identifiability takes a chain"),
        (Family(3, damped=False)[1], [Experiment(sensor=4)], "no mass 4"),
        (Family(3, damped=False)[1], ["sensor=2"], "such as Experiment"),
        (Family(3, damped=False)[1], [(Experiment(), Experiment())], "on one model"),
        (Family(2, damped=False)[1], [Experiment(locked=(1, 2))], "all masses are locked"),
    ],
)
def test_bad_input(model, experiments, said):
    with pytest.raises(InputError, match=said):
        identifiability(model, experiments=experiments)
