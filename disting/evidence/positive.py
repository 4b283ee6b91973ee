"""Findings on positive equivalents, how many of the positive models of one chain have one in
another, and their evidence.

`source` is the model whose positive parameters are asked about, `other` the one in which
equivalents are looked for.
"""

from dataclasses import asdict, dataclass
from enum import StrEnum
from math import sqrt
from typing import Any, ClassVar, Self, get_args

from disting.algebra.certainty import Certainty, withhold
from disting.evidence.decision import Exclusion, Theorem
from disting.evidence.kind import Kind, PointText, plain_fields, read

Z95 = 1.96  # quantile of the normal distribution for 95 %


@dataclass(frozen=True, slots=True)
class EmptyFibre(Kind):
    """NEVER: at this rational point of `source` no parameters of `other`, not even complex ones,
    are equivalent.
    """

    kind: ClassVar[str] = "no-equivalent"
    words: ClassVar[str] = (
        "For one choice of rational parameters of {left} no parameters of {right}, real or complex,"
        " give the same transfer function; so generic parameters have no equivalent."
    )
    symbols: ClassVar[str] = "Φ₂⁻¹(Φ₁(p₀)) = ∅"
    point: PointText


@dataclass(frozen=True, slots=True)
class RowWords:
    """A row (`part`) of both models: number of masses, ports of `given` and of `other`, and words
    that only `given` can have.

    A word says how many zeros lie in each gap between neighbouring poles (see `words`).
    """

    part: str
    nodes: int
    given: tuple[int, int]
    other: tuple[int, int]
    lacking: tuple[tuple[int, ...], ...]


@dataclass(frozen=True, slots=True)
class Interlacing(Kind):
    """ALWAYS or SOMETIMES: how poles and zeros of each row may lie; rational points with and
    without an equivalent.
    """

    kind: ClassVar[str] = "interlacing"
    theorem: ClassVar[str] = "order of poles and zeros"
    parts: tuple[RowWords, ...]
    with_one: PointText = ()
    without: PointText = ()

    def sentence(self, source: str, other: str) -> str:
        """Which arrangements of poles and zeros `other` lacks."""
        lacking = [(p.part, _spelled(p.lacking)) for p in self.parts if p.lacking]
        if not lacking:
            return (
                f"However the zeros of {source} lie between its poles, positive parameters of"
                f" {other} can do the same."
            )
        which = " and ".join(f"{words} in the {name} row" for name, words in lacking)
        return (
            f"Some positive parameters of {source} have a positive equivalent in {other}, others"
            f" have none: those where the zeros of a row lie between its poles as in no {other}"
            f" (zeros a gap, slowest gap first: {which})."
        )

    @property
    def formula(self) -> str:
        """Numbers of lacking words."""
        counted = ((p.part, len(p.lacking)) for p in self.parts)
        return ", ".join(
            f"{name}: {n or 'no'} arrangement{'s' if n > 1 else ''} lacking" for name, n in counted
        )

    @classmethod
    def from_dict(cls, data: dict[str, Any]) -> Self:
        """From plain data; raises KeyError or TypeError for what is none."""
        rows = tuple(RowWords(**plain_fields(row)) for row in data["parts"])
        return cls(**plain_fields(data) | {"parts": rows})


@dataclass(frozen=True, slots=True)
class Points(Kind):
    """SOMETIMES: rational points of `source`, one in an open set with positive equivalents, one
    in an open set without.
    """

    kind: ClassVar[str] = "points"
    words: ClassVar[str] = (
        "All models near one choice of positive rational parameters of {left} have a positive"
        " equivalent in {right}, generic ones near another choice have none."
    )
    symbols: ClassVar[str] = "∃ p₀: Φ₂⁻¹(Φ₁(p₀)) ∩ ℝ₊ⁿ ≠ ∅,  ∃ p₁: Φ₂⁻¹(Φ₁(p₁)) ∩ ℝ₊ⁿ = ∅"
    with_one: PointText
    without: PointText


@dataclass(frozen=True, slots=True)
class BoxMap(Kind):
    """ALWAYS, within ranges: a renaming (source, other) takes the ranges of `source` into those
    of `other`.
    """

    kind: ClassVar[str] = "box"
    words: ClassVar[str] = (
        "A renaming turns {left} into {right}, and every range of {left} lies inside the range that"
        " it is renamed to."
    )
    pairs: tuple[tuple[str, str], ...]

    @property
    def formula(self) -> str:
        """All pairs."""
        return ", ".join(f"{a} → {b}" for a, b in self.pairs)


@dataclass(frozen=True, slots=True)
class OnlyOne(Kind):
    """ALWAYS, of models under several experiments: in one of them (counted from 1) there is always
    a positive equivalent and no other, complex ones included.
    """

    kind: ClassVar[str] = "only one"
    words: ClassVar[str] = (
        "In experiment {0.experiment} alone every positive {left} has a positive equivalent in"
        " {right}, and generic ones have no other, so it is that of all experiments."
    )
    symbols: ClassVar[str] = "|Φ₂,{0.experiment}⁻¹(Φ₁,{0.experiment}(p))| = 1, ⊂ ℝ₊ⁿ"
    experiment: int


PositiveEvidence = Theorem | Exclusion | EmptyFibre | Interlacing | Points | BoxMap | OnlyOne


class Share(StrEnum):
    """Which generic positive models have a positive equivalent: all, some (and some have none),
    none; or that is not known.
    """

    ALWAYS = "always"
    SOMETIMES = "sometimes"
    NEVER = "never"
    UNKNOWN = "unknown"


@dataclass(frozen=True, slots=True)
class Empirical:
    """Of `tries` random models `hits` have an equivalent for certain; of `open` ones it is not
    known.
    """

    hits: int
    tries: int
    open: int = 0

    def __post_init__(self) -> None:
        if min(self.hits, self.open, self.tries - self.hits - self.open) < 0 or not self.tries:
            raise ValueError(
                "hits and open points are at most as many as tries, of which there are some"
            )

    @property
    def interval(self) -> tuple[float, float]:
        """Wilson's 95 % interval (1927) of the share for this distribution; open points count as
        misses below, as hits above.

        >>> tuple(round(x, 3) for x in Empirical(0, 10).interval)
        (0.0, 0.278)
        """
        return _wilson(self.hits, self.tries)[0], _wilson(self.hits + self.open, self.tries)[1]

    @property
    def sentence(self) -> str:
        """The share in words."""
        low, high = self.interval
        return (
            f"{self.hits} of {self.tries} random points have one: empirically {low:.0%} to"
            f" {high:.0%}"
        )


@dataclass(frozen=True, slots=True)
class PositiveFinding:
    """`share` is proven as `certainty` says (BOUNDED: wrong with a probability of at most
    2**-safety); `empirical` is sampled.

    `reason` says why nothing is known. A bound that does not reach 2**-LEAST_SAFETY leaves the
    share unknown.
    """

    share: Share
    certainty: Certainty | None = None
    safety: int = 0
    evidence: PositiveEvidence | None = None
    empirical: Empirical | None = None
    reason: str = ""

    def __post_init__(self) -> None:
        if (self.share is Share.UNKNOWN) == (
            self.evidence is not None and self.certainty is not None
        ):
            raise ValueError("exactly a share that is not unknown carries certainty and evidence")
        withhold(self, (self.certainty, self.safety), "reason", share=Share.UNKNOWN, certainty=None)

    def __bool__(self) -> bool:
        raise TypeError("a finding is not true or false; look at its share")

    @property
    def is_known(self) -> bool:
        """Whether something was found."""
        return self.share is not Share.UNKNOWN

    def sentence(self, source: str, other: str) -> str:
        """What is known and why; a sampled share is called empirical."""
        if self.evidence is None:
            return (
                f"Which positive {source} have a positive equivalent in {other} is not known:"
                f" {self.reason}."
            )
        seen = (
            f" {self.empirical.sentence}."
            if self.empirical and self.share is Share.SOMETIMES
            else ""
        )
        return self.evidence.sentence(source, other) + seen

    def to_dict(self) -> dict[str, object]:
        """Plain data, ready for JSON; what is empty is left out."""
        plain: dict[str, object] = {"share": self.share.value}
        if self.evidence and self.certainty:
            plain |= {
                "certainty": self.certainty.value,
                "safety": self.safety,
                "evidence": self.evidence.to_dict(),
            }
        if self.empirical:
            plain["empirical"] = asdict(self.empirical)
        return plain | ({"reason": self.reason} if self.reason else {})

    @staticmethod
    def from_dict(data: dict[str, Any]) -> "PositiveFinding":
        """Inverse of `to_dict`; raises ValueError, KeyError or TypeError for what is none."""
        certainty = Certainty(data["certainty"]) if "certainty" in data else None
        evidence = (
            read(data["evidence"], get_args(PositiveEvidence)) if "evidence" in data else None
        )
        empirical = Empirical(**data["empirical"]) if "empirical" in data else None
        return PositiveFinding(
            share=Share(data["share"]),
            certainty=certainty,
            safety=data.get("safety", 0),
            evidence=evidence,
            empirical=empirical,
            reason=data.get("reason", ""),
        )


def _wilson(hits: int, tries: int) -> tuple[float, float]:
    p, z = hits / tries, Z95
    middle, spread = (
        p + z * z / (2 * tries),
        z * sqrt(p * (1 - p) / tries + z * z / (4 * tries * tries)),
    )
    return max(0.0, (middle - spread) / (1 + z * z / tries)), min(
        1.0, (middle + spread) / (1 + z * z / tries)
    )


def _spelled(words: tuple[tuple[int, ...], ...]) -> str:
    """At most three words, such as 0-2-0."""
    shown = ", ".join("-".join(map(str, w)) for w in words[:3])
    return shown if len(words) <= 3 else f"{shown} and {len(words) - 3} more"
