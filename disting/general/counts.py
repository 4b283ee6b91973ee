"""Number of equivalents in a case with one equation and one unknown, where it is the same for all
parameters.

THEOREM. Let h, g_1, g_2, .. be polynomials in p and x. Let no positive p be such that (1) the first
or the last coefficient of h in x is zero, (2) h and its derivative by x have a common zero x > 0,
(3) h and a g_k have a common zero x > 0. Then the number of x > 0 with h = 0 and all g_k > 0 is the
same for all positive p. Proof. The positive p are connected, so it is enough to see that the number
is the same near by. By (1) the positive zeros of h stay within some [a, b], 0 < a < b, for all p
near by; by (2) they are simple, so they move continuously, and as many as before; by (3) no g_k
changes its sign at them.

So the number at one rational p is that of all. That there are no common zeros follows from the
signs of the factors of resultants, or from the search for cases (see `cases`), in which all of p
and x are unknown then.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from math import prod
from typing import Any

from flint import ctx, fmpz, fmpz_mpoly, fmpz_poly

from disting.algebra.symbols import factorise
from disting.general.cases import cases_of
from disting.general.elimination import Case, inequalities
from disting.general.orthant import Orthant, TooMuch
from disting.model.question import Domain

SIZE = 60_000  # of resultants: terms and degrees of both
BITS = 8192  # with which a sign is looked for at most
POINT = (2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43)


def number_of_roots(ring: Orthant, case: Case) -> int | None:
    """Number of values of the only unknown that solve the only equation with all inequalities in
    it, the same number for all positive p; None where that is not proven.
    """
    free = ring.occurring((*case.equations, *case.positive))
    if ring.domain is not Domain.POSITIVE or len(case.equations) != 1 or len(free) != 1:
        return None
    (at,), (equation,) = free, case.equations
    conditions = [g for g in case.positive if g.degrees()[at]]
    try:
        ends = ring.coefficients(equation, at)
        if not (ring.sign(ends[0]) and ring.sign(ends[-1])):
            return None
        walls = (equation.derivative(at), *conditions)
        if all(_are_apart(ring, equation, wall, at) for wall in walls):
            return _count_certified(ring, equation, conditions, at)
    except TooMuch:
        pass
    return None


def at_roots(ring: Orthant, case: Case) -> Case | str:
    """A case with one equation in its only unknown, its inequalities as they are at the roots:
    remainders, where the leading coefficient of the equation has one sign; else what would have to
    hold and fails.
    """
    free = ring.occurring((*case.equations, *case.positive))
    if ring.domain is not Domain.POSITIVE or len(case.equations) != 1 or len(free) != 1:
        return case
    (at,), (equation,) = free, case.equations
    lead = ring.coefficients(equation, at)[-1]
    sign = ring.sign(lead)
    if not sign or not equation.degrees()[at]:
        return case
    try:
        rests = [remainder(ring, g, sign * equation, sign * lead, at) for g in case.positive]
        positive, failing = inequalities(ring, rests)
    except TooMuch:
        return case
    return f"{failing} > 0" if failing is not None else replace(case, positive=positive)


def remainder(
    ring: Orthant, polynomial: fmpz_mpoly, equation: fmpz_mpoly, lead: fmpz_mpoly, at: int
) -> fmpz_mpoly:
    """Polynomial with the sign of the given one where an equation with a positive leading
    coefficient is zero.
    """
    degree, x = int(equation.degrees()[at]), ring.generators[at]
    while (high := int(polynomial.degrees()[at])) >= degree and polynomial:
        if len(polynomial) * max(len(lead), len(equation)) > 100 * ring.terms:
            raise TooMuch("a remainder of many terms")
        first = ring.coefficients(polynomial, at)[-1]
        polynomial = lead * polynomial - first * x ** (high - degree) * equation
    return polynomial


def _are_apart(ring: Orthant, polynomial: fmpz_mpoly, other: fmpz_mpoly, at: int) -> bool:
    """Return True if no positive p and x are zeros of both; False where that is not found."""
    degrees = int(polynomial.degrees()[at]) * int(other.degrees()[at])
    if not degrees:
        return bool(ring.sign(other))
    if len(polynomial) * len(other) * degrees**2 < SIZE:
        resultant = polynomial.resultant(other, at)
        if resultant and all(map(ring.sign, (f for f, _ in factorise(resultant)[1]))):
            return True
    everything = Orthant(0, ring.n_given + 1, Domain.POSITIVE)
    pair = tuple(_move_unknowns(ring, everything, e, at) for e in (polynomial, other))
    try:
        return not cases_of(everything, Case(pair), tuple(everything.unknowns)).cases
    except TooMuch:
        return False


def _move_unknowns(ring: Orthant, into: Orthant, polynomial: fmpz_mpoly, at: int) -> fmpz_mpoly:
    """The same with p and x as unknowns."""
    kept = (*range(ring.n_given), at)
    terms = polynomial.to_dict().items()
    return into.context.from_dict({(*(e[i] for i in kept), 0): c for e, c in terms})


def _count_certified(
    ring: Orthant, equation: fmpz_mpoly, asked: list[fmpz_mpoly], at: int
) -> int | None:
    """The number at one point, every sign certified."""
    point = {i: POINT[i % len(POINT)] for i in range(ring.n_given)}
    return count_roots_at(ring, equation, [(g,) for g in asked], (), at, point)


def count_roots_at(
    ring: Orthant,
    equation: fmpz_mpoly,
    asked: Sequence[Sequence[fmpz_mpoly]],
    nonzero: Sequence[fmpz_mpoly],
    at: int,
    point: Mapping[int, int],
) -> int | None:
    """Count the real roots (positive ones, over positive parameters) that an equation has at a
    point of whole numbers, and near it, at which all products that are `asked` are positive; every
    sign certified.

    None at a special point: where roots are multiple or infinite, or one of the `asked` or
    `nonzero` polynomials is zero.
    """
    plain, *others = (_in_root(e, at, point) for e in (equation, *nonzero))
    products = [[_in_root(g, at, point) for g in factors] for factors in asked]
    if plain.degree() < int(equation.degrees()[at]) or plain.gcd(plain.derivative()).degree() > 0:
        return None
    is_positive, bits = ring.domain is Domain.POSITIVE, 128
    while bits <= BITS:
        with ctx.workprec(bits):
            isolated: list[Any] = plain.complex_roots()
            real = [root.real for root, _ in isolated if root.imag.is_zero()]
            signs = [[prod(_sign(g(x)) for g in factors) for factors in products] for x in real]
            signs = [
                [_sign(x), *row] if is_positive else row for x, row in zip(real, signs, strict=True)
            ]
            is_apart = all(_sign(g(x)) for g in others for x in real)
        if is_apart and all(map(all, signs)):
            return sum(min(row, default=1) > 0 for row in signs)
        bits *= 4
    return None


def _in_root(polynomial: fmpz_mpoly, at: int, point: Mapping[int, int]) -> fmpz_poly:
    """The polynomial in one variable that is left at a point of all others."""
    others: dict[str | int, int | fmpz] = {i: x for i, x in point.items()}  # noqa: C416
    terms = {int(e[at]): int(c) for e, c in polynomial.subs(others).to_dict().items()}
    return fmpz_poly([terms.get(k, 0) for k in range(max(terms, default=0) + 1)])


def _sign(ball: Any) -> int:
    return 1 if ball > 0 else -1 if ball < 0 else 0
