"""Entries of a model as trees of sums, products and whole powers: read from numbers, from text and from SymPy expressions.

Only exact numbers enter: integers, fractions, decimals written in a text ("0.1" is 1/10). A float is taken if it is a whole
number; any other one stands for a rounded number, and its digits are to be written as text. SymPy expressions are recognised
by their own attributes, so SymPy itself is not needed. Symbols are known by their names alone, whatever they are assumed to be.
"""

import ast
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import reduce
from numbers import Rational
from typing import Any

from flint import fmpz_mpoly

from disting.errors import InputError
from disting.parametric.ratio import Ratio

HIGHEST_POWER = 1000


@dataclass(frozen=True, slots=True)
class Sum:
    """Sum of its parts."""

    parts: tuple["Tree", ...]


@dataclass(frozen=True, slots=True)
class Product:
    """Product of its parts."""

    parts: tuple["Tree", ...]


@dataclass(frozen=True, slots=True)
class Power:
    """Whole power, negative ones too."""

    base: "Tree"
    exponent: int


Tree = Fraction | str | Sum | Product | Power
"""A number, the name of a symbol, or an operation on trees."""


def tree(entry: object) -> Tree:
    """Tree of an entry: number, text or SymPy expression. Raises InputError for anything else.

    >>> tree("k1/2")
    Product(parts=('k1', Power(base=Fraction(2, 1), exponent=-1)))
    """
    match entry:
        case bool():
            raise InputError(f"an entry is a number or an expression, not {entry}")
        case str():
            return _of_text(entry)
        case float():
            return _of_float(entry)
        case _ if hasattr(entry, "is_Symbol"):
            return _of_sympy(entry.as_expr() if hasattr(entry, "as_expr") else entry)
        case Rational():
            return Fraction(int(entry.numerator), int(entry.denominator))
    raise InputError(f"an entry is a number, a text or a SymPy expression, not of type {type(entry).__name__}")


def names(of: Tree) -> Iterator[str]:
    """Yield the names of all symbols, with repetitions."""
    match of:
        case str():
            yield of
        case Sum(parts) | Product(parts):
            for part in parts:
                yield from names(part)
        case Power(base):
            yield from names(base)


def value(of: Tree, ring: dict[str, fmpz_mpoly], one: fmpz_mpoly) -> Ratio:
    """Value of a tree in the field of fractions; `ring` holds the generators by name. Raises InputError for x/0."""
    match of:
        case Fraction():
            return Ratio(one * of.numerator, one * of.denominator)
        case str():
            return Ratio(ring[of], one)
        case Sum(parts):
            return reduce(Ratio.__add__, (value(part, ring, one) for part in parts))
        case Product(parts):
            return reduce(Ratio.__mul__, (value(part, ring, one) for part in parts))
        case Power(base, exponent):
            return value(base, ring, one) ** exponent


def _of_text(text: str) -> Tree:
    try:
        node = ast.parse(text.strip(), mode="eval").body
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        raise InputError(f"{text!r} is no expression; write it as in Python, such as 'k12*s/(m1 + m2)**2'") from None
    return _of_node(node, text.strip())


def _of_node(node: ast.expr, text: str) -> Tree:
    match node:
        case ast.Name(name):
            return name
        case ast.Constant(int() | float() as number) if not isinstance(number, bool):
            return Fraction(ast.get_source_segment(text, node) or number) if isinstance(number, float) else Fraction(number)
        case ast.UnaryOp(ast.UAdd(), operand):
            return _of_node(operand, text)
        case ast.UnaryOp(ast.USub(), operand):
            return _negative(_of_node(operand, text))
        case ast.BinOp(left, ast.Pow(), right):
            return _power(_of_node(left, text), _whole(right, text), text)
        case ast.BinOp(left, ast.Add() | ast.Sub() | ast.Mult() | ast.Div() as operator, right):
            return _combined(_of_node(left, text), operator, _of_node(right, text))
    raise InputError(f"{text!r} is no rational expression: numbers, names and + - * / ** with whole exponents make one")


def _combined(left: Tree, operator: ast.operator, right: Tree) -> Tree:
    match operator:
        case ast.Add():
            return Sum((left, right))
        case ast.Sub():
            return Sum((left, _negative(right)))
        case ast.Mult():
            return Product((left, right))
    return Product((left, Power(right, -1)))


def _negative(of: Tree) -> Tree:
    return -of if isinstance(of, Fraction) else Product((Fraction(-1), of))


def _whole(node: ast.expr, text: str) -> int:
    exponent = _of_node(node, text)
    if not isinstance(exponent, Fraction) or exponent.denominator != 1:
        raise InputError(f"{text!r}: exponents are whole numbers")
    return int(exponent)


def _power(base: Tree, exponent: int, text: object) -> Tree:
    if abs(exponent) > HIGHEST_POWER:
        raise InputError(f"{text}: exponents are {HIGHEST_POWER} at most")
    return Power(base, exponent)


def _of_float(number: float) -> Fraction:
    if not number.is_integer():
        raise InputError(f"{number!r} is a float and no exact number; write it as text, '{number!r}', or as a fraction")
    return Fraction(int(number))


def _of_sympy(expression: Any) -> Tree:
    """SymPy's own names of the kinds of expressions; no import of SymPy."""
    if expression.is_Symbol:
        return str(expression.name)
    if expression.is_Rational:
        return Fraction(int(expression.p), int(expression.q))
    if getattr(expression, "is_Float", False):
        return _of_float(float(expression))
    if getattr(expression, "is_Add", False):
        return Sum(tuple(map(_of_sympy, expression.args)))
    if getattr(expression, "is_Mul", False):
        return Product(tuple(map(_of_sympy, expression.args)))
    if getattr(expression, "is_Pow", False) and expression.exp.is_Integer:
        return _power(_of_sympy(expression.base), int(expression.exp), expression)
    raise InputError(f"{expression} is no rational expression in its symbols")
