"""Exact rank of a matrix of polynomials by fraction-free elimination (Bareiss 1968): every
division leaves no remainder.

The pivot is the entry with the fewest terms, and the common factor of each row is taken out first,
which keeps entries short.

Resultants modulo a prime for given formal degrees: polynomials in the coefficients, also
where leading ones vanish.
"""

from collections.abc import Sequence
from time import monotonic

from flint import fmpz_mpoly, nmod_mat, nmod_poly

Polynomial = fmpz_mpoly
Modular = nmod_poly
"""A polynomial in one variable modulo a prime."""


class OutOfTimeError(Exception):
    """The elimination was given up."""


def rank(rows: Sequence[Sequence[Polynomial]], seconds: float) -> int:
    """Rank over the field of fractions; raises OutOfTimeError after about `seconds`.

    >>> from disting.algebra.symbols import symbols
    >>> x, y = symbols(["x", "y"]).values()
    >>> rank([[x, y], [x * y, y**2], [x - x, x]], 1.0), rank([[x, y], [x**2, x * y]], 1.0)
    (2, 1)
    """
    end = monotonic() + seconds
    work = [_primitive(row) for row in rows]
    columns = list(range(len(work[0]))) if work else []
    previous: Polynomial | None = None
    done = 0
    while pivots := [
        (len(work[i][j]), i, j)
        for i in range(done, len(work))
        for j in columns
        if not work[i][j].is_zero()
    ]:
        _, at, column = min(pivots)
        work[done], work[at] = work[at], work[done]
        columns.remove(column)
        for i in range(done + 1, len(work)):
            if monotonic() > end:
                raise OutOfTimeError(f"more than {seconds:g} s")
            work[i] = _reduced(work[i], work[done], column, columns, previous)
        previous = work[done][column]
        done += 1
    return done


def _reduced(
    row: Sequence[Polynomial],
    pivot: Sequence[Polynomial],
    column: int,
    columns: list[int],
    previous: Polynomial | None,
) -> list[Polynomial]:
    """Bareiss' step: (pivot * entry - factor * above) / previous pivot."""
    found = list(row)
    for j in columns:
        entry = pivot[column] * row[j] - row[column] * pivot[j]
        found[j] = entry if previous is None else entry // previous
    return found


def _primitive(row: Sequence[Polynomial]) -> list[Polynomial]:
    """The row without its common factor."""
    common: Polynomial | None = None
    for entry in row:
        if not entry.is_zero():
            common = entry if common is None else common.gcd(entry)
    return [entry // common for entry in row] if common is not None else list(row)


def polynomial(coefficients: Sequence[int], modulus: int) -> Modular:
    """The polynomial with these coefficients, the constant first."""
    return nmod_poly(list(coefficients), modulus)


def resultant(f: Modular, g: Modular, m: int, n: int) -> int:
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
