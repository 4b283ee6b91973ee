"""The resultants of rows: SymPy's own elimination, models and what is no model, formal degrees."""

import pytest
import sympy as sp

from disting.algebra.fractionfree import polynomial, resultant
from disting.algebra.sampling import prime, residues
from disting.model.row import Row
from disting.questions.inclusion.row_resultants import end_resultant, inner_resultant

S = sp.Symbol("s")
P = prime("row resultants")
COLLOCATED = sorted(
    {
        Row(n, grounded, at, at, True).canonical
        for n in (2, 3, 4)
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


@pytest.mark.parametrize("row", COLLOCATED, ids=repr)
def test_models_fulfil_the_equations_and_others_do_not(row):
    for k in range(3):
        num, den = receptance(row, residues(f"{k}:{row}", len(row.structure.parameters), P))
        assert end_resultant(row, num, den, P) == inner_resultant(row, num, den, P) == 0
    e = 2 * row.n_masses - 2
    num, den = (residues(f"{row}:{name}", count, P) for name, count in (("b", e + 1), ("a", e + 3)))
    if not row.grounded:
        den[0], den[1], den[3] = 0, 0, den[2] * num[1] * pow(num[0], -1, P) % P  # momentum is kept
    at_end, alone = (
        row.a in (1, row.n_masses),
        row.a == row.n_masses - 1 or (row.a == 2 and not row.grounded),
    )
    assert bool(end_resultant(row, num, den, P)) == (at_end and (row.grounded or e > 2))
    assert bool(inner_resultant(row, num, den, P)) == (alone and (row.grounded or e > 2))


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
