"""Closures that must meet, because their dimensions add up: a count that proves one model to be a
limit of another.

Write the transfer functions of the larger model as N/D, and let its pairs (N : D) have
`coordinates` coefficients that do not vanish identically. The closure V of these pairs in the
projective space P of dimension `coordinates` - 1 has at least the dimension `rank`. A function n/d
is written there as (c n : c d) for every polynomial c with fitting powers of s; these pairs are a
linear subspace of dimension `factors` - 1. Two closed sets meet in a projective space if their
dimensions add up to at least that of the space (Hartshorne, Algebraic Geometry, I.7.2), so

    rank + factors >= coordinates

proves that some (c n : c d) lies in V: models of the larger kind exist whose transfer functions
tend to n/d, wherever c d is not zero. That holds for every n/d of these degrees.

`same_mass`: a free row with dampers between its masses alone has s^2 G = 1/m + O(s^2), m being its
total mass, for its momentum is the impulse. So the two lowest coefficients of D are those of N
times m. Multiplying all elements by a number multiplies m by it; so the pairs of V with a given m
have dimension rank - 1 at least. They lie, with all (c n : c d), in the subspace of the two
equations a_0 = m b_0 and a_1 = m b_1. So one dimension less is needed.
"""

from dataclasses import dataclass
from functools import lru_cache

from disting.behaviour.chain_model import ChainModel, Powers, powers
from disting.behaviour.sample import Representation, drawn, seen_at
from disting.model.row import rows_of
from disting.model.structure import Structure

POINTS = 2  # at which a rank is looked at; what is seen at one is a lower bound
REMEMBERED = 4096


@dataclass(frozen=True, slots=True)
class Room:
    """The numbers of the module's inequality."""

    rank: int
    coordinates: int
    factors: int
    same_mass: bool

    @property
    def suffices(self) -> bool:
        """Whether the dimensions add up."""
        return self.factors > 0 and self.rank + self.factors + self.same_mass >= self.coordinates


def room(small: Structure, large: Structure, seed: str = "meeting") -> Room:
    """The numbers for two structures with the same sensor, without dead time; the rank is seen
    at points of the seed.
    """
    wanted, given = powers(small), powers(large)
    factors = sum(_fits(c, wanted, given) for c in range(max(given[1]) + 1))
    return Room(least_rank(large, seed), sum(map(len, given)), factors, _same_mass(small, large))


def _fits(c: int, wanted: Powers, given: Powers) -> bool:
    """Whether s^c times the one has no other powers than the other."""
    return all({c + i for i in w} <= g for w, g in zip(wanted, given, strict=True))


@lru_cache(maxsize=REMEMBERED)
def least_rank(structure: Structure, seed: str = "meeting") -> int:
    """A lower bound of the rank of the coefficients: what has full rank modulo a prime has it
    over the rationals.
    """
    return max(_rank_at(structure, f"{seed}:{k}") for k in range(POINTS))


def most_rank(structure: Structure) -> int:
    """An upper bound of the rank: the number of parameters, or of coefficients up to a common
    factor.
    """
    return min(len(structure.parameters), sum(map(len, powers(structure))) - 1)


def _rank_at(structure: Structure, label: str) -> int:
    return int(seen_at(drawn(ChainModel(structure), label), Representation.TF, 0).jacobian.rank())


def _same_mass(small: Structure, large: Structure) -> bool:
    """Whether both tell the mass of a free row in the same two pairs of coefficients, odd
    powers of s among them.
    """
    mine, theirs = powers(small), powers(large)
    alike = all(min(m) == min(t) and min(t) + 1 in t for m, t in zip(mine, theirs, strict=True))
    return alike and all(_keeps_momentum(x) for x in (small, large))


def _keeps_momentum(structure: Structure) -> bool:
    """Whether neither springs nor dampers tie the last row, on which the force acts, to the ground;
    no lag.
    """
    row = rows_of(structure)[-1]
    return not (row.grounded or row.ground_dampers or structure.lag)
