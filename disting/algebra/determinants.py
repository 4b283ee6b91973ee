"""Determinants of matrices of polynomials without any division.

Determinants are expanded along rows: the minors of the first rows are kept by their set of columns,
and a minor of k + 1 rows is the sum of an entry times a minor of k rows over the columns. Of n
columns at most 2^n sets are met, and far fewer where the matrix has many zeros. With polynomials
this is cheaper than elimination, whose exact quotients go through larger polynomials than the
result.
"""

from collections.abc import Callable, Sequence
from operator import mul

from flint import fmpz_mpoly

Times = Callable[[fmpz_mpoly, fmpz_mpoly], fmpz_mpoly]
Minors = dict[int, fmpz_mpoly]
"""Minors of the first rows by their columns, as a bit mask; those that are not there are zero."""


def minors(rows: Sequence[Sequence[fmpz_mpoly]], start: Minors, times: Times = mul) -> Minors:
    """The minors of more rows, from those of the rows above; {0: 1} stands for no row. `times`
    multiplies, or refuses to.

    >>> from disting.algebra.symbols import symbols
    >>> a, b = symbols(["a", "b"]).values()
    >>> str(minors([[a, b], [b, a]], {0: a**0})[0b11])
    'a^2 - b^2'
    """
    found = start
    for row in rows:
        found = _with_row(
            found, [(j, entry) for j, entry in enumerate(row) if not entry.is_zero()], times
        )
    return found


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
