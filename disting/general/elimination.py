"""Cases of equations and inequalities: values put into them, and two equations in two unknowns as
one equation in one of them. See `cases` for the definition of cases and the proof.

Let e and f be polynomials in x and y, irreducible and different, and let R be their resultant in y.
R = A e + B f, so R(x) = 0 at every common zero: one of its factors h is zero there.

Pseudo-remainders c^k g = Q h + r of e and f, their contents (greatest divisors without y) left out,
lead to a polynomial s y + t: times the contents it is a combination of e and f, so at a common zero
at which no content vanishes s y + t = 0. Let h be irreducible, and divide neither s nor a content.
Then these have no common zero with h for generic p (the resultant of both is a polynomial in the p
that is not zero), so y = -t/s there. Conversely x with h(x) = 0 and y = -t/s is a common zero if h
divides the numerators of e(x, -t/s) and f(x, -t/s); if it does not divide both there is none, for
generic p.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass

from flint import fmpz_mpoly

from disting.algebra.symbols import RationalFunction, factorise
from disting.general.orthant import Orthant, TooMuch

SIZE = 200_000  # product of numbers of terms and degrees of both: below, less than a second


Line = tuple[fmpz_mpoly, fmpz_mpoly]
"""(t, s) of s y + t."""


@dataclass(frozen=True, slots=True)
class Branch:
    """Common zeros at which `factor`, a polynomial in one unknown, is zero: where a `line` (t, s)
    is known the unknown at its position is -t/s.
    """

    factor: fmpz_mpoly
    line: tuple[int, fmpz_mpoly, fmpz_mpoly] | None = None


@dataclass(frozen=True, slots=True)
class Branches:
    """All common zeros for p at which no `generic` polynomial is zero; `closed`: factors that have
    none.
    """

    open: tuple[Branch, ...]
    closed: tuple[fmpz_mpoly, ...]
    generic: tuple[fmpz_mpoly, ...]


def branches(ring: Orthant, polynomial: fmpz_mpoly, other: fmpz_mpoly) -> Branches | None:
    """The common zeros of two equations in two unknowns; None where they are not of this form.
    Raises TooMuch.
    """
    unknowns = ring.occurring((polynomial, other))
    shared = [i for i in unknowns if polynomial.degrees()[i] and other.degrees()[i]]
    if len(unknowns) != 2 or not shared:
        return None
    at = min(shared, key=lambda i: int(polynomial.degrees()[i]) * int(other.degrees()[i]))
    kept = next(i for i in unknowns if i != at)
    if _size(polynomial, other, at) > SIZE:
        raise TooMuch(f"a resultant of polynomials of {len(polynomial)} and {len(other)} terms")
    line, contents = _line(ring, polynomial, other, at)
    open_, closed, generic = list[Branch](), list[fmpz_mpoly](), list[fmpz_mpoly]()
    for factor, _ in factorise(polynomial.resultant(other, at))[1]:
        if not factor.degrees()[kept]:
            generic.append(factor)
        elif ring.sign(factor):
            closed.append(factor)
        elif line is None or any(divides(factor, c) for c in (line[1], *contents)):
            open_.append(Branch(factor))
        else:
            wanted = [line[1], *contents]
            missed = [e for e in (polynomial, other) if not divides(factor, _on(ring, e, at, line))]
            wanted += [_on(ring, e, at, line) for e in missed[:1]]
            generic += [_apart(ring, factor, c, kept) for c in wanted]
            if missed:
                closed.append(factor)
            else:
                open_.append(Branch(factor, (at, *line)))
    return Branches(tuple(open_), tuple(closed), tuple(generic))


def divides(factor: fmpz_mpoly, polynomial: fmpz_mpoly) -> bool:
    """Return True if an irreducible polynomial divides another one."""
    return not polynomial.gcd(factor).is_constant()


def _apart(ring: Orthant, factor: fmpz_mpoly, polynomial: fmpz_mpoly, at: int) -> fmpz_mpoly:
    """Polynomial that is nonzero where both have no common zero: their resultant, or 0 if it is too
    large, which gives no statement for any p.
    """
    if not polynomial.degrees()[at]:
        return polynomial
    return (
        factor.resultant(polynomial, at) if _size(factor, polynomial, at) < SIZE else ring.number(0)
    )


def _size(polynomial: fmpz_mpoly, other: fmpz_mpoly, at: int) -> int:
    return (
        len(polynomial)
        * len(other)
        * (int(polynomial.degrees()[at]) * int(other.degrees()[at])) ** 2
    )


def _on(ring: Orthant, polynomial: fmpz_mpoly, at: int, line: Line) -> fmpz_mpoly:
    """Numerator of the value at -t/s."""
    return ring.put(polynomial, at, -line[0], line[1])[0]


def _line(
    ring: Orthant, polynomial: fmpz_mpoly, other: fmpz_mpoly, at: int
) -> tuple[Line | None, list[fmpz_mpoly]]:
    """(t, s) of s y + t, and the contents that were left out; None where no remainder is linear."""
    first, second = sorted((polynomial, other), key=lambda e: -int(e.degrees()[at]))
    contents = list[fmpz_mpoly]()
    while int(second.degrees()[at]) > 1:
        rest = _remainder(ring, first, second, at)
        if rest.is_zero() or not rest.degrees()[at]:
            return None, contents
        content = _content(ring, rest, at)
        contents.append(content)
        first, second = second, rest // content
        if len(second) > 10 * ring.terms:
            raise TooMuch(f"a remainder of {len(second)} terms")
    rest, factor = ring.coefficients(second, at)
    return (rest, factor), contents


def _remainder(ring: Orthant, first: fmpz_mpoly, second: fmpz_mpoly, at: int) -> fmpz_mpoly:
    """The pseudo-remainder in one variable."""
    y, degree = ring.generators[at], int(second.degrees()[at])
    lead = ring.coefficients(second, at)[-1]
    while not first.is_zero() and int(first.degrees()[at]) >= degree:
        top = ring.coefficients(first, at)[-1]
        first = lead * first - top * second * y ** (int(first.degrees()[at]) - degree)
        if len(first) > 100 * ring.terms:
            raise TooMuch(f"a remainder of {len(first)} terms")
    return first


def _content(ring: Orthant, polynomial: fmpz_mpoly, at: int) -> fmpz_mpoly:
    common = ring.number(0)
    for c in ring.coefficients(polynomial, at):
        common = common.gcd(c)
    return common


@dataclass(frozen=True, slots=True)
class Case:
    """Equations left over (irreducible, in no unknown linear), polynomials that are positive,
    unknowns that are solved for.

    `nonzero`: irreducible polynomials with unknowns that are not zero.
    """

    equations: tuple[fmpz_mpoly, ...] = ()
    positive: tuple[fmpz_mpoly, ...] = ()
    solved: tuple[tuple[int, RationalFunction], ...] = ()
    nonzero: tuple[fmpz_mpoly, ...] = ()


def substitute(ring: Orthant, case: Case, at: int, by: RationalFunction) -> Case | str:
    """A case with one unknown replaced by a fraction whose denominator is not zero; else what
    would have to hold and fails.
    """
    put = [ring.put(c, at, by.num, by.den)[0] for c in case.nonzero]
    void = next(
        (c for c, polynomial in zip(case.nonzero, put, strict=True) if polynomial.is_zero()), None
    )
    if void is not None:
        return f"{void} != 0"
    positive, failing = inequalities(ring, (put_positive(ring, g, at, by) for g in case.positive))
    if failing is not None:
        return f"{failing} > 0"
    equations = tuple(ring.put(e, at, by.num, by.den)[0] for e in case.equations)
    solved = tuple((i, put_ratio(ring, value, at, by)) for i, value in case.solved)
    return Case(equations, positive, (*solved, (at, by)), unknown_factors(ring, put))


def unknown_factors(ring: Orthant, polynomials: Iterable[fmpz_mpoly]) -> tuple[fmpz_mpoly, ...]:
    """The distinct irreducible factors that contain unknowns."""
    every = [
        f for polynomial in polynomials for f, _ in factorise(polynomial)[1] if ring.occurring([f])
    ]
    return tuple(f for i, f in enumerate(every) if f not in every[:i])


def choose(ring: Orthant, case: Case, at: int, values: Callable[[int], RationalFunction]) -> Case:
    """A case with an unknown of no equation and no inequality replaced by the first of values(1),
    values(2), .. that may be.

    These are different fractions. A polynomial of degree d in the unknown is zero at d of them at
    most, if it is not zero.
    """
    numbers = range(1, 2 + sum(int(c.degrees()[at]) for c in case.nonzero))
    return next(c for k in numbers if isinstance(c := substitute(ring, case, at, values(k)), Case))


def fix_free(ring: Orthant, case: Case) -> Case:
    """A case whose unknowns of no equation and no inequality are numbers at which no `nonzero`
    polynomial is zero.
    """
    left = ring.occurring((*case.equations, *case.positive))
    for at in ring.unknowns:
        if at not in left and at not in dict(case.solved):
            case = choose(
                ring, case, at, lambda k: RationalFunction(ring.number(k), ring.number(1))
            )
    return case


def put_positive(
    ring: Orthant, polynomial: fmpz_mpoly, at: int, by: RationalFunction
) -> fmpz_mpoly:
    """A polynomial with the sign of the value where one variable is replaced by a fraction."""
    the_polynomial, degree = ring.put(polynomial, at, by.num, by.den)
    return the_polynomial * by.den if degree % 2 and ring.sign(by.den) <= 0 else the_polynomial


def inequalities(
    ring: Orthant, polynomials: Iterable[fmpz_mpoly]
) -> tuple[tuple[fmpz_mpoly, ...], fmpz_mpoly | None]:
    """The inequalities that are not proven to hold, shortened, and one that fails or contradicts
    another, if there is one.
    """
    kept: list[fmpz_mpoly] = []
    for polynomial in polynomials:
        shorter = simplify(ring, polynomial)
        if shorter is None or any(x == -shorter or ring.sign(x + shorter) < 0 for x in kept):
            return (), polynomial
        if not shorter.is_one() and shorter not in kept:
            kept.append(shorter)
    return tuple(kept), None


def simplify(ring: Orthant, polynomial: fmpz_mpoly) -> fmpz_mpoly | None:
    """Polynomial that must be positive for the given one to be positive, 1 where it always is; None
    where it never is.
    """
    if polynomial.is_zero():
        return None
    sign, factors = ring.parts(polynomial, odd=True)
    if not factors:
        return ring.number(1) if sign > 0 else None
    return sign * ring.product(factors)


def put_ratio(
    ring: Orthant, value: RationalFunction, at: int, by: RationalFunction
) -> RationalFunction:
    """A fraction with one variable replaced by another fraction."""
    (top, above), (bottom, below) = (
        ring.put(side, at, by.num, by.den) for side in (value.num, value.den)
    )
    return RationalFunction(
        top * by.den ** max(below - above, 0), bottom * by.den ** max(above - below, 0)
    )
