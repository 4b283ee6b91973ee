"""The question about a pair and its answer: the verdict with its proof, its words, its JSON form.

A query names what may decide: representations, conditions, Markov parameters, and the values of the
parameters. By default it is about positive parameters: masses, springs and dampers of a machine are
positive. The paper's views speak of generic complex parameters.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from enum import StrEnum
from functools import cached_property

from disting.algebra.certainty import Certainty, bits_in_words
from disting.conditions.inclusion import (
    Inclusion,
    Inclusions,
    inclusions_from_dict,
    inclusions_to_dict,
)
from disting.conditions.rule import (
    EXACT,
    RULES,
    Finding,
    Outcome,
    Role,
    Rule,
    Stage,
    condition_names,
)
from disting.errors import InputError, short
from disting.evidence.conditions import capital
from disting.evidence.kinds import Evidence, evidence_from as evidence_from
from disting.evidence.positive import BothWays, PositiveFinding
from disting.model.chain import Premise
from disting.model.presentation import AS_CHAIN, COUNTED, GENERIC, NotebookTable, summary
from disting.model.question import Domain, Relation as Relation


def error_bound(certainty: str, safety: int) -> str:
    """Text of the bound that goes with a certainty."""
    if not certainty:
        return ""
    return bits_in_words(safety) if certainty == Certainty.BOUNDED else "0"


TOLD = (COUNTED, GENERIC, AS_CHAIN)  # how notes begin that belong to what is said
WHERE = {Stage.TF: "transfer function", Stage.MARKOV: "Markov parameters"}
_APART, _SAME = (
    {Outcome.FAILS: Relation.DISTINGUISHABLE},
    {Outcome.HOLDS: Relation.INDISTINGUISHABLE},
)
PROVES: dict[Role, dict[Outcome, Relation]] = {
    Role.NECESSARY: _APART,
    Role.SUFFICIENT: _SAME,
    Role.STRUCTURAL: _SAME,
    Role.DECISION: _APART | _SAME | {Outcome.SOMETIMES: Relation.SOMETIMES},
}  # what an outcome proves; others prove nothing


@dataclass(frozen=True, slots=True)
class Step:
    """One condition in one representation, with what it found.

    >>> from disting import findings
    >>> findings("2:1", "2:2")[0].representation.value
    'tf'
    """

    representation: Stage
    finding: Finding

    def __repr__(self) -> str:
        where = f", {self.representation}" if self.representation else ""
        return summary(self, f"{self.finding.rule.in_words()}{where}: {self.finding.outcome}")

    @property
    def relation(self) -> Relation:
        """Relation that this finding alone decides."""
        return PROVES[self.finding.rule.role].get(self.finding.outcome, Relation.UNDECIDED)


@dataclass(frozen=True, slots=True)
class Verdict(NotebookTable):
    """Relation of a pair with its proof.

    `decided_by`: the name of the rule, "1" to "9", "exact", "admissible", or "" if undecided;
    `representation`: the stage at which it looked; with certainty BOUNDED the probability of error
    is at most 2**-safety; `notes` names what was abandoned. `image`: over complex parameters, whose
    generic models have equivalents on the other side, elements finite and not zero; `closure` whose
    are limits of models there; for models of unequal rank `inclusions` gives the reasons.
    `left_positive`: which positive left models have a positive equivalent on the right, where
    generic left ones have equivalents there; `right_positive`: the reverse. `premises`: damping and
    sensor quantity of both, None of models that are no chains.

    >>> from disting import compare
    >>> found = compare("2:1", "2:2")
    >>> found.relation.value, found.decided_by, found.certainty.value
    ('distinguishable', '1', 'proven')
    """

    left: str
    right: str
    relation: Relation
    decided_by: str = ""
    representation: Stage = Stage.NONE
    certainty: Certainty | None = None
    safety: int = 0
    evidence: Evidence | None = None
    domain: Domain = Domain.COMPLEX
    notes: tuple[str, ...] = ()
    image: Inclusion = Inclusion.UNKNOWN
    closure: Inclusion = Inclusion.UNKNOWN
    inclusions: Inclusions | None = None
    left_positive: PositiveFinding | None = None
    right_positive: PositiveFinding | None = None
    premises: tuple[Premise | None, Premise | None] = (None, None)

    def __post_init__(self) -> None:
        decided = self.relation is not Relation.UNDECIDED
        if decided != bool(
            self.decided_by and self.representation and self.certainty and self.evidence
        ):
            raise ValueError(
                "exactly a decided verdict names condition, representation, certainty and evidence"
            )

    def __repr__(self) -> str:
        # the names are short ones in catalogues, of any length in lists of one's own
        left, right = (n if len(n) <= 30 else f"{n[:29]}…" for n in (self.left, self.right))
        sure = self.sure.removeprefix("probability of ").partition(" (")[0]
        how = f", {sure}" if sure else ""
        models = _models(left, right, self.premises).removesuffix(",")
        return summary(self, f"{models}: {self.in_words} over {self.domain} parameters{how}")

    def __str__(self) -> str:
        return self.sentence

    def __bool__(self) -> bool:
        raise TypeError("a verdict is not true or false; use its relation")

    @property
    def error_bound(self) -> str:
        """Probability that the verdict is wrong, at most; "0" where nothing is left to chance,
        "" if undecided.
        """
        return error_bound(self.certainty or "", self.safety)

    @property
    def sure(self) -> str:
        """Certainty in words; "" if undecided.

        >>> from disting import compare
        >>> compare("3:1", "3:11").sure, compare("3:1", "3:2").sure
        ('proven (duality theorem)', 'proven')
        """
        if self.certainty is None:
            return ""
        return self.certainty.in_words(self.safety, self.evidence.title if self.evidence else "")

    @property
    def has_exceptions(self) -> bool:
        """True if special values, a set of measure zero, are excepted: the rule that decides
        indistinguishable models does not cover them.
        """
        if self.relation is not Relation.INDISTINGUISHABLE or self.evidence is None:
            return False
        return not self.evidence.without_exception(self.domain)

    @property
    def models(self) -> str:
        """Both names with their premises."""
        return _models(self.left, self.right, self.premises)

    @property
    def sentence(self) -> str:
        """The verdict in self-contained words: models, domain, reason, certainty."""
        over = f" over {self.domain} parameters"
        if self.evidence is None:
            why = f" ({'; '.join(self.notes)})" if self.notes else ""
            return (
                f"{self.models} are undecided{over}: none of the available methods decides"
                f" them{why}."
            )
        depending = ", depending on their values" if self.relation is Relation.SOMETIMES else ""
        aside = ", special values aside" if self.has_exceptions else ""
        return (
            f"{self.models} are {self.in_words}{over}{depending}{aside} ({self.rule}):"
            f" {self.evidence.sentence(self.left, self.right)} {capital(self.sure)}."
            + "".join(f" {capital(note)}." for note in self.notes if note.startswith(TOLD))
        )

    @property
    def in_words(self) -> str:
        """The relation as used in a sentence."""
        sometimes = self.relation is Relation.SOMETIMES
        return "sometimes indistinguishable" if sometimes else self.relation.value

    @property
    def rule(self) -> str:
        """Deciding rule in words; "" if there is none."""
        if not self.decided_by:
            return ""
        rule = RULES[self.decided_by]
        if rule.role is not Role.DECISION:
            where = WHERE.get(self.representation, "structure")
            return f"{rule.in_words()}, {where}"
        grounds = self.evidence.claim.grounds if self.evidence and rule is EXACT else ""
        return ", ".join(filter(None, [rule.in_words(self.domain).removeprefix("the "), grounds]))

    @property
    def proves_shares(self) -> bool:
        """True if the evidence itself states the share of positive models with positive
        equivalents.
        """
        return isinstance(self.evidence, BothWays)

    def to_dict(self) -> dict[str, object]:
        """Plain data, ready for JSON; error bound and sentence are derived."""
        evidence = self.evidence.to_dict() if self.evidence else {}
        return {
            "left": self.left,
            "right": self.right,
            "left_premise": _premise_to(self.premises[0]),
            "right_premise": _premise_to(self.premises[1]),
            "relation": self.relation.value,
            "decided_by": self.decided_by,
            "representation": self.representation,
            "certainty": self.certainty.value if self.certainty else "",
            "safety": self.safety,
            "domain": self.domain.value,
            "image": self.image.value,
            "closure": self.closure.value,
            "inclusions": {} if self.inclusions is None else inclusions_to_dict(self.inclusions),
            "left_positive": {} if self.left_positive is None else self.left_positive.to_dict(),
            "right_positive": {} if self.right_positive is None else self.right_positive.to_dict(),
            "error_bound": self.error_bound,
            "evidence": evidence,
            "notes": list(self.notes),
            "sentence": self.sentence,
        }

    @staticmethod
    def from_dict(data: dict[str, object]) -> "Verdict":
        """Inverse of to_dict; raises ValueError, KeyError or TypeError for what is none."""
        certainty, evidence, inclusion = data["certainty"], data["evidence"], data["inclusions"]
        return Verdict(
            str(data["left"]),
            str(data["right"]),
            Relation(str(data["relation"])),
            str(data["decided_by"]),
            Stage(str(data["representation"])),
            Certainty(str(certainty)) if certainty else None,
            int(str(data["safety"])),
            evidence_from(evidence) if isinstance(evidence, dict) and evidence else None,
            Domain(str(data["domain"])),
            tuple(map(str, data["notes"])) if isinstance(data["notes"], list) else (),
            Inclusion(str(data["image"])),
            Inclusion(str(data["closure"])),
            inclusions_from_dict(inclusion) if isinstance(inclusion, dict) and inclusion else None,
            left_positive=_positive_from(data["left_positive"]),
            right_positive=_positive_from(data["right_positive"]),
            premises=(_premise_from(data["left_premise"]), _premise_from(data["right_premise"])),
        )


def open_note(reason: str) -> str:
    """Note on a pair that is open over admissible parameters only."""
    return f"over complex parameters they are indistinguishable; {reason}"


def _models(left: str, right: str, premises: tuple[Premise | None, Premise | None]) -> str:
    """Both names, with their premises, once if they are equal.

    >>> from disting.model.chain import Quantity
    >>> a, b = Premise(True, Quantity.ACCELERATION), Premise(False, Quantity.POSITION)
    >>> _models("3:1", "3:4", (a, a)), _models("3:1", "star", (b, None))
    ('3:1 and 3:4, damped, acceleration,', '3:1 (undamped, position) and star')
    """
    if premises[0] == premises[1]:
        return f"{left} and {right}" + (f", {premises[0]}," if premises[0] else "")
    named = zip((left, right), premises, strict=True)
    return " and ".join(n if k is None or n.endswith(f"({k})") else f"{n} ({k})" for n, k in named)


def _premise_to(premise: Premise | None) -> dict[str, object]:
    return {} if premise is None else premise.to_dict()


def _premise_from(data: object) -> Premise | None:
    return Premise.from_dict(data) if isinstance(data, dict) and data else None


def _positive_from(data: object) -> PositiveFinding | None:
    return PositiveFinding.from_dict(data) if isinstance(data, dict) and data else None


ALL_CONDITIONS = tuple(name for name, rule in RULES.items() if rule.is_condition)


class View(StrEnum):
    """Selection of the representations that may decide: `combined` is the paper's, all conditions;
    `exact` adds the exact decision.

    All of them are over complex parameters. `real` and `positive` are `exact`, and then decide
    whether equivalents with such parameters exist; `positive` is the default.

    >>> View.POSITIVE.domain.value, View.MARKOV.domain.value
    ('positive', 'complex')
    """

    TF = "tf"
    MARKOV = "markov"
    COMBINED = "combined"
    EXACT = "exact"
    REAL = "real"
    POSITIVE = "positive"

    @cached_property
    def domain(self) -> Domain:
        """Parameter values that this view speaks of."""
        return Domain(self.value) if self in (View.REAL, View.POSITIVE) else Domain.COMPLEX

    @cached_property
    def representations(self) -> tuple[Stage, ...]:
        """The representations of this view, in order."""
        if self in (View.TF, View.MARKOV):
            return (Stage(self.value),)
        conditions = (Stage.TF, Stage.MARKOV, Stage.STRUCTURE)
        return conditions if self is View.COMBINED else (*conditions, Stage.FIBRE)


@dataclass(frozen=True, slots=True)
class Query:
    """Settings of a decision: the view, the conditions' names, the number of Markov parameters (0 =
    all).

    `inclusion`: after the exact decision, decide also whose models lie in the other's closure and
    which positive models have positive equivalents; this is most of the work.

    >>> from disting import compare
    >>> compare("3:1", "3:4", query=Query(View.COMBINED, ("1", "4", "5"))).decided_by
    '5'
    """

    view: View = View.POSITIVE
    conditions: tuple[str, ...] = ALL_CONDITIONS
    markov: int = 0
    inclusion: bool = True

    def __post_init__(self) -> None:
        # numbers do as well as names
        object.__setattr__(self, "conditions", tuple(map(str, self.conditions)))
        unknown = [name for name in self.conditions if name not in ALL_CONDITIONS]
        if unknown:
            raise InputError(
                f"conditions are {', '.join(ALL_CONDITIONS)}, not {', '.join(unknown)}"
            )
        if self.markov < 0:
            raise InputError(
                f"the number of Markov parameters is 1 or more, or 0 for all, not {self.markov}"
            )

    def __repr__(self) -> str:
        options = [] if self.view is View.POSITIVE else [f"View.{self.view.name}"]
        options += [f"conditions={self.conditions}"] if self.conditions != ALL_CONDITIONS else []
        options += [f"markov={self.markov}"] if self.markov else []
        options += [] if self.inclusion else ["inclusion=False"]
        return f"Query({', '.join(options)})"

    def asks(self, rule: Rule) -> bool:
        """Return True if this condition may decide."""
        return rule.name in self.conditions

    @property
    def tells_inclusion(self) -> bool:
        """True if verdicts include the inclusions: not in the paper's views."""
        return self.inclusion and Stage.FIBRE in self.view.representations

    def count(self, n_states: int) -> int:
        """Number of Markov parameters after G_0: as requested, or the N_S1 + N_S2 = `n_states` of
        both models, which are exhaustive.
        """
        return self.markov or n_states


REPRESENTATIONS = {"tf": View.TF, "markov": View.MARKOV, "all": View.EXACT}
VIEWS = {
    Domain.COMPLEX: View.EXACT,
    Domain.REAL: View.REAL,
    Domain.POSITIVE: View.POSITIVE,
}  # everything that may decide over a domain
Conditions = str | Iterable[str | int]
"""Numbers of conditions: a list, or text such as "1-5,8"."""


def query_of(
    conditions: Conditions | None = None,
    domain: Domain | str | None = None,
    representation: str = "all",
    markov: int = 0,
) -> Query:
    """The query of these options: over positive parameters, but over complex ones, which is the
    paper's view, where conditions or a representation ("tf", "markov") are named. Conditions that
    are named decide alone. Raises InputError for unknown names, and for real or positive parameters
    together with conditions or a representation.

    >>> query_of(), query_of("1-3")
    (Query(), Query(View.COMBINED, conditions=('1', '2', '3')))
    """
    if representation not in REPRESENTATIONS:
        known = ", ".join(REPRESENTATIONS)
        raise InputError(f"representation is one of {known}, not {short(representation)}")
    view = REPRESENTATIONS[representation]
    is_paper = conditions is not None or view is not View.EXACT
    over = as_domain(domain or (Domain.COMPLEX if is_paper else Domain.POSITIVE))
    if over is not Domain.COMPLEX:
        if is_paper:
            raise InputError(
                f"domain {over} is not supported with conditions or a representation, which decide"
                " over complex parameters; remove one of them"
            )
        return Query(VIEWS[over], markov=markov)
    if conditions is None:
        return Query(view, markov=markov)
    names = condition_names(conditions) if isinstance(conditions, str) else tuple(conditions)
    return Query(View.COMBINED if view is View.EXACT else view, tuple(map(str, names)), markov)


def as_domain(domain: Domain | str) -> Domain:
    """The domain of this name; raises InputError for another one."""
    try:
        return Domain(domain)
    except ValueError:
        names = ", ".join(d.value for d in Domain)
        raise InputError(f"domain is one of {names}, not {short(domain)}") from None
