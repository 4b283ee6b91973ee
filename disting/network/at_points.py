"""A network at a point of its values, without polynomials in them: numerator and denominator of the
transfer function with their derivatives modulo a prime.

    G(s) = s^q c^T P^-1 b,   D = det P,   N = s^q c^T adj(P) b

At a number s the inverse of P gives it all. With w = p_e s^(r_e) the entry of an element, v its
vector, x = P^-1 b, y = P^-1 c and h = v^T P^-1 v:

    dD/dp_e = s^(r_e) D h,   dN/dp_e = s^(r_e) (N h - D (v^T x)(v^T y))

The degree in s is at most the sum of the highest powers of all rows; so many numbers s and one
more give the coefficients. Reciprocal networks without gears: P is symmetric. Node 0 has no row.
A value that divides enters as 1/p; both sides are multiplied by it.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

from flint import nmod_mat, nmod_poly

from disting.algebra.quotient import Quotient, lowest_terms
from disting.network.network import Network

REMEMBERED = 1024  # assemblies


@dataclass(frozen=True, slots=True)
class Entry:
    """An element: the place of its value among the parameters, its power of s, whether 1/p stands
    for p, and its rows.
    """

    place: int
    power: int
    divides: bool
    rows: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class Assembly:
    """P, b and c of a network: `size` rows, `entries`, the ports' rows with their signs, `gained`
    the power of s that multiplies the numerator; `n_values` parameters. Powers are those of s, or
    of s^(1/2).
    """

    size: int
    entries: tuple[Entry, ...]
    force: tuple[tuple[int, int], ...]
    sensor: tuple[tuple[int, int], ...]
    gained: int
    n_values: int

    @property
    def sign(self) -> int:
        """That of all terms of N; 0 where they can have several."""
        if self.force == self.sensor:
            return 1
        if self.force == tuple((i, -x) for i, x in self.sensor):
            return -1
        if len(self.force) == len(self.sensor) == 1:
            return self.force[0][1] * self.sensor[0][1]
        return 0

    @property
    def highest(self) -> int:
        """Bound of the degree of D in s."""
        return sum(
            max((e.power for e in self.entries if i in e.rows), default=0) for i in range(self.size)
        )

    def rows(self, terms: Sequence[int]) -> list[list[int]]:
        """P with these numbers for the terms of its entries."""
        found = [[0] * self.size for _ in range(self.size)]
        for e, term in zip(self.entries, terms, strict=True):
            for i in e.rows:
                found[i][i] += term
            if len(e.rows) > 1:
                i, j = e.rows
                found[i][j] -= term
                found[j][i] -= term
        return found


@dataclass(frozen=True, slots=True)
class Sides:
    """N and D modulo a prime and their derivatives by every parameter."""

    num: nmod_poly
    den: nmod_poly
    num_derivatives: tuple[nmod_poly, ...]
    den_derivatives: tuple[nmod_poly, ...]


@lru_cache(maxsize=REMEMBERED)
def assembly(network: Network, halves: bool) -> Assembly | None:
    """That of a reciprocal network with one force and one sensor, without gears and exponents, in
    powers of s or of s^(1/2); None of others.
    """
    if network.is_directed or network.exponents or network.shape != (1, 1):
        return None
    plain = network.grounded
    if any(e.ratio for e in plain.elements) or not plain.elements:
        return None
    step = 1 if halves else 2
    lift = max((0, *(-e.kind.halves for e in plain.elements))) // step
    places = {name: i for i, name in enumerate(network.parameters)}
    entries = tuple(
        Entry(
            places[e.value],
            e.kind.halves // step + lift,
            e.kind.divides,
            tuple(i - 1 for i in e.nodes if i),
        )
        for e in plain.elements
    )
    force, sensor = (
        tuple(sorted((i - 1, x) for i, x in port.ends.items()))
        for port in (plain.inputs[0], plain.outputs[0])
    )
    size = max(i for e in plain.elements for i in e.nodes)
    gained = 2 * network.order // step + lift
    return Assembly(size, entries, force, sensor, gained, len(network.parameters))


def sides_at(of: Assembly, point: Sequence[int], modulus: int) -> Sides | None:
    """N and D at a point without zeros; None where P cannot be inverted at enough numbers s."""
    values = [pow(point[e.place], -1, modulus) if e.divides else point[e.place] for e in of.entries]
    wanted = of.highest + 1
    numbers, seen = list[int](), list[list[int]]()
    for s in range(1, 2 * wanted + 1):
        row = _at_number(of, values, s, modulus)
        if row and len(seen) < wanted:
            numbers.append(s)
            seen.append(row)
    if len(seen) < wanted:
        return None
    powers = nmod_mat(
        wanted, wanted, [pow(s, j, modulus) for s in numbers for j in range(wanted)], modulus
    )
    known = nmod_mat(wanted, len(seen[0]), [x for row in seen for x in row], modulus)
    solved = [int(x) for x in powers.solve(known).entries()]
    width = len(seen[0])
    num, den, *slopes = (nmod_poly(solved[i::width], modulus) for i in range(width))
    return _turned(of, point, num, den, slopes)


def _at_number(of: Assembly, values: Sequence[int], s: int, modulus: int) -> list[int] | None:
    """N without s^q and D, then the derivatives of both by the entry of each element."""
    powers = [pow(s, e.power, modulus) for e in of.entries]
    rows = of.rows([w * value for w, value in zip(powers, values, strict=True)])
    matrix = nmod_mat(of.size, of.size, [x % modulus for row in rows for x in row], modulus)
    den = int(matrix.det())
    if not den:
        return None
    flat, n = [int(x) for x in matrix.inv().entries()], of.size
    inverse = [flat[i * n : i * n + n] for i in range(n)]
    moved, turned = (
        [sum(x * inverse[i][j] for i, x in port) for j in range(n)]
        for port in (of.force, of.sensor)
    )
    num = den * sum(x * moved[i] for i, x in of.sensor) % modulus
    found = [num, den]
    for e, w in zip(of.entries, powers, strict=True):
        i, *more = e.rows
        here, there, square = moved[i], turned[i], inverse[i][i]
        for j in more:
            here, there = here - moved[j], there - turned[j]
            square += inverse[j][j] - 2 * inverse[i][j]
        found += [
            w * (num * square - den * here * there) % modulus,
            w * den * square % modulus,
        ]
    return found


def _turned(
    of: Assembly, point: Sequence[int], num: nmod_poly, den: nmod_poly, slopes: list[nmod_poly]
) -> Sides:
    """The same times all values that divide, with the derivatives by the values themselves."""
    modulus, zero = num.modulus(), num - num
    whole = 1
    for e in of.entries:
        whole = whole * point[e.place] % modulus if e.divides else whole
    sides = [side * whole for side in (num, den)]
    found = [[zero] * of.n_values, [zero] * of.n_values]
    for k, e in enumerate(of.entries):
        for at, side in enumerate(sides):
            slope = slopes[2 * k + at] * whole
            if e.divides:
                below = pow(point[e.place], -1, modulus)
                slope = (side - slope * below) * below
            found[at][e.place] += slope
    up = of.gained
    return Sides(
        sides[0].left_shift(up),
        sides[1],
        tuple(d.left_shift(up) for d in found[0]),
        tuple(found[1]),
    )


def quotient_at(of: Assembly, point: Sequence[int], modulus: int) -> Quotient:
    """N/D in lowest terms at a point without zeros; both sides are zero where P cannot be
    inverted.
    """
    found = sides_at(of, point, modulus)
    if found is None:
        zero = nmod_poly([0], modulus)
        return Quotient(zero, zero, (), ())
    return lowest_terms(found.num, found.den, found.num_derivatives, found.den_derivatives)
