"""Force and sensor at one mass: the residues of 1/H are shared out between the two sides.

H = N/D with D monic gives 1/H = m_a s^2 + W_L + W_R. The zeros of N belong to the left side or to
the right one, q (a-1) of them to the left. The right side is free, W_R(0) = W_R'(0) = 0 (undamped
W_R(0) = 0), which settles the polynomial part.
"""

from collections.abc import Iterator
from dataclasses import dataclass

from disting.fibres.synthesis.ball import Ball, Poly, Receptance, poly, product, roots, splits
from disting.fibres.synthesis.branch_ends import Leaf, RowValues, combined
from disting.fibres.synthesis.peel import Stiffness, grounded_at_zero, peel
from disting.model.row import Row


@dataclass(frozen=True, slots=True)
class Residue:
    """Zero z of the numerator and the residue of 1/H there."""

    at: Ball
    value: Ball


def collocated(row: Row, data: Receptance) -> Iterator[Leaf]:
    """Yield every row with this driving-point receptance."""
    zeros = inverse_residues(data, roots(data.numerator, row.numerator_degree))
    whole = data.denominator // data.numerator
    for left, right in splits(zeros, row.q * (row.a - 1)):
        yield from between(row, whole, left, right)


def inverse_residues(data: Receptance, zeros: list[Ball]) -> list[Residue]:
    """Of 1/H at the zeros of its numerator."""
    slope = data.numerator.derivative()
    return [Residue(z, data.denominator(z) / slope(z)) for z in zeros]


def between(row: Row, whole: Poly, left: list[Residue], right: list[Residue]) -> Iterator[Leaf]:
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

    yield from combined(peel(w_left), lambda: peel(w_right()), join)


def over(residues: list[Residue], polynomial: list[Ball]) -> Poly:
    """Numerator of (polynomial + sum of residue/(s - z)) over the product of all (s - z)."""
    total = poly(polynomial) * product([r.at for r in residues])
    for i, residue in enumerate(residues):
        total = total + residue.value * product([r.at for j, r in enumerate(residues) if j != i])
    return total
