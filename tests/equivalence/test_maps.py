"""Formulas between structures, judged by SymPy."""

import pytest
import sympy

from disting.algebra.certainty import Certainty
from disting.algebra.symbols import text, variables
from disting.equivalence import equivalents, explicit_map
from disting.equivalence.checks import holds_at_random, is_identity
from disting.model.chain import Chain
from disting.model.family import Family

S = sympy.Symbol("s")


def receptance(chain, values):
    """The textbook way."""
    n = chain.n_masses
    a = sympy.zeros(n, n)
    for name, value in values.items():
        if name[0] == "m":
            a[int(name[1:]) - 1, int(name[1:]) - 1] += value * S**2
        else:
            i, j = (int(digit) for digit in name[1:3])
            v = sympy.Matrix([int(node == j) - int(node == i) for node in range(1, n + 1)])
            a += value * (S if name[0] == "d" else 1) * v * v.T
    force, sensor = (
        [int(i == plus) - int(i == minus) for i in range(1, n + 1)] for plus, minus in _ports(chain)
    )
    return (sympy.Matrix([sensor]) * a.LUsolve(sympy.Matrix(force)))[0]


def _ports(chain):
    return (chain.act_plus, chain.act_minus), (chain.meas_plus, chain.meas_minus)


@pytest.mark.full
@pytest.mark.parametrize(
    ("n", "left", "right", "damped"),
    [
        (2, 1, 3, True),
        (3, 1, 11, True),
        (3, 2, 5, True),
        (3, 4, 1, False),
        (3, 4, 11, False),
        (3, 6, 1, False),
        (3, 8, 11, False),
    ],
)
def test_formulas_give_the_same_transfer_function(n, left, right, damped):
    family = Family(n, damped)
    found = explicit_map(family[left], family[right])
    symbols = {name: sympy.Symbol(name, positive=True) for name in family[left].parameters}
    numbers = {
        symbol: sympy.Rational(3 * i + 2, i + 1) for i, symbol in enumerate(symbols.values())
    }
    ours = receptance(family[right], {name: f.subs(numbers) for name, f in found.sympy().items()})
    given = receptance(family[left], {name: numbers[symbol] for name, symbol in symbols.items()})
    assert sympy.cancel(ours - given) == 0
    assert found.certainty is Certainty.PROVEN


@pytest.mark.full
def test_two_masses_in_full_by_sympy():
    chain, other = Family(2, True)[1], Family(2, True)[3]
    found = explicit_map(chain, other)
    symbols = {name: sympy.Symbol(name, positive=True) for name in chain.parameters}
    assert sympy.cancel(receptance(other, found.sympy()) - receptance(chain, symbols)) == 0
    assert found.text.splitlines() == [
        "m1'  = m1*(m1 + m2)/m2",
        "m2'  = m1 + m2",
        "k01' = k12*(m1 + m2)**2/m2**2",
        "d01' = d12*(m1 + m2)**2/m2**2",
    ]
    assert r"m_{1}' &= \frac{m_{1} \left(m_{1} + m_{2}\right)}{m_{2}} \\" in found.latex


@pytest.mark.full
def test_duality_of_eight_masses_is_checked_with_a_bound():
    found = explicit_map(Chain(8, damped=True), Chain(8, 7, 7, 8, 7, 8, damped=True))
    assert found.certainty is Certainty.BOUNDED and found.safety >= 240
    assert text(found.formulas["m8"]) == "m1 + m2 + m3 + m4 + m5 + m6 + m7 + m8"


def test_part_by_part():
    """Both rows have two masses; the grounded one is seen from the gap."""
    chain, other = Chain(4, 2, 1, 3, 1, 3, damped=False), Chain(4, 2, 2, 3, 2, 3, damped=False)
    found = explicit_map(chain, other)
    assert tuple(text(found.formulas[name]) for name in ("m3", "m2", "k12")) == (
        "m3",
        "m1",
        "k01 + k12",
    )


def test_where_there_is_none():
    family = Family(3, True)
    assert explicit_map(family[1], family[4]) is None
    assert (
        explicit_map(Family(3, damped=False)[1], Family(3, damped=False)[4]) is None
    )  # roots are needed
    assert explicit_map(family[1], family[1]) is None
    assert explicit_map(Chain(3, lag=True, damped=False), Chain(3, damped=False)) is None


def test_to_itself():
    chain = Chain(3, 0, 0, 2, 0, 2, damped=False)
    assert explicit_map(chain, chain).text.splitlines()[0] == "m1'  = m3"
    dual = Chain(3, 1, 1, 2, 1, 2, damped=True)
    assert explicit_map(dual, dual) is not None


def test_wrong_formulas_are_refused():
    chain, other = Family(3, True)[1], Family(3, True)[11]
    good = explicit_map(chain, other).formulas
    names = variables(["s", *chain.parameters])
    wrong = good | {"m1": good["m1"] + names["m1"] - names["m2"]}
    assert is_identity(chain, other, good) and holds_at_random(chain, other, good, "test")
    assert not is_identity(chain, other, wrong) and not holds_at_random(chain, other, wrong, "test")


def test_values_of_a_map_are_those_of_the_search():
    values = {"m1": 1, "m2": 2, "m3": 3, "k12": 100, "k23": 70, "d12": "0.1", "d23": 0.3}
    (member,) = equivalents("3:1", values, "3:11", damped=True)
    image = explicit_map(Family(3, True)[1], Family(3, True)[11]).at(values)
    assert {name: str(v) for name, v in image.items()} == {
        name: str(v) for name, v in member.exact.items()
    }


def test_python_source_runs():
    found = explicit_map(Family(3, damped=False)[4], Family(3, damped=False)[1])
    space = {}
    exec(found.python, space)
    assert all(
        sympy.simplify(space["equivalent"][name] - f) == 0 for name, f in found.sympy().items()
    )
