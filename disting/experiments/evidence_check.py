"""Whether what the exact decision found of two measured chains is true, seen anew."""

from disting.behaviour.sample import Representation
from disting.evidence.conditions import Embedding
from disting.evidence.decision import FibreUnder
from disting.evidence.ideals import Refuted, Solved
from disting.evidence.limits import MissingElements
from disting.experiments.experiment import MeasuredChain
from disting.experiments.inclusion import numberings
from disting.experiments.listing import listed_at, without_dead_time
from disting.experiments.maps import matched
from disting.experiments.stacked_profiles import profile
from disting.fibres.ideals import confirms_matched
from disting.fibres.synthesis.target import fraction
from disting.model.settings import Settings

FRESH = Settings(seed="checked again", subset_limit=0)


def confirms(
    evidence: FibreUnder | Solved | Refuted | Embedding | MissingElements,
    left: MeasuredChain,
    right: MeasuredChain,
) -> bool:
    """Whether the evidence holds: lists are made again at the stored point, solutions are put into
    all transfer functions, contradictions are found again by plain elimination; a part is looked
    for again, and ranks are computed again at other points.
    """
    if isinstance(evidence, MissingElements):
        sides = (left, right) if evidence.left_is_part else (right, left)
        return dict(evidence.numbering) in numberings(*sides)
    if isinstance(evidence, Embedding):
        sides = (left, right) if evidence.left_is_submodel else (right, left)
        ranks = {profile(m, Representation.TF, 0, FRESH).rank for m in sides}
        return ranks == {evidence.rank} and dict(evidence.numbering) in numberings(*sides)
    left, right = without_dead_time(left), without_dead_time(right)
    if not isinstance(evidence, FibreUnder):
        return confirms_matched(evidence, *matched(left, right))
    given, searched = (left, right) if evidence.left_given else (right, left)
    if sorted(name for name, _ in evidence.point) != sorted(given.chain.parameters):
        return False  # it speaks of another model
    at = evidence.listed - 1
    if not 0 <= at < len(given.experiments):
        return False
    try:
        values = {name: fraction(value) for name, value in evidence.point}
    except (ValueError, ZeroDivisionError):
        return False  # no numbers
    listed = listed_at(given, searched, at, values)
    return listed is not None and evidence.missed == tuple(
        None if k is None else k + 1 for k in listed.refuted_by
    )
