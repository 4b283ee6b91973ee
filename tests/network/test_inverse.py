"""A network at 1/s, by Kirchhoff's and Newton's laws; and verdicts that rest on it."""

import json
import random

import numpy as np
import pytest

from disting import compare, verify
from disting.evidence.general import AtInverse
from disting.network.families import family_of
from disting.network.inverse import at_inverse
from disting.network.notation import network_of
from disting.verdict.verdict_file import verdict_file
from tests.oracles.plain_network import equations

LEFT, RIGHT = "#~1, 1~2, 2~3; F2; S2:1", "#~1, 1~2, 2~3; F2:1; S3:1"


def response(network, values, s):
    at = dict(zip([e.value for e in network.elements], values, strict=True))
    a, b, c = (
        np.array(side, dtype=complex) for side in equations(network, at.__getitem__, s, np.sqrt(s))
    )
    return (c @ np.linalg.solve(a, b.T)) * s**network.order


@pytest.mark.parametrize("family", ["circuits-4", "machines-2", "machines-2-damped", "machines-3"])
def test_the_response_at_1_over_s(family):
    """Inductance and capacitance become the inverse of each other, all else keeps its value."""
    draw = random.Random(family)
    networks = family_of(family).networks
    for network in draw.sample(networks, 12):
        other = at_inverse(network)
        values = [draw.uniform(0.5, 2) for _ in network.elements]
        theirs = [
            1 / x if e.letter in "LC" else x for x, e in zip(values, network.elements, strict=True)
        ]
        halves = 2 if family.startswith("machines") else 0
        for s in (0.4 + 0.9j, 1.7j, 3.1):
            mine = response(network, values, 1 / s)
            there = response(other, theirs, s) * s ** (halves - 2 * network.order)
            assert np.allclose(mine, there, rtol=1e-9), network.name


@pytest.mark.parametrize(
    "text", ["R1-p(W1,C1)", "R1-p(R2,P1)", "1>2, 2>1; in 1; out 1", "1~2*g; F1; S2"]
)
def test_without_a_counterpart_there_is_none(text):
    assert at_inverse(network_of(text)) is None


def test_what_one_pair_leaves_open_the_other_one_decides():
    found = compare(LEFT, RIGHT)
    assert found.relation.value == "sometimes" and isinstance(found.evidence, AtInverse)
    assert "With 1/s for s" in found.sentence
    assert type(found).from_dict(json.loads(json.dumps(found.to_dict()))) == found


def test_circuits_with_inductors_are_told_as_those_with_capacitors():
    pair = "R1-p(R2,L1-p(R3,L2))", "L1 1 2; R1 1 3; R2 2 3; R3 2 0; L2 3 0"
    twins = (text.replace("L", "C") for text in pair)
    assert compare(*pair).relation is compare(*twins).relation
    assert compare(*pair).relation.value == "sometimes"


def test_its_evidence_is_checked():
    data = verdict_file(LEFT, RIGHT)
    assert verify(data).sentence == "holds"
    for name, value in (("left", data["evidence"]["right"]), ("right", "R1")):
        forged = data | {"evidence": data["evidence"] | {name: value}}
        assert verify(forged).standing.value == "does not hold"
    inner = data["evidence"]["inner"]
    changed = json.loads(json.dumps(data))
    point = (inner.get("inner") or inner)["point_with"]
    place = changed["evidence"]["inner"]
    (place.get("inner") or place)["point_with"] = [[point[0][0], "7/5"], *point[1:]]
    assert verify(changed).standing.value == "does not hold"
