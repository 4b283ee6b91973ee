"""Inclusions of general models of unequal rank in the closure of each other: by missing elements of
networks, or by degrees, ranks and free invariants. No fibre is computed.

Over complex parameters. The lemma of `decide.inclusion.profiles` speaks of any rational
functions, the theorem of `network.minors` of networks.
"""

from collections.abc import Iterator

from disting.algebra.certainty import Certainty
from disting.behaviour.profile import Profile, profile
from disting.behaviour.sample import Representation
from disting.conditions.inclusion import Inclusion, InclusionFinding, Inclusions
from disting.decide import CLOSURE_NETWORKS, OF_INCLUSIONS, Of, check, deciders_of, first_finding
from disting.decide.inclusion.profiles import by_profiles, inside, order
from disting.evidence.kinds import InclusionEvidence
from disting.evidence.limits import Minor
from disting.general.matrix_model import AnyModel
from disting.general.minor import minor_at, minor_of
from disting.general.network_model import behaviour_of
from disting.model.question import Settings
from disting.network.branches import branches, rest_of
from disting.network.minors import is_minor, minors
from disting.network.network import Network

IMAGE_NOT_ASKED = "of general models only limits are decided"
NOT_SETTLED = "neither missing elements nor the profiles decide it"
FRESH = Settings(seed="checked again")


def inclusions_of(
    left: AnyModel,
    right: AnyModel,
    profiles: tuple[Profile, Profile],
    left_is_smaller: bool,
) -> Inclusions:
    """Both statements on two models of unequal rank."""
    pair = order(left, right, left_is_smaller)
    summaries = order(*profiles, left_is_smaller)
    closure: InclusionFinding | None = first_finding(
        CLOSURE_NETWORKS.rows, *pair, summaries, left_is_smaller
    )
    if closure is None:
        closure = InclusionFinding(Inclusion.UNKNOWN, reason=NOT_SETTLED)
    if closure.inclusion is Inclusion.NEITHER:
        return Inclusions(closure, closure)
    return Inclusions(InclusionFinding(Inclusion.UNKNOWN, reason=IMAGE_NOT_ASKED), closure)


def confirms_inclusion(
    evidence: InclusionEvidence, left: AnyModel, right: AnyModel, left_is_smaller: bool
) -> bool:
    """Return True if the evidence of an inclusion holds: places of missing elements are checked
    again, everything else is found again at fresh points.
    """
    rows = deciders_of(Of.NETWORKS, OF_INCLUSIONS)
    return check(evidence, rows, left, right, left_is_smaller)


def check_minor(evidence: Minor, left: AnyModel, right: AnyModel, left_is_smaller: bool) -> bool:
    """The part once more."""
    pair = (left, right) if evidence.left_is_part else (right, left)
    return evidence.left_is_part == left_is_smaller and _is_what_remains(evidence, *pair)


def check_profiles(
    evidence: InclusionEvidence, left: AnyModel, right: AnyModel, left_is_smaller: bool
) -> bool:
    """Return True if the evidence agrees with fresh profiles."""
    small, large = order(left, right, left_is_smaller)
    fresh = [profile(behaviour_of(m), Representation.TF, 0, FRESH) for m in (small, large)]
    given = small, large, (fresh[0], fresh[1]), left_is_smaller
    finding = of_profiles(*given) if have_degrees(*given) else None
    return finding is not None and finding.evidence == evidence


def numberings(part: AnyModel, whole: AnyModel) -> Iterator[dict[int, int]]:
    """Yield the numberings {node of the part: node of the whole} under which the one network is the
    other one with elements missing, nothing rigid or at rest.
    """
    a, b = part.network, whole.network
    if a is None or b is None or a.exponents or b.exponents:
        return  # exponents are matched, and special ones are none of the part's elements
    for places in minors(a.grounded, b.grounded):
        if len(set(places.values())) == len(places):
            yield {at: i for i, at in sorted(places.items(), key=lambda x: x[1])}


def n_elements(network: Network | None) -> int | None:
    """Number of elements of a network with an effect on the response."""
    return None if network is None else len(network.grounded.elements)


def by_minors(
    small: AnyModel, large: AnyModel, profiles: tuple[Profile, Profile], left_is_part: bool
) -> InclusionFinding | None:
    """The part is a limit of the whole, its elements at these places."""
    if small.network is None or large.network is None:
        return None
    evidence = minor_of(small.network, large.network, left_is_part)
    if evidence is None:
        return None
    return InclusionFinding(inside(left_is_part), Certainty.THEOREM, evidence=evidence)


def _is_what_remains(evidence: Minor, small: AnyModel, large: AnyModel) -> bool:
    """Return True if the part is the whole without these elements: by its places, or, for
    one-ports, by its branches.
    """
    if small.network is None or large.network is None:
        return False
    part, whole = small.network.grounded, large.network.grounded
    if evidence.places:
        places = dict(evidence.places)
        is_known = is_minor(part, whole, places)
        return is_known and evidence == minor_at(part, whole, places, evidence.left_is_part)
    ports = [(n.sort, n.order, n.sign_of_one_port) for n in (part, whole)]
    form = branches(part)
    is_known = ports[0] == ports[1] and part.sign_of_one_port != 0 and form is not None
    is_known = is_known and not evidence.exponents
    return is_known and form == rest_of(whole, evidence.missing, evidence.rigid)


def have_degrees(
    small: AnyModel, large: AnyModel, profiles: tuple[Profile, Profile], left_is_smaller: bool
) -> bool:
    """Return True if degrees bound those of limits: not those in v, where exponents may change."""
    return not any(m.powers.weights for m in (small, large))


def of_profiles(
    small: AnyModel, large: AnyModel, profiles: tuple[Profile, Profile], left_is_smaller: bool
) -> InclusionFinding | None:
    """Inclusion that degrees, ranks of projections and a full image prove."""
    return by_profiles(*profiles, left_is_smaller=left_is_smaller)
