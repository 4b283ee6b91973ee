"""Directions of the parameter space that no experiment detects, at random points modulo primes.

A function f of the parameters is locally identifiable exactly if its gradient lies in the row
space of the Jacobian of the transfer-function coefficients at a generic point, that is if grad f .
v = 0 for all v of the kernel (E. Walter, L. Pronzato 1997). With f = sum c_j f_j and unknown
constants c_j this is a linear system in c, one row for each kernel vector at each point: its
solutions are all identifiable combinations of the f_j with constant coefficients. Monomials p^a
are those of f_j = log p_j.

Integer weights of monomials form lattices, for which kernels and short bases are computed.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import lcm

from flint import fmpz_mat, nmod_mat

from disting.algebra.certainty import about, prime, residues
from disting.algebra.quotient import matrix, rational
from disting.behaviour.chain_model import ChainModel, powers
from disting.behaviour.sample import DrawnPoint, Representation, at_point, draw_point, seen_at
from disting.model.chain import Structure
from disting.questions.identifiability.parts import Formula

COEFFICIENT_LIMIT = 60  # larger numbers are artefacts of the reconstruction, or not readable

Slopes = list[list[int]]  # one gradient a function


@dataclass(frozen=True, slots=True)
class Tangent:
    """A point (residues by parameter name), the rows of the Jacobian there that are not zero,
    and a basis of its kernel.
    """

    values: dict[str, int]
    modulus: int
    rows: tuple[tuple[int, ...], ...]
    kernel: tuple[tuple[int, ...], ...]

    @property
    def rank(self) -> int:
        """Rank of the Jacobian at this point."""
        return len(self.values) - len(self.kernel)

    def rank_by(self, names: Sequence[str]) -> int:
        """Rank of the columns of these parameters: the others are given."""
        columns = [i for i, name in enumerate(self.values) if name in names]
        rows = [[row[i] for i in columns] for row in self.rows]
        return int(matrix(rows, len(columns), self.modulus).rank()) if columns else 0

    def sees(self, gradient: Sequence[int]) -> bool:
        """Return True if the gradient lies in the row space."""
        return not any(_dot(gradient, v) % self.modulus for v in self.kernel)


def tangent(where: DrawnPoint) -> Tangent:
    """The tangent at a point that was drawn.

    >>> from disting.model.chain import Chain
    >>> model = ChainModel(Chain(2, meas_plus=2, damped=False).structure)
    >>> found = tangent(draw_point(model, "doc"))
    >>> found.rank, len(found.kernel)
    (2, 1)
    """
    sampled = seen_at(where, Representation.TF, 0)
    kernel, nullity = sampled.jacobian.nullspace()
    columns = kernel.transpose().tolist()[: int(nullity)]
    vectors = tuple(tuple(int(x) for x in column) for column in columns)
    values = dict(zip(where.model.parameters, where.point, strict=True))
    return Tangent(values, where.modulus, tuple(filter(any, sampled.rows)), vectors)


def proof_tangents(structure: Structure, seed: str, points: int) -> tuple[Tangent, ...]:
    """Independent points, each with its own prime: for statements with an error bound."""
    model = ChainModel(structure)
    return tuple(tangent(draw_point(model, f"identifiability:{seed}:{k}")) for k in range(points))


def search_tangents(structure: Structure, seed: str, count: int) -> Iterator[Tangent]:
    """Points that share one prime and are none of those of the proofs: for the search of
    candidates.
    """
    label = about(f"identifiability:{seed}:search", structure)
    modulus = prime(label)
    points = (
        tuple(residues(f"{label}:{k}", len(structure.parameters), modulus)) for k in range(count)
    )
    return (tangent(at_point(ChainModel(structure), p, modulus)) for p in points)


def combinations(seen: Sequence[Tangent], terms: Sequence[Formula]) -> list[list[int]]:
    """Short integer vectors c such that sum c_j terms_j is identifiable at the points used.

    Candidates, no proof. There must be at least as many kernel vectors in all as there are terms.
    """
    return _solve_weights(seen, lambda t: [f.gradient(t.values, t.modulus) for f in terms])


def monomials(seen: Sequence[Tangent]) -> list[list[int]]:
    """Short integer exponents a such that the product of p_i^a_i is identifiable at the points
    used; candidates likewise.
    """
    return _solve_weights(seen, _logarithms)


def most_invariants(structure: Structure) -> int:
    """Number of coefficients of a chain's transfer function, the denominator monic, that are
    not zero for all parameters.
    """
    return sum(map(len, powers(structure))) - 1 + structure.dead_time


def _logarithms(t: Tangent) -> Slopes:
    inverse = [pow(x, -1, t.modulus) for x in t.values.values()]
    return [[x if i == j else 0 for j in range(len(inverse))] for i, x in enumerate(inverse)]


def _solve_weights(
    seen: Sequence[Tangent], gradients: Callable[[Tangent], Slopes]
) -> list[list[int]]:
    rows: list[list[int]] = []
    for t in seen:
        slopes = gradients(t)
        rows += [[_dot(g, v) % t.modulus for g in slopes] for v in t.kernel]
    kernel, nullity = nmod_mat(
        len(rows), len(rows[0]), [x for row in rows for x in row], seen[0].modulus
    ).nullspace()
    columns = kernel.transpose().tolist()[: int(nullity)]
    whole = (_integral([int(x) for x in column], seen[0].modulus) for column in columns)
    return short_vectors([v for v in whole if max(map(abs, v)) <= COEFFICIENT_LIMIT])


def _integral(column: list[int], modulus: int) -> list[int]:
    """The smallest integer multiple of the rational vector behind residues."""
    numbers = [Fraction(rational(x, modulus)) for x in column]
    common = lcm(*(f.denominator for f in numbers))
    return [int(f * common) for f in numbers]


def _dot(left: Sequence[int], right: Sequence[int]) -> int:
    return sum(a * b for a, b in zip(left, right, strict=True))


def short_vectors(vectors: Sequence[Sequence[int]]) -> list[list[int]]:
    """A reduced basis (A. Lenstra, H. Lenstra, L. Lovasz 1982) of the lattice of independent
    integer vectors.

    >>> short_vectors([[1, 0], [7, 1]])
    [[1, 0], [0, 1]]
    """
    return (
        [[int(x) for x in row] for row in fmpz_mat([list(v) for v in vectors]).lll().tolist()]
        if vectors
        else []
    )
