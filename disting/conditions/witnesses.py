"""Evidence that two models agree for some admissible parameters only: one point with an equivalent, one without."""

from dataclasses import dataclass
from typing import ClassVar

Point = tuple[tuple[str, str], ...]


@dataclass(frozen=True, slots=True)
class Witnesses:
    """At the rational `point_with` the other model has the `equivalent` (rounded), at `point_without` none in the domain.

    `with_left_given`, `without_left_given`: the point is of the left model and the right one was searched. `solutions`: how
    many complex ones there are at the point without, -1 for infinitely many.
    """

    kind: ClassVar[str] = "witnesses"
    domain: str
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
        many = "infinitely many" if self.solutions < 0 else str(self.solutions)
        return (
            f"{given} at {_spelled(self.point_with)} is {searched} at {_spelled(self.equivalent)}; "
            f"{without} at {_spelled(self.point_without)} has no equivalent in {nowhere} with {self.domain} parameters "
            f"({many} complex)."
        )

    @property
    def formula(self) -> str:
        """Which sets are empty."""
        return "∃ p: Φ₂⁻¹(Φ₁(p)) ∩ A ≠ ∅,  ∃ p: Φ₂⁻¹(Φ₁(p)) ∩ A = ∅"


def _spelled(point: Point) -> str:
    return ", ".join(f"{name} = {value}" for name, value in point)
