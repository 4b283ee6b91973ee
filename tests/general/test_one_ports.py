"""One-ports of two kinds of elements against Foster and Cauer, by circuits written in plain
SymPy.
"""

from itertools import combinations

import pytest
import sympy as sp

from disting import Certainty, Query, Relation, View, compare
from disting.evidence.conditions import Renaming
from disting.evidence.decision import Theorem
from disting.evidence.general import Explicit
from disting.general.matrix_model import Model
from disting.general.one_ports import fills, same_one_ports


def parallel(*impedances):
    return 1 / sum(1 / sp.sympify(z) for z in impedances)


def c(name):
    return 1 / (sp.Symbol("s") * sp.Symbol(name))


def r(name):
    return sp.Symbol(name)


def model(impedance, name):
    return Model.from_transfer_function(
        *map(sp.expand, sp.fraction(sp.together(impedance))), name=name
    )


def ladder(n):
    z = parallel(c(f"C{n}"), r(f"R{n}"))
    for i in range(n - 1, 0, -1):
        z = parallel(c(f"C{i}"), r(f"R{i}") + z)
    return z


def voigt(n):
    return sum(parallel(r(f"R{i}"), c(f"C{i}")) for i in range(1, n + 1))


PLAIN = {
    "Voigt": voigt(2),
    "ladder": ladder(2),
    "branch": parallel(c("C1"), r("R1"), r("R2") + c("C2")),
    "nested": parallel(r("R1"), c("C1") + parallel(r("R2"), c("C2"))),
}
SERIES = {name: r("R0") + z for name, z in PLAIN.items()} | {
    "branches": parallel(r("R0"), r("R1") + c("C1"), r("R2") + c("C2"))
}
BLOCKING = {
    "Voigt": r("R1") + c("C1") + parallel(r("R2"), c("C2")),
    "ladder": r("R1") + parallel(c("C1"), r("R2") + c("C2")),
    "branches": parallel(r("R1") + c("C1"), r("R2") + c("C2")),
}
PAIRS = [pair for group in (PLAIN, SERIES, BLOCKING) for pair in combinations(group.values(), 2)]


@pytest.mark.full
@pytest.mark.sampled(5)
@pytest.mark.parametrize(("left", "right"), PAIRS)
def test_all_pairs_of_two_rc_one_ports_are_the_same(left, right):
    verdict = compare(model(left, "left"), model(right, "right"), query=Query(view=View.POSITIVE))
    assert verdict.relation is Relation.INDISTINGUISHABLE
    assert isinstance(verdict.evidence, (Explicit, Theorem, Renaming))
    assert verdict.certainty in (Certainty.PROVEN, Certainty.THEOREM)


@pytest.mark.full
@pytest.mark.parametrize("n", [1, 3, 4])
def test_chains_of_more(n):
    assert same_one_ports(model(voigt(n), "Voigt"), model(ladder(n), "ladder"))


@pytest.mark.full
def test_rl_and_lc_by_their_own_elements():
    s = sp.Symbol("s")
    rl = {"Foster": sum(parallel(r(f"R{i}"), s * r(f"L{i}")) for i in (1, 2))}
    rl["Cauer"] = parallel(r("R1"), s * r("L1") + parallel(r("R2"), s * r("L2")))
    assert same_one_ports(*(model(z, name) for name, z in rl.items()))
    lc = {"Foster": sum(parallel(c(f"C{i}"), s * r(f"L{i}")) for i in (1, 2))}
    lc["Cauer"] = parallel(c("C1"), s * r("L1") + parallel(c("C2"), s * r("L2")))
    assert same_one_ports(*(model(z, name) for name, z in lc.items()))
    assert not same_one_ports(model(rl["Foster"], "RL"), model(PLAIN["Voigt"], "RC"))


def test_one_element_too_few_or_a_sign_is_no_one_port_of_this_kind():
    assert fills(model(PLAIN["Voigt"], "Voigt"))
    assert not fills(Model.from_transfer_function("a*b", "(s + a)*(s + b)"))
    assert not fills(Model.from_transfer_function("1", "s**2 + a*s + b"))
    assert not fills(Model.from_transfer_function("s + z", "s**2 + a*s + b"))
    # R at s = oo is more than R1
    with_bound = model(r("R0") + r("R1") + parallel(r("R1"), c("C1")), "bound")
    assert not fills(with_bound)


@pytest.mark.full
def test_a_bound_makes_it_sometimes():
    free, bound = (
        model(r("R0") + parallel(r("R1"), c("C1")), "free"),
        model(r("R0") + r("R1") + parallel(r("R1"), c("C1")), "bound"),
    )
    assert compare(free, bound, query=Query(view=View.POSITIVE)).relation is Relation.SOMETIMES


@pytest.mark.full
@pytest.mark.parametrize("seed", range(3))
def test_interlacing_in_numbers(seed):
    """Poles and zeros of the ladder at random values interlace, as the theorem has it."""
    z = ladder(3).subs(
        {
            f"{kind}{i}": sp.Rational(1 + (7 * i + 3 * seed) % 5, 1 + (i + seed) % 3)
            for kind in "RC"
            for i in (1, 2, 3)
        }
    )
    num, den = sp.fraction(sp.together(z))
    zeros, poles = (
        sorted(map(float, sp.Poly(side, sp.Symbol("s")).nroots())) for side in (num, den)
    )
    assert (
        all(a < b < c for a, b, c in zip(poles, zeros, poles[1:], strict=False)) and poles[-1] < 0
    )
