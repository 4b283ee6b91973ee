"""Rules that decide a pair, and their findings.

A rule is one of the conditions (their table is `conditions.table`) or one of the two questions
that follow them; each has a role and its words. What an outcome proves follows from the role alone,
so that nothing else knows how many conditions there are, or in what order. A finding is what one
rule yields for one pair: three-valued and more, never a bare bool.
"""

import json
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import Self

from disting.algebra.certainty import Certainty, weakest, withhold
from disting.errors import ContradictionError, InputError, short
from disting.evidence.kinds import Evidence, evidence_from
from disting.evidence.positive import BothWays, PositiveFinding, Share
from disting.model.presentation import summary
from disting.model.question import Domain


class Stage(StrEnum):
    """Where a rule looks, in the order in which a verdict does: two exhaustive summaries, the
    elements, one fibre, the values of the parameters; NONE where nothing decides.
    """

    NONE = ""
    TF = "tf"
    MARKOV = "markov"
    STRUCTURE = "structure"
    FIBRE = "fibre"
    PARAMETERS = "parameters"


class Role(StrEnum):
    """Logical role of a rule: what it can prove, and the profiles it needs.

    NECESSARY: a property of both profiles that indistinguishable models share, so that where it
    fails they are distinguishable. SUFFICIENT, STRUCTURAL: where it holds they are
    indistinguishable; evaluated on two summaries, or of two structures. DECISION: either, by what
    is found.
    """

    NECESSARY = "necessary"
    SUFFICIENT = "sufficient"
    STRUCTURAL = "structural"
    DECISION = "decision"


@dataclass(frozen=True, slots=True)
class Rule:
    """`name` in data and tables; `title`: what it looks at; `text`: what holds then.

    `phrase` is how sentences name it, with {domain} for the parameter domain, and `mark` is what a
    field of a matrix shows; without them it is "condition NAME", marked by its name.
    """

    name: str
    role: Role
    title: str
    text: str
    phrase: str = ""
    mark: str = ""

    @property
    def sign(self) -> str:
        """Sign shown in a field of a matrix."""
        return self.mark or self.name

    @property
    def is_condition(self) -> bool:
        """True if the rule is a row of the table of conditions."""
        return self.role is not Role.DECISION

    def in_words(self, domain: Domain = Domain.POSITIVE) -> str:
        """The rule in a sentence.

        >>> EXACT.in_words(), ADMISSIBLE.in_words(Domain.REAL)
        ('the exact decision', 'equivalents with real parameters')
        """
        return self.phrase.format(domain=domain) if self.phrase else f"condition {self.name}"


INVARIANTS = Rule("1", Role.NECESSARY, "number of invariants", "equally many moment invariants")
DEGREES = Rule(
    "2", Role.NECESSARY, "degrees", "equally many numerator and denominator coefficients"
)
FORM = Rule("3", Role.NECESSARY, "symbolic form", "the same invariants are constant")
RANK = Rule("4", Role.NECESSARY, "generic rank", "equally many determinable parameters")
DEPENDENCES = Rule(
    "5", Role.NECESSARY, "dependences", "the same sets of invariants are independent"
)
RENAMING = Rule(
    "6", Role.SUFFICIENT, "renaming", "a renaming of the parameters makes the invariants identical"
)
FREE_CHOICE = Rule(
    "7",
    Role.SUFFICIENT,
    "free choice",
    "as many determinable parameters as non-constant invariants",
)
SUBMODEL = Rule(
    "8", Role.STRUCTURAL, "submodel", "one model is a part of the other, with equal rank"
)
SUPERMODEL = Rule(
    "9", Role.STRUCTURAL, "supermodel", "both are parts of a third model, with equal rank"
)
EXACT = Rule(
    name="exact",
    role=Role.DECISION,
    title="exact decision",
    text="all parameters with the other model's transfer function, at a random choice of its own",
    phrase="the exact decision",
    mark="E",
)
ADMISSIBLE = Rule(
    name="admissible",
    role=Role.DECISION,
    title="positive equivalents",
    text="theorems, order of poles and zeros, certified points",
    phrase="equivalents with {domain} parameters",
    mark="+",
)
RULES = {
    rule.name: rule
    for rule in (
        *(INVARIANTS, DEGREES, FORM, RANK, DEPENDENCES),
        *(RENAMING, FREE_CHOICE),
        *(SUBMODEL, SUPERMODEL),
        *(EXACT, ADMISSIBLE),
    )
}
"""Every rule by its name, in the order in which they are evaluated."""


# what files have in the place of the rule where a decision found it, since the first of them: a
# mark, and no place in the table of conditions, of which one called 10 is written as text
WRITTEN = 10
NOT_REAL = (
    "over real parameters no rational map is known, real factors are not known to exist or to lack,"
    " and the numbers of equivalents are not odd or not known"
)


def condition_names(text: str) -> tuple[str, ...]:
    """Return names of conditions from text such as 1-5,8, in the order of the table; raises
    InputError.

    >>> condition_names("8,1-3")
    ('1', '2', '3', '8')
    """
    names = [rule.name for rule in RULES.values() if rule.is_condition]
    chosen = set[str]()
    for part in text.split(","):
        low, dash, high = part.strip().partition("-")
        high = high if dash else low
        if not {low, high} <= set(names) or names.index(high) < names.index(low):
            offered = f"the conditions {names[0]} to {names[-1]}"
            raise InputError(f"conditions are written like 1-5,8, of {offered}, not {short(text)}")
        chosen |= set(names[names.index(low) : names.index(high) + 1])
    return tuple(name for name in names if name in chosen)


class Outcome(StrEnum):
    """A condition holds, fails, does not apply to this pair or representation, or was abandoned at
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
    """Outcome of a rule; with BOUNDED the probability of error is at most 2**-safety. `note` gives
    the reason if not.

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
        raise TypeError("a finding is not true or false; use its outcome")

    @property
    def is_known(self) -> bool:
        """True if the rule was not abandoned."""
        return self.outcome is not Outcome.ABANDONED

    @property
    def turned(self) -> Self:
        """The finding on the pair in the other order."""
        return self if self.evidence is None else replace(self, evidence=self.evidence.turned)

    def to_json(self) -> str:
        """Compact JSON text of a finding of a decision; the caller knows its rule."""
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
