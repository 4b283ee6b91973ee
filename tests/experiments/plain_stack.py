"""Plain SymPy twin of a measured chain: its dynamic stiffness matrix by indices alone, and one
fibre of the stacked coefficients by a Gröbner basis modulo a prime. No code of the package.
"""

from sympy import GF, QQ, Matrix, Poly, Rational, Symbol, groebner, symbols, zeros
from sympy.polys.matrices import DomainMatrix

S = Symbol("s")
PRIME = 2147483029


def stiffness(chain, values, locked=(), inertias=None, springs=None, brakes=None):
    """A(s) of the masses that move, and their numbers; `values` of parameters by name."""
    n = chain.n_masses
    whole = zeros(n + 1, n + 1)
    for i in range(1, n + 1):
        mass = values[f"m{i}"] + Rational(str((inertias or {}).get(i, 0)))
        whole[i, i] += mass * S**2 + Rational(str((springs or {}).get(i, 0)))
        whole[i, i] += Rational(str((brakes or {}).get(i, 0))) * S
    for i in chain.ground_dampers:
        whole[i, i] += values[f"b{i}"] * S
    for a in (i for i in range(n) if i != chain.gap):
        law = values[f"k{a}{a + 1}"] + (values[f"d{a}{a + 1}"] * S if chain.damped else 0)
        for x, y, sign in ((a, a, 1), (a + 1, a + 1, 1), (a, a + 1, -1), (a + 1, a, -1)):
            whole[x, y] += sign * law
    moving = [i for i in range(1, n + 1) if i not in locked]
    return whole.extract(moving, moving), moving


def keywords(experiment):
    """An experiment of the package as the functions here take it."""
    said = {"force": experiment.force, "sensor": experiment.sensor, "locked": ()}
    for change in experiment.changes:
        name, at, size = change.kind.argument, change.place, change.size
        said[name] = (*said[name], at) if size is None else {**said.get(name, {}), at: size}
    return said


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
    num, den = total * S**chain.quantity.order, matrix.det(method="berkowitz") * lag
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


def responses(chain, values, at, **experiment):
    """G at the number `at`, and its derivatives by the parameters: A(s) is linear in each one, and
    dG = -x' dA y with A x = sensor, A y = force; a lag and the sensor's order are factors.
    """
    every = ("locked", "inertias", "springs", "brakes")
    changes = {k: experiment[k] for k in every if k in experiment}
    matrix, moving = stiffness(chain, values, **changes)
    act = experiment.get("force") or (chain.act_plus, chain.act_minus)
    meas = experiment.get("sensor") or (chain.meas_plus, chain.meas_minus)
    ends = [[sum(w * (i == p) for p, w in zip(e, (1, -1), strict=True)) for i in moving]
            for e in (act, meas)]  # fmt: skip
    inverse = matrix.subs(S, at).inv()
    y, x = (inverse * Matrix(e) for e in ends)
    factor = Rational(at) ** chain.quantity.order / (1 + values.get("T1", 0) * at)
    plain = sum(a * b for a, b in zip(ends[1], y, strict=True))
    slopes = []
    for name in chain.parameters:
        if name == "T1":
            slopes.append(-at * factor**2 / Rational(at) ** chain.quantity.order * plain)
            continue
        unit = {n: int(n == name) for n in values}
        slope = stiffness(chain, unit, locked=changes.get("locked", ()))[0].subs(S, at)
        slopes.append(-factor * (x.T * slope * y)[0])
    return factor * plain, slopes


def determined(chain, point, experiments):
    """Rank of all responses' derivatives at a point, and the parameters whose unit vector lies in
    their row space: more numbers s than any of the functions has zeros.
    """
    numbers = [Rational(k, 3) for k in range(1, 4 * chain.n_masses + 6)]
    rows = [responses(chain, point, at, **e)[1] for e in experiments for at in numbers]
    matrix = DomainMatrix.from_Matrix(Matrix(rows)).convert_to(QQ)
    n, rank = len(chain.parameters), matrix.rank()
    kernel = matrix.nullspace().to_Matrix()
    seen = [name for j, name in enumerate(chain.parameters) if not any(kernel[:, j])] if rank < n \
        else list(chain.parameters)  # fmt: skip
    return rank, seen


def has_other(chain, point, experiments, name):
    """Whether other parameters, none of them zero and `name` not the given one, give all transfer
    functions at the point.
    """
    names = {n: Symbol(n) for n in chain.parameters}
    equations = []
    for experiment in experiments:
        n1, d1 = transfer(chain, point, **experiment)
        n2, d2 = transfer(chain, names, **experiment)
        gap = Poly(n1 * d2 - n2 * d1, S, *names.values()).clear_denoms()[1]
        equations += Poly(gap.as_expr(), S).all_coeffs()
    extra, product = symbols("extra"), names[name] - point[name]
    for symbol in names.values():
        product *= symbol
    whole = [e for e in equations if e != 0] + [extra * product - 1]
    basis = groebner(whole, extra, *names.values(), domain=GF(PRIME), order="grevlex")
    return basis.exprs != [1]
