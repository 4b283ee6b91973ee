"""A known damper to the ground, and a kind of change that only the table knows."""

import json
from itertools import combinations, product
from random import Random

import pytest

from disting import Experiment, Family, Query, View, compare, compare_everywhere
from disting.experiments.equal_machines import same_by_rows
from disting.experiments.experiment import MeasuredChain
from disting.experiments.machine_model import MachineModel
from disting.experiments.maps import _by_mass
from disting.model.kinds import BRAKE, INERTIA, KINDS
from disting.verdict.verdict_file import verdict_file
from disting.verdict.verification import Status, verify
from tests.experiments.plain_stack import has_equivalent, keywords

COMPLEX = Query(View.EXACT, inclusion=False)
AS_IT_IS = Experiment()
TOLD = [(8, 11, 1, 2), (8, 11, 3, 3), (9, 10, 1, 1), (9, 10, 2, 2), (9, 10, 3, 3)]
U, A = Family(3, damped=False), Family(3, damped=True)


def agrees_with_groebner_bases(left, right, pair):
    """The verdict beside one fibre each way, by matrices and bases of other code."""
    found = compare(left, right, experiments=[AS_IT_IS, pair], query=COMPLEX)
    ways = []
    for one, other, (here, there) in ((left, right, pair), (right, left, pair[::-1])):
        point = {name: 1009 * (i + 2) + 7**i for i, name in enumerate(one.parameters)}
        asked = [[{}, keywords(e)] for e in (here, there)]
        ways.append(has_equivalent((one, asked[0]), point, (other, asked[1])))
    assert found.relation.value == ("indistinguishable" if all(ways) else "distinguishable")


@pytest.mark.sampled(3)
@pytest.mark.full
@pytest.mark.parametrize(
    ("left", "right", "i", "j"),
    [(1, 1, 1, 3), (1, 1, 2, 2), (1, 11, 1, 1), (8, 11, 3, 3), (2, 5, 1, 3), (9, 10, 2, 3)],
)
def test_a_brake_at_two_places(left, right, i, j):
    pair = Experiment(brakes={i: "0.5"}), Experiment(brakes={j: "0.5"})
    agrees_with_groebner_bases(U[left], U[right], pair)


def random_pairs(count, seed):
    """Two chains of 2 or 3 undamped masses, each with a brake, and another change or port."""
    draw = Random(seed)
    for _ in range(count):
        n = draw.choice((2, 2, 3))
        family, size = list(Family(n, damped=False)), draw.choice(("1/2", "3"))
        more = draw.choice([{}, {}, "sensor", "force", "locked", "springs", "inertias", "brakes"])
        sides = []
        for _ in range(2):
            asked = {"brakes": {draw.randint(1, n): size}}
            at = draw.randint(1, n)
            if more in ("springs", "inertias"):
                asked[more] = {at: 2}
            elif more == "brakes":
                asked[more] |= {at: 5}
            elif more:
                asked[more] = at
            sides.append(Experiment(**asked))
        yield draw.choice(family), draw.choice(family), tuple(sides)


@pytest.mark.full
@pytest.mark.sampled(4)
@pytest.mark.parametrize("case", list(random_pairs(12, "brakes")), ids=str)
def test_random_brakes(case):
    agrees_with_groebner_bases(*case)


@pytest.mark.slow
@pytest.mark.parametrize("case", list(random_pairs(150, "more brakes")), ids=str)
def test_more_random_brakes(case):
    agrees_with_groebner_bases(*case)


@pytest.mark.full
def test_the_brake_of_one_mass_alone_is_no_brake_of_another():
    """What was given up in silence was proven: the same chain at two places of the brake."""
    found = compare_everywhere("3:1", "3:1", ["brake=1/3:0.5"])
    assert found.answer.value == "surely"
    same = compare_everywhere("3:1", "3:1", ["brake=1/1:0.5"])
    assert same.answer.value == "never"


@pytest.mark.full
def test_two_sizes_are_two_experiments():
    pair = Experiment(brakes={1: "0.5"}), Experiment(brakes={1: "0.6"})
    found = compare(A[2], A[2], experiments=[AS_IT_IS, pair], query=COMPLEX)
    assert found.relation.value == "distinguishable"


def test_a_brake_adds_no_inertia():
    """The map in 1/m is that of what adds to a mass; rows speak of any change, each of its own."""

    def under(kind, at):
        change = Experiment(**{kind.argument: {at: 1}})
        return MeasuredChain(A[2], (AS_IT_IS, change))

    for i, j in product((1, 2, 3), repeat=2):
        assert _by_mass(under(BRAKE, i), under(BRAKE, j)) is None
        assert not same_by_rows(under(BRAKE, i), under(INERTIA, j))
    assert _by_mass(under(INERTIA, 1), under(INERTIA, 1)) is not None


@pytest.mark.sampled(1)
@pytest.mark.full
@pytest.mark.parametrize("argument", ["brakes", "springs"])
def test_rows_that_show_the_same_have_equivalents(argument):
    """Whatever is added where force and sensor of a row are, or in a row that both share."""
    told = []
    for a, b in combinations((8, 9, 10, 11), 2):
        for i, j in product((1, 2, 3), repeat=2):
            pair = Experiment(**{argument: {i: 2}}), Experiment(**{argument: {j: 2}})
            sides = zip((U[a], U[b]), pair, strict=True)
            if same_by_rows(*(MeasuredChain(chain, (AS_IT_IS, e)) for chain, e in sides)):
                told.append((a, b, i, j))
                agrees_with_groebner_bases(U[a], U[b], pair)
    assert told == TOLD


def test_what_is_added_to_one_mass_counts_in_the_bound():
    """A row sums 6 terms and one for each that is added; 9 are more than 2^3."""
    sizes = [
        {"inertias": {1: 1}, "springs": {1: 1}},
        {"inertias": {1: 1}, "springs": {1: 1}, "brakes": {2: 1}},
        {"inertias": {1: 1}, "springs": {1: 1}, "brakes": {1: 1}},
    ]
    measured = [MeasuredChain(A[1], (Experiment(**given),)) for given in sizes]
    two, apart, three = (MachineModel(m).minor_size(None).bits for m in measured)
    assert two == apart < three


@pytest.fixture(scope="module")
def stored():
    pair = Experiment(brakes={1: "0.5"}), Experiment(brakes={3: "0.5"})
    return json.loads(json.dumps(verdict_file("3:1", "3:1", experiments=[AS_IT_IS, pair])))


@pytest.mark.full
def test_a_stored_verdict_has_its_brakes(stored):
    assert stored["experiments"][1]["left"]["brakes"] == [[1, "1/2"]]
    assert "brakes" not in stored["experiments"][0]["left"]  # as files had it before there were any
    assert verify(stored).status is Status.HOLDS


@pytest.mark.parametrize("brakes", [[[2, "1/2"]], [[3, "1/2"]], []])
def test_a_brake_elsewhere_is_another_verdict(stored, brakes):
    other = json.loads(json.dumps(stored))
    other["experiments"][1]["left"]["brakes"] = brakes
    assert verify(other).status is Status.FAILS


def test_every_kind_says_itself_in_full():
    for kind in KINDS:
        assert kind.name and kind.argument and kind.item and kind.anywhere and kind.title
        assert kind.is_port or kind.text
        assert bool(kind.sign) == kind.takes_size
