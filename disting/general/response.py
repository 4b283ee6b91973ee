"""The transfer function of a state space with rational entries, by two determinants without any
division.

Multiplying row i of s I - A and of B by the common denominator r_i of their entries, and C and D
by theirs, q, makes all entries polynomials. With P = diag(r) (s I - A) and the polynomial B', C',
D'

    G = C (s I - A)^-1 B + D = det [[P, B'], [-C', D']] / (q det P)

and both determinants share the minors of the rows [P, B'].
"""

from functools import reduce

from flint import fmpz_mpoly

from disting.algebra.rational_function import RationalFunction
from disting.general.entries import StateSpace
from disting.general.expansion import Expansion
from disting.general.minors import minors
from disting.general.trees import Tree


def response(space: StateSpace, expansion: Expansion, s: fmpz_mpoly) -> RationalFunction:
    """G(s) in lowest terms; the ring of the expansion holds s and the parameters. Raises
    InputError if it grows too large.
    """
    one = expansion.one
    dynamics = [
        _cleared([*row, force], expansion) for row, force in zip(space.a, space.b, strict=True)
    ]
    output, scale = _cleared([*space.c, space.d], expansion)
    rows = [[-entry for entry in row[:-1]] + [row[-1]] for row, _ in dynamics]
    for i, (_, common) in enumerate(dynamics):
        rows[i][i] += expansion.times(common, s)
    above = minors(rows, {0: one}, expansion.times)
    whole = minors([[*(-entry for entry in output[:-1]), output[-1]]], above, expansion.times)
    n = len(rows)
    zero = one - one
    return expansion.ratio(
        whole.get((2 << n) - 1, zero), expansion.times(scale, above.get((1 << n) - 1, zero))
    )


def _cleared(entries: list[Tree], expansion: Expansion) -> tuple[list[fmpz_mpoly], fmpz_mpoly]:
    """A row of entries times their common denominator, and this denominator."""
    values = [expansion.value(entry) for entry in entries]
    common = reduce(expansion.common, (v.den for v in values), expansion.one)
    return [expansion.times(v.num, common // v.den) for v in values], common
