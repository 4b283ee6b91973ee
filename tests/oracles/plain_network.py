"""Networks by Kirchhoff's and Newton's laws as they stand, one equation for each node and for each
element: no matrix is assembled from vectors, no ground is chosen, nothing is left out.

Unknowns are the potential (position, content) of every node but the ground and the flow (force,
current) through every element. At every node what enters is what leaves; every element has its law.
Networks are read by their nodes, letters and names alone.
"""

from fractions import Fraction

from sympy import Symbol
from sympy.polys.domains import QQ
from sympy.polys.matrices import DomainMatrix

from tests.oracles.plain_models import Plain

# (a, b) of a * flow = b * across, for the value p, s and the root of s
LAWS = {
    "m": lambda p, s, root: (1, p * s**2),
    "j": lambda p, s, root: (1, p * s**2),
    "d": lambda p, s, root: (1, p * s),
    "k": lambda p, s, root: (1, p),
    "R": lambda p, s, root: (p, 1),
    "L": lambda p, s, root: (p * s, 1),
    "C": lambda p, s, root: (1, p * s),
    "W": lambda p, s, root: (p, root),
    "a": lambda p, s, root: (1, p),
    "v": lambda p, s, root: (1, s),
}


def equations(network, value, s, root, phase=None):
    """A, B^T, C of A x = B u, y = s^q C x, as lists of rows, made of `value` (by name), s, its root,
    and s^n by the name of the exponent n.
    """
    nodes = sorted({i for e in network.elements for i in e.nodes} - {0})
    row = {node: at for at, node in enumerate(nodes)}
    size = len(nodes) + len(network.elements)
    a = [[0] * size for _ in range(size)]
    for at, e in enumerate(network.elements, len(nodes)):
        own = value(e.value) if e.value else 1
        law = (1, own * phase[e.exponent]) if e.exponent else LAWS[e.letter](own, s, root)
        flow, across = law
        ratio = _ratio(e.ratio, value)
        ends = [(e.nodes[0], 1), *((node, -ratio) for node in e.nodes[1:])]
        a[at][at] += flow
        # what flows between compartments is driven by its first node alone
        for node, share in ends[:1] if e.letter == "a" else ends:
            if node:
                a[at][row[node]] -= across * share
        for node, share in ends:
            if node:
                a[row[node]][at] += share
    sides = []
    for ports in (network.inputs, network.outputs):
        side = [[0] * size for _ in ports]
        for at, port in enumerate(ports):
            for node, share in ((port.plus, 1), (port.minus, -1)):
                if node:
                    side[at][row[node]] += share
        sides.append(side)
    return a, *sides


def _ratio(text, value):
    return value(text) if text.isidentifier() else Fraction(text or 1)


def response(network, values, root):
    """The matrix of transfer functions at these numbers, s^n among them by the name of n, and this
    root of s; None for an entry that the equations contradict or leave open.
    """
    sides = equations(network, values.__getitem__, root**2, root, values)
    a, b, c = ([[_exact(x) for x in row] for row in side] for side in sides)
    derived = root ** (2 * network.order)
    return [[_solved(a, entering, sensor, derived) for entering in b] for sensor in c]


def _exact(x):
    return QQ(*Fraction(x).as_integer_ratio())


def _solved(a, entering, sensor, derived):
    """y of a x = entering, y = sensor x, by elimination with y as the last unknown."""
    rows = [[*r, QQ(0), e] for r, e in zip(a, entering, strict=True)]
    rows.append([*(-x for x in sensor), QQ(1), QQ(0)])
    reduced, pivots = DomainMatrix(rows, (len(rows), len(rows) + 1), QQ).rref()
    last = len(rows) - 1
    if last + 1 in pivots or last not in pivots:
        return None
    y = reduced[pivots.index(last), last + 1].element
    return Fraction(int(y.numerator), int(y.denominator)) * derived


def plain(network, in_halves=False, phase=None):
    """One transfer function as Singular reads it, in s, or with s for the root of s, and with a power
    of that for each s^n, by the name of n; the equations must have one solution.
    """
    step = Symbol("s")
    s = step**2 if in_halves else step
    powers = {name: step**power for name, power in (phase or {}).items()}
    a, (b,), (c,) = equations(network, Symbol, s, step, powers)
    return Plain(
        network.parameters,
        tuple(tuple(map(_written, row)) for row in a),
        tuple(map(_written, b)),
        tuple(map(_written, c)),
        above=_written(s**network.order),
    )


def _written(x):
    return str(x).replace("**", "^")
