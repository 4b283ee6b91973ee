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
from disting.behaviour.expanded import coefficients_have_rank, rank_is_at_most
from disting.conditions.rule import DEPENDENCES, RANK
from disting.conditions.side import AnySide
from disting.evidence.conditions import Ranks
from disting.general.matrix_model import AnyModel
from disting.general.model_side import ComparedModel
from disting.model.chain import Sensor
from disting.model.structure import Structure
from disting.model.symmetry import canonical
from disting.verdict.chain_side import ComparedChain
from disting.verdict.decisions import Decisions
from disting.verdict.engine import Engine, Progress, silent
from disting.verdict.result import Verdict
from disting.verdict.sides import Given, models_named, sides_of

SECONDS = 10.0  # for one proof
# these invariants of this model have this rank at most
Claim = tuple[Structure | AnyModel, tuple[str, ...], int]


def prove(
    verdict: Verdict,
    left: Given,
    right: Given,
    seconds: float = SECONDS,
    *,
    damped: bool | None = None,
    sensor: Sensor | str | None = None,
) -> Verdict:
    """The verdict with certainty PROVEN if it rests on a rank that can be proven in time, else as
    it is; the models as `compare` takes them. Raises InputError for texts that name no models.

    >>> from disting import Family, compare
    >>> a = Family(3, damped=True)
    >>> compare(a[1], a[7]).certainty.value, prove(compare(a[1], a[7]), a[1], a[7]).certainty.value
    ('bounded', 'proven')
    """
    sides = sides_of(*models_named(left, right, damped, sensor), (), Engine())
    return proven_again(verdict, sides.left, sides.right, seconds)


def proven_again(verdict: Verdict, left: AnySide, right: AnySide, seconds: float) -> Verdict:
    """The same of two models as they are compared."""
    claim = _claim(verdict, left, right)
    holds = claim is not None and _holds(claim, seconds)
    return replace(verdict, certainty=Certainty.PROVEN, safety=0) if holds else verdict


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
    for i, j in combinations(range(len(decided.subjects)), 2):
        if decided.rule(i, j) in (RANK.name, DEPENDENCES.name):
            claim = _claim(decided.verdict(i, j), decided.subjects[i], decided.subjects[j])
            if claim:
                yield (i, j), claim


def _claim(verdict: Verdict, left: AnySide, right: AnySide) -> Claim | None:
    """What is not proven of a bounded verdict by ranks."""
    evidence = verdict.evidence
    if verdict.certainty is not Certainty.BOUNDED or not isinstance(evidence, Ranks):
        return None
    smaller = left if evidence.left < evidence.right else right
    rows = () if evidence.all_rows else evidence.rows
    if isinstance(smaller, ComparedChain):
        # of several experiments, not of these chains
        several = any("[" in row for row in evidence.rows)
        model: Structure | AnyModel = canonical(smaller.chain).chain.structure
    elif isinstance(smaller, ComparedModel):
        # single invariants of several transfer functions, or before G0
        several = any("[" in row or "-" in row for row in rows)
        several = several or bool(smaller.subject.powers.weights)  # exponents were drawn at random
        model = smaller.subject
    else:
        return None
    return None if several else (model, rows, min(evidence.left, evidence.right))


def _holds(claim: Claim, seconds: float) -> bool:
    model, rows, most = claim
    try:
        if isinstance(model, Structure):
            return rank_is_at_most(model, rows, most, seconds)
        entries = [(e.numerator, e.denominator) for e in model.entries]
        return coefficients_have_rank(entries, model.parameters, rows, most, seconds)
    except OutOfTimeError:
        return False
