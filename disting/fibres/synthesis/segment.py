"""Every chain without a gap that has a given receptance: which method serves which ports."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

from flint import acb_poly

from disting.fibres.synthesis.ball import Ball, Poly
from disting.fibres.synthesis.branch_ends import Leaf, Part


@dataclass(frozen=True, slots=True)
class Segment:
    """n nodes in a row, left end at the wall or free, right end free; ports a <= b, numbered from
    1.

    q = 2: in s; q = 1: in x = s^2, neither springs nor nodes are damped. `dampers`: the nodes with
    a damper to the ground; `elastic`: no dampers beside the springs, though in s; `alone`: the
    chain has no other part, so its poles are all known.
    """

    nodes: int
    a: int
    b: int
    wall: bool
    q: int
    dampers: tuple[int, ...] = ()
    elastic: bool = False
    alone: bool = False

    @property
    def distance(self) -> int:
        """Springs between the ports."""
        return self.b - self.a

    @property
    def numerator_degree(self) -> int:
        """Degree of theta_(a-1) k_a .. k_(b-1) phi_(b+1): q (n - 1) less one (damped) or q
        (undamped) a spring.
        """
        return self.q * (self.nodes - 1) - self.distance * (1 + self.elastic)

    @property
    def decay(self) -> int:
        """How many of the leading terms of H = sum h_i s^(-i-1) (or in x) vanish."""
        return self.distance * (1 + self.elastic) + self.q - 1

    @property
    def poles_at_zero(self) -> int:
        """Multiplicity of the pole at 0 of a free row: a motion of the whole, stopped by
        dampers to the ground.
        """
        return 1 if self.dampers else self.q

    @property
    def mirrored(self) -> "Segment":
        """The same chain seen from the other side; only if both ends are free."""
        dampers = tuple(self.nodes + 1 - i for i in reversed(self.dampers))
        return replace(self, a=self.nodes + 1 - self.b, b=self.nodes + 1 - self.a, dampers=dampers)


@dataclass(frozen=True, slots=True)
class Data:
    """Receptance of a segment: numerator over monic denominator, in s (damped) or x = s^2
    (undamped).

    `exact`: the numerator as fmpq_poly, if the coefficients of both are rational and known.
    """

    numerator: Poly
    denominator: Poly
    exact: Poly | None = None

    def gain(self, segment: Segment) -> Ball:
        """Leading coefficient of the numerator."""
        return self.numerator[segment.numerator_degree]

    @property
    def even(self) -> "Data":
        """In x = s^2, of a function of s^2."""
        return Data(
            acb_poly(self.numerator.coeffs()[::2]), acb_poly(self.denominator.coeffs()[::2])
        )


def mirrored(leaf: Leaf) -> Leaf:
    """The same part read from right to left."""
    if not isinstance(leaf, Part):
        return leaf
    return replace(
        leaf, masses=leaf.masses[::-1], springs=leaf.springs[::-1], dampers=leaf.dampers[::-1]
    )


def splits(items: list[Ball], size: int) -> Iterator[tuple[list[Ball], list[Ball]]]:
    """Every choice of `size` items, with the rest."""
    from itertools import combinations

    for chosen in combinations(range(len(items)), size):
        yield [items[i] for i in chosen], [z for i, z in enumerate(items) if i not in chosen]
