"""Text near to what people write: a network, or one sentence that refuses it, whatever it is; what a
network is written as is that network.
"""

import json

import networkx as nx
import pytest
from hypothesis import given, settings, strategies as st

from disting.errors import InputError
from disting.network import Element, Network, Port, network_of
from disting.network.families import FAMILIES, family_of
from disting.network.notation import DIALECTS, NOTATIONS
from disting.network.notation.entries import entry_of, network_of_entry
from tests.network.drawn import built, descriptions

GOOD = [
    "R0-p(R1,C1)-p(R2,C2)-W1",
    "R1-[C2,[R3,L4]-W5]",
    "R(RC)(C[RW])",
    "R1 1 2; L1 2 0; C1 2 0; port 1 0",
    "R1 1 2 10k tc=0.1\nC1 2 0 {c}",
    "V1 in 0\nR1 in out 10k\nC1 out 0 1u\n.end",
    "1=2=3, 2~4*3/2, 4-#; F1; S4 S3:2; velocity",
    "#=[1fs]   [2F]=[3S],",
    "1>2, 2<>3, 3>0; in 1, 2; out 1",
    "linear_compartment_model([[2], [1, 3], []], inputs=[1], outputs=[2], leaks=[1])",
]
PIECES = [
    *"RLCWFSfsp()[]-,;=~#>*:/.0123456789 \n",
    *("p(", "; F1", "; S2", "in 1", "out 1", "port ", "<>", "[[", "]]", "leaks=[", "position"),
    *("99999", "٣", "\x00", "ä", "''", "1e5", "R1 1 2", "1=2", "1>2", "*g", "*0", "[1F]", "[2S]"),
]
NOTATION = st.sampled_from(["", "", *NOTATIONS])


@st.composite
def mutants(draw):
    """A good text with pieces put in, taken out, doubled, exchanged."""
    text = draw(st.sampled_from(GOOD))
    for _ in range(draw(st.integers(0, 4))):
        a, b = sorted(draw(st.integers(0, len(text))) for _ in range(2))
        middle = draw(st.sampled_from([*PIECES, "", text[a:b], text[a:b] * 2, text[a:b][::-1]]))
        text = text[:a] + middle + text[b:]
    return text


TEXTS = st.one_of(mutants(), st.lists(st.sampled_from(PIECES), max_size=12).map("".join), st.text())


def is_read_or_refused(read):
    """The network or None; a refusal is a sentence in one line, not a page."""
    try:
        network = read()
    except InputError as problem:
        said = str(problem)
        assert said and "\n" not in said and said.isprintable() and len(said) < 500, said
        return None
    assert isinstance(network, Network)
    return network


@pytest.mark.full
@given(TEXTS, NOTATION)
def test_text_is_read_or_refused(text, notation):
    is_read_or_refused(lambda: network_of(text, notation))


@pytest.mark.slow
@settings(max_examples=20_000)
@given(TEXTS, NOTATION)
def test_much_text_is_read_or_refused(text, notation):
    is_read_or_refused(lambda: network_of(text, notation))


VALUES = st.recursive(
    st.one_of(
        *(st.integers(-2, 99999), st.floats(), st.none(), st.booleans(), TEXTS),
        *(st.sampled_from(["m1", "k12", "R1", "a12", "v", "s", "i", "3/2", "position"]),),
    ),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(max_size=3), inner, max_size=2),
    max_leaves=8,
)  # fmt: skip
KEYS = ["circuit", "machine", "network", "flows", "input", "output", "elements", "force", "sensor"]
KEYS += ["port", "quantity", "notation"]
ELEMENTS = st.lists(
    st.tuples(st.sampled_from(["m1", "k12", "d12", "R1", "C1", "x", ""]), st.integers(0, 3), VALUES)
    .map(list)
)  # fmt: skip


@pytest.mark.full
@given(st.dictionaries(st.sampled_from(KEYS), VALUES | ELEMENTS, max_size=4))
def test_entries_are_read_or_refused(entry):
    known = {"circuit", "machine", "network", "flows", "elements"} & entry.keys()
    if known:
        is_read_or_refused(lambda: network_of_entry(entry, "drawn"))


@pytest.mark.parametrize("text", GOOD)
def test_what_is_fuzzed_is_good(text):
    assert is_read_or_refused(lambda: network_of(text))


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("[12345F]=[2S]", "numbered from 1"),
        (
            "R0-p(C1,R1-Ws1)",
            "is not supported: its impedance is not a fraction",
        ),
        ("[1F]=[2FS]", "each once"),
        ("[1F]=[1S]", "each mass once"),
        ("=[1FS]", "not a joint of a drawing"),
        ("1~2; F1; S1; position; velocity", "give one quantity"),
        (f"{'1' * 4400}>2; in 1; out 1", "not a flow"),
        (f"1>2; in {'1' * 4400}; out 1", "not a flow"),
        (f"linear_compartment_model([{'[1]    ' * 400}x])", "list of lists"),
        ("linear_compartment_model([[1][1]], inputs=[1], outputs=[1])", "list of lists"),
    ],
)
def test_what_could_be_misread_is_refused(text, said):
    with pytest.raises(InputError, match=said):
        network_of(text)


SPRING, MASS = Element("k12", "k", (1, 2)), Element("m1", "m", (1,))


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("k12", "k", (1, 2), 2), "texts, not 2"),
        (("k12", "k", [1, 2]), r"a tuple of whole numbers, not \[1, 2\]"),
        (("q1", "v", (1,)), "'q1' is a compartment, which has no value: leave its name empty"),
        (("d12", "k", (1, 2)), "d12 names a damper: begin the name of a spring with k"),
        (("k12", "k", (1, 2), "", "n1"), "k12 is a spring, which has no exponent: remove it"),
        (("k12", "k", (1, 2), "0"), "the ratio of k12 is zero: remove the gear"),
        (("k12", "k", (1, 2), "s"), "'s' is not a ratio: use a name other than s, or a number"),
    ],
    ids=str,
)
def test_an_element_that_is_none_is_refused(arguments, said):
    with pytest.raises(InputError, match=said):
        Element(*arguments)


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (([MASS], (Port(1),), (Port(1),)), "elements of a network are a tuple of Element"),
        (((MASS,), (1,), (Port(1),)), "inputs of a network are a tuple of Port"),
        (((MASS,), (Port(1),), (Port(1),), 0, "two\nlines"), "printable characters only"),
        (
            ((*(Element(f"m{i}", "m", (i,)) for i in range(1, 42)),), (Port(1),), (Port(1),)),
            "40 nodes and 300 elements at most, not 41 and 41",
        ),
        (
            ((MASS, SPRING, Element("k23", "k", (2, 3), "k12")), (Port(1),), (Port(1),)),
            "k12 is a ratio and something else: give it its own name",
        ),
        (((MASS,), (Port(1),) * 11, (Port(1),) * 11), "10 inputs and outputs at most"),
        (((MASS,), (Port(1),), (Port(1),), 1.0), "the order of a network is a whole number"),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_a_network_that_is_none_is_refused(arguments, said):
    with pytest.raises(InputError, match=said):
        Network(*arguments)


@pytest.mark.parametrize(
    ("entry", "said"),
    [
        ({"circuit": "1=2; F1; S1"}, 'is not a circuit: write it as "network"'),
        ({"network": "1=2; F1; S1", "notation": "x"}, "\"notation\" is one of .*, not 'x'"),
        (
            {"elements": [["R1", 1, 0]], "port": 1, "force": 1},
            '"port" is both input and output: remove "force"',
        ),
        ({"elements": ["m1"], "force": 1, "sensor": 1}, "a list of a name and its nodes"),
        ({"elements": [["R1", 1, 0]], "port": [[1, 0, 2]]}, r"a port is \[plus, minus\]"),
    ],
    ids=str,
)
def test_an_entry_that_is_none_is_refused(entry, said):
    with pytest.raises(InputError, match=said):
        network_of_entry(entry, "refused")


@given(st.lists(st.sampled_from(["R", "C", "R1", "C2", *"()[]-,", "p("]), max_size=9).map("".join))
def test_no_circuit_is_read_in_one_dialect_that_means_another_one_in_a_second(text):
    read = {d: is_read_or_refused(lambda d=d: network_of(text, d)) for d in DIALECTS}
    meant = {network for network in read.values() if network}
    found = is_read_or_refused(lambda: network_of(text))
    assert found in meant if len(meant) == 1 else not found
    if len(meant) > 1:
        with pytest.raises(InputError, match=" and another one in "):
            network_of(text)


@pytest.mark.full
@given(descriptions())
def test_an_entry_is_read_back(description):
    network = built(description)
    if isinstance(network, Network) and writes_as_an_entry(network):
        entry = json.loads(json.dumps(entry_of(network)))
        assert is_isomorphic(network_of_entry(entry, "again"), network)


def writes_as_an_entry(network):
    """Flows have the names that notation gives them."""
    return not network.is_directed or all(
        e.value == f"a{e.nodes[0]}{e.nodes[1]}" for e in network.elements if e.value
    )


@pytest.mark.thin(1)
@pytest.mark.parametrize(
    "name",
    [pytest.param(n, marks=[pytest.mark.slow] * n.startswith("trees")) for n in FAMILIES],
)
def test_networks_of_families_are_read_back(name):
    for network in family_of(name).networks[::7]:
        again = network_of(network.name)
        assert again == network
        assert network_of_entry(entry_of(network), network.name) == network


def is_isomorphic(one, other):
    """With all kinds, names, ratios, ports and the ground."""
    return one.order == other.order and nx.is_isomorphic(
        *(graph(n) for n in (one, other)), node_match=lambda a, b: a["label"] == b["label"]
    )


def graph(network):
    made = nx.DiGraph()
    made.add_nodes_from(network.nodes, label="node")
    made.add_node(0, label="ground")
    marked = [((e.letter, e.value, e.ratio), e.nodes) for e in network.elements]
    marked += [(("in", k), (p.plus, p.minus)) for k, p in enumerate(network.inputs)]
    marked += [(("out", k), (p.plus, p.minus)) for k, p in enumerate(network.outputs)]
    for label, nodes in marked:
        for k, node in enumerate(nodes):
            made.add_node((label, k, nodes), label=(label, k))
            made.add_edge((label, k, nodes), node)
            made.add_edge((label, 0, nodes), (label, k, nodes))
    return made
