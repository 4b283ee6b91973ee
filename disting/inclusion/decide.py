"""One-sided inclusion of chains of unequal rank: whether generic models of the smaller rank have an equivalent in the other.

V1, V2: irreducible closures of the images, dim V1 = r1 < r2 = dim V2, so V2 inside V1 is impossible. IMAGE: a generic model of
the first has an equivalent in the second with finite, non-zero elements. CLOSURE: V1 lies in V2; it follows from IMAGE, not
the reverse. What proves a statement first is kept, CLOSURE before refutations of IMAGE where it is cheap to see; so a pair that
is refuted in the sense of IMAGE may lie in the CLOSURE.

Chains of different sizes are compared in `across_sizes`: the smaller one may be a limit of the larger one, which proves
CLOSURE. For chains of one size:

1. `profiles`: degrees and projections refute both; a full image proves CLOSURE.
2. Chains with a gap taken apart (`disting.ideals.by_parts`): small ideals of both parts prove CLOSURE; relative degrees and
   Markov parameters of the parts refute IMAGE without any chance.
3. One fibre by the synthesis: refuted, IMAGE; else CLOSURE. Its error bound is that of `exact`, whose argument does not use
   equal ranks.
4. The parts, then the whole model, as ideals of fibres, with the bounds of `disting.ideals.bounds`: IMAGE or CLOSURE.
"""

from dataclasses import replace

from disting.certainty import Certainty
from disting.conditions.evidence import FibreAt
from disting.conditions.exact import rational_part
from disting.conditions.subject import Subject
from disting.ideals import (
    ByParts,
    Limits,
    Refuted,
    Solved,
    coefficient_map,
    decide_by_parts,
    included_by_parts,
    normalised,
    refuted_by_parts,
)
from disting.ideals import Membership as Reached
from disting.ideals import decide as decide_ideal
from disting.inclusion.across_sizes import by_computing, by_sizes
from disting.inclusion.across_sizes_evidence import LimitFibre, PoleSharing
from disting.inclusion.finding import (
    Inclusion,
    InclusionFinding,
    RelativeDegrees,
    Sense,
    inclusion_from_json,
    inclusion_to_json,
)
from disting.inclusion.profiles import by_profiles, by_relative_degrees
from disting.invariants.sample import Representation
from disting.model.chain import Chain
from disting.question import Question
from disting.settings import Settings
from disting.synthesis.decide import Exact, Grounds, Membership, member, safety_of_point

INCLUSION_LIMITS = Limits(seconds=20.0, entries=200_000, safety=100)  # of one ideal; less than for a verdict
CLOSURE_LIMITS = Limits(seconds=5.0, entries=30_000, safety=100)  # of the ideal of one part, tried for every pair
PART_LIMITS = Limits(seconds=20.0, entries=1_000_000, safety=100)  # of the ideal of one part


def inclusion_finding(left: Subject, right: Subject) -> InclusionFinding:
    """Inclusion of two chains of unequal rank: what is cheap first, then what the answerer has to compute."""
    if left.rank == right.rank:
        raise ValueError("of equal rank: equal or neither, as the verdict says")
    found = quick_inclusion(left, right)
    if found is not None:
        return found
    answer = left.answerer(INCLUDED, by_rank(left, right), left.settings)
    return answer if left.rank < right.rank else _turned(answer)


def by_rank(left: Subject, right: Subject) -> tuple[Chain, Chain]:
    """The canonical forms of both, the smaller rank first."""
    first, second = (left, right) if left.rank < right.rank else (right, left)
    return first.canonical.chain, second.canonical.chain


def quick_inclusion(left: Subject, right: Subject) -> InclusionFinding | None:
    """What profiles, or for chains of different sizes counts and limits, settle; None if nothing."""
    one, other = left.chain, right.chain
    if (one.sensor, one.dead_time) != (other.sensor, other.dead_time):
        return InclusionFinding(Inclusion.UNKNOWN, reason="models of one sensor and dead time are compared")
    if one.n_masses != other.n_masses:
        return by_sizes(left, right)
    small, large = (left, right) if left.rank < right.rank else (right, left)
    profiles = (s.profile(Representation.TF, 0) for s in (small, large))
    return by_profiles(*profiles, left_is_smaller=left.rank < right.rank)


def included(small: Chain, large: Chain, settings: Settings) -> InclusionFinding:
    """The model of the smaller rank searched in the other: what is exact first, then the synthesis, then ideals."""
    if small.n_masses != large.n_masses:
        return by_computing(small, large, settings)
    structures = (rational_part(small), rational_part(large))
    closed = included_by_parts(*structures, settings.seed, CLOSURE_LIMITS)
    if closed.evidence is not None:
        return InclusionFinding(Inclusion.LEFT_IN_RIGHT, Sense.CLOSURE, Certainty.BOUNDED, closed.safety, closed.evidence)
    falling = by_relative_degrees(small, large)
    if falling is not None:
        return falling
    exact = refuted_by_parts(*structures, settings.seed)
    if exact is not None:
        return InclusionFinding(Inclusion.NEITHER, Sense.IMAGE, Certainty.PROVEN, evidence=exact)
    plain = not any(c.lag or c.dead_time for c in (small, large)) and small.damped == large.damped
    found = _by_synthesis(small, large, settings) if plain else None
    found = _by_parts(small, large, settings) if found is None else found
    return _by_ideal(small, large, settings) if found is None else found


def _by_parts(small: Chain, large: Chain, settings: Settings) -> InclusionFinding | None:
    found = decide_by_parts(rational_part(small), rational_part(large), settings.seed, PART_LIMITS)
    if found.evidence is None:
        return None
    if found.membership is Reached.MEMBER:
        return InclusionFinding(Inclusion.LEFT_IN_RIGHT, Sense.CLOSURE, Certainty.BOUNDED, found.safety, found.evidence)
    return InclusionFinding(Inclusion.NEITHER, Sense.IMAGE, Certainty.BOUNDED, found.safety, found.evidence)


def _by_synthesis(small: Chain, large: Chain, settings: Settings) -> InclusionFinding | None:
    found = member(small, large, settings.seed)
    if found.grounds not in (Grounds.REFUTED, Grounds.CONSTRUCTION):
        return None
    safety = safety_of_point(large)
    if found.membership is Membership.EXCLUDED:
        return InclusionFinding(Inclusion.NEITHER, Sense.IMAGE, Certainty.BOUNDED, safety, _evidence(found))
    return InclusionFinding(Inclusion.LEFT_IN_RIGHT, Sense.CLOSURE, Certainty.BOUNDED, safety, _evidence(found))


def _by_ideal(small: Chain, large: Chain, settings: Settings) -> InclusionFinding:
    reason = ""
    for coordinates in (normalised, coefficient_map):
        maps = (coordinates(rational_part(c)) for c in (small, large))
        found = decide_ideal(*maps, equal_rank=False, seed=settings.seed, limits=INCLUSION_LIMITS)
        if found.evidence is not None and found.safety >= INCLUSION_LIMITS.safety:
            evidence = replace(found.evidence, is_normalised=coordinates is normalised)
            if found.membership is Reached.MEMBER:
                return InclusionFinding(Inclusion.LEFT_IN_RIGHT, Sense.CLOSURE, Certainty.BOUNDED, found.safety, evidence)
            return InclusionFinding(Inclusion.NEITHER, Sense.IMAGE, Certainty.BOUNDED, found.safety, evidence)
        reason = found.reason
    return InclusionFinding(Inclusion.UNKNOWN, reason=f"the ideal of the fibre does not tell ({reason})")


def _evidence(found: Exact) -> FibreAt:
    point = tuple((name, str(value)) for name, value in found.point.items())
    return FibreAt(True, point, found.grounds.value, found.solutions, found.real, found.positive)


def _turned(found: InclusionFinding) -> InclusionFinding:
    """The finding on the pair in the other order; for findings of `included`, whose left model is the smaller one."""
    other = Inclusion.RIGHT_IN_LEFT if found.inclusion is Inclusion.LEFT_IN_RIGHT else found.inclusion
    evidence = found.evidence
    if isinstance(evidence, FibreAt | Solved | Refuted | ByParts):
        evidence = replace(evidence, left_given=not evidence.left_given)
    elif isinstance(evidence, PoleSharing | LimitFibre):
        evidence = replace(evidence, left_is_larger=not evidence.left_is_larger)
    elif isinstance(evidence, RelativeDegrees):
        evidence = RelativeDegrees(not evidence.left_is_larger, evidence.right, evidence.left)
    return replace(found, inclusion=other, evidence=evidence)


INCLUDED = Question("inclusions", included, inclusion_to_json, inclusion_from_json)
