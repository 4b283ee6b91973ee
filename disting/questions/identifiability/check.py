"""Checks a finding again from its content alone: fresh points, the stored point, exact identities;
no search for formulas.
"""

from dataclasses import replace

from disting.algebra.quotient import matrix
from disting.behaviour.transfer import is_renaming
from disting.fibres.synthesis.fibre import fibre
from disting.fibres.synthesis.task import fraction, target
from disting.model.chain import Chain
from disting.questions.identifiability.answer import Identifiability
from disting.questions.identifiability.parts import monomial
from disting.questions.identifiability.solutions import MOST_LISTED, foster_count
from disting.questions.identifiability.tangent import Tangent, proof_tangents

POINTS = 3


def confirms(answer: Identifiability, chain: Chain, seed: str = "verify") -> bool:
    """Return True if the ranks, the combinations, the symmetries and the number of solutions hold
    for the chain.

    >>> from disting.questions.identifiability.analysis import identifiability
    >>> confirms(identifiability(Chain(3, meas_plus=2)), Chain(3, meas_plus=2))
    True
    """
    fresh = proof_tangents(chain.structure, seed, POINTS)
    ranks = answer.parameters == chain.parameters and max(
        t.rank for t in fresh
    ) == answer.rank == len(answer.basis)
    return (
        ranks
        and all(_check_combinations(answer, t) for t in fresh)
        and _check_renamings(answer, chain)
        and _check_count(answer, chain)
    )


def _check_combinations(answer: Identifiability, at: Tangent) -> bool:
    """The combinations lie in the row space and are independent; of the parameters, only those
    listed lie in it.
    """
    slopes = [c.formula.gradient(at.values, at.modulus) for c in answer.basis]
    units = {name: [int(name == other) for other in at.values] for name in at.values}
    singles = {monomial(**{name: 1}) for name, unit in units.items() if at.sees(unit)}
    independent = matrix(slopes, len(at.values), at.modulus).rank() == answer.rank
    return (
        all(map(at.sees, slopes)) and independent and singles == {c.formula for c in answer.singles}
    )


def _check_renamings(answer: Identifiability, chain: Chain) -> bool:
    """Every renaming is an identity of formulas."""
    plain = {name: name for name in chain.parameters}
    return all(
        is_renaming(chain.structure, chain.structure, plain | dict(r.moved))
        for r in answer.renamings
    )


def _check_count(answer: Identifiability, chain: Chain) -> bool:
    """As many solutions at the stored point as are listed, or as follows from a theorem; nothing to
    check where they are not all.
    """
    if answer.most is None or answer.most > MOST_LISTED:
        return answer.most is None or answer.most == answer.least == foster_count(chain)
    plain = replace(chain, dead_time=False, damped=chain.damped and chain.n_masses > 1)
    point = {name: fraction(value) for name, value in answer.point}
    return (
        len(fibre(plain, target(plain.structure, point)).solutions)
        == answer.most
        == len(answer.alternatives)
    )
