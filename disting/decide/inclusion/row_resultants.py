"""Equations that all damped rows with force and sensor on one mass fulfil, and all their limits:
resultants, without any search.

**At an end mass** (`end_resultant`). Let G = N/D be the receptance of a row of n masses whose force
and sensor are at an end, e = deg N = 2n - 2, deg D = e + 2. Seen from the port, D/N = m s^2 + (what
holds the port's mass at its own side) + W, and W belongs to the chain of the other n - 1 masses
behind its first spring and damper k = d (s - z): W = k Z/(k + Z), where Z = C/A' belongs to the
masses themselves, A' is monic of degree e - 2, and C = m' Y with a monic Y of degree e. Hence W =
P/A, P = k Y, A = k A'/m' + Y, which is monic, and d is the leading coefficient of P. At z: P(z) =
0, A(z) = Y(z), P'(z) = d Y(z):

    P(z) = 0,   d A(z) = P'(z),   d the leading coefficient of P.
    (1)

N is A up to the factor b = b_e; let a = a_(e+2), so that m = a/b. Three kinds of rows:

* Nothing at its own side (a free row, the port at either end): D = s^2 E. The other end is free
  too, and with U = b E - a N, P = s^2 U/b^2. z is not 0, so U(z) = 0, and as d = u/b^2, u =
  U_(e-1), (1) says u N(z) = b z^2 U'(z).
* A wall at its own side (port at mass 1): D/N = m s^2 + T/N_0^2 + W with T = (D_1 N_0 - D_0 N_1) s
  + D_0 N_0, for W = O(s^2). So E = (N_0^2 D - T N)/s^2 is a polynomial, and everything is as
  before with N_0^2 N instead of N.
* A wall at the other end (port at mass n): U = b D - a s^2 N, of degree e + 1, P = U/b^2, and (1)
  says u N(z) = b U'(z).

So the resultant of U and u N - b t U', t = s^2 or 1, vanishes for all models of the row, and for
all their limits. It also does so where u = 0, which need not be a limit. So something better is
taken. In the third case let V = u N - b U', of degree e with the leading coefficient -e b u. The
coefficients of s^(e+1) and s^e in e b U + s V are e b u - e b u = 0 and e b U_e + u N_(e-1) - e b
U_e = u N_(e-1), so

    U~ = e b (e b U + s V) + N_(e-1) V

has no larger degree than e - 1, and V and U~ have the root z in common. In the first two cases,
from U(z) = 0 follows b E(z) = a N(z), and b (u E - a z^2 U')(z) = a (u N - b z^2 U')(z) = 0. The
polynomial

    V = u E - a s^2 U' + (e - 2) a s U - E_(e-1) U

vanishes at z, too, and its coefficients of s^e and s^(e-1) are u a - a (e-1) u + (e-2) a u = 0 and
u E_(e-1) - a (e-2) U_(e-2) + (e-2) a U_(e-2) - E_(e-1) u = 0. So the resultant of U and V, as
polynomials of the formal degrees e - 1 and e - 2, vanishes for all models with b != 0, so for all
of the row, and for all their limits.

**At any other mass** (`inner_resultant`): a resultant of a resultant. Let G = N/D, e = deg N = 2n -
2. Cut at the port's mass, the row falls into two sides, so D/N = m s^2 + W_L + W_R and N is, up to
a factor, the product of the denominators of W_L and W_R. Let the right side have a free end and k
masses: its denominator has 2k zeros z, distinct and not 0 for generic models. With rho_z =
D(z)/N'(z), the residues of D/N,

    W/s^2 = sum rho_z/(z^2 (s - z))  over the 2k zeros z,

as W is a linear polynomial plus sum rho_z/(s - z), for at high frequencies the first spring and
damper carry the force, and W = O(s^2). Moreover W/s^2 = m'' + O(s^2): the force is s^2 times the
sum of m_i x_i, and masses that are held by nothing else move like the port but for O(s^2). So the
derivative of the sum at 0 is 0: -sum rho_z/z^4 = 0. With

    x_z = D(z)/(z^4 N'(z)),    R(x) = Res_s(N, x s^4 N' - D),

2k of the e roots x_z of R add up to 0. So the product of the sums of all 2k of the roots vanishes
for generic models of the row. It is symmetric in the roots, and of degree c = C(e-1, 2k-1) in each:
times the c-th power of the leading coefficient R_e it is a polynomial in the coefficients of R, and
vanishes for all models and all their limits.

For a result where N has a smaller degree, s^4 N' is replaced by T = s^4 N' - e s^3 N, which is the
same at the zeros of N and has no larger degree, e + 2, than D; R is the resultant for the formal
degrees e and e + 2. In a free row D = s^2 E: there R(x) = Res(N, x (s^2 N' - e s N)
- E), formal degrees e and e. Its other side has a free end too, so all x_z add up to 0: R_(e-1) =
0. On that hyperplane c = C(e-2, 2k-1) is enough: where R_e tends to 0 and nothing else, two roots
grow, each as (-R_(e-2)/R_e)^(1/2) but for the sign, and as many sums of 2k as hold one of them grow
with it, 2 C(e-2, 2k-1). What has no pole at generic points of R_e = 0 is a polynomial in the
others. Where R_e = 0, its value is that on the line R + t x^e at t = 0.
"""

from itertools import combinations
from math import comb

from disting.algebra.determinants import Modular, interpolate, polynomial, resultant
from disting.algebra.groebner.modular import matrix
from disting.model.row import Row

LEAST = 4  # zeros of a free row with masses on both sides of its port
MOST_SUMS = 250  # a determinant of so many rows


def end_resultant(row: Row, num: list[int], den: list[int], modulus: int) -> int:
    """The resultant for a receptance modulo a prime, coefficients of the constant first; 0 where it
    is inconclusive.

    What is not 0 is no receptance of the row, and no limit of its receptances.
    """
    e = 2 * row.n_masses - 2
    at_end = row.a == row.b and row.a in (1, row.n_masses)
    if (
        not row.damped
        or row.ground_dampers
        or not at_end
        or e == 0
        or len(num) > e + 1
        or len(den) != e + 3
    ):
        return 0
    n, d = polynomial(num, modulus), polynomial(den, modulus)
    if row.grounded and row.a == row.n_masses:
        a, b = int(d[e + 2]), int(n[e])
        u = b * d - a * n.left_shift(2)
        v = int(u[e + 1]) * n - b * u.derivative()
        lower = e * b * (e * b * u + v.left_shift(1)) + int(n[e - 1]) * v
        return resultant(v, lower, e, e - 1)
    if row.grounded:
        n0, n1, d0, d1 = (int(p[i]) for p in (n, d) for i in (0, 1))
        held = polynomial([d0 * n0 % modulus, (d1 * n0 - d0 * n1) % modulus], modulus)
        return end_equation(n0 * n0 * n, (n0 * n0 * d - held * n).right_shift(2), e)
    return 0 if int(d[0]) or int(d[1]) else end_equation(n, d.right_shift(2), e)


def end_equation(n: Modular, energy: Modular, e: int) -> int:
    """Res(U, V) of the module's text for N and E of a free row with its port at an end."""
    s = polynomial([0, 1], energy.modulus())
    a, b = int(energy[e]), int(n[e])
    u = b * energy - a * n
    top = int(u[e - 1])
    v = top * energy - a * s * s * u.derivative() + (e - 2) * a * s * u - int(energy[e - 1]) * u
    return resultant(u, v, e - 1, e - 2)


def inner_resultant(row: Row, num: list[int], den: list[int], modulus: int) -> int:
    """The product of sums for a receptance modulo a prime, coefficients of the constant first; 0
    where it is inconclusive.

    What is not 0 is no receptance of the row, and no limit of its receptances.
    """
    e, beyond = 2 * row.n_masses - 2, row.n_masses - row.a
    beyond = beyond if row.grounded else min(beyond, row.a - 1)
    if row.a != row.b or not row.damped or row.ground_dampers or not beyond:
        return 0
    if len(num) > e + 1 or len(den) != e + 3 or not (row.grounded or den[0] == den[1] == 0):
        return 0
    if (not row.grounded and e < LEAST) or comb(e, 2 * beyond) > MOST_SUMS:
        return 0
    numerator, denominator = (
        polynomial(num, modulus),
        polynomial(den if row.grounded else den[2:], modulus),
    )
    r = _in_x(numerator, denominator, e, 4 if row.grounded else 2, modulus)
    if row.grounded:
        return _sums(r, 2 * beyond, comb(e - 1, 2 * beyond - 1), modulus)
    return r[e - 1] or _sums(r, 2 * beyond, comb(e - 2, 2 * beyond - 1), modulus)


def _sums(r: list[int], size: int, power: int, modulus: int) -> int:
    """The product of all sums of so many roots of r, times a power of its leading coefficient;
    where that is 0, by the values for leading coefficients 1, 2, ..
    """
    if r[-1]:
        return _product_of_sums(r, size, modulus) * pow(r[-1], power, modulus) % modulus
    values = [_sums([*r[:-1], t], size, power, modulus) for t in range(1, power + 2)]
    return int(polynomial(interpolate(values, modulus), modulus)(-1))


def _product_of_sums(r: list[int], size: int, modulus: int) -> int:
    """Determinant of what the companion matrix of r does to exterior products of so many vectors,
    one factor after the other: its eigenvalues are the sums of eigenvalues.
    """
    e, scale = len(r) - 1, -pow(r[-1], -1, modulus)
    last = [(i, scale * x % modulus) for i, x in enumerate(r[:-1]) if x]
    products = list(combinations(range(e), size))
    place = {chosen: i for i, chosen in enumerate(products)}
    whole = [[0] * len(products) for _ in products]
    for column, chosen in enumerate(products):
        for at, i in enumerate(chosen):
            rest = chosen[:at] + chosen[at + 1 :]
            for to, c in [(i + 1, 1)] if i + 1 < e else last:
                if to not in rest:
                    position = sum(x < to for x in rest)
                    line = place[(*rest[:position], to, *rest[position:])]
                    whole[line][column] += (-1) ** (at + position) * c
    return int(matrix(len(whole), len(whole), [x for y in whole for x in y], modulus).det())


def _in_x(n: Modular, d: Modular, e: int, power: int, modulus: int) -> list[int]:
    """Coefficients of R, interpolated."""
    t = n.derivative().left_shift(power) - e * n.left_shift(power - 1)
    top = e + power - 2
    return interpolate([resultant(n, x * t - d, e, top) for x in range(e + 1)], modulus)
