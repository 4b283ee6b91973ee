"""What the end of a branch can be: numbers for a row that fits, or the reason why there is none."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from enum import StrEnum
from itertools import product

from flint import acb

from disting.fibres.synthesis.ball import Ball, Poly


class Reason(StrEnum):
    """Why a branch ends without a solution; only NONZERO is a proof that it holds none."""

    NONZERO = "a ball leaves out a zero that every solution has"
    BOUNDARY = "an element or leading coefficient cannot be told from zero"
    OPEN = "this type of chain is not covered"


@dataclass(frozen=True, slots=True)
class Dead:
    """A branch without a solution."""

    reason: Reason


@dataclass(frozen=True, slots=True)
class RowValues:
    """Numbers for the masses and springs of a row, from the left, or of masses beside a port, from
    the port outwards; k(s) = c + d s (undamped: c). `gauges`: how many free choices were made.

    `dampers`: from each mass to the ground, 0 where there is none; empty where no mass has one.
    """

    masses: tuple[Ball, ...] = ()
    springs: tuple[Poly, ...] = ()
    gauges: int = 0
    dampers: tuple[Ball, ...] = ()

    @property
    def all_dampers(self) -> tuple[Ball, ...]:
        """One for every mass."""
        return self.dampers or (acb(0),) * len(self.masses)


Leaf = RowValues | Dead
NONZERO, BOUNDARY, OPEN = (Dead(reason) for reason in Reason)


def mirrored(leaf: Leaf) -> Leaf:
    """The same numbers read from right to left."""
    if not isinstance(leaf, RowValues):
        return leaf
    return replace(
        leaf, masses=leaf.masses[::-1], springs=leaf.springs[::-1], dampers=leaf.dampers[::-1]
    )


def combined(
    left: Iterable[Leaf],
    right: Callable[[], Iterable[Leaf]],
    join: Callable[[RowValues, RowValues], Leaf],
) -> Iterator[Leaf]:
    """All pairs, then what is left open; nothing but proofs if one side is proven impossible.

    `right` is asked only if the left side is not refuted.
    """
    first = list(left)
    second = [] if _refuted(first) else list(right())
    for side in (first, second):
        if _refuted(side):
            yield from side
            return
    for a, b in product(first, second):
        if isinstance(a, RowValues) and isinstance(b, RowValues):
            yield join(a, b)
    yield from (leaf for leaf in (*first, *second) if isinstance(leaf, Dead))


def _refuted(leaves: list[Leaf]) -> bool:
    return bool(leaves) and all(leaf == NONZERO for leaf in leaves)
