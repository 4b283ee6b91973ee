"""Which of two measured chains of unequal rank lies in the other one, where that follows from what
is known of both: no fibre is looked at.

Inside. If the one is the other with elements missing, and all experiments are at the same masses of
both, then springs and dampers that are missing, sent to zero, carry every transfer function of the
larger model into that of the smaller one, whatever is locked or added: rows that lose their joints
to the ports move alone.

Outside. If V1 lies inside V2, so do their projections on one experiment, and on every set of
coefficients. So one experiment is enough in which no limit has the degrees (`questions.inclusion`,
`profiles`), in which the one sensor moves and the other one never does, or in which the model that
has the smaller rank in all of them together has the larger one.
"""

from collections.abc import Callable, Iterator

from disting.algebra.certainty import Certainty, graded
from disting.behaviour.profile import Profile
from disting.behaviour.stacked import ZERO
from disting.evidence.conditions import Counts
from disting.evidence.limits import LargerProjection, MissingElements
from disting.experiments.experiment import MeasuredChain
from disting.questions.inclusion import Inclusion, InclusionFinding, Inclusions
from disting.questions.inclusion.profiles import by_profiles, degrees_refute, inside, ordered

IMAGE_NOT_ASKED = "under several experiments only limits are asked for"
NOT_SETTLED = "neither missing elements nor one experiment alone settles it"
ProfileOf = Callable[[MeasuredChain], Profile]


def inclusions_under(
    left: MeasuredChain, right: MeasuredChain, profile_of: ProfileOf
) -> Inclusions:
    """Both statements on two measured chains of unequal rank; equivalents are not looked for where
    limits are not excluded.
    """
    ranks = [profile_of(m).rank for m in (left, right)]
    first = ranks[0] < ranks[1]
    small, large = ordered(left, right, first)
    closure = next(_found(small, large, profile_of, first), None)
    if closure is None:
        closure = InclusionFinding(Inclusion.UNKNOWN, reason=NOT_SETTLED)
    if closure.inclusion is Inclusion.NEITHER:
        return Inclusions(closure, closure)
    return Inclusions(InclusionFinding(Inclusion.UNKNOWN, reason=IMAGE_NOT_ASKED), closure)


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
    found = mine.embeddings(theirs)
    return (places for places in found if _keeps(places, part, whole))


def _keeps(places: dict[int, int], part: MeasuredChain, whole: MeasuredChain) -> bool:
    """Whether every experiment on the part is that on the whole at these places."""
    for here, there in zip(part.entries, whole.entries, strict=True):
        moved_ports = tuple(places[i] for i in here.ports)
        same = moved_ports == there.ports and here.sensor_order == there.sensor_order
        changes = here.experiment.moved(places.__getitem__).changes
        if not same or changes != there.experiment.changes:
            return False
    return True


def _found(
    small: MeasuredChain, large: MeasuredChain, profile_of: ProfileOf, first: bool
) -> Iterator[InclusionFinding]:
    """Yield what settles CLOSURE, the cheapest first."""
    places = numbering(small, large)
    if places is not None:
        evidence = MissingElements(first, tuple(sorted(places.items())))
        yield InclusionFinding(inside(first), Certainty.THEOREM, evidence=evidence)
    one, other = profile_of(small), profile_of(large)
    pairs = list(zip(_pairs(one), _pairs(other), strict=True))
    for here, there in pairs:
        if here != ZERO and (there == ZERO or degrees_refute(here, there)):
            counts = Counts(*ordered(here, there, first))
            yield InclusionFinding(Inclusion.NEITHER, Certainty.PROVEN, evidence=counts)
    if any(here[1] != there[1] for here, there in pairs):
        return
    yield from _by_one_experiment(small, large, profile_of, first)
    found = by_profiles(one, other, left_is_smaller=first)
    if found is not None:
        yield found


def _by_one_experiment(
    small: MeasuredChain, large: MeasuredChain, profile_of: ProfileOf, first: bool
) -> Iterator[InclusionFinding]:
    """Yield the refutation by an experiment in which the model of the smaller rank has the larger
    one.
    """
    for k, pair in enumerate(zip(small.experiments, large.experiments, strict=True)):
        alone = (MeasuredChain(m.chain, (e,)) for m, e in zip((small, large), pair, strict=True))
        one, other = map(profile_of, alone)
        if one.rank > other.rank:
            labels = tuple(name.replace("[1]", f"[{k + 1}]") for name in one.labels)
            ranks = ordered(one.rank, other.rank, first)
            grade = graded(other.rank_proven, min(one.safety, other.safety) - 1)
            yield InclusionFinding(Inclusion.NEITHER, *grade, LargerProjection(labels, *ranks))


def _pairs(profile: Profile) -> list[tuple[int, int]]:
    return list(zip(profile.degrees[::2], profile.degrees[1::2], strict=True))
