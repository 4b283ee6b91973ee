"""An equation that all damped rows with force and sensor on one end mass fulfil: a resultant,
without any search.

Let G = N/D be the receptance of a row of n masses whose force and sensor are at an end, e = deg N
= 2n - 2, deg D = e + 2. Seen from the port, D/N = m s^2 + (what holds the port's mass at its own
side) + W, and W belongs to the chain of the other n - 1 masses behind its first spring and damper
k = d (s - z): W = k Z/(k + Z), where Z = C/A' belongs to the masses themselves, A' is monic of
degree e - 2, and C = m' Y with a monic Y of degree e. Hence W = P/A, P = k Y, A = k A'/m' + Y,
which is monic, and d is the leading coefficient of P. At z: P(z) = 0, A(z) = Y(z), P'(z) = d Y(z):

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
"""

from disting.algebra.fractionfree import Modular, polynomial, resultant
from disting.model.row import Row


def end_resultant(row: Row, num: list[int], den: list[int], modulus: int) -> int:
    """The resultant for a receptance modulo a prime, coefficients of the constant first; 0 where
    it says nothing.

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
        return _free(n0 * n0 * n, (n0 * n0 * d - held * n).right_shift(2), e)
    return 0 if int(d[0]) or int(d[1]) else _free(n, d.right_shift(2), e)


def _free(n: Modular, energy: Modular, e: int) -> int:
    """Res(U, V) of the module's text for N and E."""
    s = polynomial([0, 1], energy.modulus())
    a, b = int(energy[e]), int(n[e])
    u = b * energy - a * n
    top = int(u[e - 1])
    v = top * energy - a * s * s * u.derivative() + (e - 2) * a * s * u - int(energy[e - 1]) * u
    return resultant(u, v, e - 1, e - 2)
