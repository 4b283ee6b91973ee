"""How checks say what they found."""

from collections.abc import Sequence
from itertools import combinations

from disting.conditions.table import RULES
from disting.verdict import Decisions

Pair = tuple[int, int]


def counted(found: Decisions) -> dict[str, int]:
    """Pairs by deciding condition, undecided ones under ""."""
    return {rule: n for rule, n in found.counts().items() if n}


def told(counts: dict[str, int]) -> str:
    """Counts in words.

    >>> told({"1": 26, "": 3})
    '26 by condition 1, 3 undecided'
    """
    decided = [f"{counts[rule]} by {RULES[rule].in_words()}" for rule in sorted(counts) if rule]
    return ", ".join([*decided, f"{counts.get('', 0)} undecided"])


def deciding(found: Decisions) -> dict[Pair, str]:
    """The deciding condition of every pair of models, "" where it is undecided."""
    pairs = combinations(range(len(found.subjects)), 2)
    return {(i + 1, j + 1): found.rule(i, j) for i, j in pairs}


def undecided(found: Decisions) -> set[Pair]:
    """The pairs that stay open."""
    return {pair for pair, rule in deciding(found).items() if not rule}


def named(numbers: Sequence[object]) -> str:
    """Models, pairs or numbers with commas and a final "and".

    >>> named([1, 4, 7]), named([3])
    ('1, 4 and 7', '3')
    """
    *first, last = map(str, numbers)
    return f"{', '.join(first)} and {last}" if first else last
