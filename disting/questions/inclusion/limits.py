"""Limits of a row of masses in which one element vanishes or grows without bound.

An element with parameter w enters A(s) as w v v^T times a power of s, so numerator and denominator
of the receptance are affine in w: N/D = (N_0 + w N_1)/(D_0 + w D_1). For w without bound the limit
is N_1/D_1, for w = 0 it is N_0/D_0:

| element | limit | what remains |
|---|---|---|
| spring (its damper 0) | ∞ | its masses, with their ground dampers, are one; or one with the wall |
| spring with its damper | 0 | the row with both ports |
| mass | ∞ | it is a wall; the row with both ports hangs on it |
| damper to the ground | 0 | the row without it |

So every row that results is, for all values of its parameters, a limit of rows of the larger kind;
step by step also after several limits. What is no row with one wall at most, or has the ports in
two rows, is left out.

Closures that must meet, because their dimensions add up: a count that proves one model to be a
limit of another.

Write the transfer functions of the larger model as N/D, and let its pairs (N : D) have
`coordinates` coefficients that do not vanish identically. The closure V of these pairs in the
projective space P of dimension `coordinates` - 1 has at least the dimension `rank`. A function n/d
is written there as (c n : c d) for every polynomial c with fitting powers of s; these pairs are a
linear subspace of dimension `factors` - 1. Two closed sets meet in a projective space if their
dimensions add up to at least that of the space (Hartshorne, Algebraic Geometry, I.7.2), so

    rank + factors >= coordinates

proves that some (c n : c d) lies in V: models of the larger kind exist whose transfer functions
tend to n/d, wherever c d is not zero. That holds for every n/d of these degrees.

`same_mass`: a free row with dampers between its masses alone has s^2 G = 1/m + O(s^2), m being its
total mass, for its momentum is the impulse. So the two lowest coefficients of D are those of N
times m. Multiplying all elements by a number multiplies m by it; so the pairs of V with a given m
have dimension rank - 1 at least. They lie, with all (c n : c d), in the subspace of the two
equations a_0 = m b_0 and a_1 = m b_1. So one dimension less is needed.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache

from disting.algebra.symbols import Polynomial, coefficients, symbols
from disting.behaviour.chain_model import ChainModel, Powers, powers
from disting.behaviour.sample import Representation, draw_point, seen_at
from disting.behaviour.transfer import plain_receptance
from disting.model.chain import Damper, Element, GroundDamper, Mass, Spring, Structure
from disting.model.row import Row, rows_of

POINTS = 2  # at which a rank is looked at; what is seen at one is a lower bound
COUNTS = 4096
INFINITE, ZERO = "∞", "0"
REMEMBERED = 1024  # rows whose limits, and limits whose identities, are kept
Step = tuple[str, str]
"""An element of the canonical form at hand, and what it tends to: INFINITE or ZERO (a spring
together with its damper).
"""


@dataclass(frozen=True, slots=True)
class Room:
    """The numbers of the module's inequality."""

    rank: int
    coordinates: int
    factors: int
    same_mass: bool

    @property
    def suffices(self) -> bool:
        """True if the dimensions add up."""
        return self.factors > 0 and self.rank + self.factors + self.same_mass >= self.coordinates


def room(small: Structure, large: Structure, seed: str = "meeting") -> Room:
    """The numbers for two structures with the same sensor, without dead time; the rank is computed
    at points of the seed.
    """
    wanted, searched = powers(small), powers(large)
    factors = sum(_fits(c, wanted, searched) for c in range(max(searched[1]) + 1))
    return Room(least_rank(large, seed), sum(map(len, searched)), factors, _same_mass(small, large))


def _fits(c: int, wanted: Powers, searched: Powers) -> bool:
    """Return True if s^c times the one has no other powers than the other."""
    return all({c + i for i in w} <= g for w, g in zip(wanted, searched, strict=True))


@lru_cache(maxsize=COUNTS)
def least_rank(structure: Structure, seed: str = "meeting") -> int:
    """A lower bound of the rank of the coefficients: what has full rank modulo a prime has it
    over the rationals.
    """
    return max(_rank_at(structure, f"{seed}:{k}") for k in range(POINTS))


def most_rank(structure: Structure) -> int:
    """An upper bound of the rank: the number of parameters, or of coefficients up to a common
    factor.
    """
    return min(len(structure.parameters), sum(map(len, powers(structure))) - 1)


def _rank_at(structure: Structure, label: str) -> int:
    return int(
        seen_at(draw_point(ChainModel(structure), label), Representation.TF, 0).jacobian.rank()
    )


def _same_mass(small: Structure, large: Structure) -> bool:
    """Return True if both determine the mass of a free row by the same two pairs of coefficients,
    odd powers of s among them.
    """
    mine, theirs = powers(small), powers(large)
    alike = all(min(m) == min(t) and min(t) + 1 in t for m, t in zip(mine, theirs, strict=True))
    return alike and all(_keeps_momentum(x) for x in (small, large))


def _keeps_momentum(structure: Structure) -> bool:
    """Return True if neither springs nor dampers connect the last row, on which the force acts, to
    the ground, and there is no lag.
    """
    row = rows_of(structure)[-1]
    return not (row.grounded or row.ground_dampers or structure.lag)


@dataclass(frozen=True, slots=True)
class Specialisation:
    """One limit of a row: the element, what it tends to, the `row` that results, and what becomes
    of the nodes 0, 1, ...

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


def specialise(row: Row) -> Iterator[Specialisation]:
    """Yield every row that one limit of one element leads to.

    >>> sorted(s.step for s in specialise(Row(2, False, 1, 1)))
    [('k12', '0'), ('k12', '∞'), ('m2', '∞')]
    """
    n = row.n_masses
    for k in row.joints:
        yield from _make_limits(
            row, Spring(k), INFINITE, [max(i - (i > k), 0) for i in range(n + 1)]
        )
        yield from _make_limits(row, Spring(k), ZERO, [i if i <= k else None for i in range(n + 1)])
        yield from _make_limits(
            row, Spring(k), ZERO, [i - k if i > k else None for i in range(n + 1)]
        )
    for k in range(1, n + 1):
        yield from _make_limits(
            row, Mass(k), INFINITE, [i - k if i >= k else None for i in range(n + 1)]
        )
        if not row.grounded:
            yield from _make_limits(
                row, Mass(k), INFINITE, [k - i if 0 < i <= k else None for i in range(n + 1)]
            )
    for k in row.ground_dampers:
        yield from _make_limits(row, GroundDamper(k), ZERO, list(range(n + 1)))


@lru_cache(maxsize=REMEMBERED)
def reach(row: Row) -> dict[Row, tuple[Step, ...]]:
    """All canonical rows that limits of a canonical row lead to, itself included, each with a
    shortest way there.
    """
    ways: dict[Row, tuple[Step, ...]] = {row: ()}
    level = [row]
    while level:
        ends = [(s.row.canonical, (*ways[at], s.step)) for at in level for s in specialise(at)]
        level = []
        for below, steps in ends:
            if below not in ways:
                ways[below] = steps
                level.append(below)
    return ways


def follows(row: Row, steps: tuple[Step, ...]) -> set[Row]:
    """The canonical rows that these steps lead to, each limit proven as an identity."""
    rows = {row}
    for step in steps:
        ends = [(at, s) for at in rows for s in specialise(at) if s.step == step]
        rows = {s.row.canonical for at, s in ends if is_limit(at, s)}
    return rows


@lru_cache(maxsize=REMEMBERED)
def is_limit(row: Row, s: Specialisation) -> bool:
    """N_1/D_1 or N_0/D_0 against the new row's transfer function: an identity of polynomials in s
    and all parameters.

    >>> all(is_limit(row, s) for row in (Row(2, False, 1, 1),) for s in specialise(row))
    True
    """
    moved = _move_parameters(row, s)
    if moved is None:
        return False
    ring = symbols(["s", *row.structure.parameters])
    zero = ring["s"] - ring["s"]
    values = ring | dict.fromkeys(
        {Damper(s.element.at).parameter} & ring.keys() if s.element.kind == "k" else (), zero
    )
    num, den = _write_receptance(row, values)
    num, den = (_part(p, s.element.parameter, s.limit) for p in (num, den))
    new = {name: sum((values[old] for old in olds), zero) for name, olds in moved.items()}
    small_num, small_den = _write_receptance(s.row, new | {"s": ring["s"]})
    # what is left over, such as the minor of a row that was split off, is a common factor; cross
    # products would be larger by far
    factor, rest = divmod(den, small_den)
    return not den.is_zero() and rest.is_zero() and (num - factor * small_num).is_zero()


def _make_limits(
    row: Row, element: Element, limit: str, nodes: list[int | None]
) -> Iterator[Specialisation]:
    """The row of the nodes that are left; none if a port is lost, or if nothing is left."""
    a, b = nodes[row.a] or 0, nodes[row.b] or 0
    if not (a and b):
        return
    grounded = any(0 in (nodes[k], nodes[k + 1]) and nodes[k] != nodes[k + 1] for k in row.joints)
    left = {nodes[i] for i in row.ground_dampers if limit != ZERO or element != GroundDamper(i)}
    dampers = tuple(sorted(i for i in left if i))
    n_masses = max(i for i in nodes if i is not None)
    yield Specialisation(
        element,
        limit,
        Row(n_masses, grounded, min(a, b), max(a, b), row.damped, dampers),
        tuple(nodes),
    )


def _write_receptance(row: Row, values: dict[str, Polynomial]) -> tuple[Polynomial, Polynomial]:
    """Numerator and denominator of the receptance for these elements and s of a ring."""
    return plain_receptance(row.structure, values, values["s"], values["s"] ** 0)


def _part(polynomial: Polynomial, name: str, limit: str) -> Polynomial:
    """P_1 (for INFINITE) or P_0 of P_0 + w P_1, w the parameter of this name."""
    parts = coefficients(polynomial, name)
    if limit == ZERO:
        return parts[0]
    return parts[1] if len(parts) > 1 else parts[0] - parts[0]


def _move_parameters(row: Row, s: Specialisation) -> dict[str, list[str]] | None:
    """Parameters of the new row, and those given that add up to each: what comes together is
    added, what drops out left out.

    So each is a sum of given parameters of its own and takes all values; None if one would be of
    no given parameter.
    """
    names: dict[str, list[str]] = {name: [] for name in s.row.structure.parameters}
    for e in row.structure.elements:
        name = _name(e, s.nodes)
        is_gone = e == s.element or (s.element.kind == "k" and e == Damper(s.element.at))
        if name in names and not is_gone:
            names[name].append(e.parameter)
    return names if all(names.values()) else None


def _name(e: Element, nodes: tuple[int | None, ...]) -> str:
    """Name of an element after the limit; "" if it drops out."""
    ends = [nodes[e.at]] if e.kind in "mb" else [nodes[e.at], nodes[e.at + 1]]
    left = [i for i in ends if i is not None]
    if len(left) < len(ends) or left == [0] or (len(left) == 2 and left[0] == left[1]):
        return ""
    return e._replace(at=min(left)).parameter
