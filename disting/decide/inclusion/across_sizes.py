"""Inclusion of a chain in one with more masses: whether its models are limits of models of the
larger kind.

The smaller model has fewer poles, but it may lie in the closure of the larger one, where poles and
zeros cancel. What settles a pair first is kept:

1. Degrees: a limit has no more zeros and poles than the models that it is a limit of (see
   `profiles`). Refuted.
2. `limits`: elements that vanish or grow without bound, row by row, each an identity that is
   computed. Proven.
3. `limits` too: dimensions that add up, for the whole or for a row after such limits. Proven.
4. `model.minors`: what has no lag, or no dead time, is a limit of what has one. Proven.
5. Ranks: limits with fewer poles are a proper closed subset, so of smaller dimension. Refuted,
   with the rank's error bound.
6. `pole_sharing`: models of the smaller kind that are no limits. Refuted; this costs more.
7. `limit_fibre`: the smaller models among what limits of rows lead to. Found with an error bound.

The larger chain, with more poles, never lies in the smaller one: its generic model does not have
as few.
"""

from collections.abc import Iterator
from dataclasses import astuple
from functools import lru_cache
from itertools import permutations, product

from disting.algebra.certainty import Certainty, about
from disting.behaviour.chain_model import degrees
from disting.behaviour.sample import Representation
from disting.conditions.chain_view import ChainSide
from disting.conditions.inclusion import Inclusion, InclusionFinding
from disting.decide.inclusion.limit_fibre import find_containment
from disting.decide.inclusion.limits import follows, reach, room
from disting.decide.inclusion.pole_sharing import excluding_points, exclusion_safety
from disting.decide.inclusion.profiles import by_elements, exceed, order
from disting.decide.same.exact import rational_part, theorem
from disting.evidence.conditions import Counts
from disting.evidence.limits import (
    Limit,
    LimitFibre,
    Meeting,
    PoleSharing,
    RowLimit,
    TooLarge,
)
from disting.model.chain import Chain
from disting.model.family import Family
from disting.model.question import Settings
from disting.model.row import Row, canonical_rows
from disting.model.symmetry import canonical

REMEMBERED = 1024  # chains whose twins are kept


def by_sizes(left: ChainSide, right: ChainSide) -> InclusionFinding | None:
    """Inclusion of chains of different sizes, of one sensor quantity; None where `compute` must
    decide.
    """
    left_is_larger = left.chain.n_masses > right.chain.n_masses
    small, large = (right, left) if left_is_larger else (left, right)
    first, second = small.view.form, large.view.form
    finding = show_inclusion(first, second, left_is_larger)
    if finding is not None:
        inside = Inclusion.RIGHT_IN_LEFT if left_is_larger else Inclusion.LEFT_IN_RIGHT
        return InclusionFinding(inside, Certainty.PROVEN, evidence=finding)
    by_element = by_elements(first, second, not left_is_larger)
    if by_element is not None and (
        by_element.inclusion is not Inclusion.NEITHER or fewer_poles(first, second)
    ):
        return by_element
    if not fewer_poles(first, second):
        return InclusionFinding(
            Inclusion.UNKNOWN, reason="no limit is known, and the smaller chain has as many poles"
        )
    return refute(small, large, left_is_larger)


def compute(small: Chain, large: Chain, settings: Settings) -> InclusionFinding:
    """Compute the finding that takes longer, for a chain with fewer masses on the left: its poles
    against inclusion, a fibre of limits for it.
    """
    label = about(f"{settings.seed}:poles", small, large)
    points = excluding_points(small, large, label) if fewer_poles(small, large) else ()
    if points:
        safety = exclusion_safety(large) if len(points) > 1 else 0
        grade = Certainty.BOUNDED if safety else Certainty.PROVEN
        return InclusionFinding(Inclusion.NEITHER, grade, safety, PoleSharing(False, label, points))
    inside = find_containment(small, large, settings.seed)
    if inside is None:
        return InclusionFinding(Inclusion.UNKNOWN, reason="no limit is known, and none is excluded")
    solved = inside.solved
    evidence = LimitFibre(
        left_is_larger=False,
        steps=inside.steps,
        small_given=solved.left_given,
        labels=solved.labels,
        solutions=solved.solutions,
    )
    return InclusionFinding(Inclusion.LEFT_IN_RIGHT, Certainty.BOUNDED, inside.safety, evidence)


def show_inclusion(small: Chain, large: Chain, left_is_larger: bool) -> Limit | Meeting | None:
    """Evidence that the smaller chain is a limit of the larger one; None if there is none."""
    if exceeds(small, large) or small.dead_time > large.dead_time:
        return None
    limits = next(row_limits(small, large, counting=False), None)
    if limits is not None:
        return Limit(left_is_larger, limits)
    whole = room(rational_part(small), rational_part(large))
    if whole.suffices:
        return Meeting(left_is_larger, *astuple(whole))
    return next(_indirect(small, large, left_is_larger), None)


def _indirect(small: Chain, large: Chain, left_is_larger: bool) -> Iterator[Limit]:
    """Limits with a count of dimensions, and limits of chains that are equivalent by a theorem."""
    for limits in row_limits(small, large, counting=True):
        yield Limit(left_is_larger, limits)
    for low, high in product(twins(small), twins(large)):
        for limits in row_limits(low, high, counting=False):
            yield Limit(left_is_larger, limits, tuple(low.indices), tuple(high.indices))


@lru_cache(maxsize=REMEMBERED)
def twins(chain: Chain) -> tuple[Chain, ...]:
    """The canonical chains that are equivalent by a theorem, itself included; itself alone if it is
    in no family.
    """
    if chain.ground_dampers or chain.lag or chain.dead_time:
        return (chain,)
    members = Family(chain.n_masses, chain.damped, chain.quantity)
    return tuple(dict.fromkeys(canonical(c).chain for c in members if theorem(chain, c)))


def row_limits(small: Chain, large: Chain, *, counting: bool) -> Iterator[tuple[RowLimit, ...]]:
    """Yield the ways to make the rows of the smaller chain from different rows of the larger one.

    `counting`: not by limits of elements alone, but also by a count of dimensions after them.
    """
    if small.lag != large.lag:
        return
    wanted, rows = canonical_rows(small.structure), canonical_rows(large.structure)
    for chosen in permutations(rows, len(wanted)):
        pairs = list(zip(chosen, wanted, strict=True))
        limits = [_row_limit(a, rows[a], b, wanted[b], counting) for a, b in pairs]
        if all(limit is not None for limit in limits):
            yield tuple(limit for limit in limits if limit is not None)


def refute(small: ChainSide, large: ChainSide, left_is_larger: bool) -> InclusionFinding | None:
    """Finding of degrees and ranks against the inclusion of a chain with fewer poles; None if there
    is none.
    """
    first, second = small.view.form, large.view.form
    if exceeds(first, second):
        counts = Counts(*order(degrees_of(first), degrees_of(second), not left_is_larger))
        return InclusionFinding(Inclusion.NEITHER, Certainty.PROVEN, evidence=counts)
    if small.rank >= large.rank:
        ranks = TooLarge(*order(small.rank, large.rank, not left_is_larger))
        safety = large.profile(Representation.TF, 0).safety
        return InclusionFinding(Inclusion.NEITHER, Certainty.BOUNDED, safety, ranks)
    return None


def exceeds(small: Chain, large: Chain) -> bool:
    """More zeros or more poles than any limit of the larger chain has."""
    return exceed(degrees_of(small), degrees_of(large))


def fewer_poles(small: Chain, large: Chain) -> bool:
    """Return True if the larger chain cannot be contained in the smaller one."""
    return degrees_of(small)[1] < degrees_of(large)[1]


def degrees_of(chain: Chain) -> tuple[int, int]:
    """Degrees of numerator and denominator, without a dead time."""
    return degrees(rational_part(chain))


def _row_limit(name: str, row: Row, wanted: str, target: Row, counting: bool) -> RowLimit | None:
    """A way from one row to the other, each of its limits an identity; limits of elements alone
    first.
    """
    ways = reach(row)
    if target in ways and target in follows(row, ways[target]):
        return RowLimit(name, wanted, ways[target])
    for below, steps in ways.items() if counting else ():
        space = room(target.structure, below.structure)
        if space.suffices and below in follows(row, steps):
            return RowLimit(name, wanted, steps, tuple(map(int, astuple(space))))
    return None
