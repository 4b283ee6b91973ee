"""Structures that no data can tell apart: left out before a fit, named after it.

The candidates of Fig. 1 have their verdicts shipped (`catalogs.candidates`): those are looked up, only others are computed.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

from disting.catalogs import candidates as stored
from disting.conditions.subject import Subject
from disting.engine import Engine
from disting.errors import CatalogError
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

    Of candidates that are not shipped conditions 1-9 are asked; what they leave open is fitted separately, which costs time but
    decides nothing wrongly.
    """
    first: dict[Chain, Chain] = {}
    for same_size in _by_size(candidates):
        relation = _relation(same_size, engine)
        for j, chain in enumerate(same_size):
            equal = (first[same_size[i]] for i in range(j) if relation(i, j) is Relation.INDISTINGUISHABLE)
            first[chain] = next(equal, chain)
    return first


def alternatives(winner: Chain, family: Iterable[Chain], engine: Engine) -> tuple[Alternative, ...]:
    """The members of a family that are indistinguishable from the winner, and those of which it is not known."""
    found = []
    subject = engine.subject(str(winner), winner)
    for chain in family:
        if chain != winner and chain.n_masses == winner.n_masses and not _surely_apart(winner, chain):
            verdict = _verdict(subject, engine.subject(str(chain), chain), engine)
            if verdict.relation is not Relation.DISTINGUISHABLE:
                found.append(Alternative(chain, verdict.relation, verdict.sentence))
    return tuple(found)


def _relation(chains: Sequence[Chain], engine: Engine) -> Callable[[int, int], Relation]:
    """Relation by two places: looked up where all chains are shipped, else by the conditions."""
    known = _shipped()
    if known is not None and len({c.sensor for c in chains}) == 1 and all(c in known for c in chains):
        return lambda i, j: known.relation(chains[i], chains[j])
    return engine.decisions([engine.subject(str(c), c) for c in chains], Query(View.COMBINED)).relation


def _surely_apart(winner: Chain, other: Chain) -> bool:
    """Whether the shipped verdict says so."""
    known = _shipped()
    if known is None or winner not in known or other not in known or winner.sensor is not other.sensor:
        return False
    return known.relation(winner, other) is Relation.DISTINGUISHABLE


def _shipped() -> stored.Matrix | None:
    """The shipped verdicts; a missing or damaged file costs time only."""
    try:
        return stored.shipped()
    except CatalogError:
        return None


def _verdict(winner: Subject, other: Subject, engine: Engine) -> Verdict:
    """By the conditions, and only where they are silent by the exact decision: inclusions are not asked for."""
    by_conditions = engine.verdict(winner, other, Query(View.COMBINED))
    if by_conditions.relation is not Relation.UNDECIDED:
        return by_conditions
    return engine.verdict(winner, other, Query(View.EXACT, inclusion=False))


def _by_size(candidates: Sequence[Chain]) -> list[list[Chain]]:
    sizes = sorted({c.n_masses for c in candidates})
    return [[c for c in candidates if c.n_masses == n] for n in sizes]
