"""Structural identifiability of fitted candidates: what no data can determine, whatever the
excitation and the noise.

Where a candidate has more free parameters than the Jacobian of its transfer function's
coefficients by these has rank, its sensitivities are dependent for all parameter values: condition
and collinearity index are infinite, and what a computer finds is rounding. Such a candidate is
described by the combinations that data do determine, not by a number. Rank and combinations are
those of `disting.questions.identifiability`, at random points modulo random primes; how many
parameter vectors fit is not asked here, which costs more than the fit.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from math import inf

from disting.experiments.machine_model import rank_by
from disting.fit.search.estimate import Task
from disting.fit.search.joint import JointCost
from disting.fit.search.setup import measured_chain
from disting.model.chain import Chain
from disting.model.presentation import plural
from disting.model.question import Settings
from disting.questions.identifiability.functions import basis
from disting.questions.identifiability.parts import Formula
from disting.questions.identifiability.tangent import proof_tangents
from disting.statistics.practical import Practical

MOST_TERMS = 3  # of a combination that is written out


def with_structure(
    judged: Mapping[Chain, Practical], task: Task, settings: Settings
) -> dict[Chain, Practical]:
    """The criteria of each chain; where data cannot determine it, `unidentifiable` says so and
    indices are infinite.
    """
    return {
        chain: _told_together(chain, assessment, task, settings)
        if isinstance(task.cost, JointCost)
        else _told(chain, assessment, settings)
        for chain, assessment in judged.items()
    }


def _told_together(
    chain: Chain, assessment: Practical, task: Task, settings: Settings
) -> Practical:
    """What the first response determines, all determine; else their stacked Jacobian is asked."""
    common = tuple(name for name in assessment.names if name in chain.parameters)
    proof = proof_tangents(chain.structure, settings.seed, settings.points)
    if max(t.rank_by(common) for t in proof) == len(common):
        return assessment
    measured = measured_chain(chain, task.cost.setups_of(chain.structure))
    labels = (f"joint:{settings.seed}:{k}" for k in range(settings.points))
    rank = max(rank_by(measured, common, label) for label in labels)
    lacking = len(common) - rank
    if lacking <= 0:
        return assessment
    indices = (*assessment.condition_indices[: len(assessment.names) - lacking], *(inf,) * lacking)
    directions = plural(lacking, "combination") + " of its parameters"
    words = f"not identifiable: these responses together leave {directions} open, whatever the data"
    return replace(assessment, condition_indices=indices, collinearity=inf, unidentifiable=words)


def _told(chain: Chain, assessment: Practical, settings: Settings) -> Practical:
    proof = proof_tangents(chain.structure, settings.seed, settings.points)
    rank = max(t.rank_by(assessment.names) for t in proof)
    lacking = len(assessment.names) - rank
    if lacking <= 0:
        return assessment
    chosen = basis(chain.structure, proof, max(t.rank for t in proof), settings.seed).chosen
    indices = assessment.condition_indices[:rank] + (inf,) * lacking
    text = " and what is given" if len(assessment.names) < len(chain.parameters) else ""
    words = in_words([c.formula for c in chosen]) + text
    return replace(assessment, condition_indices=indices, collinearity=inf, unidentifiable=words)


def in_words(determined: Sequence[Formula]) -> str:
    """What is determinable at most; combinations that are long to read are counted.

    >>> from disting.questions.identifiability.parts import monomial
    >>> in_words([monomial(k12=1, d12=-1), monomial(k12=1, m1=-1, m2=-1)])
    'not identifiable: no data determine more than k12/d12, k12/(m1*m2)'
    """
    short = [formula.text for formula in determined if len(formula.terms) <= MOST_TERMS]
    more = len(determined) - len(short)
    counted = [plural(more, "longer combination" if short else "combination")] if more else []
    return (
        "not identifiable: no data determine more than"
        f" {' and '.join(([', '.join(short)] if short else []) + counted)}"
    )
