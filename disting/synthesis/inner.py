"""Damped, force and sensor at neighbours anywhere in the chain: b = a + 1.

The spring between the ports is k = d (s + rho) with a zero -rho of N; the other zeros are shared out, A to the left, B to the
right. With k to the ground on both sides the chain falls into two: G_d = D + d (s + rho) N = Theta Phi, Phi of degree 2 (n -
a). The right end is free, so m_b Phi = k B + O(s^2) as s goes to 0, which says

    Phi'(0)/Phi(0) = 1/rho + B'(0)/B(0) = sigma,    or    sigma + sum of 1/z over the roots z of Phi = 0

for one of the subsets of the roots of G_d. The product E(d) of that over all subsets, times G_d(0)^K with K = C(2n-1,
2(n-a)-1), is a polynomial in d: K subsets hold a given root. Its degree is K - 2, since four factors fall off like d^(-1/2) as
d grows: those with B, one of the two roots near -rho and one of the two that go to infinity. With a free left end D has a
double root at 0, so that d^L with L = K - C(2n-2, 2(n-a)-1) is a factor. E is found from its values on a circle; its roots are
all candidates for d.

Dampers to the ground on the left side alone change nothing but that D has a simple root at 0, so that L = 0.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import partial
from itertools import combinations
from math import comb, inf, log2

from flint import acb, fmpq

from disting.synthesis import friction
from disting.synthesis.ball import Ball, Imprecise, Poly, cut, is_boundary, poly, product, roots, shifted, vanishes
from disting.synthesis.leaves import BOUNDARY, NONZERO, Leaf, Part, combined
from disting.synthesis.peel import Stiffness, grounded_at_zero, peel
from disting.synthesis.segment import Data, Segment, splits

DEGREE_LIMIT = 40  # of E(d): the time grows with its square


@dataclass(frozen=True, slots=True)
class Branch:
    """One choice of -rho and of the zeros of A and B; gain = nu."""

    segment: Segment
    data: Data
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
        return cut(self.data.denominator + d * self.spring * self.data.numerator, 2 * self.segment.nodes)


def serves(segment: Segment) -> bool:
    """Whether b and what is right of it has no damper to the ground, and E(d) is not too long."""
    return degree_of(segment) <= DEGREE_LIMIT and not any(i >= segment.b for i in segment.dampers)


def degree_of(segment: Segment) -> int:
    """Degree of E(d), known factors d taken out."""
    return comb(2 * segment.nodes - (1 if segment.wall or segment.dampers else 2), 2 * (segment.nodes - segment.a) - 1) - 2


def inner_neighbours(segment: Segment, data: Data) -> Iterator[Leaf]:
    """Yield every damped segment with b = a + 1 and this receptance."""
    zeros, gain = roots(data.numerator, segment.numerator_degree), data.gain(segment)
    for (z,), others in splits(zeros, 1):
        for left, right in splits(others, 2 * (segment.a - 1)):
            yield from ([BOUNDARY] if is_boundary(z) else _branch(Branch(segment, data, -z, left, right, gain)))


def _branch(branch: Branch) -> Iterator[Leaf]:
    degree = degree_of(branch.segment)
    for d in roots(interpolated(lambda at: _product(branch, at), degree, _radius(branch)), degree):
        yield from [BOUNDARY] if is_boundary(d) else _with_damper(branch, d)


def _product(branch: Branch, d: Ball) -> Ball:
    """E(d) G_d(0)^K d^-L."""
    nodes, size = branch.segment.nodes, 2 * (branch.segment.nodes - branch.segment.a)
    whole, sigma = branch.grounded(d), branch.sigma
    inverse = [1 / z for z in roots(whole, 2 * nodes)]
    value: Ball = whole[0] ** comb(2 * nodes - 1, size - 1)
    for chosen in combinations(inverse, size):
        value = value * sum(chosen, sigma)
    loose = not branch.segment.wall and not branch.segment.dampers
    known = comb(2 * nodes - 1, size - 1) - comb(2 * nodes - 2, size - 1) if loose else 0
    return value / d**known


def _radius(branch: Branch) -> float:
    """A power of two near the d at which the lowest coefficient of G_d may vanish: where the roots of E are to be expected."""
    low = 0 if branch.segment.wall else 2 if is_boundary(branch.data.denominator[1]) else 1
    ratio = branch.data.denominator[low] / (branch.spring * branch.data.numerator)[low]
    size = float(ratio.abs_upper())
    if not 0 < size < inf:
        raise Imprecise("coefficients vanish at a special point")
    return float(2.0 ** round(log2(size)))


def interpolated(value: Callable[[Ball], Ball], degree: int, radius: float = 1.0) -> Poly:
    """The polynomial of this degree from its values on a circle (radius: a power of two)."""
    count = degree + 1
    unit = [acb.exp_pi_i(acb(fmpq(2 * j, count))) for j in range(count)]
    values = [value(radius * u) for u in unit]
    sums = [sum((v * unit[-i * k % count] for k, v in enumerate(values)), acb(0)) / count for i in range(count)]
    return poly([c / acb(radius) ** i for i, c in enumerate(sums)])


def _with_damper(branch: Branch, d: Ball) -> Iterator[Leaf]:
    """Every subset of the roots of G_d that may be Phi's."""
    segment, sigma = branch.segment, branch.sigma
    for right, left in splits(roots(branch.grounded(d), 2 * segment.nodes), 2 * (segment.nodes - segment.a)):
        inverse = [1 / z for z in right]
        fits = vanishes(sum(inverse, sigma), sum((abs(w) for w in inverse), abs(sigma)))
        yield from _sides(branch, d, product(left), product(right)) if fits else [NONZERO]


def _sides(branch: Branch, d: Ball, theta: Poly, phi: Poly) -> Iterator[Leaf]:
    """m_b Phi(0) = d rho B(0), m_a m_b = d/nu; then both sides are peeled."""
    a_poly, b_poly = product(branch.left), product(branch.right)
    if is_boundary(phi[0]) or is_boundary(b_poly[0]):
        yield BOUNDARY
        return
    m_b = d * branch.rho * b_poly[0] / phi[0]
    m_a = d / (branch.gain * m_b)
    nodes, a, spring = branch.segment.nodes, branch.segment.a, d * branch.spring
    w_left = _side(m_a * theta - spring * a_poly, a_poly, m_a, a - 1, branch.segment)
    w_right = _side(m_b * phi - spring * b_poly, b_poly, m_b, nodes - a - 1, None)

    def join(x: Part, y: Part) -> Part:
        return Part((*x.masses[::-1], m_a, m_b, *y.masses), (*x.springs[::-1], spring, *y.springs), x.gauges + y.gauges)

    def join_damped(b: Ball, x: Part, y: Part) -> Leaf:
        plain = join(x, y)
        dampers = (*x.all_dampers[::-1], b, friction.NOTHING, *y.all_dampers)
        return replace(plain, dampers=dampers) if a not in branch.segment.dampers or not is_boundary(b) else BOUNDARY

    if not branch.segment.dampers:
        yield from combined(peel(w_left), lambda: peel(w_right), join)
        return
    dampers = tuple(i in branch.segment.dampers for i in range(a, 0, -1))
    node = friction.Node(w_left.numerator, w_left.denominator, dampers[0], dampers[1:], w_left.wall, False)
    for b, leaf in friction.behind(node):
        yield from combined([leaf], lambda: peel(w_right), partial(join_damped, b))


def _side(whole: Poly, zeros: Poly, mass: Ball, nu: int, segment: Segment | None) -> Stiffness:
    """W = (whole - m s^2 zeros)/zeros of degree 2 nu + 1 over 2 nu; `segment` for its left side, with its dampers in W."""
    wall, known = (segment.wall, segment.poles_at_zero) if segment else (False, 2)
    numerator = cut(whole - mass * shifted(zeros, 2), 2 * nu + 1)
    return Stiffness(numerator if wall else grounded_at_zero(numerator, known), zeros, nu, wall, 2)
