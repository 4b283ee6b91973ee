"""Theorems on equivalent chains: duality of ports at the two sides of the gap, and Foster's.

Let R(x) = sum r_j/(x + l_j), x = s^2, with distinct l_j >= 0 and all r_j > 0 (Foster's reactance
theorem, Bell System Technical Journal 3, 1924: a driving-point receptance is of this form). Its
zeros -z_i separate the poles, so

    1/R = m x + c - sum t_i/(x + z_i),  m, t_i > 0,
    1/R(0) = c - sum t_i/z_i  (0 for a free row, positive at a wall)

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

Let F = 1/(m s^2 + W) be the driving-point receptance of a free chain of total mass M at its end, m
its first mass, k its first spring (any law k(s)), F1 the receptance of the rest, of mass M1 = M -
m. Then 1/W = 1/k + F1, and with R1 = F1 - 1/(M1 s^2)

    1/(F - 1/(M s^2)) = (M m/M1) s^2 + (M/M1)^2 / (1/k + R1)

By induction F - 1/(M s^2) is the receptance of a grounded chain at its free end: mass M m/M1 at
the port, behind it the spring (M/M1)^2 k and (M/M1)^2 times the grounded chain of R1 (no mass,
hence the wall, if there is no R1). The map is a bijection of positive parameters, for given M; so
H = R + F = (F - 1/(M s^2)) + (R + 1/(M s^2)) is the receptance of both chains: they are
indistinguishable over complex, real and positive parameters. Springs and dampers are multiplied by
the same factors.

Membership proven by construction: undamped chains whose two rows are known exactly.

The undamped methods have no tests: once the receptances of the grounded and of the free row are
rational functions of the right degrees, every choice of roots and gauges leads to a chain, as long
as no element and no divisor is zero, which balls can prove. So a branch that is completed is a
proof, if both receptances are exact. They are if the given chain has g or N - 1 - g masses before
its gap (or the other chain has no gap): then its own grounded or free poles are the ones to take.
"""

from collections.abc import Iterator, Mapping
from dataclasses import replace

from flint import ctx

from disting.algebra.symbols import Scalar
from disting.fibres.synthesis.branch import Imprecise, RowValues
from disting.fibres.synthesis.fibre import PRECISIONS
from disting.fibres.synthesis.methods import is_covered, synthesise
from disting.fibres.synthesis.task import Exact, Point, Target, target
from disting.model.chain import Chain, Ports
from disting.model.row import Row, grounded_and_free, rows_of
from disting.model.symmetry import canonical

Law = tuple[Scalar, ...]  # (c, d) of a spring and its damper, (c,) undamped
Outwards = tuple[
    list[Scalar], list[tuple[Scalar, ...]]
]  # masses and springs from the port outwards


def is_plain(chain: Chain) -> bool:
    """Return True if it consists of masses and springs alone."""
    return not (chain.damped or chain.ground_dampers or chain.lag or chain.dead_time)


def is_untested(chain: Chain) -> bool:
    """Return True if the synthesis of this chain has no tests at all: undamped, one row or force
    and sensor at one mass of each row.

    Then every solution that is listed exists.
    """
    grounded, free = grounded_and_free(chain.structure)
    return is_plain(chain) and (grounded is None or grounded.distance == free.distance == 0)


def is_constructed(chain: Chain, point: Point, other: Chain) -> bool:
    """Return True if a solution of `other` for the given model is proven to exist; False proves
    nothing.
    """
    grounded, free = grounded_and_free(canonical(other).chain.structure)
    if (
        not is_plain(chain)
        or not is_plain(other)
        or not all(is_covered(s) for s in (grounded, free) if s)
    ):
        return False
    whole = target(chain.structure, point).folded(1)
    if grounded is None:
        return whole.numerator.degree() == free.numerator_degree and _exists(free, whole)
    return any(
        all(_exists(*pair) for pair in pairs)
        for pairs in exact_rows(chain, point, whole, grounded, free)
    )


def exact_rows(
    chain: Chain, point: Point, whole: Target, grounded: Row, free: Row
) -> Iterator[list[tuple[Row, Target]]]:
    """Yield the receptances of both rows, of the right degrees, where the given chain's own
    poles are the ones to take.
    """
    for poles in _poles(chain, point, whole):
        summands = _summands(whole, poles) if poles.degree() == grounded.n_masses else None
        pairs = list(zip((grounded, free), summands, strict=True)) if summands else []
        if pairs and all(t.numerator.degree() == row.numerator_degree for row, t in pairs):
            yield pairs


def _poles(chain: Chain, point: Point, whole: Target) -> tuple[Exact, Exact]:
    """Denominator of the given chain's grounded row, and of its free row without the motion
    of the whole.
    """
    ports = Ports(0, chain.act_plus, 0, chain.meas_plus)
    free = target(replace(chain.structure, ports=ports), point).folded(1).denominator
    return whole.denominator // free, free // type(free)([0, 1])


def _summands(whole: Target, poles: Exact) -> tuple[Target, Target] | None:
    """H = R + F with these poles for R."""
    others = whole.denominator // poles
    common, inverse, _ = others.xgcd(poles)
    if common.degree() > 0:
        return None
    top = whole.numerator * inverse % poles
    rest = (whole.numerator - top * others) // poles
    return Target(top, poles), Target(rest, others)


def _exists(row: Row, exact: Target) -> bool:
    for bits in PRECISIONS:
        with ctx.workprec(bits):
            try:
                return any(isinstance(leaf, RowValues) for leaf in synthesise(row, exact.balls))
            except Imprecise:
                continue
    return False


def are_foster(left: Chain, right: Chain) -> bool:
    """Return True if two models are equivalent by Foster's theorem.

    >>> are_foster(Chain(3, damped=False), Chain(3, 2, 2, 3, 2, 3, damped=False))
    True
    """
    return _alike(left, right) and left.collocated and right.collocated


def are_same_by_rows(left: Chain, right: Chain) -> bool:
    """Return True if two models with the same gap are equivalent by the theorem on single rows."""
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


def are_dual(left: Chain, right: Chain) -> bool:
    """Return True if the duality theorem applies.

    >>> are_dual(Chain(3, 0, 0, 1, 0, 1, damped=True), Chain(3, 2, 2, 3, 2, 3, damped=True))
    True
    """
    plain = all(_at_gap(c) for c in (left, right)) and (left.damped, left.sensor) == (
        right.damped,
        right.sensor,
    )
    return plain and left.n_masses == right.n_masses == left.gap + right.gap + 1


def dual(chain: Chain, values: Mapping[str, Scalar]) -> dict[str, Scalar]:
    """Parameters of the dual chain with the same transfer function; exact for exact values."""
    n, g = chain.n_masses, chain.gap
    masses = [values[f"m{i}"] for i in range(1, n + 1)]
    names = [name for name in chain.parameters if name[0] == "k"]
    laws: list[Law[Scalar]] = [
        (values[k], values[f"d{k[1:]}"]) if chain.damped else (values[k],) for k in names
    ]
    total = sum(masses[g + 1 :], masses[g])
    inner, springs = _ground_row(masses[g:], laws[g:], total)
    outer, others = _free(masses[:g][::-1], laws[:g][::-1], total)
    target = _mirror_gap(chain)
    return dict(
        zip(
            target.parameters,
            _in_order(target, inner[::-1] + outer, springs[::-1] + others),
            strict=True,
        )
    )


def _at_gap(chain: Chain) -> bool:
    plain = not (chain.ground_dampers or chain.lag or chain.dead_time)
    return (
        plain
        and chain.collocated
        and (chain.act_minus, chain.act_plus) == (chain.gap, chain.gap + 1)
    )


def _mirror_gap(chain: Chain) -> Chain:
    h = chain.n_masses - 1 - chain.gap
    return Chain(chain.n_masses, h, h, h + 1, h, h + 1, sensor=chain.sensor, damped=chain.damped)


def _ground_row(
    masses: list[Scalar], springs: list[Law[Scalar]], total: Scalar
) -> Outwards[Scalar]:
    """The row of F - 1/(M s^2)."""
    if not springs:
        return [], []
    rest = total - masses[0]
    inner, laws = _ground_row(masses[1:], springs[1:], rest)
    factor = (total / rest) ** 2
    return [total * masses[0] / rest, *(factor * m for m in inner)], [
        _scale_law(law, factor) for law in (springs[0], *laws)
    ]


def _free(masses: list[Scalar], springs: list[Law[Scalar]], total: Scalar) -> Outwards[Scalar]:
    """The row of R + 1/(M s^2), the inverse: M1 = M^2/(M + mu)."""
    if not masses:
        return [total], []
    rest = total**2 / (total + masses[0])
    factor = (rest / total) ** 2
    inner, laws = _free(
        [factor * m for m in masses[1:]], [_scale_law(law, factor) for law in springs[1:]], rest
    )
    return [total - rest, *inner], [_scale_law(springs[0], factor), *laws]


def _scale_law(law: Law[Scalar], factor: Scalar) -> Law[Scalar]:
    return tuple(factor * x for x in law)


def _in_order(chain: Chain, masses: list[Scalar], laws: list[Law[Scalar]]) -> list[Scalar]:
    """Masses, springs, dampers: the order of a chain's parameters."""
    return [*masses, *(law[0] for law in laws), *(law[1] for law in laws if chain.damped)]
