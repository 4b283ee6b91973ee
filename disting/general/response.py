"""The transfer functions of a state space with rational entries, by two determinants without any
division.

Multiplying row i of s I - A and of B by the common denominator r_i of their entries, and C and D
by theirs, q, makes all entries polynomials. With P = diag(r) (s I - A) and the polynomial B', C',
D', of one input and one output,

    G = C (s I - A)^-1 B + D = det [[P, B'], [-C', D']] / (q det P)

and both determinants share the minors of the rows [P, B'], those of all outputs too.

Determinants are expanded along rows: the minors of the first rows are kept by their set of columns,
and a minor of k + 1 rows is the sum of an entry times a minor of k rows over the columns. Of n
columns at most 2^n sets are met, and far fewer where the matrix has many zeros. With polynomials
this is cheaper than elimination, whose exact quotients go through larger polynomials than the
result.
"""

from collections.abc import Callable, Iterator, Sequence
from functools import reduce
from operator import mul

from flint import fmpz_mpoly

from disting.algebra.rational_function import RationalFunction
from disting.general.entries import StateSpace
from disting.general.expansion import Expansion
from disting.general.expression import Tree

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


def responses(
    space: StateSpace, expansion: Expansion, s: fmpz_mpoly
) -> tuple[tuple[RationalFunction, ...], ...]:
    """G(s) in lowest terms, outputs x inputs; the ring of the expansion holds s and the
    parameters. Raises InputError if it grows too large.
    """
    columns = [list(_of_input(space, j, expansion, s)) for j in range(space.shape[1])]
    return tuple(zip(*columns, strict=True))


def _of_input(
    space: StateSpace, at: int, expansion: Expansion, s: fmpz_mpoly
) -> Iterator[RationalFunction]:
    """Yield the transfer functions from one input to all outputs."""
    dynamics = [
        _cleared([*row, force[at]], expansion) for row, force in zip(space.a, space.b, strict=True)
    ]
    rows = [[-entry for entry in row[:-1]] + [row[-1]] for row, _ in dynamics]
    for i, (_, common) in enumerate(dynamics):
        rows[i][i] += expansion.times(common, s)
    one, n = expansion.one, len(rows)
    zero = one - one
    above = minors(rows, {0: one}, expansion.times)
    for sensor, through in zip(space.c, space.d, strict=True):
        output, scale = _cleared([*sensor, through[at]], expansion)
        last = [[*(-entry for entry in output[:-1]), output[-1]]]
        whole = minors(last, above, expansion.times)
        yield expansion.ratio(
            whole.get((2 << n) - 1, zero), expansion.times(scale, above.get((1 << n) - 1, zero))
        )


def _cleared(entries: list[Tree], expansion: Expansion) -> tuple[list[fmpz_mpoly], fmpz_mpoly]:
    """A row of entries times their common denominator, and this denominator."""
    values = [expansion.value(entry) for entry in entries]
    common = reduce(expansion.common, (v.den for v in values), expansion.one)
    return [expansion.times(v.num, common // v.den) for v in values], common
