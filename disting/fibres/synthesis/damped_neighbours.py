"""Damped, force and sensor at neighbours anywhere in the chain: b = a + 1.

The spring between the ports is k = d (s + rho) with a zero -rho of N; the other zeros are shared
out, A to the left, B to the right. With k to the ground on both sides the chain falls into two: G_d
= D + d (s + rho) N = Theta Phi, Phi of degree 2 (n - a). The right end is free, so m_b Phi = k B +
O(s^2) as s goes to 0, which gives

    Phi'(0)/Phi(0) = 1/rho + B'(0)/B(0) = sigma,  or  sigma + sum of 1/z over the roots z of Phi = 0

for one of the subsets of the roots of G_d. The product E(d) of that over all subsets, times
G_d(0)^K with K = C(2n-1, 2(n-a)-1), is a polynomial in d: K subsets hold a given root. Its degree
is K - 2, since four factors fall off like d^(-1/2) as d grows: those with B, one of the two roots
near -rho and one of the two that go to infinity. With a free left end D has a double root at 0, so
that d^L with L = K - C(2n-2, 2(n-a)-1) is a factor. E is found from its values on a circle; its
roots are all candidates for d. What depends on d and rho only is computed once for all ways of
sharing out the other zeros.

Dampers to the ground on the left side alone change nothing but that D has a simple root at 0, so
that L = 0.
"""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from functools import cache, partial, reduce
from itertools import combinations
from math import comb, inf, log2
from operator import mul

from flint import acb_mat, ctx

from disting.fibres.synthesis import friction
from disting.fibres.synthesis.branch import (
    BOUNDARY,
    NONZERO,
    Ball,
    Imprecise,
    Leaf,
    Poly,
    Receptance,
    RowValues,
    circle,
    combine,
    cut,
    enclose,
    is_boundary,
    poly,
    product,
    roots,
    shift,
    through,
    vanishes,
)
from disting.fibres.synthesis.conjugate import conjugate_ways, zeros_of
from disting.fibres.synthesis.peel import Stiffness, grounded_at_zero, peel
from disting.model.row import Row

DEGREE_LIMIT = 40  # of E(d): the time grows with its square
ALONE_LIMIT = 60  # where it is done once: the poles need not be shared out between two rows
QUICK_BITS = 128  # tried first where a candidate for d is to be refuted


@dataclass(frozen=True, slots=True)
class Branch:
    """One choice of -rho and of the zeros of A and B; gain = nu."""

    row: Row
    data: Receptance
    rho: Ball
    left: list[Ball]
    right: list[Ball]
    gain: Ball

    @property
    def spring(self) -> Poly:
        """s + rho."""
        return poly([self.rho, 1])

    @property
    def sigma(self) -> Ball:
        """1/rho + B'(0)/B(0)."""
        return 1 / self.rho - sum((1 / z for z in self.right), 0 * self.rho)

    def grounded(self, d: Ball) -> Poly:
        """G_d, monic of degree 2n."""
        return cut(
            self.data.denominator + d * self.spring * self.data.numerator, 2 * self.row.n_masses
        )


def serves(row: Row) -> bool:
    """Return True if b and everything to its right has no damper to the ground, and E(d) is not too
    long.
    """
    limit = ALONE_LIMIT if row.is_whole else DEGREE_LIMIT
    return degree_of(row) <= limit and not any(i >= row.b for i in row.ground_dampers)


def degree_of(row: Row) -> int:
    """Degree of E(d), known factors d taken out."""
    return (
        comb(
            2 * row.n_masses - (1 if row.grounded or row.ground_dampers else 2),
            2 * (row.n_masses - row.a) - 1,
        )
        - 2
    )


def inner_neighbours(row: Row, data: Receptance) -> Iterator[Leaf]:
    """Yield every damped row with b = a + 1 and this receptance; a way that is refuted
    speaks for all its conjugates.
    """
    zeros, gain = zeros_of(data, row.numerator_degree), data.gain(row)
    known: dict[int, list[SubsetSums]] = {}
    for same in conjugate_ways([kind for kind, _ in zeros], 2 * (row.a - 1)):
        for way in same:
            (rho,), left, right = ([zeros[i][1] for i in some] for some in ((way[0],), *way[1:]))
            leaves = list(
                _branch(Branch(row, data, -rho, left, right, gain), known.setdefault(way[0], []))
            )
            yield from leaves
            if way is same[0] and leaves and all(leaf == NONZERO for leaf in leaves):
                break


def _branch(branch: Branch, seen: list["SubsetSums"]) -> Iterator[Leaf]:
    """Every candidate for d; `seen` is filled once for all ways with this rho."""
    if is_boundary(branch.rho):
        yield BOUNDARY
        return
    degree, radius = degree_of(branch.row), _radius(branch)
    if not seen:
        seen += [_sum_subsets(branch, d) for d in circle(degree, radius)]
    for d in roots(through([at.product(branch.sigma) for at in seen], radius), degree):
        yield from [BOUNDARY] if is_boundary(d) else _quickly(branch, d)


def _quickly(branch: Branch, d: Ball) -> Iterable[Leaf]:
    """With few bits where these refute everything: a ball without zero proves as much as a
    narrow one.
    """
    with ctx.workprec(min(QUICK_BITS, ctx.prec)):
        try:
            leaves = list(_with_damper(branch, d, enclose))
        except Imprecise:
            leaves = []
    return (
        leaves
        if leaves and all(leaf == NONZERO for leaf in leaves)
        else _with_damper(branch, d, roots)
    )


@dataclass(frozen=True, slots=True)
class SubsetSums:
    """Values of E for one d and rho: G_d(0)^K d^-L, and the sum of 1/z for every subset of the
    roots of G_d.
    """

    factor: Ball
    sums: list[Ball]

    def product(self, sigma: Ball) -> Ball:
        """E(d) G_d(0)^K d^-L."""
        return reduce(mul, (sigma + total for total in self.sums), self.factor)


def _sum_subsets(branch: Branch, d: Ball) -> SubsetSums:
    nodes, size = branch.row.n_masses, 2 * (branch.row.n_masses - branch.row.a)
    whole = branch.grounded(d)
    loose = not branch.row.grounded and not branch.row.ground_dampers
    power = comb(2 * nodes - 1, size - 1) - comb(2 * nodes - 2, size - 1) if loose else 0
    sums = subset_sums([1 / z for z in roots(whole, 2 * nodes)], size)
    return SubsetSums(whole[0] ** comb(2 * nodes - 1, size - 1) / d**power, sums)


def subset_sums(items: list[Ball], size: int) -> list[Ball]:
    """The sum of every subset of that size, in the order of itertools.combinations.

    >>> from flint import acb
    >>> subset_sums([acb(1), acb(2), acb(4)], 2) == [3, 5, 6]
    True
    """
    sums = _incidence(len(items), size) * acb_mat(len(items), 1, items)
    return list(sums.entries())


@cache
def _subsets(count: int, size: int) -> list[tuple[int, ...]]:
    """All subsets of that size, in the order of itertools.combinations."""
    return list(combinations(range(count), size))


@cache
def _incidence(count: int, size: int) -> acb_mat:
    """Rows: the subsets; 1 for each element."""
    subsets = _subsets(count, size)
    return acb_mat(
        len(subsets), count, [int(i in chosen) for chosen in subsets for i in range(count)]
    )


def _radius(branch: Branch) -> float:
    """A power of two near the d at which the lowest coefficient of G_d may vanish: where the
    roots of E are to be expected.
    """
    low = 0 if branch.row.grounded else 2 if is_boundary(branch.data.denominator[1]) else 1
    ratio = branch.data.denominator[low] / (branch.spring * branch.data.numerator)[low]
    size = float(ratio.abs_upper())
    if not 0 < size < inf:
        raise Imprecise("coefficients vanish at a special point")
    return float(2.0 ** round(log2(size)))


def _with_damper(
    branch: Branch, d: Ball, found_by: Callable[[Poly, int], list[Ball]]
) -> Iterator[Leaf]:
    """Every subset of the roots of G_d that may be Phi's; all that are refuted are one leaf."""
    nodes, size, sigma = (
        branch.row.n_masses,
        2 * (branch.row.n_masses - branch.row.a),
        branch.sigma,
    )
    zeros = found_by(branch.grounded(d), 2 * nodes)
    inverse, wanted = [1 / z for z in zeros], -sigma
    sums = subset_sums(inverse, size)
    met = [k for k, total in enumerate(sums) if total.overlaps(wanted)]
    if len(met) < len(sums):
        yield NONZERO
    for k in met:
        chosen = _subsets(2 * nodes, size)[k]
        if vanishes(sigma + sums[k], sum((abs(inverse[i]) for i in chosen), abs(sigma))):
            left = [z for i, z in enumerate(zeros) if i not in chosen]
            yield from _sides(branch, d, product(left), product([zeros[i] for i in chosen]))
        else:
            yield NONZERO


def _sides(branch: Branch, d: Ball, theta: Poly, phi: Poly) -> Iterator[Leaf]:
    """m_b Phi(0) = d rho B(0), m_a m_b = d/nu; then both sides are peeled."""
    a_poly, b_poly = product(branch.left), product(branch.right)
    if is_boundary(phi[0]) or is_boundary(b_poly[0]):
        yield BOUNDARY
        return
    m_b = d * branch.rho * b_poly[0] / phi[0]
    m_a = d / (branch.gain * m_b)
    nodes, a, spring = branch.row.n_masses, branch.row.a, d * branch.spring
    w_left = _side(m_a * theta - spring * a_poly, a_poly, m_a, a - 1, branch.row)
    w_right = _side(m_b * phi - spring * b_poly, b_poly, m_b, nodes - a - 1, None)

    def join(x: RowValues, y: RowValues) -> RowValues:
        """Left side, the two inner masses with their spring, right side."""
        return RowValues(
            (*x.masses[::-1], m_a, m_b, *y.masses),
            (*x.springs[::-1], spring, *y.springs),
            x.gauges + y.gauges,
        )

    def join_damped(b: Ball, x: RowValues, y: RowValues) -> Leaf:
        """The same with the dampers to the ground; none at the inner mass is a boundary case
        where one is meant.
        """
        plain = join(x, y)
        dampers = (*x.all_dampers[::-1], b, friction.NOTHING, *y.all_dampers)
        return (
            replace(plain, dampers=dampers)
            if a not in branch.row.ground_dampers or not is_boundary(b)
            else BOUNDARY
        )

    if not branch.row.ground_dampers:
        yield from combine(peel(w_left), lambda: peel(w_right), join)
        return
    dampers = tuple(i in branch.row.ground_dampers for i in range(a, 0, -1))
    node = friction.Node(
        w_left.numerator, w_left.denominator, dampers[0], dampers[1:], w_left.wall, False
    )
    for b, leaf in friction.solve_behind(node):
        yield from combine([leaf], lambda: peel(w_right), partial(join_damped, b))


def _side(whole: Poly, zeros: Poly, mass: Ball, nu: int, row: Row | None) -> Stiffness:
    """W = (whole - m s^2 zeros)/zeros of degree 2 nu + 1 over 2 nu; `row` for its left
    side, with its dampers in W.
    """
    wall, poles_at_zero = (row.grounded, row.poles_at_zero(2)) if row else (False, 2)
    numerator = cut(whole - mass * shift(zeros, 2), 2 * nu + 1)
    return Stiffness(
        numerator=numerator if wall else grounded_at_zero(numerator, poles_at_zero),
        denominator=zeros,
        masses=nu,
        wall=wall,
        q=2,
    )
