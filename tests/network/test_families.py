"""Families of networks: literal counts, and each network once: enumerated again without the package,
up to isomorphism of graphs (networkx), of circuits up to isomorphism of cycle matroids.
"""

import random
from collections import Counter
from itertools import chain, combinations, combinations_with_replacement, permutations, product

import networkx as nx
import pytest
from sympy import Matrix, Rational

from disting import compare, local_identifiability
from disting.errors import InputError
from disting.general.any_model import of_network
from disting.network.families import FAMILIES, family_of
from disting.network.notation import network_of, notations_of, values_in

COUNTS = {
    "machines-2": 13,
    "machines-2-damped": 13,
    "machines-3": 126,
    "machines-3-damped": 126,
    "trees-4": 170,
    "trees-4-damped": 170,
    "circuits-4": 63,
    "circuits-5": 148,
    "cells-4": 119,
    "cells-5": 215,
    "compartments-2": 12,
    "compartments-3": 284,
}


@pytest.mark.full
def test_numbers_of_networks():
    assert {name: len(family_of(name).networks) for name in FAMILIES} == COUNTS


def test_numbers_of_circuits_by_size():
    sizes = Counter(len(n.elements) for n in family_of("circuits-5").networks)
    assert sizes == {1: 3, 2: 6, 3: 16, 4: 38, 5: 85}
    bridges = [n for n in family_of("circuits-5").networks if ";" in n.name]
    assert len(bridges) == 85 - 68


@pytest.mark.full
def test_the_canonical_networks_of_ladenheim_are_those_of_which_all_values_can_be_determined():
    """108 of 148: Morelli and Smith, Passive Network Synthesis, SIAM 2019."""
    models = map(of_network, family_of("circuits-5").networks)
    found = [m for m in models if local_identifiability(m).rank == len(m.parameters)]
    assert len(found) == 108


@pytest.mark.thin(1)
@pytest.mark.parametrize(
    ("masses", "some", "every", "whole"), [(2, 24, 18, 13), (3, 258, 185, 126)]
)
def test_machines_are_all_graphs_in_lowest_terms(masses, some, every, whole):
    """`some` have a spring, `every` one at every mass."""
    found = once(machines(masses))
    assert len(found) == some
    graphs = [
        (g, given)
        for g, given in found
        if {*range(1, masses + 1)} <= {i for ends in given[0] for i in ends}
    ]
    assert len(graphs) == every
    kept = [g for g, given in graphs if has_two_poles_for_each_mass(masses, *given)]
    assert len(kept) == whole
    listed = [
        graph_of_machine(masses, *described(n)) for n in family_of(f"machines-{masses}").networks
    ]
    assert same_classes(listed, kept)


def machines(masses):
    pairs = list(combinations(range(masses + 1), 2))
    for springs in chain.from_iterable(combinations(pairs, k) for k in range(1, len(pairs) + 1)):
        for force, sensor in combinations_with_replacement(pairs, 2):
            given = springs, force, sensor
            yield graph_of_machine(masses, *given), given


def described(network):
    springs = [tuple(sorted(e.nodes)) for e in network.elements if e.letter == "k"]
    ports = [tuple(sorted((p.plus, p.minus))) for p in network.ports]
    return springs, *ports


def graph_of_machine(masses, springs, force, sensor):
    """Springs, both ports and the ground by labels: a port is no direction, and force and sensor
    may be exchanged.
    """
    graph = nx.Graph()
    graph.add_node(0, label="ground")
    for i, j in springs:
        graph.add_edge(("spring", i, j), i)
        graph.add_edge(("spring", i, j), j)
    for at, (i, j) in enumerate((force, sensor)):
        graph.add_edge(("port", at), i)
        graph.add_edge(("port", at), j)
    for node, data in graph.nodes.items():
        data.setdefault("label", node[0] if isinstance(node, tuple) else "mass")
    graph.add_nodes_from(set(range(1, masses + 1)) - set(graph), label="mass")
    return graph


def has_two_poles_for_each_mass(masses, springs, force, sensor):
    """Whether force and sensor reach all modes at random values: Krylov vectors of full rank."""
    draw = random.Random(1)
    stiffness = Matrix.zeros(masses)
    for i, j in springs:
        v = vector(masses, (j, i))
        stiffness += draw.randrange(1, 10**6) * v * v.T
    inverse = Matrix.diag(*(Rational(1, draw.randrange(1, 10**6)) for _ in range(masses)))
    ranks = []
    for port in (force, sensor):
        column = inverse * vector(masses, port)
        columns = [column]
        for _ in range(masses - 1):
            columns.append(inverse * stiffness * columns[-1])
        ranks.append(Matrix.hstack(*columns).rank())
    return ranks == [masses, masses]


def vector(size, ends):
    return Matrix([(i == ends[0]) - (i == ends[1]) for i in range(1, size + 1)])


@pytest.mark.thin(1)
@pytest.mark.parametrize("count", [2, pytest.param(3, marks=pytest.mark.slow)])
def test_compartments_are_all_graphs_with_a_way_through(count):
    graphs = once(compartments(count))
    listed = []
    for network in family_of(f"compartments-{count}").networks:
        flows = [e.nodes for e in network.elements if e.letter == "a"]
        ports = network.inputs[0].plus, network.outputs[0].plus
        listed.append(graph_of_compartments(count, flows, *ports))
    assert same_classes(listed, [graph for graph, _ in graphs])


def compartments(count):
    inside = range(1, count + 1)
    arrows = [(i, j) for i in inside for j in range(count + 1) if i != j]
    for flows in chain.from_iterable(combinations(arrows, k) for k in range(len(arrows) + 1)):
        for enter, leave in product(inside, repeat=2):
            graph = graph_of_compartments(count, flows, enter, leave)
            plain = graph.subgraph(inside)
            reached = {enter, *nx.descendants(plain, enter)}
            reaching = {leave, *nx.ancestors(plain, leave)}
            if len(reached & reaching) == count:
                yield graph, flows


def graph_of_compartments(count, flows, enter, leave):
    graph = nx.DiGraph()
    graph.add_nodes_from(range(1, count + 1), label="compartment")
    graph.add_node(0, label="outside")
    graph.add_edges_from(flows)
    for name, at in (("in", enter), ("out", leave)):
        graph.add_node(name, label=name)
        graph.add_edge(name, at)
    return graph


def once(graphs):
    """The first graph of every class of isomorphic ones, and what it was made of."""
    kept = {}
    for graph, given in graphs:
        like = kept.setdefault(mark(graph), [])
        if not any(is_same(graph, other) for other, _ in like):
            like.append((graph, given))
    return [pair for like in kept.values() for pair in like]


def mark(graph):
    """What isomorphic graphs share."""
    labels = graph.nodes(data="label")
    near = {i: sorted(labels[j] for j in nx.all_neighbors(graph, i)) for i in graph}
    return tuple(sorted((labels[i], *near[i]) for i in graph))


def is_same(one, other):
    return nx.is_isomorphic(one, other, node_match=lambda a, b: a["label"] == b["label"])


def same_classes(listed, expected):
    """Whether each expected graph is listed exactly once, and nothing else is."""
    found = [[is_same(graph, other) for other in expected] for graph in listed]
    return (
        len(listed) == len(expected)
        and all(map(any, found))
        and all(map(any, zip(*found, strict=True)))
    )


@pytest.mark.full
@pytest.mark.parametrize(
    ("name", "kinds", "reactive", "most"),
    [
        ("circuits-4", "RLC", "LC", 4),
        ("cells-4", "RCW", "", 4),
        pytest.param("circuits-5", "RLC", "LC", 5, marks=pytest.mark.slow),
    ],
)
def test_circuits_are_all_matroids_without_like_elements_side_by_side(name, kinds, reactive, most):
    expected = {
        form
        for count in range(1, most + 1)
        for bases in shapes(count)
        for letters in product(kinds, repeat=count)
        if sum(x in reactive for x in letters) <= 2
        and is_reduced(bases, letters)
        and (form := canonical(bases, letters))
    }
    listed = [form_of(n) for n in family_of(name).networks]
    assert len(listed) == len(set(listed))
    assert set(listed) == expected


def form_of(network):
    """A one-port up to its numbering and the order of what commutes."""
    edges = [(1, 0), *(e.nodes for e in network.elements)]
    return canonical(bases_of(edges), [e.letter for e in network.elements])


@pytest.mark.full
def test_cells_are_all_matroids_with_a_resistor_in_series():
    expected = {
        form
        for count in range(1, 6)
        for bases in shapes(count)
        for letters in combinations_with_replacement("CPRW", count)
        if (letters.count("W") <= 1 and letters.count("P") <= 2)
        and "R" in letters
        and count - letters.count("R") <= 3
        for order in set(permutations(letters))
        if is_reduced(bases, order)
        and any(x == "R" and all({0, i} & {*b} for b in bases) for i, x in enumerate(order, 1))
        and (form := canonical(bases, order))
    }
    listed = [form_of(n) for n in family_of("cells-5").networks]
    assert len(listed) == len(set(listed))
    assert set(listed) == expected


FITTED = [
    "R0-C1",
    "R0-CPE1",
    "R0-p(R1,C1)",
    "R0-p(R1,CPE1)",
    "R0-p(R1,C1)-W1",  # a layer and diffusion behind it
    "R0-p(R1,CPE1)-W1",
    "R0-p(C1,R1-W1)",  # Randles
    "R0-p(CPE1,R1-W1)",
    "R0-p(R1-W1-C2,C1)",  # a film in which what diffuses stays
    "R0-p(R1,C1)-p(R2,C2)",  # Voigt
    "R0-p(R1,CPE1)-p(R2,CPE2)",
    "R0-p(R1,C1)-p(R2,CPE1)",
    "R0-p(C1,R1-p(R2,C2))",  # a coating
    "R0-p(CPE1,R1-p(R2,CPE2))",
    "R1-[R2-W3,P4]",  # as AutoEIS writes them
    "[R1,C2]-[R3,P4]-R5",
    "P1-[R2,P3]-R4",
]


@pytest.mark.full
def test_cells_have_what_is_fitted_to_impedance():
    known = set(map(form_of, family_of("cells-5").networks))
    assert [text for text in FITTED if form_of(network_of(text)) not in known] == []
    six = network_of("R0-p(R1,C1)-p(R2-W1,C2)")
    assert form_of(six) not in known


def shapes(count):
    """Yield the cycle matroids of two-connected graphs with so many edges and a port, edge 0, each
    up to its numbering once.
    """
    known = set()
    pairs = list(combinations(range(count + 1), 2))
    for edges in combinations_with_replacement(pairs, count):
        nodes = {0, 1, *chain.from_iterable(edges)}
        if nodes != set(range(len(nodes))):
            continue
        joined = [(1, 0), *edges]
        graph = nx.Graph()
        for k, ends in enumerate(joined):
            graph.add_edges_from((("edge", k), i) for i in ends)
        if nx.is_biconnected(graph):
            form = canonical(bases_of(joined), "x" * count)
            if form not in known:
                known.add(form)
                yield form[1]


def bases_of(edges):
    """The spanning trees, as sets of positions."""
    nodes = {i for ends in edges for i in ends}
    return frozenset(
        frozenset(chosen)
        for chosen in combinations(range(len(edges)), len(nodes) - 1)
        if nx.is_connected(nx.Graph([*(edges[k] for k in chosen), *((i, i) for i in nodes)]))
    )


def canonical(bases, letters):
    """Letters and bases under the renumbering of elements that makes them smallest; the port
    stays.
    """
    forms = []
    for order in permutations(range(len(letters))):
        places = {0: 0} | {i + 1: at for at, i in enumerate(order, 1)}
        moved = sorted(tuple(sorted(places[k] for k in basis)) for basis in bases)
        forms.append((tuple(letters[i] for i in order), tuple(moved)))
    return min(forms)


def is_reduced(bases, letters):
    """Whether no two like elements are in series or parallel, and several kinds occur, or one
    element.
    """
    if len(letters) > 1 and len(set(letters)) == 1:
        return False
    for i, j in combinations(range(1, len(letters) + 1), 2):
        parallel = not any({i, j} <= {*basis} for basis in bases)
        series = all({i, j} & {*basis} for basis in bases)
        if letters[i - 1] == letters[j - 1] and (parallel or series):
            return False
    return True


@pytest.mark.parametrize("name", ["circuits-4", "machines-2-damped", "compartments-2"])
def test_a_number_names_a_network(name):
    networks = family_of(name).networks
    for number in (1, len(networks)):
        text = f"{name}:{number}"
        assert network_of(text) == networks[number - 1]
        assert (notations_of(text), values_in(text)) == (["member"], {})
    for number in (0, len(networks) + 1):
        with pytest.raises(InputError, match=f"{name} has the networks 1 to {len(networks)}"):
            network_of(f"{name}:{number}")


def test_a_number_of_a_machine_takes_the_quantity():
    assert network_of("machines-2:1", quantity="position").order == 0
    assert compare("machines-2:1", "3:1", quantity="velocity").relation == "distinguishable"


@pytest.mark.parametrize("name", ["trees-9", "trees-3", "cells-6", "circuits-4-damped", "nets-1"])
def test_a_family_that_does_not_exist(name):
    with pytest.raises(InputError, match="families of networks are machines-2, "):
        network_of(f"{name}:1")


@pytest.mark.full
def test_other_numbers_are_families_too():
    whole = family_of("circuits-6")
    assert (whole.is_shipped, whole.in_brief) == (False, False)
    assert {n.name for n in family_of("circuits-5").networks} < {*whole.source()}
