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

from disting.algebra.quotient import matrix
from disting.algebra.sampling import prime, residues
from disting.behaviour.sample import Representation
from disting.experiments.stacked_profiles import drawn_at, seen_at
from disting.fit.estimate import Task
from disting.fit.joint import JointCost
from disting.fit.practical import Practical
from disting.fit.setup import Setup, measured_chain
from disting.model.chain import Chain
from disting.model.settings import Settings
from disting.questions.identifiability.basis import basis
from disting.questions.identifiability.formula import Formula
from disting.questions.identifiability.tangent import Tangent, proof_tangents

MOST_TERMS = 3  # of a combination that is written out


def with_structure(
    judged: Mapping[Chain, Practical], task: Task, settings: Settings
) -> dict[Chain, Practical]:
    """The criteria of each chain; where data cannot determine it, `unidentifiable` says so and
    indices are infinite.
    """
    return {
        chain: _told_together(chain, found, task, settings)
        if isinstance(task.cost, JointCost)
        else _told(chain, found, settings)
        for chain, found in judged.items()
    }


def _told_together(chain: Chain, found: Practical, task: Task, settings: Settings) -> Practical:
    """What the first response determines, all determine; else their stacked Jacobian is asked."""
    common = tuple(name for name in found.names if name in chain.parameters)
    proof = proof_tangents(chain.structure, settings.seed, settings.points)
    if max(_rank(t, common) for t in proof) == len(common):
        return found
    rank = max(
        stacked_rank(chain, task.cost.setups, common, f"joint:{settings.seed}:{k}")
        for k in range(settings.points)
    )
    lacking = len(common) - rank
    if lacking <= 0:
        return found
    indices = (*found.condition_indices[: len(found.names) - lacking], *(inf,) * lacking)
    directions = f"{lacking} combination{'s' * (lacking > 1)} of its parameters"
    words = f"not identifiable: these responses together leave {directions} open, whatever the data"
    return replace(found, condition_indices=indices, collinearity=inf, unidentifiable=words)


def stacked_rank(chain: Chain, setups: Sequence[Setup], free: Sequence[str], label: str) -> int:
    """Rank of the Jacobian of the coefficients of all responses by the free parameters, at a random
    point modulo a random prime: never above that at generic parameters.
    """
    modulus = prime(label)
    point = residues(f"{label}:point", len(chain.parameters), modulus)
    seen = seen_at(drawn_at(measured_chain(chain, setups), point, modulus), Representation.TF, 0)
    at = [chain.parameters.index(name) for name in free]
    rows = [[row[i] for i in at] for row in seen.rows]
    return int(matrix(rows, len(at), modulus).rank())


def _told(chain: Chain, found: Practical, settings: Settings) -> Practical:
    proof = proof_tangents(chain.structure, settings.seed, settings.points)
    rank = max(_rank(t, found.names) for t in proof)
    lacking = len(found.names) - rank
    if lacking <= 0:
        return found
    chosen = basis(chain.structure, proof, max(t.rank for t in proof), settings.seed).chosen
    indices = found.condition_indices[:rank] + (inf,) * lacking
    given = " and what is given" * (len(found.names) < len(chain.parameters))
    words = in_words([c.formula for c in chosen]) + given
    return replace(found, condition_indices=indices, collinearity=inf, unidentifiable=words)


def _rank(at: Tangent, free: Sequence[str]) -> int:
    """Rank of the columns of the free parameters: those that are given are known."""
    columns = [i for i, name in enumerate(at.values) if name in free]
    rows = [[row[i] for i in columns] for row in at.rows]
    return int(matrix(rows, len(columns), at.modulus).rank()) if columns else 0


def in_words(determined: Sequence[Formula]) -> str:
    """What is determinable at most; combinations that are long to read are counted.

    >>> from disting.questions.identifiability.formula import monomial
    >>> in_words([monomial(k12=1, d12=-1), monomial(k12=1, m1=-1, m2=-1)])
    'not identifiable: no data determine more than k12/d12, k12/(m1*m2)'
    """
    short = [formula.text for formula in determined if len(formula.terms) <= MOST_TERMS]
    more = len(determined) - len(short)
    counted = [f"{more} {'longer ' * bool(short)}combination{'s' * (more > 1)}"] * bool(more)
    return (
        "not identifiable: no data determine more than"
        f" {' and '.join([', '.join(short)] * bool(short) + counted)}"
    )
