"""Obstacles to equivalents of undamped and damped chains, from a receptance as the sum of those of
two rows: NEVER, or row by row.

H = R + F, R of the grounded row (g masses), F of the free row; d_R, d_F = springs between the
ports of each. Statements are about all positive parameters of `chain` but for a proper algebraic
subset (poles of R and F coincide, a mode has a node at a port). M is the mass of the free row.

Decay. R ~ c s^(-2-d_R) damped, c x^(-1-d_R) undamped, with c > 0, F likewise. So H falls off by 1
or 2 + min(d_R, d_F), and chains with different ones never have the same receptance.

Residues (undamped). A row with d > 0 has residues whose sum is zero, all of them non-zero: some
are negative. The residues of a row with d = 0 are squares of modes, positive. So a chain with d >
0 in one row never equals one with d = 0 in both.

Own poles (undamped, the other chain has d > 0 in a row). The residues of that row sum to zero:
which subsets of the residues r_j of `chain` do that for all parameters? A factor of all masses and
springs of one row of `chain` divides its residues alone, so the sum over the subset is zero for
each row by itself. Poles and zeros of a row can be chosen freely within a word (see
`undamped_rows`); r_j = nu N/D' at a pole grows without bound as the pole nears another of the same
row. So no proper subset of a row's sums to zero for all parameters: it is all of a row of `chain`,
with d > 0. The free row is the one with the pole 0. Hence R and F are the same functions in both
chains, with the same gap and decay; otherwise there is no equivalent.

Signs (undamped, the other chain has no gap). In a row of n masses with ports a < b, d = b - a, the
residue of mode j has the sign of (-1)^h_j, where h_0 = 0, h_(n-1) = d and h changes by 1 - z from
one mode to the next, z zeros lying between both poles (see `undamped_rows`). So in the order of the
poles the residues change their signs as often as z is 0 or 2, that is d + 2 t times with t twos,
and t <= min(a - 1, n - b). In a sum of two rows the residues of each row keep their order: they
change their signs max(d_R, d_F) times at least. If that is more than d + 2 min(a - 1, n - b) of the
other chain, it never equals the sum.

Swapped rows (damped). Let the only subsets of non-zero poles whose residues sum to zero be the
poles of R, and those of F. (At one rational point balls separate the sums of all other subsets from
zero; the product over all of them is a rational function of the parameters, so generically none
vanishes.) Then the other chain has R' = R and F' = F, or R' = F - 1/(M s^2) and F' = R + 1/(M s^2).
The first needs equal decays. The second needs
  - d_F = 0, for R' falls off with the negative factor -1/M otherwise;
  - d_R = 0: F' ~ 1/(M s^2) for s to infinity otherwise, so the other free row is collocated with
    the mass M at its port, but M is the mass of the whole row (s to 0); so there is no more than
    this mass, and R = 0;
  - hence d_R' = d_F' = 0, by the same limits.
"""

from dataclasses import replace
from enum import StrEnum
from itertools import combinations
from math import inf

from flint import acb, ctx

from disting.fibres.synthesis.branch import Ball, Imprecise, roots, shift
from disting.fibres.synthesis.fibre import PRECISIONS
from disting.fibres.synthesis.task import Point, Target, target
from disting.model.chain import Chain, Ports
from disting.model.row import Row, rows_of
from disting.model.symmetry import canonical


class Obstacle(StrEnum):
    """Statement above that excludes positive equivalents."""

    DECAY = "decay"
    RESIDUES = "residues"
    OWN_POLES = "own poles"
    SIGNS = "signs"
    SWAPPED = "swapped parts"


def rows(chain: Chain) -> tuple[Row, ...]:
    """The rows of the canonical form, the free one last."""
    return rows_of(canonical(chain).chain.structure)


def distances(chain: Chain) -> tuple[float, int]:
    """Springs between the ports in each row; infinity for a grounded row that is not there."""
    *grounded, free = rows(chain)
    return grounded[0].distance if grounded else inf, free.distance


def obstacle(chain: Chain, other: Chain) -> Obstacle | None:
    """The statement that excludes positive equivalents for all generic positive parameters
    without looking at a point.
    """
    mine, theirs = distances(chain), distances(other)
    if min(mine) != min(theirs):
        return Obstacle.DECAY
    if chain.damped:
        return None
    if is_collocated(other):
        return None if is_collocated(chain) else Obstacle.RESIDUES
    if other.gap:
        return Obstacle.OWN_POLES if (chain.gap, mine) != (other.gap, theirs) else None
    more = chain.gap and max(mine) > _most_sign_changes(*rows(other))
    return Obstacle.SIGNS if more else None


def _most_sign_changes(row: Row) -> int:
    """Of the residues, in the order of the poles."""
    return row.distance + 2 * min(row.a - 1, row.n_masses - row.b)


def receptances(chain: Chain, point: Point) -> list[Target]:
    """Receptances of the grounded row (if there is one) and of the free row, in x undamped
    and in s damped; exact.
    """
    ports = [Ports(0, chain.act_minus, 0, chain.meas_minus)] if chain.gap else []
    ports.append(Ports(0, chain.act_plus, 0, chain.meas_plus))
    q = 2 if chain.damped else 1
    return [target(replace(chain.structure, ports=p), point).folded(q) for p in ports]


def swap_fails(chain: Chain, other: Chain) -> bool:
    """Return True if neither equal nor swapped rows can give a positive equivalent; damped chains
    with a gap.
    """
    if not (chain.damped and other.damped and chain.gap and other.gap):
        return False
    mine, theirs = distances(chain), distances(other)
    own = chain.gap == other.gap and mine == theirs
    swapped = other.gap == chain.n_masses - 1 - chain.gap and max(mine) == max(theirs) == 0
    return not (own or swapped)


def only_rows_sum_to_zero(chain: Chain, point: Point, count: int) -> bool:
    """Proof at a point: no `count` non-zero poles but a row's own have residues that sum to zero.
    False proves nothing.
    """
    grounded, free = receptances(chain, point)
    if grounded.denominator.gcd(free.denominator).degree() > 0:
        return False
    for bits in PRECISIONS:
        with ctx.workprec(bits):
            try:
                own = [_residues(grounded, 0), _residues(free, 2)]
                return all(not total.contains(0) for total in _sums(own, count))
            except Imprecise:
                continue
    return False


def _sums(own: list[list[Ball]], count: int) -> list[Ball]:
    """Sums of residues over all subsets of this size but those of whole rows."""
    labelled = [(row, r) for row, residues in enumerate(own) for r in residues]
    chosen = (c for c in combinations(labelled, count) if not _is_row(c, own))
    return [sum((r for _, r in c), acb(0)) for c in chosen]


def _is_row(chosen: tuple[tuple[int, Ball], ...], own: list[list[Ball]]) -> bool:
    return len({row for row, _ in chosen}) == 1 and len(chosen) == len(own[chosen[0][0]])


def _residues(t: Target, low: int) -> list[Ball]:
    """Residues at the non-zero poles; s^low divides the denominator."""
    data, degree = t.balls, t.denominator.degree() - low
    slope = data.denominator.derivative()
    return [data.numerator(z) / slope(z) for z in roots(shift(data.denominator, -low), degree)]


def is_collocated(chain: Chain) -> bool:
    """Return True if force and sensor are at one place in each row."""
    return all(row.distance == 0 for row in rows(chain))
