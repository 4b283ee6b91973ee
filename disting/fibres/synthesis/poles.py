"""Assignment of poles to the grounded row: H = R + F, split by every subset of the nonzero poles.

R has q g of the simple poles z_j of H with H's residues there, F the others and the motion as a
whole, s^-q (s^-1 where dampers to the ground stop it). Far away R falls off like s^-(2+distance)
(undamped x^-(1+distance), in s twice as fast), and so does F: sums of r_j z_j^i that must vanish.
Damped there is at least one such test; it leaves none or one subset, as a rule.
"""

from collections.abc import Iterator
from dataclasses import dataclass

from flint import arb

from disting.fibres.synthesis.branch import (
    BOUNDARY,
    NONZERO,
    Ball,
    Dead,
    Poly,
    Receptance,
    cut,
    product,
    roots,
    shift,
    splits,
    vanishes,
)
from disting.model.row import Row


@dataclass(frozen=True, slots=True)
class Pole:
    """Pole z and the residue of H there."""

    at: Ball
    residue: Ball

    def moment(self, i: int) -> Ball:
        """r z^i."""
        return self.residue * self.at**i


@dataclass(frozen=True, slots=True)
class Split:
    """Receptance of the grounded row and of the free one."""

    grounded: Receptance
    free: Receptance


def pole_splits(
    data: Receptance, grounded: Row, free: Row, at_zero: int | None = None
) -> Iterator[Split | Dead]:
    """Yield the split of every subset of poles that passes all tests, and what refutes the others.

    `at_zero`: multiplicity of the pole at 0, by default q, as it is without dampers to the ground.
    """
    q = max(grounded.q, free.q)
    low = q if at_zero is None else at_zero
    poles = _poles(data, low, q * (grounded.n_masses + free.n_masses))
    markov = _markov(data, max(_decay(grounded, q), _decay(free, q), 1))
    for mine, others in splits(poles, q * grounded.n_masses):
        fits = _agree(mine, [0 * h for h in markov][: _decay(grounded, q)]) and _agree(
            mine, markov[: _decay(free, q)]
        )
        d_free = shift(product([p.at for p in others]), low)
        yield (
            _exact_order(_split(data, mine, d_free, grounded, free, q), grounded, free, q)
            if fits
            else NONZERO
        )


def _poles(data: Receptance, low: int, degree: int) -> list[Pole]:
    slope = data.denominator.derivative()
    return [
        Pole(z, data.numerator(z) / slope(z))
        for z in roots(shift(data.denominator, -low), degree - low)
    ]


def _markov(data: Receptance, count: int) -> list[Ball]:
    """h_0 .. of H = sum h_i s^(-i-1), from the long division of s^count N by D."""
    series = shift(data.numerator, count) // data.denominator
    return [series[count - 1 - i] for i in range(count)]


def _decay(row: Row, q: int) -> int:
    """Number of leading terms of its H = sum h_i s^(-i-1) (q = 1: in x) that vanish."""
    return row.relative_degree * q // 2 - 1


def _agree(mine: list[Pole], targets: list[Ball]) -> bool:
    """Return True if the sums of r z^i agree with the targets."""
    return all(_agrees([p.moment(i) for p in mine], target) for i, target in enumerate(targets))


def _agrees(moments: list[Ball], target: Ball) -> bool:
    zero: Ball = 0 * target
    return vanishes(
        sum(moments, zero) - target, sum((abs(m) for m in moments), abs(zero) + abs(target))
    )


def _exact_order(split: Split, grounded: Row, free: Row, q: int) -> Split | Dead:
    """A row whose receptance falls off faster than it can would need an infinite mass or a spring
    without damper.
    """
    pairs = ((split.grounded, grounded), (split.free, free))
    short = any(_vanishing_gain(data, row.numerator_degree_in(q)) for data, row in pairs)
    return BOUNDARY if short else split


def _vanishing_gain(data: Receptance, degree: int) -> bool:
    return vanishes(data.numerator[degree], sum((abs(c) for c in data.numerator.coeffs()), arb(0)))


def _split(
    data: Receptance, mine: list[Pole], d_free: Poly, grounded: Row, free: Row, q: int
) -> Split:
    """Numerators from the residues; coefficients that the tests found to vanish are cut."""
    d_grounded = product([p.at for p in mine])
    n_grounded = cut(_partial(mine, d_grounded), grounded.numerator_degree_in(q))
    n_free = cut((data.numerator - n_grounded * d_free) // d_grounded, free.numerator_degree_in(q))
    return Split(Receptance(n_grounded, d_grounded), Receptance(n_free, d_free))


def _partial(poles: list[Pole], denominator: Poly) -> Poly:
    """Numerator of the sum of r/(s - z)."""
    total = 0 * denominator
    for i, pole in enumerate(poles):
        total = total + pole.residue * product([p.at for j, p in enumerate(poles) if j != i])
    return total
