"""Gears are a change of units: machines with and without them, in values and in verdicts."""

import json
import random
from fractions import Fraction
from itertools import product

import pytest
from hypothesis import assume, given, strategies as st

from disting import Query, View, compare, verdict_file
from disting.cli.run import main
from disting.errors import InputError
from disting.general.alternatives import alternatives
from disting.general.any_model import of_network
from disting.general.behaviour import GeneralModel
from disting.network import Network, Port
from disting.network.gears import units, unknown_ratios, without_gears
from disting.network.network import Element
from disting.network.notation import network_of
from disting.network.simplest import simplest
from disting.verdict.result import Relation
from disting.verdict.verification import Status, verify

P = 2**61 - 1
RATIOS = st.sampled_from(["", "g", "h", "3", "2/3", "5/2"])


@st.composite
def trees(draw):
    """Masses in a tree with gears, some on a spring to the ground, and a loop without gears."""
    count = draw(st.integers(2, 4))
    elements = [Element(f"m{i}", "m", (i,)) for i in range(1, count + 1)]
    for i in range(2, count + 1):
        near, letter, ratio = (
            draw(st.integers(1, i - 1)),
            draw(st.sampled_from("kdj")),
            draw(RATIOS),
        )
        elements.append(Element(f"{letter}{i}", letter, (near, i), ratio))
    if draw(st.booleans()):
        elements.append(Element("k9", "k", (draw(st.integers(1, count)), 0)))
    force, sensor = (Port(draw(st.integers(1, count))) for _ in "fs")
    return Network(tuple(elements), (force,), (sensor,))


def response(network, values):
    """The transfer function at values modulo P."""
    try:
        model = GeneralModel(of_network(network))
    except InputError:
        assume(False)
    found = model.quotients([values[name] for name in model.parameters], P)[0]
    return found and (found.num, found.den)


@pytest.mark.full
@given(trees(), st.integers(0, 10**6))
def test_values_in_other_units_give_the_same(network, seed) -> None:
    draw = random.Random(seed)
    values = {name: draw.randrange(1, P) for name in network.parameters}
    plain = without_gears(network)
    assert plain is not None and not any(e.ratio for e in plain.elements)
    others = dict(values)
    for name, (number, powers) in units(network).items():
        unit = number.numerator * pow(number.denominator, -1, P)
        for ratio, k in zip(unknown_ratios(network), powers, strict=True):
            unit = unit * pow(values[ratio], k, P) % P
        others[name] = values[name] * unit % P
    assert response(network, values) == response(plain, others)


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("1=2*3, 2=3, 3=1; F1; S3", "a loop whose ratios do not agree"),
        ("1=2*i, 2=3*j, 3=1*i; F1; S3", "a loop of unknown ratios"),
        ("1=2*3; F1; S1; S2", "two sensors in other units"),
        ("1=2*3; F1:2; S1", "a force between two masses that the gear keeps apart"),
    ],
)
def test_gears_that_are_no_units(text, why) -> None:
    network = network_of(text)
    assert without_gears(network) is None
    assert simplest(network) is None


def test_a_part_that_only_the_casing_of_its_gear_holds() -> None:
    """Without the gear it would hang on nothing."""
    elements = Element("j0", "j", (1, 3), "g"), Element("j1", "j", (2, 0))
    network = Network(elements, (Port(2),), (Port(2),), order=0)
    assert without_gears(network) is None
    assert compare(network, network).relation is Relation.INDISTINGUISHABLE


def test_two_sensors_in_the_same_units() -> None:
    network = network_of("1=2*3, 1=3*3; F1; S2; S3")
    assert without_gears(network) is not None
    assert units(network)["m2"] == (Fraction(1, 3), ())


SAME = [
    ("1=2*5/2=3; F1; S3", "1=2=3; F1; S3"),
    ("1=2*i=3; F1; S3", "1=2=3*7; F3; S1"),
    ("1=2*5/2=3=4=5=6=7=8; F1; S8", "1=2=3=4=5*3=6=7=8; F1; S8"),  # written out they take minutes
]


@pytest.mark.full
@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    ("pair", "view"), list(product(SAME, [View.EXACT, View.REAL, View.POSITIVE]))
)
def test_machines_that_are_the_same_but_for_gears(pair, view) -> None:
    query = Query(view, inclusion=False)
    found = compare(*map(network_of, pair), query=query)
    assert found.relation is Relation.INDISTINGUISHABLE
    assert (found.evidence.name, found.certainty) == ("gears", "theorem")
    assert not found.has_exceptions
    told = verify(json.loads(json.dumps(verdict_file(*map(network_of, pair), query=query))))
    assert told.status is Status.HOLDS, told


@pytest.mark.full
def test_parts_are_replaced_behind_gears_too() -> None:
    left, right = (network_of(t) for t in ("1~2*i, 1~3; F1; S1", "1~2~3; F1; S1"))
    found = compare(left, right, query=Query(View.POSITIVE, inclusion=False))
    assert found.relation is Relation.INDISTINGUISHABLE and found.evidence.name == "replacement"


def test_other_machines_with_gears_are_told_apart() -> None:
    left, right = (network_of(t) for t in ("1=2*5/2=3; F1; S3", "1=2*5/2=3; F1; S2"))
    assert compare(left, right).relation is Relation.DISTINGUISHABLE
    turned = Network(left.elements, left.inputs, left.outputs, order=0)  # a position sensor
    assert compare(left, turned).relation is Relation.DISTINGUISHABLE


@pytest.mark.full
def test_formulas_say_the_units(capsys) -> None:
    assert main(["equivalents", SAME[1][0], "--to", SAME[1][1], "--formulas"]) == 0
    said = capsys.readouterr().out
    assert "identity checked" in said and "m2'" in said
    assert main(["equivalents", SAME[0][0], "--to", SAME[0][1], "--formulas"]) == 0
    assert "m1'  = 5*m1/2\nm2'  = 2*m2/5\n" in capsys.readouterr().out


def test_values_in_other_units_come_first_where_there_are_others(capsys) -> None:
    """2 m1' = 5 m1, 5 m2' = 2 m2, 2 k12' = 5 k12, among infinitely many sets."""
    pair = ["1~2*5/2; F1; S2", "--to", "1~2; F1; S2"]
    assert main(["equivalents", *pair, "--set", "m1=1,m2=2,k12=4"]) == 0
    listed = capsys.readouterr().out.splitlines()[2:]
    assert listed[0] == "  k12 = 10, m1 = 5/2, m2 = 4/5"
    assert listed[-1] == "  and infinitely many more" and len(set(listed)) == len(listed) > 3


def test_sets_that_do_not_give_the_function_do_not_come_first() -> None:
    one, two = (of_network(network_of(t)) for t in ("1~2*5/2; F1; S2", "1~2; F1; S2"))
    plain = [{"k12": 10, "m1": m1, "m2": "4/5"} for m1 in (2, "5/2")]
    found = alternatives(one, {"m1": 1, "m2": 2, "k12": 4}, two, plain=plain)
    assert str(found.equivalents[0]) == "k12 = 10, m1 = 5/2, m2 = 4/5"
    assert not any(x.values["m1"] == 2 for x in found.equivalents)


@pytest.mark.parametrize("joint", ["1=#*i", "1~#*3", "1-#*i", "#-1*2"])
def test_a_ratio_to_the_ground_is_refused(joint) -> None:
    """A damper to the ground lost it without a word."""
    with pytest.raises(InputError, match="two nodes other than the ground"):
        network_of(f"{joint}, 1=2; F1; S1")
