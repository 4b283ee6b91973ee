"""A readable basis of what can be determined: candidates taken greedily until the rank is reached.

A candidate counts if its gradient lies in the row space at every proof point. Were it not
identifiable, a minor of one row more than the rank would not vanish identically, and yet vanish at
all points: a probability that `safety` bounds. That accepted candidates are independent is proven
by one point.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil, log2

from disting.algebra.certainty import Size, safety
from disting.algebra.quotient import matrix
from disting.behaviour.chain_model import ChainModel
from disting.model.structure import Structure
from disting.questions.identifiability.functions import Candidate, Candidates
from disting.questions.identifiability.tangent import Tangent


@dataclass(frozen=True, slots=True)
class Basis:
    """Identifiable parameters, independent identifiable functions, and the error bound
    2**-safety of all of it (0: proven).
    """

    singles: tuple[Candidate, ...]
    chosen: tuple[Candidate, ...]
    safety: int


def basis(structure: Structure, proof: Sequence[Tangent], rank: int, seed: str) -> Basis:
    """The basis; `proof` holds independent points, `rank` is the largest rank among them."""
    candidates = Candidates(structure, len(structure.parameters) - rank, seed)
    parameters = tuple(candidates.parameters())
    if rank == len(structure.parameters):
        return Basis(parameters, parameters, 0)
    at = next(t for t in proof if t.rank == rank)
    singles = tuple(c for c in parameters if _identifiable(c, proof))
    chosen, tested = list[Candidate](), list(parameters)
    for candidate in candidates:
        if len(chosen) == rank:
            break
        if _rank([*chosen, candidate], at) > len(chosen):
            tested.append(candidate)
            chosen += [candidate] if _identifiable(candidate, proof) else []
    return Basis(singles, tuple(chosen), _safety(structure, tested, len(proof)))


def _identifiable(candidate: Candidate, proof: Sequence[Tangent]) -> bool:
    return all(t.sees(candidate.formula.gradient(t.values, t.modulus)) for t in proof)


def _rank(candidates: Sequence[Candidate], at: Tangent) -> int:
    rows = [c.formula.gradient(at.values, at.modulus) for c in candidates]
    return int(matrix(rows, len(at.values), at.modulus).rank())


def _safety(structure: Structure, tested: Sequence[Candidate], points: int) -> int:
    """Bound for all tests and the rank: one more row in the largest minor, and as many
    statements as tests.
    """
    minor, sizes = ChainModel(structure).minor_size(None), [c.formula.size for c in tested]
    rows = len(structure.parameters) + 1
    bits = minor.bits + max(s.bits for s in sizes) + ceil(log2(rows))
    return safety(Size(minor.degree + max(s.degree for s in sizes), bits), points) - ceil(
        log2(len(tested) + 1)
    )
