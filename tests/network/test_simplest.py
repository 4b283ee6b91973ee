"""The simplest network of a normal form: against isomorphism of graphs (networkx), against twins
found by plain numbers, and what verdicts rest on it.
"""

import random
from itertools import combinations, permutations

import networkx as nx
import pytest

from disting import compare, network_of, verify
from disting.errors import InputError
from disting.general.any_model import of_network, on_one_variable
from disting.general.replacement import simplest_network
from disting.network.families import family_of
from disting.network.normal_form import normal_form
from disting.network.simplest import same_drawing, simplest
from disting.verdict.verdict_file import verdict_file
from tests.network.pairs import changed
from tests.oracles.twins import twin

FAMILIES = ["circuits-4", "machines-2", "compartments-2"]
LARGE = ["cells-4", "circuits-5", "machines-3", "trees-4", "compartments-3"]
# all of these were open before equations were eliminated, and parts became ladders
DECIDED = [
    pytest.param(
        *("R1-p(L1,R2-p(R3,C1))", "p(R1-L1,R2-p(R3,L2))", "distinguishable"),
        marks=pytest.mark.slow,
    ),
    ("R1-p(R2,R3-p(R4,L1))", "R1 1 2; R2 1 3; C1 2 3; R3 2 0; R4 3 0", "distinguishable"),
    ("R1-p(R2,C1-p(R3,L1))", "p(R1,C1-p(R2,R3-L1))", "indistinguishable"),
    ("#~1, #~2, 1~3; F2:1; S2:1", "#~1, 1~2, 1~3; F2; S2:1", "indistinguishable"),
]

LARGER = ("R1-p(R2-L1,R3-C1)", "L1 1 2; R1 1 3; R2 2 3; R3 2 0; L2 3 0")  # a bridge gives less


def graph(network, ends):
    """The normal form with the ends of the ports in the labels of its nodes."""
    form, made = normal_form(network), nx.DiGraph()
    for a, b, label in form.edges:
        made.add_edge(a, b, label=label)
        if not network.is_directed:
            made.add_edge(b, a, label=label)
    made.add_nodes_from(i for pair in ends for i in pair[: 1 if network.is_directed else 2])
    hanging = dict(form.nodes)
    for i in made.nodes:
        there = tuple((k, s) for k, pair in enumerate(ends) for s, j in enumerate(pair) if i == j)
        made.nodes[i]["label"] = (hanging.get(i), there)
    return made


def isomorphic(left, right):
    """Whether the normal forms are one graph, whatever way the ports of the right one are read."""
    plain = [[(p.plus, p.minus) for p in n.ports] for n in (left, right)]
    ways = [plain[1]]
    if not right.is_directed:
        ways = [list(order) for order in permutations(plain[1])]
        ways += [[pair[::-1] for pair in way] for way in ways]
    same = {"node_match": lambda a, b: a == b, "edge_match": lambda a, b: a == b}
    graphs = [graph(right, way) for way in ways]
    if right.is_directed and right.inputs == right.outputs:
        graphs += [g.reverse() for g in graphs]  # of one compartment all flows can be turned round
    return any(nx.is_isomorphic(graph(left, plain[0]), g, **same) for g in graphs)


def has_one_form(left, right):
    one = simplest(left)
    return one is not None and one == simplest(right)


@pytest.mark.sampled(2)
@pytest.mark.full
@pytest.mark.parametrize(
    "name", [*FAMILIES, *(pytest.param(n, marks=pytest.mark.slow) for n in LARGE)]
)
def test_one_simplest_network_exactly_where_normal_forms_are_one_graph(name):
    networks = family_of(name).networks
    alike = 0
    for left, right in combinations(networks, 2):
        same = has_one_form(left, right)
        assert same == isomorphic(left, right), (left.name, right.name)
        alike += same
    assert alike


@pytest.mark.thin(1)
@pytest.mark.parametrize(
    "name", [*FAMILIES, *(pytest.param(n, marks=pytest.mark.slow) for n in LARGE)]
)
def test_the_simplest_network_gives_the_same(name):
    draw = random.Random(name)
    networks = [n for n in family_of(name).networks if not same_drawing(n, simplest(n))]
    chosen = networks if name in LARGE else draw.sample(networks, min(4, len(networks)))
    for network in chosen:
        form = simplest(network)
        assert simplest(form).elements == form.elements
        assert len(form.parameters) <= len(network.parameters)
        for given, other in ((network, form), (form, network)):
            assert twin(given, other, draw)[1] is not None, (given.name, other.name)


@pytest.mark.full
def test_numbers_of_nodes_do_not_matter():
    draw = random.Random(4)
    for network in draw.sample(family_of("machines-3").networks, 20):
        order = [0, *draw.sample(range(1, 4), 3)]
        text = "".join(
            str(order[int(x)]) if x.isdigit() else x for x in network.name.replace("#", "0")
        ).replace("0", "#")
        assert simplest(network_of(text)) == simplest(network), text


@pytest.mark.full
@pytest.mark.parametrize("name", [*FAMILIES, "machines-3", "circuits-5", "cells-4"])
def test_damaged_networks_have_one_with_the_same_coefficients(name):
    """With elements too many, hanging, elsewhere, gears, ports turned: no error, no other order."""
    draw, seen = random.Random(name), 0
    for _ in range(25):
        network = draw.choice(family_of(name).networks)
        try:
            for _ in range(draw.randint(1, 3)):
                network = changed(network, draw)
            model = of_network(network)
            form = simplest_network(model)
            there = form and of_network(form)
        except InputError:
            continue
        if there:
            seen += 1
            assert pattern(*on_one_variable([there, model])) == pattern(
                *on_one_variable([model, there])
            )
    assert seen > 5


def pattern(model, _):
    """Which coefficients are not zero for all values."""
    return [list(map(bool, side)) for side in (model.numerator_terms, model.denominator_terms)]


@pytest.mark.sampled(2)
@pytest.mark.full
@pytest.mark.parametrize(("left", "right", "relation"), DECIDED)
def test_pairs_that_were_open(left, right, relation):
    data = verdict_file(left, right)
    assert data["relation"] == relation and data["certainty"] in ("proven", "theorem")
    assert verify(data).status.value == "holds"
    turned = compare(right, left)
    assert turned.relation.value == relation
    one, other, draw = network_of(left), network_of(right), random.Random(1)
    for given, searched in ((one, other), (other, one)):
        theirs = twin(given, searched, draw, 60 if relation == "indistinguishable" else 8)[1]
        assert (theirs is not None) == (relation == "indistinguishable")


@pytest.mark.full
def test_evidence_on_other_networks_is_refused():
    for left, right in (DECIDED[1][:2], LARGER):
        data = verdict_file(left, right)
        evidence = data["evidence"]
        assert evidence["kind"] == "replaced"
        lies = [
            {"left": evidence["right"], "right": evidence["left"]},
            {"left": "R1"},
            {"left_larger": not evidence["left_larger"]},
            {"right_larger": not evidence["right_larger"]},
            {"inner": {"kind": "theorem", "name": "Foster and Cauer"}},
            {"inner": evidence["inner"] | {"domain": "real"}},
            {"inner": evidence["inner"] | {"kind": "replaced"}},
        ]
        for lie in lies:
            assert not holds(data | {"evidence": evidence | lie}), lie
        assert not holds(data | {"relation": "indistinguishable"})
        assert not holds(data | {"domain": "complex"})


def holds(data):
    try:
        return verify(data).status.value == "holds"
    except InputError:
        return False
