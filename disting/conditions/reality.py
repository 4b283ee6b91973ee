"""Evidence on real parameters of undamped chains: real factors always exist, or they lack in an open set of models."""

from dataclasses import asdict, dataclass
from typing import Any, ClassVar

from disting.positivity import PositiveFinding

Point = tuple[tuple[str, str], ...]  # parameter name, fraction


@dataclass(frozen=True, slots=True)
class RealFactors:
    """Every polynomial that either chain must split into real factors can be split so (see `positivity.real`)."""

    kind: ClassVar[str] = "real factors"

    def sentence(self, left: str, right: str) -> str:
        """What the theorem says."""
        return (
            f"Poles and zeros of {left} can always be shared out among the parts of {right} with real coefficients, and the "
            "reverse: real polynomials have real factors of the degrees that are needed. The rest is rational."
        )

    @property
    def formula(self) -> str:
        """The factors."""
        return "ℝ[x] ∋ P = A·B, deg A as needed, both ways"

    def to_dict(self) -> dict[str, object]:
        """Plain data, ready for JSON."""
        return {"kind": self.kind}

    @staticmethod
    def from_dict(_: dict[str, Any]) -> "RealFactors":
        """Inverse of `to_dict`."""
        return RealFactors()


@dataclass(frozen=True, slots=True)
class RealWitnesses:
    """Some real models have real equivalents and others have none, either kind in an open set.

    `without`: a rational point of the left chain (`without_left_given`) or the right one, around which none has. `with_one`:
    the finding on positive models of the left chain (`with_left_given`) or the right one, of which all or some have.
    """

    kind: ClassVar[str] = "real witnesses"
    without_left_given: bool
    without: Point
    with_left_given: bool
    with_one: PositiveFinding

    def sentence(self, left: str, right: str) -> str:
        """Both in words."""
        given, other = (left, right) if self.without_left_given else (right, left)
        values = ", ".join(f"{name} = {_rounded(value)}" for name, value in self.without)
        positive = self.with_one.sentence(*((left, right) if self.with_left_given else (right, left)))
        return (
            f"{positive} But near {values} no real {given} has a real equivalent in {other}: its poles and zeros cannot be "
            "shared out among the parts without parting two conjugates."
        )

    @property
    def formula(self) -> str:
        """One of each."""
        return "∃ p₀: Φ₂⁻¹(Φ₁(p₀)) ∩ ℝⁿ ≠ ∅,  ∃ p₁: Φ₂⁻¹(Φ₁(p₁)) ∩ ℝⁿ = ∅"

    def to_dict(self) -> dict[str, object]:
        """Plain data, ready for JSON."""
        return {"kind": self.kind, **asdict(self), "with_one": self.with_one.to_dict()}

    @staticmethod
    def from_dict(data: dict[str, Any]) -> "RealWitnesses":
        """Inverse of `to_dict`; raises KeyError, TypeError or ValueError for what is none."""
        without = tuple((str(name), str(value)) for name, value in data["without"])
        with_one = PositiveFinding.from_dict(data["with_one"])
        return RealWitnesses(bool(data["without_left_given"]), without, bool(data["with_left_given"]), with_one)


def _rounded(value: str) -> str:
    numerator, _, denominator = value.partition("/")
    return f"{int(numerator) / int(denominator or 1):.4g}"
