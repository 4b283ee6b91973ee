"""Plain SymPy twin of a state space at rest: its matrix of transfer functions, which parameters that
determines locally, and whether other values of one fit. No code of the package.
"""

from sympy import GF, QQ, Matrix, Poly, Rational, Symbol, eye, groebner, symbols, sympify
from sympy.polys.matrices import DomainMatrix

S = Symbol("s")
PRIME = 2147483029


def system(a, b, c):
    return tuple(Matrix(rows).applyfunc(sympify) for rows in (a, b, c))


def names_of(*matrices):
    return sorted({x.name for m in matrices for x in m.free_symbols})


def determined(a, b, c, point):
    """Rank of the derivatives of all entries at a point, and the parameters whose unit vector lies
    in their row space: dG = dC R B + C R dA R B + C R dB, R = (s - A)^-1, at more numbers s than
    any of the functions has zeros.
    """
    names = names_of(a, b, c)
    here = [m.subs(point) for m in (a, b, c)]
    slopes = [[m.diff(Symbol(n)).subs(point) for m in (a, b, c)] for n in names]
    rows = []
    for k in range(1, 4 * a.rows + 4):
        inverse = (Rational(k, 7) * eye(a.rows) - here[0]).inv()
        left, right = here[2] * inverse, inverse * here[1]
        columns = [dc * right + left * da * right + left * db for da, db, dc in slopes]
        rows += [list(entry) for entry in zip(*(list(m) for m in columns), strict=True)]
    matrix = DomainMatrix.from_Matrix(Matrix(rows)).convert_to(QQ)
    kernel = matrix.nullspace().to_Matrix()
    return matrix.rank(), [n for j, n in enumerate(names) if not any(kernel[:, j])]


def has_other(a, b, c, point, name):
    """Whether other parameters, none of them zero and `name` not the given one, give all entries
    at the point of whole numbers.
    """
    names = {n: Symbol(n) for n in names_of(a, b, c)}
    sides = []
    for values in ({}, point):
        now = [m.subs(values) for m in (a, b, c)]
        pencil = S * eye(a.rows) - now[0]
        sides.append((now[2] * pencil.adjugate() * now[1], pencil.det()))
    (n2, d2), (n1, d1) = sides
    equations = []
    for gap in n1 * d2 - n2 * d1:
        whole = gap.expand()
        if whole != 0:
            equations += [e for e in Poly(whole, S).all_coeffs() if e != 0]
    extra, product = symbols("extra_"), names[name] - point[name]
    for symbol in names.values():
        product *= symbol
    basis = groebner(
        [*equations, extra * product - 1], extra, *names.values(), domain=GF(PRIME), order="grevlex"
    )
    return basis.exprs != [1]
