"""Constant phase elements: verdicts against programs that know nothing of weights, against numbers,
and against what is known of cells.
"""

import json
import random
from dataclasses import replace
from itertools import combinations, permutations

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from disting import InputError, Query, View, compare, identifiability, network_of, verify
from disting.fit.search.network_plant import NetworkPlant
from disting.general.any_model import cells_of, of_network
from disting.general.exponents import may_be_others
from disting.general.powers import Powers
from disting.model.question import Domain
from disting.network.families.circuits import circuits
from disting.verdict.model_equivalents import model_equivalents
from disting.verdict.verdict_file import verdict_file
from tests.oracles.plain_models import by_fibres
from tests.oracles.plain_network import plain
from tests.oracles.singular import PROGRAM

needs_singular = pytest.mark.skipif(not PROGRAM, reason="Singular is not installed")
WEIGHTS = (9, 63)  # of the oracle: larger than all powers of a product, and not ours
TEXTS = [text for text in circuits(5, "RCP", 5) if ";" not in text]
FEW = [text for text in circuits(4, "RCP", 4) if "P1" in text]


def relation(left: str, right: str, domain: Domain = Domain.COMPLEX) -> str:
    view = View.EXACT if domain is Domain.COMPLEX else View.POSITIVE
    return compare(left, right, query=Query(view)).relation.value


@pytest.mark.thin(1)
@pytest.mark.parametrize(
    ("left", "right", "same"),
    [
        # one element and one resistor more: two forms of one arc
        ("R0-p(R1,CPE1)", "p(R0,R1-CPE1)", True),
        # of two arcs with exponents of their own the ladder and the row are not the same, as they
        # are with capacitors
        ("R0-p(R1,P1)-p(R2,P2)", "p(R1,R2-P1,R3-P2)", False),
        ("R0-p(R1,P1)-p(R2,P2)", "R0-p(P1,R1-p(R2,P2))", False),
        # names and order of the exponents mean nothing
        ("R0-p(P1,R1-P2)", "R0-p(P2,R1-P1)", True),
        ("P1-p(C1,P2-p(C2,P3))", "P3-p(C1,P1-p(C2,P2))", True),
        # Randles' cell with a diffusion of Warburg inside or outside of the arc
        ("R0-p(R1-W1,P1)", "R0-p(R1,P1)-W1", False),
        ("R0-p(R1,C1)", "R0-p(R1,P1)", False),
    ],
)
def test_cells(left, right, same):
    expected = "indistinguishable" if same else "distinguishable"
    assert relation(left, right) == relation(left, right, Domain.POSITIVE) == expected


@pytest.mark.full
def test_arcs_that_share_an_exponent_are_like_arcs_of_capacitors():
    last = ["P2", 3, 0, "n"]
    a = _network([["R0", 1, 2], ["R1", 2, 3], ["P1", 2, 3, "n"], ["R2", 3, 0], last])
    b = _network([["R1", 1, 0], ["R2", 1, 2], ["P1", 2, 0, "n"], ["R3", 1, 3], last])
    assert a.exponents == b.exponents == ("n",)
    assert compare(a, b).relation.value == "indistinguishable"
    assert compare(a, network_of("R0-p(R1,P1)-p(R2,P2)")).relation.value == "distinguishable"


def _network(elements):
    from disting.network.notation.entries import network_of_entry

    return network_of_entry({"elements": elements, "port": [1, 0]}, "a network")


def impedance(text, values, s, phase):
    """Z by series and parallel connection of what the letters say, s^n by the number of its P."""
    elements = {
        "R": lambda x, _: x,
        "C": lambda x, _: 1 / (x * s),
        "L": lambda x, _: x * s,
        "P": lambda x, number: 1 / (x * phase[number]),
    }
    known = {name: elements[name[0]](x, name[1:]) for name, x in values.items()}
    return eval(text.replace("-", "+"), {"p": lambda *z: 1 / sum(1 / x for x in z)}, known)


def has_equivalent(given, other, order, draw):
    """Whether SymPy finds values of `other`, complex and not zero, for one point of `given`, s and
    the powers of s being independent symbols.
    """
    import sympy as sp

    names = [e.value for e in network_of(given).elements]
    theirs = [e.value for e in network_of(other).elements]
    s, *z = sp.symbols("s z1:4")
    q = sp.symbols(f"q1:{len(theirs) + 1}")
    point = {name: sp.Integer(draw.randrange(2, 60)) for name in names}
    mine = impedance(given, point, s, {str(i + 1): z[i] for i in range(3)})
    phase = {str(i + 1): z[k] for i, k in enumerate(order)}
    there = impedance(other, dict(zip(theirs, q, strict=True)), s, phase)
    (a, b), (c, d) = (sp.fraction(sp.cancel(x)) for x in (mine, there))
    equations = sp.Poly(sp.expand(a * d - b * c), s, *z).coeffs()
    spare = sp.Symbol("t")
    basis = sp.groebner([*equations, spare * sp.prod(q) - 1], spare, *q, order="grevlex")
    return basis.exprs != [1]


def pairs_of(texts, most):
    """Pairs with the same powers of s and s^n, in some order, and as many determined parameters, in
    a drawn order; all others are apart at a glance.
    """
    classes = {}
    for text in texts:
        model = of_network(network_of(text))
        powers = tuple(tuple(sorted(side)) for cell in cells_of(model) for side in cell)
        classes.setdefault((powers, identifiability(text).rank), []).append(text)
    found = [pair for like in classes.values() for pair in combinations(like, 2)]
    random.Random("pairs").shuffle(found)
    return found[:most]


@pytest.mark.slow
def test_verdicts_are_those_with_independent_symbols():
    draw, same = random.Random(2), 0
    for left, right in pairs_of(FEW, 16):
        count = len(network_of(left).exponents)
        orders = list(permutations(range(count)))
        true = any(
            has_equivalent(left, right, order, draw)
            and has_equivalent(right, left, [order.index(i) for i in range(count)], draw)
            for order in orders
        )
        assert relation(left, right) == ("indistinguishable" if true else "distinguishable")
        same += true
    assert 4 < same < 14


def agree_with_singular(pairs, least):
    draw, seen, same = random.Random(1), 0, 0
    for left, right in pairs:
        networks = network_of(left), network_of(right)
        names = [n.exponents for n in networks]
        found = []
        for order in permutations(names[1]):
            sides = zip(networks, (names[0], order), strict=True)
            asked = (plain(n, False, dict(zip(e, WEIGHTS, strict=False))) for n, e in sides)
            found.append(by_fibres(*asked, draw, 5.0))
        if None in found:
            continue
        true = any(x.same for x in found)
        assert relation(left, right) == ("indistinguishable" if true else "distinguishable")
        seen, same = seen + 1, same + true
    assert seen > least and same > least / 20, (seen, same)


@pytest.mark.full
@needs_singular
def test_verdicts_are_those_of_singular():
    agree_with_singular(pairs_of(FEW, 12), 8)


@needs_singular
@pytest.mark.slow
def test_verdicts_on_five_elements_are_those_of_singular():
    phases = [t for t in TEXTS if 1 <= t.count("P") <= 2]
    agree_with_singular(pairs_of(phases, 200), 150)


@pytest.mark.full
@settings(deadline=None, max_examples=15)
@given(st.sampled_from([t for t in TEXTS if t.count("P") > 1]), st.randoms(use_true_random=False))
def test_no_verdict_depends_on_names_and_order(text, draw):
    network = network_of(text)
    kinds = {letter: [e.value for e in network.elements if e.letter == letter] for letter in "RCP"}
    named = {}
    for letter, names in kinds.items():
        new = [f"{letter}{i + 3}" for i in range(len(names))]
        draw.shuffle(new)
        named |= dict(zip(names, new, strict=True))
    elements = [replace(e, value=named[e.value], exponent="") for e in network.elements]
    draw.shuffle(elements)
    other = replace(network, elements=tuple(elements), name="the same")
    assert compare(network, other).relation.value == "indistinguishable"
    assert identifiability(network).rank == identifiability(other).rank


@pytest.mark.thin(8)
@pytest.mark.parametrize("text", ["R0-p(R1-W1,P1)", *random.Random(3).sample(TEXTS, 25)])
def test_as_many_parameters_are_determined_as_spectra_show(text):
    """The rank of d Z by all parameters, exponents too, at more frequencies than parameters."""
    network = network_of(text)
    plant = NetworkPlant(network, np.logspace(-3, 3, 60))
    draw = np.random.default_rng(4)
    p = np.exp(draw.uniform(-1, 1, len(plant.parameters)))
    p[plant.highest < np.inf] = draw.uniform(0.3, 0.95, len(network.exponents))
    _, columns = plant.logarithmic_gradient(p)
    sizes = np.linalg.svd(np.vstack((columns.T.real, columns.T.imag)) * p, compute_uv=False)
    assert identifiability(network).rank == np.sum(sizes > 1e-9 * sizes[0])


@pytest.mark.full
def test_levels_of_exponents():
    one = identifiability("R0-p(R1,P1)")
    assert one.sentence == "4 parameters, all globally identifiable."
    two = identifiability("R0-p(R1,P1)-p(R2,P2)")
    assert two.sentence == (
        "7 parameters, all determinable; globally: R0; up to exchange: P1, P2, R1, R2, n1, n2;"
        " 2 sets of positive values fit: unique up to exchanging P1 ↔ P2, R1 ↔ R2, n1 ↔ n2."
    )
    lost = identifiability("R1 1 2; P1 2 0; P2 2 3")
    assert (lost.levels["n2"].value, lost.rank) == ("not identifiable", 3)
    assert (
        "other exponents may give the same response" in identifiability("R1-p(R2,P1,C1-P2)").reason
    )


def test_exponents_of_one_arc_can_be_no_others_between_0_and_1():
    for text in ("P1", "R0-p(R1,P1)", "R0-p(R1-W1,P1)", "R0-p(P1,R1-P2)"):
        model = of_network(network_of(text))
        assert not may_be_others(cells_of(model), model.powers)


def test_a_function_with_other_exponents_is_seen():
    """Of N = 1 + z + z w, D = 1 + z with s^m2 in the place of w and s^-m1 in that of z: both sides
    times z are of the same powers; m1 = -n1 is not between 0 and 1, 1 - n1 would be.
    """
    one = ((), 1)
    plain_side = {(0, 0): (one,), (0, 1): (one,)}
    assert not may_be_others([(plain_side, {(0, 1): (one,)})], Powers(weights=(("n1", 5),)))
    # z + s/z + 1 over 1: s^(1 - n1) does what s^n1 does
    twisted = {(0, 1): (one,), (1, -1): (one,), (0, 0): (one,)}
    assert may_be_others([(twisted, {(0, 0): (one,)})], Powers(weights=(("n1", 5),)))


@pytest.mark.full
def test_a_capacitor_a_resistor_and_a_warburg_element_are_limits():
    for text, exponent in (("R0-p(R1,C1)", "1"), ("R0-p(R1,W1)", "1/2"), ("R0-p(R1,R2)", "0")):
        found = compare("R0-p(R1,P1)", text)
        assert (found.relation.value, found.closure.value) == ("distinguishable", "right-in-left")
        assert f"with the exponent {exponent} of P1" in found.inclusions.closure.evidence.sentence(
            "A", "B"
        )
    assert compare("R0-p(R1,C1)-p(R2,C2)", "R0-p(R1,P1)").closure.value == "unknown"


def test_a_limit_is_approached():
    """Z of R0-p(R1,P1) at an exponent near 1 is near that of R0-p(R1,C1), P1 = C1."""
    omega = np.logspace(-1, 1, 20)
    there = NetworkPlant(network_of("R0-p(R1,C1)"), omega).response(np.array([2.0, 1.0, 3.0]))
    near = NetworkPlant(network_of("R0-p(R1,P1)"), omega).response(np.array([2.0, 1, 3, 1 - 1e-9]))
    np.testing.assert_allclose(near, there, rtol=1e-7)


def test_values_of_the_other_circuit_have_the_same_impedance_at_any_exponent():
    given, other = network_of("R0-p(R1,P1)"), network_of("p(R3,R4-P2)")
    values = {"R0": 1, "R1": 2, "P1": "1/2", "n1": "0.83"}
    (found,) = model_equivalents(given, [other], values)
    assert found.exponents == (("n2", "0.83"),)
    (there,) = found.values.equivalents
    s = 2.3j
    phase = {"1": s**0.83, "2": s**0.83}
    mine = impedance("R0-p(R1,P1)", {"R0": 1, "R1": 2, "P1": 0.5}, s, phase)
    theirs = impedance("p(R3,R4-P2)", {n: complex(x) for n, x in there.values.items()}, s, phase)
    assert mine == pytest.approx(theirs, rel=1e-12)


@pytest.mark.parametrize("wrong", ["x", "0", "1.5", -1])
def test_a_value_of_an_exponent_lies_between_0_and_1(wrong):
    values = {"R0": 1, "R1": 2, "P1": 3, "n1": wrong}
    with pytest.raises(InputError, match="n1 is an exponent: a number up to 1"):
        model_equivalents(network_of("R0-p(R1,P1)"), [network_of("p(R0,R1-P1)")], values)


def test_equivalents_do_not_mix_powers_of_s_and_of_its_root():
    other = network_of("R1 1 2; C1 2 0; W1 2 3")  # nothing flows through W1
    (found,) = model_equivalents(network_of("R0-C0"), [other], {"R0": 2, "C0": 3})
    there = found.values.equivalents[0].values
    assert (there["R1"], there["C1"]) == (2, 3)


@pytest.mark.full
def test_verdicts_are_checked_from_their_files():
    for left, right in (
        ("R0-p(P1,R1-P2)", "R0-p(P2,R1-P1)"),
        ("R0-p(R1,P1)", "R0-p(R1,C1)"),
        ("R0-p(R1,P1)-p(R2,P2)", "p(R1,R2-P1,R3-P2)"),
    ):
        data = json.loads(json.dumps(verdict_file(left, right)))
        assert verify(data).status.value == "holds"
        assert any("generic" in note for note in data["notes"])
        lie = data | {"notes": [n for n in data["notes"] if "generic" not in n]}
        assert verify(lie).status.value != "holds"


def test_the_transfer_function_is_written_with_its_exponents():
    assert str(of_network(network_of("R0-p(R1,P1)"))) == (
        "G(s) = (R0 + R1 + P1*R0*R1*s**n1)/(1 + P1*R1*s**n1)"
    )


@pytest.mark.parametrize(
    ("text", "notation"),
    [
        ("R0-p(R1,CPE1)", ""),
        ("R0-p(R1,P1)", "impedance"),
        ("R0-[R1,P1]", "autoeis"),
        ("R(RQ)", "boukamp"),
        ("R(R(CPE))", "boukamp"),
        ("R0 1 2; R1 2 0; P1 2 0", "spice"),
    ],
)
def test_all_notations_know_it(text, notation):
    if text == "R(R(CPE))":
        with pytest.raises(InputError, match="at least two parts are parallel"):
            network_of(text, notation)
        return
    found = network_of(text, notation)
    assert found.exponents == ("n1",) and relation(found, "R7-p(R8,P9)") == "indistinguishable"


@pytest.mark.parametrize(
    ("elements", "said"),
    [
        ([["CPE1", 1, 0]], "call it P1"),
        ([["P1", 1, 0, 0.5]], "as a text its exponent"),
        ([["P1", 1, 0, "1/2"]], "is not an exponent: use a name such as n1"),
        ([["P1", 1, 0, "R1"], ["R1", 1, 0]], "R1 is an exponent and something else"),
        ([["R1", 1, 0, "2"]], "needs two nodes other than the ground"),
        ([[f"P{i}", 1, 0] for i in range(5)], "4 different exponents at most, not 5"),
    ],
)
def test_bad_input(elements, said):
    with pytest.raises(InputError, match=said):
        of_network(_network(elements))


def test_a_network_is_an_entry_and_is_read_back():
    from disting.network.notation.entries import entry_of, network_of_entry

    for text in ("R0-p(R1,P1)", "R0-p(P1,R1-P2)"):
        network = network_of(text)
        assert network_of_entry(json.loads(json.dumps(entry_of(network))), "") == network
    shared = _network([["P1", 1, 2, "n"], ["P2", 2, 0, "n"]])
    assert entry_of(shared)["elements"][1] == ["P2", 2, 0, "n"]
