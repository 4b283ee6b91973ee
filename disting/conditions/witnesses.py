"""Evidence that two models agree for some admissible parameters only: one point with an equivalent, one without."""

from dataclasses import dataclass
from typing import ClassVar

Point = tuple[tuple[str, str], ...]


@dataclass(frozen=True, slots=True)
class Witnesses:
    """At the rational `point_with` the other model has the `equivalent` (rounded), at `point_without` none in the domain.

    The same is true of all parameters near each point. `with_left_given`, `without_left_given`: the point is of the left model
    and the right one was searched. `solutions`: how many complex ones there are at the point without, -1 for infinitely
    many, -2 where they were not counted.
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
        many = {-1: " (infinitely many complex)", -2: ""}.get(self.solutions, f" ({self.solutions} complex)")
        return (
            f"{given} at {_spelled(self.point_with)} is {searched} at {_spelled(self.equivalent)}; "
            f"{without} at {_spelled(self.point_without)} has no equivalent in {nowhere} with {self.domain} parameters{many}; "
            "the same is true all around both points."
        )

    @property
    def formula(self) -> str:
        """Which sets are empty."""
        return "∃ p: Φ₂⁻¹(Φ₁(p)) ∩ A ≠ ∅,  ∃ p: Φ₂⁻¹(Φ₁(p)) ∩ A = ∅"


def _spelled(point: Point) -> str:
    return ", ".join(f"{name} = {value}" for name, value in point)
