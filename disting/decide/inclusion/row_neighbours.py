"""An equation that all free damped rows of n masses with the force on an end mass and the sensor
on the next one fulfil, and their limits: no search.

Let G = N/D, D = s^2 E, deg N = 2n - 3, deg E = 2n - 2, and c = d (s - t) the joint between both
masses. Let m be the end mass, B the dynamic stiffness of the other masses, at the sensor's mass, B
= s^2 Q, Q = E_R/N_R: they are a row of n - 1 masses with force and sensor at its end. Then N = c
N_R, and

    D/N = m s^2 + (1 + m s^2/c) B,   so   E/N = m + T Q,   T = g/(s - t),   g = s - t + r s^2,

with r = m/d. t is a root of N. Let y_z = E(z)/N'(z), the residues of E/N, and q the quotient of
their leading coefficients. Q is a constant m_b plus what has the residues y_z/T(z) at the roots z
of N_R. Compared at high frequencies, r m_b = q; the residue at t is r t^2 Q(t) = y_t, so

    y_t - t^2 q + r t^2 sum y_z/g(z) = 0,  over the roots z of N_R,                             (1)

and r Q is q + r sum y_z (z - t)/(g(z) (s - z)), so E_R is q N_R + r P up to a factor, for the
polynomial P = E/g modulo N_R, N being monic, as that has the values of the sum at all z. Rows with
force and sensor at the end fulfil an equation in N_R and E_R, homogeneous in each
(`row_resultants`):

    Res(U, V) = 0  of N_R and q N_R + r P.                                                      (2)

Times powers of the product of all g(z), both are polynomials in r, of the degrees e and e (3e - 4),
e = 2n - 4; read as forms in m and d, g(z) = d (z - t) + m z^2, they hold for all models.

Theorem. Let n/s^2 E be in lowest terms, with numerator and denominator of full degree and distinct
roots of n, none of them 0. If it is a limit of receptances of the row, the forms (1) and (2) have a
common root (m : d) for one root t of n.

Proof. Along models whose pairs (N : D) converge to it, the roots of N converge to those of n; for
models of a subsequence t converges to one of these, and (m : d) in the projective line. The
coefficients of both forms are continuous in N, E and t, as long as the roots of N are distinct and
not 0, so both forms vanish at the limits.

So their resultants, for the formal degrees, of all t have the product 0. If n is irreducible over
Q(p), all t are conjugate, and one resultant that is not 0, at a root in the field modulo a prime,
refutes limits, without any chance. That n is irreducible is proven modulo a prime.
"""

from collections.abc import Iterable

from disting.algebra.determinants import Modular, interpolate, polynomial, resultant
from disting.decide.inclusion.row_resultants import end_equation
from disting.model.row import Row

SIZES = range(4, 8)  # masses of rows: of three the equation of the end says nothing
RowDraw = tuple[list[int], list[int], int]
"""Coefficients of numerator and denominator at a point, the constant first, modulo a prime."""


def are_no_limits(row: Row, points: Iterable[RowDraw]) -> bool:
    """Return True if receptances at random points prove that generic receptances are not limits of
    those of the row.
    """
    ends = ({1, 2}, {row.n_masses - 1, row.n_masses})
    if row.grounded or not row.damped or row.ground_dampers or {row.a, row.b} not in ends:
        return False
    if row.n_masses not in SIZES:
        return False
    whole = is_apart = False
    for num, den, modulus in points:
        n = polynomial(num, modulus)
        if (n.degree(), len(den)) != (2 * row.n_masses - 3, 2 * row.n_masses + 1) or not den[-1]:
            return False
        if den[0] or den[1]:
            return False
        factors = [f for f, _ in n.factor()[1]]
        whole = whole or len(factors) == 1
        linear = next((f for f in factors if f.degree() == 1), None)
        if linear is not None and not is_apart:
            root = -int(linear[0]) * pow(int(linear[1]), -1, modulus) % modulus
            is_apart = _has_no_common_root(n, polynomial(den[2:], modulus), root)
            if not is_apart:
                return False
        if whole and is_apart:
            return True
    return False


def _has_no_common_root(n: Modular, energy: Modular, t: int) -> bool:
    """Return True if the forms (1) and (2) have no common root, at this root of the numerator."""
    modulus, lead = n.modulus(), int(n[n.degree()])
    scale = pow(lead, -1, modulus)
    n, energy = n * scale, energy * scale
    rest = n // polynomial([-t, 1], modulus)
    if not int(n[0]) or any(n.gcd(f).degree() > 0 for f in (n.derivative(), energy)):
        return False  # a root twice, or not in lowest terms
    e = rest.degree()
    degree = (3 * e - 4) * e
    try:
        values = [_forms(rest, energy, t, r) for r in range(1, degree + 2)]
    except ZeroDivisionError:
        return False
    first, second = (
        polynomial(interpolate(side, modulus), modulus)
        for side in ([v for v, _ in values[: e + 1]], [v for _, v in values])
    )
    return bool(resultant(first, second, e, degree))


def _forms(rest: Modular, energy: Modular, t: int, r: int) -> tuple[int, int]:
    """Both forms at m = r, d = 1, for N_R = `rest` and a monic numerator. Raises ZeroDivisionError
    where a g(z) is 0.
    """
    modulus, e = rest.modulus(), rest.degree()
    joint, g = polynomial([-t, 1], modulus), polynomial([-t, 1, r], modulus)
    size, top = resultant(rest, g, e, 2), int(energy[e + 2])
    energy_at = int(energy(t)) * pow(int(rest(t)), -1, modulus)
    # the residues of F/N_R sum to the coefficient of s^(e-1) in F modulo N_R
    total = int((energy * _inverse(joint * g, rest) % rest)[e - 1])
    first = size * (energy_at + t * t * (r * total - top)) % modulus
    return first, end_equation(
        rest, (top * rest + r * (energy * _inverse(g, rest) % rest)) * size, e
    )


def _inverse(f: Modular, of: Modular) -> Modular:
    """f^-1 modulo another polynomial."""
    common, inverse, _ = (f % of).xgcd(of)
    if common.degree():
        raise ZeroDivisionError("no inverse")
    return inverse * pow(int(common[0]), -1, of.modulus())
