"""Entries of a model as trees of sums, products and whole powers, before anything is multiplied
out.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction

from disting.errors import InputError

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
