"""Symmetric tridiagonal matrices over any ring: determinants and adjugate from two three-term
recurrences.

A = tridiag(-off, diagonal, -off). With the leading minors theta_i = diagonal_i theta_(i-1) -
off_(i-1)^2 theta_(i-2) and the trailing minors phi_i likewise from the other end, det A = theta_n
and, for a <= b,

    adj A[a, b] = theta_(a-1) * off_a ... off_(b-1) * phi_(b+1)

so that no entry of the inverse ever needs elimination. The ring is whatever the entries are:
polynomials in s modulo a prime, over the integers, or with symbols.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

Ring = Any  # an element of a commutative ring: +, -, * and, for exact quotients, //


@dataclass(frozen=True)
class Tridiagonal:
    """Diagonal (n entries), negated off-diagonal (n-1 entries) and the ring's one; indices
    count from 0.
    """

    diagonal: tuple[Ring, ...]
    off: tuple[Ring, ...]
    one: Ring

    @cached_property
    def leading(self) -> list[Ring]:
        """leading[i] = determinant of the first i rows and columns."""
        return _minors(self.diagonal, self.off, self.one)

    @cached_property
    def trailing(self) -> list[Ring]:
        """trailing[i] = determinant of rows and columns i, i+1, ..., n-1."""
        return _minors(self.diagonal[::-1], self.off[::-1], self.one)[::-1]

    @property
    def determinant(self) -> Ring:
        """det A."""
        return self.leading[-1]

    def adjugate_column(self, column: int) -> list[Ring]:
        """adj A[:, column], by two running products."""
        n = len(self.diagonal)
        entries = [self.one] * n
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


def _minors(diagonal: tuple[Ring, ...], off: tuple[Ring, ...], one: Ring) -> list[Ring]:
    minors = [one]
    for i, entry in enumerate(diagonal):
        grown = entry * minors[-1]
        minors.append(grown - off[i - 1] * off[i - 1] * minors[-2] if i else grown)
    return minors
