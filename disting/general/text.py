"""Expressions written as in Python, read into trees: numbers, names, + - * / ** and parentheses.

Sums and products of any length are one tree with many parts, so that long ones are no deep ones.
Nesting and the lengths of texts and numbers are bounded before anything is computed. (Python's own
parser nests sums, and ends in an error for long ones.)
"""

import re
from collections.abc import Iterator
from fractions import Fraction
from keyword import iskeyword

from disting.errors import InputError, shown
from disting.general.trees import (
    DEEPEST,
    LONGEST_NUMBER,
    Power,
    Product,
    Sum,
    Tree,
    negative,
    number,
    power,
)

LONGEST_TEXT = 2_000_000  # characters
MOST_DIGITS = LONGEST_NUMBER * 3 // 10
TOKEN = re.compile(
    r"\s*((?:[0-9][0-9_]*\.?[0-9_]*|\.[0-9][0-9_]*)(?:[eE][+-]?[0-9]+)?|[^\W\d]\w*|\*\*|[-+*/()])"
)
END = ""


def parsed(text: str) -> Tree:
    """Tree of a text; raises InputError.

    >>> parsed("k1/2")
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
        """What is wrong as a whole: signs are missing, or there are others than those known."""
        if re.search(r"[^\w\s.+*/()-]|\w\s*\(|//|__", self.text):
            reason = (
                "is no rational expression: numbers, names and + - * / ** with whole exponents"
                " make one"
            )
        else:
            reason = "is no expression; write it as in Python, such as 'k12*s/(m1 + m2)**2'"
        return InputError(f"{shown(self.text)} {reason}")

    def sum(self, depth: int) -> Tree:
        """Terms with + and - between them."""
        if depth > DEEPEST:
            raise InputError(
                f"{shown(self.text)} is nested too deeply: {DEEPEST} parentheses within each other"
                " are read"
            )
        parts = [self._product(depth)]
        while self.next in ("+", "-"):
            is_negative = self._taken() == "-"
            part = self._product(depth)
            parts.append(negative(part) if is_negative else part)
        return parts[0] if len(parts) == 1 else Sum(tuple(parts))

    def _product(self, depth: int) -> Tree:
        parts = [self._signed(depth)]
        while self.next in ("*", "/"):
            divides = self._taken() == "/"
            part = self._signed(depth)
            parts.append(Power(part, -1) if divides else part)
        return parts[0] if len(parts) == 1 else Product(tuple(parts))

    def _signed(self, depth: int) -> Tree:
        """Powers bind closer than the signs before them: -a**2 is -(a**2), and 2**-1 is 1/2."""
        is_negative = False
        while self.next in ("+", "-"):
            is_negative ^= self._taken() == "-"
        base = self._atom(depth)
        if self.next == "**":
            self._taken()
            base = power(base, self._exponent(depth + 1), shown(self.text))
        return negative(base) if is_negative else base

    def _exponent(self, depth: int) -> int:
        if depth > DEEPEST:
            raise self.error()
        exponent = self._signed(depth)
        if not isinstance(exponent, Fraction) or exponent.denominator != 1:
            raise InputError(f"{shown(self.text)}: exponents are whole numbers")
        return int(exponent)

    def _atom(self, depth: int) -> Tree:
        token = self._taken()
        if token == "(":
            inside = self.sum(depth + 1)
            if self._taken() != ")":
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
                f"{shown(token)}: a number has {MOST_DIGITS} digits and zeros at most; choose other"
                " units"
            )
        try:
            return number(Fraction(token))
        except ValueError:
            raise self.error() from None

    def _taken(self) -> str:
        token, self.next = self.next, next(self._tokens)
        return token

    def _split(self) -> Iterator[str]:
        """Yield the tokens, then END for ever."""
        at = 0
        while at < len(self.text):
            found = TOKEN.match(self.text, at)
            if not found:
                raise self.error()
            yield found[1]
            at = found.end()
        while True:
            yield END
