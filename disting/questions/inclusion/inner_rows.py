"""An equation of all damped rows with force and sensor on one mass that has a single mass beyond
it: a resultant of resultants.

Let G = N/D, e = deg N = 2n - 2. Cut at the port's mass, the row falls into two sides, so D/N = m
s^2 + W_L + W_R and N is, up to a factor, the product of the denominators of W_L and W_R. Let the
right side have a free end and be one mass m' behind a spring and damper k: W = k m' s^2/(m' s^2 +
k), so W/s^2 = m' (1 + m' s^2/k)^-1 = m' + O(s^2). With rho_z = D(z)/N'(z), the residues of D/N,

    W/s^2 = sum rho_z/(z^2 (s - z))  over the two zeros z of m' s^2 + k,

as W = O(s^2) is a linear polynomial plus sum rho_z/(s - z). The derivative at 0 of the sum is 0:
-sum rho_z/z^4 = 0. So with

    x_z = D(z)/(z^4 N'(z)),    R(x) = Res_s(N, x s^4 N' - D),

R has two roots x_z that add up to 0, in general not zero themselves. Let R(x) = P(x^2) + x Q(x^2):
P and Q have a common root, so their resultant vanishes for generic models of the row, thus for
all, and for all their limits.

So that this says something where N has a smaller degree, s^4 N' is replaced by T = s^4 N' - e s^3
N, which is the same at the zeros of N and has no larger degree, e + 2, than D; R is the resultant
for the formal degrees e and e + 2. In a free row D = s^2 E: there R(x) = Res(N, x (s^2 N' - e s N)
- E), formal degrees e and e. W_L/s^2 = m'' + O(s^2) holds for its other side as well (a row
without a wall keeps its momentum), so all x_z add up to 0: R_(e-1) = 0, and the formal degree of Q
is e/2 - 2, else e/2 - 1.
"""

from disting.algebra.fractionfree import Modular, interpolated, polynomial, resultant
from disting.model.row import Row


def inner_resultant(row: Row, num: list[int], den: list[int], modulus: int) -> int:
    """The resultant for a receptance modulo a prime, coefficients of the constant first; 0 where
    it says nothing.

    What is not 0 is no receptance of the row, and no limit of its receptances.
    """
    e, n = 2 * row.n_masses - 2, row.n_masses
    alone = row.a == row.b and (row.a == n - 1 or (not row.grounded and row.a == 2))
    if not row.damped or row.ground_dampers or not alone or e < (2 if row.grounded else 4):
        return 0
    if len(num) > e + 1 or len(den) != e + 3 or not (row.grounded or den[0] == den[1] == 0):
        return 0
    numerator, denominator = (
        polynomial(num, modulus),
        polynomial(den if row.grounded else den[2:], modulus),
    )
    r = _in_x(numerator, denominator, e, 4 if row.grounded else 2, modulus)
    if row.grounded:
        return resultant(
            polynomial(r[::2], modulus), polynomial(r[1::2], modulus), e // 2, e // 2 - 1
        )
    if r[e - 1]:
        return r[e - 1]
    return resultant(
        polynomial(r[::2], modulus), polynomial(r[1 : e - 1 : 2], modulus), e // 2, e // 2 - 2
    )


def _in_x(n: Modular, d: Modular, e: int, power: int, modulus: int) -> list[int]:
    """Coefficients of R, interpolated."""
    t = n.derivative().left_shift(power) - e * n.left_shift(power - 1)
    top = e + power - 2
    return interpolated([resultant(n, x * t - d, e, top) for x in range(e + 1)], modulus)
