"""One pair has one strength, whoever asks and however its models are written: by text, as networks,
as models, in a file of evidence, in other numbers and names, with the sides exchanged.
"""

import json
from dataclasses import replace
from itertools import combinations
from random import Random

import pytest
import sympy

from disting import Engine, Family, compare, verify
from disting.catalogs.network_files import name_of as file_of, read
from disting.files import shipped_folder
from disting.general.any_model import of_network
from disting.general.matrix_model import Model
from disting.model.names import name_of
from disting.network import network_of
from disting.network.families import family_of
from disting.network.network import Network, Port, renumber
from disting.store.store import Store
from disting.verdict.result import Relation, Verdict
from disting.verdict.verdict_file import verdict_file
from disting.verdict.verification import Status

FAMILIES = (
    "machines-2",
    "machines-2-damped",
    "machines-3",
    "trees-4",
    "circuits-4",
    "circuits-5",
    "cells-4",
    "cells-5",
    "compartments-2",
    "compartments-3",
)
TURNED = {"left-in-right": "right-in-left", "right-in-left": "left-in-right"}


def strength(verdict):
    """What a reader may rely on."""
    return (
        verdict.relation,
        verdict.domain,
        verdict.has_exceptions,
        verdict.image,
        verdict.closure,
        verdict.certainty,
    )


def turned(verdict):
    """The same of the pair in the other order."""
    relation, domain, exceptions, *inclusions, certainty = strength(verdict)
    return (relation, domain, exceptions, *(TURNED.get(x, x) for x in inclusions), certainty)


def drawn(random, family):
    """Two networks of a family: half of the pairs are the same over complex parameters."""
    networks = family_of(family).networks
    if random.random() < 0.5:
        return random.sample(list(networks), 2)
    records = read(shipped_folder() / f"{file_of(family)}.jsonl")[1 + len(networks) :]
    record = random.choice(records)
    return networks[record["left"] - 1], networks[record["right"] - 1]


def rewritten(random, network):
    """The same network with nodes in other numbers, elements in another order and other names."""
    places = dict(zip(network.nodes, random.sample(network.nodes, len(network.nodes)), strict=True))
    places[0] = 0
    labels = random.sample(range(20, 40), len(network.elements))
    elements = [
        replace(renumber(places, e), value=e.value and f"{e.letter}{label}")
        for e, label in zip(network.elements, labels, strict=True)
    ]
    random.shuffle(elements)
    ports = (
        tuple(Port(places[p.plus], places[p.minus]) for p in side)
        for side in (network.inputs, network.outputs)
    )
    return Network(tuple(elements), *ports, network.order, "redrawn")


def from_file(left, right, engine):
    """The verdict of a file of evidence, which holds."""
    data = json.loads(json.dumps(verdict_file(left, right, engine=engine)))
    assert verify(data).status is Status.HOLDS
    return Verdict.from_dict(data)


def doors(random, left, right, folder):
    """Yield each door and its verdict on two networks."""
    texts = [network.name for network in (left, right)]
    yield "text", compare(*texts)
    yield "networks of texts", compare(*map(network_of, texts))
    yield "models", compare(of_network(left), of_network(right))
    yield "text and model", compare(texts[0], of_network(right))
    for state in ("cold", "warm"):
        with Store.open(str(folder / "cache.sqlite3")) as store:
            yield f"{state} cache", compare(left, right, engine=Engine(store=store))
    yield "file", from_file(left, right, Engine())
    yield "redrawn", compare(rewritten(random, left), rewritten(random, right))


def refuse_differences(random, family, folder):
    """All doors say the same of a drawn pair."""
    left, right = drawn(random, family)
    first = compare(left, right)
    for door, verdict in doors(random, left, right, folder):
        assert strength(verdict) == strength(first), (left.name, right.name, door)
    assert turned(compare(right, left)) == strength(first), (left.name, right.name, "turned")


@pytest.mark.full
@pytest.mark.parametrize("family", ["machines-2", "circuits-4", "cells-4", "compartments-2"])
def test_drawn_networks(family, tmp_path):
    refuse_differences(Random(family), family, tmp_path)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(16))
@pytest.mark.parametrize("family", FAMILIES)
def test_more_drawn_networks(family, seed, tmp_path):
    refuse_differences(Random(f"{family} {seed}"), family, tmp_path)


def as_functions(random, model):
    """Its transfer function alone, as SymPy writes it, in parameters of other names."""
    names = [f"x{i}" for i in range(len(model.parameters))]
    random.shuffle(names)
    new = {sympy.Symbol(p): sympy.Symbol(n) for p, n in zip(model.parameters, names, strict=True)}
    sides = sympy.fraction(sympy.together(model.expression()))
    return Model.from_transfer_function(*(side.subs(new, simultaneous=True) for side in sides))


@pytest.mark.sampled(2)
@pytest.mark.full
@pytest.mark.parametrize("family", ["machines-2", "circuits-4", "compartments-2"])
def test_a_bare_transfer_function_is_never_told_more(family):
    """Theorems speak of networks, so it may stay undecided, but it is told no other relation, and
    no fewer exceptions.
    """
    random = Random(family)
    for _ in range(6):
        left, right = drawn(random, family)
        known = compare(left, right)
        bare = compare(*(as_functions(random, of_network(n)) for n in (left, right)))
        if bare.relation is not Relation.UNDECIDED:
            assert bare.relation == known.relation, (left.name, right.name)
            assert bare.has_exceptions or not known.has_exceptions, (left.name, right.name)


@pytest.mark.full
@pytest.mark.parametrize("n", [2, pytest.param(3, marks=pytest.mark.slow)])
def test_a_chain_is_told_as_much_as_its_transfer_function(n):
    random = Random(n)
    for left, right in combinations(Family(n, damped=False), 2):
        known = compare(left, right)
        bare = compare(*(as_functions(random, Model.from_chain(c)) for c in (left, right)))
        if bare.relation is Relation.INDISTINGUISHABLE:
            assert known.relation is bare.relation
            assert bare.has_exceptions or not known.has_exceptions, (left, right)


@pytest.mark.full
def test_compartments_that_leak_elsewhere_have_one_strength():
    """By text a theorem says so, special values aside; the map has no exception."""
    texts = "1<>2, 1>0; in 1; out 1", "1<>2, 2>0; in 1; out 1"
    matrices = (
        Model.from_state_space([["-k12 - k10", "k21"], ["k12", "-k21"]], [1, 0], [1, 0]),
        Model.from_state_space([["-k12", "k21"], ["k12", "-k21 - k20"]], [1, 0], [1, 0]),
    )
    verdicts = [compare(*texts), compare(*map(network_of, texts)), compare(*matrices)]
    assert len({strength(v) for v in verdicts}) == 1 and not verdicts[0].has_exceptions
    assert "positive for all positive parameters" in verdicts[0].sentence


def test_a_chain_and_its_text_as_a_machine_have_one_strength():
    chain = Family(3, damped=False)[1]
    other = Family(3, damped=False)[2]
    found = [
        compare(chain, other),
        compare("1~2~3; F1; S1", other),
        compare(network_of("1~2~3; F1; S1"), other),
        compare(Model.from_chain(chain), other),
    ]
    assert len({strength(v) for v in found}) == 1
    assert compare(chain, "1~2~3; F1; S1").relation is Relation.INDISTINGUISHABLE
    assert name_of(chain) == "3:1"
