"""Undamped chains with the ports apart, in x = s^2: families of dimension b - a, shown by one
random member.

Neighbours (b = a + 1): for every k_a = kappa, D + kappa N = Theta Phi splits into the two sides
with kappa to the ground. Sensor at the free end (b = n): phi_(a+1)/phi_(a+1)(0) = prod (1 +
x/tau_i) with arbitrary tau_i turns the problem into the collocated one at a with the right zeros
prescribed. No test occurs: every receptance of this form has solutions, up to vanishing elements.
"""

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

from disting.algebra.sampling import residues
from disting.fibres.synthesis.ball import Ball, cut, is_boundary, poly, product, roots, shifted
from disting.fibres.synthesis.branch_ends import BOUNDARY, Leaf, Part, combined
from disting.fibres.synthesis.collocated import between
from disting.fibres.synthesis.peel import Stiffness, grounded_at_zero, peel
from disting.fibres.synthesis.segment import Data, Segment, splits


def neighbours(segment: Segment, data: Data) -> Iterator[Leaf]:
    """Yield every segment with b = a + 1 and this receptance, for one random spring between the
    ports.
    """
    yield from neighbours_at(segment, data, _random(1)[0])


def neighbours_at(segment: Segment, data: Data, spring: Any) -> Iterator[Leaf]:
    """The same for a given spring, a number or a fraction."""
    kappa, gain = spring + 0 * data.denominator[0], data.gain(segment)
    poles = roots(data.denominator + kappa * data.numerator, segment.nodes)
    zeros = roots(data.numerator, segment.numerator_degree)
    for theta, phi in splits(poles, segment.a):
        for left, right in splits(zeros, segment.a - 1):
            yield from _sides(
                segment,
                (product(theta), product(left)),
                (product(phi), product(right)),
                kappa,
                gain,
            )


def _sides(
    segment: Segment, left: tuple[Ball, Ball], right: tuple[Ball, Ball], kappa: Ball, gain: Ball
) -> Iterator[Leaf]:
    """Both sides from (Theta, A) and (Phi, B): m_b Phi(0)/B(0) = kappa (free end), m_a m_b =
    kappa/nu.
    """
    if is_boundary(right[0][0]) or is_boundary(right[1][0]):
        yield BOUNDARY
        return
    m_b = kappa * right[1][0] / right[0][0]
    m_a = kappa / (gain * m_b)
    w_left = _side(left, m_a, kappa, segment.a - 1, segment.wall)
    w_right = _side(right, m_b, kappa, segment.nodes - segment.b, False)

    def join(a: Part, b: Part) -> Part:
        """Left side, the two inner masses with their spring, right side."""
        return Part(
            (*a.masses[::-1], m_a, m_b, *b.masses), (*a.springs[::-1], poly([kappa]), *b.springs), 1
        )

    yield from combined(peel(w_left), lambda: peel(w_right), join)


def _side(pair: tuple[Ball, Ball], mass: Ball, kappa: Ball, nu: int, wall: bool) -> Stiffness:
    """W = (m Theta - kappa A - m x A)/A of degree nu over nu."""
    theta, zeros = pair
    numerator = cut(mass * theta - kappa * zeros - mass * shifted(zeros, 1), nu)
    return Stiffness(numerator if wall else grounded_at_zero(numerator, 1), zeros, nu, wall, 1)


def to_end(segment: Segment, data: Data) -> Iterator[Leaf]:
    """Yield every segment with b = n and this receptance, for random tau_i."""
    taus = _random(segment.distance)
    prescribed = [0 * data.denominator[0] - tau for tau in taus]
    numerator = data.numerator
    for tau in taus:
        numerator = numerator * poly([1, 1 / (0 * data.denominator[0] + tau)])
    drive, known = replace(segment, b=segment.a), roots(data.numerator, segment.numerator_degree)
    for leaf in between(drive, Data(numerator, data.denominator), known, prescribed):
        yield replace(leaf, gauges=segment.distance) if isinstance(leaf, Part) else leaf


def _random(count: int) -> list[float]:
    """Distinct positive numbers, exact in binary."""
    return [i + r / 4096 for i, r in enumerate(residues("synthesis:gauge", count, 1 << 12))]
