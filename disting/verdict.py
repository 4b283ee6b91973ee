"""From findings to a verdict: the conditions in order, in each representation, until one decides.

Transfer-function coefficients first (conditions 1 to 7), then Markov parameters (3 to 7), then structure (8 and 9). A
necessary condition that fails decides DISTINGUISHABLE, a sufficient one that holds INDISTINGUISHABLE; otherwise the pair is
left to the exact decision; what it cannot settle is UNDECIDED. The paper's view ends with the conditions.
All of it is over the complex numbers: distinguishable models are so over real and positive parameters too (real and positive
points are Zariski dense), while for indistinguishable ones the admissible values are asked for (see `conditions.admissible`).
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from enum import StrEnum

from disting.certainty import Certainty
from disting.conditions.admissible import ADMISSIBLE, resting_on
from disting.conditions.evidence import Evidence
from disting.conditions.evidence import from_dict as evidence_from
from disting.conditions.evidence import to_dict as evidence_to
from disting.conditions.exact import EXACT
from disting.conditions.finding import Finding, Outcome
from disting.conditions.inclusion import (
    Inclusion,
    InclusionFinding,
    inclusion_finding,
    inclusion_from_dict,
    inclusion_to_dict,
)
from disting.conditions.subject import Subject
from disting.conditions.table import CONDITIONS, NECESSARY, STRUCTURE, Necessary, Structural, Sufficient
from disting.domain import Domain
from disting.errors import ContradictionError, InputError
from disting.invariants.sample import Representation
from disting.positivity import PositiveFinding

ALL_CONDITIONS = tuple(c.number for c in CONDITIONS)
RULE_NAMES = {0: "", **{n: str(n) for n in ALL_CONDITIONS}, EXACT: "exact", ADMISSIBLE: "admissible"}  # what `decided_by` says
FIBRE = "fibre"  # the representation of the exact decision
PARAMETERS = "parameters"  # and of the question whether equivalents have admissible parameters


class Relation(StrEnum):
    """What is known of a pair; SOMETIMES: for some admissible parameters there is an equivalent, for others there is none."""

    DISTINGUISHABLE = "distinguishable"
    INDISTINGUISHABLE = "indistinguishable"
    SOMETIMES = "sometimes"
    UNDECIDED = "undecided"


class View(StrEnum):
    """Which representations may decide: `combined` is the paper's, all conditions; `exact` adds the exact decision.

    `real` and `positive` are `exact`, and then look whether equivalents with such parameters exist.
    """

    TF = "tf"
    MARKOV = "markov"
    COMBINED = "combined"
    EXACT = "exact"
    REAL = "real"
    POSITIVE = "positive"

    @property
    def domain(self) -> Domain:
        """Parameter values that this view speaks of."""
        return Domain(self.value) if self in (View.REAL, View.POSITIVE) else Domain.COMPLEX

    @property
    def representations(self) -> tuple[str, ...]:
        """The representations of this view, in order."""
        if self in (View.TF, View.MARKOV):
            return (self.value,)
        return ("tf", "markov", STRUCTURE) if self is View.COMBINED else ("tf", "markov", STRUCTURE, FIBRE)


@dataclass(frozen=True, slots=True)
class Query:
    """What may be used to decide: the view, the conditions' numbers, the number of Markov parameters (0 = all).

    `inclusion`: after the exact decision, say also whose models lie in the other's closure and which positive models have
    positive equivalents; this is most of the work.
    """

    view: View = View.EXACT
    conditions: tuple[int, ...] = ALL_CONDITIONS
    markov: int = 0
    inclusion: bool = True

    def __post_init__(self) -> None:
        if not set(self.conditions) <= set(ALL_CONDITIONS):
            raise InputError(f"conditions are numbered 1 to 9, not {sorted(set(self.conditions) - set(ALL_CONDITIONS))}")
        if self.markov < 0:
            raise InputError(f"the number of Markov parameters is 1 or more, or 0 for all, not {self.markov}")

    @property
    def tells_inclusion(self) -> bool:
        """Whether verdicts say whose models have equivalents on the other side: not in the paper's views."""
        return self.inclusion and FIBRE in self.view.representations

    def count(self, left: Subject, right: Subject) -> int:
        """Number of Markov parameters after G_0: as asked, or the N_S1 + N_S2 that are exhaustive."""
        return self.markov or left.chain.structure.n_states + right.chain.structure.n_states


def error_bound(certainty: str, safety: int) -> str:
    """Text of the bound that goes with a certainty."""
    if not certainty:
        return ""
    return f"2^-{safety}" if certainty == Certainty.BOUNDED else "0"


@dataclass(frozen=True, slots=True)
class Verdict:
    """Relation of a pair with its proof.

    `decided_by`: the condition's number, "exact", or "" if undecided; `representation`: "tf", "markov", "structure", "fibre"
    or ""; with certainty BOUNDED the probability of error is at most 2**-safety; `notes` names what was abandoned. `inclusion`
    tells, over complex parameters, whose generic models have equivalents on the other side; for models of unequal rank
    `inclusion_finding` says why. `left_positive`: which positive left models have a positive equivalent on the right, where
    generic left ones have equivalents there; `right_positive`: the reverse.
    """

    left: str
    right: str
    relation: Relation
    decided_by: str = ""
    representation: str = ""
    certainty: Certainty | None = None
    safety: int = 0
    evidence: Evidence | None = None
    domain: Domain = Domain.COMPLEX
    notes: tuple[str, ...] = ()
    inclusion: Inclusion = Inclusion.UNKNOWN
    inclusion_finding: InclusionFinding | None = None
    left_positive: PositiveFinding | None = None
    right_positive: PositiveFinding | None = None

    def __post_init__(self) -> None:
        decided = self.relation is not Relation.UNDECIDED
        if decided != bool(self.decided_by and self.representation and self.certainty and self.evidence):
            raise ValueError("exactly a decided verdict names condition, representation, certainty and evidence")

    def __bool__(self) -> bool:
        raise TypeError("a verdict is not true or false; look at its relation")

    @property
    def error_bound(self) -> str:
        """Probability that the verdict is wrong, at most; "0" where nothing is left to chance, "" if undecided."""
        return error_bound(self.certainty or "", self.safety)

    @property
    def sentence(self) -> str:
        """The verdict in words an engineer understands."""
        over = "" if self.domain is Domain.COMPLEX else f" over {self.domain} parameters"
        if self.evidence is None:
            why = f" ({'; '.join(self.notes)})" if self.notes else ""
            return f"{self.left} and {self.right} are undecided{over}: nothing settles them{why}."
        says = "agree for some parameters only" if self.relation is Relation.SOMETIMES else f"are {self.relation}{over}"
        return f"{self.left} and {self.right} {says} ({self.rule}): {self.evidence.sentence(self.left, self.right)}"

    @property
    def rule(self) -> str:
        """What decided, in words; "" if nothing did."""
        if self.decided_by.isdigit():
            where = {"tf": "transfer function", "markov": "Markov parameters"}.get(self.representation, "structure")
            return f"condition {self.decided_by}, {where}"
        return {"": "", RULE_NAMES[EXACT]: "exact decision"}.get(self.decided_by, f"equivalents with {self.domain} parameters")

    def to_dict(self) -> dict[str, object]:
        """Plain data, ready for JSON; error bound and sentence are derived."""
        evidence = evidence_to(self.evidence) if self.evidence else {}
        return {
            "left": self.left,
            "right": self.right,
            "relation": self.relation.value,
            "decided_by": self.decided_by,
            "representation": self.representation,
            "certainty": self.certainty.value if self.certainty else "",
            "safety": self.safety,
            "domain": self.domain.value,
            "inclusion": self.inclusion.value,
            "inclusion_finding": {} if self.inclusion_finding is None else inclusion_to_dict(self.inclusion_finding),
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
        certainty, evidence, inclusion = data["certainty"], data["evidence"], data["inclusion_finding"]
        return Verdict(
            str(data["left"]),
            str(data["right"]),
            Relation(str(data["relation"])),
            str(data["decided_by"]),
            str(data["representation"]),
            Certainty(str(certainty)) if certainty else None,
            int(str(data["safety"])),
            evidence_from(evidence) if isinstance(evidence, dict) and evidence else None,
            Domain(str(data["domain"])),
            tuple(map(str, data["notes"])) if isinstance(data["notes"], list) else (),
            Inclusion(str(data["inclusion"])),
            inclusion_from_dict(inclusion) if isinstance(inclusion, dict) and inclusion else None,
            *(_positive_from(data[side]) for side in ("left_positive", "right_positive")),
        )


def _positive_from(data: object) -> PositiveFinding | None:
    return PositiveFinding.from_dict(data) if isinstance(data, dict) and data else None


@dataclass(frozen=True, slots=True)
class Step:
    """One condition in one representation, with what it found."""

    representation: str
    finding: Finding

    @property
    def relation(self) -> Relation:
        """What this finding alone decides."""
        number, outcome = self.finding.number, self.finding.outcome
        if outcome is Outcome.SOMETIMES:
            return Relation.SOMETIMES
        if outcome is Outcome.FAILS and (number <= len(NECESSARY) or number in (EXACT, ADMISSIBLE)):
            return Relation.DISTINGUISHABLE
        if outcome is Outcome.HOLDS and number > len(NECESSARY):
            return Relation.INDISTINGUISHABLE
        return Relation.UNDECIDED


def steps(left: Subject, right: Subject, query: Query) -> Iterator[Step]:
    """Yield every condition's finding lazily, in order: representation by representation, condition by condition."""
    count = query.count(left, right)
    for representation in query.view.representations:
        for condition in CONDITIONS:
            if condition.number in query.conditions:
                yield from _step(condition, left, right, representation, count)
        if representation == FIBRE:
            yield Step(FIBRE, left.exact(right))


def decide(left: Subject, right: Subject, query: Query) -> Verdict:
    """Verdict of the first step that decides; indistinguishable over complex parameters, it goes on to admissible ones."""
    found, domain = _decided(left, right, query), query.view.domain
    if query.tells_inclusion:
        found = with_inclusion(found, left.rank == right.rank, lambda: inclusion_finding(left, right))
        found = _with_shares(found, left, right)
    if domain is Domain.COMPLEX or found.relation is not Relation.INDISTINGUISHABLE:
        return replace(found, domain=domain)
    grade = (found.certainty or Certainty.NUMERICAL, found.safety)
    step = Step(PARAMETERS, resting_on(left.admissible(right, domain), grade))
    open_pair = Verdict(left.name, right.name, Relation.UNDECIDED, domain=domain, notes=(open_note(step.finding.note),))
    said = open_pair if step.relation is Relation.UNDECIDED else verdict_of(left.name, right.name, step, domain)
    return replace(said, inclusion=found.inclusion, left_positive=found.left_positive, right_positive=found.right_positive)


def open_note(reason: str) -> str:
    """What is said of a pair that is open over admissible parameters only."""
    return f"over complex parameters they are indistinguishable; {reason}"


def _with_shares(verdict: Verdict, left: Subject, right: Subject) -> Verdict:
    """With the positive equivalents of each side whose generic models have equivalents on the other side, not only limits."""
    if left.chain.n_masses != right.chain.n_masses:
        return verdict
    here = verdict.inclusion in (Inclusion.EQUAL, Inclusion.LEFT_IN_RIGHT)
    there = verdict.inclusion in (Inclusion.EQUAL, Inclusion.RIGHT_IN_LEFT)
    return replace(
        verdict,
        left_positive=left.positive(right) if here else None,
        right_positive=right.positive(left) if there else None,
    )


def with_inclusion(verdict: Verdict, equal_rank: bool, finding: Callable[[], InclusionFinding]) -> Verdict:
    """The verdict over complex parameters with its inclusion; of unequal rank the finding tells it."""
    if verdict.relation is Relation.UNDECIDED:
        return verdict
    if verdict.relation is Relation.INDISTINGUISHABLE:
        return replace(verdict, inclusion=Inclusion.EQUAL)
    if equal_rank:
        return replace(verdict, inclusion=Inclusion.NEITHER)
    found = finding()
    return replace(verdict, inclusion=found.inclusion, inclusion_finding=found)


def _decided(left: Subject, right: Subject, query: Query) -> Verdict:
    notes: list[str] = []
    for step in steps(left, right, query):
        if step.relation is not Relation.UNDECIDED:
            return verdict_of(left.name, right.name, step)
        if step.finding.outcome is Outcome.ABANDONED:
            notes.append(f"{_rule(step)} was abandoned: {step.finding.note}")
    return Verdict(left.name, right.name, Relation.UNDECIDED, notes=tuple(notes))


def _rule(step: Step) -> str:
    number = step.finding.number
    return "the exact decision" if number == EXACT else f"condition {number} on {step.representation}"


def audit(left: Subject, right: Subject, query: Query) -> Verdict:
    """Run every condition in every representation; raise ContradictionError where two decide differently."""
    deciding = [step for step in steps(left, right, query) if step.relation is not Relation.UNDECIDED]
    if len({step.relation for step in deciding}) > 1:
        found = ", ".join(f"{s.relation} by condition {s.finding.number} ({s.representation})" for s in deciding)
        raise ContradictionError(f"{left.name} and {right.name}: {found}")
    return decide(left, right, query)


def verdict_of(left: str, right: str, step: Step, domain: Domain = Domain.COMPLEX) -> Verdict:
    """The verdict that a deciding step gives."""
    f, rule = step.finding, RULE_NAMES[step.finding.number]
    return Verdict(left, right, step.relation, rule, step.representation, f.certainty, f.safety, f.evidence, domain)


def _step(
    condition: Necessary | Sufficient | Structural, left: Subject, right: Subject, representation: str, count: int
) -> Iterator[Step]:
    match condition:
        case Structural() if representation == STRUCTURE:
            yield Step(representation, condition.check(left, right))
        case Necessary() if representation in tuple(Representation):
            r = Representation(representation)
            n = count if r is Representation.MARKOV else 0
            yield Step(representation, condition.check(left.profile(r, n), right.profile(r, n)))
        case Sufficient() if representation in tuple(Representation):
            r = Representation(representation)
            yield Step(representation, condition.check(left, right, r, count if r is Representation.MARKOV else 0))
