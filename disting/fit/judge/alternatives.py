"""Structures that no data can distinguish: omitted before a fit, named after it.

A fit looks at positive parameters, some of them given (`fixed`) or kept in a range (`bounds`). So
one candidate may represent another only if every positive model of either has a positive equivalent
in the other, within the given ranges:

- where neither has a parameter that is given or bounded, both shares of positive equivalents are
  "always" (see `questions.positive`);
- where one has, a renaming of parameters by symmetry turns the one into the other and takes each
  range into that of the parameter that it becomes, both ways. A dead time and a lag that both have
  are renamed to themselves.

Anything else is fitted separately, which costs time but decides nothing wrongly.

Chains with a damper across the gap are none of the class of the paper: they are compared as
networks, where both have a lag or neither, and a dead time or neither. Lag and dead time are
factors of the response; a dead time is identified separately.

The candidates of Fig. 1 have their verdicts shipped (`catalogs.candidates`): those are looked up,
all others are computed.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from math import inf
from typing import TYPE_CHECKING

from disting.catalogs import candidates as stored
from disting.errors import CatalogError
from disting.model.chain import Chain
from disting.model.presentation import summary
from disting.network.chains import of_chain
from disting.verdict.engine import Engine
from disting.verdict.result import Query, Relation, View

if TYPE_CHECKING:  # a side is made by the engine, where a verdict is not shipped
    from disting.verdict.chain_side import ComparedChain

Limits = Mapping[str, tuple[float, float]]
"""Range of each parameter that is given (one value) or bounded, by name."""


@dataclass(frozen=True)
class Alternative:
    """A structure that behaves the same (`relation` indistinguishable, over positive parameters
    within the limits of the fit), does so for some of them (sometimes), or may do so (undecided);
    why in a sentence.
    """

    chain: Chain
    relation: Relation
    sentence: str

    def __repr__(self) -> str:
        return summary(self, str(self.chain))


def limits_of(bounds: Mapping[str, tuple[float, float]], fixed: Mapping[str, float]) -> Limits:
    """Ranges that cut something off the positive numbers.

    >>> limits_of({"k12": (0.0, float("inf")), "m2": (1.0, 2.0)}, {"m1": 3.0})
    {'m2': (1.0, 2.0), 'm1': (3.0, 3.0)}
    """
    cutting = {name: pair for name, pair in bounds.items() if pair != (0.0, inf)}
    return cutting | {name: (value, value) for name, value in fixed.items()}


def representatives(
    candidates: Sequence[Chain], engine: Engine, limits: Limits
) -> dict[Chain, Chain]:
    """For each candidate the first one that has the same positive models within the limits,
    itself if none has.
    """
    first: dict[Chain, Chain] = {}
    for same_size in _by_size(candidates):
        listed = [c for c in same_size if not c.gap_damper]
        relation = _relation(listed, engine)
        for j, chain in enumerate(listed):
            equal = (listed[i] for i in range(j) if relation(i, j) is Relation.INDISTINGUISHABLE)
            first[chain] = next(
                (first[c] for c in equal if stands_for(c, chain, engine, limits)), chain
            )
        for chain in (c for c in same_size if c.gap_damper):
            earlier = [c for c in same_size[: same_size.index(chain)] if first.get(c) == c]
            first[chain] = next((c for c in earlier if stands_for(c, chain, engine, limits)), chain)
    return first


def stands_for(chain: Chain, other: Chain, engine: Engine, limits: Limits) -> bool:
    """Return True if two chains are known to have the same models with positive parameters within
    the limits.
    """
    if chain.gap_damper or other.gap_damper:
        same = across_gap(chain, other, engine, limits)
        return same is not None and same.relation is Relation.INDISTINGUISHABLE
    if set(limits) & {*chain.parameters, *other.parameters}:
        # most fits neither bound nor give a parameter
        from disting.questions.positive import renamings

        return all(
            any(is_within(r, limits) for r in renamings(*pair))
            for pair in ((chain, other), (other, chain))
        )
    own_side, other_side = (engine.subject(str(c), c) for c in (chain, other))
    return own_side.has_same_positive(other_side)


def alternatives(
    winner: Chain, family: Iterable[Chain], engine: Engine, limits: Limits
) -> tuple[Alternative, ...]:
    """The members of a family, of the winner's size, that have the same positive models, or
    some of them, or may have.
    """
    others = [
        c
        for c in family
        if c != winner and c.n_masses == winner.n_masses and not _surely_apart(winner, c)
    ]
    if not others:
        return ()
    the_alternatives = (_as_either(winner, chain, engine, limits) for chain in others)
    return tuple(a for a in the_alternatives if a is not None)


def across_gap(chain: Chain, other: Chain, engine: Engine, limits: Limits) -> Alternative | None:
    """Alternative that another structure is if one of both has a damper across the gap; None where
    both are distinguishable.
    """
    if chain.dead_time != other.dead_time:
        return None
    if chain.lag != other.lag:
        return None if chain.collocated and other.collocated else _open(other, "One has a lag.")
    plain = [of_chain(replace(c, lag=False, dead_time=False)) for c in (chain, other)]
    mine, theirs = engine.general_subjects(plain, [str(chain), str(other)])
    verdict = engine.verdict(mine, theirs, Query(View.POSITIVE, inclusion=False))
    if verdict.relation is Relation.DISTINGUISHABLE:
        return None
    if set(limits) & {*chain.parameters, *other.parameters}:
        return _open(other, verdict.sentence)
    return Alternative(other, verdict.relation, verdict.sentence)


def _open(other: Chain, why: str) -> Alternative:
    return Alternative(other, Relation.UNDECIDED, f"{why} Whether all models are the same is open.")


def _as_either(winner: Chain, other: Chain, engine: Engine, limits: Limits) -> Alternative | None:
    if winner.gap_damper or other.gap_damper:
        return across_gap(winner, other, engine, limits)
    mine, theirs = (engine.subject(str(c), c) for c in (winner, other))
    return _alternative(mine, theirs, engine, limits)


def _alternative(
    winner: "ComparedChain", other: "ComparedChain", engine: Engine, limits: Limits
) -> Alternative | None:
    """By the conditions, and only where they do not decide by the exact decision; inclusions are
    not decided.
    """
    if engine.verdict(winner, other, Query(View.COMBINED)).relation is Relation.DISTINGUISHABLE:
        return None
    verdict = engine.verdict(winner, other, Query(View.POSITIVE, inclusion=False))
    if verdict.relation is Relation.DISTINGUISHABLE:
        return None
    if verdict.relation is not Relation.INDISTINGUISHABLE or stands_for(
        winner.chain, other.chain, engine, limits
    ):
        return Alternative(other.chain, verdict.relation, verdict.sentence)
    names = [n for n in limits if n in {*winner.chain.parameters, *other.chain.parameters}]
    cut = (
        f"{verdict.sentence} Here {', '.join(names)} may not take every value, so whether they do"
        " within the limits is open."
    )
    return Alternative(other.chain, Relation.UNDECIDED, cut)


def is_within(renaming: Mapping[str, str], limits: Limits) -> bool:
    """Return True if the renaming maps every range into that of the parameter's new name."""
    anything = (0.0, inf)
    pairs = [
        (limits.get(name, anything), limits.get(image, anything))
        for name, image in renaming.items()
    ]
    return all(
        other_interval[0] <= own_interval[0] and own_interval[1] <= other_interval[1]
        for own_interval, other_interval in pairs
    )


def _relation(chains: Sequence[Chain], engine: Engine) -> Callable[[int, int], Relation]:
    """Relation over complex parameters by two places: looked up where all chains are shipped,
    else by the conditions.
    """
    matrix = _load_shipped()
    if (
        matrix is not None
        and len({c.sensor for c in chains}) == 1
        and all(c in matrix for c in chains)
    ):
        return lambda i, j: matrix.relation(chains[i], chains[j])
    return engine.decisions(
        [engine.subject(str(c), c) for c in chains], Query(View.COMBINED)
    ).relation


def _surely_apart(winner: Chain, other: Chain) -> bool:
    """Return True if the shipped verdict states that they are distinguishable."""
    matrix = _load_shipped()
    if (
        matrix is None
        or winner not in matrix
        or other not in matrix
        or winner.sensor is not other.sensor
    ):
        return False
    return matrix.relation(winner, other) is Relation.DISTINGUISHABLE


def _load_shipped() -> stored.Matrix | None:
    """The shipped verdicts; a missing or damaged file costs time only."""
    try:
        return stored.shipped_matrix()
    except CatalogError:
        return None


def _by_size(candidates: Sequence[Chain]) -> list[list[Chain]]:
    sizes = sorted({c.n_masses for c in candidates})
    return [[c for c in candidates if c.n_masses == n] for n in sizes]
