"""What may decide a pair: every rule once, with its role and its words.

A rule is one of the conditions (their table is `conditions.table`) or one of the two questions
that follow them. What an outcome proves follows from the role alone, so that nothing else knows
how many conditions there are, or in what order.
"""

from dataclasses import dataclass
from enum import StrEnum

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
    """What a rule can prove, and on what it is asked.

    NECESSARY: a property of both profiles that indistinguishable models share, so that where it
    fails they are distinguishable. SUFFICIENT, STRUCTURAL: where it holds they are
    indistinguishable; asked of two summaries, or of two structures. DECISION: either, by what is
    found.
    """

    NECESSARY = "necessary"
    SUFFICIENT = "sufficient"
    STRUCTURAL = "structural"
    DECISION = "decision"


@dataclass(frozen=True, slots=True)
class Rule:
    """`name` in data and tables; `title`: what it looks at; `text`: what holds then.

    `phrase` is how sentences name it, with {domain} for the parameters that are spoken of, and
    `mark` is what a field of a matrix shows; without them it is "condition NAME", marked by its
    name.
    """

    name: str
    role: Role
    title: str
    text: str
    phrase: str = ""
    mark: str = ""

    @property
    def sign(self) -> str:
        """What a field of a matrix shows."""
        return self.mark or self.name

    @property
    def is_condition(self) -> bool:
        """Whether it is asked as a row of the table of conditions."""
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
"""Every rule by its name, in the order in which they are asked."""
