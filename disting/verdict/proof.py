"""Raises bounded verdicts to proven ones where exact elimination ends in time.

A verdict by condition 4 or 5 says that a set of invariants has rank k in one model and more in the
other. The larger rank is proven already (a minor that is not zero somewhere is not zero); that the
smaller one is k at most is proven by elimination over the polynomials.
"""

from collections.abc import Iterator
from dataclasses import replace
from itertools import combinations

from disting.algebra.certainty import Certainty
from disting.algebra.fractionfree import OutOfTimeError
from disting.behaviour.expanded import rank_is_at_most
from disting.conditions.rule import DEPENDENCES, RANK
from disting.evidence.conditions import Ranks
from disting.model.chain import Chain, Sensor
from disting.model.names import chains_named
from disting.model.structure import Structure
from disting.model.symmetry import canonical
from disting.verdict.decisions import Decisions
from disting.verdict.engine import Progress, silent
from disting.verdict.result import Verdict

SECONDS = 10.0  # for one proof
# these invariants of this structure have this rank at most
Claim = tuple[Structure, tuple[str, ...], int]


def prove(
    verdict: Verdict,
    left: Chain | str,
    right: Chain | str,
    seconds: float = SECONDS,
    *,
    damped: bool | None = None,
    sensor: Sensor | str | None = None,
) -> Verdict:
    """The verdict with certainty PROVEN if it rests on a rank that can be proven in time, else as
    it is; the chains as `compare` takes them.

    >>> from disting import Family, compare
    >>> a = Family(3, damped=True)
    >>> compare(a[1], a[7]).certainty.value, prove(compare(a[1], a[7]), a[1], a[7]).certainty.value
    ('bounded', 'proven')
    """
    claim = _claim(verdict, *chains_named([left, right], damped=damped, sensor=sensor))
    return (
        replace(verdict, certainty=Certainty.PROVEN, safety=0)
        if claim and _holds(claim, seconds)
        else verdict
    )


def prove_all(
    decided: Decisions, seconds: float = SECONDS, progress: Progress = silent
) -> Decisions:
    """The decisions, with those marked that can be proven in time; each claim is looked at once."""
    claims = dict(_claims(decided))
    different = list(dict.fromkeys(claims.values()))
    holds: dict[Claim, bool] = {}
    for done, claim in enumerate(different, 1):
        holds[claim] = _holds(claim, seconds)
        progress("proofs", done, len(different))
    return replace(
        decided, proven=frozenset(pair for pair, claim in claims.items() if holds[claim])
    )


def _claims(decided: Decisions) -> Iterator[tuple[tuple[int, int], Claim]]:
    for i, j in combinations(range(len(decided.chains)), 2):
        if decided.rule(i, j) in (RANK.name, DEPENDENCES.name):
            claim = _claim(decided.verdict(i, j), decided.chains[i], decided.chains[j])
            if claim:
                yield (i, j), claim


def _claim(verdict: Verdict, left: Chain, right: Chain) -> Claim | None:
    """What is not proven of a bounded verdict by ranks."""
    evidence = verdict.evidence
    if verdict.certainty is not Certainty.BOUNDED or not isinstance(evidence, Ranks):
        return None
    if any("[" in row for row in evidence.rows):  # of several experiments, not of these chains
        return None
    smaller = left if evidence.left < evidence.right else right
    rows = () if evidence.all_rows else evidence.rows
    return canonical(smaller).chain.structure, rows, min(evidence.left, evidence.right)


def _holds(claim: Claim, seconds: float) -> bool:
    try:
        return rank_is_at_most(*claim, seconds)
    except OutOfTimeError:
        return False
