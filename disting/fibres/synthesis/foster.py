"""Theorems on undamped chains: equivalents that always exist and are always positive.

Let R(x) = sum r_j/(x + l_j), x = s^2, with distinct l_j >= 0 and all r_j > 0 (Foster's reactance
theorem, Bell System Technical Journal 3, 1924: a driving-point receptance is of this form). Its
zeros -z_i separate the poles, so

    1/R = m x + c - sum t_i/(x + z_i),      m, t_i > 0,      1/R(0) = c - sum t_i/z_i  (0 for a
    free row, positive at a wall)

Take any a - 1 of the zeros for the left side. The right side W_R = sum_right t_i x/(z_i (x + z_i))
is zero at x = 0, as a free end demands, and the left one W_L = 1/R(0) + sum_left t_i x/(z_i (x +
z_i)). Both have Cauer's continued fraction with positive springs and masses (W. Cauer 1926: the
terms are those of a reactance). Hence:

Foster: H = sum of residues that are all positive, so that any g of the non-zero poles can be the
grounded row: undamped models of N masses with force and sensor at the same place are all the same
over positive parameters, whatever gap and port. There are C(N-1, g) C(g-1, a_minus - 1) C(N-g-1,
a_plus - g - 1) parameter vectors, all positive.

Reversal: a row at the wall with ports a, b is the same as one with ports n + 1 - b, n + 1 - a. J =
M^(-1/2) K M^(-1/2) is a positive definite Jacobi matrix with negative off-diagonals, and every
such matrix J comes from such a row: K = S J S with S = diag(s), s = t J^(-1) e_1, has zero row
sums but for the first; s is positive because J is a nonsingular irreducible M-matrix (A. Berman,
R. Plemmons 1979), so masses s_i^2 and springs are positive. J read backwards is such a matrix too,
with the same spectrum, and t makes the gains equal: H_ab = ((J + x)^(-1))_ab / (s_a s_b).

Row by row: with the same gap, each row can be exchanged alone: two undamped models are the same
over positive parameters if their grounded rows are equal, reversed or both collocated, and their
free rows are equal or both collocated.
"""

from disting.model.chain import Chain
from disting.model.row import Row, rows_of
from disting.model.symmetry import canonical


def are_foster(left: Chain, right: Chain) -> bool:
    """Whether Foster's theorem makes two models the same.

    >>> are_foster(Chain(3, damped=False), Chain(3, 2, 2, 3, 2, 3, damped=False))
    True
    """
    return _alike(left, right) and left.collocated and right.collocated


def are_same_by_rows(left: Chain, right: Chain) -> bool:
    """Whether the theorem on single rows makes two models with the same gap the same."""
    if not _alike(left, right) or left.gap != right.gap:
        return False
    pairs = zip(*(rows_of(canonical(c).chain.structure) for c in (left, right)), strict=True)
    return all(_same(a, b) for a, b in pairs)


def _alike(left: Chain, right: Chain) -> bool:
    plain = not any(c.damped or c.ground_dampers or c.lag or c.dead_time for c in (left, right))
    return plain and (left.n_masses, left.sensor) == (right.n_masses, right.sensor)


def _same(left: Row, right: Row) -> bool:
    reverse = left.grounded and left == right.mirrored
    return left == right or left.distance == right.distance == 0 or reverse
