"""Networks under several experiments: against matrices that are written out, and against what the
engine of chains tells of the same machines.
"""

import json
from fractions import Fraction
from itertools import product
from math import prod

import pytest
import sympy
from hypothesis import given, settings, strategies as st

from disting import Experiment, Family, InputError, Query, View, compare, identifiability
from disting.cli.run import main
from disting.experiments.measured_network import MeasuredNetwork
from disting.model.question import Domain
from disting.network import network_of
from disting.network.chains import of_chain
from disting.verdict.engine import Engine
from disting.verdict.identifiable import identify_measured
from disting.verdict.placement_verdicts import compare_everywhere, everywhere_file
from disting.verdict.result import Relation
from disting.verdict.verification import Status, verify

MACHINES = (
    "1=2, 2=3, 1~3; F1; S3",
    "1=2, 2=#; F1:2; S2",
    "1=2*i, 2~3; F1; S3",
    "1~2; F1; S1; S2",
)
LONG, STAR = "1~2, 2~3; F1; S1", "1~2, 1~3; F1; S1"
EXACT = Query(View.EXACT)


@st.composite
def experiments(draw, nodes):
    """Force and sensor anywhere, a quantity, one node held, two known things added."""
    port = st.none() | st.permutations([0, *nodes]).map(lambda p: tuple(p[:2]))
    held = draw(st.sampled_from(nodes))
    others = [i for i in nodes if i != held]
    size = st.fractions(min_value=1, max_value=9, max_denominator=5)
    places = st.sampled_from(others)
    return Experiment(
        draw(port),
        draw(port),
        draw(st.sampled_from([None, "position", "velocity"])),
        locked=held,
        inertias={draw(places): draw(size)},
        brakes={draw(places): draw(size)},
    )


@pytest.mark.full
@given(st.sampled_from(MACHINES), st.data())
@settings(deadline=None, max_examples=6)
def test_all_functions_against_a_matrix_that_is_written_out(text, data):
    network = network_of(text)
    experiment = data.draw(experiments(network.nodes))
    at = {p: sympy.Rational(data.draw(st.integers(1, 9)), 7) for p in network.parameters}
    s = sympy.Rational(data.draw(st.integers(2, 9)), 5)
    measured = MeasuredNetwork(network, (Experiment(), experiment))
    found = [[[value(x, network, at, s) for x in row] for row in b] for b in measured.blocks]
    assert found == [by_hand(network, at, s, e) for e in measured.experiments]


def value(ratio, network, at, s):
    numbers = [Fraction(int(x.p), int(x.q)) for x in (s, *(at[p] for p in network.parameters))]
    top, bottom = (
        sum(
            int(number) * prod(x ** int(e) for x, e in zip(numbers, powers, strict=True))
            for powers, number in side.to_dict().items()
        )
        for side in (ratio.num, ratio.den)
    )
    return sympy.Rational(str(top / bottom))


def by_hand(network, at, s, experiment):
    """The matrix of a network at a point, by its equations: rows and columns of nodes that are held
    are left out.
    """
    nodes = [i for i in network.nodes if i not in experiment.still]
    matrix = sympy.zeros(len(nodes))
    for e in network.elements:
        ratio = sympy.Integer(1) if not e.ratio else at.get(e.ratio) or sympy.Rational(e.ratio)
        feels = column(zip(e.nodes, (1, -ratio), strict=False), nodes).T
        matrix += at[e.value] * s ** (e.kind.halves // 2) * feels.T * feels
    for change in experiment.changes:
        if change.size is not None:
            here = nodes.index(change.place)
            matrix[here, here] += sympy.Rational(str(change.size)) * s**change.kind.power
    moved = [
        (at_port,) if at_port else tuple((p.plus, p.minus) for p in ports)
        for at_port, ports in (
            (experiment.force, network.inputs),
            (experiment.sensor, network.outputs),
        )
    ]
    forces, sensors = (
        sympy.Matrix.hstack(*(column(((a, 1), (b, -1)), nodes) for a, b in ports))
        for ports in moved
    )
    order = network.order if experiment.quantity is None else experiment.quantity.order
    return (s**order * sensors.T * matrix.inv() * forces).tolist()


def column(entries, nodes):
    found = sympy.zeros(len(nodes), 1)
    for i, x in entries:
        if i in nodes:
            found[nodes.index(i)] += x
    return found


WAYS = (
    (Experiment(sensor=2), Experiment(sensor=2)),
    (Experiment(locked=2), Experiment(locked=3)),
    (Experiment(inertias={1: 2}), Experiment(inertias={1: 2})),
    (Experiment(force=2, sensor=3, brakes={3: 1}), Experiment(force=3, sensor=2, brakes={2: 1})),
)


@pytest.mark.thin(1)
@pytest.mark.parametrize("way", WAYS, ids=str)
@pytest.mark.parametrize("pair", [(1, 11), (2, 5), (9, 10)])
def test_chains_are_told_what_they_are_told_as_chains(pair, way):
    chains = [Family(3, damped=False)[m] for m in pair]
    told = compare(*chains, experiments=[Experiment(), way], query=EXACT)
    engine = Engine()
    models = [
        MeasuredNetwork(of_chain(chain, str(m)), (Experiment(), side)).model
        for chain, side, m in zip(chains, way, pair, strict=True)
    ]
    sides = engine.general_subjects(models)
    found = engine.verdict(*sides, Query(View.EXACT, inclusion=False))
    assert found.relation is told.relation is not Relation.UNDECIDED


@pytest.mark.parametrize(("number", "kind"), list(product((1, 3, 8), ("locked", "sensor"))))
def test_parameters_are_determined_as_those_of_the_chain(number, kind):
    chain, engine = Family(3, damped=False)[number], Engine()
    together = (Experiment(), Experiment(**{kind: 2}))
    told = identifiability(chain, experiments=together, engine=engine)
    measured = MeasuredNetwork(of_chain(chain), together)
    found = identify_measured(measured, Domain.POSITIVE, engine)
    assert found.levels == told.levels


def test_the_same_machine_in_other_words_is_never_told_apart():
    """The star is the row 2, 1, 3, whose force and sensor are at its middle."""
    same = compare_everywhere(STAR, "1~2, 2~3; F2; S2", ["sensor=2/1,lock=3/3"], query=EXACT)
    assert same.answer.value == "never"
    assert "mass 3 locked" in same.verdicts[0][1].sentence


@pytest.mark.full
def test_every_place_is_asked_and_a_file_of_it_is_checked():
    data = everywhere_file(LONG, STAR, ["lock=2"], query=EXACT)
    assert [one["places"] for one in data["verdicts"]] == [{"2": i} for i in (1, 2, 3)]
    assert data["answer"] == compare_everywhere(LONG, STAR, ["lock=2"], query=EXACT).answer
    assert verify(data).status is Status.HOLDS
    moved = json.loads(json.dumps(data))
    moved["verdicts"][0]["experiments"][1]["right"]["locked"] = [2]
    assert verify(moved).status is Status.FAILS


def test_a_sensor_that_does_not_move_adds_nothing():
    told = compare(LONG, STAR, experiments=[Experiment(), Experiment(locked=1)], query=EXACT)
    plain = compare(LONG, STAR, query=EXACT)
    assert (told.relation, told.evidence) == (plain.relation, plain.evidence)
    assert "its sensor never moves" in " ".join(told.notes)


@pytest.mark.parametrize(
    ("models", "also", "sentence"),
    [
        ((LONG, STAR), "sensor=4", "there is no mass 4 in a chain with masses 1 to 3"),
        ((STAR, LONG), "sensor=4", "there is no mass 4 in a machine with masses 1 to 3"),
        ((LONG, "R0-p(R1,C1)"), "sensor=2", "experiments are on machines"),
        ((LONG, "1~2; F1; S1 S2"), "lock=2", "the same outputs and inputs"),
    ],
)
def test_what_cannot_be_measured_is_refused(models, also, sentence):
    with pytest.raises(InputError, match=sentence):
        compare_everywhere(*models, [also])
    with pytest.raises(InputError, match="at least one experiment is needed"):
        MeasuredNetwork(network_of(STAR), ())
    with pytest.raises(InputError, match="experiments are on machines"):
        MeasuredNetwork(network_of("R0-p(R1,C1)"), (Experiment(),))


@pytest.mark.full
def test_commands(capsys, monkeypatch):
    monkeypatch.setenv("DISTING_CACHE", "off")
    assert main(["compare", LONG, STAR, "--also", "lock=2", "--domain", "complex"]) == 0
    assert "experiment 2  mass 2 locked" in capsys.readouterr().out
    assert main(["models", STAR, "--also", "sensor=2"]) == 0
    assert capsys.readouterr().out.endswith(
        "experiment 1  as it is\nexperiment 2  sensor 2\n5 parameters, all globally identifiable.\n"
    )
