"""What the search for a fibre brings: all parameter vectors with one receptance, and how sure
that is.
"""

from dataclasses import dataclass
from enum import StrEnum
from typing import Any

Ball = Any  # acb or arb


class Status(StrEnum):
    """COMPLETE: the solutions listed are all there are. EMPTY: proven that there is none.

    INFINITE: a family; one member per branch is listed, for random values of the free choices.
    DEGENERATE: the point is special, or an element cannot be told from zero: draw another.
    NOT_COVERED: no method for this structure; the list may be short.
    """

    COMPLETE = "complete"
    EMPTY = "empty"
    INFINITE = "infinite"
    DEGENERATE = "degenerate"
    NOT_COVERED = "not covered"


class Answer(StrEnum):
    """Three-valued."""

    YES = "yes"
    NO = "no"
    UNKNOWN = "unknown"


class Confirmation(StrEnum):
    """What is proven of a listed solution.

    SUBSYSTEM: a Krawczyk step proves that as many coefficient equations as there are parameters
    have exactly one common solution in the box; the other equations hold within their balls.
    BALLS: all equations hold within their balls, no more.
    """

    SUBSYSTEM = "square subsystem"
    BALLS = "balls"


@dataclass(frozen=True, slots=True)
class Solution:
    """Parameter values (balls, complex) by name; `width`: largest relative distance of a
    coefficient from the given one.

    `real`: YES only says that the solution, if it is one, is real: its conjugate is one too, and
    no other listed ball meets it.
    """

    values: dict[str, Ball]
    real: Answer
    positive: Answer
    gauges: int
    width: float
    confirmation: Confirmation = Confirmation.BALLS


@dataclass(frozen=True, slots=True)
class Exclusions:
    """How many branches ended for which reason: refuted (proven), at the boundary (an element
    near zero), not covered.
    """

    refuted: int = 0
    boundary: int = 0
    uncovered: int = 0


@dataclass(frozen=True, slots=True)
class Fibre:
    """All parameter vectors of a structure with a given receptance; `reason` tells what stands
    behind the status.
    """

    status: Status
    solutions: tuple[Solution, ...] = ()
    precision_bits: int = 0
    tests: Exclusions = Exclusions()
    reason: str = ""

    def __post_init__(self) -> None:
        if self.status is Status.EMPTY and (
            self.solutions or self.tests.boundary or self.tests.uncovered
        ):
            raise ValueError("an empty fibre has no solutions and no open branches")
        if self.status in (Status.COMPLETE, Status.INFINITE) and not self.solutions:
            raise ValueError("a fibre that is not empty lists solutions")

    def __bool__(self) -> bool:
        raise TypeError("a fibre is not true or false; look at its status")
