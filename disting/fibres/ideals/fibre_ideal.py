"""The fibre of one model over a generic point of another, as polynomial equations modulo a prime.

For y = Phi1(p0), p0 random, the fibre is Phi2(q) = y. Nothing forbids elements that are zero: an
empty fibre is empty with them too, and a q with elements that are zero still shows that y lies in
the image of Phi2. For equal ranks two things are added.

* Tangent equations. At a generic point y of V1 = V2, all of it smooth, im dPhi2(q) lies in the
  tangent space im dPhi1(p0) for every q of the fibre. So W J2(q) = 0 for W, W J1(p0) = 0, J1 and
  J2 the Jacobian matrices: as many equations as there are independent relations between the
  coefficients, times the number of parameters. W is taken in echelon form with pivots at the
  coefficients of highest degree, which keeps the others low.
* A slice. If J2 has rank r, a generic fibre has the dimension n - r, and n - r parameters outside
  of a column basis of J2 may be fixed at random values: their projection of the generic fibre is
  dominant.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

from disting.algebra.certainty import about, prime, residues
from disting.algebra.groebner.modular import Matrix, Sparse, matrix, null_space
from disting.fibres.ideals.system import CoefficientMap, PolynomialMap, Terms

REMEMBERED = 512  # ranks: a row is asked for in many pairs
# of the primes: the longest that fit into a machine word, which is what FLINT's fast matrices take
BITS = 64
LONG_BITS = 192  # of models so large that the others give no useful bound: slower, but one run does


@dataclass(frozen=True, slots=True)
class FibreIdeal:
    """Equations in `unknowns` modulo a prime; `point` is p0, `fixed` are the other parameters'
    values by name.
    """

    modulus: int
    point: tuple[int, ...]
    unknowns: tuple[str, ...]
    fixed: dict[str, int]
    generators: tuple[Sparse, ...]


def fibre_ideal(
    model: PolynomialMap, other: PolynomialMap, label: str, equal_rank: bool, bits: int = BITS
) -> FibreIdeal:
    """The fibre of `other` over a random point of `model`, modulo a random prime, both determined
    by the label.

    Both maps have coordinates that can be compared (see `system.match_maps`).
    """
    modulus, point = draw_point(model, label, bits)
    origin = residues(f"slice:{label}", len(other.parameters), modulus)
    fixed = _slice(other, origin, modulus) if equal_rank else {}
    targets = [evaluate(c, point, modulus) for c in model.coordinates]
    zero = (0,) * len(other.parameters)
    equations = [
        dict(c) | {zero: dict(c).get(zero, 0) - y}
        for c, y in zip(other.coordinates, targets, strict=True)
    ]
    if equal_rank:
        equations += _tangents(model, other, point, modulus)
    kept = [i for i, name in enumerate(other.parameters) if name not in fixed]
    values = [fixed.get(name, 0) for name in other.parameters]
    reduced = (restrict(e, kept, values, modulus) for e in equations)
    return FibreIdeal(
        modulus=modulus,
        point=point,
        unknowns=tuple(other.parameters[i] for i in kept),
        fixed=fixed,
        generators=tuple(e for e in reduced if e),
    )


def draw_point(model: PolynomialMap, label: str, bits: int = BITS) -> tuple[int, tuple[int, ...]]:
    """The random prime and point that a label denotes; values are drawn by name, so a scale factor
    changes no other.

    Those who choose labels make them depend on the models (`sampling.about`).
    """
    modulus = prime(label, bits)
    return modulus, tuple(residues(f"{name}:{label}", 1, modulus)[0] for name in model.parameters)


@lru_cache(maxsize=REMEMBERED)
def generic_rank(model: PolynomialMap, label: str) -> int:
    """Rank of the Jacobian matrix at a random point: a lower bound of the generic rank, and
    equal to it but for bad luck.
    """
    modulus, point = draw_point(model, about(label, model.content))
    return int(jacobian(model, point, modulus).rank())


def evaluate(terms: Terms, point: Sequence[int], modulus: int) -> int:
    """Value of a polynomial modulo a prime."""
    total = 0
    for exponents, number in terms:
        for e, x in zip(exponents, point, strict=True):
            if e:
                number = number * (x if e == 1 else pow(x, e, modulus)) % modulus
        total += number
    return total % modulus


def sides_at(
    model: CoefficientMap, point: Sequence[int], modulus: int
) -> tuple[list[int], list[int]]:
    """Coefficients of numerator and denominator at a point modulo a prime."""
    values = [evaluate(c, point, modulus) for c in model.coordinates]
    count = len(model.numerator)
    return values[:count], [*values[count:], *([1] if model.is_monic else [])]


def agree(
    model: PolynomialMap,
    point: Sequence[int],
    other: PolynomialMap,
    values: Sequence[int],
    modulus: int,
) -> bool:
    """Return True if two maps that can be compared have the same coefficients at these parameters
    modulo a prime.
    """
    pairs = zip(model.coordinates, other.coordinates, strict=True)
    return all(evaluate(a, point, modulus) == evaluate(b, values, modulus) for a, b in pairs)


def derivative(terms: Terms, at: int) -> Terms:
    """Derivative by the variable at a position."""
    return tuple(((*e[:at], e[at] - 1, *e[at + 1 :]), c * e[at]) for e, c in terms if e[at])


def jacobian(model: PolynomialMap, point: Sequence[int], modulus: int) -> Matrix:
    """Jacobian matrix (coordinates x parameters) at a point modulo a prime."""
    rows = [_gradient(c, point, modulus) for c in model.coordinates]
    return matrix(len(rows), len(point), [x for row in rows for x in row], modulus)


def _gradient(terms: Terms, point: Sequence[int], modulus: int) -> list[int]:
    """All first derivatives of a polynomial: of each term the products of the factors before and
    after each factor.
    """
    total = [0] * len(point)
    for exponents, number in terms:
        factors = [(j, e, point[j]) for j, e in enumerate(exponents) if e]
        behind = [1]
        for _, e, x in reversed(factors):
            behind.append(behind[-1] * (x if e == 1 else pow(x, e, modulus)) % modulus)
        before = number
        for k, (j, e, x) in enumerate(factors, 1):
            lowered = 1 if e == 1 else e * pow(x, e - 1, modulus)
            total[j] += before * lowered * behind[-1 - k] % modulus
            before = before * (x if e == 1 else pow(x, e, modulus)) % modulus
    return [x % modulus for x in total]


def pivots(echelon: Matrix, rank: int) -> list[int]:
    """Columns of the leading entries of an echelon form."""
    return [next(j for j in range(echelon.ncols()) if int(echelon[i, j])) for i in range(rank)]


def _slice(model: PolynomialMap, origin: Sequence[int], modulus: int) -> dict[str, int]:
    free = pivots(*jacobian(model, origin, modulus).rref())
    return {
        name: x
        for j, (name, x) in enumerate(zip(model.parameters, origin, strict=True))
        if j not in free
    }


def _tangents(
    model: PolynomialMap, other: PolynomialMap, point: Sequence[int], modulus: int
) -> list[Sparse]:
    order = sorted(range(len(other.coordinates)), key=lambda i: -_degree(other.coordinates[i]))
    normals, rank = _left_null_space(jacobian(model, point, modulus), order, modulus)
    gradients = [
        [derivative(c, j) for j in range(len(other.parameters))] for c in other.coordinates
    ]
    rows = [
        {i: int(normals[r, k]) for k, i in enumerate(order) if int(normals[r, k])}
        for r in range(rank)
    ]
    return [
        _combine_gradients(row, gradients, j, modulus)
        for row in rows
        for j in range(len(other.parameters))
    ]


def _degree(terms: Terms) -> int:
    return max((sum(e) for e, _ in terms), default=0)


def _left_null_space(of: Matrix, order: list[int], modulus: int) -> tuple[Matrix, int]:
    """Basis of {w: w of = 0} in echelon form, columns in the given order."""
    basis = null_space([[int(of[i, j]) for i in order] for j in range(of.ncols())], modulus)
    entries = [x for row in basis for x in row]
    echelon: tuple[Matrix, int] = matrix(len(basis), len(order), entries, modulus).rref()
    return echelon


def _combine_gradients(
    row: dict[int, int], gradients: list[list[Terms]], at: int, modulus: int
) -> Sparse:
    total: Sparse = {}
    for i, weight in row.items():
        for exponents, number in gradients[i][at]:
            total[exponents] = (total.get(exponents, 0) + weight * number) % modulus
    return {e: c for e, c in total.items() if c}


def restrict(polynomial: Sparse, kept: list[int], values: list[int], modulus: int) -> Sparse:
    """The fixed parameters replaced by their values."""
    total: Sparse = {}
    for exponents, number in polynomial.items():
        for i, e in enumerate(exponents):
            if e and values[i]:
                number = number * pow(values[i], e, modulus) % modulus
        key = tuple(exponents[i] for i in kept)
        total[key] = (total.get(key, 0) + number) % modulus
    return {e: c for e, c in total.items() if c}
