"""Points around which all have positive equivalents, from rounded values of one: Newton's method on
intervals shows that an exact one is near, however many unknowns there are and wherever force and
sensor are.

Let c_i(q) be the coefficients of numerator and denominator of the searched model, i = 0..k, those
left out that are always zero, c_0 the leading one of the denominator, g_i(p) the same ones of the
given model, not zero at p. Let h_1..h_m be homogeneous polynomials that are zero at all
coefficients of either model (see `relations`), and let their derivatives by c_i, i in Z, a set of m
numbers without 0, not be singular at g(p). R are the other numbers but 0. Let all unknowns but as
many as R has be fixed at positive rational numbers, X be a closed box of positive values of those,
x in X, F_i = c_i/g_i - c_0/g_0 for i in R, and J intervals that hold all derivatives of F on X.

THEOREM. Let J hold no singular matrix, and x - J^-1 F(x) be in X. Let c_0 not be zero on X, and
intervals that hold g_i(p) and all g_0 c_i/c_0 on X for i in Z be such that on them, with g_i(p) for
the others, the derivatives of h by Z are in intervals that hold no singular matrix. Then p has an
equivalent in X, and all values near p have a positive one too.
Proof. For y in X let M(y) be the mean of the derivatives of F on the way from x to y: it is in J,
which is convex, depends continuously on y, and F(y) - F(x) = M(y) (y - x). So y -> x - M(y)^-1 F(x)
maps X into X continuously and has a fixed point q (Brouwer): F(q) = 0. Let c' = g_0 c(q)/c_0(q). It
agrees with g = g(p) in 0 and R, and h is zero at both, so a mean of derivatives of h by Z on the
way from one to the other maps c' - g, which is in Z, to 0: c' = g, and q is an equivalent. Near p:
F depends smoothly on p and its derivatives at q are not singular, so there is a zero q' near q for
all p' near p (implicit function theorem), positive as q is. Intervals that are a little larger
still hold no singular matrix, so q' is an equivalent of p'.

Where x comes from does not matter: a search in rounded numbers proposes it.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import chain

from flint import arb, arb_mat, ctx, fmpq, fmpq_mat

from disting.errors import InputError
from disting.general.fibre_lists import is_in_one_variable
from disting.general.matrix_model import AnyModel, Model, Terms
from disting.general.relations import Relation, coefficients, relations, slope
from disting.general.search import values_near
from disting.general.target import Values, rational_values, value_at

MOST_TERMS = 1000  # of one model
BITS = 128
RADII = (1e-9, 1e-6, 1e-12)  # of the box, in times of the values
STEPS = 4  # of Newton's method before a box is drawn


@dataclass(frozen=True, slots=True)
class System:
    """The coefficients of the searched model and those that are wanted, the leading one of the
    denominator first; `solved` are R, `others` are Z.
    """

    rows: tuple[Terms, ...]
    wanted: tuple[Fraction, ...]
    unknowns: int
    solved: tuple[int, ...]
    others: tuple[int, ...]
    relations: tuple[Relation, ...]


def find_equivalent(
    model: AnyModel, values: Values, other: AnyModel, near: Sequence[float] = ()
) -> tuple[float, ...] | None:
    """A positive equivalent (rounded) in the other model of a point around which all have some:
    one `near` these values, or one that a search finds; None where nothing is shown.

    >>> from disting.general.any_model import of_network
    >>> from disting.network import network_of
    >>> star, loop = "1=2, 1=3; F1; S2", "1=2, 1=3, 2=3; F1; S2"
    >>> star, loop = (of_network(network_of(text)) for text in (star, loop))
    >>> find_equivalent(star, {name: Fraction(1) for name in star.parameters}, loop) is not None
    True
    """
    if not (isinstance(model, Model) and isinstance(other, Model) and are_alike(model, other)):
        return None
    system = _system(model, values, other)
    if system is None:
        return None
    wanted = [float(g / system.wanted[0]) for g in system.wanted[1:]]
    searched = values_near(system.rows, wanted, system.unknowns)
    for start in chain([near] if near else [], searched):
        equivalent = _certify(system, start)
        if equivalent:
            return equivalent
    return None


def are_alike(model: Model, other: Model) -> bool:
    """Return True if both have the same nonzero coefficients of powers of the same s, and few
    enough terms for a search.
    """
    if any(sum(map(len, coefficients(m))) > MOST_TERMS for m in (model, other)):
        return False
    if not is_in_one_variable(model.powers, other.powers) or model.degrees != other.degrees:
        return False
    own_pattern, other_pattern = ([bool(c) for c in coefficients(m)] for m in (model, other))
    return own_pattern == other_pattern


def _system(model: Model, values: Values, other: Model) -> System | None:
    """None where a coefficient is zero at the point."""
    try:
        point = [x for _, x in rational_values(model, values)]
    except InputError:
        return None
    wanted = tuple(value_at(terms, point) for terms in coefficients(model) if terms)
    if not all(wanted):
        return None
    own_relations = relations(model, other)
    others, own_relations = _independent(own_relations, wanted)
    solved = tuple(i for i in range(1, len(wanted)) if i not in others)
    rows = tuple(terms for terms in coefficients(other) if terms)
    unknowns = len(other.parameters)
    return (
        System(rows, wanted, unknowns, solved, others, own_relations)
        if len(solved) <= unknowns
        else None
    )


def _independent(
    own_relations: tuple[Relation, ...], wanted: Sequence[Fraction]
) -> tuple[tuple[int, ...], tuple[Relation, ...]]:
    """Coefficients by which relations have derivatives that are not singular, and those relations:
    as many as there are.
    """
    if not own_relations:
        return (), ()
    table = [
        [slope(r, wanted, i, Fraction(0)) for r in own_relations] for i in range(1, len(wanted))
    ]
    # the last columns first: those of the numerator
    columns, kept = _pivots(table[::-1]), _pivots([list(line) for line in zip(*table, strict=True)])
    chosen = tuple(sorted(len(wanted) - 1 - i for i in columns))
    return chosen, tuple(own_relations[i] for i in kept)


def _pivots(vectors: Sequence[Sequence[Fraction]]) -> list[int]:
    """Indices of the vectors that are independent of those before."""
    table = fmpq_mat(
        [[fmpq(x.numerator, x.denominator) for x in line] for line in zip(*vectors, strict=True)]
    )
    reduced, rank = table.rref()
    return [next(j for j in range(len(vectors)) if reduced[i, j]) for i in range(rank)]


def _certify(system: System, start: Sequence[float]) -> tuple[float, ...] | None:
    """The values, if the theorem shows an equivalent near them."""
    with ctx.workprec(BITS):
        chosen = _choose_unknowns(system, start)
        middle = _improve(system, [arb(x) for x in start], chosen)
        for radius in RADII if middle else ():
            box = [arb(x, radius * x) if j in chosen else x for j, x in enumerate(middle)]
            step = _solve_all(_derivatives(system, box, chosen), _errors(system, middle))
            if (
                step is not None
                and all(box[j].contains(middle[j] - step[i, 0]) for i, j in enumerate(chosen))
                and _follow(system, box)
            ):
                return tuple(float(x) for x in middle)
    return None


def _choose_unknowns(system: System, start: Sequence[float]) -> list[int]:
    """As many unknowns as equations, those on which these depend most."""
    import numpy as np
    from scipy.linalg import qr

    every = list(range(system.unknowns))
    jacobian = _derivatives(system, [arb(x) for x in start], every)
    count = len(system.solved)
    table = [[float(jacobian[i, j].mid()) * start[j] for j in every] for i in range(count)]
    table = [[x / (max(map(abs, row)) or 1) for x in row] for row in table]
    return sorted(map(int, qr(np.array(table), mode="r", pivoting=True)[1][:count]))


def _improve(system: System, values: list[arb], chosen: list[int]) -> list[arb]:
    """Numbers some steps of Newton's method further; none if they are not positive."""
    for _ in range(STEPS):
        step = _solve_all(_derivatives(system, values, chosen), _errors(system, values))
        if step is None:
            return []
        for i, j in enumerate(chosen):
            values = [*values[:j], (values[j] - step[i, 0]).mid(), *values[j + 1 :]]
        if not all(x > 0 for x in values):
            return []
    return values


def _solve_all(matrix: arb_mat, right: arb_mat) -> arb_mat | None:
    """All solutions for all matrices in these intervals; None if one may be singular."""
    try:
        return matrix.solve(right)
    except ZeroDivisionError:
        return None


def _follow(system: System, box: Sequence[arb]) -> bool:
    """Return True if the other coefficients agree where those that are solved for do."""
    if not system.others:
        return True
    balls = [sum((_term(t, box) for t in row), arb(0)) for row in system.rows]
    if balls[0].contains(0):
        return False
    hull = [_ball(g) for g in system.wanted]
    for i in system.others:
        hull[i] = hull[i].union(balls[i] / balls[0] * hull[0])
    table = [[slope(r, hull, i, arb(0)) for i in system.others] for r in system.relations]
    return _solve_all(arb_mat(table), arb_mat([[0]] * len(table))) is not None


def _errors(system: System, values: Sequence[arb]) -> arb_mat:
    """F_i, i in R."""
    sums = [
        sum((_term(t, values) for t in row), arb(0)) / _ball(g)
        for row, g in zip(system.rows, system.wanted, strict=True)
    ]
    return arb_mat([[sums[i] - sums[0]] for i in system.solved])


def _derivatives(system: System, values: Sequence[arb], chosen: Sequence[int]) -> arb_mat:
    """Those of F_i, i in R, by the chosen unknowns."""
    table = []
    for row, g in zip(system.rows, system.wanted, strict=True):
        line = [arb(0)] * len(chosen)
        for exponents, number in row:
            term = _term((exponents, number), values) / _ball(g)
            for at, j in enumerate(chosen):
                if exponents[j]:
                    line[at] += term * exponents[j] / values[j]
        table.append(line)
    return arb_mat(
        [[x - y for x, y in zip(table[i], table[0], strict=True)] for i in system.solved]
    )


def _term(term: tuple[tuple[int, ...], int], values: Sequence[arb]) -> arb:
    exponents, number = term
    total = arb(number)
    for x, e in zip(values, exponents, strict=True):
        if e:
            total *= x**e
    return total


def _ball(number: Fraction) -> arb:
    return arb(fmpq(number.numerator, number.denominator))
