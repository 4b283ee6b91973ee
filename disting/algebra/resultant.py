"""Resultants modulo a prime for given formal degrees: polynomials in the coefficients, also
where leading ones vanish.
"""

from collections.abc import Sequence

from flint import nmod_mat, nmod_poly


def polynomial(coefficients: Sequence[int], modulus: int) -> nmod_poly:
    """The polynomial with these coefficients, the constant first."""
    return nmod_poly(list(coefficients), modulus)


def resultant(f: nmod_poly, g: nmod_poly, m: int, n: int) -> int:
    """Determinant of Sylvester's matrix of two polynomials of the formal degrees m and n; 1 for
    two constants.

    >>> resultant(polynomial([2, 1], 7), polynomial([5, 3, 1], 7), 1, 2)
    3
    """
    modulus = f.modulus()
    rows = [[0] * i + [int(f[m - j]) for j in range(m + 1)] + [0] * (n - 1 - i) for i in range(n)]
    rows += [[0] * i + [int(g[n - j]) for j in range(n + 1)] + [0] * (m - 1 - i) for i in range(m)]
    return (
        int(nmod_mat(m + n, m + n, [x for row in rows for x in row], modulus).det()) if rows else 1
    )


def interpolated(values: Sequence[int], modulus: int) -> list[int]:
    """Coefficients, the constant first, of the polynomial of least degree with these values at 0,
    1, 2, ..

    >>> interpolated([1, 2, 5], 7)
    [1, 0, 1]
    """
    count = len(values)
    powers = nmod_mat(
        count, count, [pow(x, j, modulus) for x in range(count) for j in range(count)], modulus
    )
    found = powers.solve(nmod_mat(count, 1, list(values), modulus))
    return [int(found[j, 0]) for j in range(count)]
