"""Several transfer functions with one parameter vector as one polynomial map, for the ideal of its
fibre.

Where denominators are monic, equal transfer functions have equal coefficients. A denominator that
is not monic takes one more unknown, a common factor of all polynomials that share it (they are
those of one fraction N_1 : N_2 : .. : D only up to it). Parameters that occur nowhere are left out.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import groupby

from disting.algebra.certainty import digest
from disting.fibres.ideals.system import SCALE, Terms

Fraction = tuple[tuple[Terms, ...], tuple[Terms, ...]]
"""Coefficients of numerator and denominator, of s^0, s^1, .."""


@dataclass(frozen=True)
class StackedMap:
    """Parameters -> coefficients of all transfer functions, one after the other; `parts`: how many
    coordinates each numerator, each denominator has.
    """

    parameters: tuple[str, ...]
    coordinates: tuple[Terms, ...]
    parts: tuple[int, ...]

    @cached_property
    def content(self) -> str:
        """A digest of all that distinguishes two maps."""
        return digest(self.parameters, self.coordinates)

    def __hash__(self) -> int:
        return hash(self.content)


def stacked_maps(
    names: Sequence[tuple[str, ...]], sides: Sequence[Sequence[Fraction]]
) -> tuple[StackedMap, ...]:
    """The maps of some models, of equal degrees in the same order, in a form in which equal
    transfer functions are equal coordinates: they share a denominator where they do in all models.
    """
    shared = [tuple(f[1] for f in each) for each in zip(*sides, strict=True)]
    order = sorted(range(len(shared)), key=lambda i: shared.index(shared[i]))
    groups = [list(g) for _, g in groupby(order, key=lambda i: shared.index(shared[i]))]
    monic = [all(is_one(side[g[0]][1][-1]) for side in sides) for g in groups]
    return tuple(_stack(each, side, groups, monic) for each, side in zip(names, sides, strict=True))


def _stack(
    names: tuple[str, ...],
    fractions: Sequence[Fraction],
    groups: Sequence[Sequence[int]],
    monic: Sequence[bool],
) -> StackedMap:
    scales = [f"{SCALE}{k + 1}" for k, is_monic in enumerate(monic) if not is_monic]
    parts: list[list[Terms]] = []
    at = 0
    for group, is_monic in zip(groups, monic, strict=True):
        denominator = fractions[group[0]][1]
        whole = [*(fractions[i][0] for i in group), denominator[:-1] if is_monic else denominator]
        factor = [0] * len(scales)
        if not is_monic:
            factor[at], at = 1, at + 1
        parts += [[tuple(((*e, *factor), c) for e, c in terms) for terms in each] for each in whole]
    return map_of([*names, *scales], parts)


def map_of(names: Sequence[str], parts: Sequence[Sequence[Terms]]) -> StackedMap:
    """The map of these coordinates, in those of the parameters that occur in it."""
    coordinates = [terms for part in parts for terms in part]
    used = sorted({j for terms in coordinates for e, _ in terms for j, x in enumerate(e) if x})
    return StackedMap(
        tuple(names[j] for j in used),
        tuple(tuple((tuple(e[j] for j in used), c) for e, c in terms) for terms in coordinates),
        tuple(map(len, parts)),
    )


def is_one(terms: Terms) -> bool:
    """Return True if a polynomial is the constant 1."""
    return len(terms) == 1 and terms[0][1] == 1 and not any(terms[0][0])
