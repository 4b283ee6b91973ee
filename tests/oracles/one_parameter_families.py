"""Limits of machines by explicit one-parameter families: some elements are e or 1/e, and e goes to
zero. No code of the package: machines are graphs, responses are numbers, exact fractions.

A machine is a set of elements (kind, node, node), named by kind and place. An element of kind k, d,
b, T1 or Td that is e is deleted; a spring that is 1/e makes one node of its ends, a mass that is 1/e
makes its node the ground. What then has no way to the ports is left out. Where the rest is another
chain, its nodes numbered in some way, the family tends to this chain: that is checked with numbers,
see `tends`.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from itertools import permutations
from math import exp

ORDERS = {"position": 0, "velocity": 1, "acceleration": 2}
POWERS = {"m": 2, "d": 1, "b": 1, "k": 0}
POINTS = (Fraction(3, 2), Fraction(7, 3))
SMALL = (Fraction(1, 10**9), Fraction(1, 10**13))
Element = tuple[str, int, int]
Nodes = dict[int, int]  # of the large machine: nodes of the small one; what is left out has none
Key = tuple[int, frozenset[Element], tuple[int, ...], bool, bool]


@dataclass(frozen=True)
class Family:
    """Elements of the large chain that are e (0) or 1/e (1), and where its nodes are in the small
    chain `key`.
    """

    key: Key
    nodes: tuple[tuple[int, int], ...]
    small: tuple[Element, ...]
    large: tuple[Element, ...]


def elements_of(chain) -> tuple[Element, ...]:
    """Masses, springs, dampers; ("T", 0, 0) and ("D", 0, 0) for a lag and a dead time."""
    n = chain.n_masses
    joints = [i for i in range(n) if i != chain.gap]
    return (
        *(("m", i, i) for i in range(1, n + 1)),
        *(("k", i, i + 1) for i in joints),
        *(("d", i, i + 1) for i in joints if chain.damped),
        *(("b", i, 0) for i in chain.ground_dampers),
        *[("T", 0, 0)] * chain.lag,
        *[("D", 0, 0)] * chain.dead_time,
    )


def ports_of(chain) -> tuple[int, ...]:
    """Force plus and minus, sensor plus and minus."""
    return chain.act_plus, chain.act_minus, chain.meas_plus, chain.meas_minus


def key_of(chain) -> Key:
    """What makes a chain, as a graph with numbered nodes."""
    return _key(chain.n_masses, elements_of(chain), ports_of(chain))


def families(chain) -> Iterator[Family]:
    """Yield a family to each machine with numbered nodes that deletions and contractions make of a
    chain, some of them chains; the chain itself first.
    """
    elements, ports = elements_of(chain), ports_of(chain)
    start = (tuple(range(chain.n_masses + 1)), frozenset(elements))
    seen, queue = {start}, [(start, frozenset(), frozenset())]
    while queue:
        (merged, left), small, large = queue.pop(0)
        yield from _numbered(merged, left, ports, tuple(sorted(small)), tuple(sorted(large)))
        for e in sorted(left):
            ways = [((merged, left - {e}), small | {e}, large)] if e[0] != "m" else []
            a, b = merged[e[1]], merged[e[2] if e[0] == "k" else 0]
            if e[0] in "mk" and a != b:
                one = tuple(min(a, b) if x in (a, b) else x for x in merged)
                ways.append(((one, left - {e}), small, large | {e}))
            for way in ways:
                state = _lean(*way[0])
                if state not in seen:
                    seen.add(state)
                    queue.append((state, *way[1:]))


def response(
    chain, values, s: Fraction, *, ports=None, locked=(), inertias=None, brakes=None, springs=None
) -> Fraction:
    """G(s) at a real s, `values` by element; mass i locked, known inertias, brakes and springs added."""
    n = chain.n_masses
    matrix = [[Fraction(0)] * (n + 1) for _ in range(n + 1)]
    factor = s ** ORDERS[str(chain.quantity)]
    known = [(("m", i, i), x) for i, x in (inertias or {}).items()]
    known += [(("b", i, 0), x) for i, x in (brakes or {}).items()]
    known += [(("k", i, 0), x) for i, x in (springs or {}).items()]
    for (kind, i, j), value in [*values.items(), *known]:
        if kind == "T":
            factor /= 1 + value * s
        elif kind == "D":
            factor *= Fraction(exp(-value * s))
        else:
            term = Fraction(value) * s ** POWERS[kind]
            matrix[i][i] += term
            if i != j:
                matrix[j][j] += term
                matrix[i][j] -= term
                matrix[j][i] -= term
    moving = [i for i in range(1, n + 1) if i not in locked]
    plus, minus, seen_plus, seen_minus = ports or ports_of(chain)
    force = [Fraction((i == plus) - (i == minus)) for i in moving]
    x = dict(
        zip(moving, _solved([[matrix[i][j] for j in moving] for i in moving], force), strict=True)
    )
    return factor * (x.get(seen_plus, 0) - x.get(seen_minus, 0))


def tends(family: Family, large, small, values, large_setup, small_setup) -> bool:
    """Whether the responses of the large chain come closer to those of the small one, with these
    values by element, as e goes to zero.
    """
    nodes, shares = dict(family.nodes), {}
    for e in elements_of(large):
        if e not in family.small and e not in family.large:
            shares.setdefault(_moved(e, nodes), []).append(e)
    for s in POINTS:
        wanted = response(small, values, s, **small_setup)
        errors = []
        for at in SMALL:
            given = dict.fromkeys(family.small, at) | dict.fromkeys(family.large, 1 / at)
            for target, some in shares.items():
                value = values.get(target, Fraction(1)) if target else Fraction(1)
                given |= dict.fromkeys(some, value / len(some))
            errors.append(abs(response(large, given, s, **large_setup) - wanted))
        if errors[1] > errors[0] / 1000 + Fraction(1, 10**15):
            return False
    return True


def _moved(e: Element, nodes: Nodes) -> Element | None:
    """Where an element is in the small machine; None if it is left out."""
    kind, i, j = e
    if kind in "TD":
        return e
    a, b = nodes.get(i), nodes.get(j)
    if a is None or b is None:
        return None
    return (kind, max(a, b), 0) if kind == "b" else (kind, min(a, b), max(a, b))


def _numbered(merged, left, ports, small, large) -> Iterator[Family]:
    """The machine with its nodes numbered in every way."""
    ends = tuple(merged[p] for p in ports)
    names = _reached({*ends} - {0}, {(merged[i], merged[j]) for k, i, j in left if k in "kd"})
    for order in permutations(range(1, len(names) + 1)):
        number = {0: 0} | dict(zip(names, order, strict=True))
        nodes = {i: number[at] for i, at in enumerate(merged) if at in number}
        moved = [_moved(e, nodes) for e in left]
        key = _key(len(names), [e for e in moved if e], tuple(number[p] for p in ends))
        yield Family(key, tuple(sorted(nodes.items())), small, large)


def _reached(ports, joints) -> list[int]:
    """Nodes other than the ground that joints connect with the ports."""
    found = set(ports)
    while True:
        more = {x for joint in joints if found & {*joint} for x in joint} - {0} - found
        if not more:
            return sorted(found)
        found |= more


def _lean(merged, left):
    """Without elements that are at one node, and without masses at the ground."""
    kept = frozenset(
        e
        for e in left
        if e[0] in "TD" or (merged[e[1]] != 0 if e[0] in "mb" else merged[e[1]] != merged[e[2]])
    )
    return merged, kept


def _key(n, elements, ports) -> Key:
    """Elements in parallel are one; T and D apart."""
    plain = frozenset(e for e in elements if e[0] not in "TD")
    kinds = {e[0] for e in elements}
    return n, plain, ports, "T" in kinds, "D" in kinds


def _solved(matrix, right):
    """Gauss elimination."""
    rows = [[*row, x] for row, x in zip(matrix, right, strict=True)]
    n = len(rows)
    for k in range(n):
        pivot = next(i for i in range(k, n) if rows[i][k])
        rows[k], rows[pivot] = rows[pivot], rows[k]
        rows[k] = [x / rows[k][k] for x in rows[k]]
        for i in range(n):
            if i != k and rows[i][k]:
                rows[i] = [x - rows[i][k] * y for x, y in zip(rows[i], rows[k], strict=True)]
    return [row[-1] for row in rows]
