"""Joint certainty of all statements on a family.

The error bound of a pair is that of the pair alone. Pairs share the points and primes of their
models, so a bound of all of them adds up what can go wrong, independent or not (union bound): a
profile errs for all pairs of its model at once, so it counts once for each representation in which
it decides; a bounded exact decision, inclusion or finding on positive equivalents counts by itself.
Where inclusion is reported, it rests on the order of the ranks: of unequal ranks the larger model
does not lie in the smaller one, and of equal ranks distinguishable models lie neither in the other.
So every rank that is not proven counts.
"""

from collections.abc import Iterator, Mapping
from typing import TypeVar

import numpy as np

from disting.algebra.certainty import LEAST_SAFETY, USELESS, Certainty, joint_safety
from disting.conditions.rule import Stage
from disting.verdict.classes import Classes
from disting.verdict.decisions import Decisions

T = TypeVar("T")


def family_safety(decided: Decisions) -> int:
    """Largest b such that all statements on all pairs hold, but for a probability of 2**-b at
    most; 0: all is proven.

    `certainty.USELESS` where no bound is left.
    """
    part = _safeties(decided.part.decisions) if decided.part else ()
    return joint_safety([*_safeties(decided), *part])


def classes_safety(classes: Classes) -> int:
    """The same for classes of models, from the number of statements alone: each is wrong with
    2^-LEAST_SAFETY at most.

    Three profiles a model (transfer function, Markov parameters, 1/G), as many links as models
    beyond the first of each class, and one exact decision for each pair of classes that no column
    distinguishes.
    """
    first: dict[int, int] = {}
    for i, group in enumerate(classes.group):
        first.setdefault(int(group), i)
    columns = classes.columns[list(first.values())]
    together = np.ones((len(first), len(first)), bool)
    for column in columns.T:
        lower, upper = column[:, None], column[None, :]
        together &= (lower == upper) | (lower < 0) | (upper < 0)
    decisions = int(np.triu(together, 1).sum()) - len(classes.open_groups)
    return joint_safety([LEAST_SAFETY] * (3 * len(classes) + len(classes) - len(first) + decisions))


def joint_in_words(safety: int) -> str:
    """Joint certainty of all statements on a family, in words.

    >>> joint_in_words(121)
    'all of it together is wrong with a probability of at most 2^-121'
    >>> joint_in_words(USELESS)
    'no error bound is left for all of it together'
    """
    if safety == USELESS:
        return "no error bound is left for all of it together"
    return (
        f"all of it together is wrong with a probability of at most 2^-{safety}"
        if safety
        else "nothing is left to chance"
    )


def _safeties(decided: Decisions) -> Iterator[int]:
    """Yield the bits of everything that rests on chance, but for what is decided in a part of a
    list. Those of an exact decision count the ranks it needs.
    """

    def own(by_pair: Mapping[tuple[int, int], T]) -> list[T]:
        """Values of the pairs that are not of the part."""
        return [x for pair, x in by_pair.items() if decided.within(*pair) is None]

    profiles = set[tuple[Stage, int]]()
    for i, j, _, where, certainty, safety in decided.grades():
        if decided.within(i, j):
            continue
        if certainty == Certainty.BOUNDED and (i, j) in decided.steps:
            yield safety
        elif certainty == Certainty.BOUNDED:
            profiles |= {(Stage(where), i), (Stage(where), j)}
    if decided.query.tells_inclusion:
        profiles |= set(_uncertain_ranks(decided))
    yield from (decided.profile(where, i).safety for where, i in profiles)
    yield from (safety for safety in (f.safety for f in own(decided.equal)) if safety)
    for both in own(decided.inclusions):
        yield from (f.safety for f in dict.fromkeys((both.image, both.closure)) if f.safety)
    yield from (share.safety for share in own(decided.shares) if share.safety)


def _uncertain_ranks(decided: Decisions) -> Iterator[tuple[Stage, int]]:
    """Yield the models whose ranks are not proven, with the representation that gives them."""
    where = Stage.TF
    yield from (
        (where, i)
        for i in range(len(decided.subjects))
        if not decided.profile(where, i).rank_proven
    )
