"""Structures that no data can tell apart: left out before a fit, named after it."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from disting.conditions.subject import Subject
from disting.engine import Engine
from disting.model.chain import Chain
from disting.verdict import Query, Relation, Verdict, View


@dataclass(frozen=True)
class Alternative:
    """A structure whose behaviour is the same as (`relation` indistinguishable), or may be (undecided); why in a sentence."""

    chain: Chain
    relation: Relation
    sentence: str


def representatives(candidates: Sequence[Chain], engine: Engine) -> dict[Chain, Chain]:
    """For each candidate the first one that is indistinguishable from it, itself if none is.

    Conditions 1-9 are asked; what they leave open is fitted separately, which costs time but decides nothing wrongly.
    """
    first: dict[Chain, Chain] = {}
    for same_size in _by_size(candidates):
        decided = engine.decisions([engine.subject(str(c), c) for c in same_size], Query(View.COMBINED))
        for j, chain in enumerate(same_size):
            equal = (first[same_size[i]] for i in range(j) if decided.relation(i, j) is Relation.INDISTINGUISHABLE)
            first[chain] = next(equal, chain)
    return first


def alternatives(winner: Chain, family: Iterable[Chain], engine: Engine) -> tuple[Alternative, ...]:
    """The members of a family that are indistinguishable from the winner, and those of which it is not known."""
    found = []
    subject = engine.subject(str(winner), winner)
    for chain in family:
        if chain != winner and chain.n_masses == winner.n_masses:
            verdict = _verdict(subject, engine.subject(str(chain), chain), engine)
            if verdict.relation is not Relation.DISTINGUISHABLE:
                found.append(Alternative(chain, verdict.relation, verdict.sentence))
    return tuple(found)


def _verdict(winner: Subject, other: Subject, engine: Engine) -> Verdict:
    """By the conditions, and only where they are silent by the exact decision: inclusions are not asked for."""
    by_conditions = engine.verdict(winner, other, Query(View.COMBINED))
    return by_conditions if by_conditions.relation is not Relation.UNDECIDED else engine.verdict(winner, other, Query())


def _by_size(candidates: Sequence[Chain]) -> list[list[Chain]]:
    sizes = sorted({c.n_masses for c in candidates})
    return [[c for c in candidates if c.n_masses == n] for n in sizes]
