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
from fractions import Fraction
from math import inf

from disting.algebra.quotient import matrix
from disting.algebra.sampling import prime, residues
from disting.fit.estimate import Task
from disting.fit.joint import JointCost
from disting.fit.practical import Practical
from disting.fit.setup import Setup
from disting.model.chain import Chain, Sensor
from disting.model.settings import Settings
from disting.model.structure import POWER, Element, Mass, Structure
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
    rational = tuple(name for name in common if name != "Td")
    rank = max(
        stacked_rank(chain, task.cost.setups, rational, f"joint:{settings.seed}:{k}")
        for k in range(settings.points)
    )
    lacking = len(rational) - rank
    if lacking <= 0:
        return found
    indices = (*found.condition_indices[: len(found.names) - lacking], *(inf,) * lacking)
    directions = f"{lacking} combination{'s' * (lacking > 1)} of its parameters"
    words = f"not identifiable: these responses together leave {directions} open, whatever the data"
    return replace(found, condition_indices=indices, collinearity=inf, unidentifiable=words)


def stacked_rank(chain: Chain, setups: Sequence[Setup], free: Sequence[str], label: str) -> int:
    """Rank of the Jacobian of all responses by the free parameters, without dead times, at a
    random point modulo a random prime: never above that at generic parameters.

    Its rows are d G(s)/d p of each setup at as many random s as there are parameters, by the
    formulas of `plant`: as many values as a rational function of s has coefficients tell it.
    """
    modulus = prime(label)
    elements = chain.structure.elements
    names = [*(e.parameter for e in elements), *["T1"] * chain.lag]
    values = dict(zip(names, residues(f"{label}:point", len(names), modulus), strict=True))
    count = 2 * (len(names) + len(elements))
    rows = [
        _gradient(chain.structure, setup, values, s, modulus)
        for k, setup in enumerate(setups)
        for s in residues(f"{label}:{k}", count, modulus)
    ]
    at = [names.index(name) for name in free]
    return int(matrix([[row[i] for i in at] for row in rows], len(at), modulus).rank())


def _gradient(
    structure: Structure, setup: Setup, values: Mapping[str, int], s: int, modulus: int
) -> list[int]:
    """d G/d p modulo the prime, by all elements and the lag."""
    n = structure.n_masses
    still, seen = {0, *setup.still(n)}, setup.seen(structure, Sensor.POSITION).ports
    known = [(Mass(i), Fraction(size)) for i, size in setup.added(n)]
    rows = [[int(i == j and i in still) for j in range(n + 1)] for i in range(n + 1)]
    everything = [(e, Fraction(values[e.parameter])) for e in structure.elements]
    for element, size in everything + known:
        part = size.numerator * pow(size.denominator, -1, modulus) * pow(s, POWER[element.kind])
        for i, one in _ends(element):
            for j, other in _ends(element):
                if i not in still and j not in still:
                    rows[i][j] = (rows[i][j] + part * one * other) % modulus
    solved = matrix(rows, n + 1, modulus)

    def moved(minus: int, plus: int) -> list[int]:
        """Displacements under a force between two places."""
        force = [
            [int(i not in still) * ((i == plus) - (i == minus)) % modulus] for i in range(n + 1)
        ]
        return [int(row[0]) for row in solved.solve(matrix(force, 1, modulus)).tolist()]

    x, y = moved(seen.act_minus, seen.act_plus), moved(seen.meas_minus, seen.meas_plus)
    lag = pow(1 + s * values["T1"], -1, modulus) if structure.lag else 1
    stretched = [
        [sum(sign * by[i] for i, sign in _ends(element)) for by in (x, y)]
        for element in structure.elements
    ]
    slopes = [
        -lag * pow(s, POWER[e.kind]) * one * other % modulus
        for e, (one, other) in zip(structure.elements, stretched, strict=True)
    ]
    response = lag * (x[seen.meas_plus] - x[seen.meas_minus])
    return [*slopes, *[-s * lag * response % modulus] * structure.lag]


def _ends(element: Element) -> tuple[tuple[int, int], ...]:
    """Masses that an element acts on, with signs; the ground is 0."""
    return ((element.at, 1), (element.at + 1, -1)) if element.kind in "kd" else ((element.at, 1),)


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
