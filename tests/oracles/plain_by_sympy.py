"""The truth of a pair of plain models by SymPy alone, where Singular is not installed: slower, so
it is given small models.

Ranks of the Jacobian matrices at a random point modulo 2^31 - 1, and a Groebner basis of the fibre
over a random point. It runs in a process of its own, which ends when the time is up: `python -m
tests.oracles.plain_by_sympy`, question and answer as JSON.
"""

import json
import subprocess
import sys
from dataclasses import asdict
from random import Random

import sympy as sp

from tests.oracles.singular import PRIME

S, T = sp.symbols("s t")


def same(left, right, draw: Random, seconds: float = 60.0) -> bool | None:
    """Whether two `plain_models.Plain` are indistinguishable over complex parameters; None if
    the time is up.
    """
    question = json.dumps(
        [asdict(left.renamed("p")), asdict(right.renamed("q")), draw.randrange(PRIME)]
    )
    command = [sys.executable, "-m", "tests.oracles.plain_by_sympy"]
    try:
        done = subprocess.run(
            command, input=question, capture_output=True, text=True, timeout=seconds, check=True
        )
    except subprocess.TimeoutExpired:
        return None
    return json.loads(done.stdout)


def decided(left: dict, right: dict, seed: int) -> bool:
    """Equal degrees and ranks, and a fibre that is not empty: then both closures are the same."""
    draw = Random(seed)
    one, other = _coefficients(left), _coefficients(right)
    if [len(side) for side in one] != [len(side) for side in other]:
        return False
    (p, here), (q, there) = ((_names(m), _monic(*c)) for m, c in ((left, one), (right, other)))
    at = {name: draw.randrange(1, PRIME) for name in p + q}
    jacobians = [
        [[_at(c.diff(x), at) for x in names] for c in forms]
        for names, forms in ((p, here), (q, there))
    ]
    kept = [_independent(rows) for rows in jacobians]
    if len(kept[0]) != len(kept[1]):
        return False
    fixed = {x: draw.randrange(1, PRIME) for i, x in enumerate(q) if i not in kept[1]}
    unknowns = [x for x in q if x not in fixed]
    pairs = [sp.fraction(sp.together(c)) for c in there]
    equations = [
        (top - _at(c, at) * bottom).subs(fixed)
        for (top, bottom), c in zip(pairs, here, strict=True)
    ]
    whole = sp.prod({bottom for _, bottom in pairs}).subs(fixed)
    basis = sp.groebner([*equations, T * whole - 1], T, *unknowns, modulus=PRIME, order="grevlex")
    return list(basis.exprs) != [1]


def _names(model: dict) -> list[sp.Symbol]:
    return [_read(name) for name in model["parameters"]]


def _coefficients(model: dict) -> tuple[list[sp.Expr], list[sp.Expr]]:
    """Coefficients of numerator and denominator in lowest terms, the highest first."""
    dynamics, force, output = (
        sp.Matrix(_read(model[name])) for name in ("dynamics", "force", "output")
    )
    through, scale, above, below = (
        _read(model[name]) for name in ("through", "scale", "above", "below")
    )
    bordered = dynamics.row_join(force).col_join((-output.T).row_join(sp.Matrix([[through]])))
    fraction = sp.fraction(
        sp.cancel(
            above
            * bordered.det(method="berkowitz")
            / (below * scale * dynamics.det(method="berkowitz"))
        )
    )
    top, bottom = (sp.Poly(side, S).all_coeffs() for side in fraction)
    return top, bottom


def _read(entry: object) -> object:
    if isinstance(entry, list):
        return [_read(e) for e in entry]
    text = str(entry).replace("^", "**")
    for i in range(1, 20):
        text = text.replace(f"p({i})", f"p{i}").replace(f"q({i})", f"q{i}")
    return sp.sympify(
        text, locals={f"{x}{i}": sp.Symbol(f"{x}{i}") for x in "pq" for i in range(1, 20)}
    )


def _monic(top: list[sp.Expr], bottom: list[sp.Expr]) -> list[sp.Expr]:
    return [c / bottom[0] for c in (*top, *bottom[1:])]


def _at(expression: sp.Expr, values: dict) -> int:
    top, bottom = (int(side.subs(values)) for side in sp.fraction(sp.together(expression)))
    return top * pow(bottom, -1, PRIME) % PRIME


def _independent(rows: list[list[int]]) -> list[int]:
    """Columns of a basis of the column space, by elimination modulo the prime."""
    rows, found = [list(row) for row in rows], []
    for j in range(len(rows[0])):
        at = next((i for i in range(len(found), len(rows)) if rows[i][j]), None)
        if at is None:
            continue
        k = len(found)
        rows[k], rows[at] = rows[at], rows[k]
        inverse = pow(rows[k][j], -1, PRIME)
        for i in range(k + 1, len(rows)):
            factor = rows[i][j] * inverse % PRIME
            rows[i] = [(a - factor * b) % PRIME for a, b in zip(rows[i], rows[k], strict=True)]
        found.append(j)
    return found


if __name__ == "__main__":
    print(json.dumps(decided(*json.load(sys.stdin))))
