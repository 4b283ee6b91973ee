"""The receptance of a damped row but for its gain: a map to monic polynomials.

A row has a wall at its left end or none; its right end is free. With ports a <= b, the names of
`system` and, for the joints between the ports, h_i = u_i/e_i:

    H = G s^-2w N/D,   N = prod_(a <= i < b) (s + h_i) theta_(a-1) phi_(b+1),   G = g prod_(a <= i
    < b) e_i

with w = 0 at a wall and 1 without one (then the determinant is s^2 D). N, theta, phi and D are
monic. The gain g is in G only, so the closure of all H is the product of a line and the closure of
Psi = (N, D): rows of equal kind are the same exactly if their maps Psi have the same closure.
Where e_i of a joint between the ports is zero, N has a smaller degree; no such row has the
receptance of one where none is.
"""

from dataclasses import dataclass
from functools import cache, reduce
from operator import mul

from flint import fmpz_mpoly

from disting.algebra.symbols import symbols
from disting.fibres.ideals.system import CoefficientMap, minors, separated
from disting.model.row import Row


@dataclass(frozen=True)
class MonicMap:
    """Psi in factors: parameters, the h_i in order, and the coefficients of theta, phi and D
    without their leading ones.
    """

    parameters: tuple[str, ...]
    heads: tuple[str, ...]
    left: tuple[fmpz_mpoly, ...]
    right: tuple[fmpz_mpoly, ...]
    poles: tuple[fmpz_mpoly, ...]
    whole: CoefficientMap


@cache
def monic_map(row: Row) -> MonicMap:
    """Psi of a damped row without dampers to the ground.

    >>> m = monic_map(Row(2, True, 1, 2, damped=True))
    >>> m.parameters, [str(c) for c in m.right], len(m.poles)
    (('u0', 'e0', 'h1', 'e1', 'r1'), [], 4)
    """
    a, b, n = row.a, row.b, row.n_masses
    names = tuple(
        x
        for i in row.joints
        for x in (f"{'h' if a <= i < b else 'u'}{i}", f"e{i}", f"r{i}")[: 3 if i else 2]
    )
    ring = symbols(["s", *names])
    s, zero, one = ring["s"], ring["s"] - ring["s"], ring["s"] ** 0
    joint = {
        i: ring[f"e{i}"] * (s + ring[f"h{i}"]) if a <= i < b else ring[f"u{i}"] + ring[f"e{i}"] * s
        for i in row.joints
    }
    joint = {0: zero, n: zero} | joint
    ratio = {i: ring.get(f"r{i}", one) for i in range(n)}
    diagonal = [s * s + joint[i - 1] * ratio[i - 1] + joint[i] for i in range(1, n + 1)]
    squares = [joint[i] * joint[i] * ratio[i] for i in range(1, n)]
    leading, trailing = minors(diagonal, squares, one), minors(diagonal[::-1], squares[::-1], one)
    left, right, poles = (
        leading[a - 1],
        trailing[n - b],
        leading[n] if row.grounded else leading[n] // s**2,
    )
    heads = tuple(f"h{i}" for i in range(a, b))
    zeros = reduce(mul, (s + ring[h] for h in heads), left * right)
    sides = [separated(names, p, one).numerator[:-1] for p in (left, right, poles)]
    return MonicMap(
        parameters=names,
        heads=heads,
        left=sides[0],
        right=sides[1],
        poles=sides[2],
        whole=separated(names, zeros, poles),
    )
