"""What one condition finds about one pair: three-valued and more, never a bare bool."""

import json
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import Self

from disting.algebra.certainty import Certainty, weakest, withhold
from disting.conditions.rule import ADMISSIBLE, EXACT, Rule
from disting.errors import ContradictionError
from disting.evidence.kinds import Evidence, evidence_from
from disting.evidence.positive import BothWays, PositiveFinding, Share
from disting.model.presentation import summary

# what files have in the place of the rule where a decision found it, since the first of them: a
# mark, and no place in the table of conditions, of which one called 10 is written as text
WRITTEN = 10
NOT_REAL = (
    "over real parameters no rational map is known, real factors are not known to exist or to lack,"
    " and the numbers of equivalents are not odd or not known"
)


class Outcome(StrEnum):
    """A condition holds, fails, does not apply to this pair or representation, or was given up at
    a limit.

    SOMETIMES: it holds for some parameter values and fails for others.

    >>> from disting import findings
    >>> findings("3:1", "3:11")[0].finding.outcome is Outcome.HOLDS
    True
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

    >>> from disting import findings
    >>> findings("2:1", "2:2")[0].finding
    <Finding: condition 1 fails (proven)>
    """

    rule: Rule
    outcome: Outcome
    certainty: Certainty = Certainty.PROVEN
    safety: int = 0
    evidence: Evidence | None = None
    note: str = ""

    def __post_init__(self) -> None:
        withhold(
            self,
            (self.certainty, self.safety),
            "note",
            outcome=Outcome.ABANDONED,
            certainty=Certainty.PROVEN,
        )

    def __repr__(self) -> str:
        return summary(self, f"{self.rule.in_words()} {self.outcome} ({self.certainty})")

    def __bool__(self) -> bool:
        raise TypeError("a finding is not true or false; look at its outcome")

    @property
    def is_known(self) -> bool:
        """Whether the rule was not given up."""
        return self.outcome is not Outcome.ABANDONED

    @property
    def turned(self) -> Self:
        """The finding on the pair in the other order."""
        return self if self.evidence is None else replace(self, evidence=self.evidence.turned)

    def to_json(self) -> str:
        """Compact JSON text of a finding of a decision; its rule is known to whoever asked."""
        evidence = None if self.evidence is None else self.evidence.to_dict()
        data = [WRITTEN, self.outcome, self.certainty, self.safety, evidence, self.note]
        return json.dumps(data, separators=(",", ":"))

    @classmethod
    def from_json(cls, text: str, rule: Rule = EXACT) -> Self:
        """Inverse of `to_json`, for a finding by this rule; raises ValueError, KeyError or
        TypeError for what is none.
        """
        written, outcome, certainty, safety, evidence, note = json.loads(text)
        if written != WRITTEN:
            raise ValueError("not a finding of a decision")
        return cls(
            rule=rule,
            outcome=Outcome(outcome),
            certainty=Certainty(certainty),
            safety=safety,
            evidence=evidence_from(evidence) if evidence else None,
            note=note,
        )


# of both ways
SAME = {Share.ALWAYS: Outcome.HOLDS, Share.SOMETIMES: Outcome.SOMETIMES, Share.NEVER: Outcome.FAILS}


def positive_ways(left: PositiveFinding, right: PositiveFinding) -> Finding:
    """Over positive parameters, from the shares of both sides of a pair that is indistinguishable
    over complex ones.

    Raises ContradictionError where one side has equivalents and the other has none.
    """
    shares, graded_ways = {left.share, right.share}, [x for x in (left, right) if x.certainty]
    if Share.NEVER in shares and shares & {Share.ALWAYS, Share.SOMETIMES}:
        raise ContradictionError(
            f"positive equivalents {left.share} one way and {right.share} the other"
        )
    both = BothWays(left, right)
    if both.share is Share.UNKNOWN:
        reasons = "; ".join(
            dict.fromkeys(x.reason for x in (left, right) if x.share is Share.UNKNOWN)
        )
        return Finding(
            ADMISSIBLE,
            Outcome.ABANDONED,
            note=f"whether equivalents are positive is not known: {reasons}",
        )
    certainty, safety = weakest(*((x.certainty, x.safety) for x in graded_ways if x.certainty))
    return Finding(
        rule=ADMISSIBLE,
        outcome=SAME[both.share],
        certainty=certainty,
        safety=safety,
        evidence=both,
    )
