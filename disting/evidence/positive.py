"""Findings on positive equivalents, how many of the positive models of one chain have one in
another, and their evidence.

`given` is the model whose positive parameters are asked about, `other` the one in which
equivalents are looked for.
"""

from dataclasses import asdict, dataclass
from enum import StrEnum
from math import sqrt
from typing import Any, ClassVar, Self, get_args

from disting.algebra.certainty import Certainty, withhold
from disting.evidence.decision import Theorem
from disting.evidence.kind import Kind, plain_fields, read

Values = tuple[tuple[str, str], ...]  # parameter name, fraction
Z95 = 1.96  # quantile of the normal distribution for 95 %

_OBSTACLES = {
    "decay": (
        "the transfer functions of {0} and {1} fall off at different rates for high frequencies"
    ),
    "residues": (
        "{0} has negative residues in the row where force and sensor are apart, {1} has positive"
        " ones alone"
    ),
    "own poles": (
        "the grounded and the free row of {1} would have to be those of {0}, which are of another"
        " kind"
    ),
    "signs": (
        "in the order of the poles the residues of a row of {0} change their signs more often than"
        " those of {1} can"
    ),
    "swapped parts": (
        "the rows of {1} would be those of {0}, equal or exchanged, which decay or positive masses"
        " rule out"
    ),
}


@dataclass(frozen=True, slots=True)
class Excluded(Kind):
    """NEVER: the statement of that `name`, see `positivity.obstacles`; at the rational `point`, if
    one is needed, balls are looked at.
    """

    kind: ClassVar[str] = "excluded"
    name: str
    point: Values = ()

    def __post_init__(self) -> None:
        # from a damaged file: said here, and not when it is to be told
        if self.name not in _OBSTACLES:
            raise ValueError(f"nothing that excludes equivalents is called {self.name!r}")

    def sentence(self, given: str, other: str) -> str:
        """What stands against equivalents."""
        why = _OBSTACLES[self.name].format(given, other)
        return (
            f"No generic positive parameters of {given} have a positive equivalent in {other}:"
            f" {why}."
        )

    @property
    def formula(self) -> str:
        """The statement by name."""
        return f"{self.name} exclude positive equivalents"

    @property
    def title(self) -> str:
        """The statement by name."""
        return self.name


@dataclass(frozen=True, slots=True)
class EmptyFibre(Kind):
    """NEVER: at this rational point of `given` no parameters of `other`, not even complex ones,
    are equivalent.
    """

    kind: ClassVar[str] = "no-equivalent"
    point: Values

    def sentence(self, given: str, other: str) -> str:
        """What the fibre shows."""
        return (
            f"For one choice of rational parameters of {given} no parameters of {other}, real or"
            " complex, give the same transfer function; so generic parameters have no equivalent."
        )

    @property
    def formula(self) -> str:
        """The empty fibre."""
        return "Φ₂⁻¹(Φ₁(p₀)) = ∅"


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
    parts: tuple[RowWords, ...]
    with_one: Values = ()
    without: Values = ()

    def sentence(self, given: str, other: str) -> str:
        """Which arrangements of poles and zeros `other` lacks."""
        lacking = [(p.part, _spelled(p.lacking)) for p in self.parts if p.lacking]
        if not lacking:
            return (
                f"However the zeros of {given} lie between its poles, positive parameters of"
                f" {other} can do the same."
            )
        which = " and ".join(f"{words} in the {name} row" for name, words in lacking)
        return (
            f"Some positive parameters of {given} have a positive equivalent in {other}, others"
            f" have none: those where the zeros of a row lie between its poles as in no {other}"
            f" (zeros a gap, slowest gap first: {which})."
        )

    @property
    def formula(self) -> str:
        """Numbers of lacking words."""
        counted = ((p.part, len(p.lacking)) for p in self.parts)
        return ", ".join(
            f"{name}: {n or 'no'} arrangement{'s' * (n > 1)} lacking" for name, n in counted
        )

    @property
    def title(self) -> str:
        """What settles it."""
        return "order of poles and zeros"

    @classmethod
    def from_dict(cls, data: dict[str, Any]) -> Self:
        """From plain data; raises KeyError or TypeError for what is none."""
        rows = tuple(RowWords(**plain_fields(row)) for row in data["parts"])
        return cls(**plain_fields(data) | {"parts": rows})


@dataclass(frozen=True, slots=True)
class Points(Kind):
    """SOMETIMES: rational points of `given`, one in an open set with positive equivalents, one
    in an open set without.
    """

    kind: ClassVar[str] = "points"
    with_one: Values
    without: Values

    def sentence(self, given: str, other: str) -> str:
        """What the two points show."""
        return (
            f"All models near one choice of positive rational parameters of {given} have a positive"
            f" equivalent in {other}, generic ones near another choice have none."
        )

    @property
    def formula(self) -> str:
        """One of each."""
        return "∃ p₀: Φ₂⁻¹(Φ₁(p₀)) ∩ ℝ₊ⁿ ≠ ∅,  ∃ p₁: Φ₂⁻¹(Φ₁(p₁)) ∩ ℝ₊ⁿ = ∅"


@dataclass(frozen=True, slots=True)
class BoxMap(Kind):
    """ALWAYS, within ranges: a renaming (given, other) takes the ranges of `given` into those
    of `other`.
    """

    kind: ClassVar[str] = "box"
    pairs: tuple[tuple[str, str], ...]

    def sentence(self, given: str, other: str) -> str:
        """What the renaming does to the ranges."""
        return (
            f"A renaming turns {given} into {other}, and every range of {given} lies inside the"
            " range that it is renamed to."
        )

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
    experiment: int

    def sentence(self, given: str, other: str) -> str:
        """Why the equivalent under one experiment is that under all."""
        return (
            f"In experiment {self.experiment} alone every positive {given} has a positive"
            f" equivalent in {other}, and generic ones have no other, so it is that of all"
            " experiments."
        )

    @property
    def formula(self) -> str:
        """The fibre of one experiment is one positive point."""
        return f"|Φ₂,{self.experiment}⁻¹(Φ₁,{self.experiment}(p))| = 1, ⊂ ℝ₊ⁿ"


PositiveEvidence = Theorem | Excluded | EmptyFibre | Interlacing | Points | BoxMap | OnlyOne


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
        withhold(self, "reason", share=Share.UNKNOWN, certainty=None)

    def __bool__(self) -> bool:
        raise TypeError("a finding is not true or false; look at its share")

    def sentence(self, given: str, other: str) -> str:
        """What is known and why; a sampled share is called empirical."""
        if self.evidence is None:
            return (
                f"Which positive {given} have a positive equivalent in {other} is not known:"
                f" {self.reason}."
            )
        seen = (
            f" {self.empirical.sentence}."
            if self.empirical and self.share is Share.SOMETIMES
            else ""
        )
        return self.evidence.sentence(given, other) + seen

    def to_dict(self) -> dict[str, object]:
        """Plain data, ready for JSON; what is empty is left out."""
        told: dict[str, object] = {"share": self.share.value}
        if self.evidence and self.certainty:
            told |= {
                "certainty": self.certainty.value,
                "safety": self.safety,
                "evidence": self.evidence.to_dict(),
            }
        if self.empirical:
            told["empirical"] = asdict(self.empirical)
        return told | ({"reason": self.reason} if self.reason else {})

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
