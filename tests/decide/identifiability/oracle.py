"""Identifiability in plain SymPy: solutions counted by a Groebner basis, kernels of symbolic
Jacobians.
"""

import random

from sympy import Poly, Symbol, expand, groebner, prod, symbols, sympify
from sympy.polys.matrices import DomainMatrix

from tests.oracles.sympy_twin import summary

PRIME = 32003


def solutions(chain, modulus=PRIME, seed=1):
    """Number of non-zero parameter vectors, with multiplicities, over the closure of GF(modulus)
    (0: of the rationals) that have the transfer function of a random point; None if there are
    infinitely many.
    """
    draw = random.Random(seed)
    point = {
        name: draw.randrange(1, modulus) if modulus else draw.randrange(2, 9)
        for name in chain.parameters
    }
    names, inverse = symbols(chain.parameters), Symbol("inverse")
    equations = [_equation(entry, point, modulus) for entry in summary(chain).entries]
    system = [*(e for e in equations if e != 0), prod(names) * inverse - 1]
    field = {"modulus": modulus} if modulus else {}
    basis = groebner(system, inverse, *names, order="grevlex", **field)
    leading = [Poly(p, inverse, *names, **field).monoms(order="grevlex")[0] for p in basis.exprs]
    return _below(leading, len(names) + 1)


def _equation(entry, point, modulus):
    numerator, denominator = entry.numer.as_expr(), entry.denom.as_expr()
    top, bottom = int(numerator.subs(point)), int(denominator.subs(point))
    if modulus:
        top, bottom = top * pow(bottom, -1, modulus) % modulus, 1
    return expand(bottom * numerator - top * denominator)


def _below(leading, size):
    """Number of monomials that no leading one divides."""
    if not all(any(m[i] and sum(map(bool, m)) == 1 for m in leading) for i in range(size)):
        return None
    start = (0,) * size
    seen, waiting = {start}, [start]
    while waiting:
        here = waiting.pop()
        for i in range(size):
            there = tuple(e + (i == j) for j, e in enumerate(here))
            if there not in seen and not any(
                all(a >= b for a, b in zip(there, m, strict=True)) for m in leading
            ):
                seen.add(there)
                waiting.append(there)
    return len(seen)


def symbolic_kernel(chain):
    """Field of fractions of the parameters, and the kernel of the Jacobian over it: one row a
    vector.
    """
    entries = summary(chain).entries
    field = entries[0].field
    rows = [[entry.diff(x) for x in field.gens] for entry in entries]
    return field, DomainMatrix(rows, (len(rows), len(field.gens)), field.to_domain()).nullspace()


def derivative_along(field, kernel, text):
    """Derivatives of a formula along all kernel vectors."""
    function = field.from_expr(
        sympify(text.replace("^", "**"), locals={str(s): s for s in field.symbols})
    )
    gradient = [function.diff(x) for x in field.gens]
    return [
        sum((g * v for g, v in zip(gradient, vector, strict=True)), field.zero)
        for vector in kernel.to_list()
    ]
