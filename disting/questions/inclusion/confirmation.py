"""Checks the evidence of an inclusion again, from itself alone."""

from dataclasses import astuple, replace
from math import comb

from disting.behaviour.chain_model import ChainModel
from disting.behaviour.sample import Representation, samples
from disting.decide import OF_INCLUSIONS, Of, check, deciders_of
from disting.evidence.conditions import Counts, FreeChoice
from disting.evidence.decision import DeadTime, FibreAt
from disting.evidence.ideals import ByRows, Refutation, Solutions
from disting.evidence.kind import POINTS, Labels
from disting.evidence.kinds import InclusionEvidence
from disting.evidence.limits import (
    AcrossSizes,
    FullImage,
    LargerProjection,
    Limit,
    LimitFibre,
    Meeting,
    MissingElements,
    Outside,
    PoleSharing,
    RelativeDegrees,
    RowLimit,
    RowsInside,
    TooLarge,
)
from disting.fibres.ideals import Limits, coefficient_map, confirms_by_rows, decide, normalise
from disting.model.chain import Chain, Sensor, Structure
from disting.model.question import Membership
from disting.model.row import Row, canonical_rows
from disting.questions.inclusion.across_sizes import (
    ChainSide,
    degrees_of,
    exceeds,
    fewer_poles,
    twins,
)
from disting.questions.inclusion.closures import confirms_rows
from disting.questions.inclusion.limit_fibre import contains
from disting.questions.inclusion.limits import Room, follows, room
from disting.questions.inclusion.pole_sharing import excludes
from disting.questions.inclusion.profiles import confirms_missing, exceed, order
from disting.questions.same.evidence_check import Witness
from disting.questions.same.exact import rational_part

OfFibre = Outside | RowsInside | ByRows | FibreAt | Solutions | Refutation
PLAIN_MONOMIALS = 1500  # that plain elimination bears for a catalogue


def confirms(evidence: InclusionEvidence, left: ChainSide, right: ChainSide) -> bool:
    """Return True if the evidence holds for the two chains, at fresh points, and refers to the one
    with fewer masses or, for equal sizes, the one of smaller rank.

    A fibre is computed again. The ranks of the two models are taken from their profiles.
    """
    return check(evidence, deciders_of(Of.CHAINS, OF_INCLUSIONS), left, right)


def check_counts(evidence: Counts, left: ChainSide, right: ChainSide) -> bool:
    """Degrees that exceed those of limits, and are those of both."""
    if left.chain.n_masses != right.chain.n_masses:
        return check_across_sizes(evidence, left, right)
    small, large = order(evidence.left, evidence.right, _left_is_smaller(left, right))
    return exceed(small, large) and _fresh().confirms(evidence, "tf", *_forms(left, right))


def check_profiles(
    evidence: Counts | LargerProjection | FullImage, left: ChainSide, right: ChainSide
) -> bool:
    """Degrees, ranks of a projection, or a full image."""
    match evidence:
        case Counts():
            return check_counts(evidence, left, right)
        case LargerProjection():
            return check_projection(evidence, left, right)
        case FullImage():
            return check_full_image(evidence, left, right)


def check_missing(evidence: MissingElements, left: ChainSide, right: ChainSide) -> bool:
    """The part is the one of smaller rank, by this numbering."""
    is_smaller = evidence.left_is_part == _left_is_smaller(left, right)
    return is_smaller and confirms_missing(evidence, *_forms(left, right))


def check_dead_time(evidence: DeadTime, left: ChainSide, right: ChainSide) -> bool:
    """Return True if exactly one of them, the stated one, has a dead time."""
    dead_times = (left.chain.dead_time, right.chain.dead_time)
    return dead_times == (evidence.left_given, not evidence.left_given)


def check_projection(evidence: LargerProjection, left: ChainSide, right: ChainSide) -> bool:
    """Ranks of these invariants at fresh points, the larger one of the smaller model."""
    first, second = order(evidence.left, evidence.right, _left_is_smaller(left, right))
    ranks = (evidence.left, evidence.right)
    return first > second and _ranks(evidence.rows, *_forms(left, right)) == ranks


def check_full_image(evidence: FullImage, left: ChainSide, right: ChainSide) -> bool:
    """Free choice of these invariants in the larger model, all others the same in both."""
    a, b = _forms(left, right)
    larger, free = (a if evidence.left_is_larger else b), evidence.free
    is_turned = evidence.left_is_larger != _left_is_smaller(left, right)
    same = is_turned and _same_elsewhere(free, a, b)
    return same and _fresh().confirms(FreeChoice(evidence.rank, free), "tf", larger, larger)


def check_relative_degrees(evidence: RelativeDegrees, left: ChainSide, right: ChainSide) -> bool:
    """Relative degrees, written out."""
    a, b = _forms(left, right)
    larger, smaller = (a, b) if evidence.left_is_larger else (b, a)
    degrees = order(evidence.left, evidence.right, not evidence.left_is_larger)
    is_turned = evidence.left_is_larger != _left_is_smaller(left, right)
    return is_turned and _fall_apart(smaller, larger, *degrees)


def check_fibre(evidence: OfFibre, left: ChainSide, right: ChainSide) -> bool:
    """The fibre of the model of smaller rank, or its rows, once more."""
    is_smaller = evidence.left_given == _left_is_smaller(left, right)
    return is_smaller and _found_again(evidence, *_forms(left, right))


def _forms(left: ChainSide, right: ChainSide) -> tuple[Chain, Chain]:
    return left.canonical.chain, right.canonical.chain


def _left_is_smaller(left: ChainSide, right: ChainSide) -> bool:
    return (left.chain.n_masses, left.rank) < (right.chain.n_masses, right.rank)


def _fresh() -> Witness:
    return Witness("inclusion")


def _found_again(evidence: OfFibre, a: Chain, b: Chain) -> bool:
    """Recompute the result of the fibre of the given model, or of its rows."""
    fresh = _fresh()
    match evidence:
        case Outside() | RowsInside():
            return confirms_rows(evidence, *((a, b) if evidence.left_given else (b, a)))
        case ByRows():
            return confirms_by_rows(evidence, rational_part(a), rational_part(b))
        case FibreAt() | Solutions():
            return fresh.confirms(evidence, "tf", a, b)
        case Refutation():
            return not evidence.tangent and (
                _refuted_again(a, b, evidence)
                if _is_large(evidence, a, b)
                else fresh.confirms(evidence, "tf", a, b)
            )


def check_across_sizes(evidence: AcrossSizes | Counts, left: ChainSide, right: ChainSide) -> bool:
    """Return True if the evidence holds for two chains of different sizes; ranks are taken from
    their profiles, counts made at fresh points.
    """
    if left.chain.n_masses == right.chain.n_masses:
        return False
    left_is_larger = left.chain.n_masses > right.chain.n_masses
    small, large = (right, left) if left_is_larger else (left, right)
    smaller, larger = small.canonical.chain, large.canonical.chain
    match evidence:
        case Counts():
            same = (evidence.left, evidence.right) == order(
                degrees_of(smaller), degrees_of(larger), not left_is_larger
            )
            return same and exceeds(smaller, larger) and fewer_poles(smaller, larger)
        case TooLarge():
            same = (evidence.left, evidence.right) == (left.rank, right.rank)
            return same and small.rank >= large.rank and fewer_poles(smaller, larger)
        case Limit():
            a, b = _twin(smaller, evidence.smaller), _twin(larger, evidence.larger)
            followed = a is not None and b is not None and _follow(evidence.parts, a, b)
            return evidence.left_is_larger == left_is_larger and followed
        case Meeting():
            stated = Room(evidence.rank, evidence.coordinates, evidence.factors, evidence.same_mass)
            again = room(rational_part(smaller), rational_part(larger), "verify")
            return evidence.left_is_larger == left_is_larger and again == stated and stated.suffices
        case PoleSharing():
            fewer = evidence.left_is_larger == left_is_larger and fewer_poles(smaller, larger)
            return fewer and excludes(smaller, larger, evidence.label, evidence.points)
        case LimitFibre():
            solved = Solutions(evidence.small_given, evidence.labels, evidence.solutions)
            return evidence.left_is_larger == left_is_larger and contains(
                smaller, larger, evidence.steps, solved
            )


def _twin(chain: Chain, indices: tuple[int, ...]) -> Chain | None:
    """The twin with these indices; the chain itself for ()."""
    return (
        next((c for c in twins(chain) if tuple(c.indices) == indices), None) if indices else chain
    )


def _follow(limits: tuple[RowLimit, ...], small: Chain, large: Chain) -> bool:
    """Return True if these are all rows of the smaller chain, made from different rows of the
    larger one.
    """
    wanted, rows = canonical_rows(small.structure), canonical_rows(large.structure)
    names = sorted(p.wanted for p in limits), {p.given for p in limits}
    complete = (
        names[0] == sorted(wanted) and len(names[1]) == len(limits) and names[1] <= rows.keys()
    )
    return (
        small.lag == large.lag
        and complete
        and all(_leads(p, rows[p.given], wanted[p.wanted]) for p in limits)
    )


def _leads(limit: RowLimit, row: Row, target: Row) -> bool:
    ends = follows(row, limit.steps)
    if not limit.room:
        return target in ends
    counts = (room(target.structure, below.structure, "verify") for below in ends)
    return any(c.suffices and tuple(map(int, astuple(c))) == limit.room for c in counts)


def _is_large(evidence: Refutation, a: Chain, b: Chain) -> bool:
    """Return True if plain elimination has too many monomials."""
    unknowns = max(len(coefficient_map(rational_part(c)).parameters) for c in (a, b))
    return comb(unknowns + 1 + evidence.degree, evidence.degree) > PLAIN_MONOMIALS


def _refuted_again(a: Chain, b: Chain, evidence: Refutation) -> bool:
    """Return True if the decision is the same at fresh points and primes."""
    coordinates = normalise if evidence.is_normalised else coefficient_map
    chain, other = (
        coordinates(rational_part(c)) for c in ((a, b) if evidence.left_given else (b, a))
    )
    again = decide(
        chain,
        other,
        equal_rank=False,
        seed="verify",
        limits=Limits(seconds=600, entries=10**9, safety=1),
    )
    return again.membership is Membership.EXCLUDED


def _ranks(rows: Labels, a: Chain, b: Chain) -> tuple[int, int] | None:
    """Ranks of named invariants of both chains at fresh points; None for coefficients if they have
    different numbers of poles.
    """
    ranks = [
        list(samples(ChainModel(c.structure), Representation.TF, 0, POINTS, "inclusion"))
        for c in (a, b)
    ]
    small_rank, large_rank = (
        max(s.rank(tuple(i for i, x in enumerate(s.labels) if x in rows)) for s in each)
        for each in ranks
    )
    poles = {sum(x[0] == "a" for x in each[0].labels) for each in ranks}
    return (small_rank, large_rank) if len(poles) == 1 or rows == ("Td",) else None


def _same_elsewhere(free: Labels, a: Chain, b: Chain) -> bool:
    """Return True if all invariants but the free ones have the same values in both chains at fresh
    points, absent ones zero.
    """
    drawn = [
        list(samples(ChainModel(c.structure), Representation.TF, 0, POINTS, "inclusion"))
        for c in (a, b)
    ]
    values = [[dict(zip(s.labels, s.values, strict=True)) for s in each] for each in drawn]
    poles = {sum(x[0] == "a" for x in each[0]) for each in values}
    labels = {*values[0][0], *values[1][0]} - set(free)
    return len(poles) == 1 and all(
        x.get(n, 0) == y.get(n, 0) for x, y in zip(*values, strict=True) for n in labels
    )


def _fall_apart(small: Chain, large: Chain, small_rank: int, large_rank: int) -> bool:
    """Return True if in the expanded transfer functions the first one's relative degree is
    `small_rank` at least, the second one's always `large_rank`, smaller; or the first one's
    `small_rank`, the second one's never below `large_rank`, larger.

    That is so if both leading coefficients are products of elements; or that of the denominator.
    """
    first, second = (coefficient_map(_receptance(c)) for c in (small, large))
    (low, poles), (top, others) = first.degrees, second.degrees
    if len(second.denominator[-1]) > 1 or others - top != large_rank:
        return False
    if small_rank < large_rank:
        return poles - low == small_rank
    return len(second.numerator[top]) == 1 and poles - low >= small_rank > large_rank


def _receptance(chain: Chain) -> Structure:
    """The structure with a sensor of position, without dead time."""
    return replace(chain, sensor=Sensor.POSITION, dead_time=False).structure
