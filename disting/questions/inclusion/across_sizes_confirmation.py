"""Checks what was found about the inclusion of a chain in one with more masses again, from the
evidence alone.
"""

from dataclasses import astuple

from disting.evidence.across_sizes import (
    AcrossSizes,
    Limit,
    LimitFibre,
    Meeting,
    PoleSharing,
    RowLimit,
    TooLarge,
)
from disting.evidence.conditions import Counts
from disting.evidence.ideals import Solved
from disting.model.chain import Chain
from disting.model.row import Row, canonical_rows
from disting.questions.inclusion.across_sizes import degrees_of, exceeds, fewer_poles, twins
from disting.questions.inclusion.limit_fibre import contains
from disting.questions.inclusion.limits import follows
from disting.questions.inclusion.meeting import Room, room
from disting.questions.inclusion.pole_sharing import excludes
from disting.questions.inclusion.profiles import ordered
from disting.questions.inclusion.side import ChainSide
from disting.questions.same.exact import rational_part


def confirms_across_sizes(
    evidence: AcrossSizes | Counts, left: ChainSide, right: ChainSide
) -> bool:
    """Whether the evidence is true of the two chains; ranks are taken from their profiles,
    counts made at fresh points.
    """
    left_is_larger = left.chain.n_masses > right.chain.n_masses
    small, large = (right, left) if left_is_larger else (left, right)
    one, other = small.canonical.chain, large.canonical.chain
    match evidence:
        case Counts():
            same = (evidence.left, evidence.right) == ordered(
                degrees_of(one), degrees_of(other), not left_is_larger
            )
            return same and exceeds(one, other) and fewer_poles(one, other)
        case TooLarge():
            same = (evidence.left, evidence.right) == (left.rank, right.rank)
            return same and small.rank >= large.rank and fewer_poles(one, other)
        case Limit():
            a, b = _twin(one, evidence.smaller), _twin(other, evidence.larger)
            known = a is not None and b is not None and _follow(evidence.parts, a, b)
            return evidence.left_is_larger == left_is_larger and known
        case Meeting():
            told = Room(evidence.rank, evidence.coordinates, evidence.factors, evidence.same_mass)
            again = room(rational_part(one), rational_part(other), "verify")
            return evidence.left_is_larger == left_is_larger and again == told and told.suffices
        case PoleSharing():
            fewer = evidence.left_is_larger == left_is_larger and fewer_poles(one, other)
            return fewer and excludes(one, other, evidence.label, evidence.points)
        case LimitFibre():
            solved = Solved(evidence.small_given, evidence.labels, evidence.solutions)
            return evidence.left_is_larger == left_is_larger and contains(
                one, other, evidence.steps, solved
            )


def _twin(chain: Chain, indices: tuple[int, ...]) -> Chain | None:
    """The twin with these indices; the chain itself for ()."""
    return (
        next((c for c in twins(chain) if tuple(c.indices) == indices), None) if indices else chain
    )


def _follow(limits: tuple[RowLimit, ...], small: Chain, large: Chain) -> bool:
    """Whether these are all rows of the smaller chain, made from different rows of the
    larger one.
    """
    wanted, given = canonical_rows(small.structure), canonical_rows(large.structure)
    names = sorted(p.wanted for p in limits), {p.given for p in limits}
    complete = (
        names[0] == sorted(wanted) and len(names[1]) == len(limits) and names[1] <= given.keys()
    )
    return (
        small.lag == large.lag
        and complete
        and all(_leads(p, given[p.given], wanted[p.wanted]) for p in limits)
    )


def _leads(limit: RowLimit, row: Row, target: Row) -> bool:
    ends = follows(row, limit.steps)
    if not limit.room:
        return target in ends
    counts = (room(target.structure, below.structure, "verify") for below in ends)
    return any(c.suffices and tuple(map(int, astuple(c))) == limit.room for c in counts)
