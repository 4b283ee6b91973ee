"""A network at 1/s, by Kirchhoff's and Newton's laws; and verdicts that rest on it."""

import random
from dataclasses import replace

import numpy as np
import pytest

from disting import compare
from disting.conditions.rule import ADMISSIBLE, Finding, Outcome
from disting.evidence.general import AtInverse, Replacement
from disting.general.any_model import of_network
from disting.general.forms import by_inverse, confirms_forms
from disting.model.question import Settings
from disting.network.families import family_of
from disting.network.inverse import at_inverse
from disting.network.notation import network_of
from tests.oracles.plain_network import equations

LEFT, RIGHT = "#~1, 1~2, 2~3; F2; S2:1", "#~1, 1~2, 2~3; F2:1; S3:1"


def response(network, values, s):
    at = dict(zip([e.value for e in network.elements], values, strict=True))
    a, b, c = (
        np.array(side, dtype=complex) for side in equations(network, at.__getitem__, s, np.sqrt(s))
    )
    return (c @ np.linalg.solve(a, b.T)) * s**network.order


@pytest.mark.full
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


@pytest.fixture(scope="module")
def asked():
    """Both models, and what the pair with 1/s for s says of them."""
    left, right = (of_network(network_of(text)) for text in (LEFT, RIGHT))
    return left, right, by_inverse(left, right, Settings())


@pytest.mark.slow
def test_the_other_pair_says_the_same(asked):
    _, _, found = asked
    assert found.outcome is Outcome.SOMETIMES and isinstance(found.evidence, AtInverse)
    assert "With 1/s for s" in found.evidence.sentence("A", "B")
    assert Finding.from_json(found.to_json(), rule=ADMISSIBLE) == found
    assert compare(LEFT, RIGHT).relation.value == "sometimes"


@pytest.mark.full
def test_circuits_with_inductors_are_told_as_those_with_capacitors():
    pair = "R1-p(R2,L1-p(R3,L2))", "L1 1 2; R1 1 3; R2 2 3; R3 2 0; L2 3 0"
    twins = (text.replace("L", "C") for text in pair)
    assert compare(*pair).relation is compare(*twins).relation
    assert compare(*pair).relation.value == "sometimes"


@pytest.mark.full
def test_its_evidence_is_checked(asked):
    left, right, found = asked
    evidence = found.evidence
    assert confirms_forms(evidence, left, right, "tf")
    for forged in (replace(evidence, left=evidence.right), replace(evidence, right="R1")):
        assert not confirms_forms(forged, left, right, "tf")
    inner = evidence.inner
    whole = isinstance(inner, Replacement)
    points = inner.inner if whole else inner
    lie = replace(
        points, point_without=points.point_with, without_left_given=points.with_left_given
    )
    changed = replace(evidence, inner=replace(inner, inner=lie) if whole else lie)
    assert not confirms_forms(changed, left, right, "tf")
