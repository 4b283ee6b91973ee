"""What one condition finds about one pair: three-valued and more, never a bare bool."""

from dataclasses import dataclass
from enum import StrEnum

from disting.algebra.certainty import Certainty, shortfall
from disting.conditions.rule import Rule
from disting.evidence.kinds import Evidence
from disting.model.shown import summary


class Outcome(StrEnum):
    """A condition holds, fails, does not apply to this pair or representation, or was given up at
    a limit.

    SOMETIMES: it holds for some parameter values and fails for others.
    """

    HOLDS = "holds"
    FAILS = "fails"
    INAPPLICABLE = "inapplicable"
    ABANDONED = "abandoned"
    SOMETIMES = "sometimes"


@dataclass(frozen=True, slots=True)
class Finding:
    """Outcome of a rule; with BOUNDED the probability of error is at most 2**-safety. `note` says
    why not.

    A bounded outcome whose bound does not reach 2**-LEAST_SAFETY becomes ABANDONED, whoever makes
    the finding.
    """

    rule: Rule
    outcome: Outcome
    certainty: Certainty = Certainty.PROVEN
    safety: int = 0
    evidence: Evidence | None = None
    note: str = ""

    def __post_init__(self) -> None:
        lacking = shortfall(self.certainty, self.safety)
        if lacking:
            given_up = {
                "outcome": Outcome.ABANDONED,
                "certainty": Certainty.PROVEN,
                "safety": 0,
                "evidence": None,
            }
            for name, value in (given_up | {"note": lacking}).items():
                object.__setattr__(self, name, value)

    def __repr__(self) -> str:
        return summary(self, f"{self.rule.in_words()} {self.outcome} ({self.certainty})")

    def __bool__(self) -> bool:
        raise TypeError("a finding is not true or false; look at its outcome")
