"""Plain SymPy twin of a measured chain: its dynamic stiffness matrix by indices alone, and one
fibre of the stacked coefficients by a Gröbner basis modulo a prime. No code of the package.
"""

from sympy import GF, QQ, Poly, Rational, Symbol, groebner, symbols, zeros

S = Symbol("s")
PRIME = 2147483029


def stiffness(chain, values, locked=(), inertias=None, springs=None):
    """A(s) of the masses that move, and their numbers; `values` of parameters by name."""
    n = chain.n_masses
    whole = zeros(n + 1, n + 1)
    for i in range(1, n + 1):
        mass = values[f"m{i}"] + Rational(str((inertias or {}).get(i, 0)))
        whole[i, i] += mass * S**2 + Rational(str((springs or {}).get(i, 0)))
    for i in chain.ground_dampers:
        whole[i, i] += values[f"b{i}"] * S
    for a in (i for i in range(n) if i != chain.gap):
        law = values[f"k{a}{a + 1}"] + (values[f"d{a}{a + 1}"] * S if chain.damped else 0)
        for x, y, sign in ((a, a, 1), (a + 1, a + 1, 1), (a, a + 1, -1), (a + 1, a, -1)):
            whole[x, y] += sign * law
    moving = [i for i in range(1, n + 1) if i not in locked]
    return whole.extract(moving, moving), moving


def transfer(chain, values, *, force=None, sensor=None, **changes):
    """Numerator and denominator of G(s), expressions, common factors not cancelled."""
    matrix, moving = stiffness(chain, values, **changes)
    act = force or (chain.act_plus, chain.act_minus)
    meas = sensor or (chain.meas_plus, chain.meas_minus)
    adjugate, total = matrix.adjugate(method="berkowitz"), 0
    for i, x in zip(meas, (1, -1), strict=True):
        for j, y in zip(act, (1, -1), strict=True):
            if i in moving and j in moving:
                total += x * y * adjugate[moving.index(i), moving.index(j)]
    lag = 1 + values["T1"] * S if chain.lag else 1
    num, den = total * S**chain.sensor.order, matrix.det(method="berkowitz") * lag
    return num.expand() if total != 0 else 0, den.expand()


def coefficients(num, den, domain=QQ):
    """Those of numerator and monic denominator in lowest terms, from s^0 on; ([], [1]) for 0."""
    top, bottom = Poly(num, S, domain=domain), Poly(den, S, domain=domain)
    common = top.gcd(bottom)
    top, bottom = top.quo(common), bottom.quo(common)
    lead = bottom.LC()
    scaled = (p.mul_ground(1 / Rational(lead)) if domain == QQ else p for p in (top, bottom))
    return [p.all_coeffs()[::-1] if p else [] for p in scaled]


def has_equivalent(given, point, searched):
    """Whether parameters of the searched chain, none of them zero, give all transfer functions of
    the given one at the point: 1 is in no ideal of their equations.

    `given`, `searched`: (chain, its experiments as keywords); `point`: numbers by name.
    """
    names = {name: Symbol(name) for name in searched[0].parameters}
    equations = []
    for here, there in zip(given[1], searched[1], strict=True):
        n1, d1 = transfer(given[0], point, **here)
        n2, d2 = transfer(searched[0], names, **there)
        gap = Poly(n1 * d2 - n2 * d1, S, *names.values()).clear_denoms()[1]
        equations += Poly(gap.as_expr(), S).all_coeffs()
    product, extra = 1, symbols("extra")
    for symbol in names.values():
        product *= symbol
    whole = [e for e in equations if e != 0] + [extra * product - 1]
    basis = groebner(whole, extra, *names.values(), domain=GF(PRIME), order="grevlex")
    return basis.exprs != [1]
