"""Rational functions for people, by SymPy: as its expressions, as text that Python reads, and in
LaTeX.

Importing SymPy takes about as long as importing all of this package, so it is imported where an
expression is written and nowhere else. What is printed is built unevaluated: SymPy then keeps the
order of the terms, which is the chain's (k12/m1 + k12/m2, where it would sort k12/m2 + k12/m1),
and numbers before sums. What users compute with is evaluated, in symbols that are positive, as
parameters are, but for the frequency variable s.
"""

import re
from collections.abc import Callable, Sequence
from functools import cache
from typing import TYPE_CHECKING, TypeAlias

from disting.algebra.symbols import (
    Content,
    Polynomial,
    RationalFunction,
    Term,
    content,
    factors,
    polynomial_of,
    terms,
)

if TYPE_CHECKING:
    import sympy

Expr: TypeAlias = "sympy.Expr"
Sum = Sequence[Term]
"""A sum of products of powers, whose exponents may be negative."""
Product = tuple["sympy.Expr | int", list[tuple[Expr, int]]]
"""A number, and bases with their exponents."""


def expression(of: RationalFunction | Sum, *, evaluate: bool = True) -> Expr:
    """The same for SymPy; a rational function factorised, a sum term by term.

    >>> from disting.algebra.symbols import variables
    >>> a, b = variables(["m1", "m2"]).values()
    >>> expression((a**2 - b**2) / a) * expression([(1, {"m1": 1})])
    (m1 - m2)*(m1 + m2)
    """
    from sympy import Rational

    if not isinstance(of, RationalFunction):
        return _added(_products(of), evaluate)
    (above, top), (below, bottom) = factors(of.num), factors(of.den)
    powers = [
        (_added(_products(terms(p)), evaluate), sign * e)
        for sign, found in ((1, top), (-1, bottom))
        for p, e in found
    ]
    return _product((Rational(above, below), powers), evaluate)


def quotient(
    above: Sequence[Polynomial],
    below: Sequence[Polynomial],
    *,
    evaluate: bool = True,
    power: Callable[[int], Expr] = int,
) -> Expr:
    """A rational function of s, from the coefficients of the powers 0, 1, .. of numerator and
    denominator, or of those that `power` makes of 0, 1, ..

    >>> from disting.algebra.symbols import symbols
    >>> k, m = symbols(["k", "m"]).values()
    >>> printed(quotient([k], [k, m - m, m + 1], evaluate=False))
    'k/(k + (m + 1)*s**2)'
    """
    from sympy import Rational

    (n, top), (d, bottom) = (_in_s(side, evaluate, power) for side in (above, below))
    return _product((Rational(n, d), [*top, *((x, -e) for x, e in bottom)]), evaluate)


def symbol(name: str) -> Expr:
    """A parameter, which is positive, or the frequency variable s."""
    from sympy import Symbol

    return Symbol(name) if name == "s" else Symbol(name, positive=True)


def text(of: RationalFunction | Sum) -> str:
    """A valid Python expression.

    >>> text([(1, {"k12": 1, "m1": -1}), (-2, {"k12": 1, "m2": -1})])
    'k12/m1 - 2*k12/m2'
    """
    return printed(expression(of, evaluate=False))


def printed(unevaluated: Expr) -> str:
    """An expression as text, in the order in which it is built."""
    from sympy import sstr

    return str(sstr(unevaluated, order="none"))


def latex(of: RationalFunction | Sum) -> str:
    r"""In LaTeX, without dollar signs.

    >>> latex([(1, {"k9_10": 2, "m1": -1})])
    '\\frac{k_{9,10}^{2}}{m_{1}}'
    """
    if isinstance(of, RationalFunction):
        return _quotient_latex(content(of.num), content(of.den))
    return _printed_latex(expression(of, evaluate=False))


@cache
def _quotient_latex(above: Content, below: Content) -> str:
    """Kept: the maps between the models of a family repeat a few formulas many times."""
    of = RationalFunction(polynomial_of(above), polynomial_of(below))
    return _printed_latex(expression(of, evaluate=False))


def _printed_latex(unevaluated: Expr) -> str:
    import sympy

    names = {x: latex_symbol(x.name) for x in unevaluated.free_symbols}
    return str(sympy.latex(unevaluated, order="none", symbol_names=names))


def latex_symbol(name: str) -> str:
    r"""m_{1} for m1, k_{9,10} for k9_10, s for s; names of several letters are upright.

    >>> latex_symbol("k9_10"), latex_symbol("gain"), latex_symbol("k_on2")
    ('k_{9,10}', '\\mathrm{gain}', 'k_{on2}')
    """
    head, index = split_name(name)
    letter = head if len(head) == 1 else rf"\mathrm{{{head.replace('_', chr(92) + '_')}}}"
    return f"{letter}_{{{index}}}" if index else letter


def split_name(name: str) -> tuple[str, str]:
    """The letters of a name, and its index: what follows from a digit or an underscore on, or a
    single small letter after a capital one.

    >>> split_name("k9_10"), split_name("tau_m"), split_name("s"), split_name("_x")
    (('k', '9,10'), ('tau', 'm'), ('s', ''), ('_x', ''))
    >>> split_name("Td"), split_name("Gain")
    (('T', 'd'), ('Gain', ''))
    """
    head = re.match(r"[A-Z](?=[a-z]$)|[^\W\d_]+", name)
    if head is None:
        return name, ""
    return head[0], name[head.end() :].strip("_").replace("_", ",")


def _in_s(
    coefficients: Sequence[Polynomial], evaluate: bool, power: Callable[[int], Expr]
) -> Product:
    """A polynomial in s as one product: a sum with brackets around its longer coefficients, or
    its only term.
    """
    found: list[Product] = []
    for i, coefficient in enumerate(coefficients):
        products = _products(terms(coefficient))
        shown = [(1, [(_added(products, evaluate), 1)])] if i and len(products) > 1 else products
        found += [(number, [*powers, (symbol("s"), power(i))]) for number, powers in shown]
    return found[0] if len(found) == 1 else (1, [(_added(found, evaluate), 1)])


def _products(found: Sum) -> list[Product]:
    return [(number, [(symbol(name), e) for name, e in powers.items()]) for number, powers in found]


def _added(products: Sequence[Product], evaluate: bool) -> Expr:
    from sympy import Add

    return Add(*(_product(p, evaluate) for p in products), evaluate=evaluate)


def _product(of: Product, evaluate: bool) -> Expr:
    from sympy import Mul, Pow

    number, powers = of
    parts = [x if e == 1 else Pow(x, e, evaluate=evaluate) for x, e in powers if e]
    return Mul(*([number] if number != 1 or not parts else []), *parts, evaluate=evaluate)
