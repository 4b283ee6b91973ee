"""One-sided inclusion of chains of unequal rank: whether generic models of the smaller rank have an equivalent in the other.

V1, V2: irreducible closures of the images, dim V1 = r1 < r2 = dim V2, so V2 inside V1 is impossible. IMAGE: a generic model of
the first has an equivalent in the second with finite, non-zero elements. CLOSURE: V1 lies in V2; it follows from IMAGE, not
the reverse. Degrees and projections refute both; a full image proves CLOSURE only; a refuted fibre refutes IMAGE only.

Degrees: with masses other than zero no special value raises the number of poles or lowers the relative degree. Projections: of
equally many poles, the coefficients are regular functions of the parameters, and V1 in V2 gives rank1(S) <= rank2(S) for
every set S of them. The error bound of one fibre is that of `exact`, whose argument does not use equal ranks.
"""

import json
from dataclasses import asdict, dataclass, replace
from enum import StrEnum
from typing import ClassVar, TypeVar

from disting.algebra.matroid import Matroid, rank_in
from disting.certainty import Certainty
from disting.conditions.evidence import Counts, FibreAt, FreeChoice, Labels, from_dict, spelled, to_dict
from disting.conditions.exact import rational_part, safety_of_point
from disting.conditions.question import Question
from disting.conditions.subject import Subject
from disting.conditions.verify import POINTS, Witness
from disting.ideals import Limits, Refuted, Solved, coefficient_map, normalised
from disting.ideals import Membership as Reached
from disting.ideals import decide as decide_ideal
from disting.invariants.profile import Profile, samples
from disting.invariants.sample import Representation
from disting.model.chain import Chain
from disting.settings import Settings
from disting.synthesis.decide import Exact, Grounds, Membership, member

T = TypeVar("T")
INCLUSION_LIMITS = Limits(seconds=20.0, entries=200_000, safety=100)  # of one ideal; less than for a verdict


class Inclusion(StrEnum):
    """Which generic models have equivalents on the other side."""

    EQUAL = "equal"
    LEFT_IN_RIGHT = "left-in-right"
    RIGHT_IN_LEFT = "right-in-left"
    NEITHER = "neither"
    UNKNOWN = "unknown"


class Sense(StrEnum):
    """What a finding speaks of: equivalents themselves, the closures of the images, or both."""

    IMAGE = "image"
    CLOSURE = "closure"
    BOTH = "both"


@dataclass(frozen=True, slots=True)
class LargerProjection:
    """The invariants `rows` have a larger rank in the model of the smaller rank; ranks in the pair's order."""

    kind: ClassVar[str] = "larger-projection"
    rows: Labels
    left: int
    right: int

    def sentence(self, left: str, right: str) -> str:
        """Both ranks in words."""
        return f"The invariants {spelled(self.rows)} have rank {self.left} in {left} and {self.right} in {right}."

    @property
    def formula(self) -> str:
        """The two ranks."""
        return f"rank ∂({spelled(self.rows)})/∂p = {self.left}, {self.right}"


@dataclass(frozen=True, slots=True)
class FullImage:
    """The model of the larger rank has as many determinable parameters as non-constant invariants."""

    kind: ClassVar[str] = "full-image"
    left_is_larger: bool
    rank: int
    free: Labels

    def sentence(self, left: str, right: str) -> str:
        """What that means for the other."""
        larger, smaller = (left, right) if self.left_is_larger else (right, left)
        return f"{larger} gives its {self.rank} invariants any generic values, so those of {smaller} are limits of its own."

    @property
    def formula(self) -> str:
        """N_R equals the number of free invariants."""
        return f"N_R = {self.rank} = |{{{spelled(self.free)}}}|"


InclusionEvidence = Counts | LargerProjection | FullImage | FibreAt | Solved | Refuted
_OWN = {c.kind: c for c in (LargerProjection, FullImage)}


@dataclass(frozen=True, slots=True)
class InclusionFinding:
    """Inclusion with its evidence; `reason` says why it is unknown."""

    inclusion: Inclusion
    sense: Sense = Sense.BOTH
    certainty: Certainty | None = None
    safety: int = 0
    evidence: InclusionEvidence | None = None
    reason: str = ""

    def __post_init__(self) -> None:
        if len({self.inclusion is not Inclusion.UNKNOWN, self.evidence is not None, self.certainty is not None}) > 1:
            raise ValueError("exactly a finding that is not unknown carries certainty and evidence")
        if (self.certainty is Certainty.BOUNDED) != (self.safety > 0):
            raise ValueError("exactly a bounded finding carries an error bound")

    def __bool__(self) -> bool:
        raise TypeError("a finding is not true or false; look at its inclusion")


def inclusion_finding(left: Subject, right: Subject) -> InclusionFinding:
    """Inclusion of two chains of unequal rank: cheap refutations, then a full image, then one fibre."""
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
    """What the profiles settle; None if nothing."""
    one, other = left.chain, right.chain
    if (one.n_masses, one.sensor, one.dead_time) != (other.n_masses, other.sensor, other.dead_time):
        return InclusionFinding(Inclusion.UNKNOWN, reason="models of one size, sensor and dead time are compared")
    small, large = (left, right) if left.rank < right.rank else (right, left)
    profiles = (s.profile(Representation.TF, 0) for s in (small, large))
    return _by_profiles(*profiles, left_is_smaller=left.rank < right.rank)


def confirms(evidence: InclusionEvidence, left: Subject, right: Subject) -> bool:
    """Whether the evidence is true of the two chains, at fresh points, and speaks of the model of the smaller rank.

    A fibre is computed again. The ranks of the two models are taken from their profiles.
    """
    a, b = left.canonical.chain, right.canonical.chain
    left_is_smaller, fresh = left.rank < right.rank, Witness("inclusion")
    match evidence:
        case Counts():
            small, large = _ordered(evidence.left, evidence.right, left_is_smaller)
            return _degrees_refute(small, large) and fresh.confirms(evidence, "tf", a, b)
        case LargerProjection():
            here, there = _ordered(evidence.left, evidence.right, left_is_smaller)
            return here > there and _ranks(evidence.rows, a, b) == (evidence.left, evidence.right)
        case FullImage():
            larger = a if evidence.left_is_larger else b
            free = FreeChoice(evidence.rank, evidence.free)
            same = evidence.left_is_larger != left_is_smaller and _same_elsewhere(evidence.free, a, b)
            return same and fresh.confirms(free, "tf", larger, larger)
        case FibreAt():
            return evidence.left_given == left_is_smaller and fresh.confirms(evidence, "tf", a, b)
        case Solved() | Refuted():
            plain = isinstance(evidence, Solved) or not evidence.tangent
            return evidence.left_given == left_is_smaller and plain and fresh.confirms(evidence, "tf", a, b)


def _by_profiles(small: Profile, large: Profile, *, left_is_smaller: bool) -> InclusionFinding | None:
    """What degrees, ranks of projections and a full image settle; None if nothing."""
    if _degrees_refute(small.degrees, large.degrees):
        counts = Counts(*_ordered(small.degrees, large.degrees, left_is_smaller))
        return InclusionFinding(Inclusion.NEITHER, Sense.BOTH, Certainty.PROVEN, evidence=counts)
    if small.degrees[1] != large.degrees[1]:
        return None
    safety = min(small.safety, large.safety) - 1
    rows = _larger_rows(small, large)
    if rows is not None:
        ranks = _ordered(_rank(small, rows), _rank(large, rows), left_is_smaller)
        return InclusionFinding(Inclusion.NEITHER, Sense.BOTH, Certainty.BOUNDED, safety, LargerProjection(rows, *ranks))
    if large.rank == len(large.form) and small.form <= large.form and _constants_agree(small, large):
        free = tuple(x for x in large.labels if x in large.form)
        evidence = FullImage(not left_is_smaller, large.rank, free)
        return InclusionFinding(_inside(left_is_smaller), Sense.CLOSURE, Certainty.BOUNDED, safety, evidence)
    return None


def _degrees_refute(small: tuple[int, int], large: tuple[int, int]) -> bool:
    """More poles, or a smaller relative degree, than any model of the larger rank has."""
    return small[1] > large[1] or small[1] - small[0] < large[1] - large[0]


def _larger_rows(small: Profile, large: Profile) -> Labels | None:
    """The smallest recorded dependent set of the larger model that is of larger rank in the smaller one."""
    if not (isinstance(small.matroid, Matroid) and isinstance(large.matroid, Matroid)):
        return None
    constant = tuple(x for x in small.labels if x in small.form - large.form)
    if constant:
        return constant
    named = ((tuple(large.labels[i] for i in rows), rank) for rows, rank in large.matroid.dependences())
    return min((rows for rows, rank in named if _rank(small, rows) > rank), key=lambda x: (len(x), x), default=None)


def _rank(profile: Profile, rows: Labels) -> int:
    """Rank of named invariants; those that the model lacks are zero."""
    assert isinstance(profile.matroid, Matroid)
    return rank_in(profile.matroid, tuple(i for i, label in enumerate(profile.labels) if label in rows))


def _ranks(rows: Labels, a: Chain, b: Chain) -> tuple[int, int] | None:
    """Ranks of named invariants of both chains at fresh points; None if they have different numbers of poles."""
    seen = [list(samples(c.structure, Representation.TF, 0, POINTS, "inclusion")) for c in (a, b)]
    here, there = (max(s.rank(tuple(i for i, x in enumerate(s.labels) if x in rows)) for s in each) for each in seen)
    poles = {sum(x[0] == "a" for x in each[0].labels) for each in seen}
    return (here, there) if len(poles) == 1 else None


def _same_elsewhere(free: Labels, a: Chain, b: Chain) -> bool:
    """Whether all invariants but the free ones have the same values in both chains at fresh points, absent ones zero."""
    seen = [list(samples(c.structure, Representation.TF, 0, POINTS, "inclusion")) for c in (a, b)]
    values = [[dict(zip(s.labels, s.values, strict=True)) for s in each] for each in seen]
    poles = {sum(x[0] == "a" for x in each[0]) for each in values}
    labels = {*values[0][0], *values[1][0]} - set(free)
    return len(poles) == 1 and all(x.get(n, 0) == y.get(n, 0) for x, y in zip(*values, strict=True) for n in labels)


def _constants_agree(small: Profile, large: Profile) -> bool:
    """Whether what is constant in the larger model is the same constant in the smaller one; what one lacks is zero."""
    values = dict(zip(small.labels, small.constants, strict=True))
    rows = zip(large.labels, large.free, large.constants, strict=True)
    return all(free or (value != "" and values.get(label, "0") == value) for label, free, value in rows)


def included(small: Chain, large: Chain, settings: Settings) -> InclusionFinding:
    """One point of the smaller model searched in the larger one: by the synthesis, then as an ideal."""
    plain = not any(c.lag or c.ground_dampers or c.dead_time for c in (small, large)) and small.damped == large.damped
    found = _by_synthesis(small, large, settings) if plain else None
    return _by_ideal(small, large, settings) if found is None else found


def _by_synthesis(small: Chain, large: Chain, settings: Settings) -> InclusionFinding | None:
    found = member(small, large, settings.seed)
    safety = safety_of_point(small.n_masses, len(large.parameters))
    if found.grounds not in (Grounds.REFUTED, Grounds.CONSTRUCTION) or safety <= 0:
        return None
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
    return InclusionFinding(Inclusion.UNKNOWN, reason=f"the ideal of the fibre is too large for the limits ({reason})")


def _evidence(found: Exact) -> FibreAt:
    point = tuple((name, str(value)) for name, value in found.point.items())
    return FibreAt(True, point, found.grounds.value, found.solutions, found.real, found.positive)


def _turned(found: InclusionFinding) -> InclusionFinding:
    """The finding on the pair in the other order; for findings of `included`, whose left model is the smaller one."""
    other = Inclusion.RIGHT_IN_LEFT if found.inclusion is Inclusion.LEFT_IN_RIGHT else found.inclusion
    evidence = found.evidence
    if isinstance(evidence, FibreAt | Solved | Refuted):
        evidence = replace(evidence, left_given=not evidence.left_given)
    return replace(found, inclusion=other, evidence=evidence)


def inclusion_to_dict(found: InclusionFinding) -> dict[str, object]:
    """Plain data, ready for JSON."""
    evidence = found.evidence
    plain: dict[str, object] = {}
    if isinstance(evidence, LargerProjection | FullImage):
        plain = {"kind": evidence.kind, **asdict(evidence)}
    elif evidence is not None:
        plain = to_dict(evidence)
    certainty = found.certainty.value if found.certainty else ""
    head = {"inclusion": found.inclusion.value, "sense": found.sense.value, "certainty": certainty, "safety": found.safety}
    return head | {"evidence": plain, "reason": found.reason}


def inclusion_from_dict(data: dict[str, object]) -> InclusionFinding:
    """Inverse of `inclusion_to_dict`; raises KeyError, TypeError or ValueError for what is none."""
    plain, certainty = data["evidence"], data["certainty"]
    evidence: InclusionEvidence | None = None
    if isinstance(plain, dict) and plain:
        kind = _OWN.get(str(plain["kind"]))
        fields = {name: tuple(v) if isinstance(v, list) else v for name, v in plain.items() if name != "kind"}
        evidence = kind(**fields) if kind else from_dict(plain)  # type: ignore[assignment, arg-type]
    grade = Certainty(str(certainty)) if certainty else None
    head = (Inclusion(str(data["inclusion"])), Sense(str(data["sense"])), grade, int(str(data["safety"])))
    return InclusionFinding(*head, evidence, str(data["reason"]))


def _to_json(found: InclusionFinding) -> str:
    return json.dumps(inclusion_to_dict(found), separators=(",", ":"))


def _from_json(text: str) -> InclusionFinding:
    return inclusion_from_dict(json.loads(text))


INCLUDED = Question("inclusions", included, _to_json, _from_json)


def _inside(left_is_smaller: bool) -> Inclusion:
    return Inclusion.LEFT_IN_RIGHT if left_is_smaller else Inclusion.RIGHT_IN_LEFT


def _ordered(small: T, large: T, left_is_smaller: bool) -> tuple[T, T]:
    return (small, large) if left_is_smaller else (large, small)
