"""Monomials as whole numbers, ordered by degree and then reverse lexicographically (degrevlex).

For exponents e_1, .., e_n the order compares e_1+..+e_n, then e_1+..+e_(n-1), .., then e_1. These
partial sums and the exponents themselves are written side by side, eight bits each, sums first. So
codes are compared as numbers, multiplication of monomials is addition, and whether one divides
another shows in the top bits of the exponents' fields, which are not used otherwise.
"""

from dataclasses import dataclass
from functools import cache
from itertools import accumulate

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
        """Whether the first monomial divides the second."""
        guard, mask = self.guard, self.mask
        return (((code & mask) | guard) - (divisor & mask)) & guard == guard


@cache
def _guard(size: int) -> int:
    return sum(1 << (FIELD * i + FIELD - 1) for i in range(size))
