"""All parameter vectors of a network or a chain with the response that it has at one point, by plain
SymPy: a Groebner basis over the rational numbers, roots isolated by Sturm sequences, signs of the
parameters at each root. Nothing of the package decides anything here.
"""

from dataclasses import dataclass
from fractions import Fraction

import sympy as sp
from sympy.polys.matrices import DomainMatrix

from tests.oracles.plain_network import plain

S = sp.Symbol("s")
WIDTH = sp.Rational(1, 10**6)


@dataclass(frozen=True)
class Found:
    """Numbers of solutions over complex, real and positive parameters, and by parameter whether
    all real, and all positive solutions have the value of the point.
    """

    complex: int
    real: int
    positive: int
    one_real: dict[str, bool]
    one_positive: dict[str, bool]


def response(network):
    """Numerator and denominator of its transfer function, as polynomials in s."""
    model = plain(network)
    read = lambda text: sp.sympify(text.replace("^", "**"), locals=names)  # noqa: E731
    names = {name: sp.Symbol(name) for name in (*model.parameters, "s")}
    rows = [[*map(read, row), read(b)] for row, b in zip(model.dynamics, model.force, strict=True)]
    last = [*(-read(c) for c in model.output), sp.Integer(0)]
    size = len(rows)
    whole = _determinant([*rows, last])
    part = _determinant([row[:size] for row in rows])
    return sp.fraction(sp.cancel(read(model.above) * whole / part))


def _determinant(rows):
    matrix = DomainMatrix.from_Matrix(sp.Matrix(rows)).to_field()
    return matrix.domain.to_sympy(matrix.to_dense().det())


def solutions(function, parameters, point):
    """The solutions where the parameters are those of the point."""
    numerator, denominator = (sp.Poly(side, S) for side in function)
    lead = denominator.LC()
    names = sp.symbols(parameters)
    values = {name: sp.Rational(point[str(name)]) for name in names}
    inverse, form = sp.symbols("inverse form")
    own_lead = lead.subs(values)
    equations = [
        sp.expand(c * own_lead - c.subs(values) * lead)
        for c in (*numerator.all_coeffs(), *denominator.all_coeffs()[1:])
    ]
    weights = [3 * k * k + 7 * k + 1 for k in range(len(names))]
    system = [
        *(e for e in equations if e != 0),
        inverse * lead - 1,
        form - sum(w * x for w, x in zip(weights, names, strict=True)),
    ]
    order = (inverse, *names, form)
    basis = sp.groebner(system, *order, order="grevlex")
    shaped = basis.fglm("lex")
    by_lead = {sp.Poly(g, *order).monoms(order="lex")[0]: g for g in shaped.exprs}
    polynomial = sp.Poly(next(g for g in shaped.exprs if g.free_symbols <= {form}), form)
    coordinates = {}
    for at, name in enumerate(order[:-1]):
        unit = tuple(int(i == at) for i in range(len(order)))
        assert unit in by_lead, "the linear form does not tell the solutions apart"
        found = sp.Poly(by_lead[unit], *order)
        coordinates[name] = sp.Poly(name - found.as_expr() / found.coeff_monomial(unit), form)
    return _counted(polynomial, {str(n): coordinates[n] for n in names}, point)


def _counted(polynomial, coordinates, point):
    square_free = sp.Poly(sp.sqf_part(polynomial), polynomial.gen)
    real, vectors = 0, []
    for (low, high), _ in square_free.intervals(eps=WIDTH):
        real += 1
        vectors.append(
            {name: _sign(square_free, g, low, high) for name, g in coordinates.items()}
            | {
                f"{name}!": _sign(square_free, g - point[name], low, high)
                for name, g in coordinates.items()
            }
        )
    positive = [v for v in vectors if all(v[name] > 0 for name in coordinates)]
    return Found(
        complex=square_free.degree(),
        real=real,
        positive=len(positive),
        one_real={n: all(v[f"{n}!"] == 0 for v in vectors) for n in coordinates},
        one_positive={n: all(v[f"{n}!"] == 0 for v in positive) for n in coordinates},
    )


def _sign(polynomial, g, low, high):
    """Sign of g at the only root of a polynomial in an interval."""
    common = sp.gcd(polynomial, g)
    if g.is_zero or (common.degree() > 0 and common.count_roots(low, high)):
        return 0
    while g.degree() > 0 and g.count_roots(low, high):
        if low == high:
            break
        low, high = polynomial.refine_root(low, high, eps=(high - low) / 16)
    return int(sp.sign(g.eval((low + high) / 2)))


def points(parameters, draw, count):
    """Random positive fractions of different sizes."""
    for _ in range(count):
        yield {
            name: Fraction(draw.randint(1, 997), draw.choice((7, 11, 13, 17, 19)))
            for name in parameters
        }
