"""Springs without dampers, dampers to the ground, sensor at the free right end, force one spring
before it.

The last mass swings on its spring kappa with q_t = s^2 + beta s + t, t = kappa/m_b, beta = b/m_b,
and q_t divides D - m_b s (s + beta) N. Modulo q_t, s^2 = -beta s - t, so U = D/s (at a wall D) and
V = (s + beta) N (at a wall N, kappa N in place of the product) are linear in s, and their
coefficients form a determinant C(t) of degree 2n - 3 with C(t) = 0 for every solution. With beta =
0 its leading coefficient is nu b_a/m_a, and it has double roots where a single damper makes all
odd parts multiples of each other: three masses or more need dampers at mass a and another one. Two
free masses with both dampers are a family: beta is a free choice.
"""

from collections.abc import Iterator

from disting.fibres.synthesis import friction
from disting.fibres.synthesis.branch import (
    BOUNDARY,
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
)
from disting.model.row import Row


def adapts(row: Row) -> bool:
    """Return True if the last mass has no damper, or any beta is suitable, and C has simple
    roots.
    """
    if row.n_masses == 2:
        return row.ground_dampers == (1,) or (not row.grounded and len(row.ground_dampers) == 2)
    return (
        row.n_masses not in row.ground_dampers
        and row.a in row.ground_dampers
        and len(row.ground_dampers) > 1
    )


def swing_rows(row: Row, data: Receptance) -> Iterator[Leaf]:
    """Yield every row with this receptance, of a family by a sample."""
    beta = friction.random(1)[0] if row.n_masses in row.ground_dampers else friction.NOTHING
    upper = data.denominator if row.grounded else shift(data.denominator, -1)
    lower = data.numerator if row.grounded else data.numerator * poly([beta, 1])
    (u1, u0), (v1, v0) = _reduce_modulo(upper, beta), _reduce_modulo(lower, beta)
    degree = 2 * row.n_masses - 3
    for t in roots(cut(u1 * v0 - u0 * v1, degree), degree):
        ratio = _ratio((u1(t), u0(t)), (v1(t), v0(t)))
        mass = ratio if not row.grounded or ratio is None else -ratio / t
        yield from (
            [BOUNDARY] if mass is None or is_boundary(t) else _with_mass(row, data, beta, t, mass)
        )


def _reduce_modulo(p: Poly, beta: Ball) -> tuple[Poly, Poly]:
    """Coefficients of s and 1 of p modulo s^2 + beta s + t, polynomials in t, from s^(k+1) = s
    s^k.
    """
    slope, offset, total = poly([]), poly([1]), (poly([]), poly([]))
    for coefficient in p.coeffs():
        total = (total[0] + coefficient * slope, total[1] + coefficient * offset)
        slope, offset = offset - beta * slope, -shift(slope, 1)
    return total


def _ratio(u: tuple[Ball, Ball], v: tuple[Ball, Ball]) -> Ball | None:
    """u/v, two vectors of one direction; None where that cannot be decided."""
    return next(
        (a / b for a, b in zip(u, v, strict=True) if not is_boundary(a) and not is_boundary(b)),
        None,
    )


def _with_mass(row: Row, data: Receptance, beta: Ball, t: Ball, m_b: Ball) -> Iterator[Leaf]:
    """W_L + b_a s = m_a (D - m_b s (s + beta) N)/(q_t A) - m_a s^2, m_a m_b = kappa/nu, then
    mass a and what is left of it.
    """
    nu, gain = row.n_masses - 2, data.gain(row)
    spring, m_a = poly([t * m_b]), t / gain
    zeros = product(roots(data.numerator, row.numerator_degree))
    quotient = (data.denominator - m_b * shift(poly([beta, 1]) * data.numerator, 1)) // poly(
        [t, beta, 1]
    )
    raw = cut(m_a * (quotient - shift(zeros, 2)), 2 * nu + 1)
    raw = raw if row.grounded else shift(shift(raw, -1), 1)
    dampers = tuple(i in row.ground_dampers for i in range(row.a, 0, -1))
    for b, leaf in friction.solve_behind(
        friction.Node(raw, zeros, dampers[0], dampers[1:], row.grounded, True)
    ):
        yield _join_row(row, leaf, (m_a, m_b), (b, beta * m_b), spring)


def _join_row(
    row: Row,
    left: Leaf,
    masses: tuple[Ball, Ball],
    dampers: tuple[Ball, Ball],
    spring: Poly,
) -> Leaf:
    if not isinstance(left, RowValues):
        return left
    if row.a in row.ground_dampers and is_boundary(dampers[0]):
        return BOUNDARY
    at_ports = tuple(
        b if i in row.ground_dampers else friction.NOTHING
        for i, b in zip((row.a, row.b), dampers, strict=True)
    )
    gauges = left.gauges + (row.n_masses in row.ground_dampers)
    return RowValues(
        (*left.masses[::-1], *masses),
        (*left.springs[::-1], spring),
        gauges,
        (*left.all_dampers[::-1], *at_ports),
    )
