"""Entries of a model as trees of sums, products and whole powers, before anything is multiplied
out: read from numbers, from text and from SymPy expressions.

Text is written as in Python: numbers, names, + - * / ** and parentheses. Sums and products of any
length are one tree with many parts, so that long ones are no deep ones. Nesting and the lengths of
texts and numbers are bounded before anything is computed. (Python's own parser nests sums, and ends
in an error for long ones.)

Only exact numbers enter: integers, fractions, decimals written in a text ("0.1" is 1/10). A float
is taken if it is a whole number; any other one is a rounded number, and its digits are to be
written as text. SymPy expressions are recognised by their own attributes, so SymPy itself is not
needed. Symbols are known by their names alone, whatever they are assumed to be.

Evidence is stored as FLINT writes polynomials and fractions, and read back so: its bytes depend on
no printer's taste.
"""

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from keyword import iskeyword
from numbers import Rational
from typing import Any

from flint import Ordering, fmpz_mpoly, fmpz_mpoly_ctx

from disting.algebra.symbols import RationalFunction
from disting.errors import InputError, short

HIGHEST_POWER = 1000
DEEPEST = 100  # operations within each other
LONGEST_NUMBER = 12_000  # bits of a numerator or denominator: Python writes no longer ones as text


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


def names(of: Tree) -> Iterator[str]:
    """Yield the names of all symbols, with repetitions."""
    left = [of]
    while left:
        match left.pop():
            case str(name):
                yield name
            case Sum(parts) | Product(parts):
                left += parts
            case Power(base):
                left.append(base)


def number(value: Fraction | int) -> Fraction:
    """An exact number as a tree; raises InputError for one that is too long."""
    exact = Fraction(value)
    if max(exact.numerator.bit_length(), exact.denominator.bit_length()) > LONGEST_NUMBER:
        raise InputError(
            f"numbers of a model have {LONGEST_NUMBER} bits at most; choose other units"
        )
    return exact


def negative(of: Tree) -> Tree:
    """-of."""
    return -of if isinstance(of, Fraction) else Product((Fraction(-1), of))


def power(base: Tree, exponent: int, text: str) -> Tree:
    """base**exponent; raises InputError, naming the text, for one that is too high."""
    if abs(exponent) > HIGHEST_POWER:
        raise InputError(f"{text}: exponents are {HIGHEST_POWER} at most")
    return Power(base, exponent)


LONGEST_TEXT = 2_000_000  # characters
MOST_DIGITS = LONGEST_NUMBER * 3 // 10
TOKEN = re.compile(
    r"\s*((?:[0-9][0-9_]*\.?[0-9_]*|\.[0-9][0-9_]*)(?:[eE][+-]?[0-9]+)?|[^\W\d]\w*|\*\*|[-+*/()])"
)
END = ""


def parse(text: str) -> Tree:
    """Tree of a text; raises InputError.

    >>> parse("k1/2")
    Product(parts=('k1', Power(base=Fraction(2, 1), exponent=-1)))
    """
    if len(text) > LONGEST_TEXT:
        raise InputError(f"an expression has {LONGEST_TEXT} characters at most, not {len(text)}")
    reader = _Reader(text)
    whole = reader.sum(0)
    if reader.next != END:
        raise reader.error()
    return whole


class _Reader:
    """Recursive descent with one token of look-ahead."""

    def __init__(self, text: str) -> None:
        self.text = text.strip()
        self._tokens = self._split()
        self.next = next(self._tokens)

    def error(self) -> InputError:
        """Error in the text as a whole: missing or unknown signs."""
        if re.search(r"[^\w\s.+*/()-]|\w\s*\(|//|__", self.text):
            reason = (
                "is no rational expression: numbers, names and + - * / ** with whole exponents"
                " make one"
            )
        else:
            reason = "is no expression; write it as in Python, such as 'k12*s/(m1 + m2)**2'"
        return InputError(f"{short(self.text)} {reason}")

    def sum(self, depth: int) -> Tree:
        """Terms with + and - between them."""
        if depth > DEEPEST:
            raise InputError(
                f"{short(self.text)} is nested too deeply: {DEEPEST} parentheses within each other"
                " are read"
            )
        parts = [self._product(depth)]
        while self.next in ("+", "-"):
            is_negative = self._take_token() == "-"
            part = self._product(depth)
            parts.append(negative(part) if is_negative else part)
        return parts[0] if len(parts) == 1 else Sum(tuple(parts))

    def _product(self, depth: int) -> Tree:
        parts = [self._read_signed(depth)]
        while self.next in ("*", "/"):
            divides = self._take_token() == "/"
            part = self._read_signed(depth)
            parts.append(Power(part, -1) if divides else part)
        return parts[0] if len(parts) == 1 else Product(tuple(parts))

    def _read_signed(self, depth: int) -> Tree:
        """Powers bind closer than the signs before them: -a**2 is -(a**2), and 2**-1 is 1/2."""
        is_negative = False
        while self.next in ("+", "-"):
            is_negative ^= self._take_token() == "-"
        base = self._atom(depth)
        if self.next == "**":
            self._take_token()
            base = power(base, self._exponent(depth + 1), short(self.text))
        return negative(base) if is_negative else base

    def _exponent(self, depth: int) -> int:
        if depth > DEEPEST:
            raise self.error()
        exponent = self._read_signed(depth)
        if not isinstance(exponent, Fraction) or exponent.denominator != 1:
            raise InputError(f"{short(self.text)}: exponents are whole numbers")
        return int(exponent)

    def _atom(self, depth: int) -> Tree:
        token = self._take_token()
        if token == "(":
            inside = self.sum(depth + 1)
            if self._take_token() != ")":
                raise self.error()
            return inside
        if token and (token[0].isdigit() or token[0] == "."):
            return self._number(token)
        if not token or not token.isidentifier() or iskeyword(token):
            raise self.error()
        return token

    def _number(self, token: str) -> Fraction:
        digits, _, exponent = token.lower().partition("e")
        if len(digits) > MOST_DIGITS or len(exponent) > 9 or abs(int(exponent or 0)) > MOST_DIGITS:
            raise InputError(
                f"{short(token)}: a number has {MOST_DIGITS} digits and zeros at most; choose other"
                " units"
            )
        try:
            return number(Fraction(token))
        except ValueError:
            raise self.error() from None

    def _take_token(self) -> str:
        token, self.next = self.next, next(self._tokens)
        return token

    def _split(self) -> Iterator[str]:
        """Yield the tokens, then END for ever."""
        at = 0
        while at < len(self.text):
            match = TOKEN.match(self.text, at)
            if not match:
                raise self.error()
            yield match[1]
            at = match.end()
        while True:
            yield END


def tree(entry: object) -> Tree:
    """Tree of an entry: number, text or SymPy expression. Raises InputError for anything else.

    >>> tree("k1/2")
    Product(parts=('k1', Power(base=Fraction(2, 1), exponent=-1)))
    """
    match entry:
        case bool():
            raise InputError(f"an entry is a number or an expression, not {entry}")
        case str():
            return parse(entry)
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
            _of_sympy(expression.base, depth + 1), int(expression.exp), short(str(expression))
        )
    raise InputError(f"{short(str(expression))[1:-1]} is no rational expression in its symbols")


def polynomial_text(polynomial: fmpz_mpoly, names: Sequence[str]) -> str:
    """A polynomial with other names of its variables."""
    context = fmpz_mpoly_ctx.get(tuple(names), Ordering.degrevlex)
    return str(context.from_dict(polynomial.to_dict())).replace("^", "**")


def text_of(ratio: RationalFunction, names: Sequence[str]) -> str:
    """A fraction with other names of its variables."""
    top, bottom = (polynomial_text(side, names) for side in (ratio.num, ratio.den))
    if bottom == "1":
        return top
    return "/".join(f"({x})" if any(c in x for c in " */") else x for x in (top, bottom))
