"""Thousands of texts as entries of a model: the value that Python gives them with exact
fractions, or one sentence.
"""

import ast
import faulthandler
import operator as op
import re
from fractions import Fraction

import pytest

from disting import Model
from disting.errors import InputError
from tests.attack.counts import chance, times

pytestmark = pytest.mark.attack
NAMES = {"a": Fraction(3, 7), "b": Fraction(-5, 2), "c": Fraction(11), "s": Fraction(2, 3)}
SIGNS = "abcs0123456789.+-*/()_ eE,;^%=<>!&|~@[]{}'\"\\\n\t#:∞²ä\0"
HOSTILE = (
    "__import__('os').system('id')", "a.__class__", "open('/etc/passwd')", "lambda: 1", "a if b else c", "[a][0]", "a:=1",
    "f'{a}'", "9" * 5000, "a**1e9", "a**999999999", "2**2**2**2**2**2", "((2**1000)**1000)**1000", "(a+b+c)**1000", "(" * 3000,
    "-" * 5000 + "a", "+".join(["a"] * 3000), "a" * 10**6, "1/0", "0/0", "a/(b-b)", "1e999999999", "0x10", "1_0", "1j", "True",
    "None", "a@b", "a//b", "yield a", "await a", "*a", "a=1", "exec('1')", "a;b", "\ud800", "１", "ｓ",
)  # fmt: skip
OPERATORS = {
    ast.Add: op.add,
    ast.Sub: op.sub,
    ast.Mult: op.mul,
    ast.Div: op.truediv,
    ast.Pow: op.pow,
}
HUNG = 300  # seconds
DEEPEST = 2000  # characters: longer sums are read by disting, but not by the reading here
LONGEST = 2000  # characters of an error


def drawn(draw, depth):
    """A text and what Python takes it for."""
    if depth == 0 or draw.random() < 0.2:
        return draw.choice(
            [*NAMES, str(draw.randrange(20)), f"{draw.randrange(1, 9)}.{draw.randrange(10)}"]
        )
    left, right = drawn(draw, depth - 1), drawn(draw, depth - 1)
    return draw.choice(
        (
            f"({left} + {right})",
            f"({left}-{right})",
            f"({left}*{right})",
            f"({left})/({right})",
            f"(-{left})**{draw.randrange(4)}",
        )
    )


def exactly(text):
    """The value with fractions; decimals are exact too."""

    def value(node):
        match node:
            case ast.BinOp(left, operator, right):
                whole = int(value(right)) if isinstance(operator, ast.Pow) else value(right)
                return OPERATORS[type(operator)](value(left), whole)
            case ast.UnaryOp(operator, of):
                return -value(of) if isinstance(operator, ast.USub) else value(of)
            case ast.Name(name):
                return NAMES[name]
        return Fraction(ast.get_source_segment(text, node))

    text = re.sub(r"(?<![\w.])0+(?=\d)", "", text)  # 01 is 1, though Python refuses it
    return value(ast.parse(text, mode="eval").body)


def at(polynomials, parameters):
    """Coefficients at the values of the names, as a polynomial in s at its value."""
    total = Fraction(0)
    for power, terms in enumerate(polynomials):
        for exponents, number in terms:
            term = Fraction(number)
            for name, exponent in zip(parameters, exponents, strict=True):
                term *= NAMES[name] ** exponent
            total += term * NAMES["s"] ** power
    return total


def test_texts(counts):
    draw = chance("expressions")
    for _ in range(times(3000)):
        text = drawn(draw, draw.randrange(1, 5))
        kind = draw.random()
        if kind < 0.4:
            place = draw.randrange(len(text) + 1)
            text = text[:place] + draw.choice(SIGNS) + text[place + draw.randrange(2) :]
        elif kind < 0.5:
            text = draw.choice((draw.choice(HOSTILE), f"({draw.choice(HOSTILE)}) + a"))
        counts["tried"] += 1
        whole = f"a/(s+b)**9 * ({text})"
        faulthandler.dump_traceback_later(HUNG, exit=True)
        try:
            model = Model.from_transfer_function(whole, "1")
        except InputError as reason:
            counts["refused"] += 1
            counts["long sentences"] += len(str(reason)) > LONGEST
            continue
        finally:
            faulthandler.cancel_dump_traceback_later()
        counts["accepted"] += 1
        if set(model.parameters) <= set(NAMES) and len(whole) < DEEPEST:
            found = at(model.numerator_terms, model.parameters) / at(
                model.denominator_terms, model.parameters
            )
            counts["compared"] += 1
            counts["wrong"] += found != exactly(whole)
    assert counts["accepted"] and not counts["wrong"] + counts["long sentences"]
