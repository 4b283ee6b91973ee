"""A network at a point of its values, without polynomials in them: numerator and denominator of the
transfer function with their derivatives modulo a prime.

    G(s) = s^q c^T P^-1 b,   D = det P,   N = s^q c^T adj(P) b

At a number s the inverse of P gives it all. An element adds w u v^T with w = p_e s^(r_e). With
x = P^-1 b, y = P^-T c, the derivatives along any u' and v' are those of

    D (v'^T P^-1 u'),   N (v'^T P^-1 u') - D (y^T u') (v'^T x)

u and v for the entry of the element itself; for the ratio g of a gear, u = v = e_i - g e_j, those
with -w e_j for one of both. Where a ratio is a number, all u and v are taken times the one that
makes them whole, and N times its square. The degree in s is at most the sum of the highest powers
of all rows; so many numbers s and one more give the coefficients. Node 0 has no row. A value that
divides enters as 1/p; both sides are multiplied by it.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import islice

from flint import nmod_mat, nmod_poly

from disting.algebra.quotient import Quotient, lowest_terms
from disting.network.network import Element, Network

REMEMBERED = 1024  # assemblies
Vector = tuple[tuple[int, int], ...]
"""Rows with their numbers: signs, times those of known ratios."""


@dataclass(frozen=True, slots=True)
class Entry:
    """An element: the place of its value among the parameters (None of a compartment, whose entry
    is s), its power of s, whether 1/p replaces p, where it acts and what drives it, and the place
    of its ratio, which multiplies the last row of both (None without a gear).
    """

    place: int | None
    power: int
    divides: bool
    pulls: Vector
    feels: Vector
    ratio: int | None

    def value(self, point: Sequence[int]) -> int:
        """That of its parameter."""
        return 1 if self.place is None else point[self.place]

    def sides(self, point: Sequence[int]) -> tuple[Vector, Vector]:
        """u and v with the ratio that it has at a point."""
        if self.ratio is None:
            return self.pulls, self.feels
        (i, number), (j, sign) = self.feels
        return (((i, number), (j, sign * point[self.ratio])),) * 2


@dataclass(frozen=True, slots=True, eq=False)  # one of a kind: see `_frame`
class Frame:
    """P of a network: `size` rows, `entries`; `n_values` parameters. Powers are those of s, or of
    s^(1/2).
    """

    size: int
    entries: tuple[Entry, ...]
    n_values: int

    @property
    def ungeared(self) -> "Frame":
        """The same with 1 for ratios that are numbers."""
        entries = self.entries
        if all(abs(x) == 1 for e in entries for _, x in e.feels):
            return self
        columns = []
        for e in entries:
            v = tuple((i, sign) for (i, _), sign in zip(e.feels, (1, -1), strict=False))
            columns.append(replace(e, pulls=v, feels=v))
        return _frame(self.size, tuple(columns), self.n_values)

    @property
    def highest(self) -> int:
        """Bound of the degree of D in s."""
        powers = [0] * self.size
        for e in self.entries:
            for i, _ in e.pulls:
                powers[i] = max(powers[i], e.power)
        return sum(powers)

    def rows(self, terms: Sequence[int], point: Sequence[int]) -> list[list[int]]:
        """P with these numbers for the terms of its entries, and ratios as at a point."""
        rows = [[0] * self.size for _ in range(self.size)]
        for e, term in zip(self.entries, terms, strict=True):
            u, v = e.sides(point)
            for i, a in u:
                for j, b in v:
                    rows[i][j] += a * b * term
        return rows


@dataclass(frozen=True, slots=True)
class Assembly:
    """P, b and c of a network: its frame, the ports' rows with their signs; `gained` the power of s
    and `scale` the number that multiply the numerator.
    """

    frame: Frame
    force: Vector
    sensor: Vector
    gained: int
    scale: int


@dataclass(frozen=True, slots=True)
class PointSolution:
    """P^-1 and D at a number s; `ways` the derivatives of w u v^T by each entry and each ratio: a
    number w, pairs of u' and v' to be summed, and the sum of v'^T P^-1 u'.
    """

    s: int
    den: int
    inverse: tuple[tuple[int, ...], ...]
    ways: tuple[tuple[int, tuple[tuple[Vector, Vector], ...], int], ...]


@dataclass(frozen=True, slots=True)
class Sides:
    """N and D modulo a prime and their derivatives by every parameter."""

    num: nmod_poly
    den: nmod_poly
    num_derivatives: tuple[nmod_poly, ...]
    den_derivatives: tuple[nmod_poly, ...]


@lru_cache(maxsize=REMEMBERED)
def assembly(network: Network, halves: bool) -> Assembly | None:
    """That of a network with one input and one output and without exponents, in powers of s or of
    s^(1/2); None of others.
    """
    plain = network.grounded
    if network.exponents or network.shape != (1, 1) or not plain.elements:
        return None
    step = 1 if halves else 2
    lift = max((0, *(-e.kind.halves for e in plain.elements))) // step
    places = {name: i for i, name in enumerate(network.parameters)}
    force, sensor = (
        tuple(sorted((i - 1, x) for i, x in port.ends.items()))
        for port in (plain.inputs[0], plain.outputs[0])
    )
    size = max(i for e in plain.elements for i in e.nodes)
    scale = plain.ratio_scale
    entries = tuple(_entry(e, places, e.kind.halves // step + lift, scale) for e in plain.elements)
    frame = _frame(size, entries, len(network.parameters))
    return Assembly(frame, force, sensor, 2 * network.order // step + lift, scale**2)


_frame = lru_cache(maxsize=REMEMBERED)(Frame)
"""All ports of a network share it, and it is looked up by identity, not by content."""


def _entry(e: Element, places: dict[str, int], power: int, scale: int) -> Entry:
    pulls, feels = (
        tuple((i - 1, -scale if isinstance(x, str) else int(x * scale)) for i, x in side.items())
        for side in (e.pulls, e.feels)
    )
    place, ratio = places.get(e.value), places.get(e.ratio)
    return Entry(place, power, e.kind.divides, pulls, feels, ratio)


def sides_at(of: Assembly, point: Sequence[int], modulus: int) -> Sides | None:
    """N and D at a point without zeros; None where P cannot be inverted at enough numbers s."""
    solution = solve(of.frame, tuple(point), modulus)
    if not solution:
        return None
    rows, wanted = [_at_number(of, at, modulus) for at in solution], len(solution)
    powers = nmod_mat(
        wanted, wanted, [pow(at.s, j, modulus) for at in solution for j in range(wanted)], modulus
    )
    width = len(rows[0])
    right_sides = nmod_mat(wanted, width, [x for row in rows for x in row], modulus)
    numbers = [int(x) for x in powers.solve(right_sides).entries()]
    num, den, *slopes = (nmod_poly(numbers[i::width], modulus) for i in range(width))
    return _invert_dividing(of, point, num, den, slopes)


@lru_cache(maxsize=4)  # for the other ports of the same network
def solve(of: Frame, point: tuple[int, ...], modulus: int) -> tuple[PointSolution, ...]:
    """As many numbers s as there can be powers, or none where too few are found."""
    values = [pow(e.value(point), -1, modulus) if e.divides else e.value(point) for e in of.entries]
    wanted = of.highest + 1
    tried = (_at(of, point, values, s, modulus) for s in range(1, 2 * wanted + 1))
    solveds = tuple(islice((at for at in tried if at), wanted))
    return solveds if len(solveds) == wanted else ()


def _at(
    of: Frame, point: tuple[int, ...], values: Sequence[int], s: int, modulus: int
) -> PointSolution | None:
    powers = [pow(s, e.power, modulus) for e in of.entries]
    terms = [w * value % modulus for w, value in zip(powers, values, strict=True)]
    rows = of.rows(terms, point)
    matrix = nmod_mat(of.size, of.size, [x % modulus for row in rows for x in row], modulus)
    den = int(matrix.det())
    if not den:
        return None
    flat, n = [int(x) for x in matrix.inv().entries()], of.size
    inverse = tuple(tuple(flat[i * n : i * n + n]) for i in range(n))
    ways = []
    for e, power, term in zip(of.entries, powers, terms, strict=True):
        for w, pairs in _ways(e, point, power, term):
            square = 0
            for u, v in pairs:
                for i, a in u:
                    for j, b in v:
                        square += a * b * inverse[j][i]
            ways.append((w, pairs, square % modulus))
    return PointSolution(s, den, inverse, tuple(ways))


def _ways(
    e: Entry, point: Sequence[int], power: int, term: int
) -> Iterator[tuple[int, tuple[tuple[Vector, Vector], ...]]]:
    """Yield the derivatives of an element's w u v^T by its entry and by its ratio: a number, and
    pairs of u' and v' to be summed.
    """
    u, v = e.sides(point)
    yield power, ((u, v),)
    if e.ratio is not None:
        turned = (e.feels[1],)
        yield term, ((turned, v), (u, turned))


def _at_number(of: Assembly, at: PointSolution, modulus: int) -> list[int]:
    """N without s^q and D, then the derivatives of both by the entry of each element, and by the
    ratio of each gear.
    """
    inverse, den = at.inverse, at.den
    x = [of.scale * sum(a * row[i] for i, a in of.force) for row in inverse]
    y = [sum(a * inverse[i][j] for i, a in of.sensor) for j in range(len(inverse))]
    num = den * sum(a * x[i] for i, a in of.sensor) % modulus
    sides = [num, den]
    for w, pairs, square in at.ways:
        slope = 0
        for u, v in pairs:
            left_value = moved = 0
            for i, a in u:
                left_value += a * y[i]
            for j, b in v:
                moved += b * x[j]
            slope += left_value * moved
        sides += [w * (num * square - den * slope) % modulus, w * den * square % modulus]
    return sides


def _invert_dividing(
    of: Assembly, point: Sequence[int], num: nmod_poly, den: nmod_poly, slopes: list[nmod_poly]
) -> Sides:
    """The same times all values that divide, with the derivatives by the values themselves."""
    modulus, zero = num.modulus(), num - num
    whole = 1
    for e in of.frame.entries:
        whole = whole * e.value(point) % modulus if e.divides else whole
    sides = [side * whole for side in (num, den)]
    gradients = [[zero] * of.frame.n_values, [zero] * of.frame.n_values]
    derivatives = iter(slopes)
    for e in of.frame.entries:
        pair = [next(derivatives) * whole for _ in sides]
        if e.divides and e.place is not None:
            below = pow(point[e.place], -1, modulus)
            pair = [(side - d * below) * below for side, d in zip(sides, pair, strict=True)]
        by_ratio = [] if e.ratio is None else [next(derivatives) * whole for _ in sides]
        for place, each in ((e.place, pair), (e.ratio, by_ratio)):
            if place is not None:
                for total, slope in zip(gradients, each, strict=True):
                    total[place] += slope
    up = of.gained
    return Sides(
        sides[0].left_shift(up),
        sides[1],
        tuple(d.left_shift(up) for d in gradients[0]),
        tuple(gradients[1]),
    )


def quotient_at(of: Assembly, point: Sequence[int], modulus: int) -> Quotient:
    """N/D in lowest terms at a point without zeros; both sides are zero where P cannot be
    inverted.
    """
    sides = sides_at(of, point, modulus)
    if sides is None:
        zero = nmod_poly([0], modulus)
        return Quotient(zero, zero, (), ())
    return lowest_terms(sides.num, sides.den, sides.num_derivatives, sides.den_derivatives)
