"""Distribution of the poles of a smaller model over two rows: a refutation at one of its models.

Let G = l_1/D_1 + l_2/D_2 be the receptance of a chain with a gap, from its grounded and its free
row, as functions of t = s, or of t = s^2 without dampers. The degrees are bounded: D_1 by A, l_1
by r_1, D_2 by B, l_2 by r_2; and the free row's double pole t^z (z = 2, or 1 in s^2) divides D_2.
So the pairs (N : D) of G fulfil, with some D_1 and D_2,

    D = D_1 D_2,    t^z divides D_2,    N lies in the space S = {l_1 D_2 + l_2 D_1}.

Let n/d be in lowest terms, the roots of d but 0 being distinct, and let (c n : c d) be a limit of
such pairs, k >= deg c. D_1 and D_2 have limits with these properties too, where S keeps its
dimension, and it does for min(k, A, B) < deg d - r_1 - r_2: otherwise a common factor h of D_1 and
D_2 has deg D_1 - deg h <= r_1 and deg D_2 - deg h <= r_2, so deg d + deg c <= 2 deg h + r_1 + r_2;
but each root of h is a root of c as often, so deg h <= deg c <= k, and deg h <= A, B. Then n/d =
l_1/D_1 + l_2/D_2 itself. Cancelling all common factors gives d = e f_1 f_2 and polynomials x, v, y
with

    D_1 = e v x f_1,  D_2 = e v y f_2,  v n = l_1' f_2 + l_2' f_1,  l_1 = x l_1',  l_2 = y l_2'.

There are finitely many e, f_1, f_2, and for each of them linear equations for v, l_1', l_2'. If
none has a solution with v other than 0, then n/d is no limit of the larger kind, and no equivalent
exists either. Where there is one solution up to a factor, and degrees leave no x, (l_1 : D_1) must
also fulfil the equations of the grounded row (`row_equations`).

All this is done modulo a prime p, for parameters at which d has all its roots there. It holds over
the rationals too: integers with these residues give a model whose limit (c n : c d), D_1 and D_2
over a p-adic field, scaled to be divisible by p no more, have residues with all the properties
used.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import islice, product

from disting.algebra.certainty import prime
from disting.algebra.determinants import Modular
from disting.algebra.quotient import constant, matrix, variable
from disting.behaviour.chain_model import powers
from disting.model.chain import Chain
from disting.model.row import GROUNDED, canonical_rows
from disting.questions.inclusion.profiles import row_falls
from disting.questions.inclusion.row_equations import RowEquation, equation_safety, row_equation
from disting.questions.inclusion.split_poles import (
    Split,
    accelerate,
    model_at,
    poles_of,
    polynomial_of,
    split_model,
    step_of,
)

TRIALS = 3  # points and primes, where an equation of the grounded row is used
MOST_POLES = 8  # other than 0, of the smaller model: there are 3 to this power distributions
COMMON, FIRST, SECOND = range(3)
Points = tuple[tuple[int, ...], ...]
Solution = tuple[Modular, Modular] | None


@dataclass(frozen=True, slots=True)
class Bounds:
    """The degrees A, B, r_1, r_2, z and deg d of the module's equations, and the largest degree
    k of c.
    """

    first: int
    second: int
    top_first: int
    top_second: int
    zeros: int
    poles: int
    factor: int

    @property
    def direct(self) -> bool:
        """True if the space of numerators keeps its dimension."""
        return (
            min(self.factor, self.first, self.second)
            < self.poles - self.top_first - self.top_second
        )


@dataclass(frozen=True, slots=True)
class Sharing:
    """One choice of e, f_1 and f_2, and how often 0 is a root of f_1."""

    common: Modular
    first: Modular
    second: Modular
    lacking: int


def excluding_points(small: Chain, large: Chain, label: str) -> Points:
    """Parameters of the smaller chain that refute its inclusion: one point without chance, or
    several with `row_equations`.

    Each is taken modulo the prime of a label of its own, see `labels`. () if none are found.
    """
    models = (
        split_model(small, trial) if _covers(small, large) else None for trial in labels(label)
    )
    points = tuple(split.point for split in islice(models, 1) if split is not None)
    if points and excludes(small, large, label, points):
        return points
    points += tuple(split.point for split in models if split is not None)
    return points if len(points) == TRIALS and excludes(small, large, label, points) else ()


def excludes(small: Chain, large: Chain, label: str, points: Points) -> bool:
    """Return True if these parameters of the smaller chain refute its inclusion, all of them if
    there is more than one.
    """
    count = len(accelerate(small).parameters)
    if (
        not _covers(small, large)
        or len(points) not in (1, TRIALS)
        or any(len(point) != count for point in points)
    ):
        return False
    trials = zip(labels(label), points, strict=False)
    return all(
        _excludes(small, large, trial, point, by_equation=len(points) > 1)
        for trial, point in trials
    )


def labels(label: str) -> tuple[str, ...]:
    """The labels of the trials."""
    return tuple(f"{label}:{k}" for k in range(TRIALS))


def exclusion_safety(large: Chain) -> int:
    """Largest b with P(all trials by an equation err) <= 2^-b."""
    return TRIALS * equation_safety(canonical_rows(large.structure)[GROUNDED])


def _covers(small: Chain, large: Chain) -> bool:
    """A larger chain with a gap, dampers in parallel with the springs of both or of none, no other
    dampers and no lag.
    """
    plain = not any(c.lag or c.ground_dampers for c in (small, large))
    return (
        plain and large.gap > 0 and small.damped == large.damped and poles_of(small) <= MOST_POLES
    )


def _excludes(
    small: Chain, large: Chain, label: str, point: tuple[int, ...], *, by_equation: bool
) -> bool:
    modulus = prime(label)
    split = model_at(small, point, modulus)
    if split is None:
        return False
    b = _bounds(small, large, split.n.degree())
    row = canonical_rows(large.structure)[GROUNDED]
    equation = row_equation(row, label) if by_equation else None
    shape = tuple(sorted(i // step_of(large) for i in p) for p in powers(row.structure))
    allowed = (_solutions(split.n, s, b, modulus) for s in _sharings(split, b, modulus))
    return b.factor < 0 or (
        b.direct and not any(_stands(x, b, shape, equation) for some in allowed for x in some)
    )


def _bounds(small: Chain, large: Chain, degree: int) -> Bounds:
    step = step_of(large)
    first, second = 2 * large.gap // step, 2 * (large.n_masses - large.gap) // step
    fall_second, fall_first = (-(-fall // step) for fall in row_falls(large))
    zeros, top = 2 // step, first + second - min(fall_first, fall_second)
    poles = poles_of(small) + zeros
    factor = min(first + second - poles, top - degree)
    return Bounds(first, second, first - fall_first, second - fall_second, zeros, poles, factor)


def _sharings(split: Split, b: Bounds, modulus: int) -> Iterator[Sharing]:
    """All ways to distribute the roots of d."""
    unit, t = constant(1, modulus), variable(modulus)
    for chosen in product((COMMON, FIRST, SECOND), repeat=len(split.factors)):
        parts = [unit, unit, unit]
        for place, factor in zip(chosen, split.factors, strict=True):
            parts[place] = parts[place] * factor
        for at_first, at_second in product(range(b.zeros + 1), repeat=2):
            common = b.zeros - at_first - at_second
            if common >= 0:
                shared, first, second = (
                    p * t**k for p, k in zip(parts, (common, at_first, at_second), strict=True)
                )
                yield Sharing(shared, first, second, at_first)


def _solutions(n: Modular, s: Sharing, b: Bounds, modulus: int) -> Iterator[Solution]:
    """Yield what solves v n = l_1 f_2 + l_2 f_1 with v other than 0: y takes t^i, v the rest of
    what t^z lacks in D_2.
    """
    t = variable(modulus)
    for i in range(s.lacking + 1):
        low = s.lacking - i
        room = (b.first - s.first.degree(), b.second - s.second.degree() - i)
        high = min(room) - s.common.degree()
        left = [n * t**j for j in range(low, high + 1)]
        first = [s.second * t**j for j in range(b.top_first + 1)]
        second = [s.first * t**j for j in range(b.top_second - i + 1)]
        if left and _rank(left + first + second, modulus) < len(left) + _rank(
            first + second, modulus
        ):
            yield _solution(left, first, second, s, low, modulus)


def _solution(
    left: list[Modular],
    first: list[Modular],
    second: list[Modular],
    s: Sharing,
    low: int,
    modulus: int,
) -> Solution:
    """The only solution up to a factor, as (l_1, D_1 up to x); None for more of them."""
    rows = left + first + second
    width = max(p.degree() for p in rows) + 1
    basis, nullity = matrix(
        [[int(p[j]) for p in rows] for j in range(width)], len(rows), modulus
    ).nullspace()
    if nullity > 1:
        return None
    numbers = [int(basis[k, 0]) for k in range(len(rows))]
    v = polynomial_of([0] * low + numbers[: len(left)], modulus)
    return (
        polynomial_of([-c % modulus for c in numbers[len(left) : len(left) + len(first)]], modulus),
        s.common * v * s.first,
    )


def _stands(
    solution: Solution, b: Bounds, shape: tuple[list[int], ...], equation: RowEquation | None
) -> bool:
    """Return True if the equation of the grounded row does not exclude a solution: there is none,
    or x is not constant.
    """
    if equation is None or solution is None:
        return True
    num, den = solution
    settled = den.degree() == b.first or num.degree() == b.top_first  # x would exceed a degree
    return not settled or equation.holds(
        tuple(int(p[i]) for p, powers in zip(solution, shape, strict=True) for i in powers)
    )


def _rank(polynomials: list[Modular], modulus: int) -> int:
    width = max((p.degree() for p in polynomials), default=-1) + 1
    return int(
        matrix([[int(p[j]) for j in range(width)] for p in polynomials], width, modulus).rank()
    )
