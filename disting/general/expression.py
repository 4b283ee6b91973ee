"""Entries of a model as trees of sums, products and whole powers: read from numbers, from text and
from SymPy expressions.

Only exact numbers enter: integers, fractions, decimals written in a text ("0.1" is 1/10). A float
is taken if it is a whole number; any other one stands for a rounded number, and its digits are to
be written as text. SymPy expressions are recognised by their own attributes, so SymPy itself is
not needed. Symbols are known by their names alone, whatever they are assumed to be.
"""

from fractions import Fraction
from numbers import Rational
from typing import Any

from disting.errors import InputError, shown
from disting.general.text import parsed
from disting.general.trees import DEEPEST, Product, Sum, Tree, number, power


def tree(entry: object) -> Tree:
    """Tree of an entry: number, text or SymPy expression. Raises InputError for anything else.

    >>> tree("k1/2")
    Product(parts=('k1', Power(base=Fraction(2, 1), exponent=-1)))
    """
    match entry:
        case bool():
            raise InputError(f"an entry is a number or an expression, not {entry}")
        case str():
            return parsed(entry)
        case float():
            return _of_float(entry)
        case _ if hasattr(entry, "is_Symbol"):
            return _of_sympy(entry.as_expr() if hasattr(entry, "as_expr") else entry)
        case Rational():
            return number(Fraction(int(entry.numerator), int(entry.denominator)))
    raise InputError(
        f"an entry is a number, a text or a SymPy expression, not of type {type(entry).__name__}"
    )


def _of_float(value: float) -> Fraction:
    if not value.is_integer():
        raise InputError(
            f"{value!r} is a float and no exact number; write it as text, '{value!r}', or as a"
            " fraction"
        )
    return Fraction(int(value))


def _of_sympy(expression: Any, depth: int = 0) -> Tree:
    """SymPy's own names of the kinds of expressions; no import of SymPy."""
    if depth > DEEPEST:
        raise InputError(
            f"an expression is nested too deeply: {DEEPEST} operations within each other are read"
        )
    if expression.is_Symbol:
        return str(expression.name)
    if expression.is_Rational:
        return number(Fraction(int(expression.p), int(expression.q)))
    if getattr(expression, "is_Float", False):
        return _of_float(float(expression))
    if getattr(expression, "is_Add", False):
        return Sum(tuple(_of_sympy(part, depth + 1) for part in expression.args))
    if getattr(expression, "is_Mul", False):
        return Product(tuple(_of_sympy(part, depth + 1) for part in expression.args))
    if getattr(expression, "is_Pow", False) and expression.exp.is_Integer:
        return power(
            _of_sympy(expression.base, depth + 1), int(expression.exp), shown(str(expression))
        )
    raise InputError(f"{shown(str(expression))[1:-1]} is no rational expression in its symbols")
