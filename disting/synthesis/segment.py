"""Every chain without a gap that has a given receptance: which method serves which ports."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

from disting.synthesis.ball import Ball, Poly
from disting.synthesis.leaves import Leaf, Part


@dataclass(frozen=True, slots=True)
class Segment:
    """n nodes in a row, left end at the wall or free, right end free; ports a <= b, numbered from 1; q = 2 damped, 1 not."""

    nodes: int
    a: int
    b: int
    wall: bool
    q: int

    @property
    def distance(self) -> int:
        """Springs between the ports."""
        return self.b - self.a

    @property
    def numerator_degree(self) -> int:
        """Degree of theta_(a-1) k_a .. k_(b-1) phi_(b+1): q (n - 1) less one (damped) or q (undamped) a spring."""
        return self.q * (self.nodes - 1) - self.distance

    @property
    def mirrored(self) -> "Segment":
        """The same chain seen from the other side; only if both ends are free."""
        return replace(self, a=self.nodes + 1 - self.b, b=self.nodes + 1 - self.a)


@dataclass(frozen=True, slots=True)
class Data:
    """Receptance of a segment: numerator over monic denominator, in s (damped) or x = s^2 (undamped)."""

    numerator: Poly
    denominator: Poly

    def gain(self, segment: Segment) -> Ball:
        """Leading coefficient of the numerator."""
        return self.numerator[segment.numerator_degree]


def mirrored(leaf: Leaf) -> Leaf:
    """The same part read from right to left."""
    return replace(leaf, masses=leaf.masses[::-1], springs=leaf.springs[::-1]) if isinstance(leaf, Part) else leaf


def splits(items: list[Ball], size: int) -> Iterator[tuple[list[Ball], list[Ball]]]:
    """Every choice of `size` items, with the rest."""
    from itertools import combinations

    for chosen in combinations(range(len(items)), size):
        yield [items[i] for i in chosen], [z for i, z in enumerate(items) if i not in chosen]
