"""Networks that are the same up to numbering, beside a search through all numberings."""

import random
import time
from collections import Counter
from dataclasses import replace
from itertools import combinations_with_replacement, permutations
from typing import Any

import pytest

from disting import Chain, Quantity
from disting.network import Element, Network, Port, network_of
from disting.network.denotation import Naming, naming_of
from disting.network.isomorphism import is_same_network
from disting.network.notation.entries import network_of_entry


def gear(*ratios: str) -> Network:
    """Three masses, a spring and a damper with ratios."""
    elements = [["m1", 1], ["m2", 2], ["m3", 3]]
    elements += [["k12", 1, 2, ratios[0]], ["k23", 2, 3, ratios[1]], ["d23", 2, 3, ratios[2]]]
    return network_of_entry({"elements": elements, "force": [1, 0], "sensor": [3, 0]}, "gear")


TEXTS = [
    *("R1-p(R2,C1)", "p(R1,C1)-R2", "p(R1,R2-C1)", "R1-C1-R2", "R1-p(R2,P1)", "p(R1,P1)-P2"),
    *("R1 1 2; C1 2 0; R2 1 0", "R1 1 2; C1 2 0; R2 2 0", "R1 1 2; R2 2 3; C1 3 1; L1 2 0"),
    *("1~2~3; F1; S2", "1~2, 1~3; F1; S2", "1~3~2; F1; S3", "1~2~3; F1; S3", "1~2~3; F2; S2"),
    *("1=2, 2~#; F1; S2", "1~2, 2-#; F1; S2", "1~2; F1; S2", "1~2; F1:2; S2", "1~2; F2:1; S1"),
    *("1>2, 2>1, 1>0; in 1; out 1", "1>2, 2>1, 2>0; in 1; out 1", "2>3, 3>2, 2>0; in 2; out 2"),
    *("1>2, 2>0; in 1; out 2", "2>1, 1>0; in 2; out 1", "1~2; F1; S1 S2", "1~2; F1; S2 S1"),
]
NETWORKS = [network_of(text) for text in TEXTS]
NETWORKS += [gear(*r) for r in (("i", "i", "j"), ("i", "j", "j"), ("2", "i", "i"), ("1", "i", "i"))]
NETWORKS += [gear("2", "4/2", "2"), gear("4/2", "2", "2"), gear("3", "2", "2")]
NETWORKS += [
    Network(
        (Element("P1", "P", (1, 2), "", n), Element("P2", "P", (2, 0), "", m)), *[(Port(1),)] * 2
    )
    for n, m in (("n", "n"), ("n", "m"), ("m", "n"))
]


def plain(network: Network, places: dict[int, int], names: dict[str, str]) -> Any:
    """All of it but the names of values, numbered anew."""
    elements = Counter[Any]()
    for e in network.elements:
        nodes = [places[i] for i in e.nodes]
        ordered = e.letter == "a" or e.known_ratio != 1
        ratio = names.get(e.ratio, "") if e.known_ratio is None else str(e.known_ratio)
        key = (e.letter, tuple(nodes if ordered else sorted(nodes)), ratio, names.get(e.exponent))
        elements[key] += 1
    ports = [(places[p.plus], places[p.minus]) for p in network.ports]
    return elements, ports, network.shape, network.order


def shared(network: Network) -> list[str]:
    ratios = {e.ratio for e in network.elements if e.known_ratio is None}
    return sorted(ratios | set(network.exponents))


def by_all_numberings(left: Network, right: Network) -> bool:
    sizes = [(n.sort, len(n.nodes), len(shared(n))) for n in (left, right)]
    if sizes[0] != sizes[1]:
        return False
    free = left.sort.value == "circuit"
    sides = [(0, *n.nodes) if free else n.nodes for n in (left, right)]
    wanted = plain(right, {i: i for i in (0, *right.nodes)}, {n: n for n in shared(right)})
    return any(
        plain(
            left,
            {0: 0} | dict(zip(sides[0], order, strict=True)),
            dict(zip(shared(left), names, strict=True)),
        )
        == wanted
        for order in permutations(sides[1])
        for names in permutations(shared(right))
    )


def renumbered(network: Network, seed: int) -> Network:
    """With other numbers of nodes, names of values and order of elements."""
    chance = random.Random(seed)
    nodes = list(network.nodes)
    others = chance.sample(range(1, 40), len(nodes))
    places = {0: 0} | dict(zip(nodes, others, strict=True))
    names = {n: f"{n}x" for n in shared(network)}
    elements = [
        Element(
            e.value and f"{e.value}_new",
            e.letter,
            tuple(places[i] for i in e.nodes)[:: -1 if e.letter not in "a" and not e.ratio else 1],
            names.get(e.ratio, e.ratio),
            names.get(e.exponent, ""),
        )
        for e in network.elements
    ]
    chance.shuffle(elements)
    ports = [Port(places[p.plus], places[p.minus]) for p in network.ports]
    size = len(network.inputs)
    return Network(tuple(elements), tuple(ports[:size]), tuple(ports[size:]), network.order)


@pytest.mark.full
def test_pairs_are_the_same_if_and_only_if_a_numbering_makes_them_equal() -> None:
    answers = Counter[bool]()
    for left, right in combinations_with_replacement(NETWORKS, 2):
        same = is_same_network(left, right)
        answers[same] += 1
        assert same is is_same_network(right, left) is by_all_numberings(left, right), (left, right)
    assert answers[True] > len(NETWORKS) and answers[False] > len(NETWORKS)


@pytest.mark.thin(8)
@pytest.mark.parametrize("at", range(len(NETWORKS)))
def test_another_numbering_is_the_same_network(at: int) -> None:
    network = NETWORKS[at]
    for seed in range(5):
        assert is_same_network(network, renumbered(network, seed))
    if network.order:
        assert not is_same_network(network, replace(network, order=network.order - 1))


@pytest.mark.full
def test_large_and_symmetric_networks_are_soon_compared() -> None:
    ladder = "-".join(f"p(R{i},C{i})" for i in range(1, 39))
    star = f"p({','.join(f'R{i}-C{i}' for i in range(1, 36))})"
    began = time.monotonic()
    for text in (ladder, star):
        network = network_of(text)
        assert is_same_network(network, renumbered(network, 1))
        assert not is_same_network(network, network_of(text.replace("C7", "L7")))
    assert time.monotonic() - began < 10


def rook(swapped: bool) -> Network:
    """Two regular graphs in which every node looks like every other: of 4 x 4 rooks, of
    Shrikhande.
    """
    steps = [(0, 1), (1, 0), (1, 1)] if swapped else [(0, 1), (0, 2), (1, 0), (2, 0)]
    cells = [(i, j) for i in range(4) for j in range(4)]
    joined = set[tuple[int, int]]()
    for i, j in cells:
        for a, b in steps:
            ends = sorted((4 * i + j, 4 * ((i + a) % 4) + (j + b) % 4))
            joined.add((ends[0] + 1, ends[1] + 1))
    masses = [Element(f"m{i}", "m", (i,)) for i in range(1, 17)]
    springs = [Element(f"k{a}_{b}", "k", (a, b)) for a, b in sorted(joined)]
    return Network((*masses, *springs), (Port(1),), (Port(1),), 2)


@pytest.mark.full
def test_regular_graphs_that_colours_alone_do_not_tell_apart() -> None:
    one, other = rook(False), rook(True)
    assert len(one.elements) == len(other.elements) == 64
    assert is_same_network(one, renumbered(one, 3)) and is_same_network(other, renumbered(other, 4))
    assert not is_same_network(one, other)


CHAIN = Chain(3, meas_plus=2, damped=True)
CELL = network_of("R0-p(R1,C1)")


@pytest.mark.thin(8)
@pytest.mark.parametrize(
    ("name", "model", "naming"),
    [
        ("R5-p(C2,R1)", CELL, "denoted"),
        ("R5-[C2,R1]", CELL, "denoted"),
        ("R(RC)", CELL, "denoted"),
        ("R(RC) 2", CELL, "denoted"),
        ("R1 1 2; R2 2 0; C1 2 0", CELL, "denoted"),
        ("R0-p(R1,L1)", CELL, "false"),
        ("R0-p(R1,C1)-R2", CELL, "false"),
        ("R(RC)(RC) 2", CELL, "false"),
        ("3:1", CELL, "false"),
        *((word, CELL, "free") for word in ("RC", "P1", "P1 2", "Lead-Lag", "cell", "α->", "A4")),
        ("R0-p(R1,C1", CELL, "free"),
        ("3:2", CHAIN, "denoted"),
        ("3:2 (damped, acceleration)", CHAIN, "denoted"),
        ("3:2 (undamped, acceleration)", CHAIN, "false"),
        ("3:2 (damped, velocity)", CHAIN, "false"),
        ("3:1", CHAIN, "false"),
        ("3:2+lag", CHAIN, "false"),
        ("3:999", CHAIN, "false"),
        ("999:1", CHAIN, "false"),
        ("(3 masses, gap 0, force 3-0, sensor 3-0, damped)", CHAIN, "false"),
        ("7=4=9; F7; S4", CHAIN, "denoted"),
        ("7=4=9; F7; S4; velocity", CHAIN, "false"),
        ("7=4=9; F7; S9", CHAIN, "false"),
        ("7~4~9; F7; S4", CHAIN, "false"),
        ("1=2=3; F1; S2", replace(CHAIN, lag=True), "false"),
        ("3:2+b3+lag", replace(CHAIN, lag=True, ground_dampers=(3,)), "denoted"),
        ("3:2+lag+b3", replace(CHAIN, lag=True, ground_dampers=(3,)), "denoted"),
        ("3:2", replace(CHAIN, quantity=Quantity.VELOCITY), "denoted"),
        ("1=2=3; F1; S2", replace(CHAIN, quantity=Quantity.VELOCITY), "denoted"),
    ],
)
def test_a_name_denotes_one_model_or_is_free(
    name: str, model: Chain | Network, naming: str
) -> None:
    assert naming_of(name, model) is Naming(naming)
