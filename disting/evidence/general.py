"""Evidence of general models: equivalents as formulas for all parameters, or none; points with
and without one; constants.
"""

from dataclasses import dataclass
from typing import ClassVar

from disting.evidence.kind import Carrier, Claim, Kind
from disting.model.question import Domain, Relation

Formula = tuple[bool, tuple[str, ...], tuple[tuple[str, str], ...], tuple[str, ...]]
"""Left given; polynomials in its parameters that are positive; values of the other model's
parameters; and, if a value contains a root, (its name, the equation's polynomial, two numbers or
fractions between which it is).
"""
Point = tuple[tuple[str, str], ...]  # parameter name, number
SHOWN = 3
BOTH = (True, False)  # ways from one model to the other


@dataclass(frozen=True, slots=True)
class _OverDomain(Kind):
    domain: str

    def shows(self, domain: Domain) -> Relation:
        """What its kind claims, over the domain that it names."""
        return self.claim.relation if self.domain == domain else Relation.UNDECIDED


@dataclass(frozen=True, slots=True)
class Explicit(_OverDomain):
    """All generic parameters of either model have an equivalent: those of the first formula
    that applies.

    Positive ones have no exception where there is one formula each way, on no condition and without
    a root, and it has plus signs only: then its values are positive wherever the parameters are.
    """

    kind: ClassVar[str] = "explicit"
    claim: ClassVar[Claim] = Claim(Carrier.ADMISSIBLE, Relation.INDISTINGUISHABLE)
    formulas: tuple[Formula, ...]

    def without_exception(self, domain: Domain) -> bool:
        """Whether it holds for special values too."""
        plain = all(
            not where and not root and not any("-" in value for _, value in values)
            for _, where, values, root in self.formulas
        )
        return (
            self.domain == domain == Domain.POSITIVE and plain and len(self.formulas) == len(BOTH)
        )

    def sentence(self, left: str, right: str) -> str:
        """One formula each way, and how many there are."""
        said = []
        for way, given, searched in zip(BOTH, (left, right), (right, left), strict=True):
            every = [f for f in self.formulas if f[0] is way]
            more = f" ({len(every)} formulas for different parameters)" if len(every) > 1 else ""
            said.append(f"{given} is {searched} at {_told(every[0])}{more}")
        values = "" if self.without_exception(Domain.POSITIVE) else " but special ones"
        return f"{'; '.join(said)}: {self.domain} for all {self.domain} parameters{values}."

    @property
    def formula(self) -> str:
        """Both ways."""
        return "∀ p ∈ A ∃ q ∈ A: Φ₂(q) = Φ₁(p),  ∀ q ∈ A ∃ p ∈ A: Φ₁(p) = Φ₂(q)"


def _told(formula: Formula) -> str:
    _, where, values, root = formula
    said = ", ".join(f"{name} = {value}" for name, value in values)
    said += f" with {root[0]} the root of {root[1]} between {root[2]} and {root[3]}" if root else ""
    return said + (f" where {' and '.join(f'{w} > 0' for w in where)}" if where else "")


@dataclass(frozen=True, slots=True)
class NoEquivalent(_OverDomain):
    """No generic parameters of one model have an equivalent: in each case one of the
    `contradictions` would have to hold.

    They are equations polynomial = 0 or inequalities, in the given parameters p0, p1, .. and the
    unknown ones q0, q1, .. in the order of the models.
    """

    kind: ClassVar[str] = "no equivalent"
    claim: ClassVar[Claim] = Claim(Carrier.ADMISSIBLE, Relation.DISTINGUISHABLE)
    left_given: bool
    contradictions: tuple[str, ...]

    def sentence(self, left: str, right: str) -> str:
        """What would have to hold."""
        given, searched = (left, right) if self.left_given else (right, left)
        first = (c if set("<>=") & set(c) else f"{c} = 0" for c in self.contradictions[:SHOWN])
        some = " or ".join([*first, *[".."] * (len(self.contradictions) > SHOWN)])
        return (
            f"{given} has no equivalent in {searched} with {self.domain} parameters: that asks for"
            f" {some}, which is impossible (p0, p1, .. parameters of {given} by the alphabet, q0,"
            f" q1, .. those of {searched})."
        )

    @property
    def formula(self) -> str:
        """Both images have nothing in common."""
        return "Φ₁(A) ∩ Φ₂(A) = ∅"


@dataclass(frozen=True, slots=True)
class Constants(Kind):
    """Coefficients of the monic form that are constant in both models and have different values."""

    kind: ClassVar[str] = "constants"
    claim: ClassVar[Claim] = Claim(Carrier.EXACT, Relation.DISTINGUISHABLE, grounds="constants")
    labels: tuple[str, ...]
    left: tuple[str, ...]
    right: tuple[str, ...]

    def sentence(self, left: str, right: str) -> str:
        """The first of them."""
        return (
            f"{self.labels[0]} is {self.left[0]} in {left} and {self.right[0]} in {right}, for all"
            " parameters."
        )

    @property
    def formula(self) -> str:
        """The first of them."""
        return f"{self.labels[0]} = {self.left[0]} ≠ {self.right[0]}"


@dataclass(frozen=True, slots=True)
class Witnesses(_OverDomain):
    """At the rational `point_with` the other model has the `equivalent` (rounded), at
    `point_without` none in the domain.

    The same is true of all parameters near each point. `with_left_given`, `without_left_given`:
    the point is of the left model and the right one was searched. `solutions`: how many complex
    ones there are at the point without, -1 for infinitely many, -2 where they were not counted.
    """

    kind: ClassVar[str] = "witnesses"
    claim: ClassVar[Claim] = Claim(Carrier.ADMISSIBLE, Relation.SOMETIMES)
    with_left_given: bool
    point_with: Point
    equivalent: Point
    without_left_given: bool
    point_without: Point
    solutions: int

    def sentence(self, left: str, right: str) -> str:
        """Both points in words."""
        given, searched = (left, right) if self.with_left_given else (right, left)
        without, nowhere = (left, right) if self.without_left_given else (right, left)
        many = {-1: " (infinitely many complex)", -2: ""}.get(
            self.solutions, f" ({self.solutions} complex)"
        )
        return (
            f"{given} at {_spelled(self.point_with)} is {searched} at {_spelled(self.equivalent)};"
            f" {without} at {_spelled(self.point_without)} has no equivalent in {nowhere} with"
            f" {self.domain} parameters{many}; the same is true all around both points."
        )

    @property
    def formula(self) -> str:
        """Which sets are empty."""
        return "∃ p: Φ₂⁻¹(Φ₁(p)) ∩ A ≠ ∅,  ∃ p: Φ₂⁻¹(Φ₁(p)) ∩ A = ∅"


OfGeneralModels = Witnesses | Explicit | NoEquivalent | Constants


def _spelled(point: Point) -> str:
    return ", ".join(f"{name} = {value}" for name, value in point)
