"""Undamped chains with the ports apart, in x = s^2: families of dimension b - a, shown by one
random member.

Neighbours (b = a + 1): for every k_a = kappa, D + kappa N = Theta Phi splits into the two sides
with kappa to the ground. Sensor at the free end (b = n): phi_(a+1)/phi_(a+1)(0) = prod (1 +
x/tau_i) with arbitrary tau_i turns the problem into the collocated one at a with the right zeros
prescribed. No test occurs: every receptance of this form has solutions, up to vanishing elements.
"""

from collections.abc import Iterator
from dataclasses import replace

from flint import fmpq

from disting.algebra.certainty import residues
from disting.fibres.synthesis.branch import (
    BOUNDARY,
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
)
from disting.fibres.synthesis.driving_point import inverse_residues, join_sides
from disting.fibres.synthesis.peel import Stiffness, grounded_at_zero, peel
from disting.model.row import Row


def neighbours(row: Row, data: Receptance) -> Iterator[Leaf]:
    """Yield every row with b = a + 1 and this receptance, for one random spring between the
    ports.
    """
    yield from neighbours_at(row, data, _random(1)[0])


def neighbours_at(row: Row, data: Receptance, spring: float | fmpq) -> Iterator[Leaf]:
    """The same for a given spring, a number or a fraction."""
    kappa, gain = spring + 0 * data.denominator[0], data.gain(row)
    poles = roots(data.denominator + kappa * data.numerator, row.n_masses)
    zeros = roots(data.numerator, row.numerator_degree)
    for theta, phi in splits(poles, row.a):
        for left, right in splits(zeros, row.a - 1):
            yield from _sides(
                row,
                (product(theta), product(left)),
                (product(phi), product(right)),
                kappa,
                gain,
            )


def _sides(
    row: Row, left: tuple[Poly, Poly], right: tuple[Poly, Poly], kappa: Ball, gain: Ball
) -> Iterator[Leaf]:
    """Both sides from (Theta, A) and (Phi, B): m_b Phi(0)/B(0) = kappa (free end), m_a m_b =
    kappa/nu.
    """
    if is_boundary(right[0][0]) or is_boundary(right[1][0]):
        yield BOUNDARY
        return
    m_b = kappa * right[1][0] / right[0][0]
    m_a = kappa / (gain * m_b)
    w_left = _side(left, m_a, kappa, row.a - 1, row.grounded)
    w_right = _side(right, m_b, kappa, row.n_masses - row.b, False)

    def join(a: RowValues, b: RowValues) -> RowValues:
        """Left side, the two inner masses with their spring, right side."""
        return RowValues(
            (*a.masses[::-1], m_a, m_b, *b.masses), (*a.springs[::-1], poly([kappa]), *b.springs), 1
        )

    yield from combine(peel(w_left), lambda: peel(w_right), join)


def _side(pair: tuple[Poly, Poly], mass: Ball, kappa: Ball, nu: int, wall: bool) -> Stiffness:
    """W = (m Theta - kappa A - m x A)/A of degree nu over nu."""
    theta, zeros = pair
    numerator = cut(mass * theta - kappa * zeros - mass * shift(zeros, 1), nu)
    return Stiffness(
        numerator=numerator if wall else grounded_at_zero(numerator, 1),
        denominator=zeros,
        masses=nu,
        wall=wall,
        q=1,
    )


def to_end(row: Row, data: Receptance) -> Iterator[Leaf]:
    """Yield every row with b = n and this receptance, for random tau_i."""
    taus = _random(row.distance)
    prescribed = [0 * data.denominator[0] - tau for tau in taus]
    numerator = data.numerator
    for tau in taus:
        numerator = numerator * poly([1, 1 / (0 * data.denominator[0] + tau)])
    drive, own_zeros = (
        Receptance(numerator, data.denominator),
        roots(data.numerator, row.numerator_degree),
    )
    left, right = (inverse_residues(drive, zeros) for zeros in (own_zeros, prescribed))
    for leaf in join_sides(replace(row, b=row.a), drive.denominator // numerator, left, right):
        yield replace(leaf, gauges=row.distance) if isinstance(leaf, RowValues) else leaf


def _random(count: int) -> list[float]:
    """Distinct positive numbers, exact in binary."""
    return [i + r / 4096 for i, r in enumerate(residues("synthesis:gauge", count, 1 << 12))]
