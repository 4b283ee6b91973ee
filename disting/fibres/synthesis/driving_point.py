"""Force and sensor at one mass: the residues of 1/H are shared out between the two sides.

H = N/D with D monic gives 1/H = m_a s^2 + W_L + W_R. The zeros of N belong to the left side or to
the right one, q (a-1) of them to the left. The right side is free, W_R(0) = W_R'(0) = 0 (undamped
W_R(0) = 0), which settles the polynomial part.

The residues of 1/H at the zeros of H are distributed between both sides (see `collocated_rows`).
W_R(0) = 0, the right end being free, which settles the constants. Far away 1/H = m_a s^2 + beta s +
.., and beta = b_a + d_L + d_R, the dampers of the springs on both sides. A side that is free and
without dampers gives its own growth, W'(0) = 0. Of b_a, d_L and d_R one that is not known follows
from beta; if more are not, the slopes of the sides are left open, and `friction` finds them.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace

from flint import arb

from disting.fibres.synthesis.branch import (
    BOUNDARY,
    NONZERO,
    Ball,
    Leaf,
    Poly,
    Receptance,
    RowValues,
    combine,
    cut,
    is_boundary,
    poly,
    product,
    roots,
    shift,
    splits,
    vanishes,
)
from disting.fibres.synthesis.friction import NOTHING, Side, peel_side, slope, without_low
from disting.fibres.synthesis.peel import Stiffness, grounded_at_zero, peel
from disting.model.row import Row


@dataclass(frozen=True, slots=True)
class Residue:
    """Zero z of the numerator and the residue of 1/H there."""

    at: Ball
    value: Ball


def collocated_rows(row: Row, data: Receptance) -> Iterator[Leaf]:
    """Yield every row with this driving-point receptance."""
    zeros = inverse_residues(data, roots(data.numerator, row.numerator_degree))
    whole = data.denominator // data.numerator
    for left, right in splits(zeros, row.q * (row.a - 1)):
        yield from join_sides(row, whole, left, right)


def inverse_residues(data: Receptance, zeros: list[Ball]) -> list[Residue]:
    """Of 1/H at the zeros of its numerator."""
    slope = data.numerator.derivative()
    return [Residue(z, data.denominator(z) / slope(z)) for z in zeros]


def join_sides(row: Row, whole: Poly, left: list[Residue], right: list[Residue]) -> Iterator[Leaf]:
    """Yield every row whose left side has the zeros `left`, its right side the zeros `right`.

    `whole`: the polynomial part of 1/H, of degree 2 (undamped 1), with the leading coefficient m_a.
    """
    q, mass = row.q, whole[row.q]
    low: list[Ball] = [
        sum((r.value / r.at ** (i + 1) for r in right), 0 * whole[0]) for i in range(q)
    ]
    p_left = over(left, [whole[i] - low[i] for i in range(q)])
    w_left = Stiffness(
        numerator=p_left if row.grounded else grounded_at_zero(p_left, q),
        denominator=product([r.at for r in left]),
        masses=row.a - 1,
        wall=row.grounded,
        q=q,
    )

    def w_right() -> Stiffness:
        """Not needed where the left side is refuted."""
        return Stiffness(
            numerator=grounded_at_zero(over(right, low), q),
            denominator=product([r.at for r in right]),
            masses=row.n_masses - row.a,
            wall=False,
            q=q,
        )

    def join(a: RowValues, b: RowValues) -> RowValues:
        """Left side, the mass between, right side."""
        return RowValues(
            (*a.masses[::-1], mass, *b.masses), (*a.springs[::-1], *b.springs), a.gauges + b.gauges
        )

    yield from combine(peel(w_left), lambda: peel(w_right()), join)


def over(residues: list[Residue], polynomial: list[Ball]) -> Poly:
    """Numerator of (polynomial + sum of residue/(s - z)) over the product of all (s - z)."""
    total = poly(polynomial) * product([r.at for r in residues])
    for i, residue in enumerate(residues):
        total = total + residue.value * product([r.at for j, r in enumerate(residues) if j != i])
    return total


@dataclass(frozen=True, slots=True)
class _Port:
    """The mass with force and sensor: its value, beta, whether it has a damper to the ground."""

    mass: Ball
    beta: Ball
    damper: bool
    scale: Ball | arb


def driving_point(row: Row, data: Receptance) -> Iterator[Leaf]:
    """Yield every row with this driving-point receptance."""
    zeros = inverse_residues(data, roots(data.numerator, row.numerator_degree))
    whole = data.denominator // data.numerator
    scale = sum((abs(c) for c in whole.coeffs()), NOTHING)
    port = _Port(whole[2], whole[1], row.a in row.ground_dampers, scale)
    for left, right in splits(zeros, 2 * (row.a - 1)):
        if not row.damped and not _is_even_far_away(right):
            yield NONZERO
            continue
        constant = sum((r.value / r.at for r in right), NOTHING)
        yield from _sides(
            port,
            _side(row, left, whole[0] - constant, True),
            _side(row, right, constant, False),
        )


def _is_even_far_away(residues: list[Residue]) -> bool:
    """Springs without dampers: W = c - c^2/(m s^2) + .. has no term in 1/s."""
    values = [r.value for r in residues]
    return (
        vanishes(sum(values, NOTHING), sum((abs(v) for v in values), NOTHING)) if values else True
    )


def _side(row: Row, residues: list[Residue], constant: Ball, left: bool) -> Side:
    """W without its growth, or with it where it is known."""
    places = range(row.a - 1, 0, -1) if left else range(row.a + 1, row.n_masses + 1)
    dampers = tuple(i in row.ground_dampers for i in places)
    side = Side(
        numerator=poly([]),
        denominator=product([r.at for r in residues]),
        dampers=dampers,
        wall=row.grounded and left,
        elastic=not row.damped,
    )
    is_known = side.is_loose and row.damped
    growth = sum((r.value / r.at**2 for r in residues), NOTHING) if is_known else NOTHING
    numerator = cut(over(residues, [constant, growth]), 2 * len(dampers) + is_known)
    return replace(
        side, numerator=without_low(numerator, side), slope_open=row.damped and not is_known
    )


def _with_growth(side: Side, growth: Ball) -> Side:
    """The side with its slope given."""
    return replace(
        side, numerator=side.numerator + growth * shift(side.denominator, 1), slope_open=False
    )


def _growth(side: Side) -> Ball:
    """Where it is known."""
    return side.numerator[2 * len(side.dampers) + 1]


def _sides(port: _Port, left: Side, right: Side) -> Iterator[Leaf]:
    """Every left side with every right one."""
    if port.damper or not (left.slope_open or right.slope_open):
        yield from combine(
            peel_side(left), lambda: peel_side(right), lambda a, b: _join_row(port, a, b)
        )
    elif left.slope_open and right.slope_open:
        for leaf in peel_side(right):
            yield from _left_of(port, left, leaf) if isinstance(leaf, RowValues) else [leaf]
    else:
        left, right = (
            (_with_growth(left, port.beta - _growth(right)), right)
            if left.slope_open
            else (left, _with_growth(right, port.beta - _growth(left)))
        )
        yield from combine(
            peel_side(left), lambda: peel_side(right), lambda a, b: _join_row(port, a, b)
        )


def _left_of(port: _Port, left: Side, right: RowValues) -> Iterator[Leaf]:
    for leaf in peel_side(_with_growth(left, port.beta - slope(right))):
        yield _join_row(port, leaf, right) if isinstance(leaf, RowValues) else leaf


def _join_row(port: _Port, left: RowValues, right: RowValues) -> Leaf:
    """The whole row; a damper that is not there must come out as zero."""
    b = port.beta - slope(left) - slope(right)
    if port.damper and is_boundary(b):
        return BOUNDARY
    if not port.damper and not vanishes(b, port.scale):
        return NONZERO
    dampers = (*left.all_dampers[::-1], b if port.damper else NOTHING, *right.all_dampers)
    masses = (*left.masses[::-1], port.mass, *right.masses)
    return RowValues(
        masses, (*left.springs[::-1], *right.springs), left.gauges + right.gauges, dampers
    )
