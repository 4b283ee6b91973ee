"""Determinants and ranks of matrices over any ring: without a division, or with exact ones.

The pivot is the entry with the fewest terms, and the common factor of each row is taken out first,
which keeps entries short.

Resultants modulo a prime for given formal degrees: polynomials in the coefficients, also
where leading ones vanish.

A = tridiag(-off, diagonal, -off). With the leading minors theta_i = diagonal_i theta_(i-1) -
off_(i-1)^2 theta_(i-2) and the trailing minors phi_i likewise from the other end, det A = theta_n
and, for a <= b,

    adj A[a, b] = theta_(a-1) * off_a ... off_(b-1) * phi_(b+1)

so that no entry of the inverse ever needs elimination. The ring is whatever the entries are:
polynomials in s modulo a prime, over the integers, or with symbols.

Determinants are expanded along rows: the minors of the first rows are kept by their set of columns,
and a minor of k + 1 rows is the sum of an entry times a minor of k rows over the columns. Of n
columns at most 2^n sets are met, and far fewer where the matrix has many zeros. With polynomials
this is cheaper than elimination, whose exact quotients go through larger polynomials than the
result.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from operator import mul
from time import monotonic
from typing import Generic, Protocol, Self, TypeVar

from flint import fmpz_mpoly, nmod_mat, nmod_poly

Modular = nmod_poly
"""A polynomial in one variable modulo a prime."""
Times = Callable[[fmpz_mpoly, fmpz_mpoly], fmpz_mpoly]
Minors = dict[int, fmpz_mpoly]
"""Minors of the first rows by their columns, as a bit mask; those that are not there are zero."""


class RingElement(Protocol):
    """An element of a commutative ring; // is for exact quotients."""

    def __add__(self, other: Self, /) -> Self: ...
    def __sub__(self, other: Self, /) -> Self: ...
    def __mul__(self, other: Self, /) -> Self: ...
    def __neg__(self) -> Self: ...
    def __floordiv__(self, other: Self, /) -> Self: ...


Ring = TypeVar("Ring", bound=RingElement)


class OutOfTimeError(Exception):
    """The elimination was abandoned."""


def rank(rows: Sequence[Sequence[fmpz_mpoly]], seconds: float) -> int:
    """Rank over the field of fractions; raises OutOfTimeError after about `seconds`.

    >>> from disting.algebra.symbols import symbols
    >>> x, y = symbols(["x", "y"]).values()
    >>> rank([[x, y], [x * y, y**2], [x - x, x]], 1.0), rank([[x, y], [x**2, x * y]], 1.0)
    (2, 1)
    """
    end = monotonic() + seconds
    work = [_primitive(row) for row in rows]
    columns = list(range(len(work[0]))) if work else []
    previous: fmpz_mpoly | None = None
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
            work[i] = _eliminate_step(work[i], work[done], column, columns, previous)
        previous = work[done][column]
        done += 1
    return done


def _eliminate_step(
    row: Sequence[fmpz_mpoly],
    pivot: Sequence[fmpz_mpoly],
    column: int,
    columns: list[int],
    previous: fmpz_mpoly | None,
) -> list[fmpz_mpoly]:
    """Bareiss' step: (pivot * entry - factor * above) / previous pivot."""
    reduced = list(row)
    for j in columns:
        entry = pivot[column] * row[j] - row[column] * pivot[j]
        reduced[j] = entry if previous is None else entry // previous
    return reduced


def _primitive(row: Sequence[fmpz_mpoly]) -> list[fmpz_mpoly]:
    """The row without its common factor."""
    common: fmpz_mpoly | None = None
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


def interpolate(values: Sequence[int], modulus: int) -> list[int]:
    """Coefficients, the constant first, of the polynomial of least degree with these values at 0,
    1, 2, ..

    >>> interpolate([1, 2, 5], 7)
    [1, 0, 1]
    """
    count = len(values)
    powers = nmod_mat(
        count, count, [pow(x, j, modulus) for x in range(count) for j in range(count)], modulus
    )
    solved = powers.solve(nmod_mat(count, 1, list(values), modulus))
    return [int(solved[j, 0]) for j in range(count)]


@dataclass(frozen=True)
class Tridiagonal(Generic[Ring]):
    """Diagonal (n entries), negated off-diagonal (n-1 entries) and the ring's one; indices
    count from 0.
    """

    diagonal: tuple[Ring, ...]
    off: tuple[Ring, ...]
    unit: Ring

    @cached_property
    def leading(self) -> list[Ring]:
        """leading[i] = determinant of the first i rows and columns."""
        return _minors(self.diagonal, self.off, self.unit)

    @cached_property
    def trailing(self) -> list[Ring]:
        """trailing[i] = determinant of rows and columns i, i+1, ..., n-1."""
        return _minors(self.diagonal[::-1], self.off[::-1], self.unit)[::-1]

    @property
    def determinant(self) -> Ring:
        """det A."""
        return self.leading[-1]

    def adjugate_column(self, column: int) -> list[Ring]:
        """adj A[:, column], by two running products."""
        n = len(self.diagonal)
        entries = [self.unit] * n
        run = self.trailing[column + 1]
        for row in range(column, -1, -1):
            run = run if row == column else run * self.off[row]
            entries[row] = self.leading[row] * run
        run = self.leading[column]
        for row in range(column + 1, n):
            run = run * self.off[row - 1]
            entries[row] = run * self.trailing[row + 1]
        return entries

    def adjugate_diagonal(self, row: int) -> Ring:
        """adj A[row, row]."""
        return self.leading[row] * self.trailing[row + 1]

    def adjugate_beside(self, row: int) -> Ring:
        """adj A[row, row + 1]."""
        return self.leading[row] * self.off[row] * self.trailing[row + 2]


def _minors(diagonal: tuple[Ring, ...], off: tuple[Ring, ...], unit: Ring) -> list[Ring]:
    minors = [unit]
    for i, entry in enumerate(diagonal):
        grown = entry * minors[-1]
        minors.append(grown - off[i - 1] * off[i - 1] * minors[-2] if i else grown)
    return minors


def minors(rows: Sequence[Sequence[fmpz_mpoly]], start: Minors, times: Times = mul) -> Minors:
    """The minors of more rows, from those of the rows above; {0: 1} stands for no row. `times`
    multiplies, or refuses to.

    >>> from disting.algebra.symbols import symbols
    >>> a, b = symbols(["a", "b"]).values()
    >>> str(minors([[a, b], [b, a]], {0: a**0})[0b11])
    'a^2 - b^2'
    """
    whole = start
    for row in rows:
        whole = _with_row(
            whole, [(j, entry) for j, entry in enumerate(row) if not entry.is_zero()], times
        )
    return whole


def _with_row(above: Minors, entries: list[tuple[int, fmpz_mpoly]], times: Times) -> Minors:
    grown: Minors = {}
    for used, minor in above.items():
        for j, entry in entries:
            if used >> j & 1:
                continue
            term = times(entry if (used >> j).bit_count() % 2 == 0 else -entry, minor)
            key = used | 1 << j
            grown[key] = grown[key] + term if key in grown else term
    return grown
