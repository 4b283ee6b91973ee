"""Findings on positive equivalents, how many of the positive models of one chain have one in
another, and their evidence.

`source` is the model whose positive parameters are in question, `other` the one in which
equivalents are searched.

The evidence is on admissible parameters: positive equivalents both ways; real factors, witnesses,
odd numbers of equivalents.
"""

from dataclasses import asdict, dataclass
from enum import StrEnum
from math import sqrt
from typing import Any, ClassVar, Self, get_args

from disting.algebra.certainty import Certainty, withhold
from disting.evidence.decision import Exclusion, Theorem
from disting.evidence.kind import Carrier, Claim, Kind, PointText, plain_fields, read
from disting.model.question import Domain, Relation

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

    A word gives how many zeros lie in each gap between neighbouring poles (see `words`).
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
        """Sentence on the arrangements of poles and zeros that `other` lacks."""
        lacking = [(p.part, _spell_words(p.lacking)) for p in self.parts if p.lacking]
        if not lacking:
            return (
                f"Wherever the zeros of {source} lie between its poles, positive parameters of"
                f" {other} can place them there too."
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
    """Share of the generic positive models that have a positive equivalent: all, some (and some
    have none), none; or unknown.
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
    """`share` is proven with this `certainty` (BOUNDED: wrong with a probability of at most
    2**-safety); `empirical` is sampled.

    `reason` explains why nothing is known. A bound that does not reach 2**-LEAST_SAFETY leaves the
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
        raise TypeError("a finding is not true or false; use its share")

    @property
    def is_known(self) -> bool:
        """True if something was found."""
        return self.share is not Share.UNKNOWN

    def sentence(self, source: str, other: str) -> str:
        """Sentence on the share and the reason; a sampled share is called empirical."""
        if self.evidence is None:
            return (
                f"Which positive {source} have a positive equivalent in {other} is not known:"
                f" {self.reason}."
            )
        sampling = (
            f" {self.empirical.sentence}."
            if self.empirical and self.share is Share.SOMETIMES
            else ""
        )
        return self.evidence.sentence(source, other) + sampling

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


def _spell_words(words: tuple[tuple[int, ...], ...]) -> str:
    """At most three words, such as 0-2-0."""
    shown = ", ".join("-".join(map(str, w)) for w in words[:3])
    return shown if len(words) <= 3 else f"{shown} and {len(words) - 3} more"


_REAL = (Domain.REAL,)
_RELATIONS = {
    Share.ALWAYS: Relation.INDISTINGUISHABLE,
    Share.NEVER: Relation.DISTINGUISHABLE,
    Share.SOMETIMES: Relation.SOMETIMES,
    Share.UNKNOWN: Relation.UNDECIDED,
}


@dataclass(frozen=True, slots=True)
class RealFactors(Kind):
    """Every polynomial that either chain must split into real factors can be split so (see
    `decide.positive.real`).
    """

    kind: ClassVar[str] = "real factors"
    claim: ClassVar[Claim] = Claim(Carrier.ADMISSIBLE, Relation.INDISTINGUISHABLE, _REAL)
    theorem: ClassVar[str] = "real factors"
    words: ClassVar[str] = (
        "Poles and zeros of {left} can always be shared out among the rows of {right} with real"
        " coefficients, and the reverse: real polynomials have real factors of the degrees that are"
        " needed. The rest is rational."
    )
    symbols: ClassVar[str] = "ℝ[x] ∋ P = A·B, deg A as needed, both ways"


@dataclass(frozen=True, slots=True)
class RealWitnesses(Kind):
    """Some real models have real equivalents and others have none, either kind in an open set.

    `without`: a rational point of the left chain (`without_left_given`) or the right one, around
    which none has. `with_one`: the finding on positive models of the left chain
    (`with_left_given`) or the right one, of which all or some have.
    """

    kind: ClassVar[str] = "real witnesses"
    claim: ClassVar[Claim] = Claim(Carrier.ADMISSIBLE, Relation.SOMETIMES, _REAL)
    symbols: ClassVar[str] = "∃ p₀: Φ₂⁻¹(Φ₁(p₀)) ∩ ℝⁿ ≠ ∅,  ∃ p₁: Φ₂⁻¹(Φ₁(p₁)) ∩ ℝⁿ = ∅"
    without_left_given: bool
    without: PointText
    with_left_given: bool
    with_one: PositiveFinding

    def sentence(self, left: str, right: str) -> str:
        """Both in words."""
        source, other = (left, right) if self.without_left_given else (right, left)
        values = ", ".join(f"{name} = {_round_value(value)}" for name, value in self.without)
        positive = self.with_one.sentence(
            *((left, right) if self.with_left_given else (right, left))
        )
        return (
            f"{positive} But near {values} no real {source} has a real equivalent in {other}: its"
            " poles and zeros cannot be shared out among the rows without separating two"
            " conjugates."
        )


def _round_value(value: str) -> str:
    numerator, _, denominator = value.partition("/")
    return f"{int(numerator) / int(denominator or 1):.4g}"


@dataclass(frozen=True, slots=True)
class BothWays(Kind):
    """Positive models of the left chain that have a positive equivalent in the right one, and the
    reverse.

    Both chains are in their canonical forms.
    """

    kind: ClassVar[str] = "both ways"
    claim: ClassVar[Claim] = Claim(Carrier.ADMISSIBLE)
    left: PositiveFinding
    right: PositiveFinding

    @property
    def share(self) -> Share:
        """Of the positive models of both that have equivalents: SOMETIMES where some of either have
        and others have not; UNKNOWN also where one way contradicts the other.
        """
        shares = {self.left.share, self.right.share}
        if len(shares) == 1:
            return self.left.share
        is_settled = Share.SOMETIMES in shares and Share.NEVER not in shares
        return Share.SOMETIMES if is_settled else Share.UNKNOWN

    def sentence(self, left: str, right: str) -> str:
        """Both ways in words; a theorem, which holds both ways, once."""
        one_way, other_way = self.left.sentence(left, right), self.right.sentence(right, left)
        same = isinstance(self.left.evidence, Theorem) and self.left.evidence == self.right.evidence
        return one_way if same else f"{one_way} {other_way}"

    @property
    def formula(self) -> str:
        """Both formulas, from left to right and back, or one if they are the same."""
        one_way, other_way = (
            x.evidence.formula if x.evidence else "not known" for x in (self.left, self.right)
        )
        return one_way if one_way == other_way else f"→ {one_way}; ← {other_way}"

    def shows(self, domain: Domain) -> Relation:
        """Relation that the share implies, over positive parameters only."""
        return _RELATIONS[self.share] if domain is Domain.POSITIVE else Relation.UNDECIDED

    def without_exception(self, domain: Domain) -> bool:
        """Return True if the share is without exception in both directions."""
        ways = (self.left.evidence, self.right.evidence)
        return all(way is not None and way.without_exception(domain) for way in ways)

    @property
    def title(self) -> str:
        """Of both ways, each once."""
        ways = (way.evidence.title for way in (self.left, self.right) if way.evidence)
        return " and ".join(dict.fromkeys(filter(None, ways)))


@dataclass(frozen=True, slots=True)
class OddFibres(Kind):
    """Over real parameters: so many parameter vectors of either chain have one generic behaviour,
    all of them simple.

    Those of a real behaviour that are not real are pairs of conjugates, so of an odd number at
    least one is real.
    """

    kind: ClassVar[str] = "odd fibres"
    claim: ClassVar[Claim] = Claim(Carrier.ADMISSIBLE, Relation.INDISTINGUISHABLE, _REAL)
    theorem: ClassVar[str] = "odd fibres"
    symbols: ClassVar[str] = "|Φ₁⁻¹(Φ₁(p))| = {0.left}, |Φ₂⁻¹(Φ₂(q))| = {0.right}"
    left: int
    right: int

    def sentence(self, left: str, right: str) -> str:
        """Both numbers and what they mean."""
        of_left, of_right = (_equivalents(n) for n in (self.right, self.left))
        return (
            f"Generic parameters of {left} have {of_left} in {right}, and those of {right} have"
            f" {of_right} in {left}; solutions that are not real are pairs of conjugates, so of an"
            " odd number at least one is real."
        )


def _equivalents(count: int) -> str:
    return "one equivalent" if count == 1 else f"{count} equivalents"
