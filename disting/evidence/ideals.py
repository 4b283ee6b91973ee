"""Evidence of fibres as polynomial ideals: what one or more of them show, of whole chains, of
their rows.

A label denotes a random prime and a random point, so evidence holds labels, not numbers.
"""

from dataclasses import dataclass
from typing import Any, ClassVar, Self, get_args

from disting.evidence.kind import COMPLEX, Carrier, Claim, Inside, Kind, read
from disting.model.question import Relation

_FULL = "have as many determinable parameters as coefficients ({})"
_IDEAL = "the ideal of one fibre"
SAME = 0  # in place of the number of coefficients of a row


@dataclass(frozen=True, slots=True)
class Solutions(Kind):
    """At the prime and point of each label the searched model has the parameters `solutions` with
    the same transfer function.

    `left_given`: the points are of the left model and the right one was searched. A scale factor,
    where needed, comes last. `is_normalised`: in the coordinates of `system.normalise`, for
    chains.
    """

    kind: ClassVar[str] = "solved"
    claim: ClassVar[Claim] = Claim(
        Carrier.EXACT, Relation.INDISTINGUISHABLE, COMPLEX, _IDEAL, Inside.LIMIT
    )
    symbols: ClassVar[str] = "Φ₂(q₀) ≡ Φ₁(p₀)"
    left_given: bool
    labels: tuple[str, ...]
    solutions: tuple[tuple[int, ...], ...]
    is_normalised: bool = False

    def sentence(self, left: str, right: str) -> str:
        """Sentence on the result."""
        source, searched = (left, right) if self.left_given else (right, left)
        return (
            f"For {_times(len(self.labels), 'choice')} of random parameters of {source} modulo a"
            f" random prime, parameters of {searched} with exactly the same transfer function were"
            " computed."
        )


@dataclass(frozen=True, slots=True)
class Refutation(Kind):
    """At the prime and point of each label the equations of the fibre have no solution: 1 is a
    combination of degree `degree`.

    `tangent`: the tangent equations belong to them, which is right for models of equal rank only.
    `is_normalised`: in the coordinates of `system.normalise`, for chains.
    """

    kind: ClassVar[str] = "refuted"
    claim: ClassVar[Claim] = Claim(Carrier.EXACT, Relation.DISTINGUISHABLE, grounds=_IDEAL)
    symbols: ClassVar[str] = "1 ∈ ⟨Φ₂(q) − Φ₁(p₀)⟩"
    left_given: bool
    labels: tuple[str, ...]
    degree: int
    tangent: bool
    is_normalised: bool = False

    def sentence(self, left: str, right: str) -> str:
        """Sentence on the result."""
        source, searched = (left, right) if self.left_given else (right, left)
        return (
            f"For {_times(len(self.labels), 'choice')} of random parameters of {source} modulo a"
            f" random prime, no parameters of {searched}, in any extension, have the same transfer"
            f" function: the equations contradict each other in degree {self.degree}."
        )


@dataclass(frozen=True, slots=True)
class Vanishing(Kind):
    """Markov parameter `index` of a row is a product of elements and has to be zero, or is
    zero and has to be something.
    """

    kind: ClassVar[str] = "vanishing"
    index: int


FibreEvidence = Vanishing | Solutions


@dataclass(frozen=True, slots=True)
class RowStep:
    """Result for one row (`part`) of the searched chain in one split."""

    split: str
    part: str
    shown: FibreEvidence


@dataclass(frozen=True, slots=True)
class ByRows(Kind):
    """In each split a row that cannot be, or in one split two rows that can; `left_given`:
    the right model is searched.
    """

    kind: ClassVar[str] = "by-parts"
    symbols: ClassVar[str] = "R₂(q) + F₂(q) = R₁(p) + F₁(p)"
    left_given: bool
    steps: tuple[RowStep, ...]

    @property
    def is_member(self) -> bool:
        """True if the evidence supports inclusion."""
        return bool(self.steps) and all(isinstance(s.shown, Solutions) for s in self.steps)

    @property
    def inside(self) -> Inside:
        """Two rows that can be are a limit: elements may be zero."""
        return Inside.LIMIT if self.is_member else Inside.NO_EQUIVALENT

    def sentence(self, left: str, right: str) -> str:
        """Sentence on the result, row by row."""
        source, searched = (left, right) if self.left_given else (right, left)
        steps = "; ".join(_describe_step(step, searched) for step in self.steps)
        if self.is_member:
            return (
                f"Both rows of {searched} can have, at least in the limit, the receptances that"
                f" add up to {source}: {steps}."
            )
        start = (
            f"The poles of each row of a generic {source} stay together in an equivalent {searched}"
        )
        if not self.steps:
            return (
                f"{start}, and no choice of rows has as many poles as the grounded row of"
                f" {searched}."
            )
        return f"{start}, so its rows have given receptances: {steps}."

    def to_dict(self) -> dict[str, object]:
        """Plain data, ready for JSON: the result of a row follows its name."""
        steps = [{"split": s.split, "part": s.part, **s.shown.to_dict()} for s in self.steps]
        return {"kind": self.kind, "left_given": self.left_given, "steps": steps}

    @classmethod
    def from_dict(cls, data: dict[str, Any]) -> Self:
        """Inverse of `to_dict`; raises KeyError, TypeError or ValueError for what is none."""
        if not isinstance(data["steps"], list):
            raise TypeError("the steps are a list")
        return cls(bool(data["left_given"]), tuple(map(_step, data["steps"])))


@dataclass(frozen=True, slots=True)
class NoShares(Kind):
    """No way to share out the roots of N at the prime and point of `label` leaves parameters of
    the searched row.

    `part`: the row in question where both chains have the other one in common ("grounded", "free"),
    "" for whole chains; `shares` that were refuted, each representing its type, in degree `degree`
    at most.
    """

    kind: ClassVar[str] = "shared"
    claim: ClassVar[Claim] = Claim(
        Carrier.EXACT,
        Relation.DISTINGUISHABLE,
        grounds="all ways to share out the zeros of a row",
    )
    symbols: ClassVar[str] = "1 ∈ ⟨θ₂ − θ, φ₂ − φ, D₂ − D₁⟩ for {0.shares} shares"
    left_given: bool
    part: str
    label: str
    shares: int
    degree: int

    def sentence(self, left: str, right: str) -> str:
        """Sentence on the result."""
        source, searched = (left, right) if self.left_given else (right, left)
        where = f"The {self.part} rows decide, the others are the same. " if self.part else ""
        return (
            f"{where}For one choice of random parameters of {source} modulo a random prime, no"
            f" parameters of {searched}, in any extension, have the same receptance: each of the"
            f" {self.shares} ways in which the numerator's roots could be shared out among its"
            " factors leads to a contradiction."
        )


@dataclass(frozen=True, slots=True)
class FullRows(Kind):
    """Exact decision: `free` coefficients of each row, as many as its rank; 0 where both
    chains have the very same row.
    """

    kind: ClassVar[str] = "full-parts"
    claim: ClassVar[Claim] = Claim(
        Carrier.EXACT,
        Relation.INDISTINGUISHABLE,
        COMPLEX,
        "rows that can have any receptance",
    )
    free: tuple[int, ...]

    def sentence(self, left: str, right: str) -> str:
        """Row by row."""
        rows = zip(("grounded", "free"), self.free, strict=True)
        same = [
            f"the {name} rows are equal" if n == SAME else f"both {name} rows {_FULL.format(n)}"
            for name, n in rows
        ]
        return (
            f"In {left} and {right} {' and '.join(same)}, so each can have the rows of the other."
        )

    @property
    def formula(self) -> str:
        """Rank and number of coefficients of the rows that are not equal."""
        return ", ".join(
            f"N_R = {n} = |Φ_{name}|" for name, n in zip("RF", self.free, strict=True) if n != SAME
        )


def _times(count: int, what: str) -> str:
    return f"one {what}" if count == 1 else f"{count} {what}s"


def _step(data: dict[str, Any]) -> RowStep:
    shown = {name: value for name, value in data.items() if name not in ("split", "part")}
    return RowStep(str(data["split"]), str(data["part"]), read(shown, get_args(FibreEvidence)))


def _describe_step(step: RowStep, searched: str) -> str:
    row = f"the {step.part} row of {searched}"
    match step.shown:
        case Vanishing():
            statement = (
                f"Markov parameter {step.shown.index} of {row} is a product of elements and had to"
                " be zero, or the reverse"
            )
        case Solutions():
            statement = (
                f"{row} was solved for {len(step.shown.labels)} random receptances modulo random"
                " primes"
            )
    return f"{_SPLITS[step.split]}, {statement}"


_SPLITS = {
    "same": "with the same rows",
    "exchanged": "with the rows exchanged except for a rigid body",
    "rigid": "with a rigid body as the free row",
}
