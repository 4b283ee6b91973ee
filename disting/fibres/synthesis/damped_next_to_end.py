"""Damped, sensor at the free right end, force one spring before it: a = n - 1, b = n.

The spring k = d (s + rho) between the ports contributes a zero -rho of N = nu A (s + rho). With t =
d/m_b the last mass swings on its spring with q_t = s^2 + t (s + rho), and q_t divides D/s^2 - m N
(free left end) resp. D + d (s + rho) N (wall). Modulo q_t both polynomials are linear in s, so
their coefficients form a 2 x 2 determinant C(t) of degree 2n - 4 (free) resp. 2n - 3: every
solution has C(t) = 0, and t gives the masses m_a = t/nu, m_b and the rest by peeling. Degrees: as t
grows, q_t has a root near -rho and one near -t, and the root s' near -rho has s' + rho of order
rho^2/t. For a free chain s^2 H = 1/M + 0 s + O(s^2), M the mass of the whole, so C(0) = 0: a test,
and one root less to find.

Dampers to the ground at other masses change nothing but that D/s is no longer divisible by s: q_t
divides D/s - m s N, and C has degree 2n - 3 without a test. With a damper b at the last mass too,
q_t = s^2 + beta s + t (s + rho), beta = b/m_b, divides D/s - m (s + beta) N; where the rest of the
row has no tests (every mass but one at the wall has a damper), beta is a free choice.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace

from disting.algebra.certainty import residues
from disting.fibres.synthesis import friction
from disting.fibres.synthesis.branch import (
    BOUNDARY,
    NONZERO,
    Ball,
    Leaf,
    Poly,
    Receptance,
    RowValues,
    cut,
    is_boundary,
    poly,
    product,
    roots,
    shift,
    splits,
    vanishes,
)
from disting.fibres.synthesis.peel import Stiffness, grounded_at_zero, peel
from disting.model.row import Row


@dataclass(frozen=True, slots=True)
class Linear:
    """A polynomial modulo q_t: slope (s + rho) + offset, both polynomials in t."""

    slope: Poly
    offset: Poly


@dataclass(frozen=True, slots=True)
class Branch:
    """One choice of the zero -rho; `others` are the zeros of A; gain = nu."""

    row: Row
    data: Receptance
    rho: Ball
    others: list[Ball]
    gain: Ball
    beta: Ball

    @property
    def upper(self) -> Poly:
        """D/s^2 (free, with dampers to the ground D/s) or D (wall)."""
        return (
            self.data.denominator
            if self.row.grounded
            else shift(self.data.denominator, -self.row.poles_at_zero(2))
        )

    @property
    def lower(self) -> Poly:
        """N (free; with dampers to the ground (s + beta) N) or (s + rho) N (wall)."""
        if self.row.grounded:
            return self.data.numerator * poly([self.rho, 1])
        return (
            self.data.numerator * poly([self.beta, 1])
            if self.row.ground_dampers
            else self.data.numerator
        )

    def swing(self, t: Ball) -> Poly:
        """q_t."""
        return poly([t * self.rho, t + self.beta, 1])


def next_to_end(row: Row, data: Receptance) -> Iterator[Leaf]:
    """Yield every damped row with a = n - 1, b = n and this receptance; one-parameter
    families by a sample.
    """
    zeros = roots(data.numerator, row.numerator_degree)
    for (z,), others in splits(zeros, 1):
        gain, beta = (
            data.gain(row),
            (friction.random(1)[0] if row.n_masses in row.ground_dampers else friction.NOTHING),
        )
        yield from (
            [BOUNDARY] if is_boundary(z) else _branch(Branch(row, data, -z, others, gain, beta))
        )


def is_untested(row: Row) -> bool:
    """Return True if the rest of the row adapts to any choice of beta."""
    return set(range(1 + row.grounded, row.n_masses)) <= set(row.ground_dampers)


def _branch(branch: Branch) -> Iterator[Leaf]:
    u, v = (reduce_modulo(p, branch.rho, branch.beta) for p in (branch.upper, branch.lower))
    tested = not branch.row.grounded and not branch.row.ground_dampers
    degree = 2 * branch.row.n_masses - (4 if tested else 3)
    determinant = cut(u.slope * v.offset - u.offset * v.slope, degree)
    if tested:
        if not vanishes(determinant[0], branch.upper[0] * branch.lower[0]):
            yield NONZERO
            return
        determinant, degree = shift(determinant, -1), degree - 1
    yield from (
        _any_ratio(branch, u, v)
        if degree < 0
        else _ratios(branch, u, v, roots(determinant, degree))
    )


def _ratios(branch: Branch, u: Linear, v: Linear, ratios: list[Ball]) -> Iterator[Leaf]:
    for t in ratios:
        yield from [BOUNDARY] if is_boundary(t) else _with_ratio(branch, u, v, t)


def _any_ratio(branch: Branch, u: Linear, v: Linear) -> Iterator[Leaf]:
    """Two free masses: C is zero for all t, a random one is the gauge."""
    t = branch.rho * 0 + residues("synthesis:ratio", 1, 1 << 12)[0] / 512
    for leaf in _with_ratio(branch, u, v, t):
        yield replace(leaf, gauges=1) if isinstance(leaf, RowValues) else leaf


def reduce_modulo(p: Poly, rho: Ball, beta: Ball = friction.NOTHING) -> Linear:
    """p modulo s^2 + beta s + t (s + rho), from s^(k+1) = s s^k.

    slope' = (rho - beta - t) slope + offset, offset' = -rho (rho - beta) slope - rho offset.
    """
    slope, offset, total = poly([]), poly([1]), Linear(poly([]), poly([]))
    for coefficient in p.coeffs():
        total = Linear(total.slope + coefficient * slope, total.offset + coefficient * offset)
        slope, offset = (
            poly([rho - beta, -1]) * slope + offset,
            -rho * (rho - beta) * slope - rho * offset,
        )
    return total


def _with_ratio(branch: Branch, u: Linear, v: Linear, t: Ball) -> Iterator[Leaf]:
    """The masses from t, then the peel of what is left of node a.

    Slopes and offsets have one ratio; at special points both slopes are zero, and the offsets still
    give it.
    """
    top, bottom = u.slope(t), v.slope(t)
    if is_boundary(bottom) and is_boundary(top):
        top, bottom = u.offset(t), v.offset(t)
    if is_boundary(bottom) or is_boundary(top):
        yield BOUNDARY
        return
    ratio = top / bottom
    m_b = ratio if not branch.row.grounded else -ratio / t
    m_a = t / branch.gain
    spring = t * m_b * poly([branch.rho, 1])
    last = RowValues(
        (m_b,), (), int(branch.row.n_masses in branch.row.ground_dampers), (branch.beta * m_b,)
    )
    w = _left_stiffness(branch, t, m_b, m_a)
    if not branch.row.ground_dampers:
        yield from (_attach_left(leaf, m_a, friction.NOTHING, spring, last) for leaf in peel(w))
        return
    dampers = tuple(i in branch.row.ground_dampers for i in range(w.masses + 1, 0, -1))
    for b, leaf in friction.solve_behind(
        friction.Node(w.numerator, w.denominator, dampers[0], dampers[1:], w.wall, False)
    ):
        yield (
            BOUNDARY if dampers[0] and is_boundary(b) else _attach_left(leaf, m_a, b, spring, last)
        )


def _left_stiffness(branch: Branch, t: Ball, m_b: Ball, m_a: Ball) -> Stiffness:
    """W_L + b_a s = (m_a (D - m_b s (s + beta) N)/q_t - m_a s^2 A)/A; without remainder by the
    choice of t and m_b.
    """
    nu, wall, poles_at_zero = (
        branch.row.n_masses - 2,
        branch.row.grounded,
        branch.row.poles_at_zero(2),
    )
    denominator = product(branch.others)
    driven = shift(poly([branch.beta, 1]) * branch.data.numerator, 1)
    quotient = (branch.data.denominator - m_b * driven) // branch.swing(t)
    numerator = cut(m_a * (quotient - shift(denominator, 2)), 2 * nu + 1)
    return Stiffness(
        numerator=numerator if wall else grounded_at_zero(numerator, poles_at_zero),
        denominator=denominator,
        masses=nu,
        wall=wall,
        q=2,
    )


def _attach_left(left: Leaf, m_a: Ball, b_a: Ball, spring: Poly, last: RowValues) -> Leaf:
    """The row from its left side, mass a with its damper, the spring between the ports, and the
    last mass.
    """
    if not isinstance(left, RowValues):
        return left
    dampers = (*left.all_dampers[::-1], b_a, *last.dampers)
    return RowValues(
        (*left.masses[::-1], m_a, *last.masses),
        (*left.springs[::-1], spring),
        left.gauges + last.gauges,
        dampers,
    )
