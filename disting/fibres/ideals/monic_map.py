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

from dataclasses import replace
from functools import cache, reduce
from operator import mul

from disting.algebra.symbols import symbols
from disting.fibres.ideals.factored import FactoredMap
from disting.fibres.ideals.system import determinants, separated, terms, with_ratios
from disting.model.row import Row


@cache
def monic_map(row: Row) -> FactoredMap:
    """Psi of a damped row without dampers to the ground.

    >>> m = monic_map(Row(2, True, 1, 2, damped=True))
    >>> m.parameters, m.joints, m.right, len(m.poles)
    (('u0', 'e0', 'h1', 'e1', 'r1'), (2,), (), 4)
    """
    row = replace(row, before=0)
    between = range(row.a, row.b)
    names = tuple(
        x
        for i in row.joints
        for x in (f"{'h' if i in between else 'u'}{i}", f"e{i}", f"r{i}")[: 3 if i else 2]
    )
    ring = symbols(["s", *names])
    s, zero = ring["s"], ring["s"] - ring["s"]
    joints = [
        ring[f"e{i}"] * (s + ring[f"h{i}"])
        if i in between
        else ring.get(f"u{i}", zero) + ring.get(f"e{i}", zero) * s
        for i in range(row.n_masses)
    ]
    left, right, poles = determinants(row, with_ratios(row, joints, ring), ring)
    poles = poles if row.grounded else poles // s**2
    zeros = reduce(mul, (s + ring[f"h{i}"] for i in between), left * right)
    coefficients = [
        tuple(terms(c) for c in separated(names, p, s**0).numerator[:-1])
        for p in (left, right, poles)
    ]
    return FactoredMap(
        name=f"{row}, {' '.join(names)}",
        parameters=names,
        joints=tuple(names.index(f"h{i}") for i in between),
        left=coefficients[0],
        right=coefficients[1],
        poles=coefficients[2],
        whole=separated(names, zeros, poles),
    )
