"""What to measure next, against what Gröbner bases modulo a prime said by other code, and laws."""

import csv
import io
import json
from itertools import combinations, product

import pytest
from sympy import Rational

from disting import Experiment, Family, Query, View, compare
from disting.behaviour.profile import profile
from disting.behaviour.sample import Representation
from disting.catalogs.next_files import next_catalog
from disting.cli.run import main
from disting.errors import InputError
from disting.experiments.machine_model import MachineModel
from disting.experiments.menu import Costs, Gain, Item, gain, measure_with
from disting.model.kinds import FORCE, INERTIA, KINDS, LOCK, SENSOR
from disting.model.names import chain_of
from disting.verdict.engine import Engine
from disting.verdict.next_experiments import Menu, menu_for
from disting.verdict.next_words import conclusion, rows
from disting.verdict.placement_verdicts import Answer
from disting.verdict.result import Relation
from tests.experiments.plain_stack import has_equivalent
from tests.experiments.test_truth import SAME

A = Family(3, damped=True)
TABLE = dict(zip(("sensor", "locked", "inertia"), (SENSOR, LOCK, INERTIA), strict=True))
EXACT = Query(View.EXACT)
EVERY = Costs.read("spring=2,brake=2")


@pytest.fixture(scope="module")
def engine():
    return Engine()


def named(family, *numbers):
    return [(f"{family.n_masses}:{m}", family[m]) for m in numbers]


@pytest.mark.full
@pytest.mark.parametrize("pair", SAME)
def test_the_truth_as_told_by_next(pair, engine):
    found = menu_for(named(A, *pair), engine)
    for kind, same in zip(TABLE.values(), SAME[pair], strict=True):
        left = {
            f"{i}/{j}"
            for i, j in product((1, 2, 3), repeat=2)
            if found.tables[kind].look_up((0, i), (1, j))[0] is Relation.INDISTINGUISHABLE
        }
        assert left == set(same.split())
        assert not found.tables[kind].decided.open


@pytest.mark.full
def test_any_second_sensor_settles_the_dual_pair(engine):
    found = menu_for(named(A, 1, 11), engine)
    assert all(found.anywhere(kind) for kind in Costs().kinds(3))
    assert {item.kind for option in found.least(0) for item in option.items} == {
        SENSOR,
        FORCE,
    }


@pytest.mark.full
def test_the_group_of_five_undamped(engine):
    group = (1, 4, 6, 8, 11)
    found = menu_for(named(Family(3, damped=False), *group), engine)
    left = {
        kind: {
            (group[a], i, group[b], j)
            for a, b in product(range(5), repeat=2)
            for i, j in product((1, 2, 3), repeat=2)
            if a < b
            and found.tables[kind].look_up((a, i), (b, j))[0] is not Relation.DISTINGUISHABLE
        }
        for kind in Costs().kinds(3)
    }
    both = {(1, 1, 4, 2), (8, 1, 11, 2), (8, 3, 11, 3)}
    assert left[SENSOR] == left[FORCE] == left[INERTIA] == both
    assert left[LOCK] == both | {(8, 2, 11, 1)}
    assert [found.whole(3, Item(SENSOR, i)) for i in (1, 2, 3)] == [
        Answer.DEPENDS,
        Answer.SURELY,
        Answer.DEPENDS,
    ]


@pytest.mark.sampled(4)
@pytest.mark.full
@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.name)
def test_tables_say_what_compare_says(kind, engine):
    """Every pair of places of a group, one by one, without classes and buckets."""
    family, group = Family(3, damped=False), (8, 11)
    found = menu_for(named(family, *group), engine, costs=EVERY)
    for i, j in product((1, 2, 3), repeat=2):
        pairs = [tuple(Item(kind, at).experiment for at in (i, j))]
        chains = (family[m] for m in group)
        said = compare(*chains, experiments=[Experiment(), *pairs], query=EXACT)
        assert found.tables[kind].look_up((0, i), (1, j))[0] is said.relation


@pytest.mark.full
@pytest.mark.parametrize(("number", "damped"), list(product(range(1, 12), (False, True))))
def test_what_repeats_tells_nothing_and_what_is_new_does(number, damped):
    """A structure against itself: the experiment at a place that gains nothing leaves as many
    determinable parameters.
    """
    chain, settings = Family(3, damped)[number], Engine().settings
    as_it_is = profile(MachineModel(measure_with(chain)), Representation.TF, 0, settings).rank
    for kind, at in product(KINDS, (1, 2, 3)):
        known = gain(chain, Item(kind, at))
        assert known is not None
        if known is not Gain.NEW:
            more = profile(
                MachineModel(measure_with(chain, Item(kind, at))), Representation.TF, 0, settings
            )
            assert more.rank == as_it_is


def test_the_force_moved_is_the_sensor_moved_where_both_are_at_one_place():
    assert measure_with(A[1], Item(FORCE, 2)) == measure_with(A[1], Item(SENSOR, 2))
    assert measure_with(A[2], Item(FORCE, 2)) != measure_with(A[2], Item(SENSOR, 2))


@pytest.mark.full
def test_two_together_at_one_mass_are_at_one_mass_of_the_other(engine):
    """Sensor at 2 leaves mass 1 of the other, inertia at 2 leaves mass 2: together nothing is."""
    found = menu_for(named(A, 9, 10), engine)
    items = Item(SENSOR, 2), Item(INERTIA, 2)
    assert [found.option(0, (item,)).left for item in items] == [(1,), (1,)]
    assert found.option(0, items).left == ()
    for j in (1, 2, 3):
        pairs = [(item.experiment, Item(item.kind, j).experiment) for item in items]
        said = compare(A[9], A[10], experiments=[Experiment(), *pairs], query=EXACT)
        assert said.relation is Relation.DISTINGUISHABLE


@pytest.mark.full
def test_nothing_on_a_menu_of_locks_and_inertias_is_enough_by_symmetry(engine):
    whole = menu_for(named(A, 2, 5), engine)
    tables = {k: whole.tables[k] for k in (LOCK, INERTIA)}
    found = Menu(whole.names, whole.structures, tables)
    assert found.least(0) == found.least(1) == ()
    assert "by symmetry" in conclusion(found, 0)
    mirrored = {1: 3, 2: 2, 3: 1}
    pairs = [
        (Item(k, i).experiment, Item(k, mirrored[i]).experiment) for k in tables for i in mirrored
    ]
    said = compare(A[2], A[5], experiments=[Experiment(), *pairs], query=EXACT)
    assert said.relation is Relation.INDISTINGUISHABLE


@pytest.mark.full
def test_costs_change_what_is_least(engine):
    found = menu_for(named(A, 1, 11), engine, costs=Costs.read("sensor=5,move=4,lock=0.5"))
    assert found.kinds == (LOCK, INERTIA, SENSOR, FORCE)
    assert {o.cost for o in found.least(0)} == {0.5}


@pytest.mark.parametrize("text", ["sensor", "screw=1", "lock=0", "lock=-1", "lock=nan", "lock=x"])
def test_bad_costs(text):
    with pytest.raises(InputError):
        Costs.read(text)


def test_a_single_mass_is_not_locked():
    assert LOCK not in Costs().kinds(1)


@pytest.mark.full
def test_rows_are_all_pairs_of_places(engine):
    found = menu_for(named(A, 2, 5), engine)
    assert len(list(rows(found))) == 4 * 9


def test_command(capsys, monkeypatch):
    monkeypatch.setenv("DISTING_CACHE", "off")
    assert main(["next", "3:5", "3:2", "--damped", "--csv", "-"]) == 0
    table = list(csv.DictReader(io.StringIO(capsys.readouterr().out)))
    same = {
        (r["at_left"], r["at_right"])
        for r in table
        if (r["experiment"], r["relation"]) == ("inertia", "indistinguishable")
    }
    assert same == {("3", "1"), ("2", "2"), ("1", "3")}
    assert main(["next", "3:2", "--damped", "--json", "-"]) == 0
    plain = json.loads(capsys.readouterr().out)
    assert plain["structures"] == ["3:2", "3:5"] and plain["anywhere"] == ["sensor", "force"]


DAMPERS = [
    (names, kind, i, j)
    for names in (("3:1+b1", "3:4+b2"), ("3:8+b1", "3:11+b2"))
    for kind in (SENSOR, LOCK)
    for i, j in product((1, 2, 3), repeat=2)
]


def agrees_with_other_code(names, kind, i, j):
    """Tables of structures with dampers to the ground, against one fibre by plain SymPy."""
    chains = [chain_of(name, Family(3, damped=False)) for name in names]
    stored = next_catalog(3, dampers=True, damped=False)
    numbers = [
        stored.number(int(name[2:].split("+")[0]), chain.ground_dampers)
        for name, chain in zip(names, chains, strict=True)
    ]
    said = stored.further(numbers).tables[kind].look_up((0, i), (1, j))[0]
    further = [{"sensor": (at, 0)} if kind == SENSOR else {"locked": (at,)} for at in (i, j)]
    point = {p: Rational(11 + 3 * k * k, 7 + 2 * k) for k, p in enumerate(chains[0].parameters)}
    sides = [(chain, [{}, one]) for chain, one in zip(chains, further, strict=True)]
    same = has_equivalent(sides[0], point, sides[1])
    return same is (said is Relation.INDISTINGUISHABLE)


@pytest.mark.sampled(4)
@pytest.mark.full
@pytest.mark.parametrize("case", DAMPERS[1::5], ids=str)
def test_truth_with_dampers_to_the_ground(case):
    assert agrees_with_other_code(*case)


@pytest.mark.slow
@pytest.mark.parametrize("case", DAMPERS, ids=str)
def test_all_truth_with_dampers_to_the_ground(case):
    assert agrees_with_other_code(*case)


def test_command_with_dampers_to_the_ground(capsys, monkeypatch):
    """3:4 is 3:4 mirrored, and so are its dampers."""
    monkeypatch.setenv("DISTING_CACHE", "off")
    assert main(["next", "3:4+b3", "--damped", "--json", "-"]) == 0
    plain = json.loads(capsys.readouterr().out)
    assert plain["structures"] == ["3:4+b3", "3:4+b1"]
    same = {
        (r["at_left"], r["at_right"])
        for r in plain["pairs"]
        if (r["experiment"], r["relation"]) == ("inertia", "indistinguishable")
    }
    assert same == {("1", "3"), ("2", "2"), ("3", "1")}


@pytest.mark.parametrize(
    ("arguments", "status", "says"),
    [
        (["3:1", "3:4"], 0, "distinguishable by the present measurement already"),
        (["3:3"], 0, "distinguishable from all other structures"),
        (["3:1", "4:1"], 2, "different numbers of masses"),
        (["7:1"], 2, "name all structures"),
        (["3:2+lag"], 2, "name all structures"),
        (["3:1+b1"], 0, "distinguishable from all other structures"),
        (["3:4+b1+b3", "3:4+b3+b1"], 2, "are the same structure"),
        (["3:1", "--cost", "gold=1"], 2, "costs are those of"),
    ],
)
def test_nothing_to_do_and_bad_input(arguments, status, says, capsys, monkeypatch):
    monkeypatch.setenv("DISTING_CACHE", "off")
    assert main(["next", *arguments, "--damped"]) == status
    said = capsys.readouterr()
    assert says in said.out + said.err


@pytest.mark.full
def test_an_inertia_whose_effect_is_foretold_excludes_where_another_one_is(engine):
    """A1 carries force and sensor at mass 1: G/(1 + J s^2 R) there, which no A11 shows."""
    found = menu_for(named(A, 1, 11), engine)
    item = Item(INERTIA, 1)
    assert found.tables[INERTIA].gain((0, 1)) is Gain.REPEATS
    assert item in set(found.items(0)) and found.whole(0, item) is Answer.SURELY
    for j in (1, 2, 3):
        pairs = [(item.experiment, Item(INERTIA, j).experiment)]
        said = compare(A[1], A[11], experiments=[Experiment(), *pairs], query=EXACT)
        assert said.relation is Relation.DISTINGUISHABLE


@pytest.mark.full
@pytest.mark.parametrize("damped", [False, True])
def test_what_is_said_of_any_mass_holds_of_every_mass(damped, engine):
    """Two structures whose effects are both foretold are alike there: no "any mass" then."""
    for group in next_catalog(3, damped=damped).groups:
        found = menu_for(named(Family(3, damped), *group), engine)
        table = found.tables[INERTIA]
        every = [
            table.look_up((a, i), (b, j))[0]
            for a, b in combinations(range(len(group)), 2)
            for i, j in product((1, 2, 3), repeat=2)
        ]
        assert found.anywhere(INERTIA) == (set(every) == {Relation.DISTINGUISHABLE})
