"""Formulas of the pages: the mathematics that a browser typesets is the transfer function, and
the LaTeX says the same.
"""

import re
from itertools import product
from xml.etree import ElementTree

import pytest
import sympy
from hypothesis import given, settings

from disting.algebra.symbols import RationalFunction, variables
from disting.behaviour.transfer import expand
from disting.catalogs import catalog
from disting.equivalence.duplicates import Assignment
from disting.model.chain import Chain
from disting.model.family import Family
from disting.report.formulas import (
    correspondence,
    expression,
    prime,
    summands,
    symbol,
    transfer_function_parts,
    written_values,
)
from tests.algebra.test_symbols import trees as rational_functions

FAMILIES = [Family(n, damped) for n, damped in product((1, 2, 3, 4), (False, True))]


def value(element: ElementTree.Element) -> sympy.Expr:
    """Independent reader of presentation MathML: products by juxtaposition, sums by signs."""
    parts = list(element)
    match element.tag:
        case "mi":
            return sympy.Symbol(str(element.text))
        case "mn":
            return sympy.Integer(int(str(element.text)))
        case "msub":
            return sympy.Symbol(str(parts[0].text) + str(parts[1].text))
        case "msup":
            return value(parts[0]) ** value(parts[1])
        case "msubsup":
            return sympy.Symbol(str(parts[0].text) + str(parts[1].text)) ** value(parts[2])
        case "msqrt":
            return sympy.sqrt(row(parts))
        case "mfrac":
            return value(parts[0]) / value(parts[1])
        case _:
            return row(parts)


def row(parts: list[ElementTree.Element]) -> sympy.Expr:
    total, factor = sympy.Integer(0), None
    sign = sympy.Integer(1)
    for part in parts:
        if part.tag == "mo" and part.text in "+−":
            total, factor = total + (sign * factor if factor is not None else 0), None
            sign = sympy.Integer(1 if part.text == "+" else -1)
        elif part.tag != "mo":
            factor = value(part) * (1 if factor is None else factor)
    return total + sign * (1 if factor is None else factor)


def read(texts: tuple[str, ...]) -> sympy.Expr:
    return value(
        ElementTree.fromstring(
            f"<mrow>{''.join(texts)}</mrow>".replace("<math>", "").replace("</math>", "")
        )
    )


@pytest.mark.full
@settings(max_examples=60, deadline=None)
@given(rational_functions)
def test_a_typeset_function_is_the_function(function: RationalFunction) -> None:
    names = {name: sympy.Symbol(name) for name in ("m1", "m2", "k12")}
    num, den = (
        sympy.sympify(str(p).replace("^", "**"), locals=names) for p in (function.num, function.den)
    )
    assert sympy.cancel(read((expression(function),)) - num / den) == 0


def test_a_minus_before_a_sum_leaves_its_brackets() -> None:
    a, b = variables(["a", "b"]).values()
    inside = '<mrow><mo stretchy="false">(</mo><mi>a</mi><mo>−</mo><mi>b</mi><mo stretchy="false">)</mo></mrow>'
    assert expression(b - a) == f"<mo>−</mo>{inside}"
    assert (
        expression((b - a) / b)
        == f"<mfrac><mrow><mo>−</mo>{inside}</mrow><mrow><mi>b</mi></mrow></mfrac>"
    )
    assert expression(a - b) == "<mi>a</mi><mo>−</mo><mi>b</mi>"


def test_a_root_is_a_fraction_of_two() -> None:
    """Of a product below too; -(a + b) + sqrt(c) above keeps its brackets."""
    found = Assignment(True, (), (("x", "(-(a + b) + sqrt(a*b))/(2*a)"),), ())
    (line,) = written_values(found).equations
    (root,) = ElementTree.fromstring(line).iter("mfrac")
    above, below = root
    a, b = sympy.symbols("a b")
    assert sympy.expand(value(above) + a + b - sympy.sqrt(a * b)) == 0 == value(below) - 2 * a


@pytest.mark.thin(1)
@pytest.mark.parametrize(
    "family", FAMILIES, ids=lambda f: f"{f.n_masses}-{'damped' if f.damped else 'undamped'}"
)
def test_the_typeset_coefficients_are_those_of_the_transfer_function(family: Family) -> None:
    s = sympy.Symbol("s")
    for chain in (
        (family[len(family)],) if family.n_masses == 4 else (family[1], family[len(family)])
    ):
        found = transfer_function_parts(chain)
        stiffness = {
            sympy.Symbol(f"κ{n[1:]}"): sympy.Symbol(n) + s * sympy.Symbol(f"d{n[1:]}")
            for n in chain.parameters
            if n[0] == "k"
        }
        sums = {"b": sympy.Integer(0), "a": sympy.Integer(0)}
        for label, parts in found.lines:
            letter, power = re.findall(r"<mi>(.)</mi><mn>(\d+)</mn>", label)[0]
            sums[letter.lower()] += read(parts).subs(stiffness) * s ** int(power)
        num, den = (sympy.sympify(str(p).replace("^", "**")) for p in expand(chain.structure))
        assert found.stiffness == (chain.damped and chain.n_masses == 4)
        assert sympy.expand(sums["b"] * den - sums["a"] * num) == 0


def test_the_latex_names_every_coefficient_and_balances() -> None:
    for chain in (Chain(3, damped=True), Chain(5, damped=True)):
        found = transfer_function_parts(chain)
        assert found.latex.count(" &= ") == 1 + len(found.lines)
        assert found.latex.count("{") == found.latex.count("}")
        assert found.latex.count(r"\left(") == found.latex.count(r"\right)")
    assert (
        r"\kappa_{12}" in transfer_function_parts(Chain(5, damped=True)).latex
        and " k_{" not in transfer_function_parts(Chain(5, damped=True)).latex
    )


def plain(latex: str) -> str:
    """LaTeX of products, powers, sums and parentheses as Python."""
    text = re.sub(
        r"\\?(\w+)_\{(\d+)\}", r"\1\2", latex.replace(r"\left", "").replace(r"\right", "")
    )
    text = re.sub(r"\^\{(\d+)\}", r"**\1", text)
    return re.sub(r"(?<=[\w)]) +(?=[\w(])", "*", text)


@pytest.mark.parametrize(
    "chain",
    [Chain(3, damped=True), Chain(4, damped=True), Chain(4, 1, 1, 3, 1, 2, damped=False)],
    ids=str,
)
def test_the_latex_is_what_is_typeset(chain: Chain) -> None:
    found = transfer_function_parts(chain)
    rows = [line.split(" &= ")[1].removesuffix(r" \\") for line in found.latex.splitlines()[2:-1]]
    for (label, parts), row in zip(found.lines, rows, strict=True):
        typeset = read(parts).subs(
            {x: sympy.Symbol(x.name.replace("κ", "kappa")) for x in read(parts).free_symbols}
        )
        assert sympy.expand(typeset - sympy.sympify(plain(row))) == 0, label


def test_a_map_is_typeset_as_its_formulas() -> None:
    found = correspondence(Chain(2, damped=True), Chain(2, 1, 1, 2, 1, 2, damped=True))
    assert found is not None and len(found.equations) == 4
    left, right = found.equations[0].split("<mo>=</mo>")
    m1, m2 = sympy.symbols("m1 m2")
    assert left == "<math>" + prime("m1")
    assert sympy.simplify(read(("<math>" + right,)) - m1 * (m1 + m2) / m2) == 0


@pytest.mark.full
def test_long_maps_are_left_to_the_command_line() -> None:
    undamped = catalog(4, damped=False)
    a, b = undamped.classes()[0][:2]
    found = [
        correspondence(undamped.family[a], undamped.family[b]),
        correspondence(Chain(1, damped=False), Chain(2, damped=False)),
    ]
    assert all(f is None or len(f.latex) < 2000 for f in found) and found[1] is None


def test_signs_stand_between_terms() -> None:
    assert summands([(1, {"m1": 1}), (-2, {})]) == [symbol("m1"), "<mo>−</mo><mn>2</mn>"]
    assert summands([(-1, {"m1": 2})]) == [
        "<mo>−</mo><msubsup><mi>m</mi><mn>1</mn><mn>2</mn></msubsup>"
    ]
