"""How large an algebraic relation between k + 1 polynomials in k variables has to be: its degree,
and its coefficients.

Theorem. Let q_0, .., q_k be polynomials in x_1, .., x_k with integer coefficients, q_j of degree
d_j >= 1 at most (constants are allowed), ||q_j|| the sum of the sizes of its coefficients, and
delta = d_0 d_1 .. d_k. There is a polynomial E(y_0, .., y_k) with integer coefficients, not zero,
such that E(q_0, .., q_k) = 0, with d_0 a_0 + .. + d_k a_k <= delta for each of its monomials y^a
(O. Perron, Algebra I, 1927), and with a Mahler measure of

    log M(E) <= sum_j delta/d_j log(||q_j|| + 2) + delta/2 log (k+1)!,      M(E) = exp of the mean
    of log |E| over |y_j| = 1

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

    R(y, e) = Res(Q_0 - y_0 x_0^d_0, Q_1 - y_1 x_0^d_1 + e x_1^d_1, .., Q_k - y_k x_0^d_k + e
    x_k^d_k).

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

ROUNDING = 1 + 2.0**-40  # of a sum of logarithms in floating point


@dataclass(frozen=True, slots=True)
class Bounded:
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


def relation(polynomials: Sequence[Bounded]) -> Relation:
    """Bounds of a relation between k + 1 polynomials in k variables, and of each of its factors.

    >>> relation([Bounded(2, 0.0), Bounded(3, 0.0)]).weight
    6
    """
    delta, count = prod(q.degree for q in polynomials), len(polynomials)
    shares = sum((_log_sum(q.norm) + 1) / q.degree for q in polynomials)
    return Relation(delta, delta * (shares + lgamma(count + 1) / log(2) / 2) * ROUNDING)


def _log_sum(norm: float) -> float:
    """log2(2**norm + 2)."""
    return norm + log2(1 + 2.0 ** (1 - norm))
