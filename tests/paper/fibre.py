"""A fibre, in plain SymPy: have two models one transfer function at a random point of the left one?

For models of equal dimension, an empty fibre over a random point proves them distinguishable (but
for the chance that the point was special): were their sets of transfer functions the same, a
generic one of the left would occur on the right.
"""

import random

from sympy import Symbol, expand, groebner, prod, symbols

from tests.oracles.sympy_twin import summary

PRIME = 32003


def fibre_is_empty(left, right, seed=1):
    """Whether no non-zero right parameters, over the closure of GF(PRIME), give the left model
    at a random point.
    """
    draw = random.Random(seed)
    point = {name: draw.randrange(1, PRIME) for name in left.parameters}
    targets = [_residue(entry, point) for entry in summary(left).entries]
    equations = [
        expand(entry.numer.as_expr() - target * entry.denom.as_expr())
        for entry, target in zip(summary(right).entries, targets, strict=True)
    ]
    names, inverse = symbols(right.parameters), Symbol("inverse")
    masses = prod(name for name in names if str(name).startswith("m"))
    system = [*(e for e in equations if e != 0), masses * inverse - 1]
    return groebner(system, inverse, *names, modulus=PRIME, order="grevlex").exprs == [1]


def _residue(entry, point):
    numerator, denominator = (
        int(part.as_expr().subs(point)) for part in (entry.numer, entry.denom)
    )
    return numerator * pow(denominator, -1, PRIME) % PRIME
