"""Structural identifiability of fitted candidates: what no data can determine, whatever the excitation and the noise.

Where a candidate has more free parameters than the coefficients of its transfer function have rank, its sensitivities are
dependent for all parameter values: condition and collinearity index are infinite, and what a computer finds is rounding. Such a
candidate is described by the combinations that data do determine, not by a number. Rank and combinations are those of
`disting.identifiability`, at random points modulo random primes; how many parameter vectors fit is not asked here, which costs
more than the fit.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from math import inf

from disting.fit.practical import Practical
from disting.identifiability.basis import basis
from disting.identifiability.formula import Formula
from disting.identifiability.tangent import proof_tangents
from disting.model.chain import Chain
from disting.settings import Settings

MOST_TERMS = 3  # of a combination that is written out


def with_structure(judged: Mapping[Chain, Practical], settings: Settings) -> dict[Chain, Practical]:
    """The criteria of each chain; where data cannot determine it, `unidentifiable` says so and indices are infinite."""
    return {chain: _told(chain, found, settings) for chain, found in judged.items()}


def _told(chain: Chain, found: Practical, settings: Settings) -> Practical:
    proof = proof_tangents(chain.structure, settings.seed, settings.points)
    rank = max(t.rank for t in proof)
    lacking = len(found.names) - rank
    if lacking <= 0:
        return found
    chosen = basis(chain.structure, proof, rank, settings.seed).chosen
    indices = found.condition_indices[:rank] + (inf,) * lacking
    return replace(found, condition_indices=indices, collinearity=inf, unidentifiable=in_words([c.formula for c in chosen]))


def in_words(determined: Sequence[Formula]) -> str:
    """What is determinable at most; combinations that are long to read are counted.

    >>> from disting.identifiability.formula import monomial
    >>> in_words([monomial(k12=1, d12=-1), monomial(k12=1, m1=-1, m2=-1)])
    'not identifiable: no data determine more than k12/d12, k12/(m1*m2)'
    """
    short = [formula.text for formula in determined if len(formula.terms) <= MOST_TERMS]
    more = len(determined) - len(short)
    counted = [f"{more} {'longer ' * bool(short)}combination{'s' * (more > 1)}"] * bool(more)
    return f"not identifiable: no data determine more than {' and '.join([', '.join(short)] * bool(short) + counted)}"
