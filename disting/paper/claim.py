"""A printed statement and its check."""

from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum

from disting.paper.findings import Findings


class Outcome(StrEnum):
    """Whether what is found here agrees with what is printed."""

    AGREES = "agrees"
    DIFFERS = "differs"
    UNCHECKED = "cannot be checked"


@dataclass(frozen=True, slots=True)
class Found:
    """What is found here, in words, and whether the printed statement holds."""

    value: str
    agrees: bool

    @property
    def outcome(self) -> Outcome:
        """As an outcome."""
        return Outcome.AGREES if self.agrees else Outcome.DIFFERS


@dataclass(frozen=True, slots=True)
class Claim:
    """One statement of the paper.

    `place` where it is printed; `text` the statement, literally where it stands in quotation
    marks; `printed` its value; `check` computes ours, None where nobody can; `outcome` what the
    check is known to give; `reason` why; `about` the subject of what differs, in a few words.
    """

    key: str
    place: str
    text: str
    printed: str
    check: Callable[[Findings], Found] | None
    outcome: Outcome
    reason: str = ""
    about: str = ""

    def __post_init__(self) -> None:
        if (self.check is None) != (self.outcome is Outcome.UNCHECKED):
            raise ValueError(f"{self.key}: a claim without a check is unchecked, and no other")
        if self.outcome is not Outcome.AGREES and not self.reason:
            raise ValueError(f"{self.key}: what does not agree needs a reason")
        if (self.outcome is Outcome.DIFFERS) != bool(self.about):
            raise ValueError(f"{self.key}: what differs, and nothing else, says what it is about")
