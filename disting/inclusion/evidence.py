"""Kinds of evidence that are inclusion's own, which statement each of them proves, and their text form."""

from dataclasses import asdict, dataclass
from typing import Any, ClassVar

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
from disting.inclusion.outside_evidence import Outside, PartsInside


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


InclusionEvidence = (
    AcrossSizes
    | Counts
    | LargerProjection
    | FullImage
    | RelativeDegrees
    | Outside
    | PartsInside
    | ByParts
    | FibreAt
    | Solved
    | Refuted
)
_OWN: dict[str, Any] = ACROSS_SIZES | {c.kind: c for c in (LargerProjection, FullImage, RelativeDegrees, Outside, PartsInside)}
_SHOWN = {c.kind: c for c in (Vanishing, Solved, Refuted)}


def tells_equivalents(evidence: InclusionEvidence) -> bool:
    """Whether it shows finite elements other than zero: they are limits too."""
    return isinstance(evidence, FibreAt) and evidence.solutions > 0


def tells_limits(evidence: InclusionEvidence) -> bool:
    """Whether it shows limits; those of `Solved` and `ByParts` may have elements that are zero."""
    by_parts = isinstance(evidence, ByParts) and evidence.is_member
    return (
        by_parts
        or isinstance(evidence, Limit | Meeting | LimitFibre | FullImage | PartsInside | Solved)
        or tells_equivalents(evidence)
    )


def excludes_limits(evidence: InclusionEvidence) -> bool:
    """Whether it says that generic models are no limits, so that they have no equivalents either."""
    return isinstance(evidence, Counts | LargerProjection | TooLarge | PoleSharing | Outside)


def excludes_equivalents(evidence: InclusionEvidence) -> bool:
    """Whether it says that generic models have no equivalent with finite elements other than zero."""
    return excludes_limits(evidence) or not tells_limits(evidence)


def evidence_to_dict(evidence: InclusionEvidence | None) -> dict[str, object]:
    """Plain data; {} for none."""
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
            | Outside()
            | PartsInside()
            | Limit()
            | LimitFibre()
            | Meeting()
            | PoleSharing()
            | TooLarge()
        ):
            return {"kind": evidence.kind, **asdict(evidence)}
        case _:
            return to_dict(evidence)


def evidence_from_dict(plain: dict[str, object]) -> InclusionEvidence:
    """Inverse of `evidence_to_dict`; raises KeyError, TypeError or ValueError for what is none."""
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
