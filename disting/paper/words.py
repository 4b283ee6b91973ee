"""How checks say what they found."""

from collections.abc import Sequence
from itertools import combinations

from disting.engine import Decisions

Pair = tuple[int, int]


def counted(found: Decisions) -> dict[int, int]:
    """Pairs by deciding condition, undecided ones under 0."""
    return {int(number or 0): n for number, n in found.counts().items() if n}


def told(counts: dict[int, int]) -> str:
    """Counts in words.

    >>> told({1: 26, 0: 3})
    '26 by condition 1, 3 undecided'
    """
    decided = [f"{counts[number]} by condition {number}" for number in sorted(counts) if number]
    return ", ".join([*decided, f"{counts.get(0, 0)} undecided"])


def deciding(found: Decisions) -> dict[Pair, int]:
    """Number of the deciding condition of every pair of models, 0 where it is undecided."""
    pairs = combinations(range(len(found.subjects)), 2)
    return {(i + 1, j + 1): int(found.decided_by[i, j]) for i, j in pairs}


def undecided(found: Decisions) -> set[Pair]:
    """The pairs that stay open."""
    return {pair for pair, number in deciding(found).items() if number == 0}


def named(numbers: Sequence[object]) -> str:
    """Models, pairs or numbers with commas and a final "and".

    >>> named([1, 4, 7]), named([3])
    ('1, 4 and 7', '3')
    """
    *first, last = map(str, numbers)
    return f"{', '.join(first)} and {last}" if first else last
