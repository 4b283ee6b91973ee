"""Rational functions are a field, and what is written of them is what is meant, as SymPy reads
it.

Factors of polynomials with coefficients of any size; the oracle is SymPy.
"""

import re
from math import prod

import pytest
import sympy
from hypothesis import given, settings, strategies as st

from disting.algebra.symbols import (
    RationalFunction,
    expression,
    factorise,
    latex,
    latex_symbol,
    symbols,
    text,
    variables,
)

X, Y = symbols(["x", "y"]).values()
SIZES = [2**30, 2**31, 2**32, 2**62, 2**63, 2**64, 2**200]


@pytest.mark.parametrize("size", SIZES)
def test_literal_factors_of_every_size(size):
    number, found = factorise(-12 * (X + size) * (X - size) * (X + size + 1) * (size * X + Y) ** 2)
    assert number == -12
    assert set(map(str, (f for f, e in found if e == 1))) == {
        f"x + {size}",
        f"x - {size}",
        f"x + {size + 1}",
    }
    assert [(str(f), e) for f, e in found if e == 2] == [(f"{size}*x + y", 2)]


def test_numbers_have_no_factors():
    assert factorise(0 * X + 2**70) == (2**70, [])


numbers = st.integers(-9, 9) | st.sampled_from([s + d for s in SIZES for d in (-1, 0, 1)])
terms = st.tuples(st.integers(0, 2), st.integers(0, 2), numbers)
polynomials = st.lists(st.lists(terms, min_size=1, max_size=3), min_size=1, max_size=3)


@pytest.mark.full
@settings(max_examples=40)
@given(polynomials)
def test_factors_are_those_of_sympy(sides):
    x, y = sympy.symbols("x y")
    ours, theirs = 0 * X + 1, sympy.Integer(1)
    for side in sides:
        ours *= sum((c * X**a * Y**b for a, b, c in side), 0 * X)
        theirs *= sum(c * x**a * y**b for a, b, c in side)
    if ours.is_zero():
        return
    number, found = factorise(ours)
    assert prod((f**e for f, e in found), start=0 * X + number) == ours
    _, wanted = sympy.factor_list(sympy.expand(theirs), x, y)
    spelled = {(sympy.sympify(str(f).replace("^", "**")).expand(), e) for f, e in found}
    assert spelled <= {((sign * f).expand(), e) for f, e in wanted for sign in (1, -1)}
    assert len(spelled) == len(found) == len(wanted)


RING = variables(["m1", "m2", "k12"])
leaves = st.sampled_from([*RING.values(), RING["m1"] / RING["m1"]])
trees = st.recursive(
    leaves,
    lambda inner: st.tuples(inner, inner, st.sampled_from("+-*/")).map(lambda t: combined(*t)),
    max_leaves=6,
)


def combined(a, b, sign):
    if sign == "/" and b.num.is_zero():
        return a
    return {"+": a.__add__, "-": a.__sub__, "*": a.__mul__, "/": a.__truediv__}[sign](b)


@pytest.mark.full
@settings(max_examples=60, deadline=None)
@given(trees)
def test_what_is_written_is_what_is_meant(function: RationalFunction):
    """The text, read by SymPy, is the expression; and both are num/den, as put into each other
    term by term.
    """
    names = {name: sympy.Symbol(name, positive=True) for name in RING}
    value = expression(function)
    num, den = (
        sympy.sympify(str(p).replace("^", "**"), locals=names) for p in (function.num, function.den)
    )
    assert (
        sympy.cancel(sympy.sympify(text(function), locals=names) - value)
        == 0
        == sympy.cancel(value - num / den)
    )


def test_latex():
    m1, m2, k12 = RING.values()
    assert latex(m1) == "m_{1}"
    assert latex((m1 - m2) / k12) == r"\frac{m_{1} - m_{2}}{k_{12}}"
    assert latex(-m1 * (m1 + m2 + m2) ** 3) == r"- m_{1} \left(m_{1} + 2 m_{2}\right)^{3}"
    assert latex(m1 / (k12 + k12)) == r"\frac{m_{1}}{2 k_{12}}"
    assert latex(RING["m1"] / RING["m1"]) == "1"


def printed_by_sympy(of):
    """LaTeX of a sum by SymPy's printer, which keeps an order only of what is built unevaluated;
    it writes a first number -1 without a space.
    """
    products = [
        sympy.Mul(
            *([c] if c != 1 or not powers else []),
            *(sympy.Pow(sympy.Symbol(n), e, evaluate=e == 1) for n, e in powers.items()),
            evaluate=False,
        )
        for c, powers in of
    ]
    found = sympy.Add(*products, evaluate=False)
    names = {x: latex_symbol(x.name) for x in found.free_symbols}
    return re.sub(r"^-(?=\d)", "- ", sympy.latex(found, order="none", symbol_names=names))


POWERS = st.dictionaries(
    st.sampled_from(["m1", "k9_10", "Td", "gain", "s"]),
    st.sampled_from([-2, -1, 1, 2, 3]),
    max_size=4,
)


@settings(max_examples=60, deadline=None)
@given(st.lists(st.tuples(st.sampled_from([-3, -1, 1, 2]), POWERS), max_size=3))
def test_sums_in_latex_are_what_sympy_prints(found):
    assert latex(found) == printed_by_sympy(found)


def test_signs_powers_and_brackets():
    m1, m2, k12 = RING.values()
    for function, python, tex in (
        (-(m1 + m2), "-(m1 + m2)", r"- \left(m_{1} + m_{2}\right)"),
        (m1**-2, "1/m1**2", r"\frac{1}{m_{1}^{2}}"),
        (
            m1 / (k12 * (m1 + m2)),
            "m1/(k12*(m1 + m2))",
            r"\frac{m_{1}}{k_{12} \left(m_{1} + m_{2}\right)}",
        ),
        (-(m1 - m2) / k12, "-(m1 - m2)/k12", r"- \frac{m_{1} - m_{2}}{k_{12}}"),
        ((m1 + m2) ** 2 / m2, "(m1 + m2)**2/m2", r"\frac{\left(m_{1} + m_{2}\right)^{2}}{m_{2}}"),
        (k12 / (m1 + m2), "k12/(m1 + m2)", r"\frac{k_{12}}{m_{1} + m_{2}}"),
    ):
        assert (text(function), latex(function)) == (python, tex)


def test_sums_keep_their_order_and_numbers_stay_before_sums():
    m1, m2, _ = RING.values()
    two = RING["m1"] / RING["m1"] + RING["m1"] / RING["m1"]
    assert text([(1, {"k12": 1, "m1": -1}), (1, {"k12": 1, "m2": -1})]) == "k12/m1 + k12/m2"
    assert text([(-1, {"m10": 1}), (3, {"m2": 2, "T1": -1}), (1, {})]) == "-m10 + 3*m2**2/T1 + 1"
    assert (text(two * (m1 + m2)), text(-(m1 + m2)), text((m1 - m1) * m2)) == (
        "2*(m1 + m2)",
        "-(m1 + m2)",
        "0",
    )
    assert (text(m1 / (two * two * m2)), text(-((m1 / m2) ** 2) / two)) == (
        "m1/(4*m2)",
        "-m1**2/(2*m2**2)",
    )
    assert [latex_symbol(name) for name in ("m1", "k9_10", "Td", "s")] == [
        "m_{1}",
        "k_{9,10}",
        "T_{d}",
        "s",
    ]


def test_symbols_are_positive_as_parameters_are():
    assert expression(RING["m1"]).is_positive and sympy.sqrt(
        expression(RING["m1"] ** 2)
    ) == expression(RING["m1"])


@settings(max_examples=60, deadline=None)
@given(trees, trees)
def test_equal_functions_are_equal_pairs(a: RationalFunction, b: RationalFunction):
    assert a + b - b == a and a - a - a == -a
    assert b.num.is_zero() or (a / b * b == a and b**-2 * b**3 == b)
    assert (a + b).den.leading_coefficient() > 0


def test_no_function_divides_by_zero():
    zero = RING["m1"] - RING["m1"]
    for divided in (
        lambda: RING["m1"] / zero,
        lambda: zero**-1,
        lambda: (RING["m1"] / RING["m2"]).value({"m1": 1, "m2": 0}),
    ):
        with pytest.raises(ZeroDivisionError):
            divided()


def test_factors_that_are_remembered_are_those_of_the_ring_and_stay_as_they_are():
    found = []
    for names in (("x", "y"), ("x", "z")):
        a, b = symbols(names).values()
        number, powers = factorise(2 * (a + b) ** 2)
        assert (number, powers) == (2, [(a + b, 2)])
        powers.clear()
        found.append(factorise(2 * (a + b) ** 2)[1])
    assert [str(powers[0][0]) for powers in found] == ["x + y", "x + z"]
