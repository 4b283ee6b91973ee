"""How surely one fibre modulo one random prime tells what holds for generic parameters over the complex numbers.

Notation: n1, n2 parameters, c coordinates, V1 and V2 the closures of the images of Phi1 and Phi2. Point and prime are random.
Of numerators of unequal degrees the missing coordinates are the polynomial 0, to which all of the following applies.

EMPTY FIBRE. Suppose that generic points of V1 were reached by Phi2. Then {(p, q): Phi1(p) = Phi2(q)} has a component over the
rational numbers that dominates the points p. Cut by as many planes as its generic fibres have dimensions (for equal ranks:
with the parameters of the slice counted among the p) it becomes a variety X, generically finite over the points p. Let I
be the prime ideal of all integer polynomials that vanish on X, and R = Z[p, q]/I. Each q_j satisfies an equation
A_j(p) q_j^k + .. = 0 in R, so R[1/A] is integral over Z[p][1/A], A = A_1 A_2 .. By the lying-over theorem, every point p0
modulo a prime at which A(p0) is not zero lies below a point of R, where all equations that hold on X hold modulo the prime:
the fibre's and, if V1 = V2 and the minors that give the ranks of both Jacobian matrices do not vanish at the points drawn, the
tangent equations. So a fibre that is empty modulo the prime refutes the supposition, unless A or one of two minors vanishes.

NOT EMPTY. Suppose that V1 does not lie inside V2. Some linear projection of V2 to one dimension more than its own lies in a
hypersurface F = 0, F irreducible, that does not contain the projection of V1. F(projected Phi2) = 0 is an identity of integer
polynomials, so it holds modulo every prime: a solution of Phi2(q) = Phi1(p0) modulo the prime, in whatever extension, shows
F(projected Phi1) = 0 at p0. As a polynomial in p that is not zero, it vanishes there by accident only.

DEGREES AND BITS come from the arithmetic Perron theorem: k+1 integer polynomials y_i in k variables, of degrees d_i and with
coefficients of h_i bits, satisfy an equation E(y) = 0 with d_1 a_1 + .. <= delta = prod d_i for each of its monomials y^a and
with coefficients of at most delta (sum h_i/d_i + (k+2) log2(2k+8)) bits (C. D'Andrea, T. Krick, M. Sombra, Heights of
varieties in multiprojective spaces and arithmetic Nullstellensätze, Ann. Sci. Éc. Norm. Sup. 46, 2013).

* A_j: the variables are all p and q. The polynomials are r coordinates g_i of Phi1 - Phi2 whose gradients by q are independent
  (equal ranks), or combinations of all coordinates, and planes; all p; and q_j. X is a component of the intersection of the g_i
  and planes with no more dimensions than it must have. So one may divide E by the power of g_1 that it contains, put g_1 = 0,
  go over to a component of g_1 = 0 that contains X, and so on: what is left has coefficients of E only, vanishes on X and is
  not zero. A_j is its leading coefficient.
* F: the variables are q. The polynomials are combinations of Phi2, and planes, which are put to zero in the same way. A factor
  has at most as many more bits as the sum of its partial degrees (A. O. Gelfond).
* Combinations and planes have to avoid at most delta linear conditions each, so coefficients of 0, .., delta do.

A polynomial of degree d and B bits vanishes at a random point modulo a random prime of b bits with a probability of at most
d/2^(b-1) (Schwartz, Zippel), plus the share of the primes that divide all its coefficients, at most B/(b-1) of them.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import log, log2, prod

from disting.algebra.sampling import Size
from disting.ideals.fibre_ideal import BITS
from disting.ideals.system import CoefficientMap, Terms


@dataclass(frozen=True, slots=True)
class _Shape:
    """Degrees of the coordinates in falling order, bits of their largest coefficient and of their number of terms."""

    degrees: tuple[int, ...]
    bits: float
    terms: float


def safety_of_empty(given: CoefficientMap, other: CoefficientMap, equal_rank: bool, bits: int = BITS) -> int:
    """Bits of error probability of "generic models of `given` are no models of `other`" from one empty fibre."""
    shape = _shape([a + b for a, b in zip(given.coordinates, other.coordinates, strict=True)])
    n, variables = len(other.parameters), len(given.parameters) + len(other.parameters)
    equations = min(n, len(shape.degrees))
    delta, height = _perron(shape, equations, 0 if equal_rank else n - equations, not equal_rank, variables)
    minor = sum(shape.degrees[:n])
    minor_bits = n * (shape.bits + shape.terms + 2 * log2(minor + 2))
    return _safety(Size(n * delta + 2 * minor, int(n * height + 2 * minor_bits) + 1), bits)


def safety_of_member(given: CoefficientMap, other: CoefficientMap, bits: int = BITS) -> int:
    """Bits of error probability of "the models of `given` lie in the closure of those of `other`" from one solution."""
    shape, first = _shape(other.coordinates), _shape(given.coordinates)
    n = len(other.parameters)
    equations = min(n + 1, len(shape.degrees))
    delta, height = _perron(shape, equations, n + 1 - equations, True, n)
    factor = equations * delta
    put_in = delta * (first.bits + first.terms + log2(delta) + log2(len(first.degrees))) + equations * log2(delta + 1)
    return _safety(Size(delta * first.degrees[0], int(height + factor + put_in) + 1), bits)


def _perron(shape: _Shape, equations: int, planes: int, combined: bool, variables: int) -> tuple[int, float]:
    """delta and the bits of E's coefficients; both grow with the degrees, so the largest ones are a bound."""
    degrees = [max(d, 1) for d in shape.degrees[:equations]]
    delta = prod(degrees)
    more = log2(delta + 1)
    bits = shape.bits + 1 + (more + log2(len(shape.degrees)) if combined else 0)
    return delta, delta * (sum(bits / d for d in degrees) + planes * more + (variables + 2) * log2(2 * variables + 8))


def _shape(coordinates: Sequence[Terms]) -> _Shape:
    degrees = sorted((max((sum(e) for e, _ in terms), default=0) for terms in coordinates), reverse=True)
    largest = max((abs(c) for terms in coordinates for _, c in terms), default=1)
    return _Shape(tuple(degrees), log2(largest), log2(max(map(len, coordinates)) + 1))


def _safety(size: Size, bits: int) -> int:
    primes = 3 * 2.0 ** (bits - 1) / (5 * bits * log(2))  # of that size, at least (Rosser and Schoenfeld 1962)
    miss = size.degree / 2.0 ** (bits - 1) + (1 + size.bits / (bits - 1)) / primes
    return max(0, int(-log2(miss)))
