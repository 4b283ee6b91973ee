"""Identifiability of one chain over a domain of parameters, from its finding over complex ones.

Theorems give vectors that are positive for all positive parameters: renamings by symmetry, the dual
chain, Foster's networks. What else was listed at the random point is positive, real or complex
there, and perhaps only there.
"""

from collections.abc import Collection
from dataclasses import replace

from disting.algebra.certainty import Certainty, Grade, weakest
from disting.model.question import Answer, Domain
from disting.questions.identifiability.answer import Identifiability
from disting.questions.identifiability.domains import OverDomains, Solutions, over
from disting.questions.identifiability.parts import Combination, Level, Renaming

ANSWERS = {
    Level.GLOBAL: Answer.YES,
    Level.EXCHANGES: Answer.NO,
    Level.LOCAL: Answer.NO,
    Level.UNKNOWN: Answer.UNKNOWN,
}


def is_settled(found: Identifiability) -> bool:
    """Return True if theorems alone give the solutions over each domain: one, or all of them
    positive.
    """
    if found.level is Level.NOT:
        return all(c.unique is Answer.YES for c in found.singles)
    return found.level is Level.GLOBAL or _is_by_theorem(found)


def _is_by_theorem(found: Identifiability) -> bool:
    """Return True if all vectors exist by theorems, which make them positive."""
    theorems = all(a.certainty is Certainty.THEOREM for a in found.alternatives)
    return theorems and found.least == found.most


def find_chain_over_domain(
    found: Identifiability, solutions: OverDomains | None, domain: Domain
) -> Identifiability:
    """The finding over complex parameters, and the solutions over a domain if they were searched,
    as one finding.
    """
    plain, merged = (
        _merge(found, None if solutions is None else over(solutions, of), of)
        for of in (Domain.COMPLEX, domain)
    )
    if domain is Domain.COMPLEX:
        return plain
    bounds = (plain.least, plain.most) if not plain.freedom else (merged.least, merged.most)
    same = (merged.levels, merged.least, merged.most) == (plain.levels, *bounds)
    return replace(merged, over_complex=None if same else plain)


def _merge(found: Identifiability, solutions: Solutions | None, domain: Domain) -> Identifiability:
    order = solutions.order if solutions else 1 + len(found.renamings)
    least, most, grade = _bounds(found, solutions, domain)
    sampled, varies = _sample_counts(found, solutions, domain)
    is_full = found.level is not Level.NOT
    exchanged = is_full and most == order
    answers = _answers(found, solutions, domain)
    if exchanged:
        moved = {a for r in _exchanges(found, solutions) for a, _ in r.moved}
        answers = {c.text: Answer.NO if c.text in moved else Answer.YES for c in found.singles}
    is_open = least != most
    level = found.level if not is_full else _level(order, most, exchanged, answers.values())
    return replace(
        found,
        level=level,
        level_grade=grade if is_full else found.level_grade,
        least=least,
        most=most,
        count_grade=grade,
        singles=tuple(_with(c, answers, most, domain) for c in found.singles),
        basis=tuple(_with(c, answers, most, domain) for c in found.basis),
        domain=domain,
        sampled=sampled if is_open and is_full else (),
        varies=varies and is_open and is_full,
        exchanges=_exchanges(found, solutions),
    )


def _exchanges(found: Identifiability, solutions: Solutions | None) -> tuple[Renaming, ...]:
    return solutions.exchanges if solutions else found.renamings


def _bounds(
    found: Identifiability, solutions: Solutions | None, domain: Domain
) -> tuple[int, int | None, Grade]:
    """Of the number of vectors, with the grade of both."""
    by_theorem = sum(a.certainty is Certainty.THEOREM for a in found.alternatives)
    least = found.least if domain is Domain.COMPLEX or _is_by_theorem(found) else by_theorem
    is_sure = found.count_grade[0] is not Certainty.NUMERICAL
    most = found.most if is_sure or (domain is Domain.COMPLEX and not solutions) else None
    grade = found.count_grade if most is not None else (Certainty.THEOREM, 0)
    if solutions is None:
        return least, most, grade
    least = max(least, solutions.least)
    if solutions.most is not None and (most is None or solutions.most <= most):
        most, grade = solutions.most, solutions.grade
    return (most if most == solutions.order else least), most, weakest(grade, solutions.grade)


def _sample_counts(
    found: Identifiability, solutions: Solutions | None, domain: Domain
) -> tuple[tuple[int, ...], bool]:
    """The numbers of vectors at random values: those of the list, if it is complete, come last."""
    if solutions and solutions.sampled:
        return solutions.sampled, solutions.varies
    if found.most is None or len(found.alternatives) != found.most:
        return (), False
    numbers = {
        Domain.COMPLEX: len(found.alternatives),
        Domain.REAL: found.real,
        Domain.POSITIVE: found.positive,
    }
    return (numbers[domain],), False


def _answers(
    found: Identifiability, solutions: Solutions | None, domain: Domain
) -> dict[str, Answer]:
    """By parameter: whether it has one value over the domain."""
    answers = dict[str, Answer]()
    for c in found.singles:
        level = solutions.levels.get(c.text, Level.UNKNOWN) if solutions else Level.UNKNOWN
        keeps = domain is Domain.COMPLEX or c.unique is Answer.YES
        if (keeps and c.unique is not Answer.UNKNOWN) or c.certainty is Certainty.THEOREM:
            answers[c.text] = c.unique
        else:
            answers[c.text] = ANSWERS[level]
    return answers


def _level(order: int, most: int | None, exchanged: bool, answers: Collection[Answer]) -> Level:
    if most == 1:
        return Level.GLOBAL
    if exchanged and order > 1:
        return Level.EXCHANGES
    if Answer.UNKNOWN in answers:
        return Level.UNKNOWN
    return Level.LOCAL if Answer.NO in answers else Level.GLOBAL


def _with(
    c: Combination, answers: dict[str, Answer], most: int | None, domain: Domain
) -> Combination:
    """A combination as it is over the domain: several complex values may be one in it."""
    if c.text in answers:
        return replace(c, unique=answers[c.text])
    if most == 1:
        return replace(c, unique=Answer.YES)
    is_open = c.unique is Answer.NO and c.certainty is not Certainty.THEOREM
    return replace(c, unique=Answer.UNKNOWN) if is_open and domain is not Domain.COMPLEX else c
