"""The fibre over one point with integer coordinates, over the rational numbers: an emptiness
without any prime.

FLINT's Buchberger algorithm finds the Gröbner basis in a process that can be killed. The basis {1}
proves that this one point has no equivalent, real or complex. What it says about generic points is
bounded by the point's size alone (see `bounds`).
"""

from collections.abc import Sequence
from enum import StrEnum

from flint import Ordering, fmpq_mat, fmpz_mat, fmpz_mpoly_ctx, fmpz_mpoly_vec

from disting.algebra.groebner.modular import Sparse
from disting.algebra.groebner.own_process import run_limited
from disting.fibres.ideals.fibre_ideal import derivative
from disting.fibres.ideals.system import CoefficientMap, Terms, match_maps


class Emptiness(StrEnum):
    """Whether the fibre has points over the complex numbers."""

    EMPTY = "empty"
    NOT_EMPTY = "not empty"
    UNKNOWN = "unknown"


def fibre_over_rationals(
    given: CoefficientMap,
    other: CoefficientMap,
    point: Sequence[int],
    equal_rank: bool,
    seconds: float,
    megabytes: int = 2048,
) -> tuple[Emptiness, str]:
    """Whether `other` has parameters with the transfer function of `given` at this point, and why
    it is not known.

    With `equal_rank` the tangent equations are added: then EMPTY refutes that the point is a
    generic point of equal images, and is no statement about this point alone. Coordinates of a
    scale factor, where one is needed, are 1.
    """
    left, right = match_maps(given, other)
    values = [*point, *[1] * (len(left.parameters) - len(point))]
    generators = [list(g.items()) for g in integer_fibre(left, right, values, equal_rank)]
    ended = run_limited(_is_one, (generators, len(right.parameters)), seconds, megabytes)
    if ended.value is None:
        return Emptiness.UNKNOWN, ended.reason
    return (Emptiness.EMPTY if ended.value else Emptiness.NOT_EMPTY), ""


def integer_fibre(
    given: CoefficientMap, other: CoefficientMap, point: Sequence[int], tangent: bool
) -> list[Sparse]:
    """Equations with integer coefficients in the parameters of `other`; of two maps that can be
    compared.
    """
    zero = (0,) * len(other.parameters)
    targets = [_value(c, point) for c in given.coordinates]
    equations: list[Sparse] = []
    for c, y in zip(other.coordinates, targets, strict=True):
        terms = dict(c)
        equations.append(terms | {zero: terms.get(zero, 0) - y})
    if tangent:
        equations += [
            _combined(row, other, j) for row in _normals(given, point) for j in range(len(zero))
        ]
    return [kept for e in equations if (kept := {m: c for m, c in e.items() if c})]


def _value(terms: Terms, point: Sequence[int]) -> int:
    total = 0
    for exponents, number in terms:
        for e, x in zip(exponents, point, strict=True):
            number *= x**e
        total += number
    return total


def _normals(given: CoefficientMap, point: Sequence[int]) -> list[list[int]]:
    """Integer basis, in echelon form, of the relations between the rows of the Jacobian matrix."""
    size = len(given.coordinates)
    columns = [
        [_value(derivative(c, j), point) for c in given.coordinates] for j in range(len(point))
    ]
    space, nullity = fmpz_mat(columns).nullspace()
    if not nullity:
        return []
    echelon, _ = fmpq_mat(
        fmpz_mat([[space[i, j] for i in range(size)] for j in range(nullity)])
    ).rref()
    cleared, _ = echelon.numer_denom()
    return [[int(cleared[i, j]) for j in range(size)] for i in range(nullity)]


def _combined(weights: list[int], model: CoefficientMap, at: int) -> Sparse:
    total: Sparse = {}
    for weight, terms in zip(weights, model.coordinates, strict=True):
        for exponents, number in derivative(terms, at) if weight else ():
            total[exponents] = total.get(exponents, 0) + weight * number
    return total


def _is_one(generators: list[list[tuple[tuple[int, ...], int]]], size: int) -> bool:
    context = fmpz_mpoly_ctx.get([f"x{i}" for i in range(size)], Ordering.degrevlex)
    basis = fmpz_mpoly_vec(
        [context.from_dict(dict(g)) for g in generators], context
    ).buchberger_naive()
    return any(p.is_constant() and not p.is_zero() for p in basis)
