"""Inclusion of a measured chain in another one of larger rank, where it follows from known results
on both: no fibre is computed.

Inside. If the one is the other with elements missing, and all experiments are at the same masses of
both, then elements that vanish or grow without bound carry every transfer function of the larger
model into that of the smaller one, whatever is locked or added (`model.minors`).

Outside. If V1 lies inside V2, so do their projections on one experiment, and on every set of
coefficients. So one experiment is enough in which no limit has the degrees (the lemma of
`decide.inclusion.profiles`, which speaks of finite elements only where it says so), in which the
one sensor moves and the other one never does, or in which the model that has the smaller rank in
all of them together has the larger one.
"""

from collections.abc import Callable, Iterator
from dataclasses import replace
from fractions import Fraction
from functools import cache

from disting.algebra.certainty import Certainty, grade_of
from disting.behaviour.profile import Profile
from disting.behaviour.sample import Representation
from disting.conditions.inclusion import Inclusion, InclusionFinding, Inclusions
from disting.conditions.side import AnySide
from disting.decide import CLOSURE_MEASURED, first_finding
from disting.decide.inclusion.profiles import (
    by_missing_elements,
    by_profiles,
    exceed,
    order,
    without_dead_time,
)
from disting.evidence.conditions import Counts
from disting.evidence.limits import LargerProjection, MissingElements
from disting.experiments.experiment import Experiment, MeasuredChain
from disting.experiments.machine_model import MachineModel
from disting.model.kinds import Kind
from disting.model.minors import embeddings, is_minor, minors

IMAGE_NOT_ASKED = "with several experiments only limits are decided"
NOT_SETTLED = "neither missing elements nor a single experiment decides it"
ProfileOf = Callable[[MeasuredChain], Profile]


def inclusions_under(
    left: MeasuredChain, right: MeasuredChain, profile_of: ProfileOf
) -> Inclusions:
    """Both statements on two measured chains of unequal rank; equivalents are not searched where
    limits are not excluded.
    """
    profile_of = cache(profile_of)
    ranks = [profile_of(m).rank for m in (left, right)]
    first = ranks[0] < ranks[1]
    small, large = order(left, right, first)
    closure: InclusionFinding | None = first_finding(
        CLOSURE_MEASURED.rows, small, large, profile_of, first
    )
    if closure is None:
        closure = InclusionFinding(Inclusion.UNKNOWN, reason=NOT_SETTLED)
    if closure.inclusion is Inclusion.NEITHER:
        return Inclusions(closure, closure)
    return Inclusions(InclusionFinding(Inclusion.UNKNOWN, reason=IMAGE_NOT_ASKED), closure)


def of_sides(left: AnySide, right: AnySide) -> Inclusions:
    """Return both statements on two sides: profiles are those of the coefficients, without
    dependences.
    """

    def profile_of(measured: MeasuredChain) -> Profile:
        settings = replace(left.settings, subset_limit=0)
        return left.source(MachineModel(measured), Representation.TF, 0, settings)

    return inclusions_under(left.subject, right.subject, profile_of)


def numbering(part: MeasuredChain, whole: MeasuredChain) -> dict[int, int] | None:
    """Masses of the whole, which has more elements, for those of the part, such that all elements
    and all experiments of the part are there; None if there are none.

    >>> from disting.experiments.experiment import Experiment
    >>> from disting.model.chain import Chain
    >>> both = (Experiment(), Experiment(sensor=1))
    >>> one, other = (MeasuredChain(Chain(2, ground_dampers=b), both) for b in ((), (2,)))
    >>> numbering(one, other), numbering(other, one)
    ({0: 0, 1: 1, 2: 2}, None)
    """
    return next(numberings(part, whole), None)


def numberings(part: MeasuredChain, whole: MeasuredChain) -> Iterator[dict[int, int]]:
    """Yield all such numberings."""
    mine, theirs = part.chain.structure, whole.chain.structure
    if len(mine.elements) >= len(theirs.elements):
        return iter(())
    ways = embeddings(mine, theirs)
    return (places for places in ways if _keeps(places, part, whole))


def places_in(part: MeasuredChain, whole: MeasuredChain) -> Iterator[dict[int, int]]:
    """Yield the places of masses of the whole in the part at which elements of the whole that
    vanish or grow without bound make the part of it in all experiments (see `model.minors`).

    >>> from disting.experiments.experiment import Experiment
    >>> from disting.model.chain import Chain
    >>> one, two = (MeasuredChain(c, (Experiment(),)) for c in (Chain(1), Chain(2, meas_plus=2)))
    >>> list(places_in(one, two))
    [{0: 0, 1: 1, 2: 1}]
    """
    pairs = {
        pair
        for inner, outer in zip(part.entries, whole.entries, strict=True)
        for pair in zip(outer.attached, inner.attached, strict=True)
    }
    ports = dict(pairs)
    if len(ports) < len(pairs):
        return iter(())
    ways = minors(part.chain.structure, whole.chain.structure, ports)
    return (places for places in ways if _keeps(places, whole, part))


def confirms_missing(evidence: MissingElements, left: MeasuredChain, right: MeasuredChain) -> bool:
    """Return True if the numbering makes the one a part of the other, in all experiments."""
    part, whole = (left, right) if evidence.left_is_part else (right, left)
    places = {i: at for at, i in evidence.numbering}
    is_part = is_minor(part.chain.structure, whole.chain.structure, places)
    return is_part and len(places) == len(evidence.numbering) and _keeps(places, whole, part)


def _keeps(places: dict[int, int], measured: MeasuredChain, other: MeasuredChain) -> bool:
    """Return True if every experiment becomes that on the other chain when the nodes of the one are
    at these places of the other; a change at a mass without a place has no effect.
    """
    same = {i: i for i in range(other.chain.n_masses + 1)}
    return all(
        tuple(map(places.get, mine.attached)) == theirs.attached
        and mine.sensor_order == theirs.sensor_order
        and _changes(mine.experiment, places) == _changes(theirs.experiment, same)
        for mine, theirs in zip(measured.entries, other.entries, strict=True)
    )


def _changes(
    experiment: Experiment, places: dict[int, int]
) -> dict[tuple[Kind, int], Fraction | None]:
    """Changes at each place except the ground; sizes at one place add up."""
    done = dict[tuple[Kind, int], Fraction | None]()
    for change in experiment.changes:
        at = places.get(change.place)
        if at:
            change_at = change.kind, at
            done[change_at] = (
                None if change.size is None else change.size + (done.get(change_at) or 0)
            )
    return done


def of_missing_elements(
    small: MeasuredChain, large: MeasuredChain, profile_of: ProfileOf, first: bool
) -> InclusionFinding | None:
    """Elements that vanish or grow without bound, in all experiments."""
    places = next(places_in(small, large), None)
    return None if places is None else by_missing_elements(places, first)


def of_dead_time(
    small: MeasuredChain, large: MeasuredChain, profile_of: ProfileOf, first: bool
) -> InclusionFinding | None:
    """A dead time of the one of smaller rank alone."""
    is_alone = small.chain.dead_time and not large.chain.dead_time
    return without_dead_time(first) if is_alone else None


def of_degrees(
    small: MeasuredChain, large: MeasuredChain, profile_of: ProfileOf, first: bool
) -> InclusionFinding | None:
    """An experiment in which the degrees exceed those of limits."""
    for smaller, larger in _degree_pairs(small, large, profile_of):
        if exceed(smaller, larger):
            counts = Counts(*order(smaller, larger, first))
            return InclusionFinding(Inclusion.NEITHER, Certainty.PROVEN, evidence=counts)
    return None


def have_equal_poles(
    small: MeasuredChain, large: MeasuredChain, profile_of: ProfileOf, first: bool
) -> bool:
    """Return True for as many poles in every experiment."""
    pairs = _degree_pairs(small, large, profile_of)
    return all(smaller[1] == larger[1] for smaller, larger in pairs)


def of_one_experiment(
    small: MeasuredChain, large: MeasuredChain, profile_of: ProfileOf, first: bool
) -> InclusionFinding | None:
    """An experiment in which the model of the smaller rank has the larger one."""
    for k, pair in enumerate(zip(small.experiments, large.experiments, strict=True)):
        alone = (MeasuredChain(m.chain, (e,)) for m, e in zip((small, large), pair, strict=True))
        mine, theirs = map(profile_of, alone)
        if mine.rank > theirs.rank:
            labels = tuple(name.replace("[1]", f"[{k + 1}]") for name in mine.labels)
            ranks = order(mine.rank, theirs.rank, first)
            grade = grade_of(theirs.rank_proven, min(mine.safety, theirs.safety) - 1)
            return InclusionFinding(Inclusion.NEITHER, *grade, LargerProjection(labels, *ranks))
    return None


def of_profiles(
    small: MeasuredChain, large: MeasuredChain, profile_of: ProfileOf, first: bool
) -> InclusionFinding | None:
    """Ranks of projections, or a full image, of all experiments together."""
    return by_profiles(profile_of(small), profile_of(large), left_is_smaller=first)


def _degree_pairs(
    small: MeasuredChain, large: MeasuredChain, profile_of: ProfileOf
) -> list[tuple[tuple[int, int], tuple[int, int]]]:
    """Degrees of both in every experiment."""
    return list(zip(_pairs(profile_of(small)), _pairs(profile_of(large)), strict=True))


def _pairs(profile: Profile) -> list[tuple[int, int]]:
    return list(zip(profile.degrees[::2], profile.degrees[1::2], strict=True))
