"""The resultants of rows: SymPy's own elimination, models and what is no model, formal degrees."""

from itertools import combinations
from math import comb, prod

import pytest
import sympy as sp

from disting.algebra.certainty import prime, residues
from disting.algebra.determinants import polynomial, resultant
from disting.decide.inclusion.row_resultants import _sums, end_resultant, inner_resultant
from disting.model.row import Row

S = sp.Symbol("s")
P = prime("row resultants")
COLLOCATED = sorted(
    {
        Row(n, grounded, at, at, True).canonical
        for n in (2, 3, 4, 5)
        for grounded in (False, True)
        for at in range(1, n + 1)
    },
    key=repr,
)


def receptance(row, numbers):
    """Coefficients of numerator and denominator, the constant first, from the matrix of the
    equation of motion.
    """
    a = sp.zeros(row.n_masses, row.n_masses)
    p = dict(zip(row.structure.parameters, numbers, strict=True))
    for i in range(1, row.n_masses + 1):
        a[i - 1, i - 1] += p[f"m{i}"] * S**2
    for i in row.joints:
        w = p[f"k{i}{i + 1}"] + p[f"d{i}{i + 1}"] * S
        for r, c, sign in ((i, i, 1), (i - 1, i - 1, 1), (i, i - 1, -1), (i - 1, i, -1)):
            if r >= 0 and c >= 0:
                a[r, c] += sign * w
    minor = a.minor_submatrix(row.a - 1, row.b - 1) if row.n_masses > 1 else sp.eye(1)
    found = [
        sp.Poly(sp.expand(m.det(method="berkowitz")), S).all_coeffs()[::-1] for m in (minor, a)
    ]
    return [[int(c) % P for c in coefficients] for coefficients in found]


@pytest.mark.thin(1)
@pytest.mark.sampled(5)
@pytest.mark.parametrize("row", COLLOCATED, ids=repr)
def test_models_fulfil_the_equations_and_others_do_not(row):
    for k in range(3 if row.n_masses < 5 else 1):
        num, den = receptance(row, residues(f"{k}:{row}", len(row.structure.parameters), P))
        assert end_resultant(row, num, den, P) == inner_resultant(row, num, den, P) == 0
    e = 2 * row.n_masses - 2
    num, den = (residues(f"{row}:{name}", count, P) for name, count in (("b", e + 1), ("a", e + 3)))
    if not row.grounded:
        den[0], den[1], den[3] = 0, 0, den[2] * num[1] * pow(num[0], -1, P) % P  # momentum is kept
    at_end = row.a in (1, row.n_masses)
    inner = row.a < row.n_masses if row.grounded else not at_end
    assert bool(end_resultant(row, num, den, P)) == (at_end and (row.grounded or e > 2))
    assert bool(inner_resultant(row, num, den, P)) == inner
    # of a numerator that has lost a coefficient too
    assert bool(inner_resultant(row, num[:-1], den, P)) == inner


@pytest.mark.parametrize("size", [1, 2, 3])
def test_products_of_sums_are_those_of_the_roots(size):
    """Six roots; five, the sixth having gone to infinity as -r5/r6, in 5 over size - 1 sums."""
    roots, lead = residues("roots", 6, P), residues("lead", 1, P)[0]
    for known in (roots, roots[:5]):
        r = polynomial([lead], P)
        for x in known:
            r *= polynomial([-x, 1], P)
        power = comb(5, size - 1)
        scale = lead if len(known) == len(roots) else -lead
        sums = prod(sum(chosen) for chosen in combinations(known, size))
        coefficients = [int(r[i]) for i in range(7)]
        assert _sums(coefficients, size, power, P) == pow(scale, power, P) * sums % P


def test_two_masses_at_a_wall_by_hand():
    """Force and sensor on mass 1: D = (m1 s^2 + d0 s + c0) N + m2 s^2 (d s + c) with N = m2 s^2 +
    d s + c, so that, by hand,

    b1 (a2 b0^2 - (a1 b0 - a0 b1) b1 - a0 b0 b2) = b0 (a3 b0^2 - (a1 b0 - a0 b1) b2).
    """
    row = Row(2, True, 1, 1, True)
    for k in range(5):
        b0, b1, b2, a0, a1, a2, a4 = residues(f"hand:{k}", 7, P)
        low = a1 * b0 - a0 * b1
        a3 = (
            (b1 * (a2 * b0**2 - low * b1 - a0 * b0 * b2) * pow(b0, -1, P) + low * b2)
            * pow(b0, -2, P)
            % P
        )
        for more in (0, 1):
            den = [a0, a1, a2, (a3 + more) % P, a4]
            assert (
                bool(end_resultant(row, [b0, b1, b2], den, P))
                == bool(inner_resultant(row, [b0, b1, b2], den, P))
                == bool(more)
            )


@pytest.mark.parametrize(("m", "n"), [(1, 1), (3, 2), (2, 4)])
def test_resultants_are_those_of_sympy(m, n):
    f, g = (residues(f"{m}:{n}:{name}", count + 1, 97) for name, count in (("f", m), ("g", n)))
    hand = sp.resultant(sp.Poly(f[::-1], S), sp.Poly(g[::-1], S)) % 97
    assert resultant(polynomial(f, 97), polynomial(g, 97), m, n) == hand
    # a common root at infinity
    assert resultant(polynomial(f[:-1], 97), polynomial(g[:-1], 97), m, n) == 0
