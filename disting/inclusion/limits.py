"""Limits of a row of masses in which one element vanishes or grows without bound.

An element with parameter w enters A(s) as w v v^T times a power of s, so numerator and denominator of the receptance are
affine in w: N/D = (N_0 + w N_1)/(D_0 + w D_1). For w without bound the limit is N_1/D_1, for w = 0 it is N_0/D_0:

| element | limit | what remains |
|---|---|---|
| spring (its damper 0) | ∞ | its two masses, and their dampers to the ground, are one; at the wall the mass rests |
| spring with its damper | 0 | the piece with force and sensor |
| mass | ∞ | it is a wall; the piece with force and sensor hangs on it |
| damper to the ground | 0 | the row without it |

So every row that results is, for all values of its parameters, a limit of rows of the larger kind; step by step also after
several limits. What is no row with one wall at most, or has force and sensor in two pieces, is left out.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache

from disting.algebra.sampling import residues
from disting.inclusion.rows import Row
from disting.invariants.transfer import receptance
from disting.model.structure import Damper, Element, GroundDamper, Mass, Spring

INFINITE, ZERO = "∞", "0"
POINTS = 3  # at which a limit is checked
REMEMBERED = 1024  # rows whose limits are kept
Step = tuple[str, str]
"""An element of the canonical form at hand, and what it tends to: INFINITE or ZERO (a spring together with its damper)."""


@dataclass(frozen=True, slots=True)
class Specialised:
    """One limit of a row: the element, what it tends to, the `row` that results, and what becomes of the nodes 0, 1, ...

    `nodes[i]` is the number of node i in the new row, 0 the wall, or None if it drops out.
    """

    element: Element
    limit: str
    row: Row
    nodes: tuple[int | None, ...]

    @property
    def step(self) -> Step:
        """The element by name, and its limit."""
        return self.element.parameter, self.limit


def specialised(row: Row) -> Iterator[Specialised]:
    """Yield every row that one limit of one element leads to.

    >>> sorted(s.step for s in specialised(Row(2, False, 1, 1)))
    [('k12', '0'), ('k12', '∞'), ('m2', '∞')]
    """
    n = row.n_masses
    for k in row.joints:
        yield from _made(row, Spring(k), INFINITE, [max(i - (i > k), 0) for i in range(n + 1)])
        yield from _made(row, Spring(k), ZERO, [i if i <= k else None for i in range(n + 1)])
        yield from _made(row, Spring(k), ZERO, [i - k if i > k else None for i in range(n + 1)])
    for k in range(1, n + 1):
        yield from _made(row, Mass(k), INFINITE, [i - k if i >= k else None for i in range(n + 1)])
        if not row.walled:
            yield from _made(row, Mass(k), INFINITE, [k - i if 0 < i <= k else None for i in range(n + 1)])
    for k in row.ground_dampers:
        yield from _made(row, GroundDamper(k), ZERO, list(range(n + 1)))


@lru_cache(maxsize=REMEMBERED)
def reached(row: Row) -> dict[Row, tuple[Step, ...]]:
    """All canonical rows that limits of a canonical row lead to, itself included, each with a shortest way there."""
    found: dict[Row, tuple[Step, ...]] = {row: ()}
    level = [row]
    while level:
        ends = [(s.row.canonical, (*found[here], s.step)) for here in level for s in specialised(here)]
        level = []
        for below, steps in ends:
            if below not in found:
                found[below] = steps
                level.append(below)
    return found


def follows(row: Row, steps: tuple[Step, ...]) -> set[Row]:
    """The canonical rows that these steps lead to, each limit seen in exact numbers."""
    rows = {row}
    for step in steps:
        ends = [(here, s) for here in rows for s in specialised(here) if s.step == step]
        rows = {s.row.canonical for here, s in ends if is_limit(here, s)}
    return rows


def is_limit(row: Row, s: Specialised) -> bool:
    """N_1/D_1 or N_0/D_0 against the new row's transfer function, at points with fractions for s and the parameters."""
    return all(_agree(row, s, seed) for seed in range(POINTS))


def _made(row: Row, element: Element, limit: str, nodes: list[int | None]) -> Iterator[Specialised]:
    """The row of the nodes that are left; none if a port is lost, or if nothing is left."""
    act, meas = nodes[row.act], nodes[row.meas]
    if not act or not meas:
        return
    walled = any(0 in (nodes[k], nodes[k + 1]) and nodes[k] != nodes[k + 1] for k in row.joints)
    left = {nodes[i] for i in row.ground_dampers if limit != ZERO or element != GroundDamper(i)}
    dampers = tuple(sorted(i for i in left if i))
    n_masses = max(i for i in nodes if i is not None)
    yield Specialised(element, limit, Row(n_masses, walled, act, meas, row.damped, dampers), tuple(nodes))


def _agree(row: Row, s: Specialised, seed: int) -> bool:
    structure = row.structure
    numbers = residues(f"specialisation:{seed}:{row}", len(structure.parameters) + 1, 10**6)
    values = {name: Fraction(n, 1000) for name, n in zip(structure.parameters, numbers, strict=False)}
    name, at = s.element.parameter, Fraction(numbers[-1], 777)
    if isinstance(s.element, Spring):
        values |= dict.fromkeys({Damper(s.element.at).parameter} & values.keys(), Fraction(0))
    (n0, d0), (n1, d1) = (_value(row, values | {name: Fraction(w)}, at) for w in (0, 1))
    num, den = (n1 - n0, d1 - d0) if s.limit == INFINITE else (n0, d0)
    left = _moved(row, s, values)
    small_num, small_den = _value(s.row, left, at)
    return all(left.values()) and num * small_den == small_num * den and den != 0


def _value(row: Row, values: dict[str, Fraction], at: Fraction) -> tuple[Fraction, Fraction]:
    """Numerator and denominator of the receptance at s = `at`."""
    found = receptance(row.structure, values, at, Fraction(1))
    return found.num, found.den


def _moved(row: Row, s: Specialised, values: dict[str, Fraction]) -> dict[str, Fraction]:
    """Parameters of the new row: elements that come together are added, those that drop out are left out.

    So each is a sum of given parameters of its own and takes all values; one that is 0 would be of no given parameter.
    """
    found = dict.fromkeys(s.row.structure.parameters, Fraction(0))
    for e in row.structure.elements:
        name = _name(e, s.nodes)
        if name in found and e != s.element:
            found[name] += values[e.parameter]
    return found


def _name(e: Element, nodes: tuple[int | None, ...]) -> str:
    """Name of an element after the limit; "" if it drops out."""
    ends = [nodes[e.at]] if e.kind in "mb" else [nodes[e.at], nodes[e.at + 1]]
    left = [i for i in ends if i is not None]
    if len(left) < len(ends) or left == [0] or (len(left) == 2 and left[0] == left[1]):
        return ""
    return e._replace(at=min(left)).parameter
