"""What remains of networks, against numbers: elements that are nearly missing or nearly rigid."""

from dataclasses import replace
from fractions import Fraction
from itertools import combinations, permutations, product

import pytest

from disting import compare
from disting.evidence.limits import Minor
from disting.general.any_model import of_network
from disting.general.model_inclusions import confirms_inclusion
from disting.network import Port, network_of
from disting.network.branches import branches, remainder, rest_of
from disting.network.families import family_of
from disting.network.minors import minors
from tests.oracles.plain_network import response

ROOT = Fraction(7, 5)
TINY = Fraction(1, 10**60)
CLOSE = Fraction(1, 10**30)


def seen(network, values):
    return response(network, values, ROOT)[0][0]


def ways(whole, size):
    """Which values are left, and extreme values for the others."""
    for kept in combinations(whole.parameters, size):
        gone = [name for name in whole.parameters if name not in kept]
        for extremes in product((TINY, 1 / TINY), repeat=len(gone)):
            yield kept, dict(zip(gone, extremes, strict=True))


def comes_near(part, whole):
    """Whether the whole with extreme values shows what the part does, values of one kind exchanged.

    Every order of the part's values is tried: slow, and nothing of graphs is known here.
    """
    numbers = [Fraction(n) for n in (2, 3, 5, 7, 11)][: len(part.parameters)]
    wanted = seen(part, dict(zip(part.parameters, numbers, strict=True)))
    for kept, extremes in ways(whole, len(part.parameters)):
        for order in permutations(numbers):
            mine, there = zip(kept, order, strict=True), zip(part.parameters, numbers, strict=True)
            kinds = {(name[0], x) for name, x in mine} == {(name[0], x) for name, x in there}
            if kinds:
                got = seen(whole, {**dict(zip(kept, order, strict=True)), **extremes})
                if got is not None and abs(got - wanted) < CLOSE * abs(wanted):
                    return True
    return False


def pairs(name, step):
    networks = family_of(name).networks
    found = [
        (part, whole)
        for part, whole in product(networks, networks)
        if len(part.parameters) < len(whole.parameters)
        and {p[0] for p in part.parameters} <= {p[0] for p in whole.parameters}
    ]
    return found[::step]


@pytest.mark.full
@pytest.mark.parametrize(
    ("family", "step"),
    [
        ("cells-4", 47),
        ("circuits-4", 31),
        pytest.param("cells-4", 1, marks=pytest.mark.slow),
        pytest.param("circuits-4", 1, marks=pytest.mark.slow),
    ],
)
def test_a_one_port_is_what_remains_of_another_one_exactly_where_numbers_show_it(family, step):
    counts = {True: 0, False: 0}
    for part, whole in pairs(family, step):
        told = remainder(part, whole)
        assert (told is not None) == comes_near(part, whole), f"{part.name} in {whole.name}"
        if next(minors(part.grounded, whole.grounded), None) is not None:
            assert told is not None, f"{part.name} in {whole.name}"
        if told is not None:
            assert branches(part) == rest_of(whole, *told)
        counts[told is not None] += 1
    assert min(counts.values()) > 3, counts


@pytest.mark.parametrize(
    ("part", "whole"),
    [
        ("W1-R1", "R1-p(W1,C1)"),
        ("p(R1,C1)-R0", "R0-p(R1,C1)-p(R2,C2)"),
        ("R0-p(C1,L1)", "p(L1-R1,C1)-R0-C2"),
    ],
)
def test_the_order_of_branches_in_series_does_not_matter(part, whole):
    verdict = compare(part, whole)
    assert verdict.closure.value == "left-in-right"
    assert verdict.inclusions.closure.certainty.value == "theorem"


def test_forged_evidence_of_missing_elements_does_not_hold():
    part, whole = (of_network(network_of(t)) for t in ("W1-R1", "R1-p(W1,C1)"))
    true = Minor(True, (), ("C1",), ())
    assert confirms_inclusion(true, part, whole, True)
    assert not confirms_inclusion(true, whole, part, True)
    assert not confirms_inclusion(true, part, whole, False)
    for missing, rigid in (((), ("C1",)), (("W1",), ()), (("C2",), ()), ((), ()), (("R1",), ())):
        assert not confirms_inclusion(
            replace(true, missing=missing, rigid=rigid), part, whole, True
        )
    (out,) = whole.network.outputs
    turned = replace(whole.network, outputs=(Port(out.minus, out.plus),))
    assert not confirms_inclusion(true, part, of_network(turned), True)


def test_bridges_and_networks_with_force_and_sensor_apart_have_no_branches():
    bridge = network_of("C1 1 2; R1 1 3; R2 2 3; R3 2 0; C2 3 0")
    gone = remainder(network_of("R1-C1"), bridge)
    assert branches(bridge) is None
    assert gone is not None and rest_of(bridge, *gone) == branches(network_of("C1-R1"))
    assert remainder(network_of("1~2; F1; S2"), network_of("1~2~3; F1; S2")) is None
