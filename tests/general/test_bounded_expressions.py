"""Expressions made to break what reads them: each is computed or refused in one short sentence,
before it grows.
"""

import random
import subprocess
import sys
from fractions import Fraction
from math import prod

import pytest

from disting import InputError, Model

HUGE = {
    "powers of powers": "(((2**1000)**1000)**1000)**1000*k",
    "a high power of a symbol": "((k**1000)**1000)**1000",
    "a decimal exponent": "1e999999999*k",
    "a negative one": "1e-999999999*k",
    "a power of a sum": "(a+b+c+d+e+f)**1000",
    "a product of sums": "*".join(f"(a{i}+1)" for i in range(60)),
    "sums of fractions": "+".join(f"1/(a{i}+1)" for i in range(60)),
    "a product of numbers": "*".join(["12345"] * 20_000) + "*k",
    "digits": "1" * 1_000_000 + "*k",
    "symbols": "+".join(f"x{i}" for i in range(5000)),
    "parentheses": "(" * 50_000 + "k" + ")" * 50_000,
    "calls": "f(" * 1000,
    "a tower": "k" + "**2" * 50_000,
    "a long text": "k+" * 2_000_000 + "k",
    "no expression": "k " * 200_000,
    "control characters": "k+\x1b[2J\x00",
}


@pytest.mark.thin(8)
@pytest.mark.parametrize("text", HUGE.values(), ids=HUGE)
@pytest.mark.parametrize(
    "make",
    [
        lambda e: Model.from_state_space([[e]], [1], [1]),
        lambda e: Model.from_transfer_function("1", ["1", e]),
    ],
)
def test_what_would_grow_is_refused_in_a_short_sentence(make, text):
    with pytest.raises(InputError) as refusal:
        make(text)
    assert len(str(refusal.value)) < 220 and str(refusal.value).isprintable()


@pytest.mark.thin(3)
@pytest.mark.parametrize(
    ("text", "same"),
    [
        ("+".join(["a*b"] * 450), "450*a*b"),
        (
            "+".join(f"{i}*k*a**{i % 7}" for i in range(7 * 1000)),
            "+".join(f"{sum(range(r, 7000, 7))}*k*a**{r}" for r in range(7)),
        ),
        ("-".join(["k"] * 20_000), "-19998*k"),
        ("-" * 10_001 + "k", "0-k"),
        ("(" * 90 + "k" + ")" * 90, "k"),
        ("-k**2", "(-1)*(k*k)"),
        ("a/b/c*d", "(a*d)/(b*c)"),
        ("2**-1*k - .5e1*a + 5.*a", "k/2 + 0*a"),
        ("1/2*k + 1/3*k + k/6", "k"),
        ("(2/3)**-2*k", "9*k/4"),
    ],
)
def test_what_is_long_but_not_large_is_computed(text, same):
    assert Model.from_transfer_function("z", ["1", text]) == Model.from_transfer_function(
        "z", ["1", same]
    )


CRASHED = (
    "from disting import Model; Model.from_transfer_function('k', ['1',"
    " '(((2**1000)**1000)**1000)**1000'])"
)


@pytest.mark.full
def test_no_expression_ends_the_interpreter():
    done = subprocess.run(
        [sys.executable, "-c", CRASHED], capture_output=True, text=True, check=False, timeout=600
    )
    assert done.returncode == 1 and "TooLargeError: the expressions grow too large" in done.stderr


def drawn(source, depth):
    """A random expression with its value at a = 2, b = 3 as Python computes it in fractions,
    None where it divides by zero.
    """
    kind = source.choice("nnab" if depth == 0 else "+-*/p_")
    if kind == "n":
        n = source.randint(1, 99)
        return str(n), Fraction(n)
    if kind in "ab":
        return kind, Fraction(2 if kind == "a" else 3)
    text, value = drawn(source, depth - 1)
    if kind == "_":
        return f"-({text})", value and -value
    if kind == "p":
        n = source.choice([0, 1, 2, 3, -1])
        return f"({text})**{n}", None if value is None or (n < 0 and value == 0) else value**n
    other, second = drawn(source, source.randint(0, depth - 1))
    if value is None or second is None or (kind == "/" and second == 0):
        return f"({text}){kind}({other})", None
    return f"({text}){kind}({other})", eval(f"x {kind} y", {"x": value, "y": second})


@pytest.mark.full
def test_random_expressions_have_the_value_that_python_computes():
    source, accepted = random.Random(5), 0
    for _ in range(300):
        text, value = drawn(source, source.randint(1, 4))
        try:
            model = Model.from_transfer_function(["1"], ["z", text])
        except InputError:
            continue
        if value is not None:
            point = {"a": 2, "b": 3, "z": 1}
            assert ratio_at(model, point) == value, text
            accepted += 1
    assert accepted > 150


def ratio_at(model, point):
    """a_0/a_1 of the denominator, computed from its terms."""
    constant, leading = (
        sum(
            n * prod(Fraction(point[p]) ** e for p, e in zip(model.parameters, powers, strict=True))
            for powers, n in terms
        )
        for terms in model.denominator_terms
    )
    return constant / leading
