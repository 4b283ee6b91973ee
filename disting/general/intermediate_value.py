"""Unknowns that are roots: an equivalent for every p by the intermediate value theorem.

In a case with one equation h = 0 some unknowns are chosen as fractions of the p, and for the last
one, x, two points a, b of [0, oo] are sought between which h changes its sign for all p: the
numerators of h(a) and h(b) have opposite signs, and all inequalities hold on the whole way x = (a +
b t)/(1 + t), t > 0, a and b over their denominators: as polynomials in p and t they have positive
coefficients. So h has a root on the way. Or only this: THEOREM. Let each inequality g > 0 hold on
the whole way, or let g(a) > 0 and h have the sign of h(b) wherever g = 0 on it. Then all hold at
the root of h that is nearest to a. Proof. From a up to this root h has the sign of h(a). Had g a
zero there, h would have that of h(b). What h is where g = 0 shows its remainder after division by
g, multiplied by powers of the leading coefficient of g, which is to have one sign. What is solved
for is N/c, and inequalities lose even powers, so it is also required that the `nonzero` polynomials
of the case, among them these c, N and lead(q), have no common factor with h that contains x: then
for generic p none of them is zero at any root of h (their resultant with h, a polynomial in the p,
is not zero), and all other unknowns are positive there. What is tried: 0, oo, 1, single p, sums and
quotients of products of a few of them, and the roots of linear inequalities.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import combinations, combinations_with_replacement, islice, permutations
from math import prod

from flint import fmpz_mpoly

from disting.algebra.certainty import residues
from disting.algebra.symbols import RationalFunction, factorise
from disting.general.counts import number_of_roots, remainder
from disting.general.elimination import Case, fix_free, substitute
from disting.general.orthant import Orthant

CHOICES = 12  # fractions that are tried for the unknown that is chosen
TRIALS = 6  # points at which signs are looked at in rounded numbers first
QUOTIENTS = 4  # parameters up to which p_i p_j/p_k are tried

End = tuple[fmpz_mpoly, fmpz_mpoly]
"""A point of [0, oo] by numerator and denominator."""


@dataclass(frozen=True, slots=True)
class Path:
    """An equivalent for every generic p: `values`, x among them being a root of `equation`
    between `low` and `high` at which all of `where` are positive.
    """

    equation: fmpz_mpoly
    at: int
    low: End
    high: End
    values: tuple[RationalFunction, ...]
    where: tuple[fmpz_mpoly, ...] = ()


@dataclass(frozen=True, slots=True)
class Mark:
    """An end, the sign of the equation there, and whether no inequality fails there: in rounded
    numbers, at some points.
    """

    end: End
    sign: int
    inside: bool


def path(ring: Orthant, case: Case) -> Path | None:
    """A path in a case of one equation, if one of those tried is one."""
    free = ring.occurring((*case.equations, *case.positive))
    if len(case.equations) != 1 or len(free) > 2:
        return None
    if len(free) == 1:
        return _root(ring, case, free[0])
    for at in free:
        for num, den in islice(_candidates(ring), CHOICES):
            chosen = _choose_case(ring, case, at, RationalFunction(num, den))
            the_path = _root(ring, chosen, next(i for i in free if i != at)) if chosen else None
            if the_path:
                return the_path
    return None


def odd_path(ring: Orthant, case: Case) -> Path | None:
    """Over the real numbers: a root of an equation of odd degree in its only unknown, whose
    leading coefficient is not zero.
    """
    free = ring.occurring((*case.equations, *case.positive))
    if len(case.equations) != 1 or len(free) != 1 or case.equations[0].degrees()[free[0]] % 2 == 0:
        return None
    polynomial, zero = ring.number(1), ring.number(0)
    return _complete_path(ring, case, free[0], (-polynomial, zero), (polynomial, zero))


def by_count(ring: Orthant, case: Case) -> Path | None:
    """A root between 0 and oo of a case in which there are as many for all p, and some (see
    `counts`).
    """
    if not number_of_roots(ring, case) or not all(
        map(ring.occurring, ([g] for g in case.positive))
    ):
        return None
    (at,) = ring.occurring(case.equations)
    polynomial, zero = ring.number(1), ring.number(0)
    the_path = _complete_path(ring, case, at, (zero, polynomial), (polynomial, zero))
    return the_path and replace(the_path, where=case.positive)


def _choose_case(ring: Orthant, case: Case, at: int, value: RationalFunction) -> Case | None:
    the_case = substitute(ring, case, at, value)
    return the_case if isinstance(the_case, Case) and ring.occurring(the_case.equations) else None


def _root(ring: Orthant, case: Case, at: int) -> Path | None:
    ends, equation = _mark_ends(ring, case, at), case.equations[0]
    for low, high in combinations([e for e in ends if e.inside], 2):
        if _sign_change(ring, equation, at, low, high) and all(
            _holds_between(ring, g, at, low.end, high.end) for g in case.positive
        ):
            return _complete_path(ring, case, at, low.end, high.end)
    for start, goal in permutations(ends, 2):
        sign = _sign_change(ring, equation, at, start, goal) if start.inside else 0
        if sign and all(
            _holds_to_root(ring, g, sign * equation, at, (start.end, goal.end))
            for g in case.positive
        ):
            return _complete_path(ring, case, at, start.end, goal.end)
    return None


def _sign_change(ring: Orthant, equation: fmpz_mpoly, at: int, low: Mark, high: Mark) -> int:
    """The sign at the one end if it is found to be opposite to that at the other one, else 0."""
    if low.sign == high.sign:
        return 0
    signs = [_sign_of(ring, ring.put(equation, at, *mark.end)[0]) for mark in (low, high)]
    return signs[1] if signs[0] * signs[1] < 0 else 0


def _holds_to_root(
    ring: Orthant, polynomial: fmpz_mpoly, equation: fmpz_mpoly, at: int, way: tuple[End, End]
) -> bool:
    """Return True if it is positive from the start to the first root: on the whole way, or by the
    theorem. The equation is positive at the goal.
    """
    if _holds_between(ring, polynomial, at, *way):
        return True
    lead = ring.coefficients(polynomial, at)[-1]
    sign = ring.sign(lead)
    if not (sign and polynomial.degrees()[at]):
        return False
    if _sign_of(ring, ring.put(polynomial, at, *way[0])[0]) <= 0:
        return False
    rest = remainder(ring, equation, sign * polynomial, sign * lead, at)
    return _holds_between(ring, rest, at, *way)


def _complete_path(ring: Orthant, case: Case, at: int, low: End, high: End) -> Path | None:
    """The path, unless a polynomial that must not be zero has a common root with the equation
    for all p.
    """
    whole, equation = fix_free(ring, case), _of_odd_roots(case.equations[0], at)
    if any(c.gcd(equation).degrees()[at] for c in whole.nonzero):
        return None
    values = dict(whole.solved) | {at: RationalFunction(ring.generators[at], ring.number(1))}
    return Path(equation, at, low, high, tuple(values[i] for i in ring.unknowns))


def _of_odd_roots(equation: fmpz_mpoly, at: int) -> fmpz_mpoly:
    """Polynomial with the roots of an equation at which it changes its sign, once each, for all p:
    factors without the unknown and even powers do not belong to an equation for it.
    """
    parts = factorise(equation)[1]
    if all(f.degrees()[at] and power == 1 for f, power in parts):
        return equation
    return prod((f for f, power in parts if f.degrees()[at] and power % 2), start=equation**0)


def _sign_of(ring: Orthant, polynomial: fmpz_mpoly) -> int:
    """The sign of a polynomial if all its factors show theirs."""
    sign, factors = (0, ()) if polynomial.is_zero() else ring.parts(polynomial, odd=True)
    return 0 if factors else sign


def _mark_ends(ring: Orthant, case: Case, at: int) -> list[Mark]:
    """Ends at which the equation seems to have one sign: where to look."""
    marks = []
    for end in _ends(ring, case, at):
        rows = _numbers(ring, [ring.put(g, at, *end)[0] for g in (*case.equations, *case.positive)])
        if abs(sum(rows[0])) == TRIALS:
            inside = all(min(r, default=0) >= 0 for r in rows[1:])
            marks.append(Mark(end, rows[0][0], inside))
    return marks


def _numbers(ring: Orthant, polynomials: list[fmpz_mpoly]) -> list[list[int]]:
    """Signs of polynomials in the p at a few points; only as many as agree with the first."""
    signs_at = []
    for polynomial in polynomials:
        terms = [(int(c), tuple(map(int, e))) for e, c in polynomial.to_dict().items()]
        signs: list[int] = []
        for k in range(TRIALS):
            point = [x / 7 for x in residues(f"path:{k}", ring.n_given, 71)]
            value = sum(c * prod(x**a for x, a in zip(point, e, strict=False)) for c, e in terms)
            signs.append((value > 0) - (value < 0))
            if signs[0] != signs[-1] or not signs[-1]:
                break
        signs_at.append(signs)
    return signs_at


def _holds_between(ring: Orthant, polynomial: fmpz_mpoly, at: int, low: End, high: End) -> bool:
    t = ring.generators[ring.path]
    value = ring.put(polynomial, at, low[0] + high[0] * t, low[1] + high[1] * t)[0]
    return ring.sign(value) > 0


def _ends(ring: Orthant, case: Case, at: int) -> Iterator[End]:
    zero, polynomial = ring.number(0), ring.number(1)
    yield from ((zero, polynomial), (polynomial, zero))
    for g in case.positive:
        if g.degrees()[at] == 1:
            rest, factor = ring.coefficients(g, at)
            root = RationalFunction(-rest, factor)
            if ring.sign(root.num) > 0 and ring.sign(root.den) > 0:
                yield root.num, root.den
    yield from _candidates(ring)


def _candidates(ring: Orthant) -> Iterator[End]:
    """Positive fractions of the p, simple ones first."""
    p, polynomial = ring.generators[: ring.n_given], ring.number(1)
    yield from ((x, polynomial) for x in p)
    yield polynomial, polynomial
    yield from ((x + y, polynomial) for x, y in combinations(p, 2))
    yield from (
        (sum(c, ring.number(0)), polynomial)
        for k in range(3, len(p) + 1)
        for c in combinations(p, k)
    )
    yield from ((x, y) for x in p for y in p if x != y)
    if len(p) <= QUOTIENTS:
        for x, y in combinations_with_replacement(p, 2):
            yield from ((x * y, z) for z in p if z not in (x, y))
            yield from ((x * y, z + w) for z, w in combinations(p, 2))


def without_equations(ring: Orthant, case: Case) -> Case | None:
    """A case whose inequalities all hold by a choice of its unknowns as fractions of the p, if
    one that is tried does.
    """
    free = ring.occurring(case.positive)
    if not free:
        return None if case.positive else case
    if case.equations or len(free) > 2:
        return None
    for num, den in _candidates(ring):
        value = RationalFunction(num, den)
        chosen = substitute(ring, case, free[0], value)
        the_case = without_equations(ring, chosen) if isinstance(chosen, Case) else None
        if the_case:
            return the_case
    return None
