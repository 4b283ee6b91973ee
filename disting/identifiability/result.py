"""What is said about one chain: how many parameters can be determined, how many sets of them fit, what can be determined."""

from dataclasses import asdict, dataclass
from typing import Any

from disting.certainty import Grade
from disting.identifiability.codec import decoded
from disting.identifiability.parts import Alternative, Combination, Level, Renaming, Scaling
from disting.identifiability.words import sentence
from disting.synthesis.result import Answer


@dataclass(frozen=True, slots=True)
class Identifiability:
    """Identifiability of one chain.

    `rank`: number of determinable parameters, with its grade. `least` and `most`: bounds of the number of complex parameter
    vectors with one generic behaviour (`most` None: infinite or not known). `count_grade`: grade of "at most `most`", and of
    "exactly" where both agree. `alternatives`: those listed at the random point `point` (name, fraction), the point itself
    first. `singles`: the locally identifiable parameters. `basis`: `rank` independent locally identifiable combinations, the
    most readable found. That both are identifiable, and that no other parameter is, is wrong with a probability of at most
    2**-safety (0: proven). `scalings` and `renamings`: symmetries; `self_dual`: see Origin.DUALITY.
    """

    parameters: tuple[str, ...]
    rank: int
    rank_grade: Grade
    level: Level
    level_grade: Grade
    least: int
    most: int | None
    count_grade: Grade
    alternatives: tuple[Alternative, ...]
    singles: tuple[Combination, ...]
    basis: tuple[Combination, ...]
    safety: int
    scalings: tuple[Scaling, ...]
    renamings: tuple[Renaming, ...]
    self_dual: bool
    point: tuple[tuple[str, str], ...]
    reason: str = ""

    def __post_init__(self) -> None:
        if self.most is not None and self.least > self.most:
            raise ValueError("the least number of solutions is larger than the most")
        if (self.level is Level.NOT) != (self.rank < len(self.parameters)):
            raise ValueError("a chain is not identifiable exactly if its rank is smaller than the number of its parameters")

    @property
    def sentence(self) -> str:
        """The finding in plain English."""
        return sentence(self)

    @property
    def combinations(self) -> tuple[str, ...]:
        """The basis as text: k01/m1."""
        return tuple(c.text for c in self.basis)

    @property
    def real(self) -> int:
        """How many of the parameter vectors listed at the random point are real."""
        return sum(a.real is Answer.YES for a in self.alternatives)

    @property
    def positive(self) -> int:
        """How many of them are positive."""
        return sum(a.positive is Answer.YES for a in self.alternatives)

    def to_dict(self) -> dict[str, object]:
        """Plain data, ready for JSON."""
        return asdict(self)

    @staticmethod
    def from_dict(data: dict[str, Any]) -> "Identifiability":
        """Inverse of `to_dict`; raises KeyError, TypeError or ValueError for what is none."""
        return Identifiability(**decoded(data))

    def __bool__(self) -> bool:
        raise TypeError("identifiability is not true or false; look at its level")
