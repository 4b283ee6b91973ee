"""What to measure next on networks: against what chains are told by another engine, and against
matrices that are written out.
"""

import json
from itertools import product

import pytest
import sympy
from hypothesis import given, settings, strategies as st

from disting import Chain, Family, View
from disting.catalogs import catalog
from disting.cli.run import main
from disting.errors import InputError
from disting.experiments.experiment import places_of
from disting.experiments.measured_network import further_model
from disting.experiments.menu import Costs, Gain
from disting.model.kinds import ALL_KINDS, CIRCUIT_KINDS, COMPARTMENT_KINDS, KINDS
from disting.network import network_of
from disting.network.chains import of_chain
from disting.verdict.engine import Engine
from disting.verdict.next_experiments import menu_for, next_experiments
from disting.verdict.next_words import rows
from disting.verdict.result import Relation

EVERY = Costs.read("spring=2,brake=2")
RANDLES = "R0-p(R1,C1)-p(R2,C2)", "R0-p(C1,R1-p(R2,C2))"


@pytest.fixture(scope="module")
def engine():
    return Engine()


GROUPS = [
    pytest.param(n, damped, numbers, marks=[pytest.mark.slow] * (n > 3))
    for n, damped in product((3, 4), (True, False))
    for numbers in catalog(n, damped=damped).classes(View.EXACT)
]


@pytest.mark.full
@pytest.mark.sampled(2)
@pytest.mark.parametrize(("n", "damped", "numbers"), GROUPS)
def test_chains_are_told_what_they_are_told_as_chains(n, damped, numbers, engine):
    family = Family(n, damped=damped)
    group = [family[m] for m in numbers]
    names = [f"{n}:{m}" for m in numbers]
    networks = [of_chain(chain, name) for name, chain in zip(names, group, strict=True)]
    chains = menu_for(list(zip(names, group, strict=True)), engine, costs=EVERY)
    found = menu_for(list(zip(names, networks, strict=True)), engine, costs=EVERY)
    assert set(found.tables) == set(chains.tables)
    compared = 0
    for kind, table in found.tables.items():
        spots = [(k, i) for k in range(len(numbers)) for i in range(1, n + 1)]
        for left, right in product(spots, repeat=2):
            if left[0] < right[0]:
                told = chains.tables[kind].look_up(left, right)[0]
                assert table.look_up(left, right)[0] is told, (kind, left, right)
                compared += told is not Relation.UNDECIDED
        for spot in spots:
            silent = chains.tables[kind].gain(spot) is Gain.SILENT
            assert (table.gain(spot) is Gain.SILENT) is silent
    assert compared
    for k in range(len(numbers)):
        assert found.least(k) == chains.least(k)


TEXTS = (
    "1=2, 2=3, 1~3; F1; S3",
    "1=2, 2=#; F1:2; S2",
    "1=2*i, 2~3; F1; S3",
    "1~2; F1; S1; S2",
    "R0-p(R1,C1)-p(R2,C2)",
    "p(R1,C1-W1)",
    "L1-p(R1,C1)",
    "1>2, 2>1, 2>0; in 1; out 2",
    "1>2, 2>3, 3>1, 3>0; in 1; out 3",
)
MENUS = {"machine": KINDS, "circuit": CIRCUIT_KINDS, "compartments": COMPARTMENT_KINDS}


@pytest.mark.full
@given(st.sampled_from(TEXTS), st.data())
@settings(deadline=None, max_examples=30)
def test_what_is_measured_against_a_matrix_that_is_written_out(text, data):
    network = network_of(text)
    kind = data.draw(st.sampled_from(MENUS[network.sort]))
    node = data.draw(st.sampled_from(places_of(network)))
    at = {p: sympy.Rational(data.draw(st.integers(1, 9)), 7) for p in network.parameters}
    root = sympy.Rational(data.draw(st.integers(2, 9)), 5)  # s^(1/2)
    shown = [x for row in further_model(network, kind, node, "n")[0].rows for x in row]
    values = [None if x is None else value(x, at, root) for x in shown]
    outputs, inputs = network.shape
    now = [x for row in by_hand(network, at, root) for x in row]
    assert values[: outputs * inputs] == [x or None for x in now]
    more = [x for row in by_hand(network, at, root, kind, node) for x in row]
    rest = values[outputs * inputs :]
    assert rest == [x or None for x in more] + [None] * (len(rest) - len(more))


def value(model, at, root):
    variable = root if model.powers.halves else root**2
    top, bottom = (
        sum(
            sympy.Integer(number)
            * sympy.prod(at[p] ** e for p, e in zip(model.parameters, powers, strict=True))
            * variable**n
            for n, terms in enumerate(side)
            for powers, number in terms
        )
        for side in (model.numerator_terms, model.denominator_terms)
    )
    return top / bottom


def by_hand(network, at, root, kind=None, node=0):
    """The matrix of a network at a point, with one thing done at a node."""
    nodes = sorted({i for e in network.elements for i in e.nodes} - {network.reference})
    place = {i: k for k, i in enumerate(nodes)}
    matrix = sympy.zeros(len(nodes))
    for e in network.elements:
        size = at[e.value] if e.value else 1
        term = (1 / size if e.letter in "RLW" else size) * root**e.kind.halves
        if e.letter == "a":
            first, second = e.nodes
            matrix[place[first], place[first]] += term
            if second in place:
                matrix[place[second], place[first]] -= term
            continue
        ratio = sympy.Integer(1) if not e.ratio else at.get(e.ratio) or sympy.Rational(e.ratio)
        feels = sympy.zeros(1, len(nodes))
        for i, x in zip(e.nodes, (1, -ratio), strict=False):
            if i in place:
                feels[place[i]] += x
        matrix += term * feels.T * feels
    here = place.get(node)
    if kind is not None and kind.power is not None:
        matrix[here, here] += root ** (2 * kind.power)
    if kind is not None and kind.holds:
        matrix[here, :] = sympy.eye(len(nodes))[here, :]
    forces, sensors = (
        [column(p, place) for p in ports] for ports in (network.inputs, network.outputs)
    )
    there = [column_of(place, {node: 1})]
    if kind is not None and kind.holds:
        forces = [f.copy() for f in forces]
        for f in forces:
            f[here] = 0
    if kind is not None and kind.is_port:
        sensors = sensors if kind.name == "force" else there
        forces = forces if kind.name == "sensor" else there
    moved = matrix.inv() * sympy.Matrix.hstack(*forces)
    return (root ** (2 * network.order) * sympy.Matrix.hstack(*sensors).T * moved).tolist()


def column(port, place):
    return column_of(place, {port.plus: 1, port.minus: -1})


def column_of(place, entries):
    found = sympy.zeros(len(place), 1)
    for i, x in entries.items():
        if i in place:
            found[place[i]] += x
    return found


@pytest.mark.full
def test_the_same_whatever_the_order_and_some_of_them_only(engine):
    texts = [*RANDLES, "R0-p(R1-p(R2,C2),C1)"]
    group = [(t, network_of(t)) for t in texts]
    whole = menu_for(group, engine)
    turned = menu_for(group[::-1], engine)
    for k, other in ((0, 2), (2, 0)):
        assert [o.items for o in whole.least(k)] == [o.items for o in turned.least(other)]
    some = whole.only([2, 0])
    alone = menu_for([group[2], group[0]], engine)
    assert list(rows(some)) == list(rows(alone))


@pytest.mark.full
def test_a_battery_is_told_apart_at_an_inner_node(capsys):
    assert main(["next", *RANDLES]) == 0
    shown = capsys.readouterr().out
    assert "sufficient: the voltage at node 3 measured (cost 1)" in shown
    assert "nothing moves" in shown
    assert "mass" not in shown and "force" not in shown and "sensor does" not in shown


@pytest.mark.full
def test_compartments_and_machines(capsys):
    assert main(["next", "1>2,2>1,2>0; in 1; out 1", "1>2,2>1,1>0; in 1; out 1"]) == 0
    assert "sufficient: the contents of compartment 2 measured" in capsys.readouterr().out
    assert main(["next", "1~2,2~3; F1; S1", "1~2,1~3; F1; S1", "--json", "-"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["anywhere"] == ["sensor", "force", "lock"]
    assert all("mass" in item for item in told["menu"])


@pytest.mark.slow
def test_networks_with_two_sensors_and_with_constant_phase_elements(capsys):
    assert main(["next", "1~2~3~4; F1; S1 S2", "1~2, 2~3, 2~4; F1; S1 S2"]) == 0
    told = capsys.readouterr().out
    assert "what separates all of them: a sensor at any further mass" in told
    assert main(["next", "R0-p(R1,P1)", "p(R0,R1-P2)"]) == 0
    assert "the voltage at any further node measured (cost 1)" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("texts", "sentence"),
    [
        (["R1-p(R2,C1)"], "one network"),
        (["1~2,2~3; F1; S1", "R1-p(R2,C1)"], "distinguishable by the present measurement already"),
    ],
)
def test_what_is_no_group(texts, sentence, capsys):
    main(["next", *texts])
    told = capsys.readouterr()
    assert sentence in told.out + told.err


def test_networks_without_a_menu_in_common(engine):
    pair = [(t, network_of(t)) for t in ("1~2; F1; S1", "p(R1,C1)")]
    with pytest.raises(InputError, match="one kind"):
        menu_for(pair, engine)


def test_structures_that_are_no_group_are_refused(engine):
    machine = "1~2; F1; S1"
    for texts, said in (
        ([machine, machine], "1~2; F1; S1 is named twice"),
        (["3:1", "1~2~3; F1; S1"], "chains and networks are on different menus"),
    ):
        with pytest.raises(InputError, match=said):
            next_experiments(texts, damped=False, engine=engine)
    chains = [(str(k), Chain(3, quantity=q)) for k, q in enumerate(("velocity", "position"))]
    with pytest.raises(InputError, match="different numbers of masses or sensor quantities"):
        menu_for(chains, engine)


def test_every_kind_has_its_words():
    assert all(kind.item.format(2) and kind.anywhere and kind.title for kind in ALL_KINDS)
