"""Combinations of equations with positive coefficients, against least squares from many starts that
know nothing of them.
"""

import random
from fractions import Fraction

import numpy as np
import pytest

from disting import Model, verify
from disting.general.any_model import of_network
from disting.general.combination import excludes
from disting.network.notation import network_of
from disting.verdict.verdict_file import verdict_file
from tests.network.test_fibre_lists import distance

STAR, LOOP = "1~2, 1~3; F1; S2", "1~2, 1~3, 2~3; F1; S2"
PAIRS = [
    (LOOP, STAR),
    ("#~1, 1~2, 1~3; F1; S3:2", "#~1, 1~2, 2~3; F1; S3:2"),
    ("R1-p(R2,C1-p(R3,L1))", "R1-p(R2-L1,R3-C1)"),
]


def drawn(model, draw):
    return {name: Fraction(draw.randint(1, 30), draw.randint(1, 30)) for name in model.parameters}


@pytest.mark.full
@pytest.mark.parametrize(
    "pair", [PAIRS[1], *(pytest.param(PAIRS[i], marks=pytest.mark.slow) for i in (0, 2))]
)
def test_no_search_finds_what_is_excluded(pair):
    given, other = (of_network(network_of(text)) for text in pair)
    draw, search, met = random.Random(pair[0]), np.random.default_rng(5), 0
    for _ in range(40):
        values = drawn(given, draw)
        if excludes(given, values, other):
            met += 1
            assert distance(given, values, other, search, 4) > 1e-7, values
        if met == 2:
            return
    assert met, "no point was excluded"


@pytest.mark.full
@pytest.mark.sampled(2)
@pytest.mark.parametrize("text", [STAR, LOOP, "R1-p(R2,C1-p(R3,L1))", "1>2, 2>1, 2>0; in 1; out 2"])
def test_nothing_excludes_its_own_values(text):
    model, draw = of_network(network_of(text)), random.Random(3)
    assert not any(excludes(model, drawn(model, draw), model) for _ in range(12))


def test_a_case_by_hand():
    """(s + a)(s + b) has real roots: s^2 + p s + q with p^2 < 4 q has none, p^2 > 4 q has."""
    roots = Model.from_transfer_function("1", "(s + a)*(s + b)")
    other = Model.from_transfer_function("1", "s**2 + p*s + q")
    assert excludes(other, {"p": Fraction(1), "q": Fraction(1)}, roots)
    assert not excludes(other, {"p": Fraction(3), "q": Fraction(1)}, roots)
    # a root that cancels leaves fewer equations than the theorem asks for
    cancels = Model.from_transfer_function("s + c", "(s + a)*(s + b)")
    assert not excludes(cancels, dict.fromkeys("abc", Fraction(1)), cancels)


@pytest.mark.slow
def test_force_and_sensor_apart_and_more_values_than_are_determined():
    data = verdict_file(STAR, LOOP)
    assert data["relation"] == "sometimes"
    assert verify(data).sentence == "holds"
    inner = data["evidence"]["inner"]
    forged = inner | {"point_without": inner["point_with"]}
    changed = data | {"evidence": data["evidence"] | {"inner": forged}}
    assert verify(changed).status.value == "does not hold"
