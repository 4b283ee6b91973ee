"""Evidence on admissible parameters: positive equivalents both ways; real factors, witnesses,
odd numbers of equivalents.
"""

from dataclasses import dataclass
from typing import ClassVar

from disting.evidence.decision import Theorem
from disting.evidence.kind import Carrier, Claim, Kind, PointText
from disting.evidence.positive import PositiveFinding, Share
from disting.model.question import Domain, Relation

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
    `questions.positive.real`).
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
        values = ", ".join(f"{name} = {_rounded(value)}" for name, value in self.without)
        positive = self.with_one.sentence(
            *((left, right) if self.with_left_given else (right, left))
        )
        return (
            f"{positive} But near {values} no real {source} has a real equivalent in {other}: its"
            " poles and zeros cannot be shared out among the rows without parting two conjugates."
        )


def _rounded(value: str) -> str:
    numerator, _, denominator = value.partition("/")
    return f"{int(numerator) / int(denominator or 1):.4g}"


@dataclass(frozen=True, slots=True)
class BothWays(Kind):
    """Which positive models of the left chain have a positive equivalent in the right one, and the
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
        """What the share says, of positive parameters alone."""
        return _RELATIONS[self.share] if domain is Domain.POSITIVE else Relation.UNDECIDED

    def without_exception(self, domain: Domain) -> bool:
        """Whether both ways are so."""
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
