"""Certainty of a statement on generic complex parameters from one fibre modulo one random prime.

Notation: n1, n2 parameters, c coordinates, V1 and V2 the closures of the images of Phi1 and Phi2.
Point and prime are random. Of numerators of unequal degrees the missing coordinates are the
polynomial 0, to which all of the following applies. Relations E are those of the last theorem here;
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

How large an algebraic relation between k + 1 polynomials in k variables has to be: its degree,
and its coefficients.

Theorem. Let q_0, .., q_k be polynomials in x_1, .., x_k with integer coefficients, q_j of degree
d_j >= 1 at most (constants are allowed), ||q_j|| the sum of the sizes of its coefficients, and
delta = d_0 d_1 .. d_k. There is a polynomial E(y_0, .., y_k) with integer coefficients, not zero,
such that E(q_0, .., q_k) = 0, with d_0 a_0 + .. + d_k a_k <= delta for each of its monomials y^a
(O. Perron, Algebra I, 1927), and with a Mahler measure of

    log M(E) <= sum_j delta/d_j log(||q_j|| + 2) + delta/2 log (k+1)!,
    M(E) = exp of the mean of log |E| over |y_j| = 1

So a coefficient of y^a is at most M(E) prod_j binomial(deg_j E, a_j) (K. Mahler, On some
inequalities for polynomials in several variables, J. London Math. Soc. 37, 1962), deg_j E <=
delta/d_j, hence at most M(E) 2^(sum_j delta/d_j). That holds for every factor F of E with integer
coefficients too: M(E) = M(F) M(E/F), M(E/F) >= 1, and the degrees are smaller.

Proof. The resultant Res(F_0, .., F_k) of k + 1 forms of degrees d_j in x_0, .., x_k is a
polynomial in their coefficients with integer coefficients, homogeneous of degree D_j = delta/d_j
in those of F_j; it is 0 exactly if the forms have a common zero other than 0, over any field;
Res(x_0^d_0, .., x_k^d_k) = 1; it is multiplicative in each F_j; and putting s x_0 for x_0
multiplies it by s^delta (D. Cox, J. Little, D. O'Shea, Using Algebraic Geometry, chapter 3). Let
Q_j = x_0^d_j q_j(x_1/x_0, ..), and

    R(y, e) = Res(Q_0 - y_0 x_0^d_0, Q_1 - y_1 x_0^d_1 + e x_1^d_1, .., Q_k - y_k x_0^d_k
                  + e x_k^d_k).

R is not zero: the coefficient of y_0^D_0 e^(D_1 + .. + D_k) is +-Res(x_0^d_0, .., x_k^d_k) = +-1,
because R is homogeneous in the coefficients of each form. R vanishes for y_0 = q_0(x), y_j =
q_j(x) + e x_j^d_j, where the forms have the common zero (1, x). Let R = e^m (E + e ..) with E(y)
other than 0: dividing by e^m and putting e = 0 gives E(q_0, .., q_k) = 0.

Degree. Putting s x_0 for x_0 multiplies y_j by s^d_j and other coefficients by powers of s that
are not negative, and R by s^delta. So in each monomial of R the powers of s that come with y^a,
sum d_j a_j of them, are at most delta.

Measure. 1. Let F_0, .., F_(k-1) have finitely many common zeros. There are D_k vectors v, other
than 0, such that Res(F_0, .., F_(k-1), G) = prod_v G(v) for all forms G of whatever degree. For
linear G both sides are polynomials in G's coefficients of degree D_k; the left one vanishes
exactly where G passes through a common zero, so it is a constant times a product of values at
zeros, and the vectors may be scaled to make the constant 1. By multiplicativity this holds for
powers G = L^d of linear forms. For all G of degree d the left side is, for the same reason, a
constant times a product of values at the zeros, with multiplicities that G = L^d shows to be those
for L, and the constant to be 1. (With infinitely many zeros both resultants below are 0.)

2. For a form G of degree d, with a random linear form L = u_0 x_0 + .. + u_k x_k, |u_i| = 1
   independent and uniform,

    log |Res(F, G)| <= D_k log ||G|| + d mean of log |Res(F, L)|,

because |G(v)| <= ||G|| max |v_i|^d and the mean of log |u_0 v_0 + .. + u_k v_k| is at least log
max |v_i| (Jensen's formula in u_i for the largest v_i: the mean of log |u_i v_i + w| is log
max(|v_i|, |w|)).

3. Let y_j and e be random on the unit circle. Then ||F_j|| <= ||q_j|| + 2. By 2, replace one form
   after another by a random linear form. When F_j is replaced, those before it are still there and
   those after it are linear: this adds d_0 .. d_(j-1) log(||q_j|| + 2) to the mean of log |Res|
   and multiplies by d_j what remains. In all, F_j adds delta/d_j log(||q_j|| + 2), and delta times
   the mean of log |det(u)| of a random (k+1) x (k+1) matrix u remains. That is at most half of the
   logarithm of the mean of |det(u)|^2 (Jensen's inequality), which is (k+1)!, since different
   products of the u are orthogonal.

4. The mean of log |E + e ..| over |e| = 1 is at least log |E| (Jensen's formula), so M(E) <= M(R).
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import lgamma, log, log2, prod

from disting.algebra.certainty import Size
from disting.fibres.ideals.fibre_ideal import BITS, LONG_BITS
from disting.fibres.ideals.system import PolynomialMap, Terms

ROUNDING = 1 + 2.0**-40  # of a sum of logarithms in floating point


@dataclass(frozen=True, slots=True)
class PolynomialBound:
    """A polynomial of degree `degree` at most, 1 or more, and with the sum 2**norm of the sizes
    of its coefficients at most.
    """

    degree: int
    norm: float


@dataclass(frozen=True, slots=True)
class Relation:
    """`weight` = delta bounds sum d_j a_j, so the total degree too; no coefficient has more
    than `bits` bits.
    """

    weight: int
    bits: float


def relation(polynomials: Sequence[PolynomialBound]) -> Relation:
    """Bounds of a relation between k + 1 polynomials in k variables, and of each of its factors.

    >>> relation([PolynomialBound(2, 0.0), PolynomialBound(3, 0.0)]).weight
    6
    """
    delta, count = prod(q.degree for q in polynomials), len(polynomials)
    shares = sum((_log_sum(q.norm) + 1) / q.degree for q in polynomials)
    return Relation(delta, delta * (shares + lgamma(count + 1) / log(2) / 2) * ROUNDING)


def _log_sum(norm: float) -> float:
    """log2(2**norm + 2)."""
    return norm + log2(1 + 2.0 ** (1 - norm))


VARIABLE = PolynomialBound(1, 0.0)
LEAST = 8  # bits of one run: with fewer, too many runs would be needed


@dataclass(frozen=True, slots=True)
class _Shape:
    """Degrees of the coordinates in falling order, 1 at least, and log2 of the largest sum of
    sizes of coefficients.
    """

    degrees: tuple[int, ...]
    norm: float


def safety_of_empty(
    model: PolynomialMap, other: PolynomialMap, equal_rank: bool, bits: int = BITS
) -> int:
    """Bits of error probability of "generic models of `model` are no models of `other`" from one
    empty fibre.

    As many equations as there are unknowns are counted, which is the worst case: a free q is of
    degree 1 and norm 1.
    """
    shape = _shape([a + b for a, b in zip(model.coordinates, other.coordinates, strict=True)])
    n, variables = len(other.parameters), len(model.parameters) + len(other.parameters)
    size = _relation_of(shape, n, not equal_rank, variables)
    minor = sum(shape.degrees[:n])  # of at most n rows, each a row of derivatives
    minor_bits = n * (shape.norm + log2(shape.degrees[0] * max(n, 1)))
    return _safety(
        Size(n * size.weight + 2 * minor, int(n * size.bits + 2 * minor_bits) + 1),
        bits,
    )


def bits_of(model: PolynomialMap, other: PolynomialMap, equal_rank: bool) -> int:
    """Of the primes modulo which a fibre is computed: machine words, unless one run gives no result
    then.
    """
    return BITS if safety_of_empty(model, other, equal_rank) >= LEAST else LONG_BITS


def safety_of_member(model: PolynomialMap, other: PolynomialMap, bits: int = BITS) -> int:
    """Bits of error probability of "the models of `model` lie in the closure of those of `other`"
    from one solution.

    A monomial of F has at most delta factors, each a form in the coordinates of Phi1, and there
    are at most (delta + 1)^(r + 1) of them.
    """
    shape, first = _shape(other.coordinates), _shape(model.coordinates)
    n = len(other.parameters)
    size = _relation_of(shape, n + 1, True, n)
    delta, forms = size.weight, min(n + 1, len(shape.degrees))
    put_in = delta * (first.norm + _mixing(delta, len(first.degrees))) + forms * log2(delta + 1)
    return _safety(Size(delta * first.degrees[0], int(size.bits + put_in) + 1), bits)


def safety_of_one_value(model: PolynomialMap) -> int:
    """Bits of error probability of "a parameter has one value in generic fibres" from one empty
    fibre of other values (see `one_value`): that of an empty fibre of the model in itself, with one
    relation more.
    """
    shape, n = _shape([c + c for c in model.coordinates]), len(model.parameters)
    degrees = shape.degrees[:n]
    difference = PolynomialBound(1, 1.0)
    others = [difference] + [VARIABLE] * (2 * n - len(degrees))
    bounds = relation([*(PolynomialBound(d, shape.norm) for d in degrees), *others])
    minor = sum(degrees)
    minor_bits = n * (shape.norm + log2(shape.degrees[0] * max(n, 1)))
    size = Size(
        (n + 1) * bounds.weight + 2 * minor, int((n + 1) * bounds.bits + 2 * minor_bits) + 1
    )
    return _safety(size, BITS)


def safety_of_other_values(model: PolynomialMap) -> int:
    """Bits of error probability of "a parameter has several values in generic fibres" from one
    fibre of other values that is nonempty (see `one_value`).

    r + 1 forms in the coordinates, r <= n parameters, one of them with u q_j added, of degree 2 at
    least; u and the q that are left over are variables.
    """
    shape, n = _shape(model.coordinates), len(model.parameters)
    forms = sorted((*shape.degrees[: n + 1], 2), reverse=True)[: n + 1]
    norm = shape.norm + _mixing(prod(forms) ** 2, len(shape.degrees) + 1)
    bounds = relation([PolynomialBound(d, norm) for d in forms] + [VARIABLE] * (n + 2 - len(forms)))
    put_in = bounds.weight * norm + (len(forms) + 1) * log2(bounds.weight + 1)
    return _safety(Size(bounds.weight, int(bounds.bits + put_in) + 1), BITS)


def _relation_of(shape: _Shape, equations: int, combined: bool, variables: int) -> Relation:
    """The relation of so many equations, or as there are coordinates, and variables: one
    polynomial more than variables.
    """
    degrees = shape.degrees[:equations]
    norm = shape.norm + (_mixing(prod(degrees), len(shape.degrees)) if combined else 0.0)
    polynomials = [PolynomialBound(d, norm) for d in degrees]
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
