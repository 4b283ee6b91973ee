"""All pairs of a list of models, decided by buckets: models whose profiles agree in a property
share its bucket.

A necessary condition decides every pair of models in different buckets at once, by one comparison
of two columns of numbers; only pairs that share all buckets are compared one by one.
"""

from collections.abc import Callable, Hashable, Sequence
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from disting.behaviour.profile import NoMatroid, Profile
from disting.behaviour.sample import Representation
from disting.conditions.inclusion import Inclusion, Sense
from disting.conditions.rule import Rule, Stage
from disting.conditions.side import AnySide, Ask
from disting.conditions.table import NECESSARY, STRUCTURAL, SUFFICIENT
from disting.model.question import Domain
from disting.questions.same.real_and_positive import resting_on
from disting.verdict.cascade import said_of
from disting.verdict.decisions import NUMBERS, STAGES, Decisions, markov_count
from disting.verdict.result import Query, Relation, Step

Where = NDArray[np.bool_] | tuple[np.intp, np.intp]  # pairs, as a mask or as one position
Prefetch = Callable[[Sequence[AnySide], Representation, int], None]


def decisions(
    subjects: Sequence[AnySide],
    query: Query,
    prefetch: Prefetch,
    ask: Ask,
    apart: Sequence[int] = (),
) -> Decisions:
    """Decide all pairs of models, of any sizes, but for those of two models in the places `apart`;
    the two callbacks compute what will be needed.
    """
    n = len(subjects)
    result = Decisions(
        tuple(subjects), query, np.zeros((n, n), np.uint8), np.zeros((n, n), np.uint8)
    )
    open_pairs = np.triu(np.ones((n, n), bool), 1)
    open_pairs[np.ix_(apart, apart)] = False
    for stage in query.view.representations:
        if stage is Stage.STRUCTURE:
            _structural(result, open_pairs)
            continue
        if stage is Stage.FIBRE:
            if open_pairs.any():
                subjects[0].prepare_exact(_pairs(result, open_pairs), ask)
            _each(result, open_pairs, Stage.FIBRE, lambda a, b: a.exact(b))
            continue
        r = Representation(stage)
        open_ones = open_pairs & _are_asked(stage, subjects)
        active = np.flatnonzero(open_ones.any(axis=0) | open_ones.any(axis=1))
        prefetch([subjects[int(i)] for i in active], r, markov_count(r, query, subjects))
        before = open_ones.copy()
        _necessary(result, open_ones, r, active)
        _sufficient(result, open_ones, r)
        open_pairs &= open_ones | ~before
    if query.tells_inclusion:
        _inclusions(result, ask)
        _positive(result, ask)
    if query.view.domain is not Domain.COMPLEX:
        _admissible(result, ask)
    return result


def _are_asked(stage: Stage, subjects: Sequence[AnySide]) -> NDArray[np.bool_]:
    """The pairs that have such a summary: Markov parameters are those of functions of s."""
    flags = np.array([stage is Stage.TF or s.in_s for s in subjects], bool)
    return np.asarray(flags[:, None] & flags[None, :])


def _pairs(result: Decisions, where: NDArray[np.bool_]) -> list[tuple[AnySide, AnySide]]:
    return [
        (result.subjects[int(i)], result.subjects[int(j)])
        for i, j in zip(*np.nonzero(where), strict=True)
    ]


def _inclusions(result: Decisions, ask: Ask) -> None:
    """Decide the inclusions of all pairs of unequal rank at once."""
    subjects = result.subjects
    pairs = [
        (i, j)
        for i, j in combinations(range(len(subjects)), 2)
        if subjects[i].rank != subjects[j].rank
    ]
    if pairs:
        chosen = [(subjects[i], subjects[j]) for i, j in pairs]
        findings = subjects[0].all_inclusions(chosen, ask)
        result.inclusions.update(zip(pairs, findings, strict=True))


def _positive(result: Decisions, ask: Ask) -> None:
    """Decide the shares of positive models with positive equivalents, wherever generic ones have
    equivalents; all at once.
    """
    n, subjects = len(result.subjects), result.subjects
    ways = [(i, j) for i in range(n) for j in range(n) if i != j and _is_asked(result, i, j)]
    if ways:
        subjects[0].prepare_positive([(subjects[i], subjects[j]) for i, j in ways], ask)
    for i, j in ways:
        image = result.inclusion(min(i, j), max(i, j), Sense.IMAGE)
        share = said_of(subjects[i].positive(subjects[j]), image)
        if share is not None:
            result.shares[i, j] = share


def _is_asked(result: Decisions, i: int, j: int) -> bool:
    """Return True if generic models i may have equivalents j: whether they are such models, or
    limits of them, and the question can be decided.
    """
    if not result.subjects[i].tells_shares(result.subjects[j]):
        return False
    inside = Inclusion.LEFT_IN_RIGHT if i < j else Inclusion.RIGHT_IN_LEFT
    return result.inclusion(min(i, j), max(i, j), Sense.CLOSURE) in (Inclusion.EQUAL, inside)


def _admissible(result: Decisions, ask: Ask) -> None:
    """Ask again about the pairs that are indistinguishable over complex parameters."""
    domain, n = result.query.view.domain, len(result.subjects)
    same = np.zeros((n, n), bool)
    for i, j in combinations(range(n), 2):
        same[i, j] = result.relation(i, j) is Relation.INDISTINGUISHABLE
    if same.any():
        result.subjects[0].prepare_admissible(_pairs(result, same), domain, ask)
    for i, j in zip(*np.nonzero(same), strict=True):
        equal = result.equal[int(i), int(j)] = result.steps.pop((int(i), int(j))).finding
        left, right = result.subjects[i], result.subjects[j]
        finding = left.admissible(right, domain, equal.evidence)
        step = Step(
            Stage.PARAMETERS, resting_on(finding, (equal.certainty, equal.safety), equal.evidence)
        )
        settled = step.relation is not Relation.UNDECIDED
        if settled:
            result.steps[int(i), int(j)] = step
        result.decided_by[i, j] = NUMBERS[step.finding.rule.name] if settled else 0
        result.representation[i, j] = STAGES.index(Stage.PARAMETERS if settled else Stage.NONE)


def _necessary(
    result: Decisions, open_pairs: NDArray[np.bool_], r: Representation, active: NDArray[np.intp]
) -> None:
    count = markov_count(r, result.query, result.subjects)
    profiles = {int(i): result.subjects[i].profile(r, count) for i in active}
    for condition in NECESSARY:
        if result.query.asks(condition.rule):
            buckets = _buckets(profiles, condition.key, len(result.subjects))
            is_known = buckets >= 0
            differ = (
                (buckets[:, None] != buckets[None, :])
                & is_known[:, None]
                & is_known[None, :]
                & open_pairs
            )
            _settle(result, open_pairs, differ, condition.rule, Stage(r))


def _buckets(
    profiles: dict[int, Profile], key: Callable[[Profile], Hashable], n: int
) -> NDArray[np.int64]:
    """Number of each model's bucket; -1 where the property is not known."""
    numbers: dict[Hashable, int] = {}
    buckets = np.full(n, -1, np.int64)
    for i, profile in profiles.items():
        value = key(profile)
        if not isinstance(value, NoMatroid):
            buckets[i] = numbers.setdefault(value, len(numbers))
    return buckets


def _sufficient(result: Decisions, open_pairs: NDArray[np.bool_], r: Representation) -> None:
    count = markov_count(r, result.query, result.subjects)
    for condition in SUFFICIENT:
        if result.query.asks(condition.rule):
            _each(result, open_pairs, Stage(r), lambda a, b, c=condition: c.check(a, b, r, count))


def _structural(result: Decisions, open_pairs: NDArray[np.bool_]) -> None:
    for condition in STRUCTURAL:
        if result.query.asks(condition.rule):
            _each(result, open_pairs, Stage.STRUCTURE, condition.check)


def _each(
    result: Decisions,
    open_pairs: NDArray[np.bool_],
    stage: Stage,
    check: Callable[..., object],
) -> None:
    for i, j in zip(*np.nonzero(open_pairs), strict=True):
        step = Step(stage, check(result.subjects[i], result.subjects[j]))  # type: ignore[arg-type]
        if step.relation is not Relation.UNDECIDED:
            result.steps[int(i), int(j)] = step
            _settle(result, open_pairs, (i, j), step.finding.rule, stage)


def _settle(
    result: Decisions, open_pairs: NDArray[np.bool_], pairs: Where, rule: Rule, stage: Stage
) -> None:
    result.decided_by[pairs] = NUMBERS[rule.name]
    result.representation[pairs] = STAGES.index(stage)
    open_pairs[pairs] = False
