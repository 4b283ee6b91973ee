"""How surely one fibre modulo one random prime tells what holds for generic parameters over the
complex numbers.

Notation: n1, n2 parameters, c coordinates, V1 and V2 the closures of the images of Phi1 and Phi2.
Point and prime are random. Of numerators of unequal degrees the missing coordinates are the
polynomial 0, to which all of the following applies. The relations E are those of `relations`;
degrees d_1 >= d_2 >= .. are those of the coordinates, 1 at least.

EMPTY FIBRE. Suppose that generic points of V1 were reached by Phi2. Then {(p, q): Phi1(p) =
Phi2(q)} has a component X over the rational numbers that dominates the points p. Let f be the
dimension of its generic fibres over p. Then f of the q, algebraically independent over Q(p) on X,
are counted among the p, and X is generically finite over these p. For equal ranks, f = n2 - r,
these are the parameters of the slice: X has the dimension n1 + n2 - r, and may be chosen to
dominate the points q as well. Let I be the prime ideal of all integer polynomials that vanish on
X, and R = Z[p, q]/I. Each other q_j satisfies an equation A_j(p) q_j^k + .. = 0 in R, so R[1/A] is
integral over Z[p][1/A], A the product of the A_j. By the lying-over theorem, every point p0 modulo
a prime at which A(p0) is not zero lies below a point of R, where all equations that hold on X hold
modulo the prime: the fibre's and, if V1 = V2 and the minors that give the ranks of both Jacobian
matrices do not vanish at the points drawn, the tangent equations. So a fibre that is empty modulo
the prime refutes the supposition, unless A or one of two minors vanishes. (Free q without a slice
may be chosen: then only a coefficient of A, as a polynomial in them, has to be other than 0.)

A_j: take n2 - f polynomials g_1, g_2, .. such that X is a component of their common zeros, of
codimension n2 - f. For equal ranks these are r coordinates of Phi1 - Phi2 whose gradients by the q
that are not free are independent at generic points of X, so that the zeros are smooth there. Else
they are combinations of coordinates, in falling order of degrees, the i-th one of the i-th and
later ones with a first factor other than 0, so that deg g_i <= d_i: on a component Y of the zeros
of g_1, .., g_(i-1) through X that is larger than X, not all coordinates vanish, and if all from
the i-th on did, so would, by g_(i-1), .., g_1, the others. So a combination that vanishes on no
such Y avoids one linear condition for each, at most delta = d_1 d_2 .. of them (Bezout), and one
more for the first factor: factors of 0, .., delta + 1 do. Then the g_i, all p and q_j are one
polynomial more than there are variables, and have a relation E. Divide it by the power of its
first variable that it contains. On the zeros of g_1, and so on the component of them that holds X,
what is left is 0 with g_1 = 0; g_2 does not vanish on that component, or X would have a smaller
codimension. Going on, a polynomial that is not zero remains, whose coefficients are those of E, in
p and q_j alone, and which vanishes on X. The p are independent there, so it contains q_j: A_j is
its leading coefficient, of degree delta at most.

NOT EMPTY. Suppose that V1 does not lie inside V2, r = dim V2. Let y be a point of V1 outside of
V2. There are r + 1 linear forms in the coordinates, with factors as above, such that the
projection of y is none of the closure of the projection of V2: of the hyperplanes l_i(y') = l_i(y)
through y the first r + 1 leave no point of the projective closure of V2, if each of them contains
no component of what the ones before leave; a component has a point other than y, so that is one
linear condition for each of them, deg V2 <= delta at most, which is not void by the same
triangular argument. Then the projection is a morphism on the projective closure of V2, its image
is closed, and y's is none of it. The image has dimension r, being finite over V2: it is F = 0 with
F irreducible. Choose r independent columns of the Jacobian matrix of Phi2; the forms l_i(Phi2(q))
and the n2 - r other q are one polynomial more than there are variables. Their values fill the
hypersurface F = 0 times all values of these q, so F divides their relation E. F(l(Phi2)) = 0 is an
identity of integer polynomials, so it holds modulo every prime: a solution of Phi2(q) = Phi1(p0)
modulo the prime, in whatever extension, shows F(l(Phi1)) = 0 at p0. As a polynomial in p that is
not zero, it vanishes there by accident only.

PROBABILITY. A polynomial of degree d and B bits vanishes at a random point modulo a random prime
of b bits with a probability of at most d/2^(b-1) (Schwartz, Zippel), plus the share of the primes
that divide all its coefficients, at most B/(b-1) of them.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import log, log2, prod

from disting.algebra.sampling import Size
from disting.fibres.ideals.fibre_ideal import BITS, LONG_BITS
from disting.fibres.ideals.relations import Bounded, Relation, relation
from disting.fibres.ideals.system import PolynomialMap, Terms

VARIABLE = Bounded(1, 0.0)
LEAST = 8  # bits of one run: with fewer, too many runs would be needed


@dataclass(frozen=True, slots=True)
class _Shape:
    """Degrees of the coordinates in falling order, 1 at least, and log2 of the largest sum of
    sizes of coefficients.
    """

    degrees: tuple[int, ...]
    norm: float


def safety_of_empty(
    given: PolynomialMap, other: PolynomialMap, equal_rank: bool, bits: int = BITS
) -> int:
    """Bits of error probability of "generic models of `given` are no models of `other`" from one
    empty fibre.

    As many equations as there are unknowns are counted, which is the worst case: a free q is of
    degree 1 and norm 1.
    """
    shape = _shape([a + b for a, b in zip(given.coordinates, other.coordinates, strict=True)])
    n, variables = len(other.parameters), len(given.parameters) + len(other.parameters)
    size = _related(shape, n, not equal_rank, variables)
    minor = sum(shape.degrees[:n])  # of at most n rows, each a row of derivatives
    minor_bits = n * (shape.norm + log2(shape.degrees[0] * max(n, 1)))
    return _safety(
        Size(n * size.weight + 2 * minor, int(n * size.bits + 2 * minor_bits) + 1),
        bits,
    )


def bits_of(given: PolynomialMap, other: PolynomialMap, equal_rank: bool) -> int:
    """Of the primes modulo which a fibre is looked at: words, unless one run says nothing then."""
    return BITS if safety_of_empty(given, other, equal_rank) >= LEAST else LONG_BITS


def safety_of_member(given: PolynomialMap, other: PolynomialMap, bits: int = BITS) -> int:
    """Bits of error probability of "the models of `given` lie in the closure of those of `other`"
    from one solution.

    A monomial of F has at most delta factors, each a form in the coordinates of Phi1, and there
    are at most (delta + 1)^(r + 1) of them.
    """
    shape, first = _shape(other.coordinates), _shape(given.coordinates)
    n = len(other.parameters)
    size = _related(shape, n + 1, True, n)
    delta, forms = size.weight, min(n + 1, len(shape.degrees))
    put_in = delta * (first.norm + _mixing(delta, len(first.degrees))) + forms * log2(delta + 1)
    return _safety(Size(delta * first.degrees[0], int(size.bits + put_in) + 1), bits)


def safety_of_one_value(model: PolynomialMap, bits: int = BITS) -> int:
    """Bits of error probability of "a parameter has one value in generic fibres" from one empty
    fibre of other values (see `one_value`): that of an empty fibre of the model in itself, with one
    relation more.
    """
    shape, n = _shape([c + c for c in model.coordinates]), len(model.parameters)
    degrees = shape.degrees[:n]
    difference = Bounded(1, 1.0)
    others = [difference] + [VARIABLE] * (2 * n - len(degrees))
    found = relation([*(Bounded(d, shape.norm) for d in degrees), *others])
    minor = sum(degrees)
    minor_bits = n * (shape.norm + log2(shape.degrees[0] * max(n, 1)))
    size = Size((n + 1) * found.weight + 2 * minor, int((n + 1) * found.bits + 2 * minor_bits) + 1)
    return _safety(size, bits)


def safety_of_other_values(model: PolynomialMap, bits: int = BITS) -> int:
    """Bits of error probability of "a parameter has several values in generic fibres" from one
    fibre of other values that is not empty (see `one_value`).

    r + 1 forms in the coordinates, r <= n parameters, one of them with u q_j added, of degree 2 at
    least; u and the q that are left over are variables.
    """
    shape, n = _shape(model.coordinates), len(model.parameters)
    forms = sorted((*shape.degrees[: n + 1], 2), reverse=True)[: n + 1]
    norm = shape.norm + _mixing(prod(forms) ** 2, len(shape.degrees) + 1)
    found = relation([Bounded(d, norm) for d in forms] + [VARIABLE] * (n + 2 - len(forms)))
    put_in = found.weight * norm + (len(forms) + 1) * log2(found.weight + 1)
    return _safety(Size(found.weight, int(found.bits + put_in) + 1), bits)


def _related(shape: _Shape, equations: int, combined: bool, variables: int) -> Relation:
    """The relation of so many equations, or as there are coordinates, and variables: one
    polynomial more than variables.
    """
    degrees = shape.degrees[:equations]
    norm = shape.norm + (_mixing(prod(degrees), len(shape.degrees)) if combined else 0.0)
    polynomials = [Bounded(d, norm) for d in degrees]
    return relation(polynomials + [VARIABLE] * (variables + 1 - len(polynomials)))


def _mixing(delta: int, coordinates: int) -> float:
    """log2 of the sum of factors 0, .., delta + 1 of a form in so many coordinates."""
    return log2(delta + 1) + log2(coordinates)


def _shape(coordinates: Sequence[Terms]) -> _Shape:
    degrees = sorted(
        (max((sum(e) for e, _ in terms), default=0) for terms in coordinates), reverse=True
    )
    norm = max(sum(abs(c) for _, c in terms) for terms in coordinates)
    return _Shape(tuple(max(d, 1) for d in degrees), log2(max(norm, 1)))


def _safety(size: Size, bits: int) -> int:
    # of that size, at least (Rosser and Schoenfeld 1962)
    primes = 3 * 2.0 ** (bits - 1) / (5 * bits * log(2))
    miss = size.degree / 2.0 ** (bits - 1) + (1 + size.bits / (bits - 1)) / primes
    return max(0, int(-log2(miss)))
