"""From findings to a verdict: the conditions in order, in each representation, until one decides.

Transfer-function coefficients first (conditions 1 to 7), then Markov parameters (3 to 7), then
structure (8 and 9). A necessary condition that fails decides DISTINGUISHABLE, a sufficient one that
holds INDISTINGUISHABLE; otherwise the pair is left to the exact decision; what it cannot settle is
UNDECIDED. The paper's view ends with the conditions. All of it is over the complex numbers:
distinguishable models are so over real and positive parameters too (real and positive points are
Zariski dense), while for indistinguishable ones the admissible values are decided (see
`questions.same.real_and_positive`).
"""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace

from disting.algebra.certainty import Certainty
from disting.behaviour.sample import Representation
from disting.conditions.inclusion import Inclusion, Inclusions
from disting.conditions.rule import ADMISSIBLE, EXACT, RULES, Finding, Outcome, Role, Stage
from disting.conditions.side import AnySide, notes_of
from disting.conditions.table import CONDITIONS, Necessary, Structural, Sufficient
from disting.errors import ContradictionError
from disting.evidence.kind import Carrier
from disting.evidence.kinds import Evidence
from disting.evidence.positive import PositiveFinding, Share
from disting.model.question import Domain
from disting.questions.same.real_and_positive import resting_on
from disting.verdict.result import PROVES, Query, Relation, Step, Verdict, open_note

SUMMARIES = (Stage.TF, Stage.MARKOV)  # exhaustive ones, which profiles are made of
STAGES = {
    Role.NECESSARY: SUMMARIES,
    Role.SUFFICIENT: SUMMARIES,
    Role.STRUCTURAL: (Stage.STRUCTURE,),
    Role.DECISION: (Stage.FIBRE,),
}  # at which a rule over complex parameters decides


def steps(left: AnySide, right: AnySide, query: Query) -> Iterator[Step]:
    """Yield every condition's finding lazily, in order: representation by representation,
    condition by condition.
    """
    count = query.count(left.n_states + right.n_states)
    for representation in query.view.representations:
        if representation is Stage.MARKOV and not (left.in_s and right.in_s):
            continue
        for condition in CONDITIONS:
            if query.asks(condition.rule):
                yield from _step(condition, left, right, representation, count)
        if representation is Stage.FIBRE:
            yield Step(Stage.FIBRE, left.exact(right))


def decide(left: AnySide, right: AnySide, query: Query) -> Verdict:
    """Verdict of the first step that decides; indistinguishable over complex parameters, it
    goes on to admissible ones.
    """
    verdict, domain = first(left, right, steps(left, right, query)), query.view.domain
    if query.tells_inclusion:
        verdict = with_inclusion(verdict, left.rank == right.rank, lambda: left.inclusions(right))
        verdict = _with_shares(verdict, left, right)
    if domain is Domain.COMPLEX or verdict.relation is not Relation.INDISTINGUISHABLE:
        return replace(verdict, domain=domain)
    step = Step(Stage.PARAMETERS, over_domain(left, right, domain, verdict))
    decided = (
        undecided_verdict(left, right, (open_note(step.finding.note),), domain)
        if step.relation is Relation.UNDECIDED
        else verdict_of(left, right, step, domain)
    )
    decided = replace(decided, image=verdict.image, closure=verdict.closure)
    return replace(
        decided, left_positive=verdict.left_positive, right_positive=verdict.right_positive
    )


def over_domain(left: AnySide, right: AnySide, domain: Domain, equal: Verdict | None) -> Finding:
    """Finding over real or positive parameters, as certain as the verdict over complex ones that it
    rests on; without one, a finding that rests on none.
    """
    if equal is None:
        return left.admissible(right, domain)
    grade = (equal.certainty or Certainty.NUMERICAL, equal.safety)
    return resting_on(left.admissible(right, domain, equal.evidence), grade, equal.evidence)


def follows(v: Verdict, evidence: Evidence, query: Query) -> bool:
    """Return True if evidence of this kind proves this relation, by a rule of this kind, over this
    domain, and the query allows it to decide. Over real and positive parameters equality is proven
    by the rule for these; a difference over complex ones is one there too.
    """
    rule, at = RULES[v.decided_by], v.representation
    carrier = {EXACT: Carrier.EXACT, ADMISSIBLE: Carrier.ADMISSIBLE}.get(rule, Carrier.CONDITION)
    if carrier not in evidence.claim.carriers or v.relation is not evidence.shows(v.domain):
        return False
    if rule is ADMISSIBLE:
        return at is Stage.PARAMETERS and v.domain is not Domain.COMPLEX
    proves = v.relation in PROVES[rule.role].values()
    over = v.domain is Domain.COMPLEX or v.relation is Relation.DISTINGUISHABLE
    return at in STAGES[rule.role] and proves and over and at in query.view.representations


def _with_shares(verdict: Verdict, left: AnySide, right: AnySide) -> Verdict:
    """With the positive equivalents of each side whose generic models are models of the other
    side, or limits of them.
    """
    if not left.tells_shares(right):
        return verdict
    left_asked = verdict.closure in (Inclusion.EQUAL, Inclusion.LEFT_IN_RIGHT)
    right_asked = verdict.closure in (Inclusion.EQUAL, Inclusion.RIGHT_IN_LEFT)
    return replace(
        verdict,
        left_positive=said_of(left.positive(right), verdict.image) if left_asked else None,
        right_positive=said_of(right.positive(left), verdict.image) if right_asked else None,
    )


def said_of(share: PositiveFinding, image: Inclusion) -> PositiveFinding | None:
    """Finding on positive equivalents; nothing is open for models that have none with finite
    elements.
    """
    return None if share.share is Share.UNKNOWN and image is Inclusion.NEITHER else share


def with_inclusion(
    verdict: Verdict, equal_rank: bool, finding: Callable[[], Inclusions]
) -> Verdict:
    """The verdict over complex parameters with its inclusion; for unequal rank it is that of the
    finding.
    """
    if verdict.relation is Relation.UNDECIDED:
        return verdict
    if verdict.relation is Relation.INDISTINGUISHABLE:
        return replace(verdict, image=Inclusion.EQUAL, closure=Inclusion.EQUAL)
    if equal_rank:
        return replace(verdict, image=Inclusion.NEITHER, closure=Inclusion.NEITHER)
    both = finding()
    return replace(
        verdict, image=both.image.inclusion, closure=both.closure.inclusion, inclusions=both
    )


def first(left: AnySide, right: AnySide, every: Iterable[Step]) -> Verdict:
    """The verdict over complex parameters of the first step that decides; undecided, it names
    what was abandoned.
    """
    notes: list[str] = []
    for step in every:
        if step.relation is not Relation.UNDECIDED:
            return verdict_of(left, right, step)
        if step.finding.outcome is Outcome.ABANDONED:
            notes.append(f"{_rule(step)} was abandoned: {step.finding.note}")
    return undecided_verdict(left, right, tuple(notes))


def _rule(step: Step) -> str:
    rule = step.finding.rule
    return (
        rule.in_words()
        if rule.role is Role.DECISION
        else f"{rule.in_words()} on {step.representation}"
    )


def audit(left: AnySide, right: AnySide, query: Query) -> Verdict:
    """Run every condition in every representation; raise ContradictionError where two decide
    differently.
    """
    refuse_contradictions(left.name, right.name, steps(left, right, query))
    return decide(left, right, query)


def refuse_contradictions(left: str, right: str, every: Iterable[Step]) -> None:
    """Raise ContradictionError where two steps decide differently."""
    deciding = [step for step in every if step.relation is not Relation.UNDECIDED]
    if len({step.relation for step in deciding}) > 1:
        contradictions = ", ".join(
            f"{s.relation} by {s.finding.rule.in_words()} ({s.representation})" for s in deciding
        )
        raise ContradictionError(f"{left} and {right}: {contradictions}")


def undecided_verdict(
    left: AnySide, right: AnySide, notes: tuple[str, ...], domain: Domain = Domain.COMPLEX
) -> Verdict:
    """The verdict that nothing gives."""
    return Verdict(
        left=left.name,
        right=right.name,
        relation=Relation.UNDECIDED,
        domain=domain,
        notes=notes,
        premises=(left.premise, right.premise),
    )


def verdict_of(
    left: AnySide, right: AnySide, step: Step, domain: Domain = Domain.COMPLEX
) -> Verdict:
    """The verdict that a deciding step gives."""
    f = step.finding
    return Verdict(
        left=left.name,
        right=right.name,
        relation=step.relation,
        decided_by=f.rule.name,
        representation=step.representation,
        certainty=f.certainty,
        safety=f.safety,
        evidence=f.evidence,
        domain=domain,
        notes=notes_of(left, right),
        premises=(left.premise, right.premise),
    )


def _step(
    condition: Necessary | Sufficient | Structural,
    left: AnySide,
    right: AnySide,
    representation: Stage,
    count: int,
) -> Iterator[Step]:
    match condition:
        case Structural() if representation is Stage.STRUCTURE:
            yield Step(representation, condition.check(left, right))
        case Necessary() if representation in SUMMARIES:
            r = Representation(representation)
            n = count if r is Representation.MARKOV else 0
            sides = (
                (left.profile(r, n), right.profile(r, n))
                if condition.of_dependences
                else (left.sketch(r, n), right.sketch(r, n))
            )
            yield Step(representation, condition.check(*sides))
        case Sufficient() if representation in SUMMARIES:
            r = Representation(representation)
            yield Step(
                representation,
                condition.check(left, right, r, count if r is Representation.MARKOV else 0),
            )
