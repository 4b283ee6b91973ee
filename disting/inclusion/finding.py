"""What is found about one-sided inclusion: the finding, the kinds of evidence that are its own, and their text form."""

import json
from dataclasses import asdict, dataclass
from enum import StrEnum
from typing import Any, ClassVar

from disting.certainty import Certainty, shortfall
from disting.conditions.evidence import Counts, FibreAt, Labels, from_dict, spelled, to_dict
from disting.ideals import ByParts, PartStep, Refuted, Solved, Vanishing
from disting.inclusion.across_sizes_evidence import (
    ACROSS_SIZES,
    AcrossSizes,
    Limit,
    LimitFibre,
    Meeting,
    PoleSharing,
    TooLarge,
)


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


@dataclass(frozen=True, slots=True)
class RelativeDegrees:
    """Relative degrees of the receptances in s, in the pair's order; no elements other than zero change the larger model's."""

    kind: ClassVar[str] = "relative-degrees"
    left_is_larger: bool
    left: int
    right: int

    def sentence(self, left: str, right: str) -> str:
        """Both relative degrees in words."""
        larger, smaller = (left, right) if self.left_is_larger else (right, left)
        here, there = (self.left, self.right) if self.left_is_larger else (self.right, self.left)
        return (
            f"The receptance of {larger} falls as s^-{here} for all elements other than zero, that of {smaller} at least as "
            f"fast as s^-{there}."
        )

    @property
    def formula(self) -> str:
        """The two relative degrees."""
        here, there = (self.left, self.right) if self.left_is_larger else (self.right, self.left)
        return f"deg D₂ − deg N₂ = {here} < {there} ≤ deg D₁ − deg N₁"


InclusionEvidence = AcrossSizes | Counts | LargerProjection | FullImage | RelativeDegrees | ByParts | FibreAt | Solved | Refuted
_OWN: dict[str, Any] = ACROSS_SIZES | {c.kind: c for c in (LargerProjection, FullImage, RelativeDegrees)}
_SHOWN = {c.kind: c for c in (Vanishing, Solved, Refuted)}


@dataclass(frozen=True, slots=True)
class InclusionFinding:
    """Inclusion with its evidence; `reason` says why it is unknown.

    A bound that does not reach 2**-LEAST_SAFETY leaves it unknown.
    """

    inclusion: Inclusion
    sense: Sense = Sense.BOTH
    certainty: Certainty | None = None
    safety: int = 0
    evidence: InclusionEvidence | None = None
    reason: str = ""

    def __post_init__(self) -> None:
        if len({self.inclusion is not Inclusion.UNKNOWN, self.evidence is not None, self.certainty is not None}) > 1:
            raise ValueError("exactly a finding that is not unknown carries certainty and evidence")
        lacking = shortfall(self.certainty, self.safety)
        if lacking:
            given_up = {"inclusion": Inclusion.UNKNOWN, "certainty": None, "safety": 0, "evidence": None, "reason": lacking}
            for name, value in given_up.items():
                object.__setattr__(self, name, value)

    def __bool__(self) -> bool:
        raise TypeError("a finding is not true or false; look at its inclusion")


def inclusion_to_dict(found: InclusionFinding) -> dict[str, object]:
    """Plain data, ready for JSON."""
    certainty = found.certainty.value if found.certainty else ""
    head = {"inclusion": found.inclusion.value, "sense": found.sense.value, "certainty": certainty, "safety": found.safety}
    return head | {"evidence": _evidence_to_dict(found.evidence), "reason": found.reason}


def inclusion_from_dict(data: dict[str, object]) -> InclusionFinding:
    """Inverse of `inclusion_to_dict`; raises KeyError, TypeError or ValueError for what is none."""
    plain, certainty = data["evidence"], data["certainty"]
    evidence = _evidence_from_dict(plain) if isinstance(plain, dict) and plain else None
    grade = Certainty(str(certainty)) if certainty else None
    head = (Inclusion(str(data["inclusion"])), Sense(str(data["sense"])), grade, int(str(data["safety"])))
    return InclusionFinding(*head, evidence, str(data["reason"]))


def inclusion_to_json(found: InclusionFinding) -> str:
    """A finding as text."""
    return json.dumps(inclusion_to_dict(found), separators=(",", ":"))


def inclusion_from_json(text: str) -> InclusionFinding:
    """A finding from its text."""
    return inclusion_from_dict(json.loads(text))


def _evidence_to_dict(evidence: InclusionEvidence | None) -> dict[str, object]:
    match evidence:
        case None:
            return {}
        case ByParts():
            steps = [{"split": s.split, "part": s.part, "kind": s.shown.kind, **asdict(s.shown)} for s in evidence.steps]
            return {"kind": evidence.kind, "left_given": evidence.left_given, "steps": steps}
        case (
            LargerProjection()
            | FullImage()
            | RelativeDegrees()
            | Limit()
            | LimitFibre()
            | Meeting()
            | PoleSharing()
            | TooLarge()
        ):
            return {"kind": evidence.kind, **asdict(evidence)}
        case _:
            return to_dict(evidence)


def _evidence_from_dict(plain: dict[str, object]) -> InclusionEvidence:
    kind, fields = str(plain["kind"]), {name: _tupled(v) for name, v in plain.items() if name != "kind"}
    if kind in _OWN:
        return _OWN[kind](**fields)  # type: ignore[no-any-return]
    if kind != ByParts.kind:
        return from_dict(plain)  # type: ignore[return-value]
    steps = plain["steps"]
    if not isinstance(steps, list):
        raise TypeError("the steps are a list")
    return ByParts(bool(plain["left_given"]), tuple(map(_step, steps)))


def _step(plain: dict[str, object]) -> PartStep:
    fields = {name: _tupled(v) for name, v in plain.items() if name not in ("split", "part", "kind")}
    return PartStep(str(plain["split"]), str(plain["part"]), _SHOWN[str(plain["kind"])](**fields))  # type: ignore[arg-type]


def _tupled(value: object) -> object:
    return tuple(map(_tupled, value)) if isinstance(value, list) else value
