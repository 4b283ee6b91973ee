"""Matrices and polynomials modulo a prime of any length: FLINT's words where it fits into one,
else its long integers.

Monomials as whole numbers, ordered by degree and then reverse lexicographically (degrevlex).

For exponents e_1, .., e_n the order compares e_1+..+e_n, then e_1+..+e_(n-1), .., then e_1. These
partial sums and the exponents themselves are written side by side, eight bits each, sums first. So
codes are compared as numbers, multiplication of monomials is addition, and whether one divides
another shows in the top bits of the exponents' fields, which are not used otherwise.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from itertools import accumulate

from flint import fmpz_mod_ctx, fmpz_mod_mat, fmpz_mod_poly, fmpz_mod_poly_ctx, nmod_mat

WORD = 64  # bits
Matrix = nmod_mat | fmpz_mod_mat
Sparse = dict[tuple[int, ...], int]
"""A polynomial: exponents and coefficients."""


def matrix(rows: int, columns: int, entries: Sequence[int], modulus: int) -> Matrix:
    """A matrix by its entries, row by row.

    >>> matrix(1, 2, [3, 4], (1 << 89) - 1).rank()
    1
    """
    if modulus.bit_length() <= WORD:
        return nmod_mat(rows, columns, entries, modulus)
    return fmpz_mod_mat(rows, columns, entries, _context(modulus))


def long_polynomial(coefficients: Sequence[int], modulus: int) -> fmpz_mod_poly:
    """A polynomial by its coefficients, ascending, in long integers whatever the prime, for what
    words do not offer.
    """
    return _polynomials(modulus)(list(coefficients))


def null_space(rows: Sequence[Sequence[int]], modulus: int) -> list[list[int]]:
    """A basis of {w: row . w = 0 for all rows}, in echelon form from the right.

    >>> null_space([[1, 2, 0]], 7)
    [[5, 1, 0], [0, 0, 1]]
    """
    width = len(rows[0])
    echelon, rank = matrix(len(rows), width, [x for row in rows for x in row], modulus).rref()
    leads = [next(j for j in range(width) if int(echelon[i, j])) for i in range(rank)]
    basis = list[list[int]]()
    for free in (j for j in range(width) if j not in leads):
        vector = [int(j == free) for j in range(width)]
        for i, lead in enumerate(leads):
            vector[lead] = -int(echelon[i, free]) % modulus
        basis.append(vector)
    return basis


@cache
def _context(modulus: int) -> fmpz_mod_ctx:
    return fmpz_mod_ctx(modulus)


@cache
def _polynomials(modulus: int) -> fmpz_mod_poly_ctx:
    return fmpz_mod_poly_ctx(_context(modulus))


FIELD = 8  # bits a field
MAX_DEGREE = 127


@dataclass(frozen=True, slots=True)
class Order:
    """Codes of monomials in `size` variables of total degree up to MAX_DEGREE."""

    size: int

    @property
    def guard(self) -> int:
        """The top bit of each exponent's field."""
        return _guard(self.size)

    @property
    def mask(self) -> int:
        """All bits of the exponents' fields."""
        return (1 << (FIELD * self.size)) - 1

    def encode(self, exponents: tuple[int, ...]) -> int:
        """Code of a monomial.

        >>> o = Order(2)
        >>> o.encode((1, 1)) > o.encode((0, 2)) > o.encode((1, 0)) > o.encode((0, 0)) == 0
        True
        """
        sums = list(accumulate(exponents))[::-1]
        return int.from_bytes(bytes([*sums, *exponents]))

    def decode(self, code: int) -> tuple[int, ...]:
        """Exponents of a code."""
        return tuple(code.to_bytes(2 * self.size)[self.size :])

    def degree(self, code: int) -> int:
        """Total degree."""
        return code >> (FIELD * (2 * self.size - 1))

    def divides(self, divisor: int, code: int) -> bool:
        """Return True if the first monomial divides the second."""
        guard, mask = self.guard, self.mask
        return (((code & mask) | guard) - (divisor & mask)) & guard == guard


@cache
def _guard(size: int) -> int:
    return sum(1 << (FIELD * i + FIELD - 1) for i in range(size))
