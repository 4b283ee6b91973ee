"""Two equations in two unknowns as one equation in one of them.

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

from dataclasses import dataclass

from flint import fmpz_mpoly

from disting.algebra.symbols import factored
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


def branches(ring: Orthant, one: fmpz_mpoly, other: fmpz_mpoly) -> Branches | None:
    """The common zeros of two equations in two unknowns; None where they are not of this form.
    Raises TooMuch.
    """
    unknowns = ring.occurring((one, other))
    shared = [i for i in unknowns if one.degrees()[i] and other.degrees()[i]]
    if len(unknowns) != 2 or not shared:
        return None
    at = min(shared, key=lambda i: int(one.degrees()[i]) * int(other.degrees()[i]))
    kept = next(i for i in unknowns if i != at)
    if _size(one, other, at) > SIZE:
        raise TooMuch(f"a resultant of polynomials of {len(one)} and {len(other)} terms")
    line, contents = _line(ring, one, other, at)
    open_, closed, generic = list[Branch](), list[fmpz_mpoly](), list[fmpz_mpoly]()
    for factor, _ in factored(one.resultant(other, at))[1]:
        if not factor.degrees()[kept]:
            generic.append(factor)
        elif ring.sign(factor):
            closed.append(factor)
        elif line is None or any(divides(factor, c) for c in (line[1], *contents)):
            open_.append(Branch(factor))
        else:
            asked = [line[1], *contents]
            missed = [e for e in (one, other) if not divides(factor, _on(ring, e, at, line))]
            asked += [_on(ring, e, at, line) for e in missed[:1]]
            generic += [_apart(ring, factor, c, kept) for c in asked]
            if missed:
                closed.append(factor)
            else:
                open_.append(Branch(factor, (at, *line)))
    return Branches(tuple(open_), tuple(closed), tuple(generic))


def divides(factor: fmpz_mpoly, polynomial: fmpz_mpoly) -> bool:
    """Whether an irreducible polynomial divides another one."""
    return not polynomial.gcd(factor).is_constant()


def _apart(ring: Orthant, factor: fmpz_mpoly, polynomial: fmpz_mpoly, at: int) -> fmpz_mpoly:
    """What is not zero where both have no common zero: their resultant, or 0 if it is too large, so
    that nothing is said of any p.
    """
    if not polynomial.degrees()[at]:
        return polynomial
    return (
        factor.resultant(polynomial, at) if _size(factor, polynomial, at) < SIZE else ring.number(0)
    )


def _size(one: fmpz_mpoly, other: fmpz_mpoly, at: int) -> int:
    return len(one) * len(other) * (int(one.degrees()[at]) * int(other.degrees()[at])) ** 2


def _on(ring: Orthant, polynomial: fmpz_mpoly, at: int, line: Line) -> fmpz_mpoly:
    """Numerator of the value at -t/s."""
    return ring.put(polynomial, at, -line[0], line[1])[0]


def _line(
    ring: Orthant, one: fmpz_mpoly, other: fmpz_mpoly, at: int
) -> tuple[Line | None, list[fmpz_mpoly]]:
    """(t, s) of s y + t, and the contents that were left out; None where no remainder is linear."""
    first, second = sorted((one, other), key=lambda e: -int(e.degrees()[at]))
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
    found = ring.number(0)
    for c in ring.coefficients(polynomial, at):
        found = found.gcd(c)
    return found
