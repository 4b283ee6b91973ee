"""The transfer functions of a state space with rational entries, by two determinants without any
division, and those of a network.

Multiplying row i of s I - A and of B by the common denominator r_i of their entries, and C and D
by theirs, q, makes all entries polynomials. With P = diag(r) (s I - A) and the polynomial B', C',
D', of one input and one output,

    G = C (s I - A)^-1 B + D = det [[P, B'], [-C', D']] / (q det P)

and both determinants share the minors of the rows [P, B'], those of all outputs too.
"""

from collections.abc import Iterator, Sequence
from functools import reduce

from flint import fmpz_mpoly

from disting.algebra.determinants import minors
from disting.algebra.symbols import RationalFunction, symbols
from disting.errors import InputError
from disting.general.entries import (
    StateSpace,
    frequency,
    parameters_of,
    refuse_namesakes,
    state_space,
)
from disting.general.expansion import Expansion
from disting.general.expression import Tree
from disting.general.powers import Powers, powers_of
from disting.network.expansion import transfer_functions as network_functions
from disting.network.network import Network


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
        _clear_denominators([*row, force[at]], expansion)
        for row, force in zip(space.a, space.b, strict=True)
    ]
    rows = [[-entry for entry in row[:-1]] + [row[-1]] for row, _ in dynamics]
    for i, (_, common) in enumerate(dynamics):
        rows[i][i] += expansion.times(common, s)
    polynomial, n = expansion.one, len(rows)
    zero = polynomial - polynomial
    above = minors(rows, {0: polynomial}, expansion.times)
    for sensor, through in zip(space.c, space.d, strict=True):
        output, scale = _clear_denominators([*sensor, through[at]], expansion)
        last = [[*(-entry for entry in output[:-1]), output[-1]]]
        whole = minors(last, above, expansion.times)
        yield expansion.ratio(
            whole.get((2 << n) - 1, zero), expansion.times(scale, above.get((1 << n) - 1, zero))
        )


def _clear_denominators(
    entries: list[Tree], expansion: Expansion
) -> tuple[list[fmpz_mpoly], fmpz_mpoly]:
    """A row of entries times their common denominator, and this denominator."""
    values = [expansion.value(entry) for entry in entries]
    common = reduce(expansion.common, (v.den for v in values), expansion.one)
    return [expansion.times(v.num, common // v.den) for v in values], common


def transfer_functions(
    a: object, b: object, c: object, d: object, s: object, x0: object = None
) -> tuple[tuple[tuple[RationalFunction, ...], ...], tuple[str, ...]]:
    """Those of a state space, outputs x inputs, in the ring of s and the parameters, s first, and
    the parameters; with an initial state the response to it is the last column. Raises InputError.
    """
    space = state_space(a, b, c, d, x0)
    refuse_namesakes(a, b, c, d, x0, s)
    variable = frequency(s)
    parameters = parameters_of(space.entries)
    if variable in parameters:
        raise InputError(
            f"the matrices contain the frequency variable {variable}; name another one with s=.."
        )
    ring = symbols([variable, *parameters])
    return responses(space, Expansion(ring, ring[variable] ** 0), ring[variable]), parameters


def fraction(sides: tuple[Tree, ...], expansion: Expansion) -> RationalFunction:
    """Numerator over denominator; raises InputError where that is zero."""
    top, bottom = map(expansion.value, sides)
    if bottom.num.is_zero():
        raise InputError("the denominator of the transfer function is zero")
    return expansion.quotient(top, bottom)


def network_ratios(network: Network) -> tuple[tuple[RationalFunction, ...], ...]:
    """The transfer functions in lowest terms, outputs x inputs, in the ring of s, or s^(1/2), of a
    variable for each power s^n, by the name of n, and of the parameters; raises InputError.
    """
    ring = symbols(["s", *network.exponents, *network.parameters])
    expansion = Expansion(ring, ring["s"] ** 0)
    sides = network_functions(network, ring, "s", expansion.times)
    return tuple(tuple(expansion.ratio(*entry) for entry in row) for row in sides)


def network_powers(ratios: Sequence[RationalFunction], network: Network) -> Powers:
    """Powers of v in such functions of a network, without those that are zero; raises
    InputError.
    """
    present = [ratio for ratio in ratios if not ratio.num.is_zero()]
    return powers_of(present, network.halves, network.exponents, len(network.parameters))
